// SPDX-License-Identifier: MIT
import { FieldNumber, nameOf, Numbers, numbers, options, refuse, shown, whole } from "./arguments.js";
import { carried, EXPLANATION_BYTES } from "./layout.js";
import type { Borrowed, Structure } from "./memory.js";
import { CrowdRows, Limbs } from "./rows.js";

export type { BodiesGroup, BodyGroup, Fit, FitGroup, Ground, Group, GroupOptions, Look, LookGroup, Plant, Prop, PropGroup } from "./groups.js";
export type { Limbs } from "./rows.js";

/**
 * What a solve does, as swivel_job: at most one of mask, limbs and priorities. Left out: every limb. In a crowd of bodies blocks, masks,
 * lists and priorities count bodies.
 */
export interface Job {
    blocks?: { first: number; count: number };
    /** Numbers of groups: no others are solved. Not with priorities. */
    groups?: Numbers;
    /** Bit i % 32 of word i / 32 is limb i = firstLimb(group) + n. Two blocks of 16 limbs share a word. */
    mask?: Numbers;
    /** Limbs as firstLimb(group) + n. */
    limbs?: Numbers;
    /** For each group, or once for bodies: one number for each limb, or one for all. The maxBlocks most urgent blocks are solved. */
    priorities?: readonly Numbers[];
    maxBlocks?: number;
    /**
     * How long blocks have waited: blockCount numbers, zeros at first. Give the same array each time; each solve changes it, so that
     * blocks take turns. Left out: priorities alone decide.
     */
    urgency?: Float32Array;
    /**
     * Finds Field.PROBE of groups with Feature.WITH_GROUND, and changes nothing else. Sample the ground there, give Field.GROUND and
     * Field.GROUND_NORMAL, and solve. A solve calls no function of yours.
     */
    probesOnly?: boolean;
}

/** A limb, counted within its group. */
export interface Place {
    group: number;
    limb: number;
}

/** Swivels allowed, from one to the other by the right hand: cosine and sine of each end, angle 0 being the wish. */
export interface Arc {
    from: [number, number];
    to: [number, number];
}

/** How joint angles are wanted: orders from Order, and the family of Euler angles, 0 or 1. Left out: XYZ, 0. */
export interface JointAngles extends Limbs {
    shoulderOrder?: number;
    wristOrder?: number;
    family?: number;
}

type Answer = (group: number, first: number, count: number, out: number) => number;

