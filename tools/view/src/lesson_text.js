// SPDX-License-Identifier: MIT
//
// The lecture's words: its steps, its entities as they are named and coloured, and their coefficients as text.

export const STEPS = [
    ["1. The elbow point", "The elbow is one bone away from the shoulder and one from the wrist. So it lies on two spheres, and in the swivel " +
        "plane. All three meet in two points. The elbow is the one on the pole's side."],
    ["2. The elbow quaternion", "The lines of both bones enclose the flexion. Half-angle formulas turn its cosine into a rotation. No arc cosine " +
        "is needed."],
    ["3. The middle line", "At rest the elbow is on e3. The plane in the middle between there and the elbow, and the plane through both, meet in a " +
        "line."],
    ["4. Rotate to the elbow", "A turn by half a circle about the middle line carries the elbow at rest to the elbow. The line itself is this " +
        "rotation."],
    ["5. Rotate to the wrist", "A turn about the upper arm is left: it brings the forearm into the swivel plane. Both turns together are the " +
        "shoulder's rotation."],
];
export const COLOURS = {
    p_w: "#ffd34d", pi_swivel: "#b48bff", S1: "#38c6c0", S2: "#4aa3ff", PP: "#e2588f", p_e: "#e0433b",
    line_se: "#4aa3ff", line_ew: "#38c6c0", q_e: "#e2588f",
    p_ze: "#8d99a8", pi_M: "#58a968", pi_e: "#98a2b0", l_M: "#ff8a5c", q12: "#ff8a5c", q3: "#b48bff", q_s: "#e0433b",
};
// Vectors before the units i, j and k; einf and e0 last.
const BLADES = [0, 8, 16, 24].flatMap((nulls) => [0, 1, 2, 4, 6, 5, 3, 7].map((euclidean) => nulls | euclidean));

/** An entity as text, with what is not rounding beside its largest coefficient. */
export function textOf(swivel, { coefficients }) {
    const max = Math.max(...coefficients.map(Math.abs));
    const terms = BLADES.filter((blade) => Math.abs(coefficients[blade]) > 1e-12 * max).map((blade, n) => {
        const number = coefficients[blade], sign = number < 0 ? "−" : n > 0 ? "+" : "";
        const unit = swivel.bladeName(blade);
        return `${n > 0 ? ` ${sign} ` : sign}${Math.abs(number).toPrecision(5)}${blade === 0 ? "" : ` ${unit}`}`;
    });
    return terms.join("") || "0";
}
