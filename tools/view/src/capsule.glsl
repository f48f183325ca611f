// A capsule from a to b, as wide as their radii: position holds the direction from its axis, z along it; end is 0 at a
// and 1 at b.
in float end, part;

void putCapsule(vec3 a, vec3 b, float radiusA, float radiusB) {
    vec3 axis = b - a;
    float distance_ab = length(axis);
    vec3 along = distance_ab > 1e-6 * radiusA ? axis / distance_ab : vec3(0.0, 1.0, 0.0);
    vec3 side = normalize(abs(along.y) < 0.9 ? cross(along, vec3(0.0, 1.0, 0.0)) : cross(along, vec3(1.0, 0.0, 0.0)));
    vec3 normal = position.x * side + position.y * cross(along, side) + position.z * along;
    put(mix(a, b, end) + mix(radiusA, radiusB, end) * normal, normal);
}
