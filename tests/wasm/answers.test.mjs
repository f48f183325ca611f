// SPDX-License-Identifier: MIT
// The promise: skeletons, limits, orders and choices of limbs mean what they mean in C.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, Order } from 'swivel-wasm';
import { chain, close, plus, refuses, swivel, times, turned, unit } from './common.mjs';

test('joints of a bound skeleton put wrists at their targets', () => {
  const binding = swivel.bind(chain);
  close(binding.lengths, [0.3, Math.hypot(0.25, 0.02)], 1e-7);
  const whole = swivel.bindJoints(
    { parents: [-1, 0, 1, 2], translations: [1, 2, 3, 0, 0.1, 0, ...chain.elbowOffset, ...chain.wristOffset],
      rotations: [0, 0, 0, 1, ...chain.shoulderRotation, ...chain.elbowRotation, ...chain.wristRotation] },
    { shoulder: 1, elbow: 2, wrist: 3, bend: chain.bend });
  assert.deepEqual(whole.bytes, binding.bytes);
  const skeleton = { parents: [-1, 0, 1, 1], translations: [0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0.5] };
  const joints = { shoulder: 0, elbow: 1, wrist: 2, bend: [0, 1, 0] };
  assert.notDeepEqual(swivel.bindJoints(skeleton, { ...joints, twistBones: [3] }).bytes, swivel.bindJoints(skeleton, joints).bytes);
  refuses(() => swivel.bindJoints({ ...skeleton, translations: [0, 0, 1] }, joints), 'translations has 3 numbers; give 12');
  refuses(() => swivel.bindJoints(skeleton, { ...joints, wrist: 9 }), '9');

  const crowd = swivel.crowd([{ limbCount: 50, binding }], Feature.WORLD | Feature.JOINTS | Feature.WITH_HAND);
  const parent = unit([0.3, -0.2, 0.5, 0.7]), place = [2, -1, 4], hand = unit([0.5, 0.1, -0.3, 0.6]);
  crowd.write(Field.PARENT_ROTATION, parent), crowd.write(Field.SHOULDER_POSITION, place), crowd.write(Field.HAND, hand);
  crowd.write(Field.POLE, plus(place, [0, -5, 1]));
  const target = crowd.values(Field.TARGET);
  for (let n = 0; n < 50; ++n) target.set(plus(place, [0.3 * Math.sin(n), 0.2, 0.3 * Math.cos(n)]), 3 * n);
  crowd.solve();
  const shoulder = crowd.read(Field.SHOULDER), elbow = crowd.read(Field.ELBOW), wrist = crowd.read(Field.WRIST);
  for (let n = 0; n < 50; ++n) {
    const upper = times(parent, [...shoulder.slice(4 * n, 4 * n + 4)]), fore = times(upper, [...elbow.slice(4 * n, 4 * n + 4)]);
    close(plus(place, plus(turned(upper, chain.elbowOffset), turned(fore, chain.wristOffset))), [...target.slice(3 * n, 3 * n + 3)], 2e-6);
    const turnedHand = times(fore, [...wrist.slice(4 * n, 4 * n + 4)]);
    assert.ok(Math.abs(turnedHand.reduce((sum, x, k) => sum + x * hand[k], 0)) > 1 - 1e-6);
  }
  close([...crowd.elbows({ count: 1 })], plus(place, turned(times(parent, [...shoulder.slice(0, 4)]), chain.elbowOffset)), 2e-6);
  close([...crowd.hands({ count: 1 })].map(Math.abs), hand.map(Math.abs), 1e-6);
  crowd.dispose();
});

test('explanations of many bad inputs are whole', () => {
  const crowd = swivel.crowd([1], Feature.WITH_HAND | Feature.WITH_INCOMING | Feature.WITH_SHOULDER_BOX | Feature.WITH_WRIST_BOX | Feature.WITH_REACH);
  for (const field of Object.values(Field)) {
    const count = field < Field.SHOULDER ? crowd.fieldRowCount(field) : 0;
    if (count) crowd.write(field, new Array(count).fill(-1.2345678e20));
  }
  crowd.solve();
  assert.ok(crowd.explain(0).length > 1024);
  assert.match(crowd.explain(0), / The limb has its rest pose\.$/);
  crowd.dispose();
});

