// SPDX-License-Identifier: MIT
//
// Hips that the user has moved up or down. Where feet stand on ground, a body wishes for a shift, and comes as near to it as its legs reach.
import { memberOf, sizeOf } from "./bytes.js";
import { shiftOf } from "./goals.js";

export const legsOf = (stage) => stage.limbs.filter((limb) => stage.has(limb, "PLANT"));
export const hasHips = (stage) => legsOf(stage).length > 0;

/** The middle of the hips in the world. */
export function hipsOf(stage, character) {
    const places = legsOf(stage).map((leg) => stage.shoulder(leg, character));
    return [0, 1, 2].map((axis) => places.reduce((sum, place) => sum + place[axis], 0) / places.length);
}
/** Puts the wishes of stage.hips, a map from characters to heights, in place of those of the command. */
export function putHips(stage, hips) {
    stage.hips = hips;
    const at = (n) => stage.charactersAt + n * sizeOf("goal_character");
    stage.characters.forEach(({ wish }, n) => { memberOf(stage.memory.buffer, at(n), "goal_character", "wish")[0] = hips.get(n) ?? wish; });
}
/** Moves hips to the height of a place in the world, and everyone's by as much of their size, if asked. */
export function dragHips(stage, character, [, height], everyone) {
    const shift = shiftOf(stage, character), { characters } = stage;
    const wished = height - (hipsOf(stage, character)[1] - shift), by = (wished - characters[character].wish) / characters[character].size;
    putHips(stage, everyone ? new Map(characters.map(({ wish, size }, n) => [n, wish + size * by])) : new Map(stage.hips).set(character, wished));
}
export function dropHips(stage, character) {
    const hips = new Map(stage.hips);
    hips.delete(character);
    putHips(stage, hips);
}
