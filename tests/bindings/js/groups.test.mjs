// SPDX-License-Identifier: MIT
// The promise: groups have features of their own, and a solve is of the groups that it names.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag } from 'swivel-wasm';
import { chain, refuses, swivel } from './common.mjs';

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
