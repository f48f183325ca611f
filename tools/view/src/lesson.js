// SPDX-License-Identifier: MIT
//
// The lecture, one step at a time, on the chosen limb: each entity is drawn, named and written out, while the arm may be
// dragged. The entities are the library's own: swivel_steps().
import { Group, Vector3 } from "three";

import { button, element, section } from "./dom.js";
import { ball, clear, disc, dashes, sphere, tube, Z } from "./marks.js";
import { geometryOf } from "./overlays.js";

const STEPS = [
    ["1. The elbow point", "The elbow is one bone away from the shoulder and one from the wrist. So it lies on two spheres, and in the swivel plane. " +
        "All three meet in two points. The elbow is the one on the pole's side."],
    ["2. The elbow quaternion", "The lines of both bones enclose the flexion. Half-angle formulas turn its cosine into a rotation. No arc cosine is needed."],
    ["3. The middle line", "At rest the elbow is on e3. The plane in the middle between there and the elbow, and the plane through both, meet in a line."],
    ["4. Rotate to the elbow", "A turn by half a circle about the middle line carries the elbow at rest to the elbow. The line itself is this rotation."],
    ["5. Rotate to the wrist", "A turn about the upper arm is left: it brings the forearm into the swivel plane. Both turns together are the shoulder's rotation."],
];
const COLOURS = { p_w: "#ffd34d", pi_swivel: "#b48bff", S1: "#38c6c0", S2: "#4aa3ff", PP: "#e2588f", p_e: "#e0433b", line_se: "#4aa3ff", line_ew: "#38c6c0", q_e: "#e2588f",
    p_ze: "#8d99a8", pi_M: "#58a968", pi_e: "#98a2b0", l_M: "#ff8a5c", q12: "#ff8a5c", q3: "#b48bff", q_s: "#e0433b" };
const SHOWN = { p_w: "p_w", pi_swivel: "π_swivel", S1: "S₁", S2: "S₂", PP: "PP", p_e: "p_e", line_se: "l_se", line_ew: "l_ew", c4: "c₄", q_e: "q_e", p_ze: "p_ze",
    pi_M: "π_M", pi_e: "π_e", l_M: "l_M", q12: "q₁₂", c3: "c₃", q3: "q₃", q_s: "q_s" };
// Vectors before the units i, j and k; einf and e0 last.
const BLADES = [0, 8, 16, 24].flatMap((nulls) => [0, 1, 2, 4, 6, 5, 3, 7].map((euclidean) => nulls | euclidean));

const vectorOf = (entity) => new Vector3(entity.coefficients[1], entity.coefficients[2], entity.coefficients[4]);

/** An entity as text, with what is not rounding beside its largest coefficient. */
function textOf(swivel, { coefficients }) {
    const most = Math.max(...coefficients.map(Math.abs));
    const terms = BLADES.filter((blade) => Math.abs(coefficients[blade]) > 1e-12 * most).map((blade, n) => {
        const number = coefficients[blade], sign = number < 0 ? "−" : n > 0 ? "+" : "";
        const unit = swivel.bladeName(blade).replaceAll("^", "∧").replaceAll("einf", "e∞");
        return `${n > 0 ? ` ${sign} ` : sign}${Math.abs(number).toPrecision(5)}${blade === 0 ? "" : ` ${unit}`}`;
    });
    return terms.join("") || "0";
}

/** The elbow's two candidates: p_e, and its mirror image in the line from shoulder to wrist. */
function pairOf(elbow, wrist) {
    const along = wrist.clone().normalize(), foot = along.clone().multiplyScalar(elbow.dot(along));
    return [elbow, foot.multiplyScalar(2).sub(elbow)];
}

