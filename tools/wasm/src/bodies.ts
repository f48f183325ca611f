// SPDX-License-Identifier: MIT
//
// Crowds of bodies. Their poses lie in swivel's own memory, where solves read and write them.
import { FieldNumber, nameOf, Numbers, numbers, options, refuse, shown, whole } from "./arguments.js";
import { Crowd, Shape } from "./crowd.js";
import { BodiesGroup, bodyGroups, SharedSkeleton } from "./groups.js";
import { carried, EXPLANATION_BYTES, layout, PoseForm, PoseSpace } from "./layout.js";
import { Borrowed, Memory, Structure } from "./memory.js";
import { copyOf, inBody, Rest, rotationOf, valueOf } from "./rest.js";
import { isPosition, Limbs } from "./rows.js";

export interface BodiesOptions extends SharedSkeleton {
    /** Each is one limb of every body, its shift, or a thing that it holds. */
    groups: readonly BodiesGroup[];
    /** Of groups of limbs that give none of their own. */
    features?: bigint;
    /** What the rotations of poses are, from PoseForm. Left out: ROTATIONS. */
    form?: number;
    /** What the joints of poses are relative to, from PoseSpace. Left out: LOCAL, each to its parent. */
    space?: number;
    /** Whether root positions, and the positions of goals, are doubles. */
    rootIsDouble?: boolean;
}

/** Where an engine has the joints of a limb, in the world: three numbers each. */
export interface LimbPlaces {
    shoulder: Numbers;
    elbow: Numbers;
    wrist: Numbers;
}

/** What compare() says. */
export interface Comparison {
    agrees: boolean;
    text: string;
}

interface Part {
    /** Of swivel_pose. */
    member: keyof typeof layout.swivel_pose;
    /** What a joint starts with, or a body. */
    start: (rest: Rest, joint: number) => number[];
    /** A body has one, not each of its joints. */
    isBodys?: boolean;
    /** It is in doubles if the root is. */
    isPlace?: boolean;
    /** Whether matrices hold it. */
    inMatrices?: boolean;
}
const named = <Name extends string>(parts: Record<Name, Part>): Record<Name, Part> => parts;
const parts = named({
    rotations: { member: "rotations", start: rotationOf },
    translations: { member: "translations", start: translationOf, inMatrices: true },
    scales: { member: "scales", start: () => [1, 1, 1], inMatrices: true },
    results: { member: "results", start: rotationOf },
    translationResults: { member: "translation_results", start: translationOf, inMatrices: true },
    jointRotations: { member: "joint_rotations", start: () => [NaN, NaN, NaN, NaN] },
    jointPositions: { member: "joint_positions", start: () => [NaN, NaN, NaN] },
    rootPosition: { member: "root_position", start: () => [0, 0, 0], isBodys: true, isPlace: true },
    rootRotation: { member: "root_rotation", start: () => [0, 0, 0, 1], isBodys: true },
    rootScale: { member: "root_scale", start: () => [1], isBodys: true },
    time: { member: "time", start: () => [0], isBodys: true },
    supportPosition: { member: "support_position", start: () => [0, 0, 0], isBodys: true, isPlace: true },
    supportRotation: { member: "support_rotation", start: () => [0, 0, 0, 1], isBodys: true },
    weight: { member: "weight", start: () => [1], isBodys: true },
});
/**
 * A part of poses, as swivel_pose. Each joint has a rotation relative to its parent: x, y, z, w, or by the form 12 numbers of a matrix, of
 * MATRIX_COLUMNS 16; three numbers of translation; three of scale. The root has a position, a rotation and one number of scale.
 *
 * Solves write jointRotations, x, y, z, w, and jointPositions: where the joints that some limb needs are then, relative to the root before its
 * shift. Those of others stay NaN. In the body's space they also write translations, or translationResults if these are asked for.
 *
 * Planted limbs, shifts and looks with a rate need time: the seconds since each body's last solve. supportPosition and supportRotation are of what planted
 * points stand on, in the world. weight, 0 to 1, is how much of all corrections counts.
 */
