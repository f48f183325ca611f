// SPDX-License-Identifier: MIT
import { layout } from "./layout.js";
import { Borrowed, Memory, Numbers, refuse, whole } from "./memory.js";

/** A shoulder, elbow and wrist joint at rest, as swivel_chain: rotations x, y, z, w are the identity if left out. */
export interface Chain {
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

/** Which joints of a skeleton are a limb. */
export interface LimbJoints {
    shoulder: number;
    elbow: number;
    wrist: number;
    twistBones?: Numbers;
    bend?: Numbers;
}

/** Maps the arm frame to a skeleton's joints: a swivel_binding. Made by Swivel.bind() or Swivel.bindJoints(). */
export class Binding {
    /** @internal */
    constructor(readonly bytes: Uint8Array) {}
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
        return new Binding(memory.bytes(binding.at, layout.swivel_binding.bytes).slice());
    });
}

/** @internal */
export function bind(memory: Memory, chain: Chain): Binding {
    return make(memory, (borrowed, binding) => {
        const none = [0, 0, 0, 1];
        const at = borrowed.structure("swivel_chain");
        at.floats("shoulder_rotation", chain.shoulderRotation ?? none, 4).floats("elbow_rotation", chain.elbowRotation ?? none, 4);
        at.floats("wrist_rotation", chain.wristRotation ?? none, 4).floats("bend", chain.bend ?? [0, 0, 0], 3);
        at.floats("elbow_offset", chain.elbowOffset, 3).floats("wrist_offset", chain.wristOffset, 3);
        return memory.calls.swivel_bind(at.at, binding);
    });
}

/** @internal */
export function bindJoints(memory: Memory, skeleton: Skeleton, joints: LimbJoints): Binding {
    const count = skeleton.parents.length;
    if (skeleton.translations.length !== 3 * count) refuse(`${skeleton.translations.length} numbers of translations for ${count} joints; give 3 for each`);
    if (skeleton.rotations && skeleton.rotations.length !== 4 * count)
        refuse(`${skeleton.rotations.length} numbers of rotations for ${count} joints; give 4 for each`);
    return make(memory, (borrowed, binding) => {
        const of = borrowed.structure("swivel_skeleton").words("joint_count", count);
        of.words("parents", borrowed.words(Int32Array.from(skeleton.parents)), 4);
        of.words("translations", borrowed.floats(skeleton.translations), 12);
        if (skeleton.rotations) of.words("rotations", borrowed.floats(skeleton.rotations), 16);
        const at = borrowed.structure("swivel_limb_joints").floats("bend", joints.bend ?? [0, 0, 0], 3);
        for (const name of ["shoulder", "elbow", "wrist"] as const) at.words(name, whole(name, joints[name]));
        const bones = joints.twistBones ?? [];
        at.words("twist_bone_count", bones.length).words("twist_bones", bones.length > 0 ? borrowed.words(bones) : 0);
        return memory.calls.swivel_bind_joints(of.at, at.at, binding);
    });
}
