// SPDX-License-Identifier: MIT
// The promise: every argument of every call counts, and bodies and regions that cannot be are refused in one line. What crowds and bodies are
// made of counts in scenes.test.mjs, which has wrong ones of each.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { defaultGround, defaultLook, defaultPlant, Feature, Field, Kind, Order } from 'swivel-wasm';
import { limb, refuses, slanted, swivel } from './common.mjs';

const features = Feature.WITH_SHOULDER_CONE | Feature.WITH_HUMERAL_TWIST | Feature.WITH_SHOULDER_BOX;
// A solved crowd of two groups: 5 plain limbs, and 6 with hands.
function limbs() {
  const crowd = swivel.crowd([{ limbCount: 5, features }, { limbCount: 6, features: features | Feature.WITH_HAND | Feature.WITH_MAX_SWIVEL }]);
  [5, 6].forEach((count, group) => {
    const many = (make) => Array.from({ length: count }, (_, n) => [...make(n)]).flat();
    crowd.write(Field.LENGTHS, [1, 0.75], { group }), crowd.write(Field.POLE, many((n) => [0.3 * n, -1, 0.2]), { group });
    crowd.write(Field.TARGET, many((n) => [0.2 * n + 0.1 * group, 0.4, 0.8 + 0.1 * n]), { group });
    crowd.write(Field.SHOULDER_CONE, many((n) => swivel.cone([1, n, 0.5], 1 + 0.2 * n)), { group });
  });
  crowd.write(Field.MAX_SWIVEL, swivel.cosSin(0.1), { group: 1 }), crowd.write(Field.HAND, [0.1, 0.2, 0.3, 1], { group: 1 });
  crowd.write(Field.TARGET, [9, 9, 9], { group: 1, first: 3, count: 1 });
  crowd.solve();
  return crowd;
}
// What is left after a call that changes a crowd.
const left = (crowd) => [Field.TARGET, Field.POLE, Field.NORMAL].flatMap((field) => [0, 1].filter((group) => crowd.componentCount(field, group)).map((group) => [...crowd.read(field, { group })]));
const box = [...swivel.range(-0.2, 0.3), ...swivel.range(0.1, 0.4), ...swivel.range(-1, 2)], binding = swivel.bindJoints(slanted, limb);
const tree = { parents: [-1, 0, 1, 2, 3, 2], translations: [0, 0, 0, 0.1, 0, 0, 0.3, 0, 0, 0.1, 0, 0, 0.15, 0, 0, 0.1, 0, 0] };
const turns = [0, 0, 0, 1, 0.1, 0, 0, 1, 0, 0.2, 0, 1, 0, 0, 0.3, 1, 0.1, 0.2, 0, 1, 0, 0, 0.1, 1], joints = { shoulder: 1, elbow: 2, wrist: 4, bend: [0, 0, 1] };

// A call with its usual arguments, in a list or an object, and others in the same places: each alone must change the answer.
const some = { group: 1, first: 2, count: 2 }, others = { group: 0, first: 1, count: 1 };
const functions = {
  range: [[0, 1], [0.1, 1.1]], cone: [[[0, 0, 1], 1], [[0, 1, 1], 0.5]], flexion: [[0, 2], [0.1, 1.5]], cosSin: [[1], [2]], aim: [[[0, 0, 1], 1], [[0, 1, 0], 2]],
  armAxis: [[binding, [0, 0, 0, 1], [0, 1, 0]], [swivel.bindJoints(slanted, { ...limb, bend: [0, 1, 0] }), [0.5, 0, 0, 1], [0, 0, 1]]],
  steps: [[[1, 1, 1], [1, 1, 0], 1.4, 1.3], [[1, 1, 0.5], [0, 1, 0], 1.5, 1.2]], bladeName: [[1], [2]],
};
const bindings = {
  skeleton: [tree, { parents: [-1, 0, 1, 2, 2, 2], translations: [...tree.translations.slice(0, 12), 0.2, 0.1, 0, 0.1, 0, 0], rotations: turns }],
  joints: [joints, { shoulder: 0, elbow: 3, wrist: 3, twistBones: [5], bend: [0, 1, 1] }],
};
const answers = {
  features: [[1], [0]], limbCount: [[1], [0]], firstLimb: [[1], [0]], pack: [[1], [0]], inputRows: [[1], [0]], resultRows: [[1], [0]],
  componentCount: [[Field.HAND, 1], [Field.POLE, 0]], packedRow: [[Field.FLAGS, 1], [Field.ELBOW, 0]], fieldFirstRow: [[Field.FLAGS, 1], [Field.ELBOW, 0]],
  values: [[Field.TARGET, 1], [Field.POLE, 0]], explain: [[3, 1], [1, 0]], allowedArcs: [[3, 1], [5, 0]],
  choose: [[[[1], [2]], 1], [[[2], [1]], 2, new Float32Array([5, 0])]],
  mirror: [[Field.SHOULDER_BOX, box], { 1: [...box.slice(4), ...box.slice(0, 4)], 2: Order.ZXY }],
};
const ofLimbs = { read: [Field.TARGET], elbows: [], wrists: [], residuals: [] };
const same = (answer) => JSON.stringify(answer, (_, value) => (typeof value === 'bigint' ? String(value) : ArrayBuffer.isView(value) ? [...value] : value));

