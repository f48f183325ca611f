// SPDX-License-Identifier: MIT
// The promise: groups have features, rows and bad input of their own, and a solve is of the groups that it names.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, LANES, OnBadInput, Order } from 'swivel-wasm';
import { chain, plus, refuses, swivel } from './common.mjs';

const bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];

// Arms of a skeleton, with hands and twist bones, and plain legs with a box. Each: its group, and its inputs by field.
const binding = swivel.bind(chain), limbCounts = [50, 35];
const random = (() => { let seed = 1; return () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5; })();
const many = (count, most, from) => Array.from({ length: count }, () => from.map((x) => x + most * random())).flat();
const kinds = [
  { group: { limbCount: limbCounts[0], features: Feature.WORLD | Feature.JOINTS | Feature.WITH_HAND | 2n * Feature.WITH_TWIST_BONES, binding },
    inputs: { TARGET: many(50, 0.8, [2.2, -0.8, 4.1]), POLE: plus([2, -1, 4], [0, -5, 1]), SHOULDER_POSITION: [2, -1, 4], PARENT_ROTATION: [0.3, -0.2, 0.5, 0.7], HAND: many(50, 2, [0, 0, 0, 1]) } },
  { group: { limbCount: limbCounts[1], features: Feature.WITH_SHOULDER_BOX | Feature.WITH_MOST_SWIVEL, shoulderOrder: Order.ZYX },
    inputs: { TARGET: many(35, 0.5, [0.1, 0.2, 0.4]), LENGTHS: [0.3, 0.4], SHOULDER_BOX: [...swivel.range(-0.2, 0.3), ...swivel.range(0.1, 0.4), ...swivel.range(-1, 2)] } },
];
const give = (crowd, group, { inputs }) => Object.entries(inputs).forEach(([name, values]) => crowd.write(Field[name], values, { group }));
const results = (crowd, group) => Object.entries(Field).filter(([, field]) => field >= Field.SHOULDER && crowd.componentCount(field, group) > 0)
  .map(([name, field]) => [name, bitsOf(crowd.read(field, { group }))]);

test('groups of different features in one solve have the bits of crowds of their own', () => {
  const together = swivel.crowd(kinds.map(({ group }) => group)), alone = kinds.map(({ group }) => swivel.crowd([group]));
  kinds.forEach((kind, n) => {
    give(together, n, kind), give(alone[n], 0, kind);
    assert.equal(together.features(n), kind.group.features);
    for (const field of Object.values(Field))
      for (const of of ['componentCount', 'fieldRowCount', 'fieldFirstRow']) assert.equal(together[of](field, n), alone[n][of](field));
  });
  assert.deepEqual([0, 1].map((n) => together.componentCount(Field.TWIST_BONES, n)), [8, 0]);
  assert.deepEqual([0, 1].map((n) => together.componentCount(Field.ELBOW, n)), [4, 2]);
  // From rows first. Then from views, of one group alone and of both.
  for (const viewed of [[], [1], [0]]) {
    for (const n of viewed) {
      const targets = many(limbCounts[n], 0.1, n === 0 ? [2.2, -0.8, 4.1] : [0.1, 0.2, 0.4]);
      together.values(Field.TARGET, n).set(targets), alone[n].values(Field.TARGET).set(targets);
    }
    assert.equal(together.solve(), 85);
    kinds.forEach((_, n) => {
      alone[n].solve();
      const found = results(together, n);
      assert.deepEqual(found, results(alone[n], 0));
      assert.ok(new Set(found[0][1]).size > limbCounts[n]);  // rotations of shoulders
      const rows = together.resultRows(n), row = rows.length / Math.ceil(limbCounts[n] / LANES) + together.fieldFirstRow(Field.SHOULDER, n) * LANES;
      assert.equal(rows[row + 1], together.read(Field.SHOULDER, { group: n })[4 * 17]);  // block 1, lane 1
    });
  }
  refuses(() => together.values(Field.TWIST_BONES, 1), 'WITH_TWIST_BONES');
  refuses(() => together.write(Field.SHOULDER_BOX, kinds[1].inputs.SHOULDER_BOX), 'WITH_SHOULDER_BOX');
  assert.equal(together.mirror(Field.SHOULDER_BOX, kinds[1].inputs.SHOULDER_BOX).length, 12);
  for (const crowd of [together, ...alone]) crowd.dispose();
});

test('features given once are for groups that give none', () => {
  const crowd = swivel.crowd([2, { limbCount: 3 }, { limbCount: 4, features: 0n }, { limbCount: 5, features: Feature.JOINTS, binding }], Feature.WITH_HAND);
  assert.deepEqual([0, 1, 2, 3].map((group) => crowd.features(group)), [Feature.WITH_HAND, Feature.WITH_HAND, 0n, Feature.JOINTS]);
  assert.deepEqual([0, 1, 2, 3].map((group) => crowd.componentCount(Field.HAND, group)), [4, 4, 0, 0]);
  assert.deepEqual([2, 3].map((group) => [crowd.resultRows(group).length, crowd.pack(group).length]), [[16 * 7, 16 * 7], [16 * 9, 16 * 8]]);
  assert.deepEqual([crowd.groupCount, crowd.blockCount], [4, 4]);
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
