// SPDX-License-Identifier: MIT
//
// Materials of what stands on the ground. All of it has the same light, and a shadow that its own vertices draw.
import { GLSL3, ShaderMaterial } from "three";

import crowdGlsl from "./crowd.glsl";
import light from "./light.frag.glsl";
import put from "./put.glsl";

/**
 * A mesh and its shadow. Shadows are drawn after the ground and before all bodies, and have no depth, because they lie on it.
 * vertex, fragment: shaders' texts behind what all share. make(material, isShadow) gives a mesh.
 */
export function withShadow({ vertex, fragment, defines = {}, ...more }, make) {
    return [false, true].map((isShadow) => {
        const mesh = make(new ShaderMaterial({
            ...more, glslVersion: GLSL3, defines: { ...defines, ...(isShadow && { SHADOW: "" }) },
            vertexShader: [crowdGlsl, put, ...vertex].join("\n"), fragmentShader: `uniform vec3 uSun;\n${light}\n${fragment}`,
            depthWrite: !isShadow, polygonOffset: isShadow, polygonOffsetFactor: -2, polygonOffsetUnits: -2,
        }), isShadow);
        mesh.frustumCulled = false;
        mesh.renderOrder = isShadow ? 1 : 2;
        return mesh;
    });
}
