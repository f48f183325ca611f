// SPDX-License-Identifier: MIT
//
// A crowd's memory: what goes in and what comes out.
import { FieldNumber, nameOf, Numbers, numbers, options, refuse, shown, whole } from "./arguments.js";
import type { Binding } from "./binding.js";
import { Feature, Field, frameMembers, LANES, layout } from "./layout.js";
import { Memory, Structure } from "./memory.js";

/** Limbs that share one binding. A number alone: that many limbs without a binding, in the arm frame. */
export type Group = number | { limbCount: number; binding?: Binding };

/** Orders of the Euler angles of SHOULDER_BOX and WRIST_BOX, from Order. Left out: XYZ. */
export interface CrowdOptions {
    shoulderOrder?: number;
    wristOrder?: number;
}

/** Which limbs of a group. Left out: group 0, from its first limb on, up to its last. */
export interface Limbs {
    group?: number;
    first?: number;
    count?: number;
}

export type Values = Float32Array | Uint32Array;

export class CrowdRows {
    private at = 0;
    /** A swivel_frame for each group, with the fields that values() has given. */
    protected frames = 0;
    private readonly limbCounts: number[];
    private readonly componentCounts: Map<number, number>;
    /** Of each group, the fields that values() has given. */
    protected readonly held: Map<FieldNumber, Values>[];

    /** @internal */
    constructor(protected readonly memory: Memory, groups: readonly Group[], features: bigint, given: CrowdOptions) {
        if (typeof features !== "bigint" || features < 0n || features >> 64n) refuse(`features is ${shown(features)}; give a BigInt, such as Feature.WORLD`);
        if (!Array.isArray(groups)) refuse(`groups is ${shown(groups)}; give a list, such as [1000]`);
        const { shoulderOrder = 0, wristOrder = 0 } = options("crowd()", given, "shoulderOrder", "wristOrder");
        const defs = groups.map((group) => (typeof group === "number" ? { limbCount: group } : options("a group", group, "limbCount", "binding")));
        this.limbCounts = defs.map((def) => whole("limbCount", def.limbCount));
        this.held = defs.map(() => new Map());
        const create = (counts: number[], wanted: bigint): number =>
            memory.borrow((borrowed) => {
                const size = layout.swivel_group_def.bytes;
                const list = borrowed.bytes(size * counts.length);
                counts.forEach((count, n) => {
                    const def = new Structure(memory, "swivel_group_def", list + n * size).words("limb_count", count);
                    const binding = defs[n].binding;
                    if (binding) def.copy("binding", binding.bytes);
                });
                const def = borrowed.structure("swivel_crowd_def").wide("features", wanted);
                def.words("group_count", counts.length).words("groups", list);
                def.words("shoulder_order", whole("shoulderOrder", shoulderOrder)).words("wrist_order", whole("wristOrder", wristOrder));
                const crowd = borrowed.bytes(4);
                memory.check(memory.calls.swivel_crowd_create(def.at, crowd));
                return memory.words(crowd, 1)[0];
            });
        // A packed field's value has the numbers that it has without Feature.COMPACT.
        const one = create(this.limbCounts.slice(0, 1).fill(1), features & ~Feature.COMPACT);
        this.componentCounts = new Map(Object.values(Field).map((field) => [field, memory.calls.swivel_field_row_count(one, field)]));
        memory.calls.swivel_crowd_destroy(one);
        this.at = create(this.limbCounts, features);
        try {
            const frame = layout.swivel_frame.bytes;
            this.frames = memory.allocate(frame * groups.length);
            defs.forEach((_, n) => new Structure(memory, "swivel_frame", this.frames + n * frame));
        } catch (error) {
            this.dispose();
            throw error;
        }
    }

    /** The library's crowd. */
    protected get crowd(): number { return this.at || refuse("this crowd is disposed of"); }
    /**
     * Frees the crowd's memory. Other calls fail then. Let go of views of it: the next crowd may lie where they point.
     */
    dispose(): void {
        if (this.at === 0) return;
        this.memory.calls.swivel_crowd_destroy(this.at);
        for (const fields of this.held) for (const values of fields.values()) this.memory.free(values.byteOffset);
        this.memory.free(this.frames);
        this.at = 0;
    }

    get groupCount(): number { return this.limbCounts.length; }
    limbCount(group = 0): number {
        return this.limbCounts[group] ?? refuse(`group ${shown(group)} does not exist; the crowd has ${this.groupCount}`);
    }
    /** The index of a group's first limb in rows, masks and lists of limbs. */
    firstLimb(group = 0): number { return this.limbCount(group) && this.memory.calls.swivel_group_first_limb(this.crowd, group); }
    /** The numbers of a field's value; 0 if the crowd's features do not bring the field. */
    componentCount(field: FieldNumber): number { return this.componentCounts.get(field) ?? (nameOf(field), 0); }

