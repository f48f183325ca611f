// SPDX-License-Identifier: MIT
//
// What a link into the page asks for: "#frame=12&character=3&limb=left_arm" shows that limb, "#drawn=200" as many characters.

/** A number of the link that is one of the first `count`; null if the link has none. What is wrong is told. */
function number(page, hash, name, count) {
    if (!hash.has(name)) return null;
    const text = hash.get(name), value = Number(text);
    if (/^\d+$/.test(text) && value < count) return value;
    page.say(`The link asks for ${name} ${text}. This crowd has ${name}s 0 to ${count - 1}.`);
    return null;
}

/** The limb that the link names, or null. */
function limbOf(page, hash) {
    const name = hash.get("limb"), names = page.stage.limbs.map((limb) => limb.name);
    if (name !== null && !names.includes(name)) page.say(`The link asks for the limb ${name}. This crowd has ${names.join(", ")}.`);
    return page.stage.limbs[names.indexOf(name)] ?? null;
}

export function followLink(page) {
    const hash = new URLSearchParams(location.hash.slice(1)), { stage } = page, drawn = Number(hash.get("drawn"));
    page.say("");
    if (Number.isInteger(drawn) && drawn > 0) page.drawFirst(Math.min(drawn, page.mostDrawn));
    const frame = number(page, hash, "frame", stage.frameCount);
    const character = hash.has("character") ? number(page, hash, "character", stage.characterCount) : 0;
    if (frame !== null) page.setFrame(frame);
    const limb = limbOf(page, hash);
    if (limb === null || character === null) return;
    if (character >= page.mostDrawn) {
        page.say(`Character ${character} is solved but cannot be shown: the page draws the first ${page.mostDrawn} here.`);
        return;
    }
    if (character >= page.drawnCount) page.drawFirst(character + 1);
    page.select({ limb, character });
    page.view.lookAt(character, true);
    page.redraw();
}
