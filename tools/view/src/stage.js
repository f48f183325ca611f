// SPDX-License-Identifier: MIT
//
// The crowd and its solves: goals by the formula of the command, changes by the user, one solve for all limbs. Knows the
// solver; nothing is drawn here. World coordinates are the clip's. A character's root is where its pose hangs: it moves along.
import { SwivelError } from "swivel-wasm/arguments.js";
import { carried, defaultGround, defaultPlant, Feature, featureRules, Field, Flag } from "swivel-wasm/layout.js";
import { Swivel } from "swivel-wasm/swivel.js";
import { Quaternion, Vector3 } from "three";

import { bytesOf, constantsOf, floatsOf, givenOf, memberOf, objectsOf, sizeOf, Sources } from "./bytes.js";
import { dragEveryone, dragOne, dropAllDrags, dropDrags, isShifted, movedParts, moveGoals, NO_SHIFT } from "./drags.js";
import { featuresFor, fieldOf, fixedOf, makeCrowd, ownWith, writeFields } from "./fields.js";
import { askedFor, seenGoal, shiftOf } from "./goals.js";
import { dragHips, dropHips, legsOf, putHips } from "./hips.js";
import { dragMound, putMounds } from "./mounds.js";

const KEPT = 64;  // frames from one state that is kept to the next, at least
const MAX_KEPT = 2 ** 28;  // bytes of them
const AT_TARGET = ["target", "goal", "axis_x", "axis_y", "axis_z"];  // shapes of a limb's group that are where it is sent
const MIN_MISS = 1e-4;  // limb lengths: a line as short as this is not seen
const NO_POLES = Feature.POLE_INCOMING | Feature.POLE_HAND | Feature.POLE_HALF_LINE;

/** The names of a flag word's flags. */
export function flagNames(word) {
    return Object.keys(Flag).filter((name) => (word & Flag[name]) !== 0);
}

/** What the solver is asked for of each character: its limbs, and as one more limb how its head looks. */
export const askedOf = ({ limbs, look }) => [...limbs, ...(look ? [{ name: "the heads", ...look }] : [])];

export class Stage {
    constructor(memory, data) {
        this.memory = memory;
        this.swivel = new Swivel(memory);
        this.data = data;
        this.frameCount = data.frame_count;
        this.frame = -1;  // none is solved yet
        this.seconds = 0;  // of the last solve
        const { parents, translations, rotations } = data.skeleton;
        this.skeleton = { parents, translations: translations.flat(), rotations: rotations.flat() };
        const characters = bytesOf(data.characters);
        this.charactersAt = this.keep(characters);
        this.characters = objectsOf(characters, "goal_character");
        this.clips = [...new Set(this.characters.map(({ first }) => first))].sort((a, b) => a - b);  // their first frames
        this.ground = data.ground && this.makeGround(data.ground);
        this.given = givenOf(data.given);
        this.mounds = [];  // of the ground, by the user
        this.hips = new Map();  // heights that bodies' shifts wish for, by the user
        this.pins = new Map();  // goals moved alone: "limb:character" to { target, pole } in the world
        const asked = askedOf(data);
        this.inputCount = asked.length;  // of a character
        this.plansAt = this.keep(asked.flatMap(({ plan }) => Array.from(bytesOf(plan))));
        this.limbs = data.limbs.map((limb, index) => this.makeLimb(limb, index));
        this.look = data.look ? this.makeLook(data.look) : null;
        this.sourcesAt = memory.allocate(4 * asked.length);
        memory.words(this.sourcesAt, asked.length).set([...this.limbs, ...(this.look ? [this.look] : [])].map(({ sourcesAt }) => sourcesAt));
        this.rootsAt = memory.allocate(sizeOf("goal_root") * this.characterCount);
        this.inputsAt = memory.allocate(sizeOf("goal_input") * this.inputCount * this.characterCount);
        this.changed = false;  // by the user, since the page was opened
        this.makeCrowd();
    }

