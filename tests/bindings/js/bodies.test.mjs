// SPDX-License-Identifier: MIT
// The promise: poses of bodies are views of swivel's own memory, at rest at first, in every form, of floats or of doubles. Feet stand on ground
// that is given a frame late. Other solves are in scenes.test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, PoseForm, PoseSpace } from 'swivel-wasm';
import { close, refuses, swivel, unit } from './common.mjs';

// A body: hips, an arm with a joint in the upper arm, and a leg. Joints are turned at rest.
const random = (() => { let seed = 7; return () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5; })();
const some = (count, max) => Array.from({ length: count }, () => Math.fround(max * random()));
const parents = [-1, 0, 1, 2, 3, 0, 5, 6], translations = [0, 1, 0, 0.2, 0.4, 0, 0.1, 0, 0, 0.2, 0, 0, 0.26, 0, 0, -0.1, 0, 0, 0, -0.45, 0, 0, -0.4, 0];
const skeleton = { parents, translations, rotations: parents.flatMap(() => unit([...some(3, 0.2), 1])) };
const arm = { shoulder: 1, elbow: 3, wrist: 4, bend: [0, 0, 1] }, leg = { shoulder: 5, elbow: 6, wrist: 7, bend: [0, 0, -1] };
const limbs = [arm, leg], groups = limbs.map((joints) => ({ joints, features: Feature.POLE_INCOMING })), bodyCount = 35;
const at = (values, count, n) => [...values.slice(count * n, count * n + count)];
const bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];

test('roots in doubles: positions are views of doubles, and those of other fields are not', () => {
  const crowd = swivel.bodies({ skeleton, bodyCount, groups, rootIsDouble: true }), near = swivel.bodies({ skeleton, bodyCount, groups });
  const view = crowd.positions(Field.TARGET, 1);
  assert.ok(view instanceof Float64Array && view.every(Number.isNaN) && crowd.positions(Field.TARGET, 1) === view && view.length === 3 * bodyCount);
  assert.ok(crowd.pose('rootPosition') instanceof Float64Array);
  for (const group of [0, 1]) crowd.positions(Field.TARGET, group).fill(0.5);
  assert.equal(crowd.solve({ groups: [1] }) + crowd.solve({ groups: [0] }), 2 * bodyCount);
  refuses(() => crowd.values(Field.TARGET), 'TARGET is in doubles, as the root is; positions() gives it');
  refuses(() => crowd.positions(Field.FLAGS), 'FLAGS is no position; values() gives it');
  refuses(() => crowd.positions(Field.POLE), 'pole');
  assert.equal(near.positions(Field.TARGET), near.values(Field.TARGET));
  crowd.dispose(), near.dispose();
});

test('parts start at rest, in every form and space', () => {
  const solved = (parts, options = {}) => {
    const crowd = swivel.bodies({ skeleton, bodyCount, groups, ...options }), places = crowd.pose('jointPositions');
    for (const part of parts) crowd.pose(part);
    limbs.forEach((_, group) => crowd.write(Field.TARGET, [0.5, 0.7, 0.3], { group })), crowd.solve();
    const found = [bitsOf(crowd.pose('rotations')), [...places.slice(0, 24)]];
    crowd.dispose();
    return found;
  };
  const [rotations, places] = solved([]);
  assert.deepEqual(solved(['rotations', 'translations', 'scales', 'rootPosition', 'rootRotation', 'rootScale']), [rotations, places]);
  assert.ok(places.every((x) => !Number.isNaN(x)));
  for (const form of Object.values(PoseForm))
    for (const space of Object.values(PoseSpace)) close(solved(space === PoseSpace.IN_BODY && form === PoseForm.ROTATIONS ? ['translations'] : [], { form, space })[1], places, 2e-6);
  const matrices = swivel.bodies({ skeleton, bodyCount, groups, form: PoseForm.MATRIX_ROWS });
  for (const part of ['translations', 'scales']) refuses(() => matrices.pose(part), `the pose's matrices hold ${part}; give them there`);
  matrices.dispose();
});

