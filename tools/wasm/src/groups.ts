// SPDX-License-Identifier: MIT
//
// The groups of a crowd as they are given, and the library's crowd that is made of them.
import { Numbers, numbers, options, real, refuse, shown, whole } from "./arguments.js";
import { Binding, LimbJoints, putJoints, putSkeleton, Skeleton } from "./binding.js";
import { defaultFit, defaultGround, defaultLook, defaultPlant, defaultProp, Feature, layout, MAX_LOOK_JOINTS, MAX_TWIST_BONES, OnBadInput } from "./layout.js";
import { Memory, Structure } from "./memory.js";
import { Region } from "./region.js";

/** What groups of free limbs and of bodies have. */
interface LimbOptions {
    /** Left out: those that are given for all groups. */
    features?: bigint;
    /** Orders of the Euler angles of SHOULDER_BOX and WRIST_BOX, from Order. Left out: XYZ. */
    shoulderOrder?: number;
    wristOrder?: number;
    /** Where the upper arms may point. It brings Feature.WITH_REGION. */
    region?: Region;
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
/**
 * How the limbs of a group with Feature.WITH_PLANT stand, as swivel_plant: lengths in limb lengths, times in seconds. What is left out is
 * as defaultPlant has it.
 */
export interface Plant {
    /** A point locks only within this of where it is animated. */
    lockRadius?: number;
    /** A locked point is released if the animation has it further away. */
    unlockRadius?: number;
    /** A point that locks is at rest after this time. */
    stopTime?: number;
    /** A point that is released is with the animation again after this time. */
    releaseTime?: number;
    /** Lengths a second: after a release by distance a slower point locks anew. 0: none does. */
    relockSpeed?: number;
    /** 0: it is anchored where it locks. 1: where it would come to rest by itself. 0.5 slides least. */
    anchorLead?: number;
    /** A body that was not solved for longer than this starts anew. 0: none does. */
    resetTime?: number;
    /** With Feature.PLANT_BY_MOTION: lengths a second below which a contact begins, and goes on. */
    speed?: Numbers;
    /** The same of the height over the root, along `up`. */
    height?: Numbers;
}
/** How bodies are shifted along `up`, as swivel_fit. What is left out is as defaultFit has it. */
export interface Fit {
    /** The most down and up, in lengths of the first limb with Feature.WITH_PELVIS_FIT: see Plant. */
    drop?: number;
    rise?: number;
    /** Seconds in which about half of a distance is made up. */
    halfLife?: number;
    /** Seconds from when on Field.NEXT_TARGET counts. At 0 seconds it counts whole. */
    lookahead?: number;
}
/**
 * How feet of a group with Feature.WITH_GROUND stand on ground as it lies, as swivel_ground. Their effectors are the toes. What is left out is
 * as defaultGround has it.
 */
export interface Ground {
    /** A point of the sole in the wrist joint's frame, in the bones' unit. Zeros: the wrist itself. */
    heel?: Numbers;
    /** Heights over the ground where effector and heel stand, in the bones' unit. */
    toeClearance?: number;
    heelClearance?: number;
    /** The cosine of the angle that the foot turns at most, 0 to 1. */
    cosMax?: number;
    /** Seconds in which about half of a lift is made up. */
    halfLife?: number;
}
/** How a thing lies that hands hold, as swivel_prop. What is left out is as defaultProp has it. */
export interface Prop {
    /** Of the skeleton, which no limb turns. -1: none. */
    joint?: number;
    /** The most that it moves, in lengths of the first limb that is linked to it. 0: it stays, as a ladder does. */
    maxMove?: number;
}
/** How a chain of joints looks, as swivel_look. What is left out is as defaultLook has it. */
export interface Look {
    /** 1 to 8 of the skeleton, each below the one before, such as spine, neck and head. */
    joints: readonly number[];
    /** Of what is left of the turn, against those after it: of each joint, or one for all. */
    share?: number | Numbers;
    /** The cosine of the angle that each turns at most, -1 to 1: of each joint, or one for all. */
    cosMax?: number | Numbers;
    /** Where the line of sight starts, and where it points: in the last joint's frame. */
    eye?: Numbers;
    axis?: Numbers;
    /** The look fades as the target goes behind, between these cosines of its angle. At cosNone the pose stays. */
    cosFull?: number;
    cosNone?: number;
    /** It also fades nearer than this, in the last joint's unit. */
    fadeDistance?: number;
    /** Radians a second that the line turns at most. 0: it is not eased. */
    rate?: number;
}
/** The limb of each body that has these joints. */
export interface BodyGroup extends LimbOptions {
    /** Its features get the number of twistBones, unless they have one. */
    joints: LimbJoints;
    /** As GroupOptions'. Left out: it keeps its incoming pose. */
    onBadInput?: number;
    /** With Feature.WITH_PLANT. */
    plant?: Plant;
    /** With Feature.WITH_GROUND. */
    ground?: Ground;
    /** With Feature.WITH_LINK: the number of the group that it holds, a prop or an earlier limb. Left out: 0. */
    link?: number;
}
/** The shift of each body, so that its limbs with Feature.WITH_PELVIS_FIT reach. It has Feature.FIT and no other, and no joints. */
export interface FitGroup {
    fit: Fit;
    /** As BodyGroup's. */
    onBadInput?: number;
}

/** A thing that one hand or two of each body hold: limbs with Feature.WITH_LINK. It has Feature.PROP and no other, and is no limb. */
export interface PropGroup {
    prop: Prop;
    /** As BodyGroup's. */
    onBadInput?: number;
}

/** A chain of joints of each body that looks at Field.LOOK_TARGET. It has Feature.LOOK and no other, and is no limb. */
export interface LookGroup {
    look: Look;
    /** As BodyGroup's. */
    onBadInput?: number;
}

/** The skeleton of all bodies of a crowd, and how many these are. */
export interface SharedSkeleton {
    skeleton: Skeleton;
    bodyCount: number;
    /** The axis of heights and shifts in the root's frame, of any length but 0. Left out: +y. */
    up?: Numbers;
}

/** A group, checked. */
export interface CheckedGroup extends GroupOptions {
    features: bigint;
    joints?: LimbJoints;
    plant?: Plant;
    fit?: Fit;
    ground?: Ground;
    prop?: Prop;
    link?: number;
    look?: Look;
}

function checkedFeatures(features: bigint): bigint {
    if (typeof features === "bigint" && features >= 0n && features >> 64n === 0n) return features;
    return refuse(`features is ${shown(features)}; give a BigInt, such as Feature.WORLD`);
}
function checkedList<Each>(groups: readonly Each[], features: bigint, such: string, check: (group: Each) => GroupOptions): CheckedGroup[] {
    checkedFeatures(features);
    if (!Array.isArray(groups)) refuse(`groups is ${shown(groups)}; give a list, such as ${such}`);
    return groups.map(check).map((group) => {
        const own = group.features === undefined ? features : checkedFeatures(group.features);
        if (group.region === undefined) return { ...group, features: own };
        if (!(group.region instanceof Region)) refuse(`region is ${shown(group.region)}; give what region() made`);
        return { ...group, features: own | Feature.WITH_REGION };
    });
}

/** features: of groups that give none. */
export function freeGroups(groups: readonly Group[], features: bigint): CheckedGroup[] {
    return checkedList(groups, features, "[1000]", (group) => {
        const given = typeof group === "number" ? { limbCount: group } :
            options("a group", group, "limbCount", "features", "binding", "shoulderOrder", "wristOrder", "onBadInput", "region");
        return { ...given, limbCount: whole("limbCount", given.limbCount) };
    });
}
/** Who names twist bones wants them to turn. Too many are for the library to refuse. */
function withTwistBones(group: CheckedGroup): CheckedGroup {
    const max = BigInt(MAX_TWIST_BONES), count = BigInt(group.joints?.twistBones?.length ?? 0);
    if (group.features & (max * Feature.WITH_TWIST_BONES)) return group;
    return { ...group, features: group.features | (count < max ? count : max) * Feature.WITH_TWIST_BONES };
}
/** A group of bodies: a limb of each, their shift, a thing that they hold, or a chain that looks. */
export type BodiesGroup = BodyGroup | FitGroup | PropGroup | LookGroup;
/** Groups that are no limbs: by the member that names them. */
const limbless = [["fit", Feature.FIT, "a group of shifts"], ["prop", Feature.PROP, "a prop's group"], ["look", Feature.LOOK, "a group that looks"]] as const;
const NO_LIMB = Feature.FIT | Feature.PROP | Feature.LOOK;
function bodyGroup(group: BodiesGroup): Omit<BodyGroup, "joints"> & { features?: bigint } {
    for (const [member, features, name] of limbless)
        if (typeof group === "object" && group !== null && member in group) return { ...options(name, group, member as never, "onBadInput"), features };
    return options("a group of bodies", group as BodyGroup, "joints", "features", "shoulderOrder", "wristOrder", "onBadInput", "plant", "ground", "link", "region");
}
export function bodyGroups(groups: readonly BodiesGroup[], features: bigint, bodyCount: number): CheckedGroup[] {
    const limbCount = whole("bodyCount", bodyCount);
    return checkedList(groups, features, "[{ joints: { shoulder: 1, elbow: 2, wrist: 3 } }]", (group) => {
        const given = bodyGroup(group);
        return { ...given, onBadInput: given.onBadInput ?? OnBadInput.KEEP_POSE, limbCount };
    }).map(withTwistBones);
}
/** The numbers of a structure of constants. */
function constants(of: string, given: Plant | Fit | Ground | Prop, start: Record<string, number | Numbers>): number[] {
    const all = { ...start, ...options(of, given as typeof start, ...Object.keys(start)) };
    return Object.entries(start).flatMap(([name, usual]) => {
        const value = all[name], member = `${of}.${name}`;
        return typeof usual === "number" ? real(member, value as number) : Array.from(numbers(member, value as Numbers, usual.length));
    });
}

/** A swivel_prop's bytes: a joint, and a float. */
function propBytes(given: Prop): Uint8Array {
    const [joint, maxMove] = constants("prop", given, defaultProp), bytes = new DataView(new ArrayBuffer(8));
    if (!Number.isInteger(joint) || Math.abs(joint) > 0x7fffffff) refuse(`prop.joint is ${shown(joint)}; give the number of a joint, or -1`);
    bytes.setInt32(0, joint, true), bytes.setFloat32(4, maxMove, true);
    return new Uint8Array(bytes.buffer);
}

/** A swivel_look's bytes: a count, the joints, and floats: shares, cones, eye, axis, and four numbers. */
function lookBytes(given: Look): Uint8Array {
    const look = { ...defaultLook, ...options("look", given as Look & Record<string, unknown>, "joints", ...Object.keys(defaultLook) as (keyof typeof defaultLook)[]) };
    if (!Array.isArray(look.joints)) refuse(`look.joints is ${shown(look.joints)}; give numbers of joints`);
    const joints = look.joints.slice(0, MAX_LOOK_JOINTS), bytes = new DataView(new ArrayBuffer(layout.swivel_look.bytes));
    const each = (name: string, value: number | Numbers) =>
        typeof value === "object" ? Array.from(numbers(name, value, joints.length)) : Array(joints.length).fill(real(name, value));
    const put = (at: number, values: ArrayLike<number>) => Array.from(values).forEach((x, n) => bytes.setFloat32(at + 4 * n, x, true));
    bytes.setUint32(0, look.joints.length, true);
    joints.forEach((joint, n) => bytes.setUint32(layout.swivel_look.joints + 4 * n, whole("look.joints", joint), true));
    put(layout.swivel_look.share, each("look.share", look.share)), put(layout.swivel_look.cos_max, each("look.cosMax", look.cosMax));
    put(layout.swivel_look.eye, numbers("look.eye", look.eye, 3)), put(layout.swivel_look.axis, numbers("look.axis", look.axis, 3));
    const { cosFull, cosNone, fadeDistance, rate } = look;
    put(layout.swivel_look.cos_full, Object.entries({ cosFull, cosNone, fadeDistance, rate }).map(([name, value]) => real(`look.${name}`, value)));
    return new Uint8Array(bytes.buffer);
}

/** Makes the library's crowd. Without a skeleton its limbs are free. */
export function create(memory: Memory, groups: readonly CheckedGroup[], bodies?: SharedSkeleton): number {
    return memory.borrow((borrowed) => {
        const size = layout.swivel_group_def.bytes, list = borrowed.bytes(size * groups.length), crowd = borrowed.bytes(4);
        groups.forEach((group, n) => {
            const { limbCount, features, binding, joints, shoulderOrder = 0, wristOrder = 0, onBadInput = 0 } = group;
            const { plant = {}, fit = {}, ground = {}, prop = {}, link = 0, look, region } = group;
            const def = new Structure(memory, "swivel_group_def", list + n * size).wide("features", features);
            def.words("limb_count", limbCount).words("on_bad_input", whole("onBadInput", onBadInput));
            def.words("shoulder_order", whole("shoulderOrder", shoulderOrder)).words("wrist_order", whole("wristOrder", wristOrder));
            if (binding) def.copy("binding", binding.bytes);
            def.floats("plant", constants("plant", plant, defaultPlant)).floats("fit", constants("fit", fit, defaultFit));
            def.floats("ground", constants("ground", ground, defaultGround)).copy("prop", propBytes(prop)).words("link", whole("link", link));
            if (look) def.copy("look", lookBytes(look));
            if (region) def.words("region", region.put(borrowed));
            if (bodies && !(features & NO_LIMB)) def.words("joints", putJoints(joints as LimbJoints, borrowed).at);
        });
        const def = borrowed.structure("swivel_crowd_def").words("group_count", groups.length).words("workspace_count", 1).words("groups", list);
        if (bodies) {
            def.words("skeleton", putSkeleton(bodies.skeleton, borrowed).at).words("body_count", bodies.bodyCount);
            def.floats("up", numbers("up", bodies.up ?? [0, 1, 0], 3));
        }
        memory.check(memory.calls.swivel_crowd_create(def.at, crowd));
        return memory.words(crowd, 1)[0];
    });
}