    makeGround({ grid, heights }) {
        const bytes = bytesOf(grid), own = floatsOf(heights), at = this.keep(bytes), heightsAt = heights === "" ? 0 : this.keep(new Uint8Array(own.buffer));
        const [{ place: middle, size, columns, rows }] = objectsOf(bytes, "goal_ground");
        return { middle, size, columns, rows, own, pointers: [at, heightsAt] };
    }
    get characterCount() { return this.characters.length; }
    get limbCount() { return this.limbs.length * this.characterCount; }

    /** Bytes that stay in the module's memory. */
    keep(bytes) {
        const at = this.memory.allocate(bytes.length);
        this.memory.bytes(at, bytes.length).set(bytes);
        return at;
    }
    /** Floats that stay there, zeros at first. */
    zeros(count) { return this.memory.floats(this.keep(new Uint8Array(4 * count)), count); }
    makeLimb(limb, index) {
        const sources = bytesOf(limb.sources), { shoulder, twist_bones: twistBones, bend } = limb;
        const plan = (member) => memberOf(this.memory.buffer, this.plansAt + index * sizeOf("goal_plan"), "goal_plan", member);
        return {
            index, name: limb.name, joints: limb.joints, features: BigInt(limb.features), region: limb.region && bytesOf(limb.region),
            shoulderOrder: limb.shoulder_order, wristOrder: limb.wrist_order, poleBehind: limb.pole_behind,
            plant: limb.ground && constantsOf(limb.plant, defaultPlant), ground: limb.ground && constantsOf(limb.ground, defaultGround),
            chain: { shoulder, elbow: shoulder + 1, wrist: shoulder + 2, twistBones, bend },  // in the crowd's skeleton
            fixed: fixedOf(limb),
            own: new Map(),  // fields' values by the user: name to numbers, or to null for one taken away; never written to
            weights: plan("weights"),  // of goals, the pole's where that counts
            targetOffset: plan("target_offset"), hasFixedPole: plan("has_pole_fixed")[0] === 1,
            held: plan("holds")[0] - 1,  // the limb whose hand it holds; -1: none
            shift: NO_SHIFT,  // of everyone's goals, for a character of size 1
            sourcesAt: this.keep(sources), sources: new Sources(sources),
        };
    }

    makeLook({ sources, joint_count: count, axis, cos_max: cosMax }) {
        const first = this.skeleton.parents.length - 3;  // in the crowd's skeleton, whose last joints are a shoulder, elbow and wrist
        return { sourcesAt: this.keep(bytesOf(sources)), how: { joints: Array.from({ length: count }, (_, n) => first + n), axis, cosMax } };
    }

    /** Makes the crowd, with the features that the user's fields need. The old one stays if that fails. */
    makeCrowd() {
        const made = makeCrowd(this.swivel, this.skeleton, this.limbs, this.look?.how, this.characterCount);
        this.crowd?.dispose();
        this.crowd = made;
        const { calls } = this.memory, poseSize = calls.swivel_goal_pose_size(made.crowd);
        this.poses ??= this.zeros(poseSize * this.characterCount);
        this.offsetsAt ??= this.memory.allocate(2 * poseSize);  // bytes: half as many words
        calls.swivel_goals_pose(made.crowd, this.charactersAt, this.rootsAt, this.inputsAt, this.poses.byteOffset, this.offsetsAt, made.posed);
        this.urgency ??= new Float32Array(made.blockCount);  // of a budget
        this.urgency.fill(0);
        this.groups = Array.from({ length: made.groupCount }, (_, group) => group);
        this.carriesState = this.data.budget_blocks > 0 || this.groups.some((group) => this.carries(group));
        this.solvedFrames = 0;  // in order, from the first on; -1: not in order
        this.hasSolved = false;
        this.states = new Map();  // what solves start from, by frame
        this.kept = KEPT;  // frames between them
        this.isHeld = false;  // by the user, who drags something
    }
    has(limb, name) { return this.crowd.componentCount(Field[name], limb.index) > 0; }
    /** Whether a group's solves start from its last results. */
    carries(group) { return carried.some((field) => this.crowd.componentCount(field, group) > 0); }

