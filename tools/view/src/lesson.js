// SPDX-License-Identifier: MIT
//
// The lecture, one step at a time, on the chosen limb: each entity is drawn, named and written out, while the arm may be
// dragged. The entities are the library's own: swivel_steps().
import { Group, Quaternion, Vector3 } from "three";

import { button, element, section } from "./dom.js";
import { DRAW, vectorOf } from "./lesson_draw.js";
import { COLOURS, STEPS, textOf } from "./lesson_text.js";
import { clear } from "./marks.js";
import { geometryOf } from "./overlays.js";
import { Feature, SwivelError } from "./stage.js";
import { number, saidOf, typeset } from "./words.js";

const OFF = 1e-4;  // arm lengths between solver and steps that are worth a word: a hundred times what floats leave
const REACHED = 1e-6, STRAIGHT = 1e-9;  // arm lengths: as near counts as there, and what the lecture's circle needs
const TURNED = 0.1;  // degrees from the pole's own elbow that are worth a word

/** Where the wrist goes, relative to the shoulder: the target less the effector, as the hand's goal turns it. */
function wristGoal(stage, { limb, character }, { target }) {
    if (!stage.has(limb, "EFFECTOR")) return target;
    const { size } = stage.characters[character], turn = stage.has(limb, "SOLVED_GOAL") ? stage.read(limb, character, "SOLVED_GOAL").subarray(3) : stage.input(limb, character, "hand");
    const hand = new Quaternion().fromArray(turn).normalize();
    return target.clone().addScaledVector(new Vector3().fromArray(stage.read(limb, character, "EFFECTOR")).applyQuaternion(hand), -size);
}
/** A straight arm's wrist is at the end of its reach, whatever rounding makes of the target's distance. */
function withinReach(wrist, reach) {
    return Math.abs(wrist.length() - reach) < REACHED * reach ? wrist.setLength((1 - STRAIGHT) * reach) : wrist;
}
/** From the line between shoulder and wrist to the elbow; null if the arm is straight. */
function offLine({ elbow, along, upper }) {
    const off = elbow.clone().addScaledVector(along, -elbow.dot(along));
    return off.length() > 1e-3 * upper ? off : null;
}
/** Where the elbow would go by the pole alone, or without one as in the clip, or else where it is: at right angles to the line. */
function wishOf(stage, { limb, character }, { pole, normal, elbow, along }) {
    const features = stage.featuresOf(limb), counts = stage.poleCounts(limb, character), isNormal = (features & Feature.POLE_NORMAL) !== 0n;
    const followsRule = (features & (Feature.POLE_HAND | Feature.POLE_HALF_LINE)) !== 0n;
    const wish = followsRule ? elbow.clone() : counts && !isNormal ? pole.clone() : (counts ? pole : normal).clone().cross(along);
    return wish.addScaledVector(along, -wish.dot(along)).normalize();
}
/** The pole that gives the solver's elbow: that elbow, or where it would go if the arm is straight. */
function poleFor(stage, selection, geometry) {
    return offLine(geometry) ? geometry.elbow : wishOf(stage, selection, geometry);
}
/** How far the elbow is turned from where the limb's own pole wishes it, in degrees. */
function turnedBy(stage, selection, geometry) {
    const off = offLine(geometry), wish = wishOf(stage, selection, geometry);
    return off && wish.lengthSq() > 0 ? off.angleTo(wish) * 180 / Math.PI : 0;
}

/** The steps of the chosen limb: what they start from and what the library makes of it, or why it makes nothing. */
function stepsOf(stage, selection) {
    const geometry = geometryOf(stage, selection), { upper, fore } = geometry, back = geometry.armAxes.clone().invert();
    const inArm = (vector) => vector.clone().applyQuaternion(back);
    if (stage.featuresOf(selection.limb) & Feature.WITH_AIM)
        return { geometry, why: "This limb aims: its hand points at the target, and no place is given for its wrist" };
    const wrist = withinReach(inArm(wristGoal(stage, selection, geometry)), upper + fore), pole = inArm(poleFor(stage, selection, geometry));
    try {
        const made = stage.swivel.steps(wrist.toArray(), pole.toArray(), upper, fore);
        const entities = Object.fromEntries(made.entities.map((entity) => [entity.name, entity]));
        const off = Math.max(wrist.distanceTo(inArm(geometry.wrist)), vectorOf(entities.p_e).distanceTo(inArm(geometry.elbow))) / (upper + fore);
        return { geometry, made, entities, off, turned: turnedBy(stage, selection, geometry) };
    } catch (error) {
        if (!(error instanceof SwivelError)) throw error;
        return { geometry, why: error.message };
    }
}

