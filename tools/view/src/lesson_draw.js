// SPDX-License-Identifier: MIT
//
// What each step of the lecture draws, in the arm frame.
import { Vector3 } from "three";

import { COLOURS } from "./lesson_text.js";
import { ball, dashes, disc, sphere, tube, Z } from "./marks.js";

const ORIGIN = new Vector3(), X = new Vector3(1, 0, 0);

export const vectorOf = ({ coefficients }) => new Vector3(coefficients[1], coefficients[2], coefficients[4]);
const lineOf = ({ coefficients }) => new Vector3(coefficients[6], coefficients[5], coefficients[3]);
const times = (vector, factor) => vector.clone().multiplyScalar(factor);
const half = (a, b) => a.clone().add(b).multiplyScalar(0.5);
const flexionOf = (elbow, wrist) => elbow.angleTo(wrist.clone().sub(elbow));

/** The elbow's two candidates: p_e, and its mirror image in the line from shoulder to wrist. */
function pairOf(elbow, wrist) {
    const along = wrist.clone().normalize(), foot = times(along, elbow.dot(along));
    return [elbow, foot.multiplyScalar(2).sub(elbow)];
}
/** From a to b about an axis, by the right hand. */
function signedAngle(a, b, axis) {
    const flat = (v) => v.clone().addScaledVector(axis, -v.dot(axis)), from = flat(a), to = flat(b);
    return Math.atan2(from.clone().cross(to).dot(axis), from.dot(to));
}
/** A way of short tubes; at(share) is a place on it. */
function way(add, at, pieces, thickness, colour) {
    for (let n = 0; n < pieces; ++n) add(tube(at(n / pieces), at((n + 1) / pieces), 0.7 * thickness, colour));
}

/** For each step: entities by their names, the bones, and add(shape, name, at): a shape or null, and an entity's label with its place. */
export const DRAW = [
    ({ p_w, p_e, pi_swivel }, { upper, fore, thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), other = pairOf(elbow, wrist)[1], middle = times(wrist, 0.5);
        add(sphere(ORIGIN, upper, COLOURS.S2), "S2", times(Z, -upper));
        add(sphere(wrist, fore, COLOURS.S1), "S1", times(wrist, 1 + fore / wrist.length()));
        add(disc(middle, vectorOf(pi_swivel), 1.1 * upper, COLOURS.pi_swivel), "pi_swivel", middle);
        add(ball(wrist, 3 * thickness, COLOURS.p_w), "p_w", wrist);
        add(ball(other, 2.4 * thickness, COLOURS.PP), "PP", other);
        add(ball(elbow, 3 * thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_w, p_e }, { thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), beyond = times(elbow, 1.6);
        add(tube(ORIGIN, beyond, thickness, COLOURS.line_se), "line_se", times(elbow, 0.5));
        add(tube(elbow, wrist, thickness, COLOURS.line_ew), "line_ew", half(elbow, wrist));
        add(ball(elbow, 2 * thickness, COLOURS.p_e), "c4", beyond);
        const along = elbow.clone().normalize(), hinge = along.clone().cross(wrist.clone().sub(elbow)).normalize(), bend = flexionOf(elbow, wrist);
        const at = (share) => elbow.clone().addScaledVector(along.clone().applyAxisAngle(hinge, bend * share), 30 * thickness);
        way(add, at, 16, thickness, COLOURS.q_e);
        add(null, "q_e", at(0.5));
    },
    ({ p_ze, p_e, l_M, pi_M, pi_e }, { upper, thickness }, add) => {
        const rest = vectorOf(p_ze), elbow = vectorOf(p_e), line = lineOf(l_M).setLength(1.3 * upper), normal = vectorOf(pi_M);
        add(disc(ORIGIN, normal, upper, COLOURS.pi_M), "pi_M", line.clone().cross(normal).setLength(0.9 * upper));
        add(disc(ORIGIN, vectorOf(pi_e), upper, COLOURS.pi_e, 0.16), "pi_e", times(half(rest, elbow), -0.8));
        add(tube(times(line, -1), line, thickness, COLOURS.l_M), "l_M", line);
        add(ball(rest, 3 * thickness, COLOURS.p_ze), "p_ze", rest);
        add(ball(elbow, 3 * thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_ze, p_e, l_M }, { upper, thickness }, add) => {
        const rest = vectorOf(p_ze), elbow = vectorOf(p_e), axis = lineOf(l_M).normalize(), end = times(axis, 1.3 * upper);
        add(tube(times(end, -1), end, thickness, COLOURS.q12), "q12", end);
        way(add, (share) => rest.clone().applyAxisAngle(axis, Math.PI * share), 24, thickness, COLOURS.q12);
        add(tube(ORIGIN, rest, 0.8 * thickness, COLOURS.p_ze), "p_ze", rest);
        add(tube(ORIGIN, elbow, thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_w, p_e, pi_swivel, q12 }, { fore, thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), along = elbow.clone().normalize(), middle = times(wrist, 0.5);
        const bent = Z.clone().applyAxisAngle(X, -flexionOf(elbow, wrist)), before = bent.applyAxisAngle(lineOf(q12).normalize(), Math.PI);
        before.multiplyScalar(fore);
        const turn = signedAngle(before, wrist.clone().sub(elbow), along);
        const at = (share) => elbow.clone().add(before.clone().applyAxisAngle(along, turn * share));
        add(disc(middle, vectorOf(pi_swivel), 0.8 * wrist.length(), COLOURS.pi_swivel, 0.14), "pi_swivel", times(wrist, 0.35));
        add(dashes(elbow, at(0), 0.6 * thickness, COLOURS.p_ze), "c3", at(0));
        way(add, at, 24, thickness, COLOURS.q3);
        add(null, "q3", at(0.5));
        add(tube(ORIGIN, elbow, thickness, COLOURS.q_s), "q_s", times(elbow, 0.5));
        add(tube(elbow, wrist, thickness, COLOURS.q_s), "p_w", wrist);
    },
];
