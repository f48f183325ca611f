// A bone of the body; an instance is a character.
uniform highp sampler2D uBones;  // a texel each: the joints at both ends, the radii there

void main() {
    vec4 bone = texel(uBones, int(part));
    vec3 place = placeOf(gl_InstanceID).xyz;
    putCapsule(place + jointOf(gl_InstanceID, int(bone.x)), place + jointOf(gl_InstanceID, int(bone.y)), bone.z, bone.w);
}
