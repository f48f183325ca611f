// SPDX-License-Identifier: MIT
//
// The groups of a crowd as they are given, and the library's crowd that is made of them.
import { Numbers, numbers, options, real, refuse, shown, whole } from "./arguments.js";
import { Binding, LimbJoints, putJoints, putSkeleton, Skeleton } from "./binding.js";
import {
    defaultGround, defaultLook, defaultPlant, defaultProp, defaultShift, Feature, firstFloat, GroundConstants, Kind, layout, LookConstants, MAX_LOOK_JOINTS,
    ofEachJoint, OnBadInput, Order, PlantConstants, PropConstants, ShiftConstants,
} from "./layout.js";
import { Borrowed, Memory, Structure } from "./memory.js";
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
    /** With Feature.POLE_HALF_LINE: where no wrist goes, in the frame of the shoulder's parent. Left out: where elbows point at rest. */
    poleBehind?: Numbers;
}
/** Free limbs that share features and a binding, as swivel_limb_def. */
export interface GroupOptions extends LimbOptions {
    limbCount: number;
    /** With Feature.JOINTS. */
    binding?: Binding;
    /** What a limb with bad input gets, from OnBadInput. Left out: its rest pose. */
    onBadInput?: number;
    /** Bones that share the hand's twist, 0 to 7: more than 0 with Feature.WITH_HAND. Left out: 0. */
    twistBoneCount?: number;
}
/** A number alone: that many limbs. */
export type Group = number | GroupOptions;
/**
 * How the limbs of a group with Feature.WITH_PLANT stand, as swivel_plant. speed and height are for Feature.PLANT_BY_MOTION. What is left out is as
 * defaultPlant has it.
 */
export type Plant = PlantConstants;
/** How bodies are shifted along `up`, as swivel_shift_def. The next target is Field.NEXT_TARGET. What is left out is as defaultShift has it. */
export type Shift = ShiftConstants;
/**
 * How feet of a group with Feature.WITH_GROUND stand on ground as it lies, as swivel_ground. Their effectors are the toes. What is left out is
 * as defaultGround has it.
 */
export type Ground = GroundConstants;
/** How a thing lies that hands hold, as swivel_prop_def. What is left out is as defaultProp has it. */
export interface Prop extends PropConstants {
    /** Of the skeleton, which no limb turns. -1: none. */
    joint?: number;
}
/** How a chain of joints looks, as swivel_look_def. What is left out is as defaultLook has it. */
export interface Look extends LookConstants {
    /** 1 to 8 of the skeleton, each below the one before, such as spine, neck and head. */
    joints: readonly number[];
}
/**
 * The limb of each body that has these joints, as swivel_body_limb_def. It is in the world and has an incoming pose, so it takes no Feature.WORLD
 * and Feature.WITH_INCOMING, nor Feature.JOINTS. Its joints name its twist bones.
 */
export interface BodyGroup extends LimbOptions {
    joints: LimbJoints;
    /** As GroupOptions'. Left out: it keeps its incoming pose. */
    onBadInput?: number;
    /** With Feature.WITH_PLANT. */
    plant?: Plant;
    /** With Feature.WITH_GROUND. */
    ground?: Ground;
    /** With Feature.WITH_LINK: the number of the group that it holds, a prop or an earlier limb. */
    link?: number;
}
/** The shift of each body, so that its limbs with Feature.WITH_PELVIS_FIT reach. It has no features and no joints. */
export interface ShiftGroup {
    shift: Shift;
}

/** A thing that one hand or two of each body hold: limbs with Feature.WITH_LINK. It is no limb and has no features. */
export interface PropGroup {
    prop: Prop;
}

/** A chain of joints of each body that looks at Field.LOOK_TARGET. It is no limb and has no features. */
export interface LookGroup {
    look: Look;
}

/** A group of bodies: a limb of each, their shift, a thing that they hold, or a chain that looks. */
export type BodiesGroup = BodyGroup | ShiftGroup | PropGroup | LookGroup;

/** The skeleton of all bodies of a crowd, and how many these are. */
export interface SharedSkeleton {
    skeleton: Skeleton;
    bodyCount: number;
    /** The axis of heights and shifts in the root's frame, of any length but 0. Left out: +y. */
    up?: Numbers;
}

