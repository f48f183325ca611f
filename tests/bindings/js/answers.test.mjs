// SPDX-License-Identifier: MIT
// The promise: bindings, angles, the lecture's steps, choices of limbs and groups mean what they mean in C.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag } from 'swivel-wasm';
import { close, limb, refuses, slanted, swivel } from './common.mjs';

test('a binding is that of its joints, wherever they are in a skeleton', () => {
  const binding = swivel.bindJoints(slanted, limb);
  close(binding.lengths, [0.3, Math.hypot(0.25, 0.02)], 1e-7);
  const { translations, rotations } = slanted;
  const whole = swivel.bindJoints(
    { parents: [-1, 0, 1, 2], translations: [1, 2, 3, 0, 0.1, 0, ...translations.slice(3)], rotations: [0, 0, 0, 1, ...rotations] },
    { shoulder: 1, elbow: 2, wrist: 3, bend: limb.bend });
  assert.deepEqual(whole.bytes, binding.bytes);
  assert.notDeepEqual(swivel.bindJoints({ ...slanted, rotations: undefined }, limb).bytes, binding.bytes);
  const skeleton = { parents: [-1, 0, 1, 1], translations: [0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0.5] };
  const joints = { shoulder: 0, elbow: 1, wrist: 2, bend: [0, 1, 0] };
  assert.notDeepEqual(swivel.bindJoints(skeleton, { ...joints, twistBones: [3] }).bytes, swivel.bindJoints(skeleton, joints).bytes);
  refuses(() => swivel.bindJoints({ ...skeleton, translations: [0, 0, 1] }, joints), 'translations has 3 numbers; give 12');
  refuses(() => swivel.bindJoints(skeleton, { ...joints, wrist: 9 }), '9');
});

test('explanations of many bad inputs are whole', () => {
  const crowd = swivel.crowd([1], Feature.WITH_HAND | Feature.WITH_INCOMING | Feature.WITH_SHOULDER_BOX | Feature.WITH_WRIST_BOX | Feature.WITH_REACH);
  for (const field of Object.values(Field)) {
    const count = field < Field.SHOULDER ? crowd.componentCount(field) : 0;
    if (count) crowd.write(field, new Array(count).fill(-1.2345678e20));
  }
  crowd.solve();
  assert.ok(crowd.explain(0).length > 1024);
  assert.match(crowd.explain(0), / The limb has its rest pose\.$/);
  crowd.dispose();
});

test('angles become what fields take', () => {
  close([...swivel.range(-0.5, 1.5)], [Math.cos(0.5), Math.sin(0.5), Math.cos(1), Math.sin(1)], 1e-7);
  close([...swivel.cosSin(0.3)], [Math.cos(0.3), Math.sin(0.3)], 1e-7);
  close([...swivel.aim([0, 0, 2], 0.5)].slice(0, 3), [0, 0, 1], 1e-7);
  const straight = swivel.bindJoints({ parents: [-1, 0, 1], translations: [0, 0, 0, 0, 0, 1, 0, 0, 1] }, { ...limb, bend: [0, 1, 0] });
  close(swivel.armAxis(straight, [0, 0, Math.SQRT1_2, Math.SQRT1_2], [0, 3, 0]), [1, 0, 0], 1e-7);
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

// A mask of these limbs, as solve() takes it.
function maskOf(crowd, ...limbs) {
  const words = new Uint32Array(Math.ceil(crowd.blockCount / 2));
  for (const limb of limbs) words[limb >> 5] |= 1 << (limb & 31);
  return words;
}

test('some limbs: blocks, masks and budgets', () => {
  const crowd = swivel.crowd([40, 20]);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group }), crowd.write(Field.TARGET, [0, 0.5, 1], { group });
  const solved = () => [0, 1].flatMap((group) => [...crowd.read(Field.FLAGS, { group })].map((flag, n) => [flag, `${group}:${n}`])).filter(([flag]) => flag).map(([, name]) => name);
  assert.equal(crowd.firstLimb(1), 48);
  assert.equal(crowd.solve({ mask: maskOf(crowd, 2, crowd.firstLimb(1) + 3) }), 2);
  assert.deepEqual(solved(), ['0:2', '1:3']);
  assert.equal(crowd.solve({ mask: [1, 0, 0] }), 1);
  assert.deepEqual(solved(), ['0:0', '0:2', '1:3']);
  assert.equal(crowd.solve({ blocks: { first: 2, count: 1 } }), 8);
  const mask = crowd.choose([[1], new Float32Array(20).fill(2)], 1);
  assert.deepEqual([mask.constructor, mask.length, crowd.solve({ mask })], [Uint32Array, 3, 16]);
  assert.equal(solved().filter((name) => name.startsWith('1:')).length, 16);
  // One priority for all of a group, and one for each limb: the block of the most urgent limb is picked.
  const urgent = new Float32Array(40);
  urgent[20] = 100;
  const before = solved();
  assert.equal(crowd.solve({ mask: crowd.choose([urgent, [0]], 1) }), 16);
  assert.deepEqual(solved().filter((name) => !before.includes(name)).slice(0, 2), ['0:16', '0:17']);
  // Blocks take turns while their urgency is kept. The blocks have 16, 16, 8, 16 and 4 limbs.
  const urgency = new Float32Array(crowd.blockCount), two = [[1], [1]];
  assert.deepEqual([1, 2, 3].map(() => crowd.solve({ mask: crowd.choose(two, 2, urgency) })), [16 + 16, 8 + 16, 4 + 16]);
  assert.deepEqual([...urgency], [0, 2, 1, 1, 0]);
  assert.deepEqual([1, 2].map(() => crowd.solve({ mask: crowd.choose(two, 2) })), [16 + 16, 16 + 16]);
  refuses(() => crowd.choose(two, 2, [0, 0, 0, 0, 0]), 'give a Float32Array');
  refuses(() => crowd.choose(two, 2, new Float32Array(4)), 'urgency has 4 numbers; give 5');
  refuses(() => crowd.choose(two, 1.5, urgency), 'maxBlocks is 1.5');
  refuses(() => crowd.choose(two, undefined, urgency), 'maxBlocks is undefined');
  refuses(() => crowd.choose(1, 1, urgency), 'priorities is 1; give a list for each group');
  refuses(() => crowd.choose([1, 1], 1, urgency), 'priorities is 1; give an array of numbers');
  refuses(() => crowd.choose([[1]], 1, urgency), '1 priorities for 2 groups');
  refuses(() => crowd.choose([[1], [1, 2]], 1, urgency), '2 priorities for the 20 limbs of group 1');
  assert.deepEqual([...urgency], [0, 2, 1, 1, 0]);
  refuses(() => crowd.solve({ limb: [0] }), 'solve() takes blocks, groups, mask, not limb');
  refuses(() => crowd.solve([0]), 'not 0');
  refuses(() => crowd.solve({ mask: [0.5, 0, 0] }), 'mask is 0.5');
  refuses(() => crowd.solve({ mask: [1, 0] }), 'a mask of 2 words');
  crowd.dispose();
  refuses(() => crowd.choose(two, 2), 'this crowd is disposed of');
});

