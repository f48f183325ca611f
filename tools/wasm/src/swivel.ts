// SPDX-License-Identifier: MIT
import { Numbers, numbers, refuse, shown, whole } from "./arguments.js";
import { bindJoints, Binding, LimbJoints, Skeleton } from "./binding.js";
import { Bodies, BodiesOptions } from "./bodies.js";
import { Crowd } from "./crowd.js";
import { freeGroups, Group } from "./groups.js";
import { ENTITY_COUNT, layout } from "./layout.js";
import { Memory, vector } from "./memory.js";
import { Region } from "./region.js";

/** One entity of the lecture's five steps, as swivel_entity: 32 coefficients, whose blades bladeName() names. */
export interface Entity {
    name: string;
    meaning: string;
    step: number;
    coefficients: Float64Array;
}

/** The solver in a memory of its own. load() makes it. Names, units and meanings are those of swivel.h. */
export class Swivel {
    /** @internal */
    constructor(private readonly memory: Memory) {}

    /**
     * Makes a crowd: crowd([1000], Feature.WITH_HAND). features: of groups that give none of their own. Its memory is in use until
     * Crowd.dispose().
     */
    crowd(groups: readonly Group[], features = 0n): Crowd { return new Crowd(this.memory, freeGroups(groups, features)); }
    /** Makes a crowd of bodies, which share a skeleton: whole poses go in and come out. */
    bodies(given: BodiesOptions & { rootIsDouble: true }): Bodies<Float64Array>;
    bodies(given: BodiesOptions): Bodies;
    bodies(given: BodiesOptions): Bodies<Float32Array | Float64Array> { return new Bodies(this.memory, given); }
    /** The alignments of a limb, from a skeleton's rest pose, and the lengths of its bones. */
    bindJoints(skeleton: Skeleton, joints: LimbJoints): Binding { return bindJoints(this.memory, skeleton, joints); }
    /** A region that is empty: add to it what upper arms may do. Or one from its bytes behind its size, as the command stores them. */
    region(behindSize?: Uint8Array): Region { return new Region(this.memory, behindSize); }

    /** A range of angles in radians, for twists and, three at a time, boxes. */
    range(min: number, max: number): Float32Array {
        return this.memory.result(4, (out) => this.memory.calls.swivel_range(min, max, out));
    }
    /** An axis and the largest angle to it. */
    cone(axis: Numbers, max: number): Float32Array {
        return this.memory.result(4, (out, borrowed) => this.memory.calls.swivel_cone(vector("axis", axis, borrowed), max, out));
    }
    /** The elbow's least and largest flexion. */
    flexion(min: number, max: number): Float32Array {
        return this.memory.result(2, (out) => this.memory.calls.swivel_flexion(min, max, out));
    }
    /** For Field.AIM: an axis of the hand, and the elbow's flexion. */
    aim(axis: Numbers, flexion: number): Float32Array {
        return this.memory.result(5, (out, borrowed) => this.memory.calls.swivel_aim(vector("axis", axis, borrowed), flexion, out));
    }
    /** Cosine and sine of an angle, for fields such as Field.ANGLE. */
    cosSin(angle: number): Float32Array {
        if (!Number.isFinite(angle)) refuse(`the angle is ${shown(angle)}; give radians`);
        return this.memory.result(2, (out) => {
            this.memory.calls.swivel_cos_sin(angle, out);
            return 0;
        });
    }
    /**
     * Converts a direction of the character, in the world of its rest pose, into the arm frame, where the axes of limits are.
     * parentRotation: of the shoulder's parent joint in that world.
     */
    armAxis(binding: Binding, parentRotation: Numbers, direction: Numbers): number[] {
        return this.memory.borrow((borrowed) => {
            const axis = borrowed.bytes(24), bound = borrowed.bytes(binding.bytes.length);
            this.memory.bytes(bound, binding.bytes.length).set(binding.bytes);
            const parent = borrowed.floats(numbers("parentRotation", parentRotation, 4));
            this.memory.check(this.memory.calls.swivel_arm_axis(bound, parent, vector("direction", direction, borrowed), axis));
            return Array.from(this.memory.doubles(axis, 3));
        });
    }

    /** The lecture's five steps for one arm in the arm frame, and how far their rotors put the wrist from the target. */
    steps(target: Numbers, pole: Numbers, upper: number, fore: number): { entities: Entity[]; closingError: number } {
        const { memory } = this, { bytes, name, meaning, step, coefficients } = layout.swivel_entity;
        return memory.borrow((borrowed) => {
            const [to, side] = [vector("target", target, borrowed), vector("pole", pole, borrowed)];
            const list = borrowed.bytes(bytes * ENTITY_COUNT), closing = borrowed.bytes(8);
            const why = memory.calls.swivel_steps(to, side, upper, fore, list, closing) >>> 0;
            if (why) refuse(memory.text(why));
            const entities = Array.from({ length: ENTITY_COUNT }, (_, n): Entity => {
                const at = list + n * bytes, word = (member: number): number => memory.words(at + member, 1)[0];
                return { name: memory.text(word(name)), meaning: memory.text(word(meaning)), step: word(step),
                    coefficients: memory.doubles(at + coefficients, 32).slice() };
            });
            return { entities, closingError: memory.doubles(closing, 1)[0] };
        });
    }
    /** The name of a blade of an entity, 0 to 31: "e1", "i", "e1^einf". */
    bladeName(blade: number): string { return this.memory.text(this.memory.calls.swivel_blade_name(whole("blade", blade, 31)) >>> 0); }

    /** The instruction set in use: "sse2" is WebAssembly's SIMD. */
    get isaName(): string { return this.memory.text(this.memory.calls.swivel_isa_name() >>> 0); }
}
