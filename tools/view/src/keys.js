// SPDX-License-Identifier: MIT
//
// The keyboard, and the help that lists it.
import { button, element } from "./dom.js";

/** Keys by KeyboardEvent.key; text: for the help; withCtrl: with Ctrl or a Mac's Cmd, which others are without. */
export function keysOf(page) {
    return [
        { keys: [" "], label: "Space", text: "play or pause", act: () => page.player.toggle() },
        { keys: ["ArrowLeft"], label: "←", text: "frame before", act: () => page.player.step(-1) },
        { keys: ["ArrowRight"], label: "→", text: "next frame", act: () => page.player.step(1) },
        { keys: ["Home"], label: "Home", text: "first frame", act: () => page.setFrame(0) },
        { keys: ["End"], label: "End", text: "last frame", act: () => page.setFrame(page.stage.frameCount - 1) },
        { keys: ["n", "N"], label: "N", text: "next limb", act: () => page.selectNext() },
        { keys: ["f", "F"], label: "F", text: "follow the chosen or middle character, or stop", act: () => page.follow(page.view.followed === null) },
        { keys: ["z"], withCtrl: true, label: "Ctrl+Z", text: "take back the last drag or change", act: () => page.undo.takeBack() },
        { keys: ["r", "R"], label: "R", text: "show the crowd again", act: () => page.home() },
        { keys: ["t", "T"], label: "T", text: "light or dark", act: () => page.toggleTheme() },
        { keys: ["p", "P"], label: "P", text: "show or hide the panel", act: () => page.togglePanel() },
        { keys: ["?", "h", "H"], label: "H", text: "this help", act: () => page.help.showModal() },
        { keys: ["Escape"], label: "Esc", text: "choose nothing", act: () => page.select(null) },
    ];
}

export function listen(keys) {
    document.addEventListener("keydown", (event) => {
        const { target } = event;
        if (event.altKey || target.closest?.("dialog, select, .lesson")) return;
        if (target.matches?.("input, button, summary") && [" ", "ArrowLeft", "ArrowRight", "Home", "End"].includes(event.key)) return;
        const key = keys.find(({ keys: names, withCtrl = false }) => names.includes(event.key) && withCtrl === (event.ctrlKey || event.metaKey));
        if (!key) return;
        event.preventDefault();
        key.act();
    });
}

export function makeHelp(keys) {
    const mouse = [["Drag", "turn the camera"], ["Right drag, two fingers", "move it"], ["Wheel, pinch", "nearer or farther"],
        ["Click, tap", "choose a limb"], ["Drag a ball", "move target, pole, hips, ground or the rim of a limit"]];
    const rows = [...mouse, ...keys.map(({ label, text }) => [label, text])];
    const dialog = element("dialog", { class: "help", "aria-label": "Help" }, element("h2", {}, "How it works"),
        element("p", {}, "An animation gives the poses. In each frame swivel, the library, moves arms, legs and heads to their goals: feet stand on the ground, hands hold, eyes look. Here it runs as WebAssembly, and gives the same bits as everywhere."),
        element("dl", {}, ...rows.flatMap(([label, text]) => [element("dt", {}, label), element("dd", {}, text)])),
        button("Close", () => dialog.close()));
    return dialog;
}
