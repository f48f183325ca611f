// SPDX-License-Identifier: MIT
//
// The crowd and its solves: goals by the formula of the command, changes by the user, one solve for all limbs. Knows the
// solver; nothing is drawn here. World coordinates are the clip's.
import { SwivelError } from "swivel-wasm/arguments.js";
import { Binding } from "swivel-wasm/binding.js";
import { carried, Feature, featureRules, Field, Flag, layout } from "swivel-wasm/layout.js";
import { Swivel } from "swivel-wasm/swivel.js";
import { Quaternion, Vector3 } from "three";

import { bytesOf, charactersOf, givenOf, INPUT, Sources } from "./bytes.js";
import { dragEveryone, dragOne, dropAllDrags, dropDrags, isPinned, isShifted, moveGoals, NO_SHIFT, unit } from "./drags.js";
import { fieldOf, fixedOf, makeCrowds, setOwn, writeFields } from "./fields.js";

/** The names of a flag word's flags. */
export function flagNames(word) {
    return Object.keys(Flag).filter((name) => (word & Flag[name]) !== 0);
}

/** A rotation of a binding: x, y, z, w. */
export function rotationOf(binding, member) {
    const bytes = binding.bytes.slice(layout.swivel_binding[member]), rotation = Array.from(new Float32Array(bytes.buffer, 0, 4));
    return rotation.map((part) => part / Math.hypot(...rotation));
}

/** A vector in the world, as a limb is solved, and back: mirrored limbs are solved in the mirror image. */
const mirrored = (limb, [x, y, z]) => [limb.mirrored ? -x : x, y, z];

export class Stage {
    constructor(memory, data) {
        this.memory = memory;
        this.swivel = new Swivel(memory);
        this.data = data;
        this.frameCount = data.frame_count;
        this.frame = -1;  // none is solved yet
        this.seconds = 0;  // of the last solve
        const characters = bytesOf(data.characters);
        this.charactersAt = this.keep(characters);
        this.characters = charactersOf(characters);
        this.given = givenOf(data.given);
        this.pins = new Map();  // goals moved alone: "limb:character" to { target, pole } in the world
        this.limbs = data.limbs.map((limb, index) => this.makeLimb(limb, index));
        this.clipFrameCount = this.limbs[0].sources.frameCount;
        this.changed = false;  // by the user, since the page was opened
        this.crowds = [];
        this.makeCrowds();
    }

    get characterCount() { return this.characters.length; }
    get limbCount() { return this.limbs.length * this.characterCount; }

    /** Bytes that stay in the module's memory. */
    keep(bytes) {
        const at = this.memory.allocate(bytes.length);
        this.memory.bytes(at, bytes.length).set(bytes);
        return at;
    }
    makeLimb(limb, index) {
        const sources = bytesOf(limb.sources);
        const inputsAt = this.memory.allocate(4 * INPUT.count * this.characters.length);
        return {
            index, name: limb.name, mirrored: limb.mirrored, joints: limb.joints, group: limb.group, crowdIndex: limb.crowd,
            binding: new Binding(bytesOf(limb.binding)), region: limb.region && bytesOf(limb.region), effector: limb.effector, priority: limb.priority,
            fixed: fixedOf(limb.fixed),
            own: new Map(),  // fields' values by the user: name to numbers, or to null for one taken away
            shift: NO_SHIFT,  // of everyone's goals, as solved, for a character of size 1
            planAt: this.keep(bytesOf(limb.plan)), sourcesAt: this.keep(sources), sources: new Sources(sources), inputsAt,
            inputs: this.memory.floats(inputsAt, INPUT.count * this.characters.length),
        };
    }

    /** Makes the crowds, with the features that the user's fields need. The old ones stay if that fails. */
    makeCrowds() {
        const made = makeCrowds(this.swivel, this.data.crowds, this.limbs, this.characters);
        this.crowds.forEach((crowd) => crowd.dispose());
        this.crowds = made;
        this.carriesState = this.data.budget_blocks > 0 || this.limbs.some((limb) => this.carries(limb));
        this.urgency = new Float32Array(made[0].blockCount);  // of a budget, which has one crowd
        this.solvedFrames = 0;  // in order, from the first on
        this.hasSolved = false;
    }
    crowdOf(limb) { return this.crowds[limb.crowdIndex]; }
    has(limb, name) { return this.crowdOf(limb).componentCount(Field[name], limb.group) > 0; }
    /** Whether a limb's solves start from its last results. */
    carries(limb) { return carried.some((field) => this.crowdOf(limb).componentCount(field, limb.group) > 0); }
    writeFields(limb) { writeFields(this.crowdOf(limb), limb, this.characters); }

