// SPDX-License-Identifier: MIT
//
// What is drawn of a figure: its bones as capsules, as thick as what hangs from them, and a ball for the head. Reads the
// clip's first frame; draws nothing.
import { Quaternion, Vector3 } from "three";

const THICKNESS = 0.057;  // of a bone that carries one unit of bones, in roots of that unit: a human arm's own

export class Figure {
    /** clip: the frames of the first character's, { first, count }. */
    constructor(data, positions, limbs, clip) {
        this.joints = data.joints;
        this.positions = positions;
        this.limbs = limbs;
        this.jointCount = data.joints.length;
        this.frameCount = positions.length / (3 * this.jointCount);  // of the clip
        this.height = this.extent(clip);
        this.hanging = this.hangingLengths();
        this.solved = this.jointsOfLimbs();
    }

    at(joint, frame = 0) { return new Vector3().fromArray(this.positions, 3 * (frame * this.jointCount + joint)); }
    children(joint) { return this.joints.flatMap(({ parent }, n) => (parent === joint ? [n] : [])); }
    boneLength(joint) {
        const { parent } = this.joints[joint];
        return parent < 0 ? 0 : this.at(joint).distanceTo(this.at(parent));
    }

    /** The largest extent of the first frame: what all else is measured by. The ground is the lowest of the first character's frames. */
    extent({ first, count }) {
        const min = new Vector3(Infinity, Infinity, Infinity), max = new Vector3(-Infinity, -Infinity, -Infinity);
        for (let joint = 0; joint < this.jointCount; ++joint) {
            min.min(this.at(joint));
            max.max(this.at(joint));
        }
        this.ground = Infinity;
        const heights = this.positions.subarray(3 * first * this.jointCount, 3 * (first + count) * this.jointCount);
        for (let n = 1; n < heights.length; n += 3) this.ground = Math.min(this.ground, heights[n]);
        const size = max.sub(min);
        return Math.max(size.x, size.y, size.z) || 1;
    }
    /** Of each joint: the lengths of its own bone and of all below it. */
    hangingLengths() {
        const lengths = this.joints.map((_, joint) => this.boneLength(joint));
        for (let joint = this.jointCount - 1; joint >= 0; --joint) {
            const { parent } = this.joints[joint];
            if (parent >= 0) lengths[parent] += lengths[joint];
        }
        return lengths;
    }
    radius(joint) { return Math.max(0.02 * this.height, THICKNESS * Math.sqrt(this.hanging[joint] * this.height)); }

    /** The joints below the upper joint of any limb: the limb is drawn in their place. */
    jointsOfLimbs() {
        const uppers = new Set(this.limbs.map(({ joints }) => joints[0])), below = new Set();
        this.joints.forEach(({ parent }, joint) => { if (uppers.has(parent) || below.has(parent)) below.add(joint); });
        return below;
    }
    /** A root on the ground is a handle to move the figure by: nothing hangs from it. */
    isHandle(joint) {
        return joint >= 0 && this.joints[joint].parent < 0 && this.at(joint).y < this.ground + 0.05 * this.height;
    }
    /** Bones of the body: { a, b, radiusA, radiusB } between two joints. */
    bodyBones() {
        const bones = [];
        this.joints.forEach(({ parent }, joint) => {
            if (parent < 0 || this.isHandle(parent) || this.solved.has(joint) || this.boneLength(joint) === 0) return;
            bones.push({ a: parent, b: joint, radiusA: this.radius(joint), radiusB: 0.85 * this.radius(joint) });
        });
        bones.push(this.head());
        return bones;
    }
    /** The head is a ball at the highest joint. */
    head() {
        let top = 0;
        for (let joint = 1; joint < this.jointCount; ++joint)
            if (!this.solved.has(joint) && this.at(joint).y > this.at(top).y) top = joint;
        const radius = 0.062 * this.height;
        return { a: top, b: top, radiusA: radius, radiusB: radius };
    }

    /** A limb's radii, and where its hand ends, in the wrist joint's frame. */
    limbShape({ joints, sources }) {
        const [, lower, end] = joints;
        const radii = [this.radius(lower), this.radius(end), 0.8 * this.radius(end)];
        const tip = new Vector3(), tips = this.children(end);
        tips.forEach((joint) => tip.add(this.at(joint)));
        if (tips.length > 0) tip.divideScalar(tips.length).sub(this.at(end)).multiplyScalar(1.3);
        else tip.copy(this.at(end)).sub(this.at(lower)).multiplyScalar(0.3);
        tip.applyQuaternion(new Quaternion().fromArray(sources.hand(0)).invert());
        return { radii, tip };
    }
}
