// SPDX-License-Identifier: MIT
//
// usage: node tools/figure/figure.mjs strip HUMAN.glb FIGURE.glb    few triangles, mittens, no texture
//        node tools/figure/figure.mjs pack WALKING.glb FIGURE.glb   the same file in fewer bytes
// The steps of tools/figure/make that concern the mesh and how it is stored.
import { NodeIO } from "@gltf-transform/core";
import { MeshoptSimplifier } from "meshoptimizer";
import { Vector3 } from "three";
import { ConvexHull } from "three/addons/math/ConvexHull.js";

const TRIANGLES = 1650;
const COLOUR = [0.33, 0.42, 0.55, 1];
const isKept = (joint) => !/^(index|middle|ring|pinky|thumb)_|_leaf/.test(joint.getName());
const accessor = (document, array, type, normalized = false) =>
    document.createAccessor().setArray(array).setType(type).setNormalized(normalized).setBuffer(document.getRoot().listBuffers()[0]);

/** For each vertex, the first one at the same place. */
function welded(positions) {
    const firsts = new Map();
    return Uint32Array.from({ length: positions.length / 3 }, (_, n) => {
        const place = positions.slice(3 * n, 3 * n + 3).join();
        return firsts.get(place) ?? firsts.set(place, n).get(place);
    });
}
/** The triangles with the convex hull of each group of vertices in place of those between its own. groupOf: of a vertex, or undefined. */
function withHulls(indices, positions, groupOf) {
    const kept = [], groups = new Map();
    for (let n = 0; n < indices.length; n += 3) {
        const triangle = [...indices.slice(n, n + 3)], [first, ...others] = triangle.map(groupOf);
        if (first === undefined || others.some((other) => other !== first)) kept.push(...triangle);
        else groups.set(first, new Set([...groups.get(first) ?? [], ...triangle]));
    }
    for (const vertices of groups.values()) {
        const points = [...vertices].map((n) => Object.assign(new Vector3().fromArray(positions, 3 * n), { n }));
        for (const { edge } of new ConvexHull().setFromPoints(points).faces)
            kept.push(...[edge, edge.next, edge.next.next].map((each) => each.head().point.n));
    }
    return Uint32Array.from(kept);
}
/** Unit normals, of triangles by their areas. */
function normalsOf(positions, indices) {
    const normals = new Float32Array(positions.length);
    for (let n = 0; n < indices.length; n += 3) {
        const [a, b, c] = indices.slice(n, n + 3), side = (to) => [0, 1, 2].map((axis) => positions[3 * to + axis] - positions[3 * a + axis]);
        const [x, y, z] = side(b), [u, v, w] = side(c), area = [y * w - z * v, z * u - x * w, x * v - y * u];
        for (const vertex of [a, b, c]) area.forEach((part, axis) => { normals[3 * vertex + axis] += part; });
    }
    return normals.map((part, n) => part / Math.hypot(...normals.slice(n - n % 3, n - n % 3 + 3)));
}
/** Four weights in bytes, 255 in all; each joint once. */
function carried(pairs) {
    const sums = new Map();
    for (const [joint, weight] of pairs) sums.set(joint, (sums.get(joint) ?? 0) + weight);
    const four = [...sums].filter(([, weight]) => weight > 0).sort(([, a], [, b]) => b - a).slice(0, 4), sum = four.reduce((all, [, weight]) => all + weight, 0);
    const bytes = four.map(([joint, weight]) => [joint, Math.round(255 * weight / sum)]).filter(([, byte]) => byte > 0);
    bytes[0][1] += 255 - bytes.reduce((all, [, byte]) => all + byte, 0);
    while (bytes.length < 4) bytes.push([0, 0]);
    return bytes;
}

async function strip(document) {
    const root = document.getRoot(), [skin] = root.listSkins(), [primitive] = root.listMeshes()[0].listPrimitives();
    const all = skin.listJoints(), kept = all.filter(isKept), inverses = skin.getInverseBindMatrices();
    const keptOf = (joint) => (isKept(joint) ? kept.indexOf(joint) : keptOf(joint.getParentNode()));
    const place = all.map(keptOf);
    const [positions, joints, weights] = ["POSITION", "JOINTS_0", "WEIGHTS_0"].map((name) => primitive.getAttribute(name));
    const remap = welded(positions.getArray()), whole = Uint32Array.from(primitive.getIndices().getArray(), (n) => remap[n]);
    const heaviest = (n) => weights.getElement(n, []).reduce((best, weight, k, all) => (weight > all[best] ? k : best), 0);
    const fingers = ["index|middle|ring|pinky", "thumb"].map((name) => new RegExp(`^(${name})_.*_([lr])$`));
    const mittenOf = (n) => {
        const name = all[joints.getElement(n, [])[heaviest(n)]].getName();
        return fingers.map((finger, which) => finger.exec(name)?.[2].concat(which)).find((found) => found);
    };
    await MeshoptSimplifier.ready;
    const [indices] = MeshoptSimplifier.simplify(withHulls(whole, positions.getArray(), mittenOf), positions.getArray(), 3, 3 * TRIANGLES, 0.05);
    const [places, count] = MeshoptSimplifier.compactMesh(indices), vertices = new Uint32Array(count);
    places.forEach((to, from) => { if (to < count) vertices[to] = from; });
    const at = Float32Array.from([...vertices].flatMap((n) => positions.getElement(n, [])));
    const bones = [...vertices].map((n) => carried(joints.getElement(n, []).map((joint, k) => [place[joint], weights.getElement(n, [])[k]])));
    const set = (name, array, type, normalized) => primitive.setAttribute(name, accessor(document, array, type, normalized));
    set("POSITION", at, "VEC3");
    set("NORMAL", normalsOf(at, indices), "VEC3");
    set("JOINTS_0", Uint8Array.from(bones.flatMap((four) => four.map(([joint]) => joint))), "VEC4");
    set("WEIGHTS_0", Uint8Array.from(bones.flatMap((four) => four.map(([, byte]) => byte))), "VEC4", true);
    primitive.setAttribute("TEXCOORD_0", null).setIndices(accessor(document, Uint16Array.from(indices), "SCALAR"));
    primitive.setMaterial(document.createMaterial("Figure").setBaseColorFactor(COLOUR).setMetallicFactor(0).setRoughnessFactor(0.8));
    skin.setInverseBindMatrices(accessor(document, Float32Array.from(kept.flatMap((joint) => inverses.getElement(all.indexOf(joint), []))), "MAT4"));
    for (const joint of all) {
        skin.removeJoint(joint);
        if (!isKept(joint)) joint.dispose();
    }
    for (const joint of kept) skin.addJoint(joint);
    for (const old of [...root.listMaterials(), ...root.listTextures()]) if (old.getName() !== "Figure") old.dispose();
}

/** Rotations in shorts. */
function pack(document) {
    for (const sampler of document.getRoot().listAnimations().flatMap((each) => each.listSamplers())) {
        const output = sampler.getOutput();
        if (output.getType() === "VEC4") sampler.setOutput(accessor(document, Int16Array.from(output.getArray(), (part) => Math.round(32767 * part)), "VEC4", true));
    }
}

const [step, from, to] = process.argv.slice(2), steps = { strip, pack };
if (!to || !steps[step]) {
    console.error("usage: node tools/figure/figure.mjs strip|pack FROM.glb TO.glb");
    process.exit(2);
}
const io = new NodeIO(), document = await io.read(from);
await steps[step](document);
for (const each of document.getRoot().listAccessors()) if (each.listParents().length === 1) each.dispose();  // nothing uses it
await io.write(to, document);
