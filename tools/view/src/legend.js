// SPDX-License-Identifier: MIT
//
// What limbs are coloured by, and the legend of it.
import { SKIN } from "./bodies.js";
import { COLOUR_BY, LIMB_COLOURS } from "./colours.js";
import { element, section } from "./dom.js";
import { MAX_SKINS } from "./skins.js";
import { limbName } from "./words.js";

const SKINS = { legend: [], unit: `of the file, up to ${MAX_SKINS} characters; more are drawn as capsules` };

export function makeLegend(page) {
    const { stage, view } = page, option = (value, name) => element("option", { value }, name);
    const tells = ({ needs }) => !needs || stage.limbs.some((limb) => stage.has(limb, needs));
    const select = element("select", { "aria-label": "Colour limbs by", class: "colour" },
        ...(view.bodies.skins ? [option(SKIN, "Skin")] : []), ...COLOUR_BY.flatMap((by, n) => (tells(by) ? [option(n, by.name)] : [])));
    const list = element("ul", { class: "legend" });
    const show = () => {
        const { legend, unit } = COLOUR_BY[select.value] ?? SKINS;
        const entries = legend.length > 0 || select.value < 0 ? legend : stage.limbs.map((limb) => [LIMB_COLOURS[limb.index % LIMB_COLOURS.length], limbName(limb)]);
        list.replaceChildren(...entries.map(([colour, text]) =>
            element("li", {}, element("i", { class: "swatch", style: `--swatch: ${colour}` }), text)),
        ...(unit ? [element("li", { class: "hint" }, unit)] : []));
        view.bodies.colourBy(Number(select.value));
        page.show();
        page.redraw();
    };
    select.addEventListener("change", show);
    show();
    return section("Colour", true, element("label", { class: "row" }, "Colour limbs by", select), list);
}
