// SPDX-License-Identifier: MIT
import type { Binding } from "./binding.js";
import { Feature, Field, frameMembers, layout } from "./layout.js";
import { Memory, Numbers, refuse, Structure, whole } from "./memory.js";

export type FieldNumber = (typeof Field)[keyof typeof Field];

/** Limbs that share one binding. A number alone: that many limbs without a binding, in the arm frame. */
export type Group = number | { limbCount: number; binding?: Binding };

/** Orders of the Euler angles of SHOULDER_BOX and WRIST_BOX, from Order. Left out: XYZ. */
export interface CrowdOptions {
    shoulderOrder?: number;
    wristOrder?: number;
}

/** Which limbs of a group; left out, all of group 0. */
export interface Limbs {
    group?: number;
    first?: number;
    count?: number;
}

/** What a solve does, as swivel_job: at most one of mask, limbs and priorities. Left out: every limb. */
export interface Job {
    blocks?: { first: number; count: number };
    /** Bit i % 32 of word i / 32 is limb firstLimb(group) + n. */
    mask?: Numbers;
    /** Limbs as firstLimb(group) + n. */
    limbs?: Numbers;
    /** For each group one number for each limb, or one for all; with Feature.BUDGET and mostBlocks. */
    priorities?: readonly Numbers[];
    mostBlocks?: number;
}

/** Swivels allowed, from one to the other by the right hand: cosine and sine of each end, 0 being the wish. */
export interface Arc {
    from: [number, number];
    to: [number, number];
}

type Values = Float32Array | Uint32Array;

const nameOf = (field: FieldNumber): string => Object.entries(Field).find(([, number]) => number === field)?.[0] ?? `field ${field}`;

/** A crowd: the limbs that one call solves. Made by Swivel.crowd(). */
export class Crowd {
    private at: number;
    private readonly frames: number;
    private readonly limbCounts: number[];
    private readonly componentCounts = new Map<number, number>();
    private readonly arrays: Map<number, Values>[];

    /** @internal */
    constructor(private readonly memory: Memory, groups: readonly Group[], features: bigint, options: CrowdOptions) {
        const calls = memory.calls;
        const defs = groups.map((group) => (typeof group === "number" ? { limbCount: group } : group));
        this.limbCounts = defs.map((def) => whole("limbCount", def.limbCount));
        const create = (counts: number[], wanted: bigint): number =>
            memory.borrow((borrowed) => {
                const size = layout.swivel_group_def.bytes;
                const list = borrowed.bytes(size * counts.length);
                counts.forEach((count, n) => {
                    const def = new Structure(memory, "swivel_group_def", list + n * size).words("limb_count", count);
                    const binding = defs[n].binding;
                    if (binding) def.copy("binding", binding.bytes);
                });
                const def = borrowed.structure("swivel_crowd_def");
                def.wide("features", wanted).words("group_count", counts.length).words("groups", list);
                def.words("shoulder_order", whole("shoulderOrder", options.shoulderOrder ?? 0));
                def.words("wrist_order", whole("wristOrder", options.wristOrder ?? 0));
                const crowd = borrowed.bytes(4);
                memory.check(calls.swivel_crowd_create(def.at, crowd));
                return memory.words(crowd, 1)[0];
            });
        this.at = create(this.limbCounts, features);
        // Compact rows are words. A field's value has the same numbers as without Feature.COMPACT.
        const one = features & Feature.COMPACT ? create([1], features & ~Feature.COMPACT) : this.at;
        for (const field of Object.values(Field)) this.componentCounts.set(field, calls.swivel_field_row_count(one, field));
        if (one !== this.at) calls.swivel_crowd_destroy(one);

        this.arrays = groups.map(() => new Map());
        const frame = layout.swivel_frame.bytes;
        this.frames = memory.allocate(frame * groups.length);
        groups.forEach((_, n) => new Structure(memory, "swivel_frame", this.frames + n * frame));
    }