export type PosePart = keyof typeof parts;

/** What planted points of some bodies stand on: one for all, or one for each. Left out: the world's origin, not turned. */
export interface Support {
    /** Three numbers, which are doubles. */
    position?: Numbers;
    /** x, y, z, w. */
    rotation?: Numbers;
}

function translationOf({ skeleton }: Rest, joint: number): number[] { return valueOf(skeleton.translations, 3, joint); }

/** A crowd of bodies: whole poses go in and come out. Swivel.bodies() makes it. Limb i of every group is body i's. */
export class Bodies<Positions extends Float32Array | Float64Array = Float32Array> extends Crowd {
    private readonly rest: Rest;
    private readonly isInBody: boolean;
    private readonly parts = new Map<PosePart, Float32Array | Float64Array>();
    /** Of each group, the positions that are doubles. */
    private readonly doubles: Map<FieldNumber, Float64Array>[];

    /** @internal */
    constructor(memory: Memory, given: BodiesOptions) {
        const { skeleton, bodyCount, groups, features = 0n, form = PoseForm.ROTATIONS, space = PoseSpace.LOCAL, rootIsDouble = false, up } =
            options("bodies()", given, "skeleton", "bodyCount", "groups", "features", "form", "space", "rootIsDouble", "up");
        if (!Object.values<unknown>(PoseForm).includes(form)) refuse(`form is ${shown(form)}; give one of PoseForm`);
        if (!Object.values<unknown>(PoseSpace).includes(space)) refuse(`space is ${shown(space)}; give one of PoseSpace`);
        super(memory, bodyGroups(groups, features, bodyCount), { skeleton, bodyCount, up });
        this.isInBody = space === PoseSpace.IN_BODY;
        this.rest = { skeleton: this.isInBody ? inBody(copyOf(skeleton)) : copyOf(skeleton), form };
        this.isDouble = Boolean(rootIsDouble);
        this.doubles = groups.map(() => new Map());
        this.orDispose(() => {
            this.posed = this.own(layout.swivel_pose.bytes);
            new Structure(memory, "swivel_pose", this.posed).words("form", form).words("space", space).words("root_is_double", Number(this.isDouble));
            this.pose("rotations");
            if (this.isDouble) this.pose("rootPosition");
        });
    }

    /**
     * A part of the bodies' poses, body after body and joint after joint, in swivel's own memory: no call copies it. It starts at rest.
     * From the first call on, solves read it from here, and write solved joints to rotations, or to results if these are asked for. The
     * view stays valid until dispose().
     */
    pose(part: "rootPosition" | "supportPosition"): Positions;
    pose(part: Exclude<PosePart, "rootPosition" | "supportPosition">): Float32Array;
    pose(part: PosePart): Float32Array | Float64Array {
        if (!Object.keys(parts).includes(part)) refuse(`poses have ${Object.keys(parts).join(", ")}, not ${shown(part)}`);
        const { member, start, isBodys, isPlace, inMatrices } = parts[part], { memory, rest } = this;
        const held = this.crowd && this.parts.get(part);
        if (held) return held;
        if (inMatrices && rest.form !== PoseForm.ROTATIONS) refuse(`the pose's matrices hold ${part}; give them there`);
        if (part === "translationResults") {
            if (!this.isInBody) refuse("only translations in the body's space change; give bodies() the space PoseSpace.IN_BODY");
            this.pose("translations");
        }
        const count = isBodys ? 1 : rest.skeleton.parents.length, ofBody = Array.from({ length: count }, (_, n) => start(rest, n)).flat();
        const bytes = this.isDouble && isPlace ? 8 : 4, length = ofBody.length * this.limbCount();
        const at = this.own(bytes * length), stride = bytes * ofBody.length;
        const values = bytes === 8 ? memory.doubles(at, length) : memory.floats(at, length);
        for (let n = 0; n < length; n += ofBody.length) values.set(ofBody, n);
        memory.words(this.posed + layout.swivel_pose[member], isBodys ? 2 : 4).set(isBodys ? [at, stride] : [at, stride, stride / count, 0]);
        this.parts.set(part, values);
        return values;
    }

