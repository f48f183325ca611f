// SPDX-License-Identifier: MIT
//
// How much was solved, how fast, whether the bits are the command's, and what the page has to say.
import { element } from "./dom.js";

/** What a frame's digest is beside the command's. */
const DIGEST_WORDS = {
    equal: () => "equal to the command's",
    different: (native) => `not the command's ${native}: these bits differ`,
    changed: (native) => `changed by you from the command's ${native}`,
    "out of order": (native) => `the command's ${native} is comparable if you play from the first frame, because this crowd carries state`,
    none: () => "the command solved no such frame",
};

export function makeStatus(page) {
    const { stage } = page, speed = element("p", { class: "speed", "aria-live": "off" }), digest = element("p", { class: "digest" });
    page.on("frame", () => {
        const count = stage.limbCount.toLocaleString("en"), rate = stage.armsPerSecond / 1e6;
        speed.textContent = `${count} limbs solved in ${(stage.seconds * 1000).toFixed(1)} ms: ${rate.toFixed(1)} million a second`;
        const state = stage.digestState();
        digest.dataset.state = state;
        digest.textContent = `digest ${stage.digests().join(" ")}, ${DIGEST_WORDS[state](stage.data.digests[stage.frame]?.join(" "))}`;
    });
    const notice = element("p", { class: "notice", role: "status" });
    page.on("say", (text) => { notice.textContent = text; });
    return element("div", { class: "status" }, speed, digest, notice);
}
