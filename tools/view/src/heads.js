// SPDX-License-Identifier: MIT
//
// Heads that look at a point, by looks of the library: as the crowd file says, or at the pointer. Heads that look at the pointer are a crowd
// of their own, beside the one whose bits are the command's.
import { Matrix4, Quaternion } from "three";

import { GOAL_JOINTS } from "./bytes.js";
import { Field } from "./stage.js";

const MAX_TURN = Math.cos(70 * Math.PI / 180);  // of each joint of neck and head

export class Heads {
    /** skin: as the command writes it. poses: of the characters, whose bodies stay as they are. count: of characters, at most. */
    constructor(stage, { head, face }, poses, count) {
        Object.assign(this, { stage, poses, at: null });  // at: where they look, in the world; null: ahead
        const { figure } = poses, above = figure.joints[head[0]].parent;
        this.chain = [above, ...head];
        this.below = figure.joints.flatMap((_, joint) => (this.followed(joint) >= 1 ? [joint] : []));
        if (stage.look) {
            this.rotations = new Float32Array(4 * this.chain.length * count);
            return;
        }
        const inParent = (n) => figure.at(head[n]).sub(figure.at(this.chain[n])).applyQuaternion(poses.turnOf(this.chain[n], 0).invert()).toArray();
        const skeleton = {
            parents: this.chain.map((_, n) => n - 1), translations: [0, 0, 0, ...head.flatMap((_, n) => inParent(n))], rotations: this.chain.flatMap(() => [0, 0, 0, 1]),
        };
        this.crowd = stage.swivel.bodies({ skeleton, bodyCount: count, groups: [{ look: { joints: head.map((_, n) => n + 1), axis: face, cosMax: MAX_TURN, rate: 0 } }] });
        this.rotations = this.crowd.pose("rotations");
        this.roots = this.crowd.pose("rootPosition");
        this.sizes = this.crowd.pose("rootScale");
        this.targets = this.crowd.values(Field.LOOK_TARGET);
    }
    /** The joint of the chain that one is or hangs on, by its place there; -1: none. */
    followed(joint) {
        for (let at = joint; at >= 0; at = this.poses.figure.joints[at].parent) if (this.chain.includes(at)) return this.chain.indexOf(at);
        return -1;
    }
    /** The chain's rotations as a character's clip has them now, in the world. */
    turnsOf(character) {
        const heading = this.stage.headingOf(character), frame = this.stage.clipFrame(character);
        return this.chain.map((joint) => this.poses.turnOf(joint, frame).premultiply(heading));
    }

    get isLooking() { return this.stage.look !== null || this.at !== null; }
    /** Of these characters. */
    solve(first, count) {
        if (!this.isLooking) return;
        const { stage, poses: { figure, poseSize }, chain } = this;
        if (stage.look) {  // whose joints come last
            const size = 4 * chain.length, from = (character) => poseSize * (character + 1) - 4 * GOAL_JOINTS;
            for (let n = 0; n < count; ++n) this.rotations.set(stage.poses.subarray(from(first + n), from(first + n) + size), size * n);
            return;
        }
        for (let n = 0; n < count; ++n) {
            const character = first + n, frame = stage.clipFrame(character), turns = this.turnsOf(character);
            turns.forEach((turn, k) => (k === 0 ? turn : turns[k - 1].clone().invert().multiply(turn)).toArray(this.rotations, 4 * (chain.length * n + k)));
            const { size, place } = stage.characters[character], root = figure.at(chain[0], frame).multiplyScalar(size).applyQuaternion(stage.headingOf(character));
            this.roots.set([root.x + place[0], root.y + place[1] + (stage.rises?.[4 * character] ?? 0), root.z + place[2]], 3 * n);
            this.sizes[n] = size;
            this.targets.set(this.at, 3 * n);
        }
        this.crowd.solve({ blocks: { first: 0, count: Math.ceil(count / 16) } });
    }
    /** Turns the matrices of the joints from the neck on. n: of the character in the last solve(). */
    place(character, n, matrices) {
        if (!this.isLooking) return;
        const { stage, chain } = this, were = this.turnsOf(character), turn = were[0].clone(), turned = [];
        for (let k = 1; k < chain.length; ++k) {
            turn.multiply(new Quaternion().fromArray(this.rotations, 4 * (chain.length * n + k)));
            const change = new Matrix4().makeRotationFromQuaternion(turn.clone().multiply(were[k].invert())), by = turned[k - 1];
            const was = new Matrix4().copyPosition(matrices[chain[k]]), is = was.clone();
            if (by) is.premultiply(by);
            turned[k] = new Matrix4().copyPosition(is).multiply(change).multiply(was.invert());
        }
        for (const joint of this.below) matrices[joint].premultiply(turned[this.followed(joint)]);
    }
}
