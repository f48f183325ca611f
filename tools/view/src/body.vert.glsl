// A bone of the body; an instance is a character.
uniform highp sampler2D uBones;  // a texel each: the joints at both ends, the radii there

void main() {
    vec4 bone = texel(uBones, int(part));
    int character = characterOf(gl_InstanceID);
    vec4 place = placeOf(character);
    vec3 a = place.xyz + jointOf(character, int(bone.x)), b = place.xyz + jointOf(character, int(bone.y));
    putCapsule(a, b, place.w * bone.z, place.w * bone.w);
}
