// SPDX-License-Identifier: MIT
//
// All joints of a character as it is solved, in the world of the clip. Above and beside the limbs they are as in the clip. What hangs on
// a limb's joint goes along with it: it keeps its place there as in the clip.
import { layout } from "swivel-wasm/layout.js";
import { Matrix4, Quaternion, Vector3 } from "three";

import { floatsOf } from "./bytes.js";
import { Heads } from "./heads.js";
import { Field } from "./stage.js";

const quaternion = (numbers, at = 0) => new Quaternion().fromArray(numbers, at);
/** From rotations, each relative to the one before, to rotations in the world. */
const worldTurns = ([first, ...others]) => others.reduce((turns, local) => [...turns, turns.at(-1).clone().multiply(local)], [first]);

/** A part of the body in a character's pose: x in the clip is at `to` + size * turn(x - `from`). */
const part = (turn, from, to) => ({ turn, from, to });

export class Poses {
    /** skin: as the command writes it, with five numbers for each frame of the clip and each joint: its rotation in the world, and its scale, below 0 in a mirror. */
    constructor(stage, figure, skin, count) {
        Object.assign(this, { stage, figure, turns: floatsOf(skin.turns) });
        this.limbs = stage.limbs.map((limb) => this.bind(limb));
        this.partOf = figure.joints.map((_, joint) => this.findPart(joint));
        this.matrices = figure.joints.map(() => new Matrix4());
        this.poseSize = stage.poses.length / stage.characterCount;
        this.heads = skin.head.length > 0 && skin.head.every((joint) => figure.joints[joint].parent >= 0) ? new Heads(stage, skin, this, count) : null;
    }
    turnOf(joint, frame) { return quaternion(this.turns, 5 * (frame * this.figure.jointCount + joint)); }
    bind(limb) {
        const { stage } = this, { buffer } = stage.swivel.bindJoints(stage.skeleton, limb.chain).bytes;
        const armFromParent = quaternion(new Float32Array(buffer, layout.swivel_binding.parent_from_arm, 4)).invert();
        const before = stage.limbs.slice(0, limb.index).reduce((sum, { chain }) => sum + 4 * (4 + chain.twistBones.length), 0);
        return { limb, armFromParent, posesAt: before, inClip: new Map() };
    }
    /** The part that a joint belongs to. 0: the body; 1 + 4 * limb and on: a clavicle that turns, the upper arm, the forearm, the hand. */
    findPart(joint) {
        for (let at = joint; at >= 0; at = this.figure.joints[at].parent)
            for (const { limb } of this.limbs) {
                const [upper, lower, end] = limb.joints, clavicle = this.stage.has(limb, "CLAVICLE") ? this.figure.joints[upper].parent : -1;
                const found = [clavicle, upper, lower, end].indexOf(at);
                if (found >= 0) return 1 + 4 * limb.index + found;
            }
        return 0;
    }
    /** The number of the limb that a joint belongs to; -1: of none. */
    limbOf(joint) { return Math.floor((this.partOf[joint] - 1) / 4); }
    /** Of one frame: the shoulder, elbow and wrist in the world, and how the joints from the one above the shoulder on turn there. */
    clipOf({ limb, inClip }, frame) {
        if (!inClip.has(frame)) {
            const { places, turns } = limb.sources.joints(frame);
            inClip.set(frame, { places: places.map((place) => new Vector3(...place)), turns: worldTurns(turns.map((each) => quaternion(each))), locals: turns });
        }
        return inClip.get(frame);
    }

    /** Calls use(n, matrices) for each of these characters, n from 0 on: a matrix for each joint, which the next call overwrites. */
    each(first, count, use) {
        const { stage } = this;
        this.heads?.solve(first, count);
        const solved = stage.limbs.map((limb) => {
            const records = stage.crowd.read(Field.RECORD, { group: limb.index, first, count });
            return { records, recordSize: records.length / count, ...stage.joints(limb, first, count) };
        });
        for (let n = 0; n < count; ++n) {
            const parts = [this.bodyOf(first + n)];
            this.limbs.forEach((limb, which) => parts.push(...this.partsOf(limb, first + n, solved[which], n)));
            this.place(first + n, parts);
            this.heads?.place(first + n, n, this.matrices);
            use(n, this.matrices);
        }
    }
    bodyOf(character) {
        const { place: [x, y, z] } = this.stage.characters[character], rise = this.stage.rises?.[4 * character] ?? 0;
        return part(this.stage.headingOf(character), new Vector3(), new Vector3(x, y + rise, z));
    }
    partsOf(own, character, { records, recordSize, elbows, wrists }, n) {
        const { stage } = this, clip = this.clipOf(own, stage.clipFrame(character)), at = this.poseSize * character + own.posesAt;
        const above = quaternion(records, recordSize * n + 3).multiply(own.armFromParent);
        const locals = [1, 2, 3].map((joint) => this.localOf(at + 4 * joint, clip.locals[joint]));
        const turns = worldTurns([above, ...locals]), [x, y, z] = stage.root(character);
        const place = (from, first) => new Vector3(x + from[first], y + from[first + 1], z + from[first + 2]);
        const shoulder = place(records, recordSize * n), elbow = place(elbows, 3 * n), wrist = place(wrists, 3 * n);
        return [shoulder, shoulder, elbow, wrist].map((to, joint) =>
            part(turns[joint].multiply(clip.turns[joint].clone().invert()), clip.places[Math.max(0, joint - 1)], to));
    }
    /** A joint's own rotation as solved, or as in the clip where it is not solved. */
    localOf(at, inClip) {
        const solved = quaternion(this.stage.poses, at);
        return solved.lengthSq() > 0 ? solved : quaternion(inClip);
    }
    place(character, parts) {
        const { stage, figure, turns } = this, { size } = stage.characters[character], first = stage.clipFrame(character) * figure.jointCount;
        const at = new Vector3(), turn = new Quaternion(), scale = new Vector3();
        for (let joint = 0; joint < figure.jointCount; ++joint) {
            const { turn: turned, from, to } = parts[this.partOf[joint]], own = 5 * (first + joint);
            at.fromArray(figure.positions, 3 * (first + joint)).sub(from).applyQuaternion(turned).multiplyScalar(size).add(to);
            turn.fromArray(turns, own).premultiply(turned);
            const own_scale = size * turns[own + 4];  // below 0 in a mirror, which is in the joint's own x
            this.matrices[joint].compose(at, turn, scale.set(own_scale, Math.abs(own_scale), Math.abs(own_scale)));
        }
    }
}
