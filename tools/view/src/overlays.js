// SPDX-License-Identifier: MIT
//
// The overlays of the chosen limb: the shapes of swivel_draw(), and the geometry of the solution, which are the spheres of both bones, their
// circle, the swivel plane, the middle line and the wrist's trail. All is drawn relative to the limb's shoulder.
import { Group, Vector3 } from "three";

import { CONE, cssOf } from "./colours.js";
import { checkbox, element, section } from "./dom.js";
import { ball, clear, dashes, disc, handle, line, ring, sphere, tube, Z } from "./marks.js";
import { Feature } from "./stage.js";
import { saidOf } from "./words.js";

const TRAIL = "#2eb39a", CIRCLE = "#98a2b0";

/**
 * name: of the switch and of the group that is drawn. An overlay has either colours, in which this file draws it, or shapes, the names by
 * which swivel_draw() gives it.
 */
const OVERLAYS = [
    { name: "spheres", text: "Spheres of both bones", colours: ["#4aa3ff", "#38c6c0"], isOn: true },
    { name: "circle", text: "Circle of the elbow", colours: [CIRCLE], isOn: true },
    { name: "plane", text: "Swivel plane", colours: ["#b48bff"], isOn: true },
    { name: "middle", text: "Middle line", colours: ["#ff8a5c"], isOn: false },
    { name: "trail", text: "Trail of the wrist, through frames in order", colours: [TRAIL], isOn: false },
    { name: "goal", text: "Target, effector and miss", shapes: ["target", "goal", "effector", "miss", "prop", "bad_input"], isOn: true },
    { name: "pole", text: "Line to the pole, or a wished normal", shapes: ["pole", "normal"], isOn: true },
    { name: "allowed", text: "Elbow without limits, and where they allow it", shapes: ["wish", "allowed"], isOn: true },
    { name: "limits", text: "Limits: cones and regions", shapes: ["cone", "region"], isOn: true },
    { name: "ground", text: "Ground, anchor and shift of the body", shapes: ["anchor", "probe", "ground", "shift"], isOn: true },
    { name: "sight", text: "Line of sight", shapes: ["sight"], isOn: false },
    { name: "bones", text: "Bones as in the clip and as solved", shapes: ["incoming", "bend", "bone"], isOn: false },
    { name: "axes", text: "Axes of the root and of the hand's goal", shapes: ["axis_x", "axis_y", "axis_z"], isOn: false },
];
const MAX_TRAIL = 240;  // frames

/**
 * The chosen limb as it is solved: vectors relative to the shoulder as the clavicle moves it, the arm frame's axes, and what arm() has.
 * along: the direction of the line that the elbow swivels about, which goes to the wrist, or to the target of a limb that aims. Of length 1.
 */
export function geometryOf(stage, { limb, character }) {
    const { shoulder, axes: armAxes, ...arm } = stage.arm(limb, character), { elbows, wrists } = stage.joints(limb, character, 1);
    const place = (numbers) => new Vector3().fromArray(numbers).sub(shoulder), placeOf = (world) => place(stage.fromRoot(character, world));
    const isPoint = stage.hasPole(limb) && stage.poleIsPoint(limb), wrist = place(wrists), target = placeOf(stage.goal(limb, character, "target"));
    const way = stage.featuresOf(limb) & Feature.WITH_AIM ? target : wrist;
    return {
        ...arm, armAxes, elbow: place(elbows), wrist, target,
        pole: isPoint ? placeOf(stage.goal(limb, character, "pole")) : new Vector3().fromArray(stage.input(limb, character, "pole")),
        along: way.lengthSq() > 0 ? way.clone().normalize() : Z.clone().applyQuaternion(armAxes),
    };
}

const draw = {
    spheres(group, { wrist, upper, fore }) {
        group.add(sphere(new Vector3(), upper, "#4aa3ff"), sphere(wrist, fore, "#38c6c0"));
    },
    circle(group, { elbow, along }, { thickness }) {
        const centre = along.clone().multiplyScalar(elbow.dot(along));
        group.add(ring(centre, along, centre.distanceTo(elbow), thickness, CIRCLE));
    },
    plane(group, { elbow, wrist }) {
        const normal = wrist.clone().cross(elbow), size = 0.75 * Math.max(elbow.length(), wrist.length());
        if (normal.lengthSq() > 0) group.add(disc(wrist.clone().multiplyScalar(0.5), normal, size, "#b48bff"));
    },
    middle(group, { armAxes, upper, elbow }, { thickness }) {
        const rest = new Vector3(0, 0, upper).applyQuaternion(armAxes), middle = rest.clone().add(elbow).multiplyScalar(0.5);
        if (middle.lengthSq() > 0) middle.setLength(1.3 * upper);
        group.add(tube(new Vector3(), middle, thickness, "#ff8a5c"), dashes(rest, elbow, 0.6 * thickness, "#ff8a5c"));
    },
    trail(group, geometry, { shoulder, trail }) {
        group.add(line(trail.map((place) => place.clone().sub(shoulder)), TRAIL));
    },
};

/** A shape of swivel_draw(): a tube for a line, a ball for a point. */
function markOf({ from, to, color }, { shoulder, thickness }) {
    const start = new Vector3(...from).sub(shoulder), end = new Vector3(...to).sub(shoulder), colour = cssOf(color);
    return start.equals(end) ? ball(start, 2 * thickness, colour) : tube(start, end, 0.7 * thickness, colour);
}

