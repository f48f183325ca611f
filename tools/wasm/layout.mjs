// SPDX-License-Identifier: MIT
//
// usage: node tools/wasm/layout.mjs HEADERS         prints C++ that compiles if numbers, sizes and offsets are those of HEADERS, tools/headers/headers.json
//        node tools/wasm/layout.mjs HEADERS WASM    prints src/layout.ts
//
// layout.ts has the numbers of the headers' names, where members of structures lie in WebAssembly's memory, and the functions of the module WASM.
// The library itself describes what features need, what fields are, and the constants of groups.
import { readFileSync } from "node:fs";

const [file, wasm] = process.argv.slice(2), headers = JSON.parse(readFileSync(file, "utf8"));
const all = (kind) => Object.assign({}, ...Object.values(headers).map((header) => header[kind]));
const structures = all("structures"), enumerations = all("enumerations"), constants = all("constants");
const starts = { Plant: "plant", Ground: "ground", Look: "look_def", Prop: "prop_def", Shift: "shift_def" };  // constants of groups

/** A build stops where the headers have another number, size or offset. The test `headers` compares the rest: types, defaults and functions. */
function checks() {
    const facts = [constants, ...Object.values(enumerations)].flatMap(Object.entries);
    for (const [name, { wasm32, members }] of Object.entries(structures))
        facts.push([`sizeof(${name})`, wasm32], ...Object.entries(members).map(([member, { wasm32: at }]) => [`offsetof(${name}, ${member})`, at]));
    const includes = Object.keys(headers).map((name) => `#include "${name === "goals" ? "tools/crowd" : "swivel"}/${name}.h"\n`);
    return [...includes, ...facts.map(([name, value]) => `static_assert(${name} == ${value}, "run tools/headers/describe");\n`)].join("");
}

async function load() {
    const memory = new WebAssembly.Memory({ initial: 32, maximum: 32 }), none = () => 1;  // the status where there is no environment
    const env = { memory, emscripten_notify_memory_growth() {} }, wasi_snapshot_preview1 = { environ_sizes_get: none, environ_get: none };
    const { instance: { exports } } = await WebAssembly.instantiate(readFileSync(wasm), { env, wasi_snapshot_preview1 });
    exports._initialize();
    return { exports, bytes: Buffer.from(memory.buffer) };
}

/** The rows that a function of the module describes, as objects with the members of a structure. */
function table({ exports, bytes }, describe, { wasm32: size, members }) {
    const word = (at) => bytes.readUInt32LE(at), text = (at) => bytes.toString("utf8", word(at), bytes.indexOf(0, word(at)));
    const read = { "const char *": text, float: (at) => bytes.readFloatLE(at), swivel_features: (at) => `${bytes.readBigUInt64LE(at)}n` };
    const row = exports.malloc(size), rows = [];
    while (exports[describe](rows.length, row))
        rows.push(Object.fromEntries(Object.entries(members).map(([name, { type, wasm32 }]) => [name, (read[type] ?? word)(row + wasm32)])));
    return rows;
}

/** How TypeScript calls a function: structures are where their bytes are, and one that is returned is a first parameter. */
function signature(name, { returns, parameters }) {
    const type = (of) => (/^(uint64_t|swivel_features)$/.test(of) ? "bigint" : of === "void" ? of : "number"), isStructure = returns in structures;
    const given = Object.entries({ ...(isStructure && { result: "size_t" }), ...parameters }).map(([parameter, of]) => `${parameter}: ${type(of)}`);
    return `    ${name}(${given.join(", ")}): ${isStructure ? "void" : type(returns)};\n`;
}

/** Lines of an object, from the names and values of its members. */
const object = (members) => `{\n${members.map((member) => `    ${member.join(": ")},\n`).join("")}}`;

function enumeration(name) {
    const members = Object.entries(enumerations[`swivel_${name}`]).filter(([member]) => !member.endsWith("_END"));
    return object(members.map(([member, value]) => [member.replace(/SWIVEL_(KIND_)?/, ""), value]));
}

/** All names in a text. */
const camel = (text) => text.replace(/_(.)/g, (_, letter) => letter.toUpperCase());
const isOfEachJoint = (count) => count === constants.SWIVEL_MAX_LOOK_JOINTS;

/** Members of an interface: constants as options of a group. Bounds are as long as messages have them. */
function options(rows) {
    const type = (count) => [count > 1 && "ArrayLike<number>", (count === 1 || isOfEachJoint(count)) && "number"].filter(Boolean).join(" | ");
    const bound = (x) => (Math.abs(x) < 1e6 ? x : x.toExponential(0));
    return rows.map(({ name, unit, text, count, min, max }) =>
        `    /** ${text[0].toUpperCase()}${camel(text.slice(1))} (${unit && `${unit}, `}${bound(min)} to ${bound(max)}). */\n    ${camel(name)}?: ${type(count)};\n`).join("");
}

