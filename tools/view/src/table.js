// SPDX-License-Identifier: MIT
//
// The goals that the user has moved, as a table that `swivel solve --targets` reads (docs/motion_files.md), in all
// frames.
import { element } from "./dom.js";

const MAX_ROWS = 2e6;

/** What the user sees and the table does not hold: a sentence, or nothing. The crowd file's own pole comes before a table's. */
export function lackOf(stage) {
    const isPoleLost = (limb) => limb.hasFixedPole && stage.characters.some((_, n) => stage.movedParts(limb, n).includes("pole"));
    const lacks = [[stage.limbs.some(({ own }) => own.size > 0), "limits and weights"], [stage.limbs.some(isPoleLost), "poles that the crowd file sets"], [stage.hips.size > 0, "hips that were moved"], [stage.mounds.length > 0, "the ground that was moved"],
        [stage.given.size > 0, "the table that this page was made with"]];
    const names = lacks.filter(([isLack]) => isLack).map(([, name]) => name);
    return names.length > 0 ? `The table does not hold ${names.join(", nor ")}.` : "";
}

/** A number that reads back as the same double. */
const text = (number) => (Object.is(number, -0) ? "-0" : `${number}`);

function rowOf(stage, limb, character, withPole) {
    const target = stage.input(limb, character, "target").map((coordinate, axis) => coordinate - limb.targetOffset[axis]);  // which solve adds again
    const pole = withPole ? Array.from(stage.input(limb, character, "pole"), text) : ["", "", ""];
    return `${[stage.frame, character, limb.name, ...Array.from(target, text), ...pole]}\n`;
}

export function saveTable(page) {
    const { stage } = page;
    const all = stage.limbs.flatMap((limb) => stage.characters.map((_, character) => ({ limb, character, parts: stage.movedParts(limb, character) })));
    const moved = all.filter(({ parts }) => parts.length > 0), rows = moved.length * stage.frameCount, count = (number) => number.toLocaleString("en");
    if (rows > MAX_ROWS)
        return page.say(`This table would have ${count(rows)} rows, and ${count(MAX_ROWS)} are the most: move fewer characters' goals, or take fewer --frames.`);
    const { frame: shown } = stage, lines = ["frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n"];
    for (let frame = 0; frame < stage.frameCount; ++frame) {
        stage.askMovedGoals(frame);
        lines.push(moved.map(({ limb, character, parts }) => rowOf(stage, limb, character, parts.includes("pole") && !limb.hasFixedPole)).join(""));
    }
    stage.askMovedGoals(shown);
    const href = URL.createObjectURL(new Blob(lines, { type: "text/csv" }));
    element("a", { href, download: "targets.csv" }).click();
    setTimeout(() => URL.revokeObjectURL(href), 60_000);  // some browsers read it late
    page.say("");
}
