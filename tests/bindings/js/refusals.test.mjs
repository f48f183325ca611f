// SPDX-License-Identifier: MIT
// The promise: what is wrong is refused in one line, and changes nothing.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, load, SwivelError } from 'swivel-wasm';
import { chain, refuses, swivel, wasm } from './common.mjs';

test('what is wrong is refused in one line, and changes nothing', async () => {
  const crowd = swivel.crowd([4, 2]);
  for (const group of [0, 1]) crowd.write(Field.TARGET, [0, 0, 1], { group }), crowd.write(Field.LENGTHS, [1, 1], { group });
  crowd.solve();
  const before = crowd.digest(), targets = crowd.read(Field.TARGET);
  refuses(() => crowd.write(Field.TARGET, [0, 0]), '2 numbers for TARGET of 4 limbs; give 3, or 3 for each limb');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 1, 0, 0, 1]), '6 numbers for TARGET of 4 limbs');
  refuses(() => crowd.write(Field.TARGET, []), '0 numbers');
  refuses(() => crowd.write(Field.TARGET, { x: 0, y: 0, z: 0 }), 'TARGET is [object Object]; give an array of numbers');
  refuses(() => crowd.write(Field.TYPO, [9, 9, 9]), 'the field is undefined; give one of Field');
  refuses(() => crowd.write('POLE', [9, 9, 9]), 'the field is "POLE"; give one of Field');
  refuses(() => crowd.read(undefined), 'give one of Field');
  refuses(() => crowd.values(7000), 'give one of Field');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 0], { first: 4, count: 1 }), 'count is 1; give a whole number from 0 to 0');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 0], { first: 5 }), 'first is 5; give a whole number from 0 to 4');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 0], { group: NaN, count: 4 }), 'group NaN does not exist');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 0], { limb: 2 }), 'a choice of limbs takes group, first, count, not limb');
  refuses(() => crowd.write(Field.TARGET, [0, 0, 0], 3), 'not 3');
  refuses(() => crowd.read(Field.TARGET, { group: 2 }), 'group 2 does not exist; the crowd has 2');
  refuses(() => crowd.read(Field.TARGET, { first: -1 }), 'first is -1');
  refuses(() => crowd.explain(undefined), 'limb is undefined');
  refuses(() => crowd.explain(4), 'limb is 4; give a whole number from 0 to 3');
  refuses(() => crowd.find('BAD_INPUT'), 'flags is "BAD_INPUT"');
  refuses(() => crowd.find(Flag.TYPO), 'flags is undefined');
  refuses(() => crowd.jointAngles({ order: 2 }), 'not order');
  refuses(() => crowd.firstLimb(9), 'group 9');
  refuses(() => crowd.mirror(Field.ANGLE, [1, 0]), 'this crowd has no ANGLE');
  refuses(() => swivel.crowd([0]), 'limb');
  refuses(() => swivel.crowd(5), 'groups is 5');
  refuses(() => swivel.crowd([{ limbs: 5 }]), 'a group takes limbCount, features, binding, shoulderOrder, wristOrder, onBadInput, region, not limbs');
  refuses(() => swivel.crowd([1], 3), 'features is 3; give a BigInt');
  refuses(() => swivel.crowd([1], 1n << 64n), 'features is');
  refuses(() => swivel.crowd([1, { limbCount: 1, features: 3 }]), 'features is 3; give a BigInt');
  refuses(() => swivel.crowd([{ limbCount: 1, order: 1 }]), 'not order');
  refuses(() => swivel.crowd([{ limbCount: 1, wristOrder: 6 }]), 'order');
  refuses(() => swivel.crowd([{ limbCount: 1, onBadInput: 2 }]), 'bad');
  refuses(() => swivel.crowd([{ limbCount: 1, onBadInput: 'KEEP_POSE' }]), 'onBadInput is "KEEP_POSE"');
  refuses(() => crowd.componentCount(Field.TARGET, 2), 'group 2 does not exist; the crowd has 2');
  for (const call of ['inputRows', 'resultRows', 'pack', 'features']) refuses(() => crowd[call](2), 'group 2 does not exist; the crowd has 2');
  for (const call of ['fieldFirstRow', 'fieldRowCount']) refuses(() => crowd[call](Field.TARGET, 2), 'group 2 does not exist; the crowd has 2');
  refuses(() => crowd.solve({ groups: [0, 2] }), 'group 2 does not exist; the crowd has 2');
  refuses(() => crowd.solve({ groups: 1 }), 'groups is 1; give an array of numbers');
  refuses(() => swivel.crowd([71_582_800]), 'beyond what a pointer reaches');
  refuses(() => swivel.crowd([5_000_000]), 'give load() more megabytes');
  refuses(() => swivel.bind(), 'bind() takes shoulderRotation');
  refuses(() => swivel.bind({ elbowOffset: [0, 0, 1] }), 'wristOffset is undefined; give an array of numbers');
  refuses(() => swivel.bind({ ...chain, bend: [1, 0] }), 'bend has 2 numbers; give 3');
  refuses(() => swivel.cone([0, 0], 1), 'axis has 2 numbers; give 3');
  assert.equal(crowd.digest(), before);
  assert.deepEqual(crowd.read(Field.TARGET), targets);
  const view = crowd.values(Field.SHOULDER);
  crowd.dispose();
  for (const call of ['solve', 'digest', 'inputRows', 'reset', 'residuals']) refuses(() => crowd[call](), 'this crowd is disposed of');
  refuses(() => crowd.values(Field.SHOULDER), 'this crowd is disposed of');
  refuses(() => crowd.read(Field.SHOULDER), 'this crowd is disposed of');
  assert.equal(view.length, 16);
});

test('load() takes bytes, a response or an address, and says what is wrong', async () => {
  for (const source of [wasm, new Response(wasm), `data:application/wasm;base64,${wasm.toString('base64')}`, undefined])
    assert.equal((await load({ wasm: source })).isaName, 'sse2');
  for (const [given, says] of [
    [{ megabytes: 1 }, 'megabytes is 1; give 2 to 4096'],
    [{ memory: 8 }, 'load() takes megabytes, wasm, not memory'],
    [8, 'load() takes megabytes, wasm, not 8'],
    [{ wasm: new Uint8Array(8) }, 'what came is not swivel.wasm'],
    [{ wasm: new Response('<!doctype html>') }, 'it starts with "<!do"'],
    [{ wasm: wasm.subarray(0, 5000) }, 'or the file is damaged'],
    [{ wasm: new Response('', { status: 404 }) }, '404'],
  ]) await assert.rejects(load(given), (error) => error instanceof SwivelError && error.message.includes(says) || assert.fail(error));
});
