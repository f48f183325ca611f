// SPDX-License-Identifier: MIT
//
// What the shader makes of a limb, read back for tests: elbow and wrist of those that are drawn, relative to the
// character's place, with how far the limb misses and how it slides, by the vertex shader's own function.
import { BufferGeometry, FloatType, GLSL3, NearestFilter, Points, RGBAFormat, Scene, ShaderMaterial, WebGLRenderTarget } from "three";

import crowdGlsl from "./crowd.glsl";
import limbGlsl from "./limb.glsl";

const vertex = `
uniform int uCount;
flat out vec4 vJoint;
void main() {
    int character = characterOf(gl_VertexID / 2);
    Limb limb = limbOf(limbOfInstance(gl_VertexID / 2));
    vec3 root = rootOf(character) + vec3(0.0, risesOf(character).y, 0.0);
    vJoint = gl_VertexID % 2 == 0 ? vec4(root + limb.elbow, limb.missed) : vec4(root + limb.wrist, limb.slide);
    gl_Position = vec4((float(gl_VertexID) + 0.5) / float(2 * uCount) * 2.0 - 1.0, 0.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}`;
const fragment = `
flat in vec4 vJoint;
out vec4 colour;
void main() { colour = vJoint; }`;

let former = null;  // the last call's material, which keeps the program for the next one

/** Elbow and wrist in turns: three numbers each, and what the limb misses by, or its slide. count: at most some thousand. */
export function readback(view, limb, count) {
    const { bodies, renderer, camera } = view, { uniforms } = bodies.limbs[limb.index];
    const target = new WebGLRenderTarget(2 * count, 1, { type: FloatType, format: RGBAFormat, minFilter: NearestFilter, magFilter: NearestFilter });
    const material = new ShaderMaterial({
        uniforms: { ...bodies.shared, ...uniforms, uCount: { value: count } }, glslVersion: GLSL3,
        vertexShader: [crowdGlsl, limbGlsl, vertex].join("\n"), fragmentShader: fragment,
    });
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, 2 * count);
    const points = new Points(geometry, material), scene = new Scene();
    points.frustumCulled = false;
    scene.add(points);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const texels = new Float32Array(8 * count);
    renderer.readRenderTargetPixels(target, 0, 0, 2 * count, 1, texels);
    renderer.setRenderTarget(null);
    [target, geometry, former].forEach((each) => each?.dispose());
    former = material;
    return Array.from({ length: 2 * count }, (_, n) => Array.from(texels.subarray(4 * n, 4 * n + 4)));
}
