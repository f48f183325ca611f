// SPDX-License-Identifier: MIT
//
// Hills that the user has raised or sunk: round mounds, added to the heights that feet stand on.

const WIDE = 3;  // from a mound's middle to its rim, in lengths of the leg of who stands there
const STEEP = 0.5;  // of its rim's distance: how high it may be

export const hasHills = (stage) => stage.ground?.columns > 0;

/** Where a character stands: below its root. */
export function footingOf(stage, character) {
    const [x, , z] = stage.root(character);
    return [x, stage.groundHeight(x, z), z];
}
/** Puts stage.mounds, a list of { x, z, rim, height }, on the command's heights. */
export function putMounds(stage, mounds) {
    if (!hasHills(stage)) return;
    stage.mounds = mounds;
    const { columns, rows, size, middle, own, pointers } = stage.ground, heights = stage.memory.floats(pointers[1], own.length);
    const places = (axis, count) => Array.from({ length: count }, (_, n) => middle[axis] + size[axis] * (n / (count - 1) - 0.5));
    const xs = places(0, columns), zs = places(2, rows);
    heights.set(own);
    for (const { x, z, rim, height } of mounds)
        for (const [row, at] of zs.entries()) {
            if (Math.abs(at - z) >= rim) continue;
            for (const [column, from] of xs.entries()) {
                const share = 1 - ((from - x) ** 2 + (at - z) ** 2) / rim ** 2;
                if (share > 0) heights[row * columns + column] += height / size[1] * share ** 2;
            }
        }
}
/** Raises or sinks the ground to a height in the world, round where a character stands: by one mound, as long as it is held. */
export function dragMound(stage, character, [, wanted]) {
    const held = stage.isHeld ? stage.mounds.at(-1) : undefined, others = held ? stage.mounds.slice(0, -1) : stage.mounds;
    const { size, columns, rows } = stage.ground, [x, , z] = held ? [held.x, 0, held.z] : footingOf(stage, character);
    const rim = held?.rim ?? Math.max(WIDE * stage.legLength(character), 3 * size[0] / (columns - 1), 3 * size[2] / (rows - 1));
    const heightWith = (height) => {
        putMounds(stage, [...others, { x, z, rim, height }]);
        return stage.groundHeight(x, z);
    };
    const without = heightWith(0), rise = heightWith(rim) - without;  // which the spline makes a little less than the rim's distance
    const height = rim * (wanted - without) / rise;
    heightWith(Math.min(STEEP * rim, Math.max(-STEEP * rim, height)));
}