    /** Goes to a frame and solves it. A crowd that carries state solves all that lies between, so a frame looks the same however it was reached. */
    setFrame(frame) {
        if (this.carriesState && frame !== (this.isHeld ? this.frame + 1 : this.solvedFrames)) return this.replay(frame);
        this.frame = frame;
        this.solve();
    }
    /** Solves a frame and those before it, from the last one whose state is kept. */
    replay(frame) {
        const from = Math.max(...Array.from(this.states.keys()).filter((kept) => kept <= frame));
        if (Number.isFinite(from)) this.putState(this.states.get(from));
        else if (this.hasSolved) this.makeCrowd();
        this.solvedFrames = Math.max(from, 0);
        for (this.frame = this.solvedFrames; this.frame < frame; ++this.frame) this.solve();
        this.solve();
    }
    takeState() {
        return { rows: this.groups.map((group) => this.crowd.resultRows(group).slice()), poses: this.poses.slice(), urgency: this.urgency.slice(), hasSolved: this.hasSolved };
    }
    putState({ rows, poses, urgency, hasSolved }) {
        this.groups.forEach((group) => this.crowd.resultRows(group).set(rows[group]));
        this.poses.set(poses);
        this.urgency.set(urgency);
        this.hasSolved = hasSolved;
    }
    /** After a change of what is asked for: states that are kept came without it, but for the first. */
    forgetStates() {
        for (const frame of this.states.keys()) if (frame > 0) this.states.delete(frame);
        this.solvedFrames = -1;
    }
    /** Keeps what this frame's solve starts from; every other one goes where they take too much. */
    keepState() {
        const bytes = this.groups.reduce((sum, group) => sum + this.crowd.resultRows(group).byteLength, this.poses.byteLength);
        if (this.states.size * bytes > MAX_KEPT) {
            this.kept *= 2;
            for (const frame of this.states.keys()) if (frame % this.kept > 0) this.states.delete(frame);
        }
        if (this.frame % this.kept === 0) this.states.set(this.frame, this.takeState());
    }
    /** Solves the frame again, after a change. Its state at hand goes on, until another frame is looked at or settle() is called. */
    solveAgain() {
        this.forgetStates();
        this.solve();
    }
    /** After a change that is complete: solves the frame as if it had always been so. */
    settle() {
        this.isHeld = false;
        if (this.carriesState && this.solvedFrames < 0) this.replay(this.frame);
    }
    /** Solves the frame. */
    solve() {
        const inOrder = this.solvedFrames === this.frame;
        if (inOrder && this.carriesState && this.frame % this.kept === 0 && !this.states.has(this.frame)) this.keepState();
        this.askMovedGoals(this.frame);
        if (this.hasSolved) this.forgetEnds();
        const before = performance.now(), { crowd, poses, groundAt, charactersAt, rootsAt, inputsAt } = this;
        this.memory.borrow((borrowed) => this.memory.check(this.memory.calls.swivel_goals_solve(
            crowd.crowd, ...groundAt, this.data.frame_seconds, charactersAt, rootsAt, inputsAt, poses.byteOffset, this.job(borrowed).at)));
        this.hasSolved = true;
        this.seconds = (performance.now() - before) / 1000;
        this.solvedFrames = inOrder ? this.frame + 1 : -1;
        this.seeRises();
    }
    get groundAt() { return this.ground?.pointers ?? [0, 0]; }
    /** How much higher each character is than the clip and its place say: its joints, and what its rows are counted from. */
    seeRises() {
        if (!this.ground) return;
        this.rises ??= new Float32Array(4 * this.characterCount);
        for (let n = 0; n < this.characterCount; ++n) {
            const lift = this.lift(n);
            this.rises.set([lift + shiftOf(this, n), lift], 4 * n);
        }
    }
    /** How much higher the ground has a character's root than the clip and its place. */
    lift(character) {
        if (!this.ground) return 0;
        const { size, place } = this.characters[character], [, height] = this.limbs[0].sources.root(this.clipFrame(character));
        return this.root(character)[1] - (place[1] + size * height);
    }
    groundHeight(x, z) { return this.memory.calls.swivel_ground_height(...this.groundAt, x, z); }
    /** With a budget the first solve is of all limbs. */
    job(borrowed) {
        const job = borrowed.structure("swivel_job");
        if (this.data.budget_blocks === 0 || !this.hasSolved) return job;
        const mask = this.crowd.choose([[1]], this.data.budget_blocks, this.urgency);
        return job.words("mask", borrowed.words(mask)).words("mask_word_count", mask.length);
    }
    /** From the clip's end to its start is no motion. */
    forgetEnds() {
        for (const group of this.groups)
            if (this.carries(group))
                for (let n = 0; n < this.characterCount; ++n) if (this.clipFrame(n) === this.characters[n].first) this.crowd.reset({ group, first: n, count: 1 });
    }
    /** The goals as the command has them. */
    askGoals() {
        this.memory.calls.swivel_goals(this.plansAt, this.sourcesAt, this.inputCount, this.frame, ...this.groundAt,
            this.charactersAt, this.characterCount, this.rootsAt, this.inputsAt);
        for (const { character, limb: index, pole_weight: poleWeight, target, pole, hand } of this.given.get(this.frame) ?? []) {
            const limb = this.limbs[index], set = (part, goal) => this.input(limb, character, part).set(goal);
            set("target", target), set("pole", pole), set("hand", hand);
            set("weights", [limb.weights[0], limb.weights[1], poleWeight > 0 ? limb.weights[2] : 0]);
        }
    }
    /** The goals of a frame as the user has moved them. Solves nothing: who looks at another frame goes back to the one that is shown. */
    askMovedGoals(frame) {
        this.frame = frame;
        this.askGoals();
        this.limbs.forEach((limb) => moveGoals(this, limb));
    }