test('limits, their arcs, and what explains them', () => {
  const features = Feature.WITH_SHOULDER_CONE | Feature.WITH_FLEXION_LIMIT | Feature.WITH_ANGLE | Feature.WITH_SHOULDER_BOX;
  const crowd = swivel.crowd([{ limbCount: 3, features, shoulderOrder: Order.YXZ }]);
  crowd.write(Field.LENGTHS, [1, 1]);
  crowd.write(Field.TARGET, [0, 0, 1.5, 0, 0, 1.5, 0, 0, 0.2]);
  crowd.write(Field.FLEXION_LIMIT, swivel.flexion(0, 2));
  crowd.write(Field.SHOULDER_CONE, swivel.cone([0.6, 0, 1], 0.6), { first: 1, count: 1 });
  crowd.solve();
  const flags = crowd.read(Field.FLAGS);
  assert.equal(flags[0], Flag.REACHED);
  assert.equal(flags[1], Flag.REACHED | Flag.LIMITED_SHOULDER_CONE);
  assert.ok(flags[2] & Flag.LIMITED_FLEXION);
  const [x, y, z] = crowd.elbows({ first: 1, count: 1 });
  close([(0.6 * x + z) / Math.hypot(0.6, 1)], [Math.cos(0.6)], 2e-6);
  assert.deepEqual(crowd.find(Flag.LIMITED_SHOULDER_CONE), { group: 0, limb: 1 });
  assert.equal(crowd.find(Flag.LIMITED_SHOULDER_CONE, { group: 0, limb: 2 }), undefined);
  assert.match(crowd.explain(1), /cone/);
  assert.equal(crowd.explain(0).includes('\0'), false);
  const [arc, ...more] = crowd.allowedArcs(1);
  assert.equal(more.length, 0);
  close([Math.hypot(...arc.from), Math.hypot(...arc.to)], [1, 1], 1e-6);
  assert.ok(y > -0.6);  // the cone has turned it away from the pole

  // Mirrored: the elbow on the other side.
  crowd.write(Field.SHOULDER_CONE, crowd.mirror(Field.SHOULDER_CONE, swivel.cone([0.6, 0, 1], 0.6)), { first: 1, count: 1 });
  crowd.solve();
  close([...crowd.elbows({ first: 1, count: 1 })], [-x, y, z], 1e-6);
  close([...swivel.range(-0.5, 1.5)], [Math.cos(0.5), Math.sin(0.5), Math.cos(1), Math.sin(1)], 1e-7);
  close([...swivel.turn(0.3)], [Math.cos(0.3), Math.sin(0.3)], 1e-7);
  close([...swivel.aim([0, 0, 2], 0.5)].slice(0, 3), [0, 0, 1], 1e-7);
  close(swivel.armAxis(swivel.bind({ elbowOffset: [0, 0, 1], wristOffset: [0, 0, 1], bend: [0, 1, 0] }), [0, 0, 0, 1], [0, 3, 0]), [0, 1, 0], 1e-7);
  close(swivel.armAxis(swivel.bind({ elbowOffset: [0, 0, 1], wristOffset: [0, 0, 1], bend: [0, 1, 0] }), [0, 0, Math.SQRT1_2, Math.SQRT1_2], [0, 3, 0]), [1, 0, 0], 1e-7);
  close([swivel.aim([0, 0, 2], 0.5)[3]], [Math.cos(0.25)], 1e-7);
  crowd.dispose();
});

test("the lecture's steps come entity by entity", () => {
  const { entities, closingError } = swivel.steps([1.1, 1.1, 1.1], [1.1, 1.1, 0], 1.4, 1.3);
  assert.ok(closingError < 1e-14);
  const of = Object.fromEntries(entities.map((entity) => [entity.name, entity]));
  const named = (name, blade) => of[name].coefficients[Array.from({ length: 32 }, (_, n) => swivel.bladeName(n)).indexOf(blade)];
  close(['e1', 'e2', 'e3'].map((blade) => named('p_e', blade)), [0.980883, 0.980883, -0.189039], 1e-6);
  close(['1', 'i', 'j', 'k'].map((blade) => named('q_s', blade)), [0.251667, 0.288289, 0.695991, 0.607577], 1e-6);
  assert.deepEqual([of.p_w.step, of.q_s.step], [1, 5]);
  assert.ok(of.S1.meaning.includes('sphere'));
  assert.throws(() => swivel.steps([9, 0, 0], [0, 1, 0], 1, 1), /too far by 7/);
  assert.throws(() => swivel.steps([9, 0], [0, 1, 0], 1, 1), /target has 2 numbers/);
  assert.throws(() => swivel.bladeName(32), /0 to 31/);
});