test("feet stand on the ground below the last solve's probes", () => {
  const walker = { parents: [-1, 0, 1, 2], translations: [0, 0.93, 0, 0.1, 0, 0, 0, -0.45, 0, 0, -0.42, 0] }, toe = [0, -0.06, 0.12];
  const features = Feature.POLE_INCOMING | Feature.WITH_HAND | Feature.WITH_EFFECTOR | Feature.WITH_PLANT | Feature.WITH_GROUND | Feature.WITH_HAND_TRANSFORM;
  const foot = { joints: { shoulder: 1, elbow: 2, wrist: 3, bend: [0, 0, -1] }, features, ground: { heel: [0, -0.06, -0.06] } };
  const crowd = swivel.bodies({ skeleton: walker, bodyCount, groups: [foot] }), rotations = crowd.pose('rotations'), rest = rotations.slice();
  crowd.write(Field.EFFECTOR, toe), crowd.write(Field.GROUND_NORMAL, [0, 1, -0.2]), crowd.pose('time').fill(1 / 60);
  const [probes, feet, ground, contact] = [Field.PROBE, Field.HAND_TRANSFORM, Field.GROUND, Field.CONTACT].map((field) => crowd.values(field));
  const cross = (a, b) => [0, 1, 2].map((n) => a[(n + 1) % 3] * b[(n + 2) % 3] - a[(n + 2) % 3] * b[(n + 1) % 3]);
  // How far a toe is above a slope that begins 0.1 above its root, and beside its probe.
  const places = (body) => {
    const [x, y, z, i, j, k, w] = at(feet, 7, body), once = cross([i, j, k], toe), twice = cross([i, j, k], once);
    const found = [x, y, z].map((value, n) => value + toe[n] + 2 * (w * once[n] + twice[n])), probe = at(probes, 3, body);
    return [found[1] - 0.1 - 0.2 * found[2], found[0] - probe[0], found[2] - probe[2]];
  };
  for (let frame = 0; frame < 60; ++frame) {
    for (let body = 0; body < bodyCount; ++body) {
      const z = 0.1 * body + 0.02 * Math.min(frame, 30);
      crowd.pose('rootPosition').set([0, 0.2 * z, z], 3 * body);
    }
    rotations.set(rest), contact.fill(frame < 30 ? 0 : 1);
    assert.equal(crowd.solve(), bodyCount);
    for (let body = 0; body < bodyCount; ++body) {
      close(places(body), [frame === 0 ? -0.124 : 0, 0, 0], 1e-5);  // no ground is known in the first frame
      const [x, , z] = at(probes, 3, body);
      ground.set([x, 0.1 + 0.2 * z, z], 3 * body);
    }
  }
  assert.ok(crowd.read(Field.FLAGS).every((flags) => flags & Flag.PLANTED));
  crowd.dispose();
});

test('what is wrong with bodies is refused in one line', () => {
  const bodies = (given) => swivel.bodies({ skeleton, bodyCount, groups, ...given });
  refuses(() => bodies({ features: 1 }), 'features is 1; give a BigInt');
  refuses(() => bodies({ joints: 1 }), 'bodies() takes skeleton, bodyCount, groups, features, form, space, rootIsDouble, up, not joints');
  refuses(() => bodies({ form: 4 }), 'form is 4; give one of PoseForm');
  refuses(() => bodies({ space: 2 }), 'space is 2; give one of PoseSpace');
  refuses(() => bodies({ bodyCount: 1.5 }), 'bodyCount is 1.5');
  refuses(() => bodies({ groups: 8 }), 'groups is 8; give a list, such as [{ joints: ');
  refuses(() => bodies({ groups: [{ limbCount: 3 }] }), 'a group of bodies takes joints, features, shoulderOrder, wristOrder, onBadInput, plant, ground, link, region, poleBehind, not limbCount');
  refuses(() => bodies({ groups: [{}] }), "a limb's joints takes shoulder");
  refuses(() => bodies({ groups: [{ joints: { ...arm, wrist: 9 } }] }), 'group 0: ');
  refuses(() => bodies({ groups: [{ joints: arm, features: Feature.WORLD }] }), "SWIVEL_WORLD is not for a body's limb");
  refuses(() => bodies({ groups: [{ joints: arm, twistBoneCount: 1 }] }), 'not twistBoneCount');
  refuses(() => bodies({ skeleton: undefined }), 'a skeleton takes parents');
  refuses(() => bodies({ skeleton: { ...skeleton, translations: [0] } }), 'translations has 1 numbers; give 24');
  refuses(() => swivel.crowd([{ limbCount: 1, joints: arm }]), 'not joints');
  const crowd = bodies();
  refuses(() => crowd.choose([[1], [1]], 1), '2 priorities for bodies; give one list');
  refuses(() => crowd.pose('rotation'), 'poses have rotations, translations, scales, results, translationResults, jointRotations, jointPositions, rootPosition, rootRotation, rootScale, time, supportPosition, supportRotation, weight, not "rotation"');
  refuses(() => crowd.pose('translationResults'), "only translations in the body's space change");
  crowd.dispose();
  for (const call of [() => crowd.pose('rotations'), () => crowd.pose('scales'), () => crowd.solve()]) refuses(call, 'this crowd is disposed of');
  // 2^32 bytes of rotations
  const chain = Array.from({ length: 1024 }, (_, n) => n - 1);
  refuses(() => bodies({ skeleton: { parents: chain, translations: chain.flatMap(() => [1, 0, 0]) }, bodyCount: 2 ** 18, groups: [groups[0]] }), 'give load() more megabytes');
});

