// SPDX-License-Identifier: MIT
//
// Boxes between the hands of characters that carry one, level from front to back.
import { BoxGeometry, InstancedBufferAttribute, InstancedMesh, Matrix4, Vector3 } from "three";

import bodyFragment from "./body.frag.glsl";
import boxVertex from "./box.vert.glsl";
import { BOX, rgb } from "./colours.js";
import { withShadow } from "./shaded.js";

const UP = new Vector3(0, 1, 0);

export class Boxes {
    /** box: of a character of size 1, its three sides, and how far its middle is ahead of the wrists. shared: uniforms of all that is drawn. */
    constructor(stage, [width, height, depth, ahead], shared) {
        Object.assign(this, { stage, ahead });
        this.arms = ["left_arm", "right_arm"].map((name) => stage.limbs.find((limb) => limb.name === name));
        this.carriers = stage.characters.flatMap(({ carries }, n) => (carries ? [n] : []));
        const geometry = new BoxGeometry(width, height, depth), uniforms = { ...shared, uColour: { value: rgb(BOX) } };
        this.ids = new InstancedBufferAttribute(new Float32Array(this.carriers.length), 1);
        geometry.setAttribute("carrier", this.ids);
        this.meshes = withShadow({ uniforms, vertex: [boxVertex], fragment: bodyFragment }, (material) => new InstancedMesh(geometry, material, this.carriers.length));
        this.meshes[1].instanceMatrix = this.meshes[0].instanceMatrix;
    }
    /** Puts the boxes of the first characters, and of one more unless extra is null, where the hands are now. */
    show(drawnCount, extra) {
        const shown = this.carriers.filter((n) => n < drawnCount || n === extra), matrix = new Matrix4();
        shown.forEach((character, n) => {
            this.ids.setX(n, character);
            this.meshes[0].setMatrixAt(n, this.place(character, matrix));
        });
        this.ids.needsUpdate = this.meshes[0].instanceMatrix.needsUpdate = true;
        for (const mesh of this.meshes) mesh.count = shown.length;
    }
    /** The box of a character, in the world of the clip. */
    place(character, matrix) {
        const { stage } = this, { size } = stage.characters[character];
        const [left, right] = this.arms.map((arm) => new Vector3(...stage.toWorld(character, stage.joints(arm, character, 1).wrists)));
        const x = left.clone().sub(right).normalize(), z = x.clone().cross(UP).normalize(), y = z.clone().cross(x);
        return matrix.makeBasis(x, y, z).scale(new Vector3(size, size, size)).setPosition(left.add(right).multiplyScalar(0.5).addScaledVector(z, size * this.ahead));
    }
}