// The answer with each argument replaced is another.
function count(name, call, usual, replaced) {
  const before = same(call(usual));
  assert.equal(same(call(usual)), before);
  for (const [key, other] of Object.entries(replaced)) {
    const given = Array.isArray(usual) ? Object.assign([...usual], { [key]: other }) : { ...usual, [key]: other };
    assert.notEqual(same(call(given)), before, `${name}: ${key}`);
  }
}

test('every argument of every call counts', () => {
  for (const [name, [usual, other]] of Object.entries(functions)) count(name, (given) => swivel[name](...given), usual, other);
  count('bindJoints', (given) => swivel.bindJoints(given, joints).bytes, ...bindings.skeleton);
  count('bindJoints', (given) => swivel.bindJoints(tree, given).bytes, ...bindings.joints);
  const crowd = limbs();
  for (const [name, [usual, other]] of Object.entries(answers)) count(name, (given) => crowd[name](...given), usual, other);
  for (const [name, first] of Object.entries(ofLimbs)) count(name, (given) => crowd[name](...first, given), some, others);
  count('hands', (given) => crowd.hands(given), some, { first: 1, count: 1 });
  count('jointAngles', (given) => crowd.jointAngles(given), some, { ...others, shoulderOrder: Order.ZYX, wristOrder: Order.ZYX, family: 1 });
  const after = (call) => (given) => { const each = limbs(); call(each, given); const is = left(each); each.dispose(); return is; };
  count('write', after((each, given) => each.write(Field.TARGET, [1, 2, 3], given)), some, others);
  count('write', after((each, given) => each.write(...given)), [Field.TARGET, [1, 2, 3]], [Field.POLE, [1, 2, 4]]);
  count('reset', after((each, given) => each.reset(given)), some, others);
  assert.equal(crowd.mirror(Field.SHOULDER_CONE, [0, 0, 1, 0.5]).length, 4);
  // Whose arguments are elsewhere: those that make things, solve(), and what bodies have.
  const methods = (of) => (of === Object.prototype ? [] : [...Object.getOwnPropertyNames(of).filter((name) => typeof Object.getOwnPropertyDescriptor(of, name).value === 'function'), ...methods(Object.getPrototypeOf(of))]);
  const inside = ['constructor', 'orDispose', 'own', 'group', 'place', 'settle', 'refresh', 'streamsOf', 'listOf', 'list', 'view', 'writeFrom', 'readTo', 'rowsOf', 'rows', 'name', 'lists', 'one', 'answer', 'forward', 'choice', 'refreshResults', 'shapes'];
  const known = [...inside, ...Object.keys(functions), ...Object.keys(answers), ...Object.keys(ofLimbs), 'hands', 'jointAngles', 'write', 'reset', 'kind', 'bindJoints', 'crowd', 'bodies', 'region', 'solve', 'digest', 'save', 'load', 'resetBodies', 'stateDigest', 'draw', 'dispose'];
  assert.deepEqual([crowd, swivel].flatMap(methods).filter((name) => !known.includes(name)), []);
  crowd.dispose();
});

const probes = [[0.3, 0.2, 1], [1, 0.4, -0.2], [0.4, -0.5, 0.2], [-1, 0, 0.1], [0.5, 0.1, 0.2], [-0.7, 0.5, 0.5], [-0.3, 1, 0]];
const cones = [{ axis: [0, 0, 1], angle: 0.3 }, { axis: [1, 0, 0.5], angle: 0.3 }, { axis: [-1, 1, 0], angle: 0.3 }];
test('every argument of regions counts', () => {
  const room = (region) => probes.map((direction) => region.room(direction)), with_ = (call, usual, other) => count(call, (given) => room(swivel.region().addCones(cones.slice(0, 2))[call](...given)), usual, other);
  with_('addCones', [cones], [cones.slice(0, 2).reverse(), true]);
  with_('addPolygon', [[1, 0, 0, 0, 1, 0, 0, 0, 1]], [[-1, 0, 0, 0, -1, 0, 0, 0, 1]]);
  with_('forbid', [{ axis: [0, 0, 1], angle: 0.2 }], [{ axis: [0, 0, 1], angle: 0.4 }]);
  with_('forbid', [{ axis: [0, 0, 1], angle: 0.2 }], [{ axis: [0, 0.2, 1], angle: 0.2 }]);
  with_('addDirections', [[-1, 0, 0, -1, 0, 1, -0.3, 1, 0], 0.1], [[-1, 0, 0, -1, 0, 1], 0.2, 1]);
  const region = swivel.region().addCones(cones);
  assert.deepEqual(room(region.mirrored().mirrored()), room(region)), assert.notDeepEqual(room(region.mirrored()), room(region));
  const crowd = swivel.crowd([{ limbCount: 1, region }]);
  assert.ok(crowd.features() & Feature.WITH_REGION), crowd.dispose();
});

