// SPDX-License-Identifier: MIT
//
// Node reads swivel.wasm from the package's folder; its fetch() takes no files.
import { readFile } from "node:fs/promises";
import { load as loadWasm } from "./index.js";

export * from "./index.js";
export const load = async (options = {}) => loadWasm({ wasm: await readFile(new URL("./swivel.wasm", import.meta.url)), ...options });
