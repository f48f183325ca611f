// SPDX-License-Identifier: MIT
//
// The page's colours, light and dark, and what a limb's colour may say. limb.frag.glsl has the same ranges of error, flexion and slide.
import { Flag } from "swivel-wasm/layout.js";
import { Color } from "three";

export const THEMES = {
    light: { background: "#e9edf2", ground: "#dfe4ea", line: "#c3cad3", sky: "#9aa3ad", earth: "#6f6a66", body: "#b3bbc6", shade: "#bcc4cd" },
    dark: { background: "#12161c", ground: "#171c23", line: "#2a323d", sky: "#7e8894", earth: "#3d4148", body: "#69758a", shade: "#0b0e12" },
};
export const LIMB_COLOURS = ["#f08a3c", "#3f97e8", "#e2588f", "#2eb39a"];  // of the limbs, in their order
export const CHOSEN = "#ffd34d";
export const BOX = "#b08a57";  // that characters carry
export const HIPS = "#63b5ff";  // the ball that moves them
export const GROUND = "#8fd16a";  // the one that moves the ground
export const CONE = "#ff5fa8";  // the ball on the rim of the shoulder's limit

const RAMP = ["#2c7fb8", "#41b6a6", "#d9e26a", "#f6a03c", "#d7301f"];
const LIMITED = Object.keys(Flag).filter((name) => name.startsWith("LIMITED_"));
/** Names, colours and flags. A limb takes the last whose flags it has, the first if it has none. */
const FLAGS = [["reached", "#58a968"], ["softened or stretched", "#9fd356", "SOFTENED", "STRETCHED"],
    ["out of reach", "#e8a33d", "CLAMPED_FAR", "CLAMPED_NEAR"], ["limited", "#a877d8", ...LIMITED, "JUMPED"], ["infeasible", "#d6409f", "INFEASIBLE"],
    ["swivel undefined", "#6f7f92", "SWIVEL_UNDEFINED"], ["bad input", "#e0433b", "BAD_INPUT"]];

/** What a limb's colour says: the legend's entries, from the least on. */
export const COLOUR_BY = [
    { name: "Limb", legend: [] },
    { name: "Error", unit: "from the target, in lengths of the limb", legend: RAMP.map((colour, n) => [colour, n < 4 ? `1e-0${8 - 2 * n}` : "1"]) },
    { name: "Flag", legend: FLAGS.map(([name, colour]) => [colour, name]) },
    { name: "Flexion", unit: "degrees", legend: RAMP.map((colour, n) => [colour, `${Math.round(37.5 * n)}`]) },
    { name: "Slide", needs: "PLANT", unit: "of a foot that is down, in leg lengths a second; all else is grey",
        legend: RAMP.map((colour, n) => [colour, ["0.001", "0.006", "0.03", "0.2", "1"][n]]) },
];

/** A colour as the shaders take it: the screen's own numbers. */
export function rgb(css) {
    return new Color().setStyle(css, "srgb-linear");
}
/** The CSS of a colour 0xRRGGBBAA without its opacity. */
export const cssOf = (color) => `#${(color >>> 8).toString(16).padStart(6, "0")}`;
export const rampColours = () => RAMP.map(rgb);
export const flagColours = () => FLAGS.map(([, colour]) => rgb(colour));
export const flagMasks = () => FLAGS.map(([, , ...flags]) => flags.reduce((word, name) => word | Flag[name], 0));
