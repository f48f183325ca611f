// SPDX-License-Identifier: MIT
//
// swivel for JavaScript: the library as WebAssembly. README.md has a first program.
import { instantiate, LoadOptions } from "./instantiate.js";
import { Swivel } from "./swivel.js";

export { SwivelError } from "./arguments.js";
export type { FieldNumber, Numbers } from "./arguments.js";
export type { Binding, LimbJoints, Skeleton } from "./binding.js";
export type { Bodies, BodiesOptions, Comparison, LimbPlaces, PosePart, Support } from "./bodies.js";
export type {
    Arc, BodiesGroup, BodyGroup, Crowd, Ground, Group, GroupOptions, JointAngles, Job, Limbs, Look, LookGroup, Plant, Prop, PropGroup, Shape, Shift,
    ShiftGroup, SomeBodies,
} from "./crowd.js";
export {
    defaultGround, defaultLook, defaultPlant, defaultProp, defaultShift, Feature, featureRules, Field, Flag, Kind, LANES, MAX_TWIST_BONES, OnBadInput, Order,
    PoseForm, PoseSpace, Status, VERSION,
} from "./layout.js";
export type { LoadOptions } from "./instantiate.js";
export type { Region, RegionCone } from "./region.js";
export type { Entity, Swivel } from "./swivel.js";

/** Makes a solver in a memory of its own. */
export async function load(options: LoadOptions = {}): Promise<Swivel> {
    return new Swivel(await instantiate(options));
}