test('a body is drawn as lines', () => {
  const crowd = swivel.bodies({ skeleton, bodyCount: 2, groups });
  limbs.forEach((_, group) => crowd.write(Field.TARGET, [0.5, 0.7, 0.3, 0.5, 0.7, 0.3], { group })), crowd.solve();
  const shapes = crowd.draw(1), targets = shapes.filter(({ name }) => name === 'target');
  assert.deepEqual(targets.map(({ group }) => group), limbs.map((_, group) => group));
  for (const { from, to, color } of targets) close(from, [0.5, 0.7, 0.3], 1e-6), assert.deepEqual(from, to), assert.equal(color, 0xffff00ff);
  assert.ok(shapes.some(({ name, group }) => name === 'bone' && group === -1));
  assert.deepEqual(crowd.draw(1, 1).filter(({ group }) => group >= 0), shapes.filter(({ group }) => group === 1));
  refuses(() => crowd.draw(2), 'body is 2; give a whole number from 0 to 1');
  crowd.dispose();
  const arm = swivel.crowd([1]);
  arm.write(Field.TARGET, [0.3, 0.1, 1]), arm.write(Field.LENGTHS, [1, 1]), arm.solve();
  assert.deepEqual(arm.draw(0).map(({ name }) => name), ['target', 'bone', 'bone', 'miss', 'pole']);
  arm.dispose();
});

test('a pose is compared with where an engine has a limb', () => {
  const crowd = swivel.bodies({ skeleton, bodyCount: 1, groups }), all = crowd.pose('jointPositions');
  crowd.pose('weight').fill(0);  // so the places after the solve are those of the pose as it comes
  limbs.forEach((_, group) => crowd.write(Field.TARGET, [0.5, 0.7, 0.3], { group })), crowd.solve();
  const places = (factor = 1) => Object.fromEntries(['shoulder', 'elbow', 'wrist'].map((name) => [name, at(all, 3, leg[name]).map((x) => factor * x)]));
  const right = crowd.compare(0, places(), 1);
  assert.match(right.text, /^The (pose|places) agree/), assert.equal(typeof right.agrees, 'boolean');
  const far = crowd.compare(0, places(100), 1);
  assert.ok(!far.agrees), assert.match(far.text, /centimetres instead of metres/);
  assert.notEqual(crowd.compare(0, places(), 0).text, right.text);
  refuses(() => crowd.compare(1, places()), 'body is 1; give a whole number from 0 to 0');
  refuses(() => crowd.compare(0, { shoulder: [0, 0, 0], elbow: [0, 0, 0], wrist: [0, 0] }), 'wrist');
  crowd.dispose();
});

test('frames are played again from what was saved', () => {
  const made = () => {
    const crowd = swivel.bodies({ skeleton, bodyCount, groups: limbs.map((joints) => ({ joints, features: Feature.WITH_PLANT | Feature.POLE_INCOMING })) });
    crowd.pose('rotations'), crowd.pose('time').fill(1 / 60);
    return crowd;
  };
  const crowd = made(), other = made(), plants = other.values(Field.PLANT, 1);
  const play = (each, frame) => {
    each.pose('rootPosition').forEach((_, n, places) => { places[n] = 0.01 * frame * (n % 3) + n; });
    limbs.forEach((_, group) => each.write(Field.CONTACT, Array.from({ length: bodyCount }, (__, n) => Number((n + frame) % 5 < 3)), { group }));
    each.solve();
    return [each.stateDigest(), bitsOf(each.pose('rotations')).join()];
  };
  const ten = (each, first) => Array.from({ length: 10 }, (_, n) => play(each, first + n));
  ten(crowd, 0);
  const standing = crowd.read(Field.PLANT, { group: 1 }), state = crowd.save(), digest = crowd.stateDigest(), size = state.length / bodyCount, rotations = crowd.pose('rotations').slice();
  assert.equal(size, 4 * (1 + 2 * 11));
  const wanted = ten(crowd, 10);
  assert.notEqual(crowd.stateDigest(), digest);
  for (const each of [crowd, other]) {
    each.load(state), each.pose('rotations').set(rotations);
    assert.deepEqual([each.stateDigest(), each.save()], [digest, state]);
    if (each === other) assert.deepEqual(plants, standing);  // views see it at once
    assert.deepEqual(ten(each, 10), wanted);
  }
  const later = crowd.save();
  crowd.load(state.slice(0, 3 * size), { first: 7, count: 3 }), crowd.resetBodies({ first: 8, count: 1 });
  assert.deepEqual([crowd.save({ first: 7, count: 1 }), crowd.save({ first: 9, count: 1 })], [state.slice(0, size), state.slice(2 * size, 3 * size)]);
  assert.ok(crowd.save({ first: 8, count: 1 }).slice(4).every((byte) => byte === 0));
  assert.deepEqual([crowd.save({ count: 7 }), crowd.save({ first: 10 })], [later.slice(0, 7 * size), later.slice(10 * size)]);
  refuses(() => crowd.load([...state]), 'state is no Uint8Array; give what save() gave');
  refuses(() => crowd.load(state.slice(1)), `state has ${state.length - 1} bytes; ${bodyCount} bodies have ${state.length}`);
  refuses(() => crowd.load(new Uint8Array(state.length)), 'state 0 is of another kind of crowd');
  refuses(() => crowd.save({ group: 1 }), 'group');
  crowd.dispose(), other.dispose();
});
