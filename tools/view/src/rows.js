// SPDX-License-Identifier: MIT
//
// Memory as textures: the solver's own rows go to the graphics processor as they lie.
import { DataTexture, FloatType, RedIntegerFormat, RGBAFormat, UnsignedIntType } from "three";

import { Field } from "./stage.js";

const WIDTH = 2048;  // of textures that are only long

/** Refuses what a browser's textures cannot hold. max: how many texels a side of them has at most. */
function checkSides(what, width, height, max) {
    const side = Math.max(width, height);
    if (side <= max) return;
    const why = `a texture has ${max} texels a side, and they take ${side}`;
    throw new Error(`this browser's graphics cannot hold ${what}: ${why}. Take fewer --frames or --characters`);
}
/** How many characters fit: a texture has a line for a block of 16, and one for the block of an extra character. */
export const maxDrawn = (max) => 16 * (max - 1);

/** A texture of four floats a texel, one after the other. */
export function floatTexture(what, texels, max) {
    const height = Math.max(1, Math.ceil(texels.length / (4 * WIDTH)));
    checkSides(what, WIDTH, height, max);
    const padded = new Float32Array(4 * WIDTH * height);
    padded.set(texels);
    const texture = new DataTexture(padded, WIDTH, height, RGBAFormat, FloatType);
    texture.internalFormat = "RGBA32F";
    texture.needsUpdate = true;
    return texture;
}

/** Blocks of rows: a line of texels for each block of 16 limbs. Words, because flags are no numbers. */
function blockTexture(words, rowCount) {
    const texture = new DataTexture(words, 16 * rowCount, words.length / (16 * rowCount), RedIntegerFormat, UnsignedIntType);
    texture.internalFormat = "R32UI";
    texture.needsUpdate = true;
    return texture;
}

/** The rows of one limb: the first blocks of 16 characters, and one more block unless extra is null. */
export class LimbRows {
    constructor(crowd, limb, blocks, extra, max) {
        this.max = max;
        this.blocks = blocks;
        this.extra = extra;
        this.copies = [];  // of rows, into textures that are no part of the solver's memory
        const group = limb.index, { blockCount } = crowd;
        this.inputs = this.texture(crowd.inputRows(group), blockCount);
        this.results = this.texture(crowd.resultRows(group), blockCount);
        const row = (name) => (crowd.componentCount(Field[name], group) > 0 ? crowd.fieldFirstRow(Field[name], group) : -1);
        this.uniforms = {
            uInputs: this.inputs, uResults: this.results,
            uTargetRow: row("TARGET"), uEffectorRow: row("EFFECTOR"), uAimRow: row("AIM"), uWeightsRow: row("WEIGHTS"),
            uShoulderRow: row("SHOULDER"), uElbowRow: row("ELBOW"), uWristRow: row("WRIST"), uFlagsRow: row("FLAGS"),
            uStretchRow: row("STRETCH"), uRecordRow: row("RECORD"), uGoalRow: row("SOLVED_GOAL"), uPlantRow: row("PLANT"), uBlocks: blocks,
        };
    }
    texture(rows, blockCount) {
        const perBlock = rows.length / blockCount;
        const from = (block, count) => new Uint32Array(rows.buffer, rows.byteOffset + 4 * perBlock * block, perBlock * count);
        const lines = this.blocks + (this.extra === null ? 0 : 1), first = from(0, this.blocks);
        checkSides("the limbs' numbers", perBlock, lines, this.max);
        if (this.extra === null) return blockTexture(first, perBlock / 16);
        const words = new Uint32Array(perBlock * lines), extra = from(this.extra, 1);
        this.copies.push(() => {
            words.set(first);
            words.set(extra, first.length);
        });
        this.copies.at(-1)();
        return blockTexture(words, perBlock / 16);
    }
    /** After a solve. */
    update() {
        this.copies.forEach((copy) => copy());
        this.inputs.needsUpdate = this.results.needsUpdate = true;
    }
    dispose() {
        this.inputs.dispose();
        this.results.dispose();
    }
}
