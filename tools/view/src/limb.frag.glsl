// A limb in its own colour, or by what the solver says of it (colours.js has the same ranges for the legend).
uniform int uColourBy;  // 0: its own, 1: error, 2: flag, 3: flexion, 4: slide
uniform vec3 uRamp[5];  // of error, flexion and slide
uniform vec3 uFlagColours[FLAG_COLOURS];
uniform uint uFlagMasks[FLAG_COLOURS];  // the flags that have that colour
uniform vec3 uChosenColour;
flat in uint vFlags;
flat in float vFlexion, vMissed, vSlide, vChosen;

vec3 ramp(float share) {
    float at = clamp(share, 0.0, 1.0) * 4.0;
    int n = min(int(at), 3);
    return mix(uRamp[n], uRamp[n + 1], at - float(n));
}
vec3 ofFlags() {
    vec3 seen = uFlagColours[0];
    for (int n = 1; n < FLAG_COLOURS; ++n)  // the last that it has is the gravest
        if ((vFlags & uFlagMasks[n]) != 0u) seen = uFlagColours[n];
    return seen;
}
vec3 ofSlide() { return vSlide < 0.0 ? vec3(0.55) : ramp((log(max(vSlide, 1e-9)) / log(10.0) + 3.0) / 3.0); }
void main() {
#ifdef SHADOW
    colour = vec4(faded(uShade), 1.0);
#else
    vec3 base = uColourBy == 1   ? ramp((log(max(vMissed, 1e-9)) / log(10.0) + 8.0) / 8.0)
                : uColourBy == 2 ? ofFlags()
                : uColourBy == 3 ? ramp(vFlexion / 2.6179939)
                : uColourBy == 4 ? ofSlide()
                                 : uColour;
    colour = vec4(faded(lit(mix(base, uChosenColour, 0.75 * vChosen))), 1.0);
#endif
}
