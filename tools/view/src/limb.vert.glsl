// Upper arm, forearm and hand, parts 0, 1 and 2; an instance is a character.
uniform vec4 uRadii;  // at shoulder, elbow, wrist and the hand's end
uniform int uChosen;  // a character, or -1
flat out uint vFlags;
flat out float vFlexion, vMissed, vSlide, vChosen;

void main() {
    int character = characterOf(gl_InstanceID), n = int(part);
    vec4 place = placeOf(character);
    Limb limb = limbOf(limbOfInstance(gl_InstanceID));
    floorAt = risesOf(character).y;
    vec3 at = place.xyz + rootOf(character) + vec3(0.0, floorAt, 0.0);
    vec3 a = n == 0 ? limb.shoulder : n == 1 ? limb.elbow : limb.wrist;
    vec3 b = n == 0 ? limb.elbow : n == 1 ? limb.wrist : limb.tip;
    putCapsule(at + a, at + b, place.w * uRadii[n], place.w * uRadii[n + 1]);
    vFlags = limb.flags;
    vFlexion = limb.flexion;
    vMissed = limb.missed;
    vSlide = limb.slide;
    vChosen = character == uChosen ? 1.0 : 0.0;
}
