// SPDX-License-Identifier: MIT
import { FieldNumber, nameOf, Numbers, numbers, options, refuse, shown, whole } from "./arguments.js";
import { carried, EXPLANATION_BYTES, Field, layout } from "./layout.js";
import type { Borrowed, Structure } from "./memory.js";
import { CrowdRows, Limbs } from "./rows.js";

export type { BodiesGroup, BodyGroup, Ground, Group, GroupOptions, Look, LookGroup, Plant, Prop, PropGroup, Shift, ShiftGroup } from "./groups.js";
export type { Limbs } from "./rows.js";

/** What a solve does, as swivel_job. Left out: every limb. In a crowd of bodies blocks and masks count bodies. */
export interface Job {
    blocks?: { first: number; count: number };
    /** Numbers of groups: no others are solved. */
    groups?: Numbers;
    /** Bit i % 32 of word i / 32 is limb i = firstLimb(group) + n. Two blocks of 16 limbs share a word. choose() makes one. */
    mask?: Numbers;
}

/** Swivels allowed, from one to the other by the right hand: cosine and sine of each end, angle 0 being the wish. */
export interface Arc {
    from: [number, number];
    to: [number, number];
}

/** Some bodies: `count` of them from `first` on. Left out: all. In a crowd of free limbs body n is limb n of each group. */
export interface SomeBodies {
    first?: number;
    count?: number;
}

/**
 * A line that draw() gives, or a point, whose ends are equal. Bodies: in the world. Free limbs: in the space of their rows, from their origin;
 * without WORLD in the arm frame. Its colour is 0xRRGGBBAA.
 */
export interface Shape {
    /** What it shows, such as "bone" or "miss". */
    name: string;
    from: [number, number, number];
    to: [number, number, number];
    color: number;
    /** -1: it belongs to no group, but to the body itself. */
    group: number;
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
    private maxShapeCount = 0;

