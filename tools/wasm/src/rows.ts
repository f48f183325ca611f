// SPDX-License-Identifier: MIT
//
// A crowd's memory: what goes in and what comes out.
import { FieldNumber, nameOf, Numbers, numbers, options, refuse, shown, whole } from "./arguments.js";
import { CheckedGroup, create, SharedSkeleton } from "./groups.js";
import { Field, LANES, layout, positions, RESULT_END } from "./layout.js";
import { Borrowed, Memory, Structure } from "./memory.js";

/** Which limbs of a group. Left out: group 0, from its first limb on, up to its last. */
export interface Limbs {
    group?: number;
    first?: number;
    count?: number;
}

export type Values = Float32Array | Uint32Array;

export function isPosition(field: FieldNumber): boolean { return (positions as readonly FieldNumber[]).includes(field); }

export class CrowdRows {
    private at = 0;
    private readonly groups: CheckedGroup[];
    /** A swivel_streams for each group, which lists the fields that values() has given. */
    protected streams = 0;
    /** Of each group, the fields that values() has given. */
    protected readonly held: Map<FieldNumber, Values>[];
    private readonly owned: number[] = [];
    /** Of bodies: the swivel_pose of every solve. */
    protected posed = 0;
    /** Of bodies: whether positions in streams are doubles. */
    protected isDouble = false;

    /** @internal */
    constructor(protected readonly memory: Memory, given: readonly CheckedGroup[], bodies?: SharedSkeleton) {
        this.at = create(memory, given, bodies);
        const { calls } = memory;
        this.groups = given.map((group, n) => ({
            ...group, kind: calls.swivel_group_kind(this.at, n), features: BigInt.asUintN(64, calls.swivel_group_features(this.at, n)),
        }));
        this.held = given.map(() => new Map());
        this.orDispose(() => {
            const { bytes } = layout.swivel_streams;
            this.streams = memory.allocate(bytes * given.length);
            given.forEach((_, n) => new Structure(memory, "swivel_streams", this.streams + n * bytes));
        });
    }
    /** Acts; where that fails nothing of this crowd is left. */
    protected orDispose(act: () => void): void {
        try {
            act();
        } catch (error) {
            this.dispose();
            throw error;
        }
    }
    /** Memory that is the crowd's until it is disposed of. */
    protected own(bytes: number): number {
        this.owned.push(this.memory.allocate(bytes));
        return this.owned[this.owned.length - 1];
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
        for (const at of this.owned) this.memory.free(at);
        if (this.streams) this.held.forEach((_, group) => this.memory.free(this.listOf(group)[0]));
        this.memory.free(this.streams);
        this.at = 0;
    }

    get groupCount(): number { return this.groups.length; }
    /** Blocks of 16 limbs, of which each group starts one. */
    get blockCount(): number { return this.memory.calls.swivel_block_count(this.crowd); }
    limbCount(group = 0): number { return this.group(group).limbCount; }
    /** The features that a group of limbs was made with. */
    features(group = 0): bigint { return this.group(group).features; }
    /** The kind of a group, from Kind. */
    kind(group = 0): number { return this.group(group).kind; }
    private group(group: number): CheckedGroup {
        return this.groups[group] ?? refuse(`group ${shown(group)} does not exist; the crowd has ${this.groupCount}`);
    }
    /** The index of a group's first limb in rows and masks. */
    firstLimb(group = 0): number { return this.limbCount(group) && this.memory.calls.swivel_group_first_limb(this.crowd, group); }
    /** The numbers of a field's value, each of which is a row of a block; 0 if the group does not have the field. */
    componentCount(field: FieldNumber, group = 0): number {
        return nameOf(field) ? this.rowsOf("swivel_field_row_count", field, group) : 0;
    }

    /**
     * The values of a field of a group, limb after limb, in swivel's own memory: no call copies them. From the first call
     * on, solves read an input from here and write a result here. The view stays valid until dispose().
     */
    values(field: typeof Field.FLAGS, group?: number): Uint32Array;
    values(field: FieldNumber, group?: number): Float32Array;
    values(field: FieldNumber, group = 0): Values {
        const limbCount = this.limbCount(group), components = this.componentCount(field, group);
        if (this.isDouble && isPosition(field)) refuse(`${nameOf(field)} is in doubles, as the root is; positions() gives it`);
        const held = this.crowd && this.held[group].get(field);
        if (held) return held;
        const at = this.memory.allocate(Math.max(4 * components, 4) * limbCount);
        try {
            this.readTo(at, field, { group, first: 0, count: limbCount });
            this.list(group, [field, at, 4 * components]);
        } catch (error) {
            this.memory.free(at);
            throw error;
        }
        const values = this.view(field, at, limbCount, components);
        this.held[group].set(field, values);
        return values;
    }

