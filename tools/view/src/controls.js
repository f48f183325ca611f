// SPDX-License-Identifier: MIT
//
// Limits, weights, reach and step of all limbs of a kind, by sliders. A switch adds the field to the crowd or takes it
// away, the crowd file's, too.
import { checkbox, element, section, slider } from "./dom.js";
import { Feature, featureRules, SwivelError } from "./stage.js";
import { kindOf, saidOf, saidOfAll } from "./words.js";

const RADIANS = Math.PI / 180;
const degreesOfHalf = (cos) => 2 * Math.acos(cos) / RADIANS;
const middle = ([cos, sin]) => Math.atan2(sin, cos) / RADIANS;
const angle = (text, min, max, value) => ({ text, min: min, max: max, step: 1, value, unit: "°" });
const share = (text, value, max = 1) => ({ text, min: 0, max, step: 0.01, value });

/** Numbers of a range as the solver has it: its ends in degrees, and back. Twists of the other side turn the other way. */
const rangeEnds = (range, { isOther }) => {
    const [from, to] = [middle(range) - middle(range.slice(2)), middle(range) + middle(range.slice(2))];
    return isOther ? [-to, -from] : [from, to];
};
const range = (swivel, [min, max], { isOther }) => {
    const [from, to] = [Math.min(min, max) * RADIANS, Math.max(min, max) * RADIANS];
    return isOther ? swivel.range(-to, -from) : swivel.range(from, to);
};

/** Axes of each order of Euler angles, in the order's own sequence. Mirrored in x, turns about y and z change their sense. */
const AXES = [[0, 1, 2], [0, 2, 1], [1, 2, 0], [1, 0, 2], [2, 0, 1], [2, 1, 0]];
const boxSliders = ["x", "y", "z"].flatMap((axis) => [angle(`${axis} least`, -180, 180, -60), angle(`${axis} most`, -180, 180, 60)]);
const box = (swivel, numbers, { isOther, order }) =>
    AXES[order].flatMap((axis) => Array.from(range(swivel, numbers.slice(2 * axis, 2 * axis + 2), { isOther: isOther && axis > 0 })));
const boxEnds = (value, { isOther, order }) => AXES[order].reduce((ends, axis, n) => {
    [ends[2 * axis], ends[2 * axis + 1]] = rangeEnds(value.slice(4 * n, 4 * n + 4), { isOther: isOther && axis > 0 });
    return ends;
}, []);

/** The axis that the crowd file gives, or the limb's own. */
const axisOf = ({ given }) => (given ? Array.from(given).slice(0, 3) : [0, 0, 1]);
const cone = (opening) => ({
    sliders: [angle("Opening", 0, 180, opening)],
    value: (swivel, [max], limb) => swivel.cone(axisOf(limb), max * RADIANS), numbers: (value) => [Math.acos(value[3]) / RADIANS],
});

/**
 * Each field: a hint for people, what its sliders are, its value from their numbers, their numbers from its value. Both get what of the
 * limb matters: isOther, whether its twists turn the other way, the order of its boxes, and the value that the crowd file gives.
 */
const FIELDS = [
    { name: "FLEXION_LIMIT", title: "Flexion",
        hint: "How far the elbow may bend, from straight on",
        sliders: [angle("Least", 0, 180, 10), angle("Most", 0, 180, 140)],
        value: (swivel, [min, max]) => swivel.flexion(Math.min(min, max) * RADIANS, Math.max(min, max) * RADIANS),
        numbers: (value) => [degreesOfHalf(value[0]), degreesOfHalf(value[1])] },
    { name: "SHOULDER_CONE", title: "Shoulder cone",
        hint: "How far the upper arm may turn from the cone's axis",
        ...cone(80) },
    { name: "HUMERAL_TWIST", title: "Humeral twist",
        hint: "How far the upper arm may turn about itself",
        sliders: [angle("Least", -180, 180, -60), angle("Most", -180, 180, 60)],
        value: range, numbers: rangeEnds },
    { name: "SHOULDER_BOX", title: "Shoulder box",
        hint: "Ranges of the shoulder's three Euler angles",
        order: "shoulderOrder", sliders: boxSliders, value: box, numbers: boxEnds },
    { name: "HAND_CONE", title: "Hand cone",
        hint: "How far the hand may bend away from the forearm",
        ...cone(60) },
    { name: "FOREARM_TWIST", title: "Forearm twist",
        hint: "How far the hand may turn about the forearm",
        sliders: [angle("Least", -180, 180, -80), angle("Most", -180, 180, 80)],
        value: range, numbers: rangeEnds },
    { name: "HAND_TWIST", title: "Hand twist",
        hint: "How far the hand may turn about its own axis",
        sliders: [angle("Least", -180, 180, -80), angle("Most", -180, 180, 80)],
        value: (swivel, ends, limb) => [...axisOf(limb), ...range(swivel, ends, limb)], numbers: (value, limb) => rangeEnds(value.slice(3), limb) },
    { name: "WRIST_BOX", title: "Wrist box",
        hint: "Ranges of the wrist's three Euler angles",
        order: "wristOrder", sliders: boxSliders, value: box, numbers: boxEnds },
    { name: "WEIGHTS", title: "Weights",
        hint: "How much each goal counts: 0 keeps the clip's pose, 1 takes the goal",
        sliders: [share("Position", 1), share("Hand", 1), share("Pole", 1)],
        value: (swivel, weights) => weights, numbers: (value) => value },
    { name: "REACH", title: "Reach",
        hint: "Soft zones near the ends of the reach, how far bones may stretch, and the least distance to the target",
        sliders: [share("Soft, far", 0.05, 0.5), share("Soft, near", 0, 0.5), { text: "Stretch", min: 1, max: 2, step: 0.01, value: 1 },
            share("Least distance", 0)],
        value: (swivel, numbers) => numbers, numbers: (value) => value },
    { name: "MAX_SWIVEL", title: "Step",
        hint: "How far the elbow may swing about the line from shoulder to wrist, in a 60th of a second",
        sliders: [angle("Most, a 60th of a second", 0, 90, 5)],
        value: (swivel, [max]) => swivel.cosSin(max * RADIANS), numbers: (value) => [middle(value)] },
];