    /** Part of what the solver takes of a limb: a view that a solve reads. Goals are in the world. */
    input(limb, character, part) {
        const at = this.inputsAt + (character * this.inputCount + limb.index) * sizeOf("goal_input");
        return memberOf(this.memory.buffer, at, "goal_input", part);
    }
    /** Sets a goal for the next solve, which then counts. With a pole the target counts, too, as in a table. */
    setGoal(limb, character, part, goal) {
        this.input(limb, character, part).set(goal);
        const weights = this.input(limb, character, "weights");
        weights.set(part === "pole" ? limb.weights : limb.weights.slice(0, 2));
    }
    clipFrame(character) {
        const { first, start, count } = this.characters[character];
        return first + (this.frame + start) % count;
    }
    /** How a character is turned about y. */
    headingOf(character) {
        const { heading } = this.characters[character];
        return new Quaternion(0, 2 * heading, 0, 1 - heading * heading).normalize();
    }
    /** A limb's shoulder in the clip, before its clavicle has turned. */
    origin(limb, character) {
        const origin = new Vector3(...limb.sources.origin(this.clipFrame(character))).applyQuaternion(this.headingOf(character)).toArray();
        const { size, place } = this.characters[character];
        return origin.map((coordinate, axis) => size * coordinate + place[axis] + (axis === 1 ? this.lift(character) : 0));
    }
    armLength(limb, character) {
        const [upper, fore] = limb.sources.lengths(this.clipFrame(character));
        return this.characters[character].size * (upper + fore);
    }
    /** Of the longest of its legs that stand. */
    legLength(character) { return Math.max(...legsOf(this).map((leg) => this.armLength(leg, character))); }
    featuresOf(limb) { return this.crowd.features(limb.index); }
    /** Poles may be points or directions; a direction is shown at the end of the limb. */
    poleIsPoint(limb) { return (this.featuresOf(limb) & Feature.POLE_DIRECTION) === 0n; }
    isPoint(limb, part) { return part === "target" || this.poleIsPoint(limb); }
    hasPole(limb) { return (this.featuresOf(limb) & (Feature.POLE_NORMAL | NO_POLES)) === 0n; }
    /** Whether the elbow goes by a pole. Without one it goes as in the clip, or as the hand or the wrist's place says. */
    poleCounts(limb, character) {
        if ((this.featuresOf(limb) & NO_POLES) !== 0n) return false;
        return !this.has(limb, "WEIGHTS") || this.input(limb, character, "weights")[2] > 0;
    }
    /** The goal that a place in the world stands for. */
    toGoal(limb, character, part, world) {
        const origin = this.origin(limb, character);
        return this.isPoint(limb, part) ? world : world.map((coordinate, axis) => coordinate - origin[axis]);
    }
    /** Where a goal is seen. */
    goal(limb, character, part) { return seenGoal(this, limb, character, part); }

