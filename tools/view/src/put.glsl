// A point of a character, from the clip's world into the eye's space, or onto the ground as a shadow.
uniform float uScale, uGround;  // metres of the scene for a unit of the clip; the ground's height in the clip
uniform vec3 uSun;
uniform highp sampler2D uHeights;  // of hills, in metres of the scene
uniform bool uHills;
uniform vec4 uGrid;  // where the first height is, x and z, and how far the next ones are
out vec3 vNormal;
out float vDepth;

float floorAt = 0.0;  // how high the ground is below the character, in the clip's unit

float heightOf(vec2 at) {
    vec2 last = vec2(textureSize(uHeights, 0) - 1), cell = clamp((at - uGrid.xy) / uGrid.zw, vec2(0.0), last);
    ivec2 first = min(ivec2(cell), ivec2(last) - 1);
    vec2 share = cell - vec2(first);
    vec4 corners = vec4(texelFetch(uHeights, first, 0).r, texelFetch(uHeights, first + ivec2(1, 0), 0).r,
                        texelFetch(uHeights, first + ivec2(0, 1), 0).r, texelFetch(uHeights, first + ivec2(1, 1), 0).r);
    vec2 rows = mix(corners.xz, corners.yw, share.x);
    return mix(rows.x, rows.y, share.y);
}

void put(vec3 place, vec3 normal) {
    vec3 at = uScale * (place - vec3(0.0, uGround, 0.0));
#ifdef SHADOW
    float ground = uScale * floorAt;
    at.xz -= uSun.xz * (max(at.y - ground, 0.0) / uSun.y);
    at.y = (uHills ? heightOf(at.xz) : ground) + 0.004;
#endif
    vNormal = normal;
    vec4 seen = viewMatrix * vec4(at, 1.0);
    vDepth = -seen.z;
    gl_Position = projectionMatrix * seen;
}
