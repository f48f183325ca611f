// SPDX-License-Identifier: MIT
// The promise: poses of bodies may be in the body's space, a solve says where joints are, and twist bones and clavicles turn along.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, PoseForm, PoseSpace } from 'swivel-wasm';
import { close, plus, refuses, swivel, times, turned, unit } from './common.mjs';

// Joints in any order, turned at rest: a finger, a twist bone, hand, forearm, upper arm, clavicle, hips; and a tail.
const parents = [2, 3, 3, 4, 5, 6, -1, 6], [FINGER, TWIST, HAND, FOREARM, UPPER_ARM, CLAVICLE, , TAIL] = parents.keys();
const translations = [[0.08, 0, 0], [0.13, 0, 0], [0.26, 0, 0], [0.3, 0, 0], [0.15, 0, 0.02], [0.05, 0.4, 0], [0, 1, 0], [0, 0, -0.2]];
const rest = parents.map((_, joint) => unit([0.1 * joint - 0.3, joint === FOREARM ? -1 : 0.1, 0.2, 1]));
const skeleton = { parents, translations: translations.flat(), rotations: rest.flat() };
const joints = { shoulder: UPPER_ARM, elbow: FOREARM, wrist: HAND, twistBones: [TWIST], bend: [0, 0, 1] };
const back = ([x, y, z, w]) => [-x, -y, -z, w], at = (values, count, n) => [...values.slice(count * n, count * n + count)];
const needed = [TWIST, HAND, FOREARM, UPPER_ARM, CLAVICLE];

// Own forward kinematics: a joint's place and rotation, relative to the root.
const forward = (rotations, joint) => {
  if (joint < 0) return { place: [0, 0, 0], rotation: [0, 0, 0, 1] };
  const { place, rotation } = forward(rotations, parents[joint]);
  return { place: plus(place, turned(rotation, translations[joint])), rotation: times(rotation, unit(at(rotations, 4, joint))) };
};
const before = (joint) => forward(rest.flat(), joint), hand = before(HAND), fore = unit(plus(hand.place, before(FOREARM).place.map((x) => -x)));
const same = (a, b, within) => close(a.map((x) => x * Math.sign(a.reduce((sum, y, n) => sum + y * b[n], 0))), b, within);
const target = plus(hand.place, [0.05, -0.1, 0.08]), wanted = times(unit([0, 0.3, 0.1, 1]), hand.rotation);

// A crowd of one body, at rest, after a solve.
const solved = (options, goals, ask = []) => {
  const { features = 0n, ...more } = options;
  const crowd = swivel.bodies({ skeleton, bodyCount: 1, groups: [{ joints, features: Feature.POLE_INCOMING | Feature.WITH_HAND | features }], ...more });
  const parts = Object.fromEntries(['rotations', ...ask].map((part) => [part, crowd.pose(part)]));
  const starts = Object.fromEntries(Object.entries(parts).map(([part, values]) => [part, values.slice()]));
  for (const [field, value] of Object.entries({ TARGET: target, HAND: wanted, ...goals })) crowd.write(Field[field], value);
  crowd.solve();
  assert.equal(crowd.read(Field.FLAGS)[0] & Flag.BAD_INPUT, 0);
  return { crowd, parts, starts };
};

test("in the body's space fingers move along, and a solve says where joints are", () => {
  const local = solved({}, {}, ['jointRotations', 'jointPlaces']).parts;
  const { parts, starts } = solved({ space: PoseSpace.IN_BODY }, {}, ['translations']);
  const matrices = solved({ space: PoseSpace.IN_BODY, form: PoseForm.MATRIX_COLUMNS }, {});
  const apart = solved({ space: PoseSpace.IN_BODY }, {}, ['results', 'translationResults']);
  parents.forEach((_, joint) => {
    const was = before(joint), is = forward(local.rotations, joint), columns = at(matrices.parts.rotations, 16, joint);
    same(at(starts.rotations, 4, joint), was.rotation, 1e-6), close(at(starts.translations, 3, joint), was.place, 1e-6);
    close(at(matrices.starts.rotations, 16, joint).slice(12), [...was.place, 1], 1e-6);
    same(at(parts.rotations, 4, joint), is.rotation, 2e-6), close(at(parts.translations, 3, joint), is.place, 2e-6);
    close(columns, [...[[1, 0, 0], [0, 1, 0], [0, 0, 1]].flatMap((axis) => [...turned(is.rotation, axis), 0]), ...is.place, 1], 3e-6);
    if (needed.includes(joint)) same(at(local.jointRotations, 4, joint), is.rotation, 2e-6), close(at(local.jointPlaces, 3, joint), is.place, 2e-6);
  });
  for (const joint of [FINGER, TAIL]) assert.ok([...at(local.jointRotations, 4, joint), ...at(local.jointPlaces, 3, joint)].every(Number.isNaN));
  close(forward(local.rotations, HAND).place, target, 1e-6), same(forward(local.rotations, HAND).rotation, wanted, 2e-6);
  assert.deepEqual([apart.parts.results, apart.parts.translationResults, apart.crowd.pose('translations')], [parts.rotations, parts.translations, starts.translations]);
  refuses(() => matrices.crowd.pose('translationResults'), "the pose's matrices hold translationResults");
});

test('twist bones and a clavicle take their shares', () => {
  const about = (angle) => [...fore.map((x) => x * Math.sin(angle / 2)), Math.cos(angle / 2)];
  const { crowd, parts } = solved({}, { TARGET: hand.place, HAND: times(about(1.2), hand.rotation) });
  assert.equal(crowd.features() & (7n * Feature.WITH_TWIST_BONES), Feature.WITH_TWIST_BONES);  // joints that name them ask for them
  same(forward(parts.rotations, TWIST).rotation, times(about(0.6), before(TWIST).rotation), 1e-5);
  const group = (more, features) => ({ joints: { ...joints, ...more }, features });
  for (const [text, given] of [['its features have 2 twist bones, its joints 1', group({}, Feature.WITH_HAND | (2n * Feature.WITH_TWIST_BONES))],
    ['there are 8 twist bones', group({ twistBones: new Array(8).fill(TWIST) }, Feature.WITH_HAND)], ['WITH_TWIST_BONES needs SWIVEL_WITH_HAND', group({}, 0n)]])
    refuses(() => swivel.bodies({ skeleton, bodyCount: 1, groups: [given] }), text);

  const way = (to) => unit(plus(to, before(CLAVICLE).place.map((x) => -x)));
  for (const share of [0, 1]) {
    const { rotation } = forward(solved({ features: Feature.WITH_CLAVICLE }, { CLAVICLE: [share] }).parts.rotations, CLAVICLE);
    close(turned(times(rotation, back(before(CLAVICLE).rotation)), way(hand.place)), way(share ? target : hand.place), 1e-6);
  }
});