    /** Goes to a frame and solves it. */
    setFrame(frame) {
        if (this.carriesState && frame === 0 && this.frame >= 0) this.makeCrowds();
        this.frame = frame;
        this.solve();
    }
    /** Solves the frame again, with whatever has changed. */
    solve() {
        const inOrder = this.solvedFrames === this.frame;
        for (const limb of this.limbs) this.setGoals(limb);
        const before = performance.now();
        this.crowds.forEach((crowd) => crowd.solve(this.job()));
        this.hasSolved = true;
        this.seconds = (performance.now() - before) / 1000;
        if (inOrder) ++this.solvedFrames;
        else if (this.carriesState) this.solvedFrames = -1;
    }
    /** With a budget the first solve is of all limbs. */
    job() {
        if (this.data.budget_blocks === 0 || !this.hasSolved) return {};
        return { priorities: this.limbs.map((limb) => [limb.priority]), mostBlocks: this.data.budget_blocks, urgency: this.urgency };
    }
    setGoals(limb) {
        const { calls } = this.memory, count = this.characterCount, crowd = this.crowdOf(limb);
        this.askGoals(limb);
        moveGoals(this, limb);
        this.memory.check(calls.swivel_goals_write(crowd.crowd, limb.group, count, limb.inputsAt));
        if (this.hasSolved && this.carries(limb))
            for (let n = 0; n < count; ++n) if (this.clipFrame(n) === 0) crowd.reset({ group: limb.group, first: n, count: 1 });
    }
    /** The goals as the command has them. */
    askGoals(limb) {
        const { calls } = this.memory;
        calls.swivel_goals(limb.planAt, limb.sourcesAt, this.clipFrameCount, this.frame, this.charactersAt, this.characterCount, limb.inputsAt);
        for (const given of this.given.get(this.frame) ?? [])
            if (given.limb === limb.index)
                for (const part of ["target", "pole", "hand"]) this.input(limb, given.character, part).set(given[part]);
    }

    /** Part of what the solver takes of a limb: a view that a solve reads. */
    input(limb, character, part) {
        const first = character * INPUT.count + INPUT[part];
        const length = { target: 3, pole: 3, lengths: 2, position: 3 }[part] ?? 4;
        return limb.inputs.subarray(first, first + length);
    }
    clipFrame(character) { return (this.frame + this.characters[character].start) % this.clipFrameCount; }
    /** Where goals are relative to, in the world: a limb's shoulder, before its clavicle has turned. */
    origin(limb, character) {
        const origin = limb.sources.origin(this.clipFrame(character)), { size, place } = this.characters[character];
        return origin.map((coordinate, axis) => size * coordinate + place[axis]);
    }
    /** Poles may be points or directions; a direction is shown at the end of the limb. */
    poleIsPoint(limb) { return (this.featuresOf(limb) & Feature.POLE_DIRECTION) === 0n; }
    isPoint(limb, part) { return part === "target" || this.poleIsPoint(limb); }
    hasPole(limb) { return (this.featuresOf(limb) & (Feature.POLE_NORMAL | Feature.POLE_INCOMING | Feature.POLE_HAND)) === 0n; }
    featuresOf(limb) { return this.crowdOf(limb).features(limb.group); }
    toWorld(limb, character, relative, part = "target") {
        const origin = this.origin(limb, character);
        let vector = mirrored(limb, Array.from(relative));
        if (!this.isPoint(limb, part)) vector = unit(vector).map((coordinate) => coordinate * this.armLength(limb, character));
        return vector.map((coordinate, axis) => coordinate + origin[axis]);
    }
    toSolved(limb, character, world) {
        const origin = this.origin(limb, character);
        return mirrored(limb, world.map((coordinate, axis) => coordinate - origin[axis]));
    }
    armLength(limb, character) {
        const [upper, fore] = this.input(limb, character, "lengths");
        return upper + fore;
    }
    /** A goal in the world. */
    goal(limb, character, part) { return this.toWorld(limb, character, this.input(limb, character, part), part); }