    /**
     * Solves limbs, and returns how many. It calls no function of yours: with Feature.WITH_GROUND read Field.PROBE after a solve, sample the
     * ground there, and give Field.GROUND and Field.GROUND_NORMAL for the next one.
     */
    solve(job: Job = {}): number {
        const { memory } = this;
        return memory.borrow((borrowed) => {
            const solved = borrowed.bytes(4);
            const to = borrowed.structure("swivel_job").words("solved_count", solved).words("pose", this.posed);
            const { blocks, groups, mask } = options("solve()", job, "blocks", "groups", "mask");
            const words = (name: string, values: Numbers): number => {
                if (!(values instanceof Uint32Array)) for (const value of Array.from(numbers(name, values))) whole(name, value);
                return borrowed.words(values);
            };
            this.name(groups, to, borrowed);
            if (blocks) to.words("blocks", words("blocks", [blocks.first, blocks.count]));
            if (mask) to.words("mask", words("mask", mask)).words("mask_word_count", mask.length);
            memory.check(memory.calls.swivel_solve(this.crowd, to.at));
            return memory.words(solved, 1)[0];
        });
    }
    /**
     * Picks at most maxBlocks blocks of 16 limbs, the most urgent ones, and solves nothing. Returns the mask of their limbs, for solve().
     * priorities: for each group, or once for bodies, one number for each limb, or one for all. urgency: how long blocks have waited:
     * blockCount numbers, zeros at first. Give the same array each time; each call changes it, so that blocks take turns. Left out:
     * priorities alone decide.
     */
    choose(priorities: readonly Numbers[], maxBlocks: number, urgency?: Float32Array): Uint32Array {
        const { memory } = this;
        const [count, of] = this.posed ? [1, "bodies; give one list"] : [this.groupCount, `${this.groupCount} groups; give one list for each`];
        if (!Array.isArray(priorities)) refuse(`priorities is ${shown(priorities)}; give a list for each group`);
        if (priorities.length !== count) refuse(`${priorities.length} priorities for ${of}`);
        if (urgency !== undefined && !(urgency instanceof Float32Array)) refuse(`urgency is ${shown(urgency)}; give a Float32Array, which choose() changes`);
        return memory.borrow((borrowed) => {
            const streams = priorities.map((values, group) => {
                const { length } = numbers("priorities", values);
                if (length !== 1 && length !== this.limbCount(group))
                    refuse(`${length} priorities for the ${this.limbCount(group)} limbs of group ${group}; give one for each, or one for all`);
                return [borrowed.floats(values), length === 1 ? 0 : 4];
            });
            const waited = urgency === undefined ? 0 : borrowed.floats(numbers("urgency", urgency, this.blockCount));
            const wordCount = Math.ceil(this.blockCount / 2), mask = borrowed.bytes(4 * wordCount);
            memory.check(memory.calls.swivel_choose(
                this.crowd, borrowed.words(streams.flat()), waited, whole("maxBlocks", maxBlocks), mask, wordCount, 0));
            if (urgency !== undefined) urgency.set(memory.floats(waited, urgency.length));
            return memory.words(mask, wordCount).slice();
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

    /** Forgets what limbs carry from solve to solve: swivels, planted points, shifts and lifts. */
    reset(limbs: Limbs = {}): void {
        const { group, first, count } = this.place(limbs);
        this.memory.check(this.memory.calls.swivel_reset(this.crowd, group, first, count));
        for (const field of carried) this.refresh(field, group);
    }

    /** reset() of all groups of these bodies, such as for a teleport. */
    resetBodies(bodies: SomeBodies = {}): void {
        const { first, count } = this.choice(bodies);
        this.memory.check(this.memory.calls.swivel_reset_body(this.crowd, first, count));
        this.refreshResults();
    }
    /** The state of bodies: all that their next solve starts from besides its inputs. The bytes are the same on every machine. */
    save(bodies: SomeBodies = {}): Uint8Array {
        const { memory } = this, { first, count } = this.choice(bodies), size = count * memory.calls.swivel_state_bytes(this.crowd);
        return memory.borrow((borrowed) => {
            const at = borrowed.bytes(size);
            memory.check(memory.calls.swivel_save(this.crowd, first, count, at, size));
            return memory.bytes(at, size).slice();
        });
    }
    /** Loads what save() gave, of as many bodies of this crowd or of another with the same groups. Inputs stay as they are. */
    load(state: Uint8Array, bodies: SomeBodies = {}): void {
        const { memory } = this, { first, count } = this.choice(bodies), size = count * memory.calls.swivel_state_bytes(this.crowd);
        if (!(state instanceof Uint8Array)) refuse("state is no Uint8Array; give what save() gave");
        if (size > 0 && state.length !== size) refuse(`state has ${state.length} bytes; ${count} bodies have ${size}`);
        memory.borrow((borrowed) => {
            const at = borrowed.bytes(state.length);
            memory.bytes(at, state.length).set(state);
            memory.check(memory.calls.swivel_load(this.crowd, first, count, at, state.length));
        });
        this.refreshResults();
    }
    /** A number for what save() has: a crowd that has loaded all bodies of another has its number. */
    stateDigest(): bigint { return BigInt.asUintN(64, this.memory.calls.swivel_state_digest(this.crowd)); }
    private choice(bodies: SomeBodies): Required<Limbs> {
        return this.place({ group: 0, ...options("a choice of bodies", bodies, "first", "count") });
    }
    private refreshResults(): void {
        this.held.forEach((fields, group) => {
            for (const field of fields.keys()) if (field >= Field.SHOULDER) this.refresh(field, group);
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

    /** What a free limb does, as lines and points. Bodies have a draw() of their own. */
    draw(limb: number, group = 0): Shape[] { return this.shapes(this.one(limb, group).first, group, 0); }
    /** There is room for as many shapes as any call before has drawn. A call that draws more is made again. */
    protected shapes(limb: number, group: number, pose: number): Shape[] {
        const { memory, maxShapeCount: capacity } = this, { bytes, name, color, group: groupOf } = layout.swivel_shape;
        return memory.borrow((borrowed) => {
            const count = borrowed.bytes(4), at = borrowed.bytes(bytes * capacity);
            memory.check(memory.calls.swivel_draw(this.crowd, group, limb, pose, at, capacity, count));
            const [length] = memory.words(count, 1);
            if (length > capacity) {
                this.maxShapeCount = length;
                return this.shapes(limb, group, pose);
            }
            return Array.from({ length }, (_, n): Shape => {
                const shape = at + bytes * n, word = (member: number): number => memory.words(shape + member, 1)[0];
                const [a, b, c, d, e, f] = memory.doubles(shape, 6);
                return { name: memory.text(word(name)), from: [a, b, c], to: [d, e, f], color: word(color), group: word(groupOf) | 0 };
            });
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

    /** A value of a limit that this crowd has, or of a turn such as Field.ANGLE, for the same limb on the body's other side. order: a box's. */
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
