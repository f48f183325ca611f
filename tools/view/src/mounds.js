// SPDX-License-Identifier: MIT
//
// Hills that the user has raised or sunk: round mounds, added to the heights that feet stand on.

const WIDE = 3;  // a mound's radius in lengths of the leg of who stands there; three cells of the grid at least
const STEEP = 0.5;  // how high a mound may be, in its radius
const NEAR = 0.25;  // of its radius: who stands so near to its middle moves that mound

export const hasHills = (stage) => stage.ground?.columns > 0;

/** Where a character stands: below its root. */
export function footingOf(stage, character) {
    const [x, , z] = stage.root(character);
    return [x, stage.groundHeight(x, z), z];
}
/** Puts stage.mounds, a list of { x, z, radius, height }, on the command's heights. */
export function putMounds(stage, mounds) {
    if (!hasHills(stage)) return;
    stage.mounds = mounds;
    const { columns, rows, size, middle, own, pointers } = stage.ground, heights = stage.memory.floats(pointers[1], own.length);
    const places = (axis, count) => Array.from({ length: count }, (_, n) => middle[axis] + size[axis] * (n / (count - 1) - 0.5));
    const xs = places(0, columns), zs = places(2, rows);
    heights.set(own);
    for (const { x, z, radius, height } of mounds)
        for (const [row, at] of zs.entries()) {
            if (Math.abs(at - z) >= radius) continue;
            for (const [column, from] of xs.entries()) {
                const share = 1 - ((from - x) ** 2 + (at - z) ** 2) / radius ** 2;
                if (share > 0) heights[row * columns + column] += height / size[1] * share ** 2;
            }
        }
}
/** A level mound below a character. Beyond the picture the ground is as at its edge, so it lies there. */
function newMound(stage, [x, z], character) {
    const { size, middle, columns, rows } = stage.ground;
    const within = (at, axis) => Math.min(Math.max(at, middle[axis] - size[axis] / 2), middle[axis] + size[axis] / 2);
    const radius = Math.max(WIDE * stage.legLength(character), 3 * size[0] / (columns - 1), 3 * size[2] / (rows - 1));
    return { x: within(x, 0), z: within(z, 2), radius, height: 0 };
}
/** Brings the ground below a character to a height in the world. One gesture, even of who walks on, moves one mound. */
export function dragMound(stage, character, [, wanted]) {
    const [x, , z] = footingOf(stage, character), isNear = (mound) => Math.hypot(mound.x - x, mound.z - z) < NEAR * mound.radius;
    const held = stage.isHeld ? stage.mounds.at(-1) : stage.mounds.find(isNear), others = stage.mounds.filter((each) => each !== held);
    const mound = stage.isHeld ? held : { ...(held ?? newMound(stage, [x, z], character)), at: [x, z] }, { radius, at } = mound;  // at: where it is held
    const heightWith = (height) => {
        putMounds(stage, [...others, { ...mound, height }]);
        return stage.groundHeight(...at);
    };
    const without = heightWith(0), rise = heightWith(radius) - without;  // the spline makes it a little less than the radius
    heightWith(Math.min(STEEP * radius, Math.max(-STEEP * radius, radius * (wanted - without) / rise)));
}
