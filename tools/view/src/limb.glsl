// Forward kinematics of a limb, from the rows that the solver reads and writes: row r of limb i is texel
// (16 r + i % 16, i / 16). All is relative to the character's root. The extra character's block is the last line.
uniform highp usampler2D uInputs, uResults;
uniform int uTargetRow, uEffectorRow, uAimRow, uWeightsRow;                         // of inputs; -1: there are none
uniform int uShoulderRow, uElbowRow, uWristRow, uFlagsRow, uStretchRow, uRecordRow;  // of results
uniform int uGoalRow;       // of results, too: where a foot that stands was sent
uniform int uPlantRow;      // of results, too: how a foot's point stands
uniform int uBlocks;        // of the rows before the extra one
uniform vec4 uHandFromArm;  // from the hand, which has the arm frame's axes at rest, to the wrist joint
uniform vec3 uTip;          // the hand's end, in the wrist joint's frame

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
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// How far the wrist, or the effector, is from its target. With an aim: how far the target is from the hand's ray.
float missedBy(int limb, vec3 wrist, vec4 hand, float scale) {
    vec3 miss = (uGoalRow < 0 ? vector(uInputs, uTargetRow, limb) : vector(uResults, uGoalRow, limb)) - wrist;
    if (uWeightsRow >= 0 && number(uInputs, uWeightsRow, limb) == 0.0) return 0.0;  // it goes along with its body
    if (uEffectorRow >= 0) miss -= scale * turned(hand, vector(uInputs, uEffectorRow, limb));
    if (uAimRow >= 0) {
        vec3 axis = normalize(turned(hand, vector(uInputs, uAimRow, limb)));
        miss -= max(dot(miss, axis), 0.0) * axis;
    }
    return length(miss);
}

// How fast a point that is down moves, in lengths of the limb a second; -1 where it is not down, or no foot.
float slideOf(int limb, float limbLength) {
    bool isDown = uPlantRow >= 0 && (int(number(uResults, uPlantRow + 10, limb)) & 1) == 1;
    return isDown ? length(vector(uResults, uPlantRow + 6, limb)) / max(limbLength, 1e-30) : -1.0;
}

struct Limb {
    vec3 shoulder, elbow, wrist, tip;
    uint flags;
    float flexion, missed;  // radians; as swivel_residuals() has it, in arm lengths
    float slide;            // as slideOf() has it
};

// SWIVEL_RECORD has the shoulder's place, the arm frame, the scale and both lengths, then the incoming rotations, which
// hands keep that are not solved.
Limb limbOf(int limb) {
    vec3 shoulder = vector(uResults, uRecordRow, limb), sizes = vector(uResults, uRecordRow + 7, limb);
    vec2 bones = sizes.x * (uStretchRow < 0 ? 1.0 : number(uResults, uStretchRow, limb)) * sizes.yz;
    vec4 flexion = vec4(-number(uResults, uElbowRow + 1, limb), 0.0, 0.0, number(uResults, uElbowRow, limb));
    vec4 upperAxes = times(rotation(uResults, uRecordRow + 3, limb), rotation(uResults, uShoulderRow, limb));
    vec4 foreAxes = times(upperAxes, normalize(flexion));
    vec4 wristTurn = rotation(uResults, uWristRow < 0 ? uRecordRow + 18 : uWristRow, limb);
    vec4 hand = times(times(foreAxes, wristTurn), uHandFromArm);
    vec3 upperAxis = turned(upperAxes, vec3(0.0, 0.0, 1.0)), foreAxis = turned(foreAxes, vec3(0.0, 0.0, 1.0));
    vec3 elbow = shoulder + bones.x * upperAxis, wrist = elbow + bones.y * foreAxis;
    return Limb(shoulder, elbow, wrist, wrist + sizes.x * turned(hand, uTip), word(uResults, uFlagsRow, limb),
                acos(clamp(dot(upperAxis, foreAxis), -1.0, 1.0)),
                missedBy(limb, wrist, hand, sizes.x) / max(bones.x + bones.y, 1e-30), slideOf(limb, bones.x + bones.y));
}
