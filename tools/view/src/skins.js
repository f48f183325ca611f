// SPDX-License-Identifier: MIT
//
// Characters in the figure's own skin, an instance for each. The poses of their bones are a texture, made anew after each solve.
import { Float32BufferAttribute, Matrix4, Mesh, NoColorSpace } from "three";

import { CHOSEN, rgb } from "./colours.js";
import { Poses } from "./poses.js";
import { floatTexture } from "./rows.js";
import { withShadow } from "./shaded.js";
import skinFragment from "./skin.frag.glsl";
import skinVertex from "./skin.vert.glsl";

export const MAX_SKINS = 300;  // characters; more are drawn as capsules

export class Skins {
    /** skin: as the command writes it; meshes, bones: as readSkin() makes them of it. shared: uniforms of all that is drawn. */
    constructor(stage, figure, skin, { meshes, bones }, shared, maxTexels) {
        this.bones = bones;
        const count = Math.min(MAX_SKINS, stage.characterCount) + 1;  // one that is drawn beside the first ones
        this.poses = new Poses(stage, figure, skin, count);
        this.texture = floatTexture("the poses", new Float32Array(12 * bones.length * count), maxTexels);
        this.uniforms = {
            uPoses: { value: this.texture }, uBoneCount: { value: bones.length },
            uChosen: { value: -1 }, uChosenLimb: { value: -1 }, uChosenColour: { value: rgb(CHOSEN) },
        };
        this.meshes = meshes.flatMap((mesh) => this.draw(mesh, shared));
    }
    /** A mesh, and its shadow. */
    draw({ geometry, material: { color, map, side, alphaTest }, firstBone }, shared) {
        geometry.setAttribute("limb", this.limbsOf(geometry.attributes, firstBone));
        if (map) map.colorSpace = NoColorSpace;  // the shaders' colours are the screen's own
        const uniforms = { ...shared, ...this.uniforms, uFirstBone: { value: firstBone }, uColour: { value: color.clone().convertLinearToSRGB() }, uMap: { value: map } };
        const defines = { ALPHA_TEST: alphaTest.toFixed(3), ...(map && { MAP: "" }) };
        return withShadow({ uniforms, side, defines, vertex: [skinVertex], fragment: skinFragment }, (material) => new Mesh(geometry, material));
    }

    /** The limb of each vertex, by the bone that it mostly follows; -1: the body. */
    limbsOf({ skinIndex, skinWeight }, firstBone) {
        const limbOf = (vertex) => {
            const [heaviest] = [0, 1, 2, 3].sort((a, b) => skinWeight.getComponent(vertex, b) - skinWeight.getComponent(vertex, a));
            return this.poses.limbOf(this.bones[firstBone + skinIndex.getComponent(vertex, heaviest)].joint);
        };
        return new Float32BufferAttribute(Float32Array.from({ length: skinIndex.count }, (_, vertex) => limbOf(vertex)), 1);
    }

    /** Poses the first characters, and one more unless extra is null, as the stage has them now. */
    show(drawnCount, extra) {
        this.write(0, drawnCount, 0);
        if (extra !== null) this.write(extra, 1, drawnCount);
        this.texture.needsUpdate = true;
        for (const { geometry } of this.meshes) geometry.instanceCount = drawnCount + (extra === null ? 0 : 1);
    }
    /** Three texels a bone: the rows of its matrix. */
    write(first, count, instance) {
        const { data } = this.texture.image, { bones } = this, matrix = new Matrix4();
        this.poses.each(first, count, (n, matrices) => {
            let at = 12 * bones.length * (instance + n);
            for (const { joint, inverse } of bones) {
                const { elements: e } = matrix.multiplyMatrices(matrices[joint], inverse);
                for (let row = 0; row < 3; ++row) for (let column = 0; column < 4; ++column) data[at++] = e[4 * column + row];
            }
        });
    }
    choose(limb, character) {
        this.uniforms.uChosen.value = limb ? character : -1;
        this.uniforms.uChosenLimb.value = limb?.index ?? -1;
    }
}
