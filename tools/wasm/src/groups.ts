// SPDX-License-Identifier: MIT
//
// The groups of a crowd as they are given, and the library's crowd that is made of them.
import { options, refuse, shown, whole } from "./arguments.js";
import { Binding, LimbJoints, putJoints, putSkeleton, Skeleton } from "./binding.js";
import { Feature, layout, MOST_TWIST_BONES, OnBadInput } from "./layout.js";
import { Memory, Structure } from "./memory.js";

/** What groups of free limbs and of bodies have. */
interface LimbOptions {
    /** Left out: those that are given for all groups. */
    features?: bigint;
    /** Orders of the Euler angles of SHOULDER_BOX and WRIST_BOX, from Order. Left out: XYZ. */
    shoulderOrder?: number;
    wristOrder?: number;
}
/** Limbs that share features and a binding, as swivel_group_def. */
export interface GroupOptions extends LimbOptions {
    limbCount: number;
    /** With Feature.JOINTS. */
    binding?: Binding;
    /** What a limb with bad input gets, from OnBadInput. Left out: its rest pose. */
    onBadInput?: number;
}
/** A number alone: that many limbs. */
export type Group = number | GroupOptions;
/** The limb of each body that has these joints. */
export interface BodyGroup extends LimbOptions {
    /** Its features get the number of twistBones, unless they have one. */
    joints: LimbJoints;
    /** As GroupOptions'. Left out: it keeps its incoming pose. */
    onBadInput?: number;
}

/** The skeleton of all bodies of a crowd, and how many these are. */
export interface SharedSkeleton {
    skeleton: Skeleton;
    bodyCount: number;
}

/** A group, checked. */
export interface CheckedGroup extends GroupOptions {
    features: bigint;
    joints?: LimbJoints;
}

function checkedFeatures(features: bigint): bigint {
    if (typeof features === "bigint" && features >= 0n && features >> 64n === 0n) return features;
    return refuse(`features is ${shown(features)}; give a BigInt, such as Feature.WORLD`);
}
function checkedList<Each>(groups: readonly Each[], features: bigint, such: string, check: (group: Each) => GroupOptions): CheckedGroup[] {
    checkedFeatures(features);
    if (!Array.isArray(groups)) refuse(`groups is ${shown(groups)}; give a list, such as ${such}`);
    return groups.map(check).map((group) => ({ ...group, features: group.features === undefined ? features : checkedFeatures(group.features) }));
}

/** features: of groups that give none. */
export function freeGroups(groups: readonly Group[], features: bigint): CheckedGroup[] {
    return checkedList(groups, features, "[1000]", (group) => {
        const given = typeof group === "number" ? { limbCount: group } :
            options("a group", group, "limbCount", "features", "binding", "shoulderOrder", "wristOrder", "onBadInput");
        return { ...given, limbCount: whole("limbCount", given.limbCount) };
    });
}
/** Who names twist bones wants them to turn. Too many are for the library to refuse. */
function withTwistBones(group: CheckedGroup): CheckedGroup {
    const most = BigInt(MOST_TWIST_BONES), count = BigInt(group.joints?.twistBones?.length ?? 0);
    if (group.features & (most * Feature.WITH_TWIST_BONES)) return group;
    return { ...group, features: group.features | (count < most ? count : most) * Feature.WITH_TWIST_BONES };
}
export function bodyGroups(groups: readonly BodyGroup[], features: bigint, bodyCount: number): CheckedGroup[] {
    const limbCount = whole("bodyCount", bodyCount);
    return checkedList(groups, features, "[{ joints: { shoulder: 1, elbow: 2, wrist: 3 } }]", (group) => {
        const given = options("a group of bodies", group, "joints", "features", "shoulderOrder", "wristOrder", "onBadInput");
        return { ...given, onBadInput: given.onBadInput ?? OnBadInput.KEEP_POSE, limbCount };
    }).map(withTwistBones);
}

/** Makes the library's crowd. Without a skeleton its limbs are free. */
export function create(memory: Memory, groups: readonly CheckedGroup[], bodies?: SharedSkeleton): number {
    return memory.borrow((borrowed) => {
        const size = layout.swivel_group_def.bytes, list = borrowed.bytes(size * groups.length), crowd = borrowed.bytes(4);
        groups.forEach(({ limbCount, features, binding, joints, shoulderOrder = 0, wristOrder = 0, onBadInput = 0 }, n) => {
            const def = new Structure(memory, "swivel_group_def", list + n * size).wide("features", features);
            def.words("limb_count", limbCount).words("on_bad_input", whole("onBadInput", onBadInput));
            def.words("shoulder_order", whole("shoulderOrder", shoulderOrder)).words("wrist_order", whole("wristOrder", wristOrder));
            if (binding) def.copy("binding", binding.bytes);
            if (bodies) def.words("joints", putJoints(joints as LimbJoints, borrowed).at);
        });
        const def = borrowed.structure("swivel_crowd_def").words("group_count", groups.length).words("workspace_count", 1).words("groups", list);
        if (bodies) def.words("skeleton", putSkeleton(bodies.skeleton, borrowed).at).words("body_count", bodies.bodyCount);
        memory.check(memory.calls.swivel_crowd_create(def.at, crowd));
        return memory.words(crowd, 1)[0];
    });
}