    /** Frees the crowd's memory. Views of it then mean nothing, and other calls fail. */
    dispose(): void {
        if (this.at === 0) return;
        this.memory.calls.swivel_crowd_destroy(this.at);
        for (const arrays of this.arrays) for (const array of arrays.values()) this.memory.free(array.byteOffset);
        this.memory.free(this.frames);
        this.at = 0;
    }

    get groupCount(): number { return this.limbCounts.length; }
    limbCount(group = 0): number {
        return this.limbCounts[whole("group", group)] ?? refuse(`group ${group} does not exist; the crowd has ${this.groupCount}`);
    }
    /** The index of a group's first limb in rows, masks and lists of limbs. */
    firstLimb(group = 0): number { return this.memory.calls.swivel_group_first_limb(this.at, whole("group", group)); }
    /** The numbers of a field's value; 0 if the crowd's features do not bring the field. */
    componentCount(field: FieldNumber): number { return this.componentCounts.get(field) ?? 0; }

    /**
     * The values of a field of a group, limb after limb, in swivel's own memory: no call copies them. From the first call
     * on, solves read an input from here and write a result here. The view stays valid until dispose().
     */
    values(field: typeof Field.FLAGS, group?: number): Uint32Array;
    values(field: FieldNumber, group?: number): Float32Array;
    values(field: FieldNumber, group = 0): Values {
        const limbCount = this.limbCount(group);
        const held = this.arrays[group].get(field);
        if (held) return held;
        if (field >= Field.SHOULDER && this.compactRows().length > 0)
            refuse("results of a crowd with Feature.COMPACT are packed: use read() or compactRows()");
        const bytes = 4 * this.componentCount(field);
        const at = this.memory.allocate(Math.max(bytes, 4) * limbCount);
        try {
            this.readTo(at, field, { group });
        } catch (error) {
            this.memory.free(at);
            throw error;
        }
        const array = this.view(field, at, limbCount);
        this.arrays[group].set(field, array);
        this.memory.words(this.frames + group * layout.swivel_frame.bytes + frameMembers[field], 2).set([at, bytes]);
        return array;
    }

    /** Sets an input: one value for all these limbs, or one for each. */
    write(field: FieldNumber, values: Numbers, limbs: Limbs = {}): void {
        const { group, first } = this.place(limbs);
        const components = this.componentCount(field);
        const same = values.length === components || components === 0;  // the library refuses a field without components
        const count = limbs.count ?? (same ? this.limbCount(group) - first : Math.floor(values.length / components));
        if (!same && values.length !== count * components)
            refuse(`${values.length} numbers for ${nameOf(field)}; give ${components}, or ${components} for each limb`);
        this.memory.borrow((borrowed) => {
            const from = borrowed.words([borrowed.floats(values), same ? 0 : 4 * components]);
            this.memory.check(this.memory.calls.swivel_write(this.at, field, group, first, whole("count", count), from));
        });
        const held = this.arrays[group].get(field);
        if (held) this.readTo(held.byteOffset + 4 * components * first, field, { group, first, count });
    }

    /** A copy of a field's values. */
    read(field: typeof Field.FLAGS, limbs?: Limbs): Uint32Array;
    read(field: FieldNumber, limbs?: Limbs): Float32Array;
    read(field: FieldNumber, limbs: Limbs = {}): Values {
        const { group, first, count } = this.place(limbs);
        const components = this.componentCount(field);
        const held = this.arrays[group].get(field);
        if (held) return held.slice(first * components, (first + count) * components);
        return this.memory.borrow((borrowed) => {
            const at = borrowed.bytes(4 * Math.max(components, 1) * count);
            this.readTo(at, field, { group, first, count });
            return this.view(field, at, count).slice();
        });
    }

