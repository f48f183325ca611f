// SPDX-License-Identifier: MIT
//
// The page's binary data: base64 of C structures, as tools/crowd/goals.h lays them out, and numbers of that header.
import { goals } from "../../headers/headers.json";

export const { GOAL_JOINTS } = goals.constants;

const { structures } = goals, arrays = { double: Float64Array, float: Float32Array, uint32_t: Uint32Array };

/** Bytes of a structure. */
export const sizeOf = (structure) => structures[structure].wasm32;

/** The numbers of a member, where they are: the structure begins at a place of a buffer. */
export function memberOf(buffer, at, structure, member) {
    const { type, count, wasm32: offset } = structures[structure].members[member];
    return new arrays[type](buffer, at + offset, count);
}

/** Structures side by side, as objects of their members. */
export function objectsOf(bytes, structure) {
    const size = sizeOf(structure), names = Object.keys(structures[structure].members);
    return Array.from({ length: bytes.length / size }, (_, n) => Object.fromEntries(names.map((name) => {
        const values = Array.from(memberOf(bytes.buffer, n * size, structure, name));
        return [name, values.length === 1 ? values[0] : values];
    })));
}

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

/** The constants of a structure in base64, which are floats side by side, by the names of their defaults. */
export function constantsOf(base64, defaults) {
    const floats = floatsOf(base64);
    let at = 0;
    const next = (usual) => (typeof usual === "number" ? floats[at++] : floats.slice(at, at += usual.length));
    return Object.fromEntries(Object.entries(defaults).map(([name, usual]) => [name, next(usual)]));
}

/** Of a limb's goal_source in each frame: its hand's rotation, its bones' lengths, its shoulder, and the figure's root, all in the world. */
export class Sources {
    constructor(bytes) { this.bytes = bytes; }
    member(frame, name) { return Array.from(memberOf(this.bytes.buffer, frame * sizeOf("goal_source"), "goal_source", name)); }
    hand(frame) { return this.member(frame, "hand"); }
    lengths(frame) { return this.member(frame, "lengths"); }
    origin(frame) { return this.member(frame, "origin"); }
    root(frame) { return this.member(frame, "root"); }
    /** Shoulder, elbow and wrist in the world; rotations of the joint above in the world, then of these three, each against the one before. */
    joints(frame) {
        const origin = this.origin(frame), below = ["elbow", "wrist"].map((name) => this.member(frame, name).map((from, axis) => from + origin[axis]));
        return { places: [origin, ...below], turns: ["parent", "shoulder", "elbow_local", "wrist_local"].map((name) => this.member(frame, name)) };
    }
}

/** Goals of one's own by frame: lists of goal_given. */
export function givenOf(base64) {
    const frames = new Map();
    for (const given of objectsOf(bytesOf(base64), "goal_given")) frames.set(given.frame, frames.get(given.frame) ?? []).get(given.frame).push(given);
    return frames;
}
