// SPDX-License-Identifier: MIT
// The promise: groups have features and bad input of their own, and a solve is of the groups that it names.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, OnBadInput } from 'swivel-wasm';
import { chain, refuses, swivel } from './common.mjs';

const bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];

const binding = swivel.bind(chain);

test('features given once are for groups that give none', () => {
  const crowd = swivel.crowd([2, { limbCount: 3 }, { limbCount: 4, features: 0n }, { limbCount: 5, features: Feature.JOINTS, binding }], Feature.WITH_HAND);
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
  assert.equal(crowd.solve({ groups: [0, 5, 39], limbs: [crowd.firstLimb(5), crowd.firstLimb(5) + 2, crowd.firstLimb(6)] }), 2);
  assert.deepEqual([...crowd.read(Field.FLAGS, { group: 5 })], [1, 0, 1, 0, 0, 0]);
  assert.equal(crowd.read(Field.FLAGS, { group: 6 })[0], 0);
  assert.equal(crowd.solve(), 820);
  assert.deepEqual(solved(), counts.map((_, group) => group));
  crowd.dispose();
});

test('a limb with bad input gets its rest pose, or keeps the one it had', () => {
  const crowd = swivel.crowd([{ limbCount: 3 }, { limbCount: 3, onBadInput: OnBadInput.KEEP_POSE }], Feature.WITH_MOST_SWIVEL);
  const of = (name) => [0, 1].map((group) => crowd.values(Field[name], group));
  const [targets, shoulders, normals, flags] = ['TARGET', 'SHOULDER', 'NORMAL', 'FLAGS'].map(of);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group }), targets[group].set([0, 0.5, 1, 0.2, 0.5, 1, 0.4, 0.5, 1]);
  crowd.solve();
  const before = [0, 1].map((group) => [bitsOf(shoulders[group]), bitsOf(normals[group])]);
  assert.deepEqual(before[0], before[1]);
  for (const group of [0, 1]) targets[group][4] = NaN;
  crowd.solve();
  for (const group of [0, 1]) {
    assert.deepEqual([...flags[group]], [Flag.REACHED, Flag.BAD_INPUT, Flag.REACHED]);
    assert.match(crowd.explain(1, group), /is not a number/);
  }
  assert.deepEqual([...shoulders[0].slice(4, 8), ...normals[0].slice(3, 6)], [0, 0, 0, 1, 0, 0, 0]);
  assert.deepEqual([bitsOf(shoulders[1]), bitsOf(normals[1])], before[1]);
  assert.deepEqual(bitsOf(crowd.read(Field.SHOULDER, { group: 1 })), before[1][0]);
  crowd.dispose();
});
