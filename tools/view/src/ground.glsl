// ---- vertex
out vec3 vAt, vNormal;
out float vDepth;
void main() {
    vNormal = normal;
    vAt = (modelMatrix * vec4(position, 1.0)).xyz;
    vec4 seen = viewMatrix * vec4(vAt, 1.0);
    vDepth = -seen.z;
    gl_Position = projectionMatrix * seen;
}
// ---- fragment
uniform vec3 uGroundColour, uLine, uBackground, uSun;
uniform float uFar;
in vec3 vAt, vNormal;
in float vDepth;
out vec4 colour;
// Lines a metre apart, as wide as the screen can show.
float line(vec2 at) {
    vec2 near = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), 1e-6);
    return 1.0 - min(min(near.x, near.y), 1.0);
}
void main() {
    float depth = clamp(vDepth / uFar, 0.0, 1.0);
    vec3 sun = normalize(uSun);
    float light = 1.0 + 0.9 * (dot(normalize(vNormal), sun) - sun.y);  // 1 where it is level
    vec3 seen = light * mix(uGroundColour, uLine, line(vAt.xz) * (1.0 - depth));
    colour = vec4(mix(seen, uBackground, depth * depth), 1.0);
}
