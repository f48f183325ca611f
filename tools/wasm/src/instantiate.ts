// SPDX-License-Identifier: MIT
//
// From the bytes of a module to its memory and functions.
import { options, refuse, shown } from "./arguments.js";
import { Exports, Memory } from "./memory.js";

type Wasm = BufferSource | Response | URL | string;
export interface LoadOptions {
    /** The size of the memory, which never changes: 2 to 4096, 64 if left out. It holds crowds and their values. */
    megabytes?: number;
    /** swivel.wasm: where to fetch it, a response that brings it, or its bytes. Left out: the file beside this module. */
    wasm?: Wasm | Promise<Wasm>;
}

async function bytesOf(given: Wasm): Promise<BufferSource> {
    if (typeof given === "string" || given instanceof URL) return bytesOf(await fetch(given));
    if (typeof Response === "undefined" || !(given instanceof Response)) return given as BufferSource;
    if (!given.ok) refuse(`cannot load ${given.url}: ${given.status} ${given.statusText}`);
    return given.arrayBuffer();
}

function checkWasm(bytes: BufferSource): void {
    if (WebAssembly.validate(bytes)) return;
    const start = new TextDecoder().decode(bytes).slice(0, 4);
    if (start !== "\0asm") refuse(`what came is not swivel.wasm: it starts with ${JSON.stringify(start)}; look at the address and the server`);
    refuse("swivel.wasm does not run here: it needs WebAssembly with SIMD, or the file is damaged");
}

/** Compiles the module and gives it its memory. */
export async function instantiate(given: LoadOptions): Promise<Memory> {
    const { megabytes = 64, wasm = new URL("./swivel.wasm", import.meta.url) } = options("load()", given, "megabytes", "wasm");
    if (!(megabytes >= 2 && megabytes <= 4096)) refuse(`megabytes is ${shown(megabytes)}; give 2 to 4096`);
    const bytes = await bytesOf(await wasm);
    checkWasm(bytes);
    const pages = Math.floor(megabytes * 16);
    const memory = new WebAssembly.Memory({ initial: pages, maximum: pages });
    // malloc() would tell of growth, which never comes. The library asks for SWIVEL_FORCE_ISA; there are no variables here.
    const env = { memory, emscripten_notify_memory_growth: (): void => undefined };
    const wasi_snapshot_preview1 = {
        environ_sizes_get(count: number, size: number): number {
            const numbers = new DataView(memory.buffer);
            for (const at of [count, size]) numbers.setUint32(at >>> 0, 0, true);
            return 0;
        },
        environ_get: (): number => 0,
    };
    const { instance } = await WebAssembly.instantiate(bytes, { env, wasi_snapshot_preview1 });
    const exports = instance.exports as unknown as Exports;
    exports._initialize();
    return new Memory(memory, exports);
}