    /** Solves limbs, and returns how many. */
    solve(job: Job = {}): number {
        const { memory } = this;
        return memory.borrow((borrowed) => {
            const solved = borrowed.bytes(4);
            const to = borrowed.structure("swivel_job").words("solved_count", solved);
            if (this.arrays.some((arrays) => arrays.size > 0)) to.words("frames", this.frames);
            if (job.blocks)
                to.words("blocks", borrowed.words([whole("first", job.blocks.first), whole("count", job.blocks.count)]));
            if (job.mask) to.words("mask", borrowed.words(job.mask)).words("mask_word_count", job.mask.length);
            if (job.limbs) to.words("limbs", borrowed.words([borrowed.words(job.limbs), job.limbs.length]));
            if (job.priorities) {
                if (job.priorities.length !== this.groupCount)
                    refuse(`${job.priorities.length} priorities for ${this.groupCount} groups; give one list for each`);
                const each = job.priorities.map((values, group) => {
                    if (values.length !== 1 && values.length !== this.limbCount(group))
                        refuse(`${values.length} priorities for the ${this.limbCount(group)} limbs of group ${group}; give one for each, or one for all`);
                    return [borrowed.floats(values), values.length === 1 ? 0 : 4];
                });
                to.words("priorities", borrowed.words(each.flat())).words("most_blocks", whole("mostBlocks", job.mostBlocks ?? 0));
            }
            memory.check(memory.calls.swivel_solve(this.at, to.at));
            return memory.words(solved, 1)[0];
        });
    }

    /** Forgets the swivels that a crowd with Feature.WITH_MOST_SWIVEL keeps between solves. */
    reset(limbs: Limbs = {}): void {
        const { group, first, count } = this.place(limbs);
        this.memory.check(this.memory.calls.swivel_reset(this.at, group, first, count));
    }

    /** The first limb with any of these flags, from a place on. To go on, add 1 to its limb. */
    find(flags: number, from = { group: 0, limb: 0 }): { group: number; limb: number } | undefined {
        return this.memory.borrow((borrowed) => {
            const at = borrowed.words([whole("group", from.group), whole("limb", from.limb)]);
            if (!this.memory.calls.swivel_find(this.at, flags, at, at + 4)) return undefined;
            const [group, limb] = this.memory.words(at, 2);
            return { group, limb };
        });
    }

    /** Why a limb is as it is, in a sentence or two. */
    explain(limb: number, group = 0): string {
        return this.memory.borrow((borrowed) => {
            const at = borrowed.bytes(1024);
            this.memory.check(this.memory.calls.swivel_explain(this.at, whole("group", group), whole("limb", limb), at, 1024));
            return this.memory.text(at);
        });
    }

    /** The swivels that a limb's limits allow for its inputs as they are. */
    allowedArcs(limb: number, group = 0): Arc[] {
        const arcs = (at: number, capacity: number, count: number): void =>
            this.memory.check(this.memory.calls.swivel_allowed_arcs(this.at, whole("group", group), whole("limb", limb), at, capacity, count));
        return this.memory.borrow((borrowed) => {
            const count = borrowed.bytes(4);
            arcs(0, 0, count);
            const [capacity] = this.memory.words(count, 1);
            const at = borrowed.bytes(16 * capacity);
            arcs(at, capacity, count);
            return Array.from({ length: capacity }, (_, n) => {
                const [a, b, c, d] = this.memory.floats(at + 16 * n, 4);
                return { from: [a, b], to: [c, d] } as Arc;
            });
        });
    }