/** What each step draws: add(shape, name, at) with the place of the entity's label. */
const draw = [
    ({ p_w, p_e, pi_swivel }, { upper, fore, thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), pair = pairOf(elbow, wrist);
        add(sphere(new Vector3(), upper, COLOURS.S2), "S2", new Vector3(0, 0, -upper));
        add(sphere(wrist, fore, COLOURS.S1), "S1", wrist.clone().addScaledVector(wrist, fore / wrist.length()));
        add(disc(wrist.clone().multiplyScalar(0.5), vectorOf(pi_swivel), 1.1 * upper, COLOURS.pi_swivel), "pi_swivel", wrist.clone().multiplyScalar(0.5));
        add(ball(wrist, 3 * thickness, COLOURS.p_w), "p_w", wrist);
        add(ball(pair[1], 2.4 * thickness, COLOURS.PP), "PP", pair[1]);
        add(ball(elbow, 3 * thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_w, p_e }, { thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), beyond = elbow.clone().multiplyScalar(1.6);
        add(tube(new Vector3(), beyond, thickness, COLOURS.line_se), "line_se", elbow.clone().multiplyScalar(0.5));
        add(tube(elbow, wrist, thickness, COLOURS.line_ew), "line_ew", elbow.clone().add(wrist).multiplyScalar(0.5));
        add(ball(elbow, 2 * thickness, COLOURS.p_e), "c4", beyond);
        const along = elbow.clone().normalize(), hinge = along.clone().cross(wrist.clone().sub(elbow)).normalize(), bend = flexionOf(elbow, wrist);
        const at = (share) => elbow.clone().addScaledVector(along.clone().applyAxisAngle(hinge, bend * share), 30 * thickness);
        for (let n = 0; n < 16; ++n) add(tube(at(n / 16), at((n + 1) / 16), 0.7 * thickness, COLOURS.q_e), n === 8 ? "q_e" : undefined, at(0.5));
    },
    ({ p_ze, p_e, l_M, pi_M, pi_e }, { upper, thickness }, add) => {
        const rest = vectorOf(p_ze), elbow = vectorOf(p_e), line = lineOf(l_M).setLength(1.3 * upper);
        add(disc(new Vector3(), vectorOf(pi_M), upper, COLOURS.pi_M), "pi_M", lineOf(l_M).cross(vectorOf(pi_M)).setLength(0.9 * upper));
        add(disc(new Vector3(), vectorOf(pi_e), upper, COLOURS.pi_e, 0.16), "pi_e", rest.clone().add(elbow).multiplyScalar(-0.4));
        add(tube(line.clone().negate(), line, thickness, COLOURS.l_M), "l_M", line);
        add(ball(rest, 3 * thickness, COLOURS.p_ze), "p_ze", rest);
        add(ball(elbow, 3 * thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_ze, p_e, l_M }, { upper, thickness }, add) => {
        const rest = vectorOf(p_ze), elbow = vectorOf(p_e), axis = lineOf(l_M).normalize();
        add(tube(axis.clone().multiplyScalar(-1.3 * upper), axis.clone().multiplyScalar(1.3 * upper), thickness, COLOURS.q12), "q12", axis.clone().multiplyScalar(1.3 * upper));
        const at = (share) => rest.clone().applyAxisAngle(axis, Math.PI * share);
        for (let n = 0; n < 24; ++n) add(tube(at(n / 24), at((n + 1) / 24), 0.7 * thickness, COLOURS.q12));
        add(tube(new Vector3(), rest, 0.8 * thickness, COLOURS.p_ze), "p_ze", rest);
        add(tube(new Vector3(), elbow, thickness, COLOURS.p_e), "p_e", elbow);
    },
    ({ p_w, p_e, pi_swivel, q12 }, { fore, thickness }, add) => {
        const wrist = vectorOf(p_w), elbow = vectorOf(p_e), axis = lineOf(q12), along = elbow.clone().normalize();
        const before = Z.clone().applyAxisAngle(new Vector3(1, 0, 0), -flexionOf(elbow, wrist)).applyAxisAngle(axis.normalize(), Math.PI).multiplyScalar(fore);
        const turn = signedAngle(before, wrist.clone().sub(elbow), along), at = (share) => elbow.clone().add(before.clone().applyAxisAngle(along, turn * share));
        add(disc(wrist.clone().multiplyScalar(0.5), vectorOf(pi_swivel), 0.8 * wrist.length(), COLOURS.pi_swivel, 0.14), "pi_swivel", wrist.clone().multiplyScalar(0.35));
        add(dashes(elbow, at(0), 0.6 * thickness, COLOURS.p_ze));
        for (let n = 0; n < 24; ++n) add(tube(at(n / 24), at((n + 1) / 24), 0.7 * thickness, COLOURS.q3), n === 12 ? "q3" : n === 1 ? "c3" : undefined, at(n === 1 ? 0 : 0.5));
        add(tube(new Vector3(), elbow, thickness, COLOURS.q_s), "q_s", elbow.clone().multiplyScalar(0.5));
        add(tube(elbow, wrist, thickness, COLOURS.q_s), "p_w", wrist);
    },
];
function lineOf({ coefficients }) { return new Vector3(coefficients[6], coefficients[5], coefficients[3]); }
function flexionOf(elbow, wrist) { return elbow.angleTo(wrist.clone().sub(elbow)); }
/** From a to b about an axis, by the right hand. */
function signedAngle(a, b, axis) {
    const flat = (v) => v.clone().addScaledVector(axis, -v.dot(axis)), from = flat(a), to = flat(b);
    return Math.atan2(from.clone().cross(to).dot(axis), from.dot(to));
}

export function makeLesson(page) {
    const { stage, view } = page, frame = new Group(), labels = element("div", { class: "labels", "aria-hidden": "true" });
    let step = 0, places = [];
    const title = element("h3"), text = element("p"), list = element("dl", { class: "entities" }), closing = element("p", { class: "hint" });
    const go = (steps) => {
        step = (step + steps + STEPS.length) % STEPS.length;
        update();
        page.redraw();
    };
    const box = section("The lecture, step by step", false, element("div", { class: "lesson" }, title, text, list, closing,
        element("div", { class: "row" }, button("Back", () => go(-1)), button("Next", () => go(1)))));
    view.marks.add(frame);
    document.body.append(labels);

    const add = (shape, name, at) => {
        frame.add(shape);
        if (name) places.push({ at, label: element("span", { style: `--swatch: ${COLOURS[name] ?? "#8d99a8"}` }, SHOWN[name]) });
    };
    const explain = (made) => {
        [title.textContent, text.textContent] = STEPS[step];
        const now = made.entities.filter((entity) => entity.step === step + 1);
        list.replaceChildren(...now.flatMap((entity) => [
            element("dt", { title: entity.meaning }, element("i", { class: "swatch", style: `--swatch: ${COLOURS[entity.name] ?? "transparent"}` }), SHOWN[entity.name]),
            element("dd", {}, textOf(stage.swivel, entity), element("small", {}, entity.meaning)),
        ]));
        closing.textContent = `Both rotations put the wrist ${made.closingError.toExponential(1)} arm lengths from the target.`;
    };
    const refuse = (why) => {
        [title.textContent] = STEPS[step];
        text.textContent = `The lecture's formulas have no answer here. ${why}.`;
        list.replaceChildren();
        closing.textContent = "The solver takes other forms of them, which hold for every arm.";
    };
    const update = () => {
        clear(frame);
        places = [];
        frame.visible = box.open;
        if (box.open) {
            const selection = page.selection ?? { limb: stage.limbs[0], character: 0 };
            const { limb, character } = selection, geometry = geometryOf(stage, selection), back = geometry.armAxes.clone().invert();
            const { upper, fore } = geometry, inArm = (vector) => vector.clone().applyQuaternion(back).toArray();
            frame.position.fromArray(stage.origin(limb, character));
            frame.scale.set(limb.mirrored ? -1 : 1, 1, 1);
            frame.quaternion.copy(geometry.armAxes);
            if (limb.mirrored) frame.quaternion.set(frame.quaternion.x, -frame.quaternion.y, -frame.quaternion.z, frame.quaternion.w);
            try {
                const made = stage.swivel.steps(inArm(geometry.target), inArm(geometry.pole), upper, fore);
                draw[step](Object.fromEntries(made.entities.map((entity) => [entity.name, entity])), { upper, fore, thickness: 0.008 * (upper + fore) }, add);
                explain(made);
            } catch (error) {
                refuse(error.message.replace("swivel_steps: ", ""));
            }
        }
        labels.replaceChildren(...places.map(({ label }) => label));
    };
    /** Labels stand where their entities are seen. */
    const placeLabels = () => {
        for (const { at, label } of places) {
            const pixel = view.projectScene(frame.localToWorld(at.clone()));
            label.hidden = pixel === null;
            if (pixel) label.style.transform = `translate(${pixel.x + 8}px, ${pixel.y - 22}px)`;
        }
    };
    box.addEventListener("toggle", () => {
        page.overlays.hide(box.open);
        if (box.open) box.scrollIntoView({ block: "nearest" });
        update();
        page.redraw();
    });
    box.addEventListener("keydown", (event) => {
        if (event.key === "ArrowRight" || event.key === "ArrowLeft") go(event.key === "ArrowRight" ? 1 : -1);
    });
    page.on("frame", update);
    page.on("select", update);
    page.on("draw", placeLabels);
    return { box, go, get step() { return step; } };
}