/** Why a field cannot be added to a limb; nothing if it can. */
function obstacle(stage, limb, field) {
    const features = stage.featuresOf(limb), name = `WITH_${field.name}`, { WITH_HAND, WITH_AIM } = Feature;
    if ((featureRules[name].needs & ~features & WITH_HAND) !== 0n) return "These limbs have no hand goals.";
    if ((features & WITH_AIM) !== 0n && (featureRules.WITH_AIM.excludes & Feature[name]) !== 0n) return "These limbs aim, which excludes it.";
    return "";
}

/** What of a limb matters to a field's value. */
function traits(limb, field) {
    return { isOther: limb.name.startsWith("right"), order: limb[field.order] ?? 0, given: limb.fixed.get(field.name) };
}

/** A field's switch and sliders, for the limbs that limbsOf() names. */
function makeField(page, field, limbsOf) {
    const { stage } = page, numbers = field.sliders.map(({ value }) => value);
    let gesture = {};  // a slider's, until it is let go
    const valueOf = (limb) => Array.from(field.value(stage.swivel, numbers, traits(limb, field)));
    const apply = () => {
        try {
            page.undo.step(page.picker.dragging ?? gesture, () => stage.setField(limbsOf(), field.name, on.box.checked ? valueOf : null));
            page.say("");
            show();
        } catch (error) {
            if (!(error instanceof SwivelError)) throw error;
            page.say(`${saidOfAll(limbsOf(), field.title)} stays as it was: ${error.message}.`);
            follow();
        }
        page.changed();
    };
    const on = checkbox(field.title, false, apply, { "data-field": field.name });
    const bars = field.sliders.map((bar, n) => slider(bar.text, bar, (number) => {
        numbers[n] = number;
        apply();
    }));
    const take = (next) => bars.forEach((bar, n) => {
        numbers[n] = next[n];
        bar.set(next[n]);
    });
    const having = () => limbsOf().filter((limb) => stage.field(limb, field.name) !== undefined);
    const show = () => {
        const limbs = limbsOf(), count = having().length;
        const why = limbs.map((limb) => obstacle(stage, limb, field)).find((text) => text !== "");
        on.words.textContent = saidOfAll(limbs, field.title);
        on.title = saidOf(limbs[0], why ?? field.hint);
        Object.assign(on.box, { checked: count > 0, indeterminate: count > 0 && count < limbs.length, disabled: why !== undefined });
        bars.forEach((bar) => { bar.hidden = count === 0; });
    };
    /** Takes over what the limbs have; the first that has the field gives the numbers. */
    const follow = () => {
        const [first] = having();
        if (first) take(field.numbers(Array.from(stage.field(first, field.name)), traits(first, field)));
        show();
    };
    page.on("select", follow);
    follow();
    /** Takes numbers from elsewhere, such as a handle in the scene. */
    const set = (next) => {
        take(next);
        apply();
    };
    const box = element("div", { class: "field" }, on, ...bars);
    box.addEventListener("change", () => { gesture = {}; });
    return { box, set };
}

export function makeControls(page) {
    const { stage } = page;
    const limbsOf = () => stage.limbs.filter((limb) => !page.selection || kindOf(limb) === kindOf(page.selection.limb));
    const whose = element("p", { class: "hint" });
    const tell = () => {
        const kinds = [...new Set(limbsOf().map(kindOf))];
        whose.textContent = `For all ${kinds.map((kind) => `${kind}s`).join(" and ")}.`;
    };
    page.on("select", tell);
    tell();
    page.fields = Object.fromEntries(FIELDS.map((field) => [field.name, makeField(page, field, limbsOf)]));
    return section("Limits and weights", false, whose, ...Object.values(page.fields).map(({ box }) => box));
}
