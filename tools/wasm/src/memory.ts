// SPDX-License-Identifier: MIT
//
// The module's memory and the functions that it exports. Memory has a fixed size, so views of it stay valid.
import { Numbers, numbers, SwivelError } from "./arguments.js";
import { Functions, layout, Status } from "./layout.js";

/** The functions of the C headers, and those of the module itself. */
export interface Exports extends Functions {
    malloc(bytes: number): number;
    free(at: number): void;
    _initialize(): void;
}

type Layout = typeof layout;

/** A C structure in memory. Members that nobody sets are zero. */
export class Structure<Name extends keyof Layout> {
    constructor(private readonly memory: Memory, private readonly name: Name, readonly at: number) {
        memory.bytes(at, layout[name].bytes).fill(0);
        if ("size" in layout[name]) this.words("size" as keyof Layout[Name], layout[name].bytes);
    }
    private place(member: keyof Layout[Name]): number {
        return this.at + (layout[this.name][member] as unknown as number);
    }
    /** Pointers, sizes and counts. */
    words(member: keyof Layout[Name], ...values: number[]): this {
        this.memory.words(this.place(member), values.length).set(values);
        return this;
    }
    floats(member: keyof Layout[Name], values: Numbers): this {
        this.memory.floats(this.place(member), values.length).set(values);
        return this;
    }
    wide(member: keyof Layout[Name], value: bigint): this {
        new BigUint64Array(this.memory.buffer, this.place(member), 1)[0] = value;
        return this;
    }
    copy(member: keyof Layout[Name], bytes: Uint8Array): this {
        this.memory.bytes(this.place(member), bytes.length).set(bytes);
        return this;
    }
}

/** Memory that a call borrows: it is free again when the call ends. */
export interface Borrowed {
    bytes(count: number): number;
    structure<Name extends keyof Layout>(name: Name): Structure<Name>;
    floats(values: Numbers): number;
    doubles(values: Numbers): number;
    words(values: Numbers): number;
}

export class Memory {
    readonly buffer: ArrayBuffer;
    constructor(memory: WebAssembly.Memory, readonly calls: Exports) {
        this.buffer = memory.buffer;
    }

    bytes(at: number, count: number): Uint8Array { return new Uint8Array(this.buffer, at, count); }
    words(at: number, count: number): Uint32Array { return new Uint32Array(this.buffer, at, count); }
    floats(at: number, count: number): Float32Array { return new Float32Array(this.buffer, at, count); }
    doubles(at: number, count: number): Float64Array { return new Float64Array(this.buffer, at, count); }
    /** A text that ends with a zero. */
    text(at: number): string {
        const bytes = new Uint8Array(this.buffer, at);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    }

    check(status: number): void {
        if (status === Status.OK) return;
        const text = this.text(this.calls.swivel_last_error() >>> 0);
        throw status === Status.OUT_OF_MEMORY ? this.full(text) : new SwivelError(status, text);
    }
    allocate(bytes: number): number {
        const at = bytes < 2 ** 32 ? this.calls.malloc(bytes) >>> 0 : 0;  // pointers are unsigned, numbers of WebAssembly are not
        if (at === 0) throw this.full(`no memory for ${bytes} bytes`);
        return at;
    }
    free(at: number): void { this.calls.free(at); }
    private full(text: string): SwivelError {
        return new SwivelError(Status.OUT_OF_MEMORY, `${text}; give load() more megabytes, or dispose() of crowds`);
    }

    borrow<Result>(act: (borrowed: Borrowed) => Result): Result {
        const places: number[] = [];
        const bytes = (count: number): number => {
            places.push(this.allocate(Math.max(count, 8)));
            return places[places.length - 1];
        };
        const put = (array: Float32Array | Float64Array | Uint32Array, values: Numbers): number => {
            array.set(values);
            return array.byteOffset;
        };
        try {
            return act({
                bytes,
                structure: (name) => new Structure(this, name, bytes(layout[name].bytes)),
                floats: (values) => put(this.floats(bytes(4 * values.length), values.length), values),
                doubles: (values) => put(this.doubles(bytes(8 * values.length), values.length), values),
                words: (values) => put(this.words(bytes(4 * values.length), values.length), values),
            });
        } finally {
            for (const at of places) this.free(at);
        }
    }
    /** The floats that a call writes. */
    result(count: number, call: (out: number, borrowed: Borrowed) => number): Float32Array {
        return this.borrow((borrowed) => {
            const out = borrowed.bytes(4 * count);
            this.check(call(out, borrowed));
            return this.floats(out, count).slice();
        });
    }
}

/** An axis or a place in double, which a call borrows. */
export function vector(name: string, values: Numbers, borrowed: Borrowed): number {
    return borrowed.doubles(numbers(name, values, 3));
}