/** The page's words for a step. */
function makeWords(swivel) {
    const title = element("h3"), text = element("p"), list = element("dl", { class: "entities" }), closing = element("p", { class: "hint" });
    const tellStep = (step, limb) => {
        const [name, words] = STEPS[step].map((each) => typeset(saidOf(limb, each)));
        title.replaceChildren(...name);
        return words;
    };
    const explain = (step, { made, off, turned }, limb) => {
        text.replaceChildren(...tellStep(step, limb));
        const rowOf = (entity) => [
            element("dt", { title: entity.meaning },
                element("i", { class: "swatch", style: `--swatch: ${COLOURS[entity.name] ?? "transparent"}` }), element("span", {}, ...typeset(entity.name))),
            element("dd", {}, ...typeset(textOf(swivel, entity)), element("small", {}, ...typeset(saidOf(limb, entity.meaning)))),
        ];
        list.replaceChildren(...made.entities.filter((entity) => entity.step === step + 1).flatMap(rowOf));
        closing.textContent = saidOf(limb, `Both rotations put the wrist ${number(made.closingError)} arm lengths from the target.` + (off <= OFF ? "" :
            ` The lecture knows no limits: limits, weights, reach or a step hold the arm that you see ${number(off)} arm lengths from this one.`) +
            (turned < TURNED ? "" :
                ` The elbow is ${turned.toFixed(1)}° from where the limb's own pole wishes it: limits, an angle, weights or a step turn it. The lesson takes a pole that gives the elbow you see.`));
    };
    const refuse = (step, { why }, limb) => {
        tellStep(step, limb);
        text.replaceChildren(...typeset(saidOf(limb, `The lecture's formulas have no answer here. ${why}.`)));
        list.replaceChildren();
        closing.textContent = saidOf(limb, "The solver takes other forms of them, which hold for every arm.");
    };
    return { parts: [title, text, list, closing], tell: (step, steps, limb) => (steps.made ? explain : refuse)(step, steps, limb) };
}

/** The drawn entities and their labels. */
function makeDrawing(view) {
    const frame = new Group(), labels = element("div", { class: "labels", "aria-hidden": "true" });
    let places = [];
    view.marks.add(frame);
    document.body.append(labels);
    const add = (shape, name, at) => {
        if (shape) frame.add(shape);
        if (name) places.push({ at, label: element("span", { style: `--swatch: ${COLOURS[name] ?? "#8d99a8"}` }, ...typeset(name)) });
    };
    const empty = () => {
        clear(frame);
        places = [];
        labels.replaceChildren();
    };
    /** origin: the shoulder in the world. */
    const show = (step, { geometry, entities }, origin) => {
        const { upper, fore, armAxes } = geometry;
        frame.position.fromArray(origin);
        frame.quaternion.copy(armAxes);
        if (entities) DRAW[step](entities, { upper, fore, thickness: 0.008 * (upper + fore) }, add);
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
    return { empty, show, placeLabels };
}

export function makeLesson(page) {
    const { stage, view } = page, words = makeWords(stage.swivel), drawing = makeDrawing(view);
    let step = 0;
    const go = (steps) => {
        step = (step + steps + STEPS.length) % STEPS.length;
        update();
        page.redraw();
    };
    const box = section("The lecture, step by step", false, element("div", { class: "lesson" }, ...words.parts,
        element("div", { class: "row" }, button("Back", () => go(-1)), button("Next", () => go(1)))));
    const update = () => {
        drawing.empty();
        if (!box.open) return;
        const selection = page.selection ?? { limb: stage.limbs[0], character: 0 }, { limb, character } = selection;
        const steps = stepsOf(stage, selection);
        drawing.show(step, steps, stage.shoulder(limb, character));
        words.tell(step, steps, limb);
    };
    box.addEventListener("toggle", () => {
        page.overlays.hide(box.open);
        if (box.open) box.scrollIntoView({ block: "nearest" });
        update();
        page.redraw();
    });
    box.addEventListener("keydown", (event) => {
        if (box.open && ["ArrowRight", "ArrowLeft"].includes(event.key)) go(event.key === "ArrowRight" ? 1 : -1);
    });
    page.on("frame", update);
    page.on("select", update);
    page.on("draw", drawing.placeLabels);
    return { box };
}
