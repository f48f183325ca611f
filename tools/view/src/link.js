// SPDX-License-Identifier: MIT
//
// What a link into the page asks for: "#frame=12&character=3&limb=left_arm" shows that limb, "#drawn=200" as many characters.

/** A number of the link that is one of the first `count`; null if the link has none. wrong: takes a sentence on what is wrong. */
function number(hash, name, count, wrong) {
    if (!hash.has(name)) return null;
    const text = hash.get(name), value = Number(text);
    if (/^\d+$/.test(text) && value < count) return value;
    wrong.push(`No ${name} ${text} here (0 to ${count - 1}).`);
    return null;
}

/** The limb that the link names, or null. The first one if it names a character alone. */
function limbOf(stage, hash, wrong) {
    if (!hash.has("limb")) return hash.has("character") ? stage.limbs[0] : null;
    const name = hash.get("limb"), names = stage.limbs.map((limb) => limb.name);
    if (!names.includes(name)) wrong.push(`No limb ${name} here (${names.join(", ")}).`);
    return stage.limbs[names.indexOf(name)] ?? null;
}

/** How many characters the link draws, if it says so. */
function drawFirst(page, hash, wrong) {
    if (!hash.has("drawn")) return;
    const text = hash.get("drawn");
    if (!/^[1-9]\d*$/.test(text)) return wrong.push(`${text} characters cannot be drawn (1 to ${page.maxDrawn}).`);
    page.drawFirst(Math.min(Number(text), page.maxDrawn));
    page.home();
}

export function followLink(page) {
    const hash = new URLSearchParams(location.hash.slice(1)), { stage } = page, wrong = [];
    drawFirst(page, hash, wrong);
    const frame = number(hash, "frame", stage.frameCount, wrong);
    const character = hash.has("character") ? number(hash, "character", stage.characterCount, wrong) : 0;
    if (frame !== null) {
        page.player.pause();
        page.setFrame(frame);
    }
    const limb = limbOf(stage, hash, wrong);
    page.say(wrong.join(" "));
    if (limb === null || character === null) return;
    page.select({ limb, character });
    page.look(limb, character);
    page.redraw();
}
