// SPDX-License-Identifier: MIT
//
// Whether the page's script is the one that `swivel view` wrote. A script that is cut off does not run at all; page.html
// has a sentence for that.

/** FNV-1a of 64 bits over UTF-8, byte by byte, as 16 hexadecimal digits. Four quarters of 16 bits make the number. */
export function digestOf(text) {
    let [a, b, c, d] = [0x2325, 0x8422, 0x9ce4, 0xcbf2];  // from the lowest on
    for (const byte of new TextEncoder().encode(text)) {
        a ^= byte;
        const [low, high] = [a, b];  // the prime is 2^40 + 0x1b3; no number reaches 2^31
        a *= 0x1b3;
        b = b * 0x1b3 + (a >>> 16);
        c = c * 0x1b3 + low * 0x100 + (b >>> 16);
        d = d * 0x1b3 + high * 0x100 + (c >>> 16);
        [a, b, c, d] = [a & 0xffff, b & 0xffff, c & 0xffff, d & 0xffff];
    }
    return [d, c, b, a].map((each) => each.toString(16).padStart(4, "0")).join("");
}

/** script: the element. */
export const isWhole = (script) => digestOf(script.textContent) === script.dataset.digest;
