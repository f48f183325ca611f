// A capsule from a to b, as wide as their radii: position holds the direction from its axis, z along it; end is 0 at a
// and 1 at b. Then the eye's space, or the shadow on the ground.
in float end, part;
uniform float uScale, uGround;  // metres of the scene for a unit of the clip; the ground's height in the clip
uniform vec3 uSun;
out vec3 vNormal;
out float vDepth;

void putCapsule(vec3 a, vec3 b, float radiusA, float radiusB) {
    vec3 axis = b - a;
    float distance_ab = length(axis);
    vec3 along = distance_ab > 1e-6 * radiusA ? axis / distance_ab : vec3(0.0, 1.0, 0.0);
    vec3 side = normalize(abs(along.y) < 0.9 ? cross(along, vec3(0.0, 1.0, 0.0)) : cross(along, vec3(1.0, 0.0, 0.0)));
    vec3 normal = position.x * side + position.y * cross(along, side) + position.z * along;
    vec3 at = uScale * (mix(a, b, end) + mix(radiusA, radiusB, end) * normal - vec3(0.0, uGround, 0.0));
#ifdef SHADOW
    at = vec3(at.xz - uSun.xz * (max(at.y, 0.0) / uSun.y), 0.004).xzy;
#endif
    vNormal = normal;
    vec4 seen = viewMatrix * vec4(at, 1.0);
    vDepth = -seen.z;
    gl_Position = projectionMatrix * seen;
}
