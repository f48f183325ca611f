// Upper arm, forearm or hand: one instance for each character and part.
uniform vec4 uRadii;  // at shoulder, elbow, wrist and the hand's end
uniform int uUpperJoint, uChosen;  // the chosen character, or -1
flat out int vCharacter;
flat out uint vFlags;
flat out float vFlexion, vMissed, vChosen;

void main() {
    int character = gl_InstanceID / 3, part = gl_InstanceID % 3;
    vec4 place = placeOf(character);
    Limb limb = limbOf(character, place.w);
    vec3 at = place.xyz + jointOf(character, uUpperJoint);
    vec3 a = part == 0 ? limb.shoulder : part == 1 ? limb.elbow : limb.wrist;
    vec3 b = part == 0 ? limb.elbow : part == 1 ? limb.wrist : limb.tip;
    putCapsule(at + a, at + b, uRadii[part], uRadii[part + 1]);
    vCharacter = character;
    vFlags = limb.flags;
    vFlexion = limb.flexion;
    vMissed = limb.missed;
    vChosen = character == uChosen ? 1.0 : 0.0;
}