    /** Moves a goal to a place in the world: of this limb alone, or by the same offset of everyone's. Solves the crowd. */
    drag(limb, character, part, world, everyone) {
        (everyone ? dragEveryone : dragOne)(this, limb, character, part, world);
        this.changed = true;
        this.solve();
    }
    /** Gives a limb's goals back to the clip, and everyone's of that limb. Solves the crowd. */
    letGo(limb, character) {
        dropDrags(this, limb, character);
        this.noteChanges();
        this.solve();
    }
    letAllGo() {
        dropAllDrags(this);
        this.noteChanges();
        this.solve();
    }
    isAnyDragged() { return this.pins.size > 0 || this.limbs.some(isShifted); }
    isDragged(limb, character) { return isPinned(this, limb, character) || isShifted(limb); }
    noteChanges() { this.changed = this.isAnyDragged() || this.limbs.some((limb) => limb.own.size > 0); }

    /** Sets a field, by its name in Field, for all characters of some limbs; null takes it away. Solves the crowd. Changes nothing if it fails. */
    setField(limbs, name, valueOf) {
        const values = limbs.map((limb) => (valueOf ? valueOf(limb) : null)), before = limbs.map(({ own }) => new Map(own));
        const isNew = limbs.some((limb) => this.has(limb, name) !== (valueOf !== null));
        const write = () => (isNew ? this.makeCrowds() : limbs.forEach((limb) => this.writeFields(limb)));
        limbs.forEach((limb, n) => setOwn(limb, name, values[n]));
        try {
            write();
        } catch (error) {
            limbs.forEach((limb, n) => { limb.own = before[n]; });
            if (!isNew) write();
            throw error;
        }
        this.noteChanges();
        this.solve();
    }
    field(limb, name) { return fieldOf(limb, name); }

    /** The results of one limb. */
    read(limb, character, name) {
        return this.crowdOf(limb).read(Field[name], { group: limb.group, first: character, count: 1 });
    }
    flags(limb, character) { return this.read(limb, character, "FLAGS")[0]; }
    explain(limb, character) { return this.crowdOf(limb).explain(character, limb.group); }
    residual(limb, character) { return this.crowdOf(limb).residuals({ group: limb.group, first: character, count: 1 })[0]; }
    arcs(limb, character) { return this.crowdOf(limb).allowedArcs(character, limb.group); }
    /** Elbow and wrist, relative to the shoulder and as solved: three numbers for each of the first characters. */
    joints(limb, first, count) {
        const limbs = { group: limb.group, first, count }, crowd = this.crowdOf(limb);
        return { elbows: crowd.elbows(limbs), wrists: crowd.wrists(limbs) };
    }
    /** What the clavicle makes of the shoulder, as solved: how far it is moved, and its parent's rotation. */
    clavicle(limb, character) {
        const parent = new Quaternion().fromArray(this.input(limb, character, "rotation")).normalize(), shift = new Vector3();
        if (!this.has(limb, "CLAVICLE")) return { shift, parent };
        const bone = new Vector3().fromArray(this.read(limb, character, "CLAVICLE"));
        const turn = new Quaternion().fromArray(this.read(limb, character, "CLAVICLE_TURN")).normalize();
        return { shift: shift.copy(bone).applyQuaternion(turn).sub(bone).applyQuaternion(parent), parent: parent.multiply(turn) };
    }
    /** A limb's shoulder in the world. */
    shoulder(limb, character) { return this.toWorld(limb, character, this.clavicle(limb, character).shift.toArray()); }
    /** Shoulder, elbow and wrist of one limb in the world. */
    pose(limb, character) {
        const { elbows, wrists } = this.joints(limb, character, 1);
        return {
            shoulder: this.shoulder(limb, character),
            elbow: this.toWorld(limb, character, elbows), wrist: this.toWorld(limb, character, wrists),
        };
    }
    /** The elbow's flexion in radians. */
    flexion(limb, character) { return this.crowdOf(limb).jointAngles({ group: limb.group, first: character, count: 1 })[3]; }

    digests() { return this.crowds.map((crowd) => crowd.digest().toString(16).padStart(16, "0")); }
    /** How this frame's digests are beside the command's: "equal", "different", "changed", "out of order" or "none". */
    digestState() {
        const native = this.data.digests[this.frame];
        if (!native) return "none";
        if (this.changed) return "changed";
        if (this.carriesState && this.solvedFrames < 0) return "out of order";
        return this.digests().every((digest, n) => digest === native[n]) ? "equal" : "different";
    }
}

export { Feature, featureRules, Field, SwivelError };
