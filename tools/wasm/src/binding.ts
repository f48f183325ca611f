// SPDX-License-Identifier: MIT
import { Numbers, numbers, options, whole } from "./arguments.js";
import { layout } from "./layout.js";
import type { Borrowed, Memory, Structure } from "./memory.js";

/**
 * A skeleton at rest, joint after joint: parents (-1 for a root), translations (3, in the parent's frame), rotations (4, x, y, z, w, relative to
 * the parent; left out: no joint is turned).
 */
export interface Skeleton {
    parents: Numbers;
    translations: Numbers;
    rotations?: Numbers;
}

/** Which joints of a skeleton are a limb, by index. twistBones: from elbow to wrist, those that share the hand's twist. */
export interface LimbJoints {
    shoulder: number;
    elbow: number;
    wrist: number;
    twistBones?: Numbers;
    /** Where flexion carries the forearm, in the shoulder joint's frame. Left out: the rest pose shows it. */
    bend?: Numbers;
}

/** Where a binding's numbers begin, behind its size. Their bytes are the same on every platform. */
const BEGIN = layout.swivel_binding.parent_from_arm;

/** Maps the arm frame to a skeleton's joints: a swivel_binding. Swivel.bindJoints() makes it. */
export class Binding {
    readonly bytes = new Uint8Array(layout.swivel_binding.bytes);
    /** @internal */
    constructor(numbers: Uint8Array) {
        new Uint32Array(this.bytes.buffer)[0] = this.bytes.length;
        this.bytes.set(numbers, BEGIN);
    }
    /** Upper arm and forearm. */
    get lengths(): [number, number] {
        const [upper, fore] = new Float32Array(this.bytes.buffer, layout.swivel_binding.lengths, 2);
        return [upper, fore];
    }
}

const shownByPose = [0, 0, 0];

/** @internal */
export function putSkeleton(given: Skeleton, borrowed: Borrowed): Structure<"swivel_skeleton"> {
    const of = options("a skeleton", given, "parents", "translations", "rotations"), count = numbers("parents", of.parents).length;
    const rest = borrowed.structure("swivel_skeleton").words("joint_count", count);
    rest.words("parents", borrowed.words(Int32Array.from(of.parents)), 4);
    rest.words("translations", borrowed.floats(numbers("translations", of.translations, 3 * count)), 12);
    if (of.rotations) rest.words("rotations", borrowed.floats(numbers("rotations", of.rotations, 4 * count)), 16);
    return rest;
}

/** @internal */
export function putJoints(given: LimbJoints, borrowed: Borrowed): Structure<"swivel_limb_joints"> {
    const limb = options("a limb's joints", given, "shoulder", "elbow", "wrist", "twistBones", "bend");
    const chosen = borrowed.structure("swivel_limb_joints").floats("bend", numbers("bend", limb.bend ?? shownByPose, 3));
    for (const name of ["shoulder", "elbow", "wrist"] as const) chosen.words(name, whole(name, limb[name]));
    const bones = numbers("twistBones", limb.twistBones ?? []);
    return chosen.words("twist_bone_count", bones.length).words("twist_bones", bones.length > 0 ? borrowed.words(bones) : 0);
}

/** @internal */
export function bindJoints(memory: Memory, skeleton: Skeleton, joints: LimbJoints): Binding {
    return memory.borrow((borrowed) => {
        const binding = borrowed.structure("swivel_binding");
        memory.check(memory.calls.swivel_bind_joints(putSkeleton(skeleton, borrowed).at, putJoints(joints, borrowed).at, binding.at));
        return new Binding(memory.bytes(binding.at + BEGIN, layout.swivel_binding.bytes - BEGIN));
    });
}
