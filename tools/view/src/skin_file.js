// SPDX-License-Identifier: MIT
//
// The figure's own skin, as the page's glTF file has it: meshes with their materials, and the bones that carry them.
import { Box3, Float32BufferAttribute, InstancedBufferGeometry, LoadingManager, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { bytesOf } from "./bytes.js";

const WHITE = "data:image/gif;base64,R0lGODlhAQABAIAAAP///wAAACH5BAAAAAAALAAAAAABAAEAAAICRAEAOw==";

/** A mesh's vertices, to be drawn many times. One that hangs on a joint has that as its only bone. */
function verticesOf(mesh) {
    const made = new InstancedBufferGeometry(), { index, attributes } = mesh.geometry, { count } = attributes.position;
    if (!attributes.normal) mesh.geometry.computeVertexNormals();
    made.setIndex(index);
    for (const name of ["position", "normal", "uv", "skinIndex", "skinWeight"]) if (attributes[name]) made.setAttribute(name, attributes[name]);
    if (!mesh.isSkinnedMesh) {
        const one = (value) => new Float32BufferAttribute(Float32Array.from({ length: 4 * count }, (_, n) => (n % 4 === 0 ? value : 0)), 4);
        made.setAttribute("skinIndex", one(0));
        made.setAttribute("skinWeight", one(1));
    }
    return made;
}

/**
 * { meshes: [{ geometry, material, firstBone }], bones: [{ joint, inverse }], height }. joint: of the clip; inverse: from the mesh to the joint
 * at rest; height: of all of it, in the clip's unit. A mesh's skinIndex counts bones from its firstBone on. Meshes that hang on no joint of the clip are left out.
 */
export async function readSkin({ glb, nodes }) {
    const manager = new LoadingManager();
    manager.setURLModifier((url) => (/^(blob|data):/.test(url) ? url : WHITE));  // a page asks nothing of a network
    const { parser, scene } = await new GLTFLoader(manager).parseAsync(bytesOf(glb).buffer, "");
    if (!scene) throw new Error("the file has no scene");
    scene.updateMatrixWorld(true);
    const joints = await Promise.all(nodes.map((node) => parser.getDependency("node", node))), jointOf = (object) => joints.indexOf(object);
    const carrierOf = (object) => (object === null || jointOf(object) >= 0 ? object : carrierOf(object.parent));
    const meshes = [], bones = [], firsts = new Map();
    scene.traverse((mesh) => {
        const carrier = !mesh.isMesh ? null : mesh.isSkinnedMesh ? mesh.skeleton : carrierOf(mesh);
        if (carrier === null) return;
        const its = mesh.isSkinnedMesh ? carrier.bones.map((bone, n) => ({ joint: jointOf(bone), inverse: carrier.boneInverses[n] }))
            : [{ joint: jointOf(carrier), inverse: carrier.matrixWorld.clone().invert().multiply(mesh.matrixWorld) }];
        if (its.some(({ joint }) => joint < 0)) return;
        if (!firsts.has(carrier) || !mesh.isSkinnedMesh) firsts.set(carrier, bones.push(...its) - its.length);
        meshes.push({ geometry: verticesOf(mesh), material: mesh.material, firstBone: firsts.get(carrier) });
    });
    if (meshes.length === 0) throw new Error("no mesh of it hangs on the joints");
    return { meshes, bones, height: new Box3().setFromObject(scene).getSize(new Vector3()).y };
}
