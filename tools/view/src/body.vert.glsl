// A bone of the body; an instance is a character.
uniform highp sampler2D uBones;  // a texel each: the joints at both ends, the radii there

void main() {
    vec4 bone = texel(uBones, int(part));
    int character = characterOf(gl_InstanceID);
    vec3 place = placeOf(character).xyz;
    putCapsule(place + jointOf(character, int(bone.x)), place + jointOf(character, int(bone.y)), bone.z, bone.w);
}
