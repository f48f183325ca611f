// SPDX-License-Identifier: MIT
// The promise: memory is free again when a crowd is, and all of it can be used.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, load } from 'swivel-wasm';
import { wasm } from './common.mjs';

test('memory beyond two gigabytes', async () => {
  const large = await load({ megabytes: 3000 });
  const [, , crowd] = [18e6, 18e6, 20].map((limbCount) => large.crowd([limbCount]));  // 60 bytes a limb
  crowd.write(Field.LENGTHS, [1, 1]), crowd.write(Field.TARGET, [0, 0.5, 1]);
  const flags = crowd.values(Field.FLAGS);
  assert.ok(crowd.resultRows().byteOffset > 2 ** 31);
  assert.equal(crowd.solve({ limbs: [0, 19] }), 2);
  assert.deepEqual([flags[0], flags[1], flags[19]], [Flag.REACHED, 0, Flag.REACHED]);
  assert.match(crowd.explain(19), /reached/i);
  assert.equal(large.isaName, 'sse2');
});

test('calls and crowds that are disposed of leave nothing behind', async () => {
  const small = await load({ megabytes: 4, wasm });
  const largest = () => {  // the limbs of the largest crowd that memory has room for
    let [least, most] = [1, 100000];
    while (most - least > 16) {
      const limbs = (least + most) >> 1;
      try {
        small.crowd([limbs]).dispose();
        least = limbs;
      } catch {
        most = limbs;
      }
    }
    return least;
  };
  const parents = Array.from({ length: 300 }, (_, n) => n - 1), translations = parents.flatMap((n) => [1, n % 2, 0]);
  const bodies = { skeleton: { parents, translations }, groups: [{ joints: { shoulder: 0, elbow: 1, wrist: 2 } }], rootIsDouble: true };
  const before = largest();
  for (let n = 0; n < 100; ++n)
    {
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