    /** Sets an input, or sets back what read() gave of a result that is carried: one value for all these limbs, or one for each. */
    write(field: FieldNumber, values: Numbers, limbs: Limbs = {}): void {
        const at = this.place(limbs);
        const components = this.componentCount(field, at.group), { length } = numbers(nameOf(field), values);
        const same = length === components || components === 0;  // the library refuses a field that the group lacks
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
        const at = this.place(limbs), components = this.componentCount(field, at.group);
        const held = this.crowd && this.held[at.group].get(field);
        if (held) return held.slice(at.first * components, (at.first + at.count) * components);
        return this.memory.borrow((borrowed) => {
            const to = borrowed.bytes(4 * Math.max(components, 1) * at.count);
            this.readTo(to, field, at);
            return this.view(field, to, at.count, components).slice();
        });
    }

    /** A group's rows of inputs in swivel's own memory, as swivel_rows says. A solve overwrites fields that values() has given. */
    inputRows(group = 0): Float32Array {
        const { at, length } = this.rows("swivel_input_rows", group);
        return this.memory.floats(at, length);
    }
    resultRows(group = 0): Float32Array {
        const { at, length } = this.rows("swivel_result_rows", group);
        return this.memory.floats(at, length);
    }
    /** A group's results in 16-bit words, a copy, as swivel_pack says. */
    pack(group = 0): Uint16Array {
        const count = Math.ceil(this.limbCount(group) / LANES), rows = this.rowsOf("swivel_packed_row", RESULT_END, group);
        return this.memory.borrow((borrowed) => {
            const words = borrowed.bytes(2 * rows * count * LANES);
            this.memory.check(this.memory.calls.swivel_pack(this.crowd, group, borrowed.words([0, count]), words));
            return new Uint16Array(this.memory.buffer, words, rows * count * LANES).slice();
        });
    }
    /** The row of words in which a field begins. */
    packedRow(field: FieldNumber, group = 0): number { return this.rowsOf("swivel_packed_row", field, group); }
    /** A field's first row in a block of the group. */
    fieldFirstRow(field: FieldNumber, group = 0): number { return this.rowsOf("swivel_field_first_row", field, group); }

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
                this.writeFrom(values.byteOffset, 4 * this.componentCount(field, group), field, { group, first: 0, count: this.limbCount(group) });
    }
    /** Brings a result's rows into the view that values() has given. */
    protected refresh(field: FieldNumber, group: number): void {
        const held = this.held[group].get(field);
        if (held) this.readTo(held.byteOffset, field, { group, first: 0, count: this.limbCount(group) });
    }
    /** The streams of these groups alone. */
    protected streamsOf(groups: readonly number[], borrowed: Borrowed): number {
        const { bytes } = layout.swivel_streams, streams = borrowed.bytes(bytes * groups.length);
        const of = (place: number): Uint8Array => this.memory.bytes(place, bytes);
        groups.forEach((group, n) => of(streams + n * bytes).set(of(this.streams + group * bytes)));
        return streams;
    }
    /** Where a group's streams say which fields they list, and how many. */
    protected listOf(group: number): Uint32Array {
        const { bytes, fields } = layout.swivel_streams;
        return this.memory.words(this.streams + group * bytes + fields, 2);
    }
    /** Adds a swivel_stream to a group's streams. */
    protected list(group: number, field: number[]): void {
        const [before, count] = this.listOf(group), size = field.length, list = this.memory.allocate(4 * size * (count + 1));
        const fields = this.memory.words(list, size * (count + 1));
        fields.set(this.memory.words(before, size * count)), fields.set(field, size * count);
        this.listOf(group).set([list, count + 1]);
        this.memory.free(before);
    }
    private view(field: FieldNumber, at: number, limbCount: number, components: number): Values {
        const length = components * limbCount;
        return field === Field.FLAGS ? this.memory.words(at, length) : this.memory.floats(at, length);
    }
    private writeFrom(from: number, stride: number, field: FieldNumber, { group, first, count }: Required<Limbs>): void {
        this.memory.borrow((borrowed) =>
            this.memory.check(this.memory.calls.swivel_write(this.crowd, field, group, first, count, borrowed.words([from, stride]))));
    }
    private readTo(to: number, field: FieldNumber, { group, first, count }: Required<Limbs>): void {
        this.memory.borrow((borrowed) => {
            const out = borrowed.words([to, 4 * Math.max(this.componentCount(field, group), 1)]);
            this.memory.check(this.memory.calls.swivel_read(this.crowd, field, group, first, count, out));
        });
    }
    private rowsOf(call: "swivel_field_first_row" | "swivel_field_row_count" | "swivel_packed_row", field: number, group: number): number {
        this.group(group);
        return this.memory.calls[call](this.crowd, group, field);
    }
    private rows(call: "swivel_input_rows" | "swivel_result_rows", group: number): { at: number; length: number } {
        this.group(group);
        return this.memory.borrow((borrowed) => {
            const rows = borrowed.structure("swivel_rows");
            this.memory.calls[call](rows.at, this.crowd, group);
            const [at, blockCount, rowCount] = this.memory.words(rows.at, 3);
            return { at, length: blockCount * rowCount * LANES };
        });
    }
}