    /**
     * The values of a field of a group, limb after limb, in swivel's own memory: no call copies them. From the first call
     * on, solves read an input from here and write a result here. The view stays valid until dispose().
     */
    values(field: typeof Field.FLAGS, group?: number): Uint32Array;
    values(field: FieldNumber, group?: number): Float32Array;
    values(field: FieldNumber, group = 0): Values {
        const limbCount = this.limbCount(group), components = this.componentCount(field);
        const held = this.crowd && this.held[group].get(field);
        if (held) return held;
        if (field >= Field.SHOULDER && this.compactRows().length > 0)
            refuse(`${nameOf(field)} of a crowd with Feature.COMPACT is packed: use read() or compactRows()`);
        const at = this.memory.allocate(Math.max(4 * components, 4) * limbCount);
        try {
            this.readTo(at, field, { group, first: 0, count: limbCount });
        } catch (error) {
            this.memory.free(at);
            throw error;
        }
        const values = this.view(field, at, limbCount);
        this.held[group].set(field, values);
        this.memory.words(this.frames + group * layout.swivel_frame.bytes + frameMembers[field], 2).set([at, 4 * components]);
        return values;
    }

    /** Sets an input: one value for all these limbs, or one for each. */
    write(field: FieldNumber, values: Numbers, limbs: Limbs = {}): void {
        const at = this.place(limbs);
        const components = this.componentCount(field), { length } = numbers(nameOf(field), values);
        const same = length === components || components === 0;  // the library refuses a field that the crowd lacks
        if (!same && length !== components * at.count)
            refuse(`${length} numbers for ${nameOf(field)} of ${at.count} limbs; give ${components}, or ${components} for each limb`);
        this.memory.borrow((borrowed) => this.writeFrom(borrowed.floats(values), same ? 0 : 4 * components, field, at));
        const held = this.held[at.group].get(field);
        if (held) this.readTo(held.byteOffset + 4 * components * at.first, field, at);
    }

    /** A copy of a field's values. */
    read(field: typeof Field.FLAGS, limbs?: Limbs): Uint32Array;
    read(field: FieldNumber, limbs?: Limbs): Float32Array;
    read(field: FieldNumber, limbs: Limbs = {}): Values {
        const at = this.place(limbs), components = this.componentCount(field);
        const held = this.crowd && this.held[at.group].get(field);
        if (held) return held.slice(at.first * components, (at.first + at.count) * components);
        return this.memory.borrow((borrowed) => {
            const to = borrowed.bytes(4 * Math.max(components, 1) * at.count);
            this.readTo(to, field, at);
            return this.view(field, to, at.count).slice();
        });
    }

    /** Rows of inputs in swivel's own memory, as swivel_rows says. A solve overwrites fields that values() has given. */
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
    fieldFirstRow(field: FieldNumber): number { return this.memory.calls.swivel_field_first_row(this.crowd, field); }
    /** A field's rows in a block. */
    fieldRowCount(field: FieldNumber): number { return this.memory.calls.swivel_field_row_count(this.crowd, field); }

    /** Checked, because WebAssembly takes everything for a number. */
    protected place(limbs: Limbs): Required<Limbs> {
        const { group = 0, first = 0, count } = options("a choice of limbs", limbs, "group", "first", "count");
        const left = this.limbCount(group) - whole("first", first, this.limbCount(group));
        return { group, first, count: count === undefined ? left : whole("count", count, left) };
    }
    /** Brings inputs that values() has given into the rows of their group, where calls look that are no solves. */
    protected settle(group: number): void {
        for (const [field, values] of this.held[group])
            if (field < Field.SHOULDER)
                this.writeFrom(values.byteOffset, 4 * this.componentCount(field), field, { group, first: 0, count: this.limbCount(group) });
    }
    /** Brings a result's rows into the view that values() has given. */
    protected refresh(field: FieldNumber, group: number): void {
        const held = this.held[group].get(field);
        if (held) this.readTo(held.byteOffset, field, { group, first: 0, count: this.limbCount(group) });
    }
    private view(field: FieldNumber, at: number, limbCount: number): Values {
        const length = this.componentCount(field) * limbCount;
        return field === Field.FLAGS ? this.memory.words(at, length) : this.memory.floats(at, length);
    }
    private writeFrom(from: number, stride: number, field: FieldNumber, { group, first, count }: Required<Limbs>): void {
        this.memory.borrow((borrowed) =>
            this.memory.check(this.memory.calls.swivel_write(this.crowd, field, group, first, count, borrowed.words([from, stride]))));
    }
    private readTo(to: number, field: FieldNumber, { group, first, count }: Required<Limbs>): void {
        this.memory.borrow((borrowed) => {
            const out = borrowed.words([to, 4 * Math.max(this.componentCount(field), 1)]);
            this.memory.check(this.memory.calls.swivel_read(this.crowd, field, group, first, count, out));
        });
    }
    /** swivel_words has the members of swivel_rows. */
    private rows(call: "swivel_input_rows" | "swivel_result_rows" | "swivel_compact_rows"): { at: number; length: number } {
        return this.memory.borrow((borrowed) => {
            const rows = borrowed.structure("swivel_rows");
            this.memory.calls[call](rows.at, this.crowd);
            const [at, blockCount, rowCount] = this.memory.words(rows.at, 3);
            return { at, length: blockCount * rowCount * LANES };
        });
    }
}