/** A group as its crowd knows it. */
export interface CheckedGroup {
    /** From Kind. */
    kind: number;
    limbCount: number;
    features: bigint;
    /** Puts its definition into memory. */
    put: (borrowed: Borrowed) => number;
}
/** Members of swivel_group_def that point to definitions, by Kind. */
const definitions = ["limb", "body_limb", "look", "prop", "shift"] as const;

function checkedFeatures(features: bigint): bigint {
    if (typeof features === "bigint" && features >= 0n && features >> 64n === 0n) return features;
    return refuse(`features is ${shown(features)}; give a BigInt, such as Feature.WORLD`);
}
/** The features of a group of limbs: its own, or those that are given for all groups, and that of its region. */
function featuresOf({ features: own, region }: LimbOptions, features: bigint): bigint {
    const asked = own === undefined ? features : checkedFeatures(own);
    if (region === undefined) return asked;
    if (!(region instanceof Region)) refuse(`region is ${shown(region)}; give what region() made`);
    return asked | Feature.WITH_REGION;
}
/** Puts what both kinds of limbs have into a definition. */
function putLimb(def: Structure<"swivel_limb_def"> | Structure<"swivel_body_limb_def">, given: LimbOptions, borrowed: Borrowed): void {
    const { region, poleBehind, shoulderOrder = Order.XYZ, wristOrder = Order.XYZ } = given;
    def.words("shoulder_order", whole("shoulderOrder", shoulderOrder)).words("wrist_order", whole("wristOrder", wristOrder));
    if (poleBehind !== undefined) def.floats("pole_behind", numbers("poleBehind", poleBehind, 3));
    if (region) def.words("region", region.put(borrowed));
}
function checkedList<Each>(groups: readonly Each[], features: bigint, such: string, check: (group: Each) => CheckedGroup): CheckedGroup[] {
    checkedFeatures(features);
    if (!Array.isArray(groups)) refuse(`groups is ${shown(groups)}; give a list, such as ${such}`);
    return groups.map(check);
}

/** features: of groups that give none. */
export function freeGroups(groups: readonly Group[], features: bigint): CheckedGroup[] {
    return checkedList(groups, features, "[1000]", (group) => {
        const given: GroupOptions = typeof group === "number" ? { limbCount: group } :
            options("a group", group, "limbCount", "features", "binding", "shoulderOrder", "wristOrder", "onBadInput", "region", "twistBoneCount",
                "poleBehind");
        const limbCount = whole("limbCount", given.limbCount), asked = featuresOf(given, features);
        const { binding, onBadInput = OnBadInput.REST_POSE, twistBoneCount = 0 } = given;
        return {
            kind: Kind.LIMB, limbCount, features: asked,
            put: (borrowed) => {
                const def = borrowed.structure("swivel_limb_def").wide("features", asked).words("limb_count", limbCount);
                def.words("on_bad_input", whole("onBadInput", onBadInput)).words("twist_bone_count", whole("twistBoneCount", twistBoneCount));
                if (binding) def.copy("binding", binding.bytes);
                putLimb(def, given, borrowed);
                return def.at;
            },
        };
    });
}

function bodyLimb(group: BodyGroup, features: bigint, limbCount: number): CheckedGroup {
    const given = options("a group of bodies", group, "joints", "features", "shoulderOrder", "wristOrder", "onBadInput", "plant", "ground", "link", "region",
        "poleBehind");
    const { joints, onBadInput = OnBadInput.KEEP_POSE, plant = {}, ground = {}, link = 0xffffffff } = given;
    const asked = featuresOf(given, features);
    return {
        kind: Kind.BODY_LIMB, limbCount, features: asked,
        put: (borrowed) => {
            const def = borrowed.structure("swivel_body_limb_def").wide("features", asked).words("joints", putJoints(joints, borrowed).at);
            def.words("on_bad_input", whole("onBadInput", onBadInput)).words("link", whole("link", link));
            def.floats("plant", constants("plant", plant, defaultPlant)).floats("ground", constants("ground", ground, defaultGround));
            putLimb(def, given, borrowed);
            return def.at;
        },
    };
}
function bodiesGroup(group: BodiesGroup, features: bigint, limbCount: number): CheckedGroup {
    const noLimb = { limbCount, features: 0n };
    if (typeof group === "object" && group !== null) {
        if ("look" in group) {
            const { look } = options("a group that looks", group, "look");
            return { ...noLimb, kind: Kind.LOOK, put: (borrowed) => putLook(look, borrowed) };
        }
        if ("prop" in group) {
            const { prop } = options("a prop's group", group, "prop");
            return { ...noLimb, kind: Kind.PROP, put: (borrowed) => putProp(prop, borrowed) };
        }
        if ("shift" in group) {
            const { shift } = options("a group of shifts", group, "shift");
            return { ...noLimb, kind: Kind.SHIFT, put: (borrowed) => putShift(shift, borrowed) };
        }
    }
    return bodyLimb(group, features, limbCount);
}
export function bodyGroups(groups: readonly BodiesGroup[], features: bigint, bodyCount: number): CheckedGroup[] {
    const limbCount = whole("bodyCount", bodyCount);
    return checkedList(groups, features, "[{ joints: { shoulder: 1, elbow: 2, wrist: 3 } }]", (group) => bodiesGroup(group, features, limbCount));
}

