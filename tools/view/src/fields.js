// SPDX-License-Identifier: MIT
//
// Values that all characters of a limb share, such as limits: the crowd file's, and the user's in their place. They decide
// the limb's features.
import { Feature, Field, OnBadInput } from "swivel-wasm/layout.js";

const NAMES = new Map(Object.entries(Field).map(([name, field]) => [field, name]));
const ALL = [1, 1, 1];  // weights that say nothing

/** The crowd file's values, by the field's name. */
export function fixedOf({ fixed, weights }) {
    const values = fixed.map(({ field, value }) => [NAMES.get(field), value]);
    return new Map(weights.every((weight) => weight === 1) ? values : [...values, ["WEIGHTS", weights]]);
}

/** What a field of a limb is: the user's, else the file's, else nothing. The user's null takes the file's away. */
export const fieldOf = (limb, name) => (limb.own.has(name) ? limb.own.get(name) ?? undefined : limb.fixed.get(name));

/** The user's fields, with this value among them; null takes the field away. */
export function ownWith(limb, name, value) {
    const own = new Map(limb.own);
    if (value || limb.fixed.has(name)) own.set(name, value);
    else own.delete(name);
    return own;
}

/** The features of a limb: the file's, with those of the user's fields, without those that were taken away. Goals always have weights. */
export function featuresFor(limb) {
    let { features } = limb;
    for (const name of limb.own.keys()) {
        const feature = Feature[`WITH_${name}`];
        if (name !== "WEIGHTS") features = fieldOf(limb, name) ? features | feature : features & ~feature;
    }
    return features;
}

/** Writes what all characters share. Weights go into the limb's plan of goals. */
export function writeFields(crowd, limb) {
    const group = limb.index;
    for (const name of new Set([...limb.fixed.keys(), ...limb.own.keys()])) {
        const value = fieldOf(limb, name);
        if (value && name !== "WEIGHTS") crowd.write(Field[name], Array.from(value).slice(0, crowd.componentCount(Field[name], group)), { group });
    }
    limb.weights.set(fieldOf(limb, "WEIGHTS") ?? ALL);
}

/** Makes the crowd of these limbs, with their fields. look: how heads look, or null. */
export function makeCrowd(swivel, skeleton, limbs, look, bodyCount) {
    const groups = limbs.map((limb) => {
        const { chain: joints, shoulderOrder, wristOrder, region, plant, ground, held } = limb;
        const shape = { joints, features: featuresFor(limb), shoulderOrder, wristOrder, onBadInput: OnBadInput.REST_POSE };
        return { ...shape, ...(held >= 0 && { link: held }), ...(region && { region: swivel.region(region) }), ...(ground && { plant, ground }) };
    });
    if (look) groups.push({ look });
    if (limbs.some((limb) => featuresFor(limb) & Feature.WITH_PELVIS_FIT)) groups.push({ shift: {} });
    const crowd = swivel.bodies({ skeleton, bodyCount, groups });
    try {
        limbs.forEach((limb) => writeFields(crowd, limb));
    } catch (error) {
        crowd.dispose();
        throw error;
    }
    return crowd;
}
