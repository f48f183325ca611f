// SPDX-License-Identifier: MIT
//
// What limbs are coloured by, and the legend of it.
import { COLOUR_BY, LIMB_COLOURS } from "./colours.js";
import { element, section } from "./dom.js";
import { limbName } from "./words.js";

export function makeLegend(page) {
    const select = element("select", { "aria-label": "Colour limbs by", class: "colour" },
        ...COLOUR_BY.map(({ name }, n) => element("option", { value: n }, name)));
    const list = element("ul", { class: "legend" });
    const show = () => {
        const { legend, unit } = COLOUR_BY[select.value];
        const entries = legend.length > 0 ? legend : page.stage.limbs.map((limb) => [LIMB_COLOURS[limb.index % LIMB_COLOURS.length], limbName(limb)]);
        list.replaceChildren(...entries.map(([colour, text]) =>
            element("li", {}, element("i", { class: "swatch", style: `--swatch: ${colour}` }), text)),
        ...(unit ? [element("li", { class: "hint" }, unit)] : []));
        page.view.bodies.colourBy(Number(select.value));
        page.redraw();
    };
    select.addEventListener("change", show);
    show();
    return section("Colour", true, element("label", { class: "row" }, "Colour limbs by", select), list);
}
