// SPDX-License-Identifier: MIT
//
// The page: a crowd that is solved as you look at it. start() makes it from the data that `swivel view` writes.
//
// The parts share one object, `page`: stage (the crowd), view (the scene), selection ({ limb, character } or null), and the calls below.
// Its events are "frame" after every solve, "select" after a choice, "draw" after every picture, and "say" with something to tell.
// window.swivelPage is this object, for tests and scripts: await swivelPage.ready first.
import { Vector3 } from "three";

import { floatsOf } from "./bytes.js";
import { makeControls } from "./controls.js";
import { button, element, section, slider } from "./dom.js";
import { Figure } from "./figure.js";
import { makeInspector } from "./inspect.js";
import { keysOf, listen, makeHelp } from "./keys.js";
import { makeLegend } from "./legend.js";
import { makeLesson } from "./lesson.js";
import { followLink } from "./link.js";
import { openStage } from "./open.js";
import { makeOverlays } from "./overlays.js";
import { Picker } from "./pick.js";
import { Player } from "./player.js";
import { readback } from "./readback.js";
import { maxDrawn } from "./rows.js";
import { View } from "./scene.js";
import { readSkin } from "./skin_file.js";
import { MAX_SKINS } from "./skins.js";
import { makeStatus } from "./status.js";
import { Undo } from "./undo.js";
import { isWhole } from "./whole.js";
import { kindOf } from "./words.js";
import css from "./style.css";

const DRAWN = 1000;  // characters at most, unless asked for more
const MAX_DRAWN = 65536;

/** What this browser lacks; nothing if it has all. */
function lack() {
    if (typeof WebAssembly !== "object") return "WebAssembly";
    if (!document.createElement("canvas").getContext("webgl2")) return "WebGL 2";
    // A function that makes a vector of zeros: the smallest module with SIMD.
    const simd = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
    return WebAssembly.validate(new Uint8Array(simd)) ? "" : "WebAssembly with SIMD";
}

const isPhone = () => matchMedia("(max-width: 760px)").matches;

function refuse(text) {
    document.body.replaceChildren(element("p", { class: "refusal", role: "alert" }, text));
}

class Page {
    constructor(stage, data, canvas) {
        this.listeners = { frame: [], select: [], draw: [], say: [] };
        this.stage = stage;
        this.canvas = canvas;
        this.selection = null;
        this.chosen = 0;  // the character that was chosen last
        this.dragsEveryone = false;
        this.view = new View(canvas, stage, new Figure(data, floatsOf(data.positions), stage.limbs, stage.characters[0]));
        this.maxDrawn = Math.min(stage.characterCount, MAX_DRAWN, maxDrawn(this.view.bodies.maxTexels));
        this.drawnCount = Math.min(this.maxDrawn, DRAWN);
        this.view.controls.addEventListener("change", () => this.redraw());
        this.picker = new Picker(this);
        this.undo = new Undo(this);
    }

    on(event, hear) { this.listeners[event].push(hear); }
    tell(event, ...more) { this.listeners[event].forEach((hear) => hear(...more)); }
    /** Shows a sentence until the next one; "" shows none. */
    say(text) { this.tell("say", text); }

    setFrame(frame) {
        this.stage.setFrame(frame);
        this.changed();
    }
    /** After a solve. */
    changed() {
        this.view.moveAlong();
        this.show();
        this.tell("frame");
        this.redraw();
    }
    /** Draws the first characters, and the one that was chosen last. */
    show() { this.view.bodies.show(this.drawnCount, this.chosen); }
    /** Draws before the browser's next picture, once. */
    redraw() {
        if (this.isDue) return;
        this.isDue = true;
        requestAnimationFrame(() => this.draw());
    }
    /** Heads look to where a ray of the pointer passes in front of them; null: ahead. */
    lead(ray) {
        const { bodies, camera, controls } = this.view, heads = bodies.isInSkins && bodies.skins.poses.heads;
        if (!heads || this.stage.look) return;  // the crowd file says where they look
        heads.at = ray && this.view.toClip(ray.at(0.5 * camera.position.distanceTo(controls.target), new Vector3()));
        this.show();
        this.redraw();
    }
    draw() {
        this.isDue = false;
        this.view.draw();
        this.tell("draw");
    }
    drawFirst(count) {
        this.drawnCount = count;
        this.changed();
    }

