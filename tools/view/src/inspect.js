// SPDX-License-Identifier: MIT
//
// The chosen limb: its numbers, its flags, and why it is as it is.
import { button, checkbox, element, facts, section } from "./dom.js";
import { flagNames } from "./stage.js";

/** A limb's word for people: "left arm". */
export const limbName = (limb) => limb.name.replace("_", " ");
const wordsOf = (flag) => flag.toLowerCase().replaceAll("_", " ");
const place = (vector) => vector.map((coordinate) => coordinate.toPrecision(5)).join(", ");
const degrees = (radians) => `${(radians * 180 / Math.PI).toFixed(1)}°`;

function rowsOf(stage, limb, character) {
    const pose = stage.pose(limb, character), goal = stage.goal(limb, character, "target"), who = stage.characters[character];
    const rows = [
        ["Character", `${character}, size ${who.size.toFixed(3)}`], ["Clip frame", `${stage.clipFrame(character)}`],
        ["Target", place(goal)], ["Wrist", place(pose.wrist)], ["Elbow", place(pose.elbow)],
        ["Off by", `${stage.residual(limb, character).toExponential(2)} arm lengths`], ["Flexion", degrees(stage.flexion(limb, character))],
    ];
    if (stage.has(limb, "STRETCH")) rows.push(["Stretch", stage.read(limb, character, "STRETCH")[0].toFixed(4)]);
    return rows;
}

export function makeInspector(page) {
    const { stage } = page;
    const none = element("p", { class: "hint" }, "Click a limb. Then drag the yellow ball, its target, or the white one, its pole.");
    const title = element("h3"), table = element("div"), flags = element("p", { class: "flags" }), why = element("p", { class: "why" });
    const everyone = checkbox("Drag everyone's", false, (isOn) => { page.dragsEveryone = isOn; },
        { title: "A drag moves this limb of all characters by the same offset, times their size. Those moved alone go along" });
    const follow = checkbox("Follow this character", false, (isOn) => page.follow(isOn));
    const release = button("Let go", () => page.letGo(), { title: "Give the goals back to the clip" });
    const body = element("div", {}, title, table, flags, why, everyone, follow, element("div", { class: "row" }, release));
    const box = section("Limb", true, none, body);
    const show = () => {
        none.hidden = page.selection !== null;
        body.hidden = page.selection === null;
        if (!page.selection || !box.open) return;
        const { limb, character } = page.selection;
        title.textContent = `${limbName(limb)} of character ${character}`;
        table.replaceChildren(facts(rowsOf(stage, limb, character)));
        flags.replaceChildren(...flagNames(stage.flags(limb, character)).map((flag) => element("span", {}, wordsOf(flag))));
        why.textContent = stage.explain(limb, character);
        release.disabled = !stage.isDragged(limb, character);
        follow.box.checked = page.view.followed === character;
    };
    page.on("frame", show);
    page.on("select", show);
    box.addEventListener("toggle", show);
    show();
    return box;
}