/** The members of a structure that src writes as floats side by side. It writes the others of definitions by their names. */
function floatsOf(structure) {
    const others = structure.endsWith("_def") ? ["size", "joint", "joint_count", "joints", "reserved"] : [];
    const floats = Object.entries(structures[`swivel_${structure}`].members).filter(([member]) => !others.includes(member));
    let next = floats[0][1].wasm32;
    for (const [member, { type, count, wasm32 }] of floats) {
        if (type !== "float" || wasm32 !== next) throw new Error(`tools/wasm/src does not know how to write swivel_${structure}.${member}`);
        next += 4 * count;
    }
    return floats;
}

/** One value stands for those of all joints of a look. */
function defaults(name) {
    const members = Object.entries(structures[`swivel_${name}`].members).filter(([, member]) => "default" in member);
    return object(members.map(([member, { count, default: value }]) => [camel(member), JSON.stringify(isOfEachJoint(count) ? value[0] : value)]));
}

async function layout() {
    const module = await load(), features = table(module, "swivel_describe_feature", structures.swivel_feature_info);
    const fields = table(module, "swivel_describe_field", structures.swivel_field_info);
    const ofGroups = table(module, "swivel_describe_constant", structures.swivel_constant_info);
    const optionsOf = (name) => options(ofGroups.filter(({ structure }) => structure === name.toLowerCase()));
    const fieldsThat = (test) => `[${fields.filter(test).map(({ name }) => `Field.${name.toUpperCase()}`).join(", ")}]`;
    const enums = { Field: "field", Flag: "flag", Kind: "kind", Order: "euler_order", OnBadInput: "on_bad_input", PoseForm: "pose_form",
        PoseSpace: "pose_space", Status: "status" };
    const places = ({ wasm32, members }) => [`bytes: ${wasm32}`, ...Object.entries(members).map(([name, member]) => `${name}: ${member.wasm32}`)];
    const firstFloats = ["Look", "Prop", "Shift"].map((name) => [name.toLowerCase(), `"${floatsOf(starts[name])[0][0]}"`]);
    const ofEachJoint = floatsOf("look_def").filter(([, { count }]) => isOfEachJoint(count)).map(([name]) => camel(name));
    const counts = ["LANES", "MAX_TWIST_BONES", "MAX_LOOK_JOINTS", "ENTITY_COUNT", "EXPLANATION_BYTES"];
    return `// SPDX-License-Identifier: MIT
// Made by layout.mjs from the C headers.

export const Feature = ${object(features.map(({ name, feature }) => [name, feature]))} as const;

/** A free limb with a feature has all that this needs, and nothing that it excludes. Bit k of kinds: groups of Kind k may have it. */
export const featureRules: Record<keyof typeof Feature, { needs: bigint; excludes: bigint; kinds: number }> = ${
        object(features.map(({ name, needs, excludes, kinds }) => [name, `{ needs: ${needs}, excludes: ${excludes}, kinds: ${kinds} }`]))};

${Object.keys(enums).map((name) => `export const ${name} = ${enumeration(enums[name])} as const;\n\n`).join("")}\
/** Results that the next solve starts from. */
export const carried = ${fieldsThat(({ kind }) => kind === enumerations.swivel_field_kind.SWIVEL_FIELD_CARRIED)} as const;

/** Fields that may be given in doubles. */
export const positions = ${fieldsThat((field) => field.is_position === 1)} as const;

${Object.keys(starts).map((name) => `export const default${name} = ${defaults(starts[name])} as const;
export interface ${name}Constants {\n${optionsOf(name)}}\n\n`).join("")}\
/** The first of the floats that a definition has side by side. */
export const firstFloat = ${object(firstFloats)} as const;

/** The constants that a look has for each of its joints. */
export const ofEachJoint: readonly string[] = ${JSON.stringify(ofEachJoint)};

// In bytes: the size of each structure, and where its members start.
export const layout = ${object(Object.keys(structures).filter((name) => name.startsWith("swivel_")).map((name) => [name, `{ ${places(structures[name]).join(", ")} }`]))} as const;

${counts.map((name) => `export const ${name} = ${constants[`SWIVEL_${name}`]};\n`).join("")}\
export const RESULT_END = ${enumerations.swivel_field.SWIVEL_RESULT_END};
export const VERSION = "${["MAJOR", "MINOR", "PATCH"].map((part) => constants[`SWIVEL_VERSION_${part}`]).join(".")}";

export interface Functions {
${Object.entries(all("functions")).filter(([name]) => name in module.exports).map(([name, each]) => signature(name, each)).join("")}}
`;
}

// What src takes for granted: some structures are so many words, others have floats side by side.
const words = { swivel_stream: 3, swivel_joint_values: 4, swivel_supports: 4 };
for (const name in words) if (structures[name].wasm32 !== 4 * words[name]) throw new Error(`tools/wasm/src writes ${name} as ${words[name]} words`);
for (const structure of ["region_cone", ...Object.values(starts)]) floatsOf(structure);
process.stdout.write(wasm ? await layout() : checks());