    select(selection) {
        this.selection = selection;
        if (selection) this.chosen = selection.character;
        if (selection && this.view.followed !== null) this.view.follow(selection.character);
        if (selection && !isPhone()) this.openPanel();
        this.view.bodies.choose(selection?.limb, selection?.character);
        this.show();
        this.tell("select");
        this.redraw();
    }
    selectNext() {
        const { limbs } = this.stage, { limb, character } = this.selection ?? { limb: limbs.at(-1), character: this.view.middle - 1 };
        const next = limbs[(limb.index + 1) % limbs.length];
        const who = (next.index === 0 ? character + 1 : character) % this.stage.characterCount;
        this.select({ limb: next, character: who });
        if (!this.pointsOf(next, who).every((point) => this.view.isSeen(point))) this.look(next, who);
    }
    /** A limb's joints, and its goals that are near. */
    pointsOf(limb, character) {
        const { stage } = this, { shoulder, elbow, wrist } = stage.pose(limb, character), near = 2 * stage.armLength(limb, character);
        const goals = ["target", ...(stage.hasPole(limb) ? ["pole"] : [])].map((part) => stage.goal(limb, character, part));
        return [shoulder, elbow, wrist, ...goals.filter((goal) => Math.hypot(...goal.map((c, axis) => c - shoulder[axis])) < near)];
    }
    /** Looks at a limb, so that all of it and its goals are seen. */
    look(limb, character) {
        this.view.lookAt(character, true);
        this.view.makeSeen(this.pointsOf(limb, character));
    }
    drag(part, world) {
        if (!this.selection) return;
        const { limb, character } = this.selection;
        this.undo.step(this.picker.dragging, () => this.stage.drag(limb, character, part, world, this.dragsEveryone));
        this.view.stay();
        this.changed();
    }
    /** After a drag. */
    settle() {
        this.stage.settle();
        this.changed();
    }
    letGo() {
        this.undo.step(null, () => this.stage.letGo(this.selection.limb, this.selection.character));
        this.changed();
    }
    letAllGo() {
        this.undo.step(null, () => this.stage.letAllGo());
        this.changed();
    }
    /** Follows the chosen character, or the one that the camera looks at from the start. */
    follow(isOn) {
        this.view.follow(isOn ? this.selection?.character ?? this.view.middle : null);
        this.tell("select");
    }
    home() {
        this.view.home(this.drawnCount);
        this.redraw();
    }
    setTheme(theme) {
        this.theme = document.documentElement.dataset.theme = theme;
        this.view.setTheme(theme);
        this.redraw();
    }
    toggleTheme() { this.setTheme(this.theme === "dark" ? "light" : "dark"); }
    /** Opens the panel, unless somebody has closed it. */
    openPanel() {
        if (!this.hasPanel) this.togglePanel();
    }
    togglePanel() {
        this.hasPanel = true;
        const was = this.view.farther();
        document.body.classList.toggle("wide");
        this.resize();
        this.view.recede(this.view.farther() / was);
        if (this.selection) this.view.makeSeen(this.pointsOf(this.selection.limb, this.selection.character));
    }
    resize() {
        const { clientWidth: width, clientHeight: height } = this.canvas, panel = document.querySelector("aside").getBoundingClientRect();
        const isBelow = panel.width > width / 2;
        const top = document.querySelector("header").getBoundingClientRect().bottom;
        const bottom = height - document.querySelector("footer").getBoundingClientRect().top;
        this.view.resize(width, height, isBelow ? 0 : panel.width, top, isBelow ? height - panel.top : bottom);
        this.redraw();
    }

    readback(limb, count) { return readback(this.view, limb, count); }
}

