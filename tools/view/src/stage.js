// SPDX-License-Identifier: MIT
//
// The crowd and its solves: goals by the formula of the command, changes by the user, one solve for all limbs. Knows the
// solver; nothing is drawn here. World coordinates are the clip's.
import { instantiate } from "swivel-wasm/instantiate.js";
import { Feature, Field, Flag, layout } from "swivel-wasm/layout.js";
import { Binding } from "swivel-wasm/binding.js";
import { Swivel } from "swivel-wasm/swivel.js";
import wasm from "view.wasm";

import { bytesOf, charactersOf, givenOf, INPUT, Sources } from "./bytes.js";

/** Opens a stage for the page's data. */
export async function openStage(data) {
    const limbCount = data.limbs.length * data.character_count;
    const megabytes = Math.min(4096, 48 + Math.ceil(limbCount / 500));
    return new Stage(await instantiate({ wasm, megabytes }), data);
}

/** The names of a flag word's flags. */
export function flagNames(word) {
    return Object.keys(Flag).filter((name) => (word & Flag[name]) !== 0);
}

/** The name of the feature that brings a field. */
const featureOf = (name) => Feature[`WITH_${name}`];

/** A vector in the world, as a limb is solved, and back: mirrored limbs are solved in the mirror image. */
const mirrored = (limb, [x, y, z]) => [limb.mirrored ? -x : x, y, z];