    /** Moves a goal or the hips to a place in the world, of this limb alone or by the same offset of everyone's; or the ground. Solves the crowd. */
    drag(limb, character, part, world, everyone) {
        if (part === "ground") dragMound(this, character, world);
        else if (part === "hips") dragHips(this, character, world, everyone);
        else (everyone ? dragEveryone : dragOne)(this, limb, character, part, askedFor(this, limb, character, part, world));
        this.changed = this.isHeld = true;
        this.solveAgain();
    }
    /** Gives a limb's goals back to the clip, everyone's of that limb, and the character's hips. Solves the crowd. */
    letGo(limb, character) {
        dropDrags(this, limb, character);
        dropHips(this, character);
        this.noteChanges();
        this.solveAgain();
        this.settle();
    }
    letAllGo() {
        dropAllDrags(this);
        putHips(this, new Map());
        putMounds(this, []);
        this.noteChanges();
        this.solveAgain();
        this.settle();
    }
    isAnyGoalMoved() { return this.pins.size > 0 || this.limbs.some(isShifted); }
    isAnyDragged() { return this.isAnyGoalMoved() || this.hips.size > 0 || this.mounds.length > 0; }
    movedParts(limb, character) { return movedParts(this, limb, character); }
    noteChanges() { this.changed = this.isAnyDragged() || this.limbs.some((limb) => limb.own.size > 0); }

    /** Sets a field, by its name in Field, for all characters of some limbs; null takes it away. Solves the crowd. Changes nothing if it fails. */
    setField(limbs, name, valueOf) {
        this.setOwn(this.limbs.map((limb) => (limbs.includes(limb) ? ownWith(limb, name, valueOf ? valueOf(limb) : null) : limb.own)));
        this.noteChanges();
        this.solveAgain();
    }
    /** Sets the user's fields of each limb. Changes nothing if it fails. */
    setOwn(owns) {
        const before = this.limbs.map(({ own }) => own), features = this.limbs.map(featuresFor);
        const set = (all) => this.limbs.forEach((limb, n) => { limb.own = all[n]; });
        const write = () => this.limbs.forEach((limb) => writeFields(this.crowd, limb));
        set(owns);
        try {
            this.limbs.some((limb, n) => featuresFor(limb) !== features[n]) ? this.makeCrowd() : write();
        } catch (error) {
            set(before);
            write();
            throw error;
        }
    }
    /** All that the user has changed. */
    get changes() { return { pins: new Map(this.pins), hips: this.hips, mounds: this.mounds, shifts: this.limbs.map(({ shift }) => shift), owns: this.limbs.map(({ own }) => own) }; }
    /** Takes all changes back to what they were. Solves the crowd. Changes nothing if it fails. */
    restore({ pins, hips, mounds, shifts, owns }) {
        this.setOwn(owns);
        putHips(this, hips);
        putMounds(this, mounds);
        this.pins = pins;
        this.limbs.forEach((limb, n) => { limb.shift = shifts[n]; });
        this.noteChanges();
        this.solveAgain();
        this.settle();
    }
    field(limb, name) { return fieldOf(limb, name); }

    /** Whether a limb of a body on ground has no goal of its own. */
    goesAlong(limb, character) { return this.ground !== undefined && !this.targetCounts(limb, character); }
    targetCounts(limb, character) { return !this.has(limb, "WEIGHTS") || this.input(limb, character, "weights")[0] !== 0; }

