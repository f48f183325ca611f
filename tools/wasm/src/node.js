// SPDX-License-Identifier: MIT
//
// Node reads swivel.wasm from the package's folder, because its fetch() takes no files.
import { readFile } from "node:fs/promises";
import { load as loadWasm } from "./index.js";

export * from "./index.js";
export async function load(given = {}) {
    if (typeof given !== "object" || given?.wasm !== undefined) return loadWasm(given);
    return loadWasm({ ...given, wasm: await readFile(new URL("./swivel.wasm", import.meta.url)) });
}
