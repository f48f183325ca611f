// SPDX-License-Identifier: MIT
//
// Limits, weights, reach and step of all limbs of a kind, by sliders. A switch adds the field to the crowd or takes it
// away.
import { checkbox, element, section, slider } from "./dom.js";
import { Feature } from "./stage.js";

const RADIANS = Math.PI / 180;
const degreesOfHalf = (cos) => 2 * Math.acos(cos) / RADIANS;
const middle = ([cos, sin]) => Math.atan2(sin, cos) / RADIANS;
const angle = (text, least, most, value) => ({ text, min: least, max: most, step: 1, value, unit: "°" });
const share = (text, value, max = 1) => ({ text, min: 0, max, step: 0.01, value });

/** Numbers of a range as the solver has it: its ends in degrees, and back. Twists of the other side turn the other way. */
const rangeEnds = (range) => [middle(range) - middle(range.slice(2)), middle(range) + middle(range.slice(2))];
const range = (swivel, [least, most], isOther) => {
    const [from, to] = [Math.min(least, most) * RADIANS, Math.max(least, most) * RADIANS];
    return isOther ? swivel.range(-to, -from) : swivel.range(from, to);
};

/** Axes of each order of Euler angles, in the order's own sequence. Mirrored in x, turns about y and z change their sense. */
const AXES = [[0, 1, 2], [0, 2, 1], [1, 2, 0], [1, 0, 2], [2, 0, 1], [2, 1, 0]];
const boxSliders = ["x", "y", "z"].flatMap((axis) => [angle(`${axis} least`, -180, 180, -60), angle(`${axis} most`, -180, 180, 60)]);
const box = (swivel, numbers, isOther, old, order) =>
    AXES[order].flatMap((axis) => Array.from(range(swivel, numbers.slice(2 * axis, 2 * axis + 2), isOther && axis > 0)));
const boxEnds = (value, order) => AXES[order].reduce((ends, axis, n) => {
    [ends[2 * axis], ends[2 * axis + 1]] = rangeEnds(value.slice(4 * n, 4 * n + 4));
    return ends;
}, []);

/** Each field: what its sliders are, its value from their numbers, their numbers from its value. */
const FIELDS = [
    { name: "FLEXION_LIMIT", title: "Flexion", sliders: [angle("Least", 0, 180, 10), angle("Most", 0, 180, 140)],
        value: (swivel, [least, most]) => swivel.flexion(Math.min(least, most) * RADIANS, Math.max(least, most) * RADIANS),
        numbers: (value) => [degreesOfHalf(value[0]), degreesOfHalf(value[1])] },
    { name: "SHOULDER_CONE", title: "Shoulder cone", sliders: [angle("Opening", 0, 180, 80)],
        value: (swivel, [most], isOther, old) => swivel.cone(old ? old.slice(0, 3) : [0, 0, 1], most * RADIANS),
        numbers: (value) => [Math.acos(value[3]) / RADIANS] },
    { name: "HUMERAL_TWIST", title: "Humeral twist", sliders: [angle("Least", -180, 180, -60), angle("Most", -180, 180, 60)],
        value: range, numbers: rangeEnds },
    { name: "SHOULDER_BOX", title: "Shoulder box", order: "shoulder_order", sliders: boxSliders, value: box, numbers: boxEnds },
    { name: "HAND_CONE", title: "Hand cone", needs: "WITH_HAND", sliders: [angle("Opening", 0, 180, 60)],
        value: (swivel, [most], isOther, old) => swivel.cone(old ? old.slice(0, 3) : [0, 0, 1], most * RADIANS),
        numbers: (value) => [Math.acos(value[3]) / RADIANS] },
    { name: "FOREARM_TWIST", title: "Forearm twist", needs: "WITH_HAND", sliders: [angle("Least", -180, 180, -80), angle("Most", -180, 180, 80)],
        value: range, numbers: rangeEnds },
    { name: "HAND_TWIST", title: "Hand twist", needs: "WITH_HAND", sliders: [angle("Least", -180, 180, -80), angle("Most", -180, 180, 80)],
        value: (swivel, ends, isOther, old) => [...(old ? old.slice(0, 3) : [0, 0, 1]), ...range(swivel, ends, isOther)],
        numbers: (value) => rangeEnds(value.slice(3)) },
    { name: "WRIST_BOX", title: "Wrist box", needs: "WITH_HAND", order: "wrist_order", sliders: boxSliders, value: box, numbers: boxEnds },
    { name: "WEIGHTS", title: "Weights", sliders: [share("Position", 1), share("Hand", 1), share("Pole", 1)],
        value: (swivel, weights) => weights, numbers: (value) => value },
    { name: "REACH", title: "Reach",
        sliders: [share("Soft, far", 0.05, 0.5), share("Soft, near", 0, 0.5), { text: "Stretch", min: 1, max: 2, step: 0.01, value: 1 }, share("Least distance", 0)],
        value: (swivel, numbers) => numbers, numbers: (value) => value },
    { name: "MOST_SWIVEL", title: "Step", sliders: [angle("Most, a frame", 0, 90, 5)],
        value: (swivel, [most]) => swivel.turn(most * RADIANS), numbers: (value) => [middle(value)] },
];
const NOT_WITH_AIM = ["WEIGHTS", "REACH", "FLEXION_LIMIT", "HAND_CONE", "FOREARM_TWIST", "HAND_TWIST", "WRIST_BOX"];

/** Why a field cannot be added to a limb's crowd; nothing if it can. */
function obstacle(stage, limb, field) {
    const features = stage.featuresOf(limb);
    if (field.needs && (features & Feature[field.needs]) === 0n) return "These limbs have no hand goals.";
    if ((features & Feature.WITH_AIM) !== 0n && NOT_WITH_AIM.includes(field.name)) return "These limbs aim, which excludes it.";
    return "";
}

/** A field's switch and sliders. */
function makeField(page, field, limbsOf) {
    const { stage } = page, { swivel } = stage, old = new Map(stage.limbs.map((limb) => [limb, stage.field(limb, field.name)]));
    const orderOf = (limb) => stage.data.crowds[limb.crowdIndex][field.order] ?? 0;
    const given = old.get(stage.limbs[0]), numbers = given ? field.numbers(Array.from(given), orderOf(stage.limbs[0])) : field.sliders.map(({ value }) => value);
    const isOther = (limb) => limb.name.startsWith("right") !== limb.mirrored;
    const apply = () => {
        stage.setField(limbsOf(), field.name,
            on.box.checked ? (limb) => Array.from(field.value(swivel, numbers, isOther(limb), old.get(limb), orderOf(limb))) : null);
        page.changed();
    };
    const on = checkbox(field.title, given !== undefined, (isOn) => {
        bars.forEach((bar) => { bar.hidden = !isOn; });
        apply();
    }, { "data-field": field.name });
    const bars = field.sliders.map((bar, n) => {
        const made = slider(bar.text, { ...bar, value: numbers[n] }, (number) => {
            numbers[n] = number;
            apply();
        });
        made.hidden = given === undefined;
        return made;
    });
    const why = obstacle(stage, stage.limbs[0], field);
    if (why) Object.assign(on.box, { disabled: true }).parentElement.title = why;
    /** Takes numbers from elsewhere, such as a handle in the scene. */
    const set = (next) => {
        next.forEach((number, n) => {
            numbers[n] = number;
            bars[n].set(number);
        });
        apply();
    };
    return { box: element("div", { class: "field" }, on, ...bars), set, isOn: () => on.box.checked };
}

export function makeControls(page) {
    const { stage } = page, kindOf = (limb) => limb.name.split("_")[1];
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
