// SPDX-License-Identifier: MIT
//
// The ground that is drawn: a plane, or the crowd's hills, in metres of the scene. Shadows read the same heights.
import { BufferGeometry, DataTexture, Float32BufferAttribute, FloatType, PlaneGeometry, RedFormat, Vector4 } from "three";

import { hasHills } from "./mounds.js";

const FAR = 2000;  // metres to the ends of what is drawn
const MOST = 512;  // heights along a side that are drawn

/** From the first to the last, as many as there are, or fewer. */
function places(middle, size, count) {
    const drawn = Math.min(count, MOST);
    return Array.from({ length: drawn }, (_, n) => middle + size * (n / (drawn - 1) - 0.5));
}

export class Ground {
    /** metres: of the scene for a unit of the clip; floor: of the clip, where the scene has its height 0. */
    constructor(stage, metres, floor) {
        Object.assign(this, { stage, metres, floor, mounds: stage.mounds });
        const { middle, size, columns, rows } = stage.ground ?? {}, isHilly = hasHills(stage);
        this.xs = isHilly ? places(middle[0], size[0], columns) : [];
        this.zs = isHilly ? places(middle[2], size[2], rows) : [];
        this.heights = heightTexture(this.xs.length, this.zs.length);
        this.uniforms = { uHeights: { value: this.heights }, uHills: { value: isHilly }, uGrid: { value: gridOf(this.xs, this.zs, metres) } };
        this.geometry = isHilly ? this.makeHills() : new PlaneGeometry(2 * FAR, 2 * FAR).rotateX(-Math.PI / 2).translate(0, stage.ground ? this.heightAt(0, 0) : 0, 0);
        if (isHilly) this.takeHeights();
    }
    heightAt(x, z) { return this.metres * (this.stage.groundHeight(x, z) - this.floor); }
    /** Level yet. */
    makeHills() {
        const far = FAR / this.metres, along = (line) => [Math.min(-far, line[0] - far), ...line, Math.max(far, line.at(-1) + far)];
        const wide = this.wide = along(this.xs), deep = this.deep = along(this.zs), positions = [], indices = [];
        for (const z of deep) for (const x of wide) positions.push(this.metres * x, 0, this.metres * z);
        for (let row = 1; row < deep.length; ++row)
            for (let column = 1; column < wide.length; ++column) {
                const at = row * wide.length + column, before = at - wide.length;
                indices.push(before - 1, at - 1, before, before, at - 1, at);
            }
        const geometry = new BufferGeometry();
        geometry.setIndex(indices);
        return geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
    }
    /** Takes the heights that the stage has now. */
    takeHeights() {
        const { wide, deep, geometry: { attributes: { position } } } = this, { data, width } = this.heights.image;
        deep.forEach((z, row) => wide.forEach((x, column) => position.setY(row * wide.length + column, this.heightAt(x, z))));
        position.needsUpdate = true;
        this.geometry.computeVertexNormals();
        for (let n = 0; n < data.length; ++n) data[n] = position.getY((Math.floor(n / width) + 1) * wide.length + n % width + 1);  // the ground goes on by a row and a column
        this.heights.needsUpdate = true;
    }
    /** Before a picture: whether the user has changed the hills. */
    update() {
        if (this.mounds === this.stage.mounds) return;
        this.mounds = this.stage.mounds;
        this.takeHeights();
    }
}

function heightTexture(width, height) {
    const texture = width > 0 ? new DataTexture(new Float32Array(width * height), width, height, RedFormat, FloatType) : new DataTexture(new Float32Array(1), 1, 1, RedFormat, FloatType);
    texture.internalFormat = "R32F";
    texture.needsUpdate = true;
    return texture;
}
/** Where the first height is, and how far the next ones are, in metres. */
function gridOf(xs, zs, metres) {
    return xs.length > 0 ? new Vector4(xs[0], zs[0], xs[1] - xs[0], zs[1] - zs[0]).multiplyScalar(metres) : new Vector4(0, 0, 1, 1);
}
