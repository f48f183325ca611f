// A corner of a box; an instance is a box.
in float carrier;  // the character that carries it

void main() {
    floorAt = risesOf(int(carrier)).y;
    put((instanceMatrix * vec4(position, 1.0)).xyz, normalize(mat3(instanceMatrix) * normal));
}
