// Sky, ground and sun on a capsule; distance fades into the background.
uniform vec3 uColour, uSky, uEarth, uBackground, uShade;
uniform float uFar;  // where the background has taken all
in vec3 vNormal;
in float vDepth;
out vec4 colour;

vec3 lit(vec3 base) {
    vec3 normal = normalize(vNormal);
    vec3 light = mix(uEarth, uSky, 0.5 + 0.5 * normal.y) + 0.55 * max(dot(normal, normalize(uSun)), 0.0);
    return base * light;
}
vec3 faded(vec3 seen) {
    float depth = clamp(vDepth / uFar, 0.0, 1.0);
    return mix(seen, uBackground, depth * depth);
}
