// A bone of the body: one instance for each character and bone.
uniform highp sampler2D uBones;  // a texel each: the joints at both ends, the radii there
uniform int uBoneCount;

void main() {
    int character = gl_InstanceID / uBoneCount;
    vec4 bone = texel(uBones, gl_InstanceID % uBoneCount);
    vec3 place = placeOf(character).xyz;
    putCapsule(place + jointOf(character, int(bone.x)), place + jointOf(character, int(bone.y)), bone.z, bone.w);
}