// ---- bodies of a chain of joints with an arm below it, and what cannot be made of them
const skeleton = { parents: [-1, 0, 1, 2, 3, 1, 5, 6, 5], translations: [0, 1, 0, 0, 0.5, 0, 0.2, 0, 0, 0.3, 0, 0, 0.25, 0, 0, 0, 0.1, 0, 0, 0.2, 0, 0, 0.1, 0, 0, 0, 0.1] };
const [SPINE, NECK, HEAD] = [5, 6, 7], arm = { joints: { shoulder: 2, elbow: 3, wrist: 4, bend: [0, 0, 1] }, features: Feature.POLE_INCOMING }, look = { joints: [SPINE, NECK, HEAD] };
const make = (groups, options = {}) => swivel.bodies({ skeleton, bodyCount: 1, groups, ...options });
const hand = arm.features | Feature.WITH_HAND, plants = arm.features | Feature.WITH_PLANT;
const fits = { ...arm, features: plants | Feature.WITH_PELVIS_FIT }, holds = { ...arm, features: hand | Feature.WITH_LINK, link: 1 };
const foot = (ground) => [{ ...arm, features: hand | plants | Feature.WITH_EFFECTOR | Feature.WITH_GROUND, ground }];
const plant = (given) => [{ ...arm, features: plants, plant: given }], prop = (given) => [holds, { prop: given }], looks = (given) => [{ look: given }];
const names = (constants) => Object.keys(constants).join(', ');
const wrong = [
  [plant(0.1), `plant takes ${names(defaultPlant)}, not 0.1`],
  [[fits, { shift: {}, joints: arm.joints }], 'a group of shifts takes shift, not joints'],
  [foot(0.1), `ground takes ${names(defaultGround)}, not 0.1`],
  [prop({ wrist: 1 }), 'prop takes joint, maxMove, not wrist'],
  [[{ ...holds, link: -1 }, { prop: {} }], 'link is -1; give a whole number'],
  [[{ prop: {}, link: 0 }], "a prop's group takes prop, not link"],
  [looks(1), `look takes joints, ${names(defaultLook)}, not 1`],
  [looks({ joints: [-1] }), 'look.joints is -1; give a whole number'],
  [[{ look, link: 0 }], 'a group that looks takes look, not link'],
];

test('what bodies cannot be made of is refused in one line', () => {
  for (const [groups, text] of wrong) refuses(() => make(groups), text);
  const crowd = make([fits, { shift: {} }]), holding = make(prop({ joint: HEAD }));
  refuses(() => crowd.solve(), 'the pose has no time');
  refuses(() => crowd.changeSupport({}, { place: [0, 0, 0] }), 'now takes position, rotation, not place');
  refuses(() => crowd.changeSupport({ position: [1, 2] }, {}), '2 numbers for was.position of 1 bodies; give 3, or 3 for each body');
  refuses(() => crowd.changeSupport({}, {}, { group: 1 }), 'group 1 does not plant');
  refuses(() => crowd.write(Field.SOLVED_GOAL, [0]), 'solved_goal');
  refuses(() => holding.solve({ groups: [0] }), 'name both');
  refuses(() => holding.solve({ sample: () => undefined }), 'not sample');
  assert.deepEqual([holding.kind(1), holding.features(1), holding.componentCount(Field.PROP_TRANSFORM, 1), holding.componentCount(Field.TARGET, 1)], [Kind.PROP, 0n, 7, 0]);
  const watching = make([{ look }, arm]), free = swivel.crowd([1]);
  assert.deepEqual([crowd.kind(), crowd.kind(1), watching.kind(0), watching.kind(1), free.kind()], [Kind.BODY_LIMB, Kind.SHIFT, Kind.LOOK, Kind.BODY_LIMB, Kind.LIMB]);
  crowd.dispose(), holding.dispose(), watching.dispose(), free.dispose();
});

test('regions that cannot be are refused, and stay as they were', () => {
  const region = swivel.region().addCones(cones), room = region.room([0, 0, 1]);
  refuses(() => region.addCones([{ axis: [1, 0, 0], angle: 0.1 }, { axis: [-1, 0, 0], angle: 0.1 }]), 'cones 0 and 1 are opposite');
  refuses(() => region.addCones([{ axis: [1, 0, 0], opening: 1 }]), 'a cone takes axis, angle, not opening');
  refuses(() => region.addCones({ axis: [1, 0, 0], angle: 1 }), 'give a list of { axis, angle }');
  refuses(() => region.addPolygon([1, 0, 0, 0, 1]), 'corners has 5 numbers; give 6');
  refuses(() => region.addDirections([1, 0, 0], 0.1, -1), 'maxCones is -1');
  assert.equal(region.room([0, 0, 1]), room);
  refuses(() => swivel.crowd([{ limbCount: 1, region: {} }]), 'give what region() made');
  refuses(() => swivel.crowd([{ limbCount: 1, region: swivel.region() }]), 'the region allows nothing');
});
