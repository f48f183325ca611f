// SPDX-License-Identifier: MIT
import { Numbers, numbers, options, whole } from "./arguments.js";
import { layout } from "./layout.js";
import type { Borrowed, Memory, Structure } from "./memory.js";

/** A shoulder, elbow and wrist joint at rest, as swivel_chain: rotations x, y, z, w are the identity if left out. */
export interface Chain {
    /** Rest rotations, each relative to the joint above: the shoulder's to its parent, the elbow's to the shoulder. */
    shoulderRotation?: Numbers;
    elbowRotation?: Numbers;
    wristRotation?: Numbers;
    /** The elbow's place in the shoulder joint's frame, and the wrist's in the elbow joint's. */
    elbowOffset: Numbers;
    wristOffset: Numbers;
    /** Where flexion carries the forearm, in the shoulder joint's frame. Left out: the rest pose shows it. */
    bend?: Numbers;
}

/** A skeleton at rest, joint after joint: parents (-1 for a root), translations (3), rotations (4; left out: none). */
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
    /** As Chain's. */
    bend?: Numbers;
}

/** Where a binding's numbers begin, behind its size. Their bytes are the same on every platform. */
const BEGIN = layout.swivel_binding.parent_from_arm;

/** Maps the arm frame to a skeleton's joints: a swivel_binding. Swivel.bind() and Swivel.bindJoints() make it. */
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

/** Makes a binding by a call that writes it. */
function make(memory: Memory, write: (borrowed: Borrowed, binding: number) => number): Binding {
    return memory.borrow((borrowed) => {
        const binding = borrowed.structure("swivel_binding");
        memory.check(write(borrowed, binding.at));
        return new Binding(memory.bytes(binding.at + BEGIN, layout.swivel_binding.bytes - BEGIN));
    });
}

const identity = [0, 0, 0, 1], shownByPose = [0, 0, 0];

/** @internal */
export function bind(memory: Memory, given: Chain): Binding {
    const of = options("bind()", given, "shoulderRotation", "elbowRotation", "wristRotation", "elbowOffset", "wristOffset", "bend");
    return make(memory, (borrowed, binding) => {
        const chain = borrowed.structure("swivel_chain");
        chain.floats("shoulder_rotation", numbers("shoulderRotation", of.shoulderRotation ?? identity, 4));
        chain.floats("elbow_rotation", numbers("elbowRotation", of.elbowRotation ?? identity, 4));
        chain.floats("wrist_rotation", numbers("wristRotation", of.wristRotation ?? identity, 4));
        chain.floats("elbow_offset", numbers("elbowOffset", of.elbowOffset, 3));
        chain.floats("wrist_offset", numbers("wristOffset", of.wristOffset, 3));
        chain.floats("bend", numbers("bend", of.bend ?? shownByPose, 3));
        return memory.calls.swivel_bind(chain.at, binding);
    });
}

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
    return make(memory, (borrowed, binding) =>
        memory.calls.swivel_bind_joints(putSkeleton(skeleton, borrowed).at, putJoints(joints, borrowed).at, binding));
}
