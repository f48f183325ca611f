// SPDX-License-Identifier: MIT
//
// Choosing a limb by a click, and dragging its wrist, its pole, the body's hips and the ground in a plane that faces the viewer.
import { Plane, Raycaster, Vector2, Vector3 } from "three";

import { CHOSEN, GROUND, HIPS } from "./colours.js";
import { hasHips, hipsOf } from "./hips.js";
import { handle } from "./marks.js";
import { footingOf, hasHills } from "./mounds.js";

const SLACK = 6;  // pixels that a click may move
const HANDLE_PIXELS = 22;
const UPRIGHT = ["hips", "ground"];  // which go up and down

export class Picker {
    /** page: main.js has it. */
    constructor(page) {
        this.page = page;
        this.caster = new Raycaster();
        this.handles = { target: this.handle(CHOSEN, 1), pole: this.handle("#ffffff", 0.7), hips: this.handle(HIPS, 1), ground: this.handle(GROUND, 1) };
        page.view.marks.add(...Object.values(this.handles));
        this.drags = {  // what a drag of each handle to a place in the world does
            target: (world) => page.drag("target", world),
            pole: (world) => page.drag("pole", world),
            hips: (world) => page.drag("hips", world),
            ground: (world) => page.drag("ground", world),
        };
        const { domElement } = page.view.renderer;
        domElement.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
        domElement.addEventListener("pointermove", (event) => this.move(event));
        domElement.addEventListener("pointerleave", () => page.lead(null));
        domElement.addEventListener("pointerup", (event) => this.up(event));
        domElement.addEventListener("pointercancel", (event) => { if (this.isPressed(event)) this.stop(); });
        page.on("frame", () => this.placeHandles());
        page.on("select", () => {
            this.stop();
            this.placeHandles();
        });
    }

    handle(colour, size) {
        const mesh = handle(0.021 * size * this.page.view.figure.height, colour);
        mesh.visible = false;
        return mesh;
    }
    /** One more handle: a mesh of the scene, and what a drag of it does. */
    addHandle(name, mesh, drag) {
        this.handles[name] = mesh;
        this.drags[name] = drag;
    }
    placeHandles() {
        const { selection, stage } = this.page;
        for (const part of ["target", "pole"]) {
            const mesh = this.handles[part];
            mesh.visible = selection !== null && selection.limb.held < 0 && (part === "target" || stage.hasPole(selection.limb));
            if (mesh.visible) mesh.position.fromArray(stage.goal(selection.limb, selection.character, part));
        }
        const { hips, ground } = this.handles;
        hips.visible = selection !== null && hasHips(stage);
        if (hips.visible) hips.position.fromArray(hipsOf(stage, selection.character));
        ground.visible = selection !== null && hasHills(stage);
        if (ground.visible) ground.position.fromArray(footingOf(stage, selection.character));
    }

    aim(event) {
        const box = event.target.getBoundingClientRect();
        const at = new Vector2((event.clientX - box.left) / box.width * 2 - 1, 1 - (event.clientY - box.top) / box.height * 2);
        this.caster.setFromCamera(at, this.page.view.camera);
        return this.caster.ray;
    }
    /** The name of the handle under the pointer, or nothing. */
    handleAt(event) {
        let best = HANDLE_PIXELS, found;
        for (const [part, mesh] of Object.entries(this.handles)) {
            if (!mesh.visible) continue;
            const { view } = this.page, at = view.project(view.toClip(mesh.getWorldPosition(new Vector3())));
            const distance = at ? Math.hypot(at.x - event.clientX, at.y - event.clientY) : Infinity;
            if (distance < best) [best, found] = [distance, part];
        }
        return found;
    }
    /** The limb under the pointer: the nearest one whose bones the ray meets. */
    limbAt(event) {
        const { stage, view } = this.page, { drawnCount, extra } = view.bodies, ray = this.aim(event), near = new Vector3(), on = new Vector3();
        const reach = 0.04 * view.figure.height * view.metres;
        let best = Infinity, found = null;
        const meet = (limb, character, a, b) => {
            const square = ray.distanceSqToSegment(view.toScene(a), view.toScene(b), near, on), distance = Math.sqrt(Math.max(0, square));  // rounding may make it negative
            const depth = ray.origin.distanceTo(near);
            if (distance < reach + 0.004 * depth && depth < best) [best, found] = [depth, { limb, character }];
        };
        const meetThose = (limb, first, count) => {
            const { elbows, wrists } = stage.joints(limb, first, count);
            for (let n = 0; n < count; ++n) {
                const who = first + n, elbow = stage.toWorld(who, elbows.subarray(3 * n, 3 * n + 3));
                meet(limb, who, stage.shoulder(limb, who), elbow);
                meet(limb, who, elbow, stage.toWorld(who, wrists.subarray(3 * n, 3 * n + 3)));
            }
        };
        for (const limb of stage.limbs) {
            meetThose(limb, 0, drawnCount);
            if (extra !== null) meetThose(limb, extra, 1);
        }
        return found;
    }

    /** Whether it is the pointer that went down first. */
    isPressed(event) { return this.pressed?.id === event.pointerId; }
    down(event) {
        if (!event.isPrimary || event.button !== 0) {
            if (!this.dragging) this.pressed = null;  // two fingers turn the camera and choose nothing
            return;
        }
        this.pressed = { id: event.pointerId, x: event.clientX, y: event.clientY };
        const part = this.handleAt(event);
        if (part) this.start(event, part);
    }
    start(event, part) {
        const { view } = this.page, at = this.handles[part].getWorldPosition(new Vector3()), facing = view.camera.getWorldDirection(new Vector3());
        if (UPRIGHT.includes(part)) facing.setY(0);
        this.dragging = { part, plane: new Plane().setFromNormalAndCoplanarPoint(facing, at) };
        view.controls.enabled = false;
        event.target.setPointerCapture(event.pointerId);
    }
    move(event) {
        this.page.lead(this.aim(event));
        if (!this.dragging) {
            event.target.style.cursor = this.handleAt(event) ? "grab" : "";
            return;
        }
        if (!this.isPressed(event)) return;
        const at = this.aim(event).intersectPlane(this.dragging.plane, new Vector3());
        if (at) this.drags[this.dragging.part](this.page.view.toClip(at));
    }
    up(event) {
        if (!this.isPressed(event)) return;
        const isClick = Math.hypot(event.clientX - this.pressed.x, event.clientY - this.pressed.y) < SLACK;
        if (isClick && !this.dragging) this.choose(this.limbAt(event));
        this.stop();
    }
    /** Chooses a limb, and goes back until its balls are beside bar and panel. */
    choose(found) {
        const { page } = this;
        page.select(found);
        if (found) page.view.makeSeen(page.pointsOf(found.limb, found.character));
    }
    stop() {
        const wasDragging = this.dragging;
        this.dragging = this.pressed = null;
        this.page.view.controls.enabled = true;
        if (wasDragging) this.page.settle();
    }
}
