// SPDX-License-Identifier: MIT
//
// Takes back what the user has changed, step by step: goals that were moved or let go, and fields.
import { SwivelError } from "./stage.js";

const MAX_STEPS = 64;

export class Undo {
    constructor(page) {
        this.page = page;
        this.before = [];  // each step's stage.changes before it
        this.gesture = null;  // whose step is the last one
    }

    /** Makes a change that can be taken back. What one gesture, any object, changes is one step; null is a gesture of its own. */
    step(gesture, change) {
        const { changes } = this.page.stage;
        change();
        if (gesture !== null && gesture === this.gesture) return;
        this.gesture = gesture;
        this.before.push(changes);
        if (this.before.length > MAX_STEPS) this.before.shift();
    }
    get canTakeBack() { return this.before.length > 0; }
    takeBack() {
        if (!this.canTakeBack) return;
        this.gesture = null;
        try {
            this.page.stage.restore(this.before.at(-1));
            this.before.pop();
            this.page.say("");
        } catch (error) {
            if (!(error instanceof SwivelError)) throw error;
            this.page.say(`The last change stays: ${error.message}.`);
        }
        this.page.select(this.page.selection);  // switches and sliders follow
        this.page.changed();
    }
}
