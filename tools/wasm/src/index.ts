// SPDX-License-Identifier: MIT
//
// swivel for JavaScript: the library of swivel.h as WebAssembly. README.md has a first program.
import { Exports, Memory } from "./memory.js";
import { Swivel } from "./swivel.js";

export { Binding } from "./binding.js";
export type { Chain, LimbJoints, Skeleton } from "./binding.js";
export { Crowd } from "./crowd.js";
export type { Arc, CrowdOptions, FieldNumber, Group, Job, Limbs } from "./crowd.js";
export { Feature, Field, Flag, LANES, MOST_TWIST_BONES, Order, Status, VERSION } from "./layout.js";
export { SwivelError } from "./memory.js";
export type { Numbers } from "./memory.js";
export type { Swivel } from "./swivel.js";

export interface LoadOptions {
    /** The size of the memory, which never changes: 2 to 4096, 64 if left out. It holds crowds and their values. */
    megabytes?: number;
    /** swivel.wasm: its bytes, or a response that brings them. Left out: the file beside this module. */
    wasm?: BufferSource | Response | Promise<BufferSource | Response>;
}

async function bytesOf(given: BufferSource | Response): Promise<BufferSource> {
    if (typeof Response === "undefined" || !(given instanceof Response)) return given as BufferSource;
    if (!given.ok) throw new Error(`cannot load ${given.url}: ${given.status} ${given.statusText}`);
    return given.arrayBuffer();
}

/** Makes a solver in a memory of its own. */
export async function load(options: LoadOptions = {}): Promise<Swivel> {
    const megabytes = options.megabytes ?? 64;
    if (!(megabytes >= 2 && megabytes <= 4096)) throw new RangeError(`megabytes is ${megabytes}; give 2 to 4096`);
    const bytes = await bytesOf(await (options.wasm ?? fetch(new URL("./swivel.wasm", import.meta.url))));
    if (!WebAssembly.validate(bytes))
        throw new Error("swivel.wasm does not run here: it needs WebAssembly with SIMD (Chrome 91, Firefox 89, Safari 16.4, Node 16.4 or later)");
    const pages = Math.floor(megabytes * 16);
    const memory = new WebAssembly.Memory({ initial: pages, maximum: pages });
    // malloc() would tell of growth, which never comes. The library asks for SWIVEL_FORCE_ISA; there are no variables here.
    const env = { memory, emscripten_notify_memory_growth: (): void => undefined };
    const wasi_snapshot_preview1 = {
        environ_sizes_get(count: number, size: number): number {
            const numbers = new DataView(memory.buffer);
            for (const at of [count, size]) numbers.setUint32(at, 0, true);
            return 0;
        },
        environ_get: (): number => 0,
    };
    const { instance } = await WebAssembly.instantiate(bytes, { env, wasi_snapshot_preview1 });
    const exports = instance.exports as unknown as Exports;
    exports._initialize();
    return new Swivel(new Memory(memory, exports));
}
