// SPDX-License-Identifier: MIT
//
// Whether the page's script is the one that `swivel view` wrote. A script that is cut off does not run at all; page.html
// has a sentence for that.

/** FNV-1a of 64 bits over UTF-8, byte by byte, as 16 hexadecimal digits. Two halves of 32 bits make the number. */
export function digestOf(text) {
    const half = 2 ** 32;
    let low = 0x84222325, high = 0xcbf29ce4;
    for (const byte of new TextEncoder().encode(text)) {
        low = (low ^ byte) >>> 0;
        const product = low * 0x1b3;  // the prime is 2^40 + 0x1b3; all sums are below 2^53
        high = (high * 0x1b3 + Math.floor(product / half) + low * 0x100) % half;
        low = product % half;
    }
    return [high, low].map((each) => each.toString(16).padStart(8, "0")).join("");
}

/** script: the element. */
export const isWhole = (script) => digestOf(script.textContent) === script.dataset.digest;
