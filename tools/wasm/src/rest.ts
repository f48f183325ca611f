// SPDX-License-Identifier: MIT
//
// The rest pose of a skeleton, in which parts of poses start.
import type { Numbers } from "./arguments.js";
import type { Skeleton } from "./binding.js";
import { PoseForm } from "./layout.js";

/** Joints as poses have them: relative to their parents, or all to the root. */
export interface Rest {
    skeleton: Skeleton;
    form: number;
}
export const valueOf = (values: Numbers, count: number, joint: number): number[] => Array.from({ length: count }, (_, n) => values[count * joint + n]);

/** A copy of a skeleton's numbers. */
export function copyOf({ parents, translations, rotations }: Skeleton): Skeleton {
    return { parents: Array.from(parents), translations: Array.from(translations), rotations: rotations && Array.from(rotations) };
}
const unit = (q: number[]): number[] => q.map((x) => x / Math.hypot(...q));
/** Hamilton's product of quaternions x, y, z, w: b first, then a. */
const times = ([ax, ay, az, aw]: number[], [bx, by, bz, bw]: number[]): number[] =>
    [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
/** The same skeleton with all joints relative to the root. Its parents lead there. */
export function inBody({ parents, translations, rotations = Array.from(parents).flatMap(() => [0, 0, 0, 1]) }: Skeleton): Skeleton {
    const places: number[][] = [], turns: number[][] = [];
    const settle = (joint: number): void => {
        const parent = parents[joint], place = valueOf(translations, 3, joint), turn = unit(valueOf(rotations, 4, joint));
        places[joint] = place, turns[joint] = turn;
        if (parent < 0) return;
        const above = turns[parent], [x, y, z, w] = above, turned = times(times(above, [...place, 0]), [-x, -y, -z, w]);
        places[joint] = places[parent].map((v, n) => v + turned[n]), turns[joint] = times(above, turn);
    };
    for (let joint = 0; joint < parents.length; ++joint) {
        const unsettled: number[] = [];
        for (let at = joint; at >= 0 && !places[at]; at = parents[at]) unsettled.push(at);
        unsettled.reverse().forEach(settle);
    }
    return { parents, translations: places.flat(), rotations: turns.flat() };
}

/** A joint's rotation at rest, in the form of poses. */
export function rotationOf({ skeleton, form }: Rest, joint: number): number[] {
    const rotation = skeleton.rotations ? valueOf(skeleton.rotations, 4, joint) : [0, 0, 0, 1];
    if (form === PoseForm.ROTATIONS) return rotation;
    const [x, y, z, w] = rotation, s = 2 / (x * x + y * y + z * z + w * w), [a, b, c] = valueOf(skeleton.translations, 3, joint);
    const rows = [
        [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), a],
        [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), b],
        [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), c],
    ];
    if (form === PoseForm.MATRIX_ROWS) return rows.flat();
    if (form === PoseForm.MATRIX_COLUMNS) rows.push([0, 0, 0, 1]);
    return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
}
