// SPDX-License-Identifier: MIT
// The promise: the types of the package for the web allow what works, and refuse what does not. tsc reads this, nothing runs it.
import { type Binding, type Bodies, type BodyGroup, type Crowd, defaultGround, defaultPlant, Feature, Field, Flag, type Ground, type Group, Kind, load, type Look, type LookGroup, OnBadInput, Order, type Plant, PoseForm, PoseSpace, type Prop, type PropGroup, type Shape, type Shift, type ShiftGroup, type Support, type Swivel, SwivelError } from 'swivel-wasm';

const swivel: Swivel = await load({ megabytes: 4 });
const binding: Binding = swivel.bindJoints({ parents: [-1, 0, 1], translations: new Float32Array(9), rotations: [0, 0, 0, 1] }, { shoulder: 0, elbow: 1, wrist: 2, bend: [0, 1, 0] });
const legs: Group = { limbCount: 3, features: Feature.WITH_SHOULDER_BOX, shoulderOrder: Order.ZXY, onBadInput: OnBadInput.KEEP_POSE };
const crowd: Crowd = swivel.crowd([{ limbCount: 3, binding, twistBoneCount: 2 }, 5, legs], Feature.WORLD);
const flags: Uint32Array = crowd.values(Field.FLAGS);
const shoulders: Float32Array = crowd.read(Field.SHOULDER, { group: 1 });
const mask: Uint32Array = crowd.choose([[1], new Float32Array(5), [3]], 1, new Float32Array(crowd.blockCount));
const solved: number = crowd.solve({ mask: [1, 2], groups: [0] }) + crowd.solve({ mask }) + crowd.solve({ mask: crowd.choose([[1], [2], [3]], 1), blocks: { first: 0, count: 1 } });
const digest: bigint = crowd.digest() ^ crowd.stateDigest();
const closing: number = swivel.steps([1, 0, 1], [0, 1, 0], 1, 1).closingError;
const isBad: boolean = (flags[0] & (Flag.BAD_INPUT | Flag.INFEASIBLE)) !== 0;
const arm: BodyGroup = { joints: { shoulder: 1, elbow: 2, wrist: 3 }, features: Feature.WITH_HAND, onBadInput: OnBadInput.REST_POSE };
const skeleton = { parents: [-1, 0, 1, 2], translations: new Float32Array(12) };
const bodies: Bodies = swivel.bodies({ skeleton, bodyCount: 3, groups: [arm], form: PoseForm.MATRIX_ROWS, space: PoseSpace.IN_BODY });
const plant: Plant = { ...defaultPlant, lockRadius: 0.1, speed: [0.5, 0.7] }, down: Shift = { drop: 0.2 }, shift: ShiftGroup = { shift: down };
const standing: Bodies = swivel.bodies({ skeleton, bodyCount: 3, groups: [{ ...arm, plant }, shift], up: [0, 0, 1] });
const ground: Ground = { ...defaultGround, heel: [0, -0.06, -0.06] }, prop: Prop = { joint: 0, maxMove: 0.1 }, rifle: PropGroup = { prop };
const look: Look = { joints: [0, 1], share: [1, 2], cosMax: 0.5 }, watch: LookGroup = { look };
const holding: Bodies = swivel.bodies({ skeleton, bodyCount: 3, groups: [{ ...arm, features: Feature.WITH_HAND | Feature.WITH_LINK, ground, link: 1 }, rifle] });
const holds: boolean = holding.kind(1) === Kind.PROP;
const shapes: Shape[] = [...crowd.draw(0, 1), ...holding.draw(0), ...holding.draw(0, 1)], end: number = shapes[0].to[2];
const support: Support = { position: new Float64Array(3), rotation: [0, 0, 0, 1] };
standing.changeSupport(support, {}, { first: 1 });
const state: Uint8Array = standing.save({ first: 1, count: 1 });
standing.load(state, { first: 2 }), standing.resetBodies({ count: 1 });
const near: Float32Array[] = [bodies.pose('rotations'), bodies.pose('rootPosition'), bodies.pose('supportPosition'), bodies.pose('time'), bodies.positions(Field.TARGET)];
const far: Float64Array[] = [swivel.bodies({ skeleton, bodyCount: 3, groups: [arm], rootIsDouble: true }).pose('supportPosition')];
export { closing, end, far, near, digest, flags, holds, isBad, shoulders, solved, SwivelError };

// @ts-expect-error: features are BigInts
swivel.crowd([3], 1);
// @ts-expect-error: of groups, too
swivel.crowd([{ limbCount: 3, features: 1 }]);
// @ts-expect-error: it is changed
crowd.choose([[1]], 1, [0]);
// @ts-expect-error: for each group an array
crowd.choose([1], 1);
// @ts-expect-error: there is no such field
crowd.values(7000);
// @ts-expect-error: the wrist is missing
swivel.bindJoints({ parents: [-1, 0, 1], translations: new Float32Array(9) }, { shoulder: 0, elbow: 1 });
// @ts-expect-error: flags are integers
const floats: Float32Array = crowd.values(Field.FLAGS);
// @ts-expect-error: an arm has no such limit
swivel.cone(1, 2);
// @ts-expect-error: options have names
crowd.write(Field.POLE, [0, 0, 0], 1);
// @ts-expect-error: poses have no such part
bodies.pose('rotation');
// @ts-expect-error: limbs of bodies are as many as these
swivel.bodies({ skeleton, bodyCount: 3, groups: [{ limbCount: 3 }] });
// @ts-expect-error: plants have no such constant
swivel.bodies({ skeleton, bodyCount: 3, groups: [{ ...arm, plant: { look: 1 } }] });
// @ts-expect-error: a prop has no wrist
swivel.bodies({ skeleton, bodyCount: 3, groups: [arm, { prop: { wrist: 1 } }] });
// @ts-expect-error: no solve calls back
holding.solve({ sample: () => undefined });
export { floats };
