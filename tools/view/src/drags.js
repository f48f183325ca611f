// SPDX-License-Identifier: MIT
//
// Goals that the user has moved: one alone, which then stays in its place, or everyone's of a limb, by one shift for all.

const PARTS = ["target", "pole"];
export const NO_SHIFT = { target: [0, 0, 0], pole: [0, 0, 0] };

/** A vector of length 1; as it is where it has none. */
export function unit(vector) {
    const length = Math.hypot(...vector);
    return Array.from(vector, (part) => (length > 0 ? part / length : part));
}
const keyOf = (limb, character) => `${limb.index}:${character}`;

const isPartShifted = (limb, part) => limb.shift[part].some((number) => number !== 0);
export const isShifted = (limb) => PARTS.some((part) => isPartShifted(limb, part));
/** Which of a limb's goals the user has moved, "target" or "pole". */
export const movedParts = (stage, limb, character) => PARTS.filter((part) => isPartShifted(limb, part) || stage.pins.get(keyOf(limb, character))?.[part]);

/** Moves a limb's goals, which the stage has just filled in, to where the user wants them. */
export function moveGoals(stage, limb) {
    for (const part of PARTS) if (isPartShifted(limb, part)) shiftAll(stage, limb, part);
    for (const [key, pin] of stage.pins) {
        const [index, character] = key.split(":").map(Number);
        if (index !== limb.index) continue;
        for (const part of PARTS) if (pin[part]) stage.setGoal(limb, character, part, stage.toGoal(limb, character, part, pin[part]));
    }
}
/** Points go by the shift times the character's size, directions of length 1 by the shift itself. */
function shiftAll(stage, limb, part) {
    const shift = limb.shift[part], isPoint = stage.isPoint(limb, part);
    stage.characters.forEach(({ size }, n) => {
        const asked = stage.input(limb, n, part);
        const to = isPoint ? asked.map((number, axis) => number + size * shift[axis]) : unit(unit(asked).map((number, axis) => number + shift[axis]));
        stage.setGoal(limb, n, part, to);
    });
}

/** world: where the goal of this character goes. */
export function dragOne(stage, limb, character, part, world) {
    const key = keyOf(limb, character);
    stage.pins.set(key, { ...stage.pins.get(key), [part]: world });
}
/** The same for everyone's. Those that were moved alone go along again. */
export function dragEveryone(stage, limb, character, part, world) {
    for (const [key, { [part]: _, ...rest }] of stage.pins) {
        if (Number(key.split(":")[0]) !== limb.index) continue;
        if (Object.keys(rest).length > 0) stage.pins.set(key, rest);
        else stage.pins.delete(key);
    }
    stage.askGoals();
    const asked = stage.input(limb, character, part), wanted = stage.toGoal(limb, character, part, world);
    const shift = stage.isPoint(limb, part) ? wanted.map((coordinate, axis) => (coordinate - asked[axis]) / stage.characters[character].size)
        : unit(wanted).map((coordinate, axis) => coordinate - unit(asked)[axis]);
    limb.shift = { ...limb.shift, [part]: shift };
}
/** A limb's goals are the clip's again, and everyone's of that limb. */
export function dropDrags(stage, limb, character) {
    stage.pins.delete(keyOf(limb, character));
    limb.shift = NO_SHIFT;
}
export function dropAllDrags(stage) {
    stage.pins.clear();
    for (const limb of stage.limbs) limb.shift = NO_SHIFT;
}
