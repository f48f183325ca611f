// SPDX-License-Identifier: MIT
//
// usage: node tools/view/bundle.mjs WASM_FOLDER PAGE
// Puts the page's program, three.js with its licence, and the wasm module into one HTML file. WASM_FOLDER: where tools/wasm was built.
import { readFile, rename, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const [wasmFolder, page] = process.argv.slice(2);
if (!page) {
    console.error("usage: node tools/view/bundle.mjs WASM_FOLDER PAGE");
    process.exit(2);
}
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const { outputFiles } = await build({
    entryPoints: [here("src/main.js")], bundle: true, write: false, format: "iife", globalName: "swivelView", minify: true, charset: "utf8",
    target: "es2022", legalComments: "none", nodePaths: [here("node_modules")],
    loader: { ".wasm": "binary", ".css": "text", ".glsl": "text" },
    alias: { "swivel-wasm": `${wasmFolder}/package`, "view.wasm": `${wasmFolder}/swivel_view.wasm` },
    define: { "import.meta.url": "location.href" },  // where the package looks for its own module, which the page brings
});
const program = outputFiles[0].text.replaceAll("</script", "<\\/script");
const shell = await readFile(here("page.html"), "utf8"), licence = await readFile(here("node_modules/three/LICENSE"), "utf8");
if (licence.includes("--")) throw new Error("three's licence cannot stand in a comment of HTML");
const notice = `<!--\nThis page's program has three.js in it.\n\n${licence.trim()}\n-->`;
await writeFile(`${page}.partial`, shell.replace("<!--notices-->", () => notice).replace("/*program*/", () => program));
await rename(`${page}.partial`, page);
