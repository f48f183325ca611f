// SPDX-License-Identifier: MIT
//
// What the solver's geometry is for the chosen limb: spheres, their circle, swivel plane, middle line, pole, the arcs
// that limits allow, and cones of limits. All is drawn relative to the limb's shoulder.
import { ConeGeometry, Group, Matrix4, Mesh, Vector3 } from "three";

import { CONE } from "./colours.js";
import { checkbox, element, section } from "./dom.js";
import { clear, dashes, disc, handle, line, sphere, surface, tube } from "./marks.js";
import { Feature, flagNames } from "./stage.js";
import { saidOf } from "./words.js";

const TRAIL = "#2eb39a", FORBIDDEN = "#e0433b", UNKNOWN = "#98a2b0", HAND_CONE = "#ffb3da";

/** name: of the switch and of the group that is drawn. colours: as they are drawn. */
const OVERLAYS = [
    { name: "spheres", text: "Spheres of both bones", colours: ["#4aa3ff", "#38c6c0"], isOn: true },
    { name: "circle", text: "Circle of the elbow: allowed, forbidden", colours: ["#43c463", FORBIDDEN], isOn: true },
    { name: "plane", text: "Swivel plane", colours: ["#b48bff"], isOn: true },
    { name: "middle", text: "Middle line", colours: ["#ff8a5c"], isOn: false },
    { name: "pole", text: "Lines to the pole, the white ball", colours: ["#98a2b0"], isOn: true },
    { name: "cones", text: "Limit cones: shoulder, hand", colours: [CONE, HAND_CONE], isOn: true },
    { name: "trail", text: "Trail of the wrist, through frames in order", colours: [TRAIL], isOn: false },
];
const MAX_TRAIL = 240;  // frames

/** The chosen limb as it is solved: vectors relative to the shoulder as the clavicle moves it, the arm frame's axes, and what arm() has. */
export function geometryOf(stage, { limb, character }) {
    const { shoulder, axes: armAxes, ...arm } = stage.arm(limb, character), { elbows, wrists } = stage.joints(limb, character, 1);
    const place = (numbers) => new Vector3().fromArray(numbers).sub(shoulder), placeOf = (world) => place(stage.fromRoot(character, world));
    const isPoint = stage.hasPole(limb) && stage.poleIsPoint(limb), wrist = place(wrists);
    return {
        ...arm, armAxes, elbow: place(elbows), wrist, target: placeOf(stage.goal(limb, character, "target")),
        pole: isPoint ? placeOf(stage.goal(limb, character, "pole")) : new Vector3().fromArray(stage.input(limb, character, "pole")),
        along: wrist.lengthSq() > 0 ? wrist.clone().normalize() : new Vector3(0, 0, 1),
    };
}
/** The circle of elbows: its centre on the line from shoulder to wrist, and its radius. */
function circleOf({ wrist, along, upper, fore }) {
    const distance = Math.max(wrist.length(), 1e-9), at = (upper ** 2 - fore ** 2 + distance ** 2) / (2 * distance);
    return { centre: along.clone().multiplyScalar(at), radius: Math.sqrt(Math.max(0, upper ** 2 - at ** 2)) };
}
const followsRule = (stage, limb) => (stage.featuresOf(limb) & (Feature.POLE_HAND | Feature.POLE_HALF_LINE)) !== 0n;
/** Whether it is known where the elbow would go. Where the hand or the wrist's place says it, that is so if the elbow is there. */
function isWishKnown(stage, { limb, character }) {
    return !followsRule(stage, limb) || !flagNames(stage.flags(limb, character)).some((name) => /^(LIMITED_(?!FLEXION)|INFEASIBLE)/.test(name));
}
/** Where the elbow would go by the pole alone, or without one as in the clip, or else where it is: at right angles to the line. */
export function wishOf(stage, { limb, character }, { pole, normal, elbow, along }) {
    const counts = stage.poleCounts(limb, character), isNormal = (stage.featuresOf(limb) & Feature.POLE_NORMAL) !== 0n;
    const wish = followsRule(stage, limb) ? elbow.clone() : counts && !isNormal ? pole.clone() : (counts ? pole : normal).clone().cross(along);
    return wish.addScaledVector(along, -wish.dot(along)).normalize();
}

