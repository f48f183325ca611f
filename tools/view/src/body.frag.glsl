void main() {
#ifdef SHADOW
    colour = vec4(faded(uShade), 1.0);
#else
    colour = vec4(faded(lit(uColour)), 1.0);
#endif
}