/** A crowd: the limbs that one call solves. Swivel.crowd() makes it. */
export class Crowd extends CrowdRows {
    /** Solves limbs, and returns how many. */
    solve(job: Job = {}): number {
        const { memory } = this;
        return memory.borrow((borrowed) => {
            const solved = borrowed.bytes(4);
            const to = borrowed.structure("swivel_job").words("solved_count", solved).words("pose", this.posed);
            const chosen = options("solve()", job, "blocks", "groups", "mask", "limbs", "priorities", "maxBlocks", "urgency", "probesOnly");
            this.name(chosen.groups, to, borrowed);
            const urgency = this.wait(chosen.urgency, to, borrowed);
            this.choose(chosen, to, borrowed);
            to.words("probes_only", Number(Boolean(chosen.probesOnly)));
            memory.check(memory.calls.swivel_solve(this.crowd, to.at));
            chosen.urgency?.set(urgency);
            return memory.words(solved, 1)[0];
        });
    }
    /** A bit for each group that a job names, and their streams. */
    private name(groups: Numbers | undefined, to: Structure<"swivel_job">, borrowed: Borrowed): void {
        if (groups === undefined) {
            if (this.held.some((_, group) => this.lists(group))) to.words("streams", this.streams);
            return;
        }
        const words = new Array<number>(Math.ceil(this.groupCount / 32)).fill(0);
        for (const group of Array.from(numbers("groups", groups))) this.limbCount(group), words[group >> 5] |= 1 << (group & 31);
        to.words("groups", borrowed.words(words)).words("group_word_count", words.length);
        const named = Array.from(new Set(Array.from(groups))).sort((a, b) => a - b);  // the crowd's order
        if (named.some((group) => this.lists(group))) to.words("streams", this.streamsOf(named, borrowed));
    }
    /** Whether a group's streams list any field. */
    private lists(group: number): boolean { return this.listOf(group)[1] > 0; }
    /** Lends the library the urgency of blocks, which a solve changes. */
    private wait(urgency: Float32Array | undefined, to: Structure<"swivel_job">, borrowed: Borrowed): Float32Array {
        if (urgency === undefined) return new Float32Array();
        if (!(urgency instanceof Float32Array)) refuse(`urgency is ${shown(urgency)}; give a Float32Array, which solves change`);
        const at = borrowed.floats(numbers("urgency", urgency, this.blockCount));
        to.words("urgency", at);
        return this.memory.floats(at, urgency.length);
    }
    private choose({ blocks, mask, limbs, priorities, maxBlocks }: Job, to: Structure<"swivel_job">, borrowed: Borrowed): void {
        const indices = (name: string, values: Numbers): number => {
            if (!(values instanceof Uint32Array)) for (const value of Array.from(numbers(name, values))) whole(name, value);
            return borrowed.words(values);
        };
        if (blocks) to.words("blocks", indices("blocks", [blocks.first, blocks.count]));
        if (mask) to.words("mask", indices("mask", mask)).words("mask_word_count", mask.length);
        if (limbs) to.words("limbs", borrowed.words([indices("limbs", limbs), limbs.length]));
        if ((priorities === undefined) !== (maxBlocks === undefined)) refuse("solve() takes priorities and maxBlocks together");
        if (!priorities) return;
        const [count, of] = this.posed ? [1, "bodies; give one list"] : [this.groupCount, `${this.groupCount} groups; give one list for each`];
        if (priorities.length !== count) refuse(`${priorities.length} priorities for ${of}`);
        const streams = priorities.map((values, group) => {
            const { length } = numbers("priorities", values);
            if (length !== 1 && length !== this.limbCount(group))
                refuse(`${length} priorities for the ${this.limbCount(group)} limbs of group ${group}; give one for each, or one for all`);
            return [borrowed.floats(values), length === 1 ? 0 : 4];
        });
        to.words("priorities", borrowed.words(streams.flat())).words("max_blocks", whole("maxBlocks", maxBlocks as number));
    }

    /** Forgets what limbs carry from solve to solve: swivels, planted points, shifts and lifts. */
    reset(limbs: Limbs = {}): void {
        const { group, first, count } = this.place(limbs);
        this.memory.check(this.memory.calls.swivel_reset(this.crowd, group, first, count));
        for (const field of carried) this.refresh(field, group);
    }

    /** The first limb with any of these flags, from a place on. To go on, add 1 to its limb. */
    find(flags: number, from: Place = { group: 0, limb: 0 }): Place | undefined {
        return this.memory.borrow((borrowed) => {
            const at = borrowed.words([whole("group", from.group), whole("limb", from.limb)]);
            if (!this.memory.calls.swivel_find(this.crowd, whole("flags", flags), at, at + 4)) return undefined;
            const [group, limb] = this.memory.words(at, 2);
            return { group, limb };
        });
    }

    /** Why a limb is as it is, from its present inputs, in a sentence or two. */
    explain(limb: number, group = 0): string {
        const { first } = this.one(limb, group);
        return this.memory.borrow((borrowed) => {
            const at = borrowed.bytes(EXPLANATION_BYTES);
            this.memory.check(this.memory.calls.swivel_explain(this.crowd, group, first, at, EXPLANATION_BYTES));
            return this.memory.text(at);
        });
    }

