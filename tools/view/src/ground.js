// SPDX-License-Identifier: MIT
//
// The ground that is drawn: a plane, or the crowd's hills, in metres of the scene. Shadows read the same heights.
import { BufferGeometry, DataTexture, Float32BufferAttribute, FloatType, PlaneGeometry, RedFormat, Vector4 } from "three";

const FAR = 2000;  // metres to the ends of what is drawn
const MOST = 512;  // heights along a side that are drawn

/** From the first to the last, as many as there are, or fewer. */
function places(middle, size, count) {
    const drawn = Math.min(count, MOST);
    return Array.from({ length: drawn }, (_, n) => middle + size * (n / (drawn - 1) - 0.5));
}

/** { geometry, uniforms }. metres: of the scene for a unit of the clip; floor: of the clip, where the scene has its height 0. */
export function makeGround(stage, metres, floor) {
    const hasHills = stage.ground?.columns > 0, { middle, size, columns, rows } = stage.ground ?? {};
    const xs = hasHills ? places(middle[0], size[0], columns) : [], zs = hasHills ? places(middle[2], size[2], rows) : [];
    const heightAt = (x, z) => metres * (stage.groundHeight(x, z) - floor);
    const heights = Float32Array.from(zs.flatMap((z) => xs.map((x) => heightAt(x, z))));
    const uniforms = { uHeights: { value: heightTexture(xs.length, zs.length, heights) }, uHills: { value: hasHills }, uGrid: { value: gridOf(xs, zs, metres) } };
    if (!hasHills) {
        const geometry = new PlaneGeometry(2 * FAR, 2 * FAR).rotateX(-Math.PI / 2);
        return { geometry: geometry.translate(0, stage.ground ? heightAt(0, 0) : 0, 0), uniforms };
    }
    const far = FAR / metres, along = (line) => [Math.min(-far, line[0] - far), ...line, Math.max(far, line.at(-1) + far)];
    const [wide, deep] = [along(xs), along(zs)], positions = [], indices = [];
    for (const z of deep) for (const x of wide) positions.push(metres * x, heightAt(x, z), metres * z);
    for (let row = 1; row < deep.length; ++row)
        for (let column = 1; column < wide.length; ++column) {
            const at = row * wide.length + column, before = at - wide.length;
            indices.push(before - 1, at - 1, before, before, at - 1, at);
        }
    const geometry = new BufferGeometry();
    geometry.setIndex(indices);
    geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
    geometry.computeVertexNormals();
    return { geometry, uniforms };
}

function heightTexture(width, height, heights) {
    const texture = width > 0 ? new DataTexture(heights, width, height, RedFormat, FloatType) : new DataTexture(new Float32Array(1), 1, 1, RedFormat, FloatType);
    texture.internalFormat = "R32F";
    texture.needsUpdate = true;
    return texture;
}
/** Where the first height is, and how far the next ones are, in metres. */
function gridOf(xs, zs, metres) {
    return xs.length > 0 ? new Vector4(xs[0], zs[0], xs[1] - xs[0], zs[1] - zs[0]).multiplyScalar(metres) : new Vector4(0, 0, 1, 1);
}