/** The floats of a structure of constants, side by side. jointCount: of a look. */
function constants(of: string, given: Plant | Ground | Shift | PropConstants | LookConstants, start: Record<string, number | Numbers>, jointCount?: number): number[] {
    const all = { ...start, ...options(of, given as typeof start, ...Object.keys(start)) };
    return Object.entries(start).flatMap(([name, usual]) => {
        const value = all[name], member = `${of}.${name}`;
        if (jointCount !== undefined && ofEachJoint.includes(name)) return eachJoint(member, value, jointCount);
        return typeof usual === "number" ? real(member, value as number) : Array.from(numbers(member, value as Numbers, usual.length));
    });
}
/** A number for each joint of a look, or one for all, and zeros for joints that it does not have. */
function eachJoint(name: string, value: number | Numbers, count: number): number[] {
    const given: number[] = typeof value === "object" ? Array.from(numbers(name, value, count)) : Array(count).fill(real(name, value));
    return [...given, ...Array(MAX_LOOK_JOINTS - count).fill(0)];
}

function putShift(given: Shift, borrowed: Borrowed): number {
    return borrowed.structure("swivel_shift_def").floats(firstFloat.shift, constants("shift", given, defaultShift)).at;
}

function putProp(given: Prop, borrowed: Borrowed): number {
    const { joint: none, ...start } = defaultProp;
    const { joint = none, ...others } = options("prop", given, ...(Object.keys(defaultProp) as (keyof Prop)[]));
    if (!Number.isInteger(joint) || Math.abs(joint) > 0x7fffffff) refuse(`prop.joint is ${shown(joint)}; give the number of a joint, or -1`);
    return borrowed.structure("swivel_prop_def").words("joint", joint).floats(firstFloat.prop, constants("prop", others, start)).at;
}

function putLook(given: Look, borrowed: Borrowed): number {
    const { joints, ...others } = options("look", given, "joints", ...(Object.keys(defaultLook) as (keyof Look)[]));
    if (!Array.isArray(joints)) refuse(`look.joints is ${shown(joints)}; give numbers of joints`);
    const known: number[] = joints.slice(0, MAX_LOOK_JOINTS), def = borrowed.structure("swivel_look_def").words("joint_count", joints.length);
    def.words("joints", ...known.map((joint) => whole("look.joints", joint)));
    return def.floats(firstFloat.look, constants("look", others, defaultLook, known.length)).at;
}

/** Makes the library's crowd. Without a skeleton its limbs are free. */
export function create(memory: Memory, groups: readonly CheckedGroup[], bodies?: SharedSkeleton): number {
    return memory.borrow((borrowed) => {
        const size = layout.swivel_group_def.bytes, list = borrowed.bytes(size * groups.length), crowd = borrowed.bytes(4);
        groups.forEach(({ kind, put }, n) => new Structure(memory, "swivel_group_def", list + n * size).words(definitions[kind], put(borrowed)));
        const def = borrowed.structure("swivel_crowd_def").words("group_count", groups.length).words("workspace_count", 1).words("groups", list);
        if (bodies) {
            def.words("skeleton", putSkeleton(bodies.skeleton, borrowed).at).words("body_count", bodies.bodyCount);
            def.floats("up", numbers("up", bodies.up ?? [0, 1, 0], 3));
        }
        memory.check(memory.calls.swivel_crowd_create(def.at, crowd));
        return memory.words(crowd, 1)[0];
    });
}