    /** As values() of a position: in doubles if the root is. What nobody has set is NaN. */
    positions(field: FieldNumber, group = 0): Positions {
        if (!isPosition(field)) refuse(`${nameOf(field)} is no position; values() gives it`);
        if (!this.isDouble) return this.values(field, group) as Positions;
        const limbCount = this.limbCount(group), held = this.crowd && this.doubles[group].get(field);
        if (held) return held as Positions;
        if (this.componentCount(field, group) === 0) this.read(field, { group });  // which says what is missing
        const values = this.memory.doubles(this.own(24 * limbCount), 3 * limbCount).fill(NaN);
        this.list(group, [field, values.byteOffset, 24]);
        this.doubles[group].set(field, values);
        return values as Positions;
    }

    /**
     * Compares the poses' parts with where your engine has a limb of a body, for the pose as it goes in. The text names the input that
     * disagrees, such as quaternions in another order, and what to do.
     */
    compare(body: number, places: LimbPlaces, group = 0): Comparison {
        const { memory } = this, { first } = this.place({ group, first: whole("body", body, this.limbCount(group) - 1), count: 1 });
        const of = options("compare()", places, "shoulder", "elbow", "wrist");
        return memory.borrow((borrowed) => {
            const [shoulder, elbow, wrist] =
                (["shoulder", "elbow", "wrist"] as const).map((name) => borrowed.doubles(numbers(name, of[name], 3)));
            const text = borrowed.bytes(EXPLANATION_BYTES), agrees = borrowed.bytes(4);
            memory.check(memory.calls.swivel_compare(this.crowd, group, first, this.posed, shoulder, elbow, wrist, text, EXPLANATION_BYTES, agrees));
            return { agrees: memory.words(agrees, 1)[0] !== 0, text: memory.text(text) };
        });
    }

    /** What a body of the pose's parts does, as lines and points: its skeleton, and one of its groups or all. Call it after a solve. */
    draw(body: number, group?: number): Shape[] {
        const { first } = this.place({ group, first: whole("body", body, this.limbCount(group) - 1), count: 1 });
        for (let g = 0; g < this.groupCount; ++g) this.settle(g);
        return this.shapes(first, group ?? -1, this.posed);
    }

    /**
     * Changes what planted points of a group stand on, without a jump. Both supports are as they are now. Call it between two solves, best
     * while a foot is in the air, and give the pose's parts the new support.
     */
    changeSupport(was: Support, now: Support, limbs: Limbs = {}): void {
        const { group, first, count } = this.place(limbs), { memory } = this;
        memory.borrow((borrowed) => {
            const [from, to] = [putSupports("was", was, count, borrowed), putSupports("now", now, count, borrowed)];
            memory.check(memory.calls.swivel_change_support(this.crowd, group, first, count, from, to));
        });
        for (const field of carried) this.refresh(field, group);
    }
}

/** Supports as swivel_supports: two streams of a place and a stride. */
function putSupports(name: string, given: Support, count: number, borrowed: Borrowed): number {
    const { position, rotation } = options(name, given, "position", "rotation");
    const stream = (of: string, values: Numbers | undefined, components: number, bytes: number, put: (values: Numbers) => number): number[] => {
        if (values === undefined) return [0, 0];
        const { length } = numbers(`${name}.${of}`, values), isOne = length === components;
        if (!isOne && length !== components * count)
            refuse(`${length} numbers for ${name}.${of} of ${count} bodies; give ${components}, or ${components} for each body`);
        return [put(values), isOne ? 0 : bytes * components];
    };
    return borrowed.words([...stream("position", position, 3, 8, borrowed.doubles), ...stream("rotation", rotation, 4, 4, borrowed.floats)]);
}