/** What the page is, and what one does in it, in two sentences. */
function about({ stage, view }) {
    const kinds = [...new Set(stage.limbs.map(kindOf))].map((kind) => `${kind}s`).join(" and ");
    const leads = view.bodies.skins?.poses.heads && !stage.look && matchMedia("(hover: hover)").matches;
    return `${stage.characterCount.toLocaleString("en")} characters, whose ${kinds} this page solves as you watch. ` +
        `${isPhone() ? "Tap" : "Click"} a limb, and drag its target.${leads ? " Heads follow your pointer." : ""} `;
}

function build(page, data) {
    const { stage } = page, keys = keysOf(page), title = element("h1", {}, data.title);
    page.help = makeHelp(keys);
    const showHelp = () => page.help.showModal();
    const head = element("header", {}, element("p", { class: "name" }, "swivel"), title,
        element("p", { class: "about" }, about(page), button("How it works", showHelp, { class: "link" })), makeStatus(page));
    const nav = element("nav", {}, button("Light or dark", () => page.toggleTheme()), button("Help", showHelp), button("Panel", () => page.togglePanel()));
    const drawn = slider("Drawn", { min: 1, max: page.maxDrawn, step: 1, value: page.drawnCount }, (count) => {
        page.drawFirst(count);
        page.home();
    });
    page.on("frame", () => drawn.set(page.drawnCount));
    const bar = element("footer", {});
    page.player = new Player(page, bar);
    document.body.classList.add("wide");  // the crowd is seen first
    const inspector = makeInspector(page), legend = makeLegend(page), controls = makeControls(page);
    page.overlays = makeOverlays(page);
    page.lesson = makeLesson(page);
    const figures = element("p", { class: "hint" }, `Of ${stage.characterCount.toLocaleString("en")} characters. All are solved, drawn or not.`);
    const panel = element("aside", { "aria-label": "Panel" }, inspector, legend, controls, page.overlays.box, page.lesson.box,
        section("Characters", false, drawn, figures));
    document.body.append(head, nav, panel, bar, page.help);
    listen(keys);
}

/** Draws the figure's own skin, if the file has one. Returns what went wrong, or nothing. */
async function dress(page, { skin }) {
    if (!skin) return "";
    try {
        page.view.addSkin(skin, await readSkin(skin));
        page.drawnCount = Math.min(page.drawnCount, MAX_SKINS);
        return "";
    } catch (error) {
        return `The figure's skin cannot be drawn: ${error.message.replace(/\.$/, "")}.`;
    }
}

async function open(data, canvas) {
    const stage = await openStage(data), page = new Page(stage, data, canvas);
    stage.setFrame(0);
    const fault = await dress(page, data);
    page.show();
    build(page, data);
    page.setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    page.changed();
    page.resize();
    addEventListener("resize", () => page.resize());
    addEventListener("hashchange", () => followLink(page));
    page.home();
    page.follow(stage.characterCount === 1);  // a clip's figure may walk out of the picture
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) page.player.start();
    followLink(page);
    if (fault) page.say(fault);
    page.draw();
    return page;
}

export function start(data) {
    document.head.append(element("style", {}, css));
    const canvas = document.querySelector("canvas");
    if (data === null) return refuse("This page shows no crowd: it is the program that swivel view fills.");
    const script = document.currentScript;  // null for a later call, when the page was judged already
    if (script && !isWhole(script)) return refuse("This page is damaged: its data are not those that swivel view wrote. Copy it again, or write it again.");
    document.querySelector(".refusal")?.remove();
    document.title = `${data.title} – swivel`;
    const missing = lack();
    if (missing) return refuse(`This browser has no ${missing}, which the page needs. Current versions of Firefox, Chrome, Edge and Safari have it.`);
    const ready = open(data, canvas).then((page) => {
        page.ready = ready;
        return (window.swivelPage = page);
    });
    window.swivelPage = { ready };
    return ready.catch((error) => {
        refuse(`The page stopped: ${error.message}`);
        throw error;
    });
}