/** Where the wrist of the chosen limb has been in the frames before, one after the other. */
class Trail {
    constructor() { this.points = []; }
    follow({ stage, selection: { limb, character } }) {
        const goesOn = this.limb === limb && this.character === character && (stage.frame === this.frame || stage.frame === this.frame + 1);
        if (!goesOn) this.points = [];
        if (stage.frame === this.frame) this.points.pop();
        this.points = [...this.points, new Vector3(...stage.pose(limb, character).wrist)].slice(-MAX_TRAIL);
        Object.assign(this, { limb, character, frame: stage.frame });
    }
}

/** Where the handle on the shoulder cone's rim is: a quarter of the rim from the elbow, mostly away from other handles. */
function rimOf({ armAxes, elbow, upper }, cone) {
    const axis = new Vector3().fromArray(cone).applyQuaternion(armAxes).normalize(), angle = Math.acos(cone[3]);
    const across = elbow.clone().addScaledVector(axis, -elbow.dot(axis));
    if (across.lengthSq() === 0) across.set(...(Math.abs(axis.x) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
    const aside = across.cross(axis).normalize();
    return axis.multiplyScalar(upper * Math.cos(angle)).addScaledVector(aside, upper * Math.sin(angle));
}

/** The ball on the rim of the shoulder cone: a drag opens or shuts the cone, so that its rim is at a point of the scene. */
function makeRim(page) {
    const { stage, view } = page, rim = handle(0.016 * view.figure.height, CONE);
    page.picker.addHandle("cone", rim, (world) => {
        const { limb, character } = page.selection, geometry = geometryOf(stage, page.selection);
        const at = new Vector3().fromArray(world).sub(new Vector3().fromArray(stage.shoulder(limb, character))).normalize();
        const axis = new Vector3().fromArray(stage.field(limb, "SHOULDER_CONE")).applyQuaternion(geometry.armAxes).normalize();
        page.fields.SHOULDER_CONE.set([Math.round(axis.angleTo(at) * 1800 / Math.PI) / 10]);
    });
    return rim;
}

const swatch = (colour, name = "") => element("i", { class: "swatch", style: `--swatch: ${colour}`, title: name });

/** A switch for each overlay. */
function makeSwitches(wanted, change) {
    return OVERLAYS.map(({ name, text, colours = [], isOn }) => {
        wanted[name] = isOn;
        const row = checkbox(text, isOn, (now) => {
            wanted[name] = now;
            change();
        }, { "data-overlay": name });
        row.swatches = element("span", { class: "swatches" }, ...colours.map((colour) => swatch(colour)));
        row.append(row.swatches);
        return row;
    });
}
/**
 * Shows the colours of a switch's shapes, each with its name as a hint. A switch without shapes is hidden while others have some. Swatches stay
 * while the names do, so that hints can be read while the page plays.
 */
function showShapes(row, shapes, othersHaveSome) {
    row.hidden = othersHaveSome && shapes.length === 0;
    const colours = new Map(shapes.map(({ name, color }) => [name, cssOf(color)])), names = [...colours.keys()].join();
    if (row.names === names) return;
    row.names = names;
    row.swatches.replaceChildren(...Array.from(colours, ([name, colour]) => swatch(colour, name.replace("_", " "))));
}

export function makeOverlays(page) {
    const { stage, view } = page, anchor = new Group(), groups = {}, wanted = {}, rim = makeRim(page), trail = new Trail();
    for (const { name } of OVERLAYS) anchor.add(groups[name] = new Group());
    anchor.add(rim);
    view.marks.add(anchor);
    let isAway = false;
    const update = () => {
        if (page.selection !== null) trail.follow(page);
        anchor.visible = page.selection !== null && !isAway;
        Object.values(groups).forEach(clear);
        rim.visible = false;
        const { selection } = page, drawn = anchor.visible ? stage.shapes(selection.limb, selection.character) : [];
        const shapesOf = (names) => drawn.filter(({ name }) => names.includes(name));
        OVERLAYS.forEach(({ shapes }, n) => { if (shapes) showShapes(rows[n], shapesOf(shapes), drawn.length > 0); });
        if (!anchor.visible) return;
        const geometry = geometryOf(stage, selection), shoulder = new Vector3(...stage.shoulder(selection.limb, selection.character));
        anchor.position.copy(shoulder);
        const thickness = 0.006 * (geometry.upper + geometry.fore), context = { shoulder, thickness, trail: trail.points };
        for (const { name, shapes } of OVERLAYS) {
            if (!wanted[name]) continue;
            if (shapes) shapesOf(shapes).forEach((shape) => groups[name].add(markOf(shape, context)));
            else draw[name](groups[name], geometry, context);
        }
        const cone = stage.field(selection.limb, "SHOULDER_CONE");
        rim.visible = wanted.limits && cone !== undefined;
        if (rim.visible) rim.position.copy(rimOf(geometry, cone));
    };
    const rows = makeSwitches(wanted, () => {
        update();
        page.redraw();
    });
    page.on("frame", update);
    page.on("select", update);
    page.on("select", () => {
        const limb = page.selection?.limb ?? stage.limbs[0];
        rows.forEach((row, n) => { row.words.textContent = saidOf(limb, OVERLAYS[n].text); });
    });
    update();
    /** The lesson draws entities of its own. */
    const hide = (isHidden) => {
        isAway = isHidden;
        update();
    };
    return { hide, box: section("Overlays", false, ...rows) };
}