    /** The swivels that a limb's limits allow for its present inputs. The whole circle is one arc with equal ends. */
    allowedArcs(limb: number, group = 0): Arc[] {
        const { first } = this.one(limb, group);
        return this.memory.borrow((borrowed) => {
            const count = borrowed.bytes(4);
            const arcs = (at: number, capacity: number): void =>
                this.memory.check(this.memory.calls.swivel_allowed_arcs(this.crowd, group, first, at, capacity, count));
            arcs(0, 0);
            const [capacity] = this.memory.words(count, 1);
            const at = borrowed.bytes(16 * capacity);
            arcs(at, capacity);
            return Array.from({ length: capacity }, (_, n): Arc => {
                const [a, b, c, d] = this.memory.floats(at + 16 * n, 4);
                return { from: [a, b], to: [c, d] };
            });
        });
    }

    /** Where the results put the elbows: three numbers each, in the space of the targets. */
    elbows(limbs: Limbs = {}): Float64Array { return this.forward(limbs, 0); }
    /** Where the results put the wrists. */
    wrists(limbs: Limbs = {}): Float64Array { return this.forward(limbs, 1); }
    /** How the results turn the hands: quaternions; with Feature.WITH_HAND. */
    hands(limbs: Limbs = {}): Float64Array { return this.forward(limbs, 2); }
    /** How far each wrist is from its target, in arm lengths; NaN for bad input. */
    residuals(limbs: Limbs = {}): Float64Array {
        return this.answer(limbs, 1, (group, first, count, out) =>
            this.memory.calls.swivel_residuals(this.crowd, group, first, count, out));
    }
    /** Seven joint angles each, in radians, about the arm frame's axes: three of the shoulder, the flexion, three of the wrist. */
    jointAngles(given: JointAngles = {}): Float64Array {
        const { shoulderOrder = 0, wristOrder = 0, family = 0, ...limbs } = given;
        const [shoulder, wrist] = [whole("shoulderOrder", shoulderOrder), whole("wristOrder", wristOrder)];
        return this.answer(limbs, 7, (group, first, count, out) =>
            this.memory.calls.swivel_joint_angles(this.crowd, group, first, count, shoulder, wrist, whole("family", family), out));
    }
    /** A number for all results: equal results of crowds of one shape have equal digests on every machine. */
    digest(): bigint { return BigInt.asUintN(64, this.memory.calls.swivel_digest(this.crowd)); }

    /** A value of Field.ANGLE or of a limit that this crowd has, for the same limb on the body's other side. order: a box's. */
    mirror(field: FieldNumber, value: Numbers, order = 0): Float32Array {
        const components = this.held.reduce((max, _, group) => Math.max(max, this.componentCount(field, group)), 0);
        if (components === 0) refuse(`this crowd has no ${nameOf(field)}; give its feature to crowd()`);
        const given = numbers(nameOf(field), value, components);
        return this.memory.result(components, (out, borrowed) =>
            this.memory.calls.swivel_mirror(field, whole("order", order), borrowed.floats(given), out));
    }

    private one(limb: number, group: number): Required<Limbs> {
        const place = this.place({ group, first: whole("limb", limb, this.limbCount(group) - 1), count: 1 });
        this.settle(group);
        return place;
    }
    private answer(limbs: Limbs, components: number, call: Answer): Float64Array {
        const { group, first, count } = this.place(limbs);
        this.settle(group);
        return this.memory.borrow((borrowed) => {
            const at = borrowed.bytes(8 * components * count);
            this.memory.check(call(group, first, count, borrowed.words([at, 8 * components])));
            return this.memory.doubles(at, components * count).slice();
        });
    }
    private forward(limbs: Limbs, which: number): Float64Array {
        return this.memory.borrow((borrowed) => {
            const leftOut = borrowed.words([0, 0]);
            return this.answer(limbs, which === 2 ? 4 : 3, (group, first, count, out) => {
                const [elbow, wrist, hand] = [0, 1, 2].map((n) => (n === which ? out : leftOut));
                return this.memory.calls.swivel_forward(this.crowd, group, first, count, elbow, wrist, hand);
            });
        });
    }
}
