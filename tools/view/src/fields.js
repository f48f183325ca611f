// SPDX-License-Identifier: MIT
//
// Values that all characters of a limb share, such as limits: the crowd file's, and the user's in their place. They decide
// the features of crowds.
import { Feature, featureRules, Field } from "swivel-wasm/layout.js";

const NAMES = new Map(Object.entries(Field).map(([name, field]) => [field, name]));

/** The crowd file's values, by the field's name. */
export const fixedOf = (fixed) => new Map(fixed.map(({ field, value }) => [NAMES.get(field), value]));

/** What a field of a limb is: the user's, else the file's, else nothing. The user's null takes the file's away. */
export const fieldOf = (limb, name) => (limb.own.has(name) ? limb.own.get(name) ?? undefined : limb.fixed.get(name));

/** Sets the user's value; null takes the field away. */
export function setOwn(limb, name, value) {
    if (value || limb.fixed.has(name)) limb.own.set(name, value);
    else limb.own.delete(name);
}

/**
 * The features of a crowd's groups: the file's, with those of the user's fields, without those that no limb uses any longer. What needs
 * an incoming pose has the clip's. Other needs are for the library to refuse.
 */
function featuresFor(shape, limbs) {
    let features = BigInt(shape.features);
    for (const name of new Set(limbs.flatMap(({ own }) => [...own.keys()]))) {
        const feature = Feature[`WITH_${name}`], { needs } = featureRules[`WITH_${name}`];
        const isUsed = limbs.some((limb) => fieldOf(limb, name) !== undefined);
        features = isUsed ? features | feature | (needs & Feature.WITH_INCOMING) : features & ~feature;
    }
    return features;
}

/** Writes what all characters share. */
export function writeFields(crowd, limb, characters) {
    const { group } = limb;
    for (const name of new Set([...limb.fixed.keys(), ...limb.own.keys()])) {
        const value = fieldOf(limb, name);
        if (value) crowd.write(Field[name], Array.from(value).slice(0, crowd.componentCount(Field[name], group)), { group });
    }
    if (crowd.componentCount(Field.EFFECTOR, group) > 0)
        crowd.write(Field.EFFECTOR, characters.flatMap(({ size }) => limb.effector.map((part) => size * part)), { group });
}

/** Makes the crowds of these limbs, with their fields; none if one fails. */
export function makeCrowds(swivel, shapes, limbs, characters) {
    const made = [];
    try {
        shapes.forEach((shape, index) => {
            const its = limbs.filter((limb) => limb.crowdIndex === index);
            const { shoulder_order: shoulderOrder, wrist_order: wristOrder } = shape;
            const groups = its.map(({ binding, region }) =>
                ({ limbCount: characters.length, binding, shoulderOrder, wristOrder, ...(region ? { region: swivel.region(region) } : {}) }));
            made.push(swivel.crowd(groups, featuresFor(shape, its)));
            its.forEach((limb) => writeFields(made[index], limb, characters));
        });
    } catch (error) {
        made.forEach((crowd) => crowd.dispose());
        throw error;
    }
    return made;
}
