// SPDX-License-Identifier: MIT
//
// Elements of the page. Text is always text, whatever it holds.

export function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
}

export function button(text, act, attributes = {}) {
    const made = element("button", { type: "button", ...attributes }, text);
    made.addEventListener("click", act);
    return made;
}

/** A part of the side panel that opens and closes. */
export function section(title, isOpen, ...children) {
    const made = element("details", {}, element("summary", {}, title), ...children);
    made.open = isOpen;
    return made;
}

export function checkbox(text, isOn, act, attributes = {}) {
    const box = element("input", { type: "checkbox", ...attributes });
    box.checked = isOn;
    box.addEventListener("change", () => act(box.checked));
    const words = element("span", {}, text);
    return Object.assign(element("label", { class: "check" }, box, words), { box, words });
}

/** A number with its slider. act gets the number. */
export function slider(text, { min, max, step, value, unit = "" }, act) {
    const input = element("input", { type: "range", min, max, step, value, "aria-label": text });
    const shown = element("output", {}, `${value}${unit}`);
    input.addEventListener("input", () => {
        shown.textContent = `${input.value}${unit}`;
        act(Number(input.value));
    });
    const set = (number) => {
        input.value = number;
        shown.textContent = `${input.value}${unit}`;
    };
    return Object.assign(element("label", { class: "slider" }, element("span", {}, text), input, shown), { input, set });
}

/** Rows of names and values. */
export function facts(rows) {
    return element("dl", {}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}