test('features given once are for groups that give none', () => {
  const crowd = swivel.crowd([2, { limbCount: 3 }, { limbCount: 4, features: 0n }, { limbCount: 5, features: Feature.JOINTS, binding: swivel.bindJoints(slanted, limb) }], Feature.WITH_HAND);
  assert.deepEqual([0, 1, 2, 3].map((group) => crowd.features(group)), [Feature.WITH_HAND, Feature.WITH_HAND, 0n, Feature.JOINTS]);
  assert.deepEqual([0, 1, 2, 3].map((group) => crowd.componentCount(Field.HAND, group)), [4, 4, 0, 0]);
  assert.deepEqual([2, 3].map((group) => [crowd.resultRows(group).length, crowd.pack(group).length]), [[16 * 7, 16 * 7], [16 * 9, 16 * 8]]);
  assert.deepEqual([crowd.groupCount, crowd.blockCount], [4, 4]);
  refuses(() => crowd.values(Field.HAND, 2), 'WITH_HAND');
  refuses(() => crowd.write(Field.HAND, [0, 0, 0, 1], { group: 2 }), 'WITH_HAND');
  crowd.dispose();
});

test('a solve of named groups leaves the others alone', () => {
  const counts = Array.from({ length: 40 }, (_, n) => 1 + n), crowd = swivel.crowd(counts);
  counts.forEach((_, group) => {
    crowd.write(Field.LENGTHS, [1, 1], { group });
    if (group % 3) crowd.values(Field.TARGET, group).fill(0.5), crowd.values(Field.FLAGS, group);  // frames of these groups
    else crowd.write(Field.TARGET, [0.5, 0.5, 0.5], { group });
  });
  const solved = () => counts.flatMap((_, group) => (crowd.read(Field.FLAGS, { group }).every((flags) => flags === Flag.REACHED) ? [group] : []));
  assert.equal(crowd.solve({ groups: [] }), 0);
  assert.deepEqual(solved(), []);
  assert.equal(crowd.solve({ groups: [34, 3, 31, 3] }), counts[3] + counts[31] + counts[34]);
  assert.deepEqual(solved(), [3, 31, 34]);
  assert.equal(crowd.solve({ groups: [0, 5, 39], mask: maskOf(crowd, crowd.firstLimb(5), crowd.firstLimb(5) + 2, crowd.firstLimb(6)) }), 2);
  assert.deepEqual([...crowd.read(Field.FLAGS, { group: 5 })], [1, 0, 1, 0, 0, 0]);
  assert.equal(crowd.read(Field.FLAGS, { group: 6 })[0], 0);
  assert.equal(crowd.solve(), 820);
  assert.deepEqual(solved(), counts.map((_, group) => group));
  crowd.dispose();
});
