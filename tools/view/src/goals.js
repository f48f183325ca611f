// SPDX-License-Identifier: MIT
//
// Where goals are seen: where the solver has sent a limb, in the world that is drawn. On ground a body is shifted, and what does not count
// goes along with it; a foot is sent where it stands, not where the clip has it.
import { unit } from "./drags.js";

/** By how much a character's body is higher than its root says. */
export const shiftOf = (stage, character) => (stage.ground ? stage.rootMember(character, "shift")[0] : 0);
const raised = ([x, y, z], by) => [x, y + by, z];

/** By how much higher a goal is seen than it is asked for. */
function riseOf(stage, limb, character, part) {
    if (!stage.isPoint(limb, part)) return shiftOf(stage, character);
    if (part === "target" && stage.has(limb, "LIFT")) return stage.read(limb, character, "LIFT")[0];
    const counts = part === "target" ? !stage.goesAlong(limb, character) : stage.poleCounts(limb, character);
    return counts ? 0 : shiftOf(stage, character);
}
/** Whether the library made the target: of a hand that holds another, and of a foot that stands, unless the user drags it. */
const isSent = (stage, limb, character) => stage.has(limb, "SOLVED_GOAL") && !(stage.isHeld && stage.movedParts(limb, character).includes("target"));

/** part: "target" or "pole". A direction is seen at the end of the limb. */
export function seenGoal(stage, limb, character, part) {
    if (part === "target" && isSent(stage, limb, character)) return stage.toWorld(character, stage.read(limb, character, "SOLVED_GOAL").subarray(0, 3));
    const asked = Array.from(stage.input(limb, character, part)), rise = riseOf(stage, limb, character, part);
    if (stage.isPoint(limb, part)) return raised(asked, rise);
    const origin = raised(stage.origin(limb, character), rise), length = stage.armLength(limb, character);
    return unit(asked).map((coordinate, axis) => length * coordinate + origin[axis]);
}
/** What to ask for, as a place in the world, so that a goal is seen at this one. A goal counts once it is moved. */
export function askedFor(stage, limb, character, part, world) {
    const isRaised = !stage.isPoint(limb, part) || (part === "target" && stage.has(limb, "LIFT"));
    return isRaised ? raised(world, -riseOf(stage, limb, character, part)) : world;
}
