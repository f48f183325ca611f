// A bone of the body; an instance is a character.
uniform highp sampler2D uBones;  // a texel each: the joints at both ends, the radii there

void main() {
    vec4 bone = texel(uBones, int(part));
    int character = characterOf(gl_InstanceID);
    vec4 place = placeOf(character);
    vec2 rises = risesOf(character);
    vec3 at = place.xyz + vec3(0.0, rises.x, 0.0);
    vec3 a = at + jointOf(character, int(bone.x)), b = at + jointOf(character, int(bone.y));
    floorAt = rises.y;
    putCapsule(a, b, place.w * bone.z, place.w * bone.w);
}