const draw = {
    spheres(group, { wrist, upper, fore }) {
        group.add(sphere(new Vector3(), upper, "#4aa3ff"), sphere(wrist, fore, "#38c6c0"));
    },
    circle(group, geometry, { stage, selection, thickness }) {
        const { centre, radius } = circleOf(geometry), wish = wishOf(stage, selection, geometry);
        const side = geometry.along.clone().cross(wish), steps = 96;
        const allowed = allowedAngles(stage.arcs(selection.limb, selection.character)), isKnown = isWishKnown(stage, selection);
        const colour = (angle) => (!isKnown ? UNKNOWN : allowed(angle) ? "#43c463" : FORBIDDEN);
        const at = (angle) => centre.clone().addScaledVector(wish, radius * Math.cos(angle)).addScaledVector(side, radius * Math.sin(angle));
        for (let n = 0; n < steps; ++n) {
            const from = 2 * Math.PI * n / steps, to = 2 * Math.PI * (n + 1) / steps;
            group.add(tube(at(from), at(to), thickness, colour((from + to) / 2)));
        }
    },
    plane(group, { elbow, wrist, along }) {
        const normal = along.clone().cross(elbow), size = 0.75 * Math.max(elbow.length(), wrist.length());
        if (normal.lengthSq() > 0) group.add(disc(wrist.clone().multiplyScalar(0.5), normal, size, "#b48bff"));
    },
    middle(group, { armAxes, upper, elbow }, { thickness }) {
        const rest = new Vector3(0, 0, upper).applyQuaternion(armAxes), middle = rest.clone().add(elbow).multiplyScalar(0.5);
        if (middle.lengthSq() > 0) middle.setLength(1.3 * upper);
        group.add(tube(new Vector3(), middle, thickness, "#ff8a5c"), dashes(rest, elbow, 0.6 * thickness, "#ff8a5c"));
    },
    pole(group, { pole, elbow }, { stage, selection, length, thickness }) {
        if (!stage.hasPole(selection.limb)) return;
        const end = stage.poleIsPoint(selection.limb) ? pole : pole.clone().setLength(length);
        group.add(dashes(new Vector3(), end, 0.6 * thickness, "#98a2b0"), dashes(elbow, end, 0.6 * thickness, "#98a2b0"));
    },
    cones(group, geometry, { stage, selection, length }) {
        const cone = stage.field(selection.limb, "SHOULDER_CONE"), hand = stage.field(selection.limb, "HAND_CONE");
        if (cone) group.add(coneMesh(new Vector3().fromArray(cone).applyQuaternion(geometry.armAxes), cone[3], 0.6 * length, CONE));
        if (!hand) return;
        const mesh = coneMesh(geometry.wrist.clone().sub(geometry.elbow).normalize(), hand[3], 0.25 * length, HAND_CONE);
        mesh.position.copy(geometry.wrist);
        group.add(mesh);
    },
    trail(group, geometry, { stage, selection, trail }) {
        const shoulder = new Vector3(...stage.shoulder(selection.limb, selection.character));
        group.add(line(trail.map((place) => place.clone().sub(shoulder)), TRAIL));
    },
};

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

function allowedAngles(arcs) {
    const ends = arcs.map(({ from, to }) => {
        const start = Math.atan2(from[1], from[0]), end = Math.atan2(to[1], to[0]);
        return [start, end > start ? end - start : end - start + 2 * Math.PI];
    });
    return (angle) => ends.some(([start, width]) => (((angle - start) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI) <= width);
}
/** A cone from its tip along an axis. One that opens wider than a right angle is drawn from the other side. */
function coneMesh(axis, cos, length, colour) {
    const angle = Math.acos(Math.min(1, Math.max(-1, cos))), made = new Group();
    const height = length * Math.cos(angle), radius = Math.max(1e-6, length * Math.sin(angle));
    const cone = new Mesh(new ConeGeometry(radius, Math.abs(height), 48, 1, true), surface(colour, 0.2));
    cone.applyMatrix4(new Matrix4().makeTranslation(0, -Math.abs(height) / 2, 0).premultiply(new Matrix4().makeRotationX(height >= 0 ? Math.PI : 0)));
    made.add(cone);
    made.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), axis.clone().normalize());
    return made;
}
/** Where the handle on the shoulder cone's rim is: a quarter of the rim from the elbow, mostly away from other handles. */
function rimOf(geometry, cone, length) {
    const axis = new Vector3().fromArray(cone).applyQuaternion(geometry.armAxes).normalize(), angle = Math.acos(cone[3]);
    const across = geometry.elbow.clone().addScaledVector(axis, -geometry.elbow.dot(axis));
    if (across.lengthSq() === 0) across.set(...(Math.abs(axis.x) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
    const aside = across.cross(axis).normalize();
    return axis.multiplyScalar(0.6 * length * Math.cos(angle)).addScaledVector(aside, 0.6 * length * Math.sin(angle));
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

/** A switch for each overlay. */
function makeSwitches(wanted, change) {
    return OVERLAYS.map(({ name, text, colours, isOn }) => {
        wanted[name] = isOn;
        const row = checkbox(text, isOn, (now) => {
            wanted[name] = now;
            change();
        }, { "data-overlay": name });
        row.append(...colours.map((colour) => element("i", { class: "swatch", style: `--swatch: ${colour}` })));
        return row;
    });
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
        if (!anchor.visible) return;
        const { selection } = page, geometry = geometryOf(stage, selection), length = geometry.upper + geometry.fore;
        anchor.position.fromArray(stage.shoulder(selection.limb, selection.character));
        const context = { stage, selection, length, thickness: 0.006 * length, trail: trail.points };
        for (const { name } of OVERLAYS) if (wanted[name]) draw[name](groups[name], geometry, context);
        const cone = stage.field(selection.limb, "SHOULDER_CONE");
        rim.visible = wanted.cones && cone !== undefined;
        if (rim.visible) rim.position.copy(rimOf(geometry, cone, length));
    };
    page.on("frame", update);
    page.on("select", update);
    page.on("select", () => {
        const limb = page.selection?.limb ?? stage.limbs[0];
        rows.forEach((row, n) => { row.words.textContent = saidOf(limb, OVERLAYS[n].text); });
    });
    const rows = makeSwitches(wanted, () => {
        update();
        page.redraw();
    });
    update();
    /** The lesson draws entities of its own. */
    const hide = (isHidden) => {
        isAway = isHidden;
        update();
    };
    return { hide, box: section("Overlays", false, ...rows) };
}