    /** The results of one limb. */
    read(limb, character, name) { return this.crowd.read(Field[name], { group: limb.index, first: character, count: 1 }); }
    flags(limb, character) { return this.read(limb, character, "FLAGS")[0]; }
    explain(limb, character) { return this.crowd.explain(character, limb.index); }
    /** In lengths of the limb; 0 for one whose target does not count. */
    residual(limb, character) {
        if (!this.targetCounts(limb, character)) return 0;
        return this.crowd.residuals({ group: limb.index, first: character, count: 1 })[0];
    }
    /**
     * The shapes of swivel_draw() in the world for a limb and for its body. A target that does not count is left out with its axes. So is a miss that
     * is too short to be seen. The flag REACHED does not tell: it is about the blend of target and incoming pose, which weights hold off the target.
     */
    shapes(limb, character) {
        const counts = this.targetCounts(limb, character), isMet = this.residual(limb, character) < MIN_MISS;
        const isShown = ({ name }) => (name === "miss" ? !isMet : counts || !AT_TARGET.includes(name));
        const isOfBody = ({ group }) => group < 0 || group >= this.limbs.length;  // or its look, or its shift
        return this.crowd.draw(character).filter((shape) => (shape.group === limb.index ? isShown(shape) : isOfBody(shape)));
    }
    /** Elbow and wrist from the root: three numbers for each of these characters. */
    joints(limb, first, count) {
        const limbs = { group: limb.index, first, count };
        return { elbows: this.crowd.elbows(limbs), wrists: this.crowd.wrists(limbs) };
    }
    /**
     * What a limb was solved from, after its clavicle has turned: its shoulder from the root, the arm frame in the world, the incoming
     * swivel plane's normal, and both bones' lengths as they came out.
     */
    arm(limb, character) {
        const record = this.read(limb, character, "RECORD"), stretch = this.has(limb, "STRETCH") ? this.read(limb, character, "STRETCH")[0] : 1;
        const axes = new Quaternion().fromArray(record, 3), [scale, upper, fore] = record.subarray(7, 10);
        const normal = new Vector3(1, 0, 0).applyQuaternion(new Quaternion().fromArray(record, 10)).applyQuaternion(axes);
        return { shoulder: new Vector3().fromArray(record), axes, normal, upper: stretch * scale * upper, fore: stretch * scale * fore };
    }
    /** A member of its goal_root. */
    rootMember(character, name) { return memberOf(this.memory.buffer, this.rootsAt + character * sizeOf("goal_root"), "goal_root", name); }
    root(character) { return this.rootMember(character, "place"); }
    /** A place from a character's root in the world, and the way back. */
    toWorld(character, place) { return Array.from(this.root(character), (coordinate, axis) => coordinate + place[axis]); }
    fromRoot(character, world) { return Array.from(this.root(character), (coordinate, axis) => world[axis] - coordinate); }
    /** A limb's shoulder in the world. */
    shoulder(limb, character) { return this.toWorld(character, this.read(limb, character, "RECORD")); }
    /** Shoulder, elbow and wrist of one limb in the world. */
    pose(limb, character) {
        const { elbows, wrists } = this.joints(limb, character, 1);
        return { shoulder: this.shoulder(limb, character), elbow: this.toWorld(character, elbows), wrist: this.toWorld(character, wrists) };
    }
    /** The elbow's flexion in radians. */
    flexion(limb, character) { return this.crowd.jointAngles({ group: limb.index, first: character, count: 1 })[3]; }

    digest() {
        const digest = this.memory.calls.swivel_goals_digest(this.crowd.crowd, this.poses.byteOffset);
        return BigInt.asUintN(64, digest).toString(16).padStart(16, "0");
    }
    /** How this frame's digest is beside the command's: "equal", "different", "changed" or "none". */
    digestState() {
        const native = this.data.digests[this.frame];
        if (!native) return "none";
        if (this.changed) return "changed";
        return this.digest() === native ? "equal" : "different";
    }
}

export { Feature, featureRules, Field, SwivelError };