    /** A value of Field.ANGLE or of a limit, for the same limb on the body's other side. order is a box's. */
    mirror(field: FieldNumber, value: Numbers, order = 0): Float32Array {
        const count = this.componentCount(field);
        if (value.length !== count) refuse(`${value.length} numbers for ${nameOf(field)}; give ${count}`);
        return this.memory.borrow((borrowed) => {
            const out = borrowed.bytes(4 * count);
            this.memory.check(this.memory.calls.swivel_mirror(field, whole("order", order), borrowed.floats(value), out));
            return this.memory.floats(out, count).slice();
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
            this.memory.calls.swivel_residuals(this.at, group, first, count, out));
    }
    /** Seven joint angles each, in radians, about the arm frame's axes; swivel_joint_angles() has their meaning. */
    jointAngles(shoulderOrder = 0, wristOrder = 0, family = 0, limbs: Limbs = {}): Float64Array {
        return this.answer(limbs, 7, (group, first, count, out) =>
            this.memory.calls.swivel_joint_angles(this.at, group, first, count, shoulderOrder, wristOrder, family, out));
    }
    /** A number for all results: equal results have equal digests on every machine. */
    digest(): bigint { return BigInt.asUintN(64, this.memory.calls.swivel_digest(this.at)); }

    /** Rows of inputs in swivel's own memory, as swivel_rows says. */
    inputRows(): Float32Array {
        const { at, length } = this.rows("swivel_input_rows");
        return this.memory.floats(at, length);
    }
    /** Rows of results; of no length with Feature.COMPACT. */
    resultRows(): Float32Array {
        const { at, length } = this.rows("swivel_result_rows");
        return this.memory.floats(at, length);
    }
    /** Rows of words; of no length without Feature.COMPACT. */
    compactRows(): Uint16Array {
        const { at, length } = this.rows("swivel_compact_rows");
        return new Uint16Array(this.memory.buffer, at, length);
    }
    /** A field's first row in a block. */
    fieldFirstRow(field: FieldNumber): number { return this.memory.calls.swivel_field_first_row(this.at, field); }
    /** A field's rows in a block. */
    fieldRowCount(field: FieldNumber): number { return this.memory.calls.swivel_field_row_count(this.at, field); }

    private place({ group = 0, first = 0, count }: Limbs): { group: number; first: number; count: number } {
        return { group, first: whole("first", first), count: whole("count", count ?? this.limbCount(group) - first) };
    }
    private view(field: FieldNumber, at: number, limbCount: number): Values {
        const length = this.componentCount(field) * limbCount;
        return field === Field.FLAGS ? this.memory.words(at, length) : this.memory.floats(at, length);
    }
    private readTo(at: number, field: FieldNumber, limbs: Limbs): void {
        const { group, first, count } = this.place(limbs);
        this.memory.borrow((borrowed) => {
            const out = borrowed.words([at, 4 * Math.max(this.componentCount(field), 1)]);
            this.memory.check(this.memory.calls.swivel_read(this.at, field, group, first, count, out));
        });
    }
    private answer(limbs: Limbs, components: number, call: (group: number, first: number, count: number, out: number) => number): Float64Array {
        const { group, first, count } = this.place(limbs);
        return this.memory.borrow((borrowed) => {
            const at = borrowed.bytes(8 * components * count);
            this.memory.check(call(group, first, count, borrowed.words([at, 8 * components])));
            return this.memory.doubles(at, components * count).slice();
        });
    }
    private forward(limbs: Limbs, which: number): Float64Array {
        return this.memory.borrow((borrowed) => {
            const none = borrowed.words([0, 0]);
            return this.answer(limbs, which === 2 ? 4 : 3, (group, first, count, out) => {
                const [elbow, wrist, hand] = [0, 1, 2].map((n) => (n === which ? out : none));
                return this.memory.calls.swivel_forward(this.at, group, first, count, elbow, wrist, hand);
            });
        });
    }
    private rows(call: "swivel_input_rows" | "swivel_result_rows" | "swivel_compact_rows"): { at: number; length: number } {
        return this.memory.borrow((borrowed) => {
            const rows = borrowed.structure("swivel_rows");
            this.memory.calls[call](rows.at, this.at);
            const [at, blocks, count] = this.memory.words(rows.at, 3);
            return { at, length: blocks * count * 16 };
        });
    }
}
