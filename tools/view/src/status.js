// SPDX-License-Identifier: MIT
//
// How much was solved, how fast, whether the bits are the command's, and what the page has to say.
import { element } from "./dom.js";

/** What a frame's results are beside the command's. */
const DIGEST_WORDS = {
    equal: "The same bits as the command",
    different: "Not the same bits as the command",
    changed: "Changed by you, so not the command's bits",
    none: "Not compared: the command solved no such frame",
};

const MAX_SOLVES = 60;  // that a rate is the mean of
const MIN_SECONDS = 1e-3;  // of all of them: browsers' clocks go by a tenth of that

/** So many a second, by the unit that suits. */
function rateText(rate) {
    const rounded = Number(rate.toPrecision(2));
    const [name, unit] = [[" million", 1e6], [" thousand", 1e3]].find(([, size]) => rounded >= size) ?? ["", 1];
    return `${rounded / unit}${name} a second`;
}
/** How long a solve takes. all: seconds of the last ones. The page's first solve is slow, so a rate waits for others. */
export function speedText(limbCount, all) {
    const [first, ...others] = all, sum = others.reduce((total, seconds) => total + seconds, 0);
    const mean = others.length > 0 ? sum / others.length : first, milliseconds = mean >= 1e-4 ? `${(1000 * mean).toFixed(1)} ms` : "less than 0.1 ms";
    const rate = sum >= MIN_SECONDS ? `: ${rateText(limbCount / mean)}` : "";
    return `${limbCount.toLocaleString("en")} limbs solved in ${milliseconds}${rate}`;
}

export function makeStatus(page) {
    const { stage } = page, speed = element("p", { class: "speed", "aria-live": "off" }), words = element("summary"), numbers = element("p");
    const digest = element("details", { class: "digest" }, words, element("p", { class: "clip" }, stage.data.clip), speed, numbers), all = [];
    digest.addEventListener("toggle", () => page.resize());
    page.on("frame", () => {
        if (all.push(stage.seconds) > MAX_SOLVES + 1) all.splice(1, 1);
        speed.textContent = speedText(stage.limbCount, all);
        const state = stage.digestState();
        digest.dataset.state = state;
        words.textContent = DIGEST_WORDS[state];
        numbers.textContent = `Digest ${stage.digest()}, the command's ${stage.data.digests[stage.frame] ?? "is none"}`;
    });
    const notice = element("p", { class: "notice", role: "status" });
    page.on("say", (text) => { notice.textContent = text; });
    return element("div", { class: "status" }, digest, notice);
}