class Stage {
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
        this.pins = new Map();  // "limb:character" to { target, pole } in the world
        this.limbs = data.limbs.map((limb, index) => this.makeLimb(limb, index));
        this.changed = false;  // by the user, since the page was opened
        this.makeCrowds();
    }

    get characterCount() { return this.characters.length; }
    get limbCount() { return this.limbs.length * this.characterCount; }
    get armsPerSecond() { return this.limbCount / Math.max(this.seconds, 1e-9); }

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
            binding: new Binding(bytesOf(limb.binding)), effector: limb.effector, priority: limb.priority,
            fixed: new Map(limb.fixed.map(({ field, value }) => [field, value])),
            own: new Map(),  // fields' values by the user: name to numbers
            shift: { target: [0, 0, 0], pole: [0, 0, 0] },  // of everyone's goals, for a character of size 1
            planAt: this.keep(bytesOf(limb.plan)), sourcesAt: this.keep(sources), sources: new Sources(sources), inputsAt,
            inputs: this.memory.floats(inputsAt, INPUT.count * this.characters.length),
        };
    }

    /** Makes the crowds, with the features that the user's fields need. */
    makeCrowds() {
        this.crowds?.forEach((crowd) => crowd.dispose());
        this.crowds = this.data.crowds.map((shape, index) => {
            const limbs = this.limbs.filter((limb) => limb.crowdIndex === index);
            const own = limbs.flatMap((limb) => [...limb.own.keys()]);
            let features = own.reduce((all, name) => all | featureOf(name), BigInt(shape.features));
            if (features & Feature.WITH_WEIGHTS) features |= Feature.WITH_INCOMING;
            const groups = limbs.map((limb) => ({ limbCount: this.characterCount, binding: limb.binding }));
            return this.swivel.crowd(groups, features, { shoulderOrder: shape.shoulder_order, wristOrder: shape.wrist_order });
        });
        for (const limb of this.limbs) this.writeFixed(limb);
        this.carriesState = this.data.budget_blocks > 0 || this.limbs.some((limb) => this.has(limb, "NORMAL"));
        this.solvedFrames = 0;  // in order, from the first on
        this.hasSolved = false;
    }
    crowdOf(limb) { return this.crowds[limb.crowdIndex]; }
    has(limb, name) { return this.crowdOf(limb).componentCount(Field[name]) > 0; }
    writeFixed(limb) {
        const crowd = this.crowdOf(limb), { group } = limb;
        const write = (field, value) => crowd.write(field, Array.from(value).slice(0, crowd.componentCount(field)), { group });
        for (const [field, value] of limb.fixed) write(field, value);
        for (const [name, value] of limb.own) write(Field[name], value);
        if (this.has(limb, "EFFECTOR"))
            crowd.write(Field.EFFECTOR, this.characters.flatMap(({ size }) => limb.effector.map((part) => size * part)), { group });
    }

    /** Goes to a frame and solves it. */
    setFrame(frame) {
        if (this.carriesState && frame === 0 && this.frame >= 0) this.makeCrowds();
        this.frame = frame;
        this.solve();
    }
    /** Solves the frame again, with whatever has changed. */
    solve() {
        const inOrder = this.solvedFrames === this.frame;
        const before = performance.now();
        for (const limb of this.limbs) this.setGoals(limb);
        const set = performance.now();
        this.crowds.forEach((crowd) => crowd.solve(this.job()));
        this.hasSolved = true;
        this.seconds = (performance.now() - set) / 1000;
        this.goalSeconds = (set - before) / 1000;
        if (inOrder) ++this.solvedFrames;
        else if (this.carriesState) this.solvedFrames = -1;
    }
    /** With a budget the first solve is of all limbs. */
    job() {
        if (this.data.budget_blocks === 0 || !this.hasSolved) return {};
        return { priorities: this.limbs.map((limb) => [limb.priority]), mostBlocks: this.data.budget_blocks };
    }
    setGoals(limb) {
        const { calls } = this.memory, count = this.characterCount, crowd = this.crowdOf(limb);
        calls.swivel_goals(limb.planAt, limb.sourcesAt, this.frameCount, this.frame, this.charactersAt, count, limb.inputsAt);
        for (const given of this.given.get(this.frame) ?? [])
            if (given.limb === limb.index)
                for (const part of ["target", "pole", "hand"]) this.input(limb, given.character, part).set(given[part]);
        this.shiftGoals(limb);
        for (const [key, pin] of this.pins) this.setPin(limb, key, pin);
        this.memory.check(calls.swivel_goals_write(crowd.crowd, limb.group, count, limb.inputsAt));
        if (this.hasSolved && this.has(limb, "NORMAL"))
            for (let n = 0; n < count; ++n) if (this.clipFrame(n) === 0) crowd.reset({ group: limb.group, first: n, count: 1 });
    }
    shiftGoals(limb) {
        for (const part of ["target", "pole"]) {
            const shift = mirrored(limb, limb.shift[part]);
            if (shift.every((number) => number === 0)) continue;
            this.characters.forEach(({ size }, n) => {
                const at = this.input(limb, n, part);
                shift.forEach((number, axis) => { at[axis] += size * number; });
            });
        }
    }
    setPin(limb, key, pin) {
        const [index, character] = key.split(":").map(Number);
        if (index !== limb.index) return;
        for (const part of ["target", "pole"])
            if (pin[part]) this.input(limb, character, part).set(this.toSolved(limb, character, pin[part], part));
    }

    /** Part of what the solver takes of a limb: a view that a solve reads. */
    input(limb, character, part) {
        const first = character * INPUT.count + INPUT[part];
        const length = { target: 3, pole: 3, lengths: 2, position: 3 }[part] ?? 4;
        return limb.inputs.subarray(first, first + length);
    }
    clipFrame(character) { return (this.frame + this.characters[character].start) % this.frameCount; }
    /** A limb's shoulder in the world. */
    origin(limb, character) {
        const origin = limb.sources.origin(this.clipFrame(character));
        return origin.map((coordinate, axis) => coordinate + this.characters[character].place[axis]);
    }
    /** Poles may be points or directions; a direction is shown at the end of the limb. */
    poleIsPoint(limb) { return (this.featuresOf(limb) & Feature.POLE_DIRECTION) === 0n; }
    hasPole(limb) { return (this.featuresOf(limb) & (Feature.POLE_NORMAL | Feature.POLE_INCOMING)) === 0n; }
    featuresOf(limb) { return BigInt(this.data.crowds[limb.crowdIndex].features); }
    toWorld(limb, character, relative, part = "target") {
        const origin = this.origin(limb, character);
        let vector = mirrored(limb, Array.from(relative));
        if (part === "pole" && !this.poleIsPoint(limb)) {
            const length = this.armLength(limb, character) / Math.max(Math.hypot(...vector), 1e-30);
            vector = vector.map((coordinate) => coordinate * length);
        }
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
        this.changed = true;
        if (!everyone) {
            const key = `${limb.index}:${character}`;
            this.pins.set(key, { ...this.pins.get(key), [part]: world });
        } else {
            const now = this.goal(limb, character, part), { size } = this.characters[character];
            limb.shift[part] = limb.shift[part].map((shift, axis) => shift + (world[axis] - now[axis]) / size);
        }
        this.solve();
    }
    /** Gives a limb's goals back to the clip, and everyone's of that limb. Solves the crowd. */
    letGo(limb, character) {
        this.pins.delete(`${limb.index}:${character}`);
        limb.shift = { target: [0, 0, 0], pole: [0, 0, 0] };
        this.noteChanges();
        this.solve();
    }
    isDragged(limb, character) {
        return this.pins.has(`${limb.index}:${character}`) || Object.values(limb.shift).flat().some((number) => number !== 0);
    }
    noteChanges() {
        const isOwn = (limb) => limb.own.size > 0 || Object.values(limb.shift).flat().some((number) => number !== 0);
        this.changed = this.pins.size > 0 || this.limbs.some(isOwn);
    }

    /** Sets a field, by its name in Field, for all characters of some limbs; null takes it away. Solves the crowd. */
    setField(limbs, name, valueOf) {
        let isNew = false;
        for (const limb of limbs) {
            const value = valueOf && valueOf(limb);
            isNew ||= value ? !this.has(limb, name) : limb.own.has(name);
            if (value) limb.own.set(name, value);
            else limb.own.delete(name);
        }
        if (isNew) this.makeCrowds();
        else limbs.forEach((limb) => this.writeFixed(limb));
        this.noteChanges();
        this.solve();
    }
    /** What a field of a limb is for all characters: the user's, else the file's, else nothing. */
    field(limb, name) { return limb.own.get(name) ?? limb.fixed.get(Field[name]); }

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
    /** Shoulder, elbow and wrist of one limb in the world. */
    pose(limb, character) {
        const { elbows, wrists } = this.joints(limb, character, 1);
        return {
            shoulder: this.origin(limb, character),
            elbow: this.toWorld(limb, character, elbows), wrist: this.toWorld(limb, character, wrists),
        };
    }

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

export { Feature, Field, Flag, layout };
