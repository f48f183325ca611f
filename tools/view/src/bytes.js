// SPDX-License-Identifier: MIT
//
// The page's binary data: base64 of C structures, as tools/crowd/goals.h and include/swivel/swivel.h lay them out.

/** Bytes of each structure. */
export const SIZE = { character: 40, source: 184, input: 124, plan: 120, given: 56 };

/** Where the floats of a goal_input begin, counted in floats. */
export const INPUT = { target: 0, pole: 3, lengths: 6, position: 8, rotation: 11, hand: 15, shoulder: 19, elbow: 23, wrist: 27, count: 31 };

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
        return { size: double(0), place: [double(1), double(2), double(3)], start: view.getUint32(at + 32, true) };
    });
}

/** What is drawn of a limb's goal_source in each frame: its shoulder in the world, and its hand's rotation as solved. */
export class Sources {
    constructor(bytes) { this.view = new DataView(bytes.buffer); }
    get frameCount() { return this.view.byteLength / SIZE.source; }
    doubles(frame, first, count) {
        return Array.from({ length: count }, (_, n) => this.view.getFloat64(frame * SIZE.source + 8 * (first + n), true));
    }
    hand(frame) { return this.doubles(frame, 6, 4); }
    origin(frame) { return this.doubles(frame, 12, 3); }
}

/** Goals of one's own by frame: lists of { character, limb, target, pole, hand }. */
export function givenOf(base64) {
    const bytes = bytesOf(base64), words = new Uint32Array(bytes.buffer), floats = new Float32Array(bytes.buffer), frames = new Map();
    for (let at = 0; at < words.length; at += SIZE.given / 4) {
        const [frame, character, limb] = words.subarray(at, at + 3), part = (first, end) => floats.subarray(at + first, at + end);
        if (!frames.has(frame)) frames.set(frame, []);
        frames.get(frame).push({ character, limb, target: part(4, 7), pole: part(7, 10), hand: part(10, 14) });
    }
    return frames;
}
