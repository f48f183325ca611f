// SPDX-License-Identifier: MIT
//
// Shapes that are drawn over the scene: surfaces one can see through, tubes in place of lines, which are a pixel wide.
import { BackSide, BufferGeometry, CylinderGeometry, DoubleSide, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, RingGeometry, SphereGeometry, TorusGeometry, Vector3 } from "three";

import { rgb } from "./colours.js";

export const Z = new Vector3(0, 0, 1);
const TOP = { depthTest: false, transparent: true };

function surface(colour, opacity) {
    return new MeshBasicMaterial({ color: rgb(colour), transparent: true, opacity, depthWrite: false, side: DoubleSide });
}
function onTop(mesh) {
    mesh.renderOrder = 15;
    return mesh;
}

export { surface };

/** A ball that one may drag, with a dark rim that parts it from any background. */
export function handle(radius, colour) {
    const made = ball(new Vector3(), radius, colour);
    const rim = new Mesh(new SphereGeometry(1.2 * radius, 20, 14), new MeshBasicMaterial({ color: rgb("#1d2733"), side: BackSide, ...TOP }));
    rim.renderOrder = 14;
    return made.add(rim);
}
/** A ball that is never hidden. */
export function ball(at, radius, colour) {
    const made = new Mesh(new SphereGeometry(radius, 20, 14), new MeshBasicMaterial({ color: rgb(colour), ...TOP, opacity: 0.95 }));
    made.position.copy(at);
    return onTop(made);
}
/** Three thin rings of a sphere, which hide nothing. */
export function sphere(centre, radius, colour) {
    const rings = [0, 1, 2].map(() => new Mesh(new TorusGeometry(radius, 0.004 * radius, 6, 96), surface(colour, 0.8)));
    rings[1].rotation.x = rings[2].rotation.y = Math.PI / 2;
    const made = new Group().add(...rings);
    made.position.copy(centre);
    return made;
}
export function tube(from, to, radius, colour) {
    const length = from.distanceTo(to), material = new MeshBasicMaterial({ color: rgb(colour), ...TOP, opacity: 0.95 });
    const made = new Mesh(new CylinderGeometry(radius, radius, length, 8), material);
    made.position.addVectors(from, to).multiplyScalar(0.5);
    if (length > 0) made.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), to.clone().sub(from).normalize());
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
