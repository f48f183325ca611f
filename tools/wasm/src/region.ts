// SPDX-License-Identifier: MIT
import { Numbers, numbers, options, real, refuse, shown, whole } from "./arguments.js";
import { layout } from "./layout.js";
import type { Borrowed, Memory } from "./memory.js";

/** A cone of a region, as swivel_region_cone: an axis of any length but 0, and the largest angle to it in radians. */
export interface RegionCone {
    axis: Numbers;
    angle: number;
}

/** Cones as they lie in memory: axis and angle are four floats. */
function putCones(cones: readonly RegionCone[], borrowed: Borrowed): number {
    if (!Array.isArray(cones)) refuse(`cones is ${shown(cones)}; give a list of { axis, angle }`);
    return borrowed.floats(cones.flatMap((each) => {
        const { axis, angle } = options("a cone", each, "axis", "angle");
        return [...Array.from(numbers("axis", axis, 3)), real("angle", angle)];
    }));
}
/** Directions one after the other, and how many they are. */
function putDirections(name: string, directions: Numbers, borrowed: Borrowed): [at: number, count: number] {
    const count = Math.ceil(numbers(name, directions).length / 3);
    return [borrowed.floats(numbers(name, directions, 3 * count)), count];
}

/**
 * Where the upper arms of a group may point: a union of cones in order, bridges between neighbours and convex polygons, less forbidden cones.
 * Swivel.region() makes one that is empty, and allows nothing. A group with a region gets Feature.WITH_REGION. Directions are in the arm frame
 * at rest, x, y, z of any length but 0: Swivel.armAxis() converts those of the character. A call that fails leaves the region as it was.
 */
export class Region {
    /** @internal */
    readonly bytes = new Uint8Array(layout.swivel_region.bytes);
    /** @internal */
    constructor(private readonly memory: Memory, behindSize: Uint8Array = new Uint8Array()) {
        const wanted = this.bytes.length - 4;
        if (behindSize.length > 0 && behindSize.length !== wanted) refuse(`a region has ${wanted} bytes behind its size, not ${behindSize.length}`);
        new Uint32Array(this.bytes.buffer)[0] = this.bytes.length;
        this.bytes.set(behindSize, 4);
    }

    /** Adds cones in order, with a bridge between neighbours. closed: bridges the last and the first, too. */
    addCones(cones: readonly RegionCone[], closed = false): this {
        return this.change((region, borrowed) => this.memory.calls.swivel_region_add_cones(region, putCones(cones, borrowed), cones.length, Number(closed)));
    }
    /** Adds a convex polygon. corners: x, y, z of each, counter-clockwise as seen from outside. */
    addPolygon(corners: Numbers): this {
        return this.change((region, borrowed) => this.memory.calls.swivel_region_add_polygon(region, ...putDirections("corners", corners, borrowed)));
    }
    /**
     * Adds cones in order that hold all these directions, each with `margin` radians, 0.01 to 1, around it: what a clip does, and a little more.
     * directions: x, y, z of each. maxCones: 1 to 6. As many are taken as allow least.
     */
    addDirections(directions: Numbers, margin: number, maxCones = 4): this {
        const max = whole("maxCones", maxCones), around = real("margin", margin);
        return this.change((region, borrowed) =>
            this.memory.calls.swivel_region_add_directions(region, ...putDirections("directions", directions, borrowed), around, max));
    }
    /** Cuts a cone out of all that is there and will be added. */
    forbid(cone: RegionCone): this {
        return this.change((region, borrowed) => this.memory.calls.swivel_region_forbid(region, putCones([cone], borrowed)));
    }
    /** The region of the same limb on the body's other side. */
    mirrored(): Region {
        return new Region(this.memory).change((region) => this.memory.calls.swivel_region_mirror(region, region), this.bytes);
    }
    /** How much room a direction has, in units of a cosine: not negative where it is allowed. */
    room(direction: Numbers): number {
        return this.memory.result(1, (out, borrowed) =>
            this.memory.calls.swivel_region_room(this.put(borrowed), borrowed.floats(numbers("direction", direction, 3)), out))[0];
    }
    /** @internal */
    put(borrowed: Borrowed, bytes = this.bytes): number {
        const at = borrowed.bytes(bytes.length);
        this.memory.bytes(at, bytes.length).set(bytes);
        return at;
    }

    /** Takes the bytes that a call makes of these. */
    private change(call: (region: number, borrowed: Borrowed) => number, from = this.bytes): this {
        return this.memory.borrow((borrowed) => {
            const at = this.put(borrowed, from);
            this.memory.check(call(at, borrowed));
            this.bytes.set(this.memory.bytes(at, from.length));
            return this;
        });
    }
}
