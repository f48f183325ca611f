// What makes a character: two texels each, place and size, then the frame of its clip that it starts at, which frames its clip is, and its heading. What is at x in the
// clip is at place + size * x, where x is turned about y. Positions of the clip's joints lie one after the other, frame by frame.
uniform highp sampler2D uCharacters, uPositions, uRoots;  // roots: of the clip's pose, a texel for each frame
uniform highp sampler2D uRises;  // how much higher each character's joints are, and what its rows are counted from
uniform int uFrame, uJointCount;
uniform int uDrawn, uExtra;  // so many characters from the first on are drawn, and one more

vec4 texel(highp sampler2D from, int at) {
    int width = textureSize(from, 0).x;
    return texelFetch(from, ivec2(at % width, at / width), 0);
}
int characterOf(int instance) { return instance < uDrawn ? instance : uExtra; }
vec4 placeOf(int character) { return texel(uCharacters, 2 * character); }
vec2 risesOf(int character) { return texel(uRises, character).xy; }
int frameOf(int character) {
    ivec3 clip = ivec3(texel(uCharacters, 2 * character + 1).xyz);
    return clip.y + (uFrame + clip.x) % clip.z;
}
// Turns along with a character, whose heading is the tangent of a quarter of its turn.
vec3 headed(int character, vec3 at) {
    float t = texel(uCharacters, 2 * character + 1).w;
    vec2 yw = vec2(2.0 * t, 1.0 - t * t) / (1.0 + t * t);
    float cosine = yw.y * yw.y - yw.x * yw.x, sine = 2.0 * yw.x * yw.y;
    return vec3(cosine * at.x + sine * at.z, at.y, cosine * at.z - sine * at.x);
}
// These are from the character's place.
vec3 jointOf(int character, int joint) {
    return headed(character, placeOf(character).w * texel(uPositions, frameOf(character) * uJointCount + joint).xyz);
}
vec3 rootOf(int character) { return headed(character, placeOf(character).w * texel(uRoots, frameOf(character)).xyz); }
