// SPDX-License-Identifier: MIT
//
// The page's binary data: base64 of C structures, as tools/crowd/goals.h and include/swivel/swivel.h lay them out.

/** Bytes of each structure. */
export const SIZE = { character: 56, source: 256, plan: 216, ground: 56, root: 32, input: 272, given: 80 };

/** Where members of a goal_plan begin, the goals of a goal_input, the shift of a goal_root, and the wish of a goal_character. */
export const PLAN = { targetOffset: 24, weights: 168, hasFixedPole: 184, holds: 208 };
export const INPUT = { target: 0, pole: 24, hand: 48, weights: 64 };
export const ROOT_SHIFT = 28, WISH = 36;
const TURNS = 168;  // the rotations of a goal_source

/** How many bytes a text stands for. */
export const byteCountOf = (base64) => base64.length / 4 * 3 - (base64.endsWith("==") ? 2 : base64.endsWith("=") ? 1 : 0);

export function bytesOf(base64) {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
    return bytes;
}

export function floatsOf(base64) {
    return new Float32Array(bytesOf(base64).buffer);
}

/** The characters as objects of their structure. */
export function charactersOf(bytes) {
    const view = new DataView(bytes.buffer);
    return Array.from({ length: bytes.length / SIZE.character }, (_, n) => {
        const at = n * SIZE.character, double = (place) => view.getFloat64(at + 8 * place, true);
        return { size: double(0), place: [double(1), double(2), double(3)], start: view.getUint32(at + 32, true), wish: view.getFloat32(at + WISH, true),
            first: view.getUint32(at + 40, true), count: view.getUint32(at + 44, true), carries: view.getUint32(at + 48, true) === 1 };
    });
}

/** A goal_ground: how large it is, where its middle is, and how many heights it has that way. */
export function gridOf(bytes) {
    const doubles = new Float64Array(bytes.buffer, 0, 6), [columns, rows] = new Uint32Array(bytes.buffer, 48, 2);
    return { size: Array.from(doubles.subarray(0, 3)), middle: Array.from(doubles.subarray(3)), columns, rows };
}

/** Of a limb's goal_source in each frame: its hand's rotation, its bones' lengths, its shoulder, and the figure's root, all in the world. */
export class Sources {
    constructor(bytes) { this.view = new DataView(bytes.buffer); }
    get frameCount() { return this.view.byteLength / SIZE.source; }
    doubles(frame, first, count) {
        return Array.from({ length: count }, (_, n) => this.view.getFloat64(frame * SIZE.source + 8 * (first + n), true));
    }
    hand(frame) { return this.doubles(frame, 6, 4); }
    lengths(frame) { return this.doubles(frame, 10, 2); }
    origin(frame) { return this.doubles(frame, 12, 3); }
    /** Shoulder, elbow and wrist in the world; rotations of the joint above in the world, then of these three, each against the one before. */
    joints(frame) {
        const origin = this.origin(frame), [elbow, wrist] = [0, 3].map((first) => this.doubles(frame, first, 3).map((from, axis) => from + origin[axis]));
        const turn = (n) => Array.from({ length: 4 }, (_, k) => this.view.getFloat32(frame * SIZE.source + TURNS + 16 * n + 4 * k, true));
        return { places: [origin, elbow, wrist], turns: [0, 1, 2, 3].map(turn) };
    }
    root(frame) { return this.doubles(frame, 15, 3); }
}

/** Goals of one's own by frame: lists of { character, limb, poleWeight, target, pole, hand }. */
export function givenOf(base64) {
    const { buffer, length } = bytesOf(base64), frames = new Map();
    for (let at = 0; at < length; at += SIZE.given) {
        const [frame, character, limb] = new Uint32Array(buffer, at, 3), [poleWeight] = new Float32Array(buffer, at + 12, 1);
        const [target, pole] = [16, 40].map((first) => new Float64Array(buffer, at + first, 3)), hand = new Float32Array(buffer, at + 64, 4);
        if (!frames.has(frame)) frames.set(frame, []);
        frames.get(frame).push({ character, limb, poleWeight, target, pole, hand });
    }
    return frames;
}
