// Forward kinematics of a limb, from the rows that the solver reads and writes: row r of limb i is texel
// (16 r + i % 16, i / 16). All is relative to the limb's shoulder. The extra character's block is the last line.
uniform highp usampler2D uInputs, uResults;
uniform int uRotationRow, uLengthsRow, uTargetRow, uClavicleRow, uEffectorRow, uAimRow;  // of inputs; -1: there are none
uniform int uShoulderRow, uElbowRow, uWristRow, uFlagsRow, uStretchRow, uTurnRow;        // of results
uniform vec4 uUpperFromArm, uElbowParentFromArm, uForeFromArm, uWristParentFromArm, uWristRest;
uniform int uBlocks;    // of the rows before the extra one
uniform float uMirror;  // -1 where the limb is solved in the mirror image, else 1
uniform vec3 uTip;      // the hand's end, in the wrist joint's frame

// Which limb of the rows is an instance's.
int limbOfInstance(int instance) { return instance < uDrawn ? instance : 16 * uBlocks + uExtra % 16; }
uint word(highp usampler2D rows, int row, int limb) {
    return texelFetch(rows, ivec2(16 * row + limb % 16, limb / 16), 0).r;
}
float number(highp usampler2D rows, int row, int limb) { return uintBitsToFloat(word(rows, row, limb)); }
vec3 vector(highp usampler2D rows, int row, int limb) {
    return vec3(number(rows, row, limb), number(rows, row + 1, limb), number(rows, row + 2, limb));
}
vec4 rotation(highp usampler2D rows, int row, int limb) {
    return normalize(vec4(vector(rows, row, limb), number(rows, row + 3, limb)));
}
// Hamilton's quaternions, x y z w: a * b turns by b first.
vec4 times(vec4 a, vec4 b) { return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz)); }
vec4 back(vec4 q) { return vec4(-q.xyz, q.w); }
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// How far the wrist, or the effector, is from its target. With an aim: how far the target is from the hand's ray.
float missedBy(int limb, vec3 wrist, vec4 hand) {
    vec3 miss = vector(uInputs, uTargetRow, limb) - wrist;
    if (uEffectorRow >= 0) miss -= turned(hand, vector(uInputs, uEffectorRow, limb));
    if (uAimRow >= 0) {
        vec3 axis = normalize(turned(hand, vector(uInputs, uAimRow, limb)));
        miss -= max(dot(miss, axis), 0.0) * axis;
    }
    return length(miss);
}

struct Limb {
    vec3 shoulder, elbow, wrist, tip;
    uint flags;
    float flexion, missed;  // radians; as swivel_residuals() has it, in arm lengths
};

Limb limbOf(int limb, float size) {
    vec4 parent = rotation(uInputs, uRotationRow, limb);
    vec3 shoulder = vec3(0.0);
    if (uClavicleRow >= 0) {
        vec3 bone = vector(uInputs, uClavicleRow, limb);
        vec4 turn = rotation(uResults, uTurnRow, limb);
        shoulder = turned(parent, turned(turn, bone) - bone);
        parent = times(parent, turn);
    }
    float stretch = uStretchRow < 0 ? 1.0 : number(uResults, uStretchRow, limb);
    float upper = stretch * number(uInputs, uLengthsRow, limb), fore = stretch * number(uInputs, uLengthsRow + 1, limb);
    vec4 upperAxes = times(times(parent, rotation(uResults, uShoulderRow, limb)), uUpperFromArm);
    vec4 foreAxes = times(times(times(upperAxes, back(uElbowParentFromArm)), rotation(uResults, uElbowRow, limb)), uForeFromArm);
    vec4 hand = times(times(foreAxes, back(uWristParentFromArm)),
                      uWristRow < 0 ? uWristRest : rotation(uResults, uWristRow, limb));
    vec3 upperAxis = turned(upperAxes, vec3(0.0, 0.0, 1.0)), foreAxis = turned(foreAxes, vec3(0.0, 0.0, 1.0));
    vec3 elbow = shoulder + upper * upperAxis, wrist = elbow + fore * foreAxis, tip = wrist + size * turned(hand, uTip);
    vec3 mirror = vec3(uMirror, 1.0, 1.0);
    return Limb(mirror * shoulder, mirror * elbow, mirror * wrist, mirror * tip, word(uResults, uFlagsRow, limb),
                acos(clamp(dot(upperAxis, foreAxis), -1.0, 1.0)),
                missedBy(limb, wrist, hand) / max(upper + fore, 1e-30));
}
