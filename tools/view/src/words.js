// SPDX-License-Identifier: MIT
//
// Words and numbers as people read them: what a leg's parts are called, one format of numbers, indices set below their letters.
import { element } from "./dom.js";

/** A limb's word for people: "left arm". */
export const limbName = (limb) => limb.name.replace("_", " ");
export const kindOf = (limb) => limb.name.split("_")[1];

/** A leg's word for an arm's. Longer ones are first. */
const LEG = new Map(Object.entries({
    "upper arm": "thigh", humeral: "thigh", forearm: "shin", arm: "leg", shoulder: "hip", elbow: "knee", wrist: "ankle", hands: "feet", hand: "foot",
}));
const WORDS = new RegExp(`\\b(${[...LEG.keys()].join("|")})(?=(s|'s)?\\b)`, "gi");

/** A text about an arm, said of this limb. */
export function saidOf(limb, text) {
    if (kindOf(limb) !== "leg") return text;
    return text.replace(WORDS, (word) => {
        const other = LEG.get(word.toLowerCase());
        return word[0] < "a" ? other[0].toUpperCase() + other.slice(1) : other;
    });
}
/** The same of several limbs: "Shoulder cone or hip cone". */
export function saidOfAll(limbs, text) {
    const [first, ...others] = new Set(limbs.map((limb) => saidOf(limb, text)));
    return [first, ...others.map((each) => each[0].toLowerCase() + each.slice(1))].join(" or ");
}

/** A number in three digits, or in two and a power of ten where it is small or large, which takes two digits at least; a dash for none. */
export function number(value) {
    if (!Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    return Math.abs(value) >= 1e-3 && Math.abs(value) < 1e6 ? `${Number(value.toPrecision(3))}` : value.toExponential(1).replace(/e[+-](?=\d$)/, "$&0");
}
/** A coordinate to 1e-5 of a length: what is less is rounding. */
export function coordinate(value, length) {
    const digits = Math.min(12, Math.max(0, 5 - Math.ceil(Math.log10(length)))), unit = 10 ** digits;
    if (!Number.isFinite(value)) return `${value}`;
    return Math.abs(value) < 1e6 * length ? (Math.round(value * unit) / unit + 0).toFixed(digits) : `${Number(value.toPrecision(6))}`;
}

/** The library's names with an index below, and its blades. */
const NAMES = /\b(p_w|p_ze|p_e|pi_swivel|pi_M|pi_e|line_se|line_ew|l_M|q_e|q_s|q12|q3|c3|c4|S1|S2|e(?:[0-3]|inf))\b|\bpi\b|\^/g;
const LETTERS = { pi: "π", line: "l" };
/** Text with its names typeset: p_w as p with a small w below. A list of strings and elements. */
export function typeset(text) {
    const parts = [];
    let end = 0;
    for (const { 0: found, 1: name, index } of text.matchAll(NAMES)) {
        parts.push(text.slice(end, index));
        end = index + found.length;
        if (!name) {
            parts.push(found === "^" ? "∧" : "π");
            continue;
        }
        const [, letter, below] = name.match(/^([a-zA-Z]+)_(\w+)$/) ?? name.match(/^([a-zA-Z])(\w+)$/);
        parts.push(LETTERS[letter] ?? letter, element("sub", {}, below === "inf" ? "∞" : below));
    }
    return [...parts, text.slice(end)].filter((part) => part !== "");
}
