uniform vec3 uChosenColour;
#ifdef MAP
uniform sampler2D uMap;
#endif
in float vChosen;
in vec3 vTint;
in vec2 vAt;
void main() {
#ifdef SHADOW
    colour = vec4(faded(uShade), 1.0);
#else
    vec3 base = uColour;
#ifdef MAP
    vec4 texel = texture(uMap, vAt);
    if (texel.a < ALPHA_TEST) discard;
    base *= texel.rgb;
#else
    base *= vTint;
#endif
    colour = vec4(faded(lit(mix(base, uChosenColour, 0.6 * vChosen))), 1.0);
#endif
}
