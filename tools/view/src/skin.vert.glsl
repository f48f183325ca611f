// A vertex of the figure's skin; an instance is a character. A bone's matrix is three texels, its rows.
in vec4 skinIndex, skinWeight;
in float limb;  // that it belongs to; -1: the body
uniform highp sampler2D uPoses;
uniform int uBoneCount, uFirstBone;
uniform int uChosen, uChosenLimb;
out float vChosen;
out vec3 vTint;  // of its character, so that a crowd is not of one colour
out vec2 vAt;

mat4x3 boneOf(int bone) {
    int first = 3 * (gl_InstanceID * uBoneCount + bone);
    return transpose(mat3x4(texel(uPoses, first), texel(uPoses, first + 1), texel(uPoses, first + 2)));
}
void main() {
    int character = characterOf(gl_InstanceID);
    mat4x3 pose = mat4x3(0.0);
    for (int n = 0; n < 4; ++n)
        if (skinWeight[n] > 0.0) pose += skinWeight[n] * boneOf(uFirstBone + int(skinIndex[n]));
    floorAt = risesOf(character).y;
    vTint = mix(vec3(0.80, 0.93, 1.12), vec3(1.22, 1.0, 0.72), fract(0.618034 * float(character)));
    vChosen = character == uChosen && int(limb) == uChosenLimb ? 1.0 : 0.0;
#ifdef MAP
    vAt = uv;
#endif
    put(pose * vec4(position, 1.0), normalize(pose * vec4(normal, 0.0)));
}
