// SPDX-License-Identifier: MIT
//
// The chosen limb: its numbers, its flags, and why it is as it is.
import { button, checkbox, element, facts, section } from "./dom.js";
import { flagNames } from "./stage.js";
import { lackOf, saveTable } from "./table.js";
import { coordinate, limbName, number, saidOf } from "./words.js";

const wordsOf = (flag) => flag.toLowerCase().replaceAll("_", " ");
const degrees = (radians) => `${(Math.round(radians * 1800 / Math.PI) / 10 + 0).toFixed(1)}°`;  // no -0

function rowsOf(stage, limb, character) {
    const pose = stage.pose(limb, character), goal = stage.goal(limb, character, "target"), who = stage.characters[character];
    const length = stage.armLength(limb, character), place = (vector) => vector.map((value) => coordinate(value, length > 0 ? length : 1)).join(", ");
    const clip = stage.clips.indexOf(who.first), clipFrame = `${stage.clipFrame(character) - who.first}${stage.clips.length > 1 ? ` of clip ${clip + 1}` : ""}`;
    const off = number(stage.residual(limb, character));
    const hasEffector = stage.has(limb, "EFFECTOR") && stage.read(limb, character, "EFFECTOR").some((part) => part !== 0);
    const rows = [
        ["Character", `${character}, size ${who.size.toFixed(3)}`], ["Clip frame", clipFrame],
        [hasEffector ? "Effector's target" : "Target", place(goal)], ["Wrist", place(pose.wrist)], ["Elbow", place(pose.elbow)],
        ["Off by", off === "–" ? off : `${off} arm lengths`], ["Flexion", degrees(stage.flexion(limb, character))],
    ];
    if (stage.has(limb, "STRETCH")) rows.push(["Stretch", stage.read(limb, character, "STRETCH")[0].toFixed(4)]);
    return rows.map(([name, value]) => [saidOf(limb, name), saidOf(limb, value)]);
}

export function makeInspector(page) {
    const { stage } = page;
    const none = element("p", { class: "hint" }, "Click a limb. Then drag the yellow ball, its target, or the white one, its pole. On ground the blue one moves the hips up and down, and on hills the green one the ground.");
    const title = element("h3"), table = element("div"), flags = element("p", { class: "flags" }), why = element("p", { class: "why" });
    const everyone = checkbox("Drag everyone's", false, (isOn) => { page.dragsEveryone = isOn; },
        { title: "A drag moves this limb of all characters by the same offset, times their size. Those moved alone go along" });
    const release = button("Let go", () => page.letGo(), { title: "Give the goals back to the clip" });
    const all = button("Let all go", () => page.letAllGo(), { title: "Give everyone's goals back to the clip, hips and ground, too" });
    const undo = button("Undo", () => page.undo.takeBack(), { title: "Take back the last drag or change (Ctrl+Z)" });
    const save = button("Save as table", () => saveTable(page), { title: "The moved goals of all frames, for swivel solve --targets" }), lack = element("p", { class: "hint" });
    const body = element("div", {}, title, table, flags, why, everyone);
    const box = section("Limb", true, none, body, element("div", { class: "acts" }, release, undo, all, save), lack);
    const show = () => {
        none.hidden = page.selection !== null;
        body.hidden = release.hidden = page.selection === null;
        all.hidden = !stage.isAnyDragged();
        save.hidden = lack.hidden = !stage.isAnyGoalMoved();
        undo.hidden = !page.undo.canTakeBack;
        if (!lack.hidden) lack.textContent = lackOf(stage);
        if (!page.selection || !box.open) return;
        const { limb, character } = page.selection;
        title.textContent = `${limbName(limb)} of character ${character}`;
        table.replaceChildren(facts(rowsOf(stage, limb, character)));
        flags.replaceChildren(...flagNames(stage.flags(limb, character)).map((flag) => element("span", {}, saidOf(limb, wordsOf(flag)))));
        why.textContent = stage.goesAlong(limb, character) ? "It goes along with its body." : saidOf(limb, stage.explain(limb, character));
        release.disabled = stage.movedParts(limb, character).length === 0 && !stage.hips.has(character);
    };
    page.on("frame", show);
    page.on("select", show);
    box.addEventListener("toggle", show);
    show();
    return box;
}
