// A limb in its own colour, or by what the solver says of it (colours.js has the same numbers for the legend).
uniform int uColourBy;         // 0: its own, 1: error, 2: flag, 3: flexion
uniform vec3 uRamp[5];         // of error and flexion
uniform vec3 uFlagColours[6];  // reached, softened or stretched, out of reach, limited, undefined swivel, bad input
uniform vec3 uChosenColour;
flat in uint vFlags;
flat in float vFlexion, vMissed, vChosen;

vec3 ramp(float share) {
    float at = clamp(share, 0.0, 1.0) * 4.0;
    int n = min(int(at), 3);
    return mix(uRamp[n], uRamp[n + 1], at - float(n));
}
vec3 ofFlags() {
    if ((vFlags & BAD) != 0u) return uFlagColours[5];
    if ((vFlags & UNDEFINED) != 0u) return uFlagColours[4];
    if ((vFlags & LIMITED) != 0u) return uFlagColours[3];
    if ((vFlags & CLAMPED) != 0u) return uFlagColours[2];
    if ((vFlags & EASED) != 0u) return uFlagColours[1];
    return uFlagColours[0];
}
void main() {
#ifdef SHADOW
    colour = vec4(faded(uShade), 1.0);
#else
    vec3 base = uColourBy == 1   ? ramp((log(max(vMissed, 1e-9)) / log(10.0) + 8.0) / 8.0)
                : uColourBy == 2 ? ofFlags()
                : uColourBy == 3 ? ramp(vFlexion / 2.6179939)
                                 : uColour;
    colour = vec4(faded(lit(mix(base, uChosenColour, 0.75 * vChosen))), 1.0);
#endif
}