test('orders of Euler angles reach boxes, mirrors and joint angles', () => {
  const box = [...swivel.range(-0.2, 0.3), ...swivel.range(0.1, 0.4), ...swivel.range(-1, 2)];
  const poses = [Order.XYZ, Order.ZYX].map((shoulderOrder) => {
    const crowd = swivel.crowd([{ limbCount: 1, features: Feature.WITH_SHOULDER_BOX, shoulderOrder }]);
    crowd.write(Field.LENGTHS, [1, 1]), crowd.write(Field.TARGET, [0.4, 0.3, 1.6]), crowd.write(Field.SHOULDER_BOX, box), crowd.solve();
    const all = [0, 1].map((family) => crowd.jointAngles({ shoulderOrder, family }));
    assert.notDeepEqual(all[0], all[1]);
    assert.notDeepEqual(crowd.mirror(Field.SHOULDER_BOX, box, Order.XYZ), crowd.mirror(Field.SHOULDER_BOX, box, Order.ZYX));
    assert.notDeepEqual(crowd.jointAngles({ shoulderOrder: 5 - shoulderOrder }), all[0]);
    const q = [...crowd.read(Field.SHOULDER)], turn = (axis, angle) => { const r = [0, 0, 0, Math.cos(angle / 2)]; r[axis] = Math.sin(angle / 2); return r; };
    const axes = shoulderOrder === Order.XYZ ? [0, 1, 2] : [2, 1, 0];
    const rebuilt = axes.map((axis, n) => turn(axis, all[0][n])).reduce(times);
    assert.ok(Math.abs(rebuilt.reduce((sum, x, n) => sum + x * q[n], 0)) > 1 - 1e-6);
    crowd.dispose();
    return q;
  });
  assert.notDeepEqual(poses[0], poses[1]);
});

test('answers are about the limb and the group asked for', () => {
  const crowd = swivel.crowd([2, 3], Feature.WITH_SHOULDER_CONE | Feature.WITH_HUMERAL_TWIST);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group }), crowd.write(Field.TARGET, [0.2, 0.3, 1.2 + 0.1 * group], { group });
  crowd.write(Field.TARGET, [0, 0, 9], { group: 1, first: 2 });
  crowd.write(Field.SHOULDER_CONE, swivel.cone([0.6, 0, 1], 0.6), { group: 1, first: 1, count: 1 });
  crowd.write(Field.HUMERAL_TWIST, swivel.range(-0.4, 0.4), { group: 1, first: 1, count: 1 });
  crowd.solve();
  assert.deepEqual(crowd.find(Flag.CLAMPED_FAR), { group: 1, limb: 2 });
  assert.deepEqual(crowd.find(Flag.REACHED), { group: 0, limb: 0 });
  assert.deepEqual(crowd.find(Flag.REACHED, { group: 1, limb: 1 }), { group: 1, limb: 1 });
  assert.match(crowd.explain(2, 1), /out of reach/);
  assert.doesNotMatch(crowd.explain(1, 0), /out of reach/);
  assert.ok(crowd.residuals({ group: 1, first: 2 })[0] > 3 && crowd.residuals({ group: 1 })[0] < 1e-6);
  assert.deepEqual(crowd.allowedArcs(0, 0).length, 1);
  const arcs = crowd.allowedArcs(1, 1);
  assert.ok(arcs.length > 0 && !arcs.every(({ from, to }) => from[0] === to[0]));
  for (const { from, to } of arcs) close([Math.hypot(...from), Math.hypot(...to)], [1, 1], 1e-6);
  crowd.write(Field.TARGET, [0.2, 0.3, 1.3], { group: 1, first: 0, count: 1 });
  crowd.write(Field.HUMERAL_TWIST, swivel.range(-3.5, -0.5), { group: 1, first: 0, count: 1 });
  crowd.write(Field.SHOULDER_CONE, swivel.cone([0.6, 0, 1], 1), { group: 1, first: 0, count: 1 });
  const two = crowd.allowedArcs(0, 1);
  assert.equal(two.length, 2);
  assert.notDeepEqual(two[0], two[1]);
  close([...crowd.wrists({ group: 1, first: 1, count: 1 })], [0.2, 0.3, 1.3], 2e-6);
  crowd.dispose();
});

