// SPDX-License-Identifier: MIT
//
// Play, pause, scrub, speed, and whether the camera follows.
import { button, checkbox, element } from "./dom.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Player {
    constructor(page, bar) {
        this.page = page;
        this.speed = 1;
        this.isPlaying = false;
        const { frameCount, data } = page.stage;
        this.rate = data.frame_seconds > 0 ? 1 / data.frame_seconds : 30;
        this.play = button("Play", () => this.toggle(), { class: "play", title: "Play or pause (space)" });
        this.scrub = element("input", { type: "range", min: 0, max: frameCount - 1, value: 0, "aria-label": "Frame", class: "scrub" });
        this.scrub.addEventListener("input", () => {
            this.pause();
            page.setFrame(Number(this.scrub.value));
        });
        this.place = element("output", { class: "place" });
        this.speeds = element("select", { "aria-label": "Speed", title: "Speed" },
            ...SPEEDS.map((speed) => element("option", { value: speed }, `${speed} ×`)));
        this.speeds.value = "1";
        this.speeds.addEventListener("change", () => { this.speed = Number(this.speeds.value); });
        const follow = checkbox("Follow", false, (isOn) => page.follow(isOn),
            { title: "The camera goes along with the chosen character, or with the middle one (F)" });
        bar.append(this.play, button("◂", () => this.step(-1), { title: "Frame before (←)", "aria-label": "Frame before" }),
            button("▸", () => this.step(1), { title: "Next frame (→)", "aria-label": "Next frame" }), this.scrub, this.place, this.speeds, follow);
        page.on("frame", () => this.show());
        page.on("select", () => { follow.box.checked = page.view.followed !== null; });
    }

    show() {
        const { frame, frameCount } = this.page.stage;
        this.scrub.value = frame;
        this.place.textContent = `${frame} / ${frameCount - 1}`;
    }
    toggle() { this.isPlaying ? this.pause() : this.start(); }
    start() {
        this.isPlaying = true;
        this.play.textContent = "Pause";
        this.since = null;
        this.next = requestAnimationFrame((now) => this.tick(now));
    }
    pause() {
        cancelAnimationFrame(this.next);
        this.isPlaying = false;
        this.play.textContent = "Play";
    }
    step(frames) {
        this.pause();
        const { frame, frameCount } = this.page.stage;
        this.page.setFrame((frame + frames + frameCount) % frameCount);
    }
    /** As many frames as time has passed. A crowd that carries state takes each of them; it may fall behind. */
    tick(now) {
        const { stage } = this.page, due = this.since === null ? 0 : Math.floor((now - this.since) / 1000 * this.rate * this.speed);
        if (this.since === null) this.since = now;
        if (due > 0) {
            this.since = due > this.rate ? now : this.since + due * 1000 / (this.rate * this.speed);
            const steps = stage.carriesState ? Math.min(due, 4) : 1, stride = stage.carriesState ? 1 : due;
            for (let n = 0; n < steps; ++n) this.page.setFrame((stage.frame + stride) % stage.frameCount);
        }
        this.next = requestAnimationFrame((later) => this.tick(later));
    }
}
