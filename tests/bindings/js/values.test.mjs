// SPDX-License-Identifier: MIT
// The promise: values are views of memory, and calls see what they hold. Memory is free again when a crowd is, and all of it can be used. That
// each field is in its place is in scenes.test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, load } from 'swivel-wasm';
import { close, refuses, swivel, wasm } from './common.mjs';

test('values are views of memory, which solves read and write', () => {
  const crowd = swivel.crowd([5, 20]);
  const target = crowd.values(Field.TARGET, 1), shoulder = crowd.values(Field.SHOULDER, 1), flags = crowd.values(Field.FLAGS, 1);
  assert.equal(target.length, 60);
  assert.ok(target.every(Number.isNaN));  // never given
  assert.equal(crowd.values(Field.TARGET, 1), target);
  assert.ok(flags instanceof Uint32Array);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group });
  target.set(Array.from({ length: 20 }, (_, n) => [0, 0.1 * n, 1]).flat());
  assert.equal(crowd.solve(), 25);
  assert.equal(crowd.read(Field.FLAGS)[4], Flag.BAD_INPUT);  // group 0 has no targets
  assert.ok(flags.slice(0, 18).every((flag) => flag === Flag.REACHED));
  assert.equal(flags[19], Flag.CLAMPED_FAR);
  assert.deepEqual(crowd.read(Field.SHOULDER, { group: 1, first: 3, count: 2 }), shoulder.slice(12, 20));
  close([...crowd.wrists({ group: 1, first: 4, count: 1 })], [0, 0.4, 1], 1e-6);

  // A copy stays, a view follows; write() changes both rows and view.
  const copy = crowd.read(Field.SHOULDER, { group: 1 });
  crowd.write(Field.TARGET, [0.5, 0.5, 0.5], { group: 1, first: 7, count: 2 });
  assert.deepEqual([...target.slice(21, 27)], [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]);
  crowd.solve();
  assert.notDeepEqual(copy.slice(28, 32), shoulder.slice(28, 32));
  assert.deepEqual(copy.slice(0, 28), shoulder.slice(0, 28));

  // Other crowds come and go; the view stays.
  const before = [...shoulder];
  const others = Array.from({ length: 30 }, () => swivel.crowd([3000]));
  for (const other of others) other.dispose();
  assert.deepEqual([...shoulder], before);
  crowd.dispose();
});

test('calls beside solves see what views hold now', () => {
  const crowd = swivel.crowd([2], Feature.WITH_MAX_SWIVEL);
  crowd.write(Field.LENGTHS, [1, 1]);
  const target = crowd.values(Field.TARGET), normal = crowd.values(Field.NORMAL);
  target.set([0, 0.5, 1, 0, 0.5, 1]);
  crowd.solve();
  assert.match(crowd.explain(1), /reached/i);
  assert.ok(Math.hypot(...normal.slice(3)) > 0.99);
  target.set([0, 0, 9], 3);
  assert.ok(crowd.residuals()[1] > 1);
  target.set([NaN, 0, 0], 3);
  assert.match(crowd.explain(1), /is not a number/);
  crowd.reset({ first: 1 });
  assert.deepEqual([...normal.slice(3)], [0, 0, 0]);
  assert.ok(Math.hypot(...normal.slice(0, 3)) > 0.99);
  crowd.dispose();
});

test('packed results and rows', () => {
  const plain = swivel.crowd([20]);
  plain.write(Field.LENGTHS, [1, 1]), plain.write(Field.TARGET, [0.2, 0.5, 1]), plain.solve();
  const packed = plain.pack(), low = plain.packedRow(Field.FLAGS);
  assert.deepEqual([packed.length, low, plain.packedRow(Field.SHOULDER)], [2 * 16 * (3 + 2 + 2), 5, 0]);
  assert.equal(packed[(7 + low) * 16 + 3], plain.read(Field.FLAGS)[19] & 0xffff);  // block 1, lane 3
  refuses(() => plain.pack(1), 'group 1 does not exist');
  const rows = plain.resultRows(), first = plain.fieldFirstRow(Field.SHOULDER);
  assert.equal(rows.length, 2 * 16 * (4 + 2 + 1));
  assert.equal(rows[(7 + first) * 16 + 3], plain.read(Field.SHOULDER)[4 * 19]);  // block 1, lane 3
  const target = plain.inputRows(), row = plain.fieldFirstRow(Field.TARGET);
  assert.deepEqual([0, 1, 2].map((c) => target[(row + c) * 16]), [0.2, 0.5, 1].map(Math.fround));
  assert.equal(plain.componentCount(Field.TARGET), 3);
  plain.dispose();
});

test('memory beyond two gigabytes', async () => {
  const large = await load({ megabytes: 3000 });
  const [, , crowd] = [18e6, 18e6, 20].map((limbCount) => large.crowd([limbCount]));  // 60 bytes a limb
  crowd.write(Field.LENGTHS, [1, 1]), crowd.write(Field.TARGET, [0, 0.5, 1]);
  const flags = crowd.values(Field.FLAGS);
  assert.ok(crowd.resultRows().byteOffset > 2 ** 31);
  assert.equal(crowd.solve({ mask: [1 + 2 ** 19] }), 2);
  assert.deepEqual([flags[0], flags[1], flags[19]], [Flag.REACHED, 0, Flag.REACHED]);
  assert.match(crowd.explain(19), /reached/i);
  assert.equal(large.isaName, 'sse2');
});

test('calls and crowds that are disposed of leave nothing behind', async () => {
  const small = await load({ megabytes: 4, wasm });
  const largest = () => {  // the limbs of the largest crowd that memory has room for
    let [min, max] = [1, 100000];
    while (max - min > 16) {
      const limbs = (min + max) >> 1;
      try {
        small.crowd([limbs]).dispose();
        min = limbs;
      } catch {
        max = limbs;
      }
    }
    return min;
  };
  const parents = Array.from({ length: 300 }, (_, n) => n - 1), translations = parents.flatMap((n) => [1, n % 2, 0]);
  const bodies = { skeleton: { parents, translations }, groups: [{ joints: { shoulder: 0, elbow: 1, wrist: 2 } }], rootIsDouble: true };
  const before = largest();
  for (let n = 0; n < 100; ++n) {
    const crowd = small.crowd([200, 300]);
    for (const field of [Field.TARGET, Field.SHOULDER, Field.FLAGS]) crowd.values(field, 1);
    crowd.write(Field.LENGTHS, [1, 1]), crowd.solve(), crowd.pack(1), crowd.explain(0), crowd.allowedArcs(0), crowd.wrists(), crowd.jointAngles();
    for (const wrong of [() => crowd.values(Field.HAND), () => crowd.read(Field.HAND), () => small.crowd([100000])]) assert.throws(wrong);
    crowd.dispose();
    crowd.dispose();
    const posed = small.bodies({ ...bodies, bodyCount: 9 });
    posed.pose('results'), posed.positions(Field.TARGET), posed.solve(), posed.dispose();
    assert.throws(() => small.bodies({ ...bodies, bodyCount: 1000 }), /give load\(\) more megabytes/);  // the crowd has room, its poses have not
  }
  assert.equal(largest(), before);
});