test('some limbs: blocks, masks, lists and budgets', () => {
  const crowd = swivel.crowd([40, 20]);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group }), crowd.write(Field.TARGET, [0, 0.5, 1], { group });
  const solved = () => [0, 1].flatMap((group) => [...crowd.read(Field.FLAGS, { group })].map((flag, n) => [flag, `${group}:${n}`])).filter(([flag]) => flag).map(([, name]) => name);
  assert.equal(crowd.firstLimb(1), 48);
  assert.equal(crowd.solve({ limbs: [2, crowd.firstLimb(1) + 3] }), 2);
  assert.deepEqual(solved(), ['0:2', '1:3']);
  assert.equal(crowd.solve({ mask: [1, 0, 0] }), 1);
  assert.deepEqual(solved(), ['0:0', '0:2', '1:3']);
  assert.equal(crowd.solve({ blocks: { first: 2, count: 1 } }), 8);
  assert.equal(crowd.solve({ priorities: [[1], new Float32Array(20).fill(2)], mostBlocks: 1 }), 16);
  assert.equal(solved().filter((name) => name.startsWith('1:')).length, 16);
  // One priority for all of a group, and one for each limb: the block of the most urgent limb is picked.
  const urgent = new Float32Array(40);
  urgent[20] = 100;
  const before = solved();
  assert.equal(crowd.solve({ priorities: [urgent, [0]], mostBlocks: 1 }), 16);
  assert.deepEqual(solved().filter((name) => !before.includes(name)).slice(0, 2), ['0:16', '0:17']);
  // Blocks take turns while their urgency is kept. The blocks have 16, 16, 8, 16 and 4 limbs.
  const urgency = new Float32Array(crowd.blockCount), two = { priorities: [[1], [1]], mostBlocks: 2 };
  assert.deepEqual([1, 2, 3].map(() => crowd.solve({ ...two, urgency })), [16 + 16, 8 + 16, 4 + 16]);
  assert.deepEqual([...urgency], [0, 2, 1, 1, 0]);
  assert.deepEqual([1, 2].map(() => crowd.solve(two)), [16 + 16, 16 + 16]);
  refuses(() => crowd.solve({ urgency }), 'urgency goes with priorities');
  refuses(() => crowd.solve({ ...two, urgency: [0, 0, 0, 0, 0] }), 'give a Float32Array');
  refuses(() => crowd.solve({ ...two, urgency: new Float32Array(4) }), 'urgency has 4 numbers; give 5');
  refuses(() => crowd.solve({ ...two, urgency, groups: [0] }), 'leave groups out');
  assert.deepEqual([...urgency], [0, 2, 1, 1, 0]);
  refuses(() => crowd.solve({ priorities: [[1], [1]] }), 'priorities and mostBlocks together');
  refuses(() => crowd.solve({ limb: [0] }), 'solve() takes blocks, groups, mask, limbs, priorities, mostBlocks, urgency, probesOnly, not limb');
  refuses(() => crowd.solve([0]), 'not 0');
  refuses(() => crowd.solve({ limbs: [0.5] }), 'limbs is 0.5');
  refuses(() => crowd.solve({ priorities: [[1]], mostBlocks: 1 }), '1 priorities for 2 groups');
  refuses(() => crowd.solve({ priorities: [[1], [1, 2]], mostBlocks: 1 }), '2 priorities for the 20 limbs of group 1');
  refuses(() => crowd.solve({ limbs: [40] }), '40');
  crowd.dispose();
});
