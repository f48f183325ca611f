// SPDX-License-Identifier: MIT
//
// Shapes that are drawn over the scene: surfaces one can see through, tubes in place of lines, which are a pixel wide.
import { BackSide, BufferGeometry, CylinderGeometry, DoubleSide, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, RingGeometry, SphereGeometry, TorusGeometry, Vector3 } from "three";

import { rgb } from "./colours.js";

const X = new Vector3(1, 0, 0), Y = new Vector3(0, 1, 0);
export const Z = new Vector3(0, 0, 1);
const TOP = { depthTest: false, transparent: true };

function surface(colour, opacity) {
    return new MeshBasicMaterial({ color: rgb(colour), transparent: true, opacity, depthWrite: false, side: DoubleSide });
}
/** The material of a mesh that is never hidden. */
function topMaterial(colour) {
    return new MeshBasicMaterial({ color: rgb(colour), ...TOP, opacity: 0.95 });
}
function onTop(mesh) {
    mesh.renderOrder = 15;
    return mesh;
}

/** A ball that one may drag, with a dark rim that parts it from any background. */
export function handle(radius, colour) {
    const made = ball(new Vector3(), radius, colour);
    const rim = new Mesh(new SphereGeometry(1.2 * radius, 20, 14), new MeshBasicMaterial({ color: rgb("#1d2733"), side: BackSide, ...TOP }));
    rim.renderOrder = 14;
    return made.add(rim);
}
/** A ball that is never hidden. */
export function ball(at, radius, colour) {
    const made = new Mesh(new SphereGeometry(radius, 20, 14), topMaterial(colour));
    made.position.copy(at);
    return onTop(made);
}
function torus(centre, axis, radius, thickness, material) {
    const made = new Mesh(new TorusGeometry(radius, thickness, 6, 96), material);
    made.position.copy(centre);
    made.quaternion.setFromUnitVectors(Z, axis);
    return made;
}
/** A ring that is never hidden. axis: of length 1. */
export function ring(centre, axis, radius, thickness, colour) {
    return onTop(torus(centre, axis, radius, thickness, topMaterial(colour)));
}
/** Three thin rings of a sphere, which hide nothing. */
export function sphere(centre, radius, colour) {
    return new Group().add(...[X, Y, Z].map((axis) => torus(centre, axis, radius, 0.004 * radius, surface(colour, 0.8))));
}
export function tube(from, to, radius, colour) {
    const length = from.distanceTo(to), made = new Mesh(new CylinderGeometry(radius, radius, length, 8), topMaterial(colour));
    made.position.addVectors(from, to).multiplyScalar(0.5);
    if (length > 0) made.quaternion.setFromUnitVectors(Y, to.clone().sub(from).normalize());
    return onTop(made);
}
/** A thin line that is never hidden. */
export function line(points, colour) {
    return onTop(new Line(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: rgb(colour), ...TOP })));
}
/** A line of short tubes. */
export function dashes(from, to, radius, colour) {
    const group = new Group(), at = (share) => from.clone().lerp(to, share);
    for (let n = 0; n < 15; n += 2) group.add(tube(at(n / 15), at((n + 1) / 15), radius, colour));
    return group;
}
/** A round piece of a plane. */
export function disc(centre, normal, radius, colour, opacity = 0.22) {
    const made = new Mesh(new RingGeometry(0, radius, 48), surface(colour, opacity));
    made.quaternion.setFromUnitVectors(Z, normal.clone().normalize());
    made.position.copy(centre);
    return made;
}
/** Empties a group and frees what it held. */
export function clear(group) {
    group.traverse((node) => {
        node.geometry?.dispose();
        node.material?.dispose();
    });
    group.clear();
}
