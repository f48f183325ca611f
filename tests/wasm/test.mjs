// SPDX-License-Identifier: MIT
// The promise: the package for the web has all that its README says, gives the native library's bits, and refuses what is wrong in one line.
//   node --test test.mjs   beside an installed swivel-wasm; ARM: swivel's build of tests/package/arm.c. HEADER: swivel.h
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { test } from 'node:test';
import { Feature, Field, Flag, LANES, load, MOST_TWIST_BONES, Order, Status, SwivelError, VERSION } from 'swivel-wasm';

const swivel = await load();
const refuses = (act, text) =>
  assert.throws(act, (error) => error instanceof SwivelError && error.message.includes(text) && !error.message.includes('\n') || assert.fail(error));

// ---- quaternions x, y, z, w; a*b applies b first
const times = ([a, b, c, d], [e, f, g, h]) =>
  [d * e + a * h + b * g - c * f, d * f - a * g + b * h + c * e, d * g + a * f - b * e + c * h, d * h - a * e - b * f - c * g];
const turned = (q, v) => times(times(q, [...v, 0]), [-q[0], -q[1], -q[2], q[3]]).slice(0, 3);
const plus = (a, b) => a.map((x, n) => x + b[n]);
const close = (a, b, within) => a.forEach((x, n) => assert.ok(Math.abs(x - b[n]) <= within, `${a} is not ${b}`));
const unit = (q) => q.map((x) => x / Math.hypot(...q));

// The arms of tests/package/arm.c.
function manyArms() {
  const targets = new Float32Array(3000);
  let random = 1;
  for (let n = 0; n < targets.length; ++n) {
    random = (Math.imul(random, 1664525) + 1013904223) >>> 0;
    targets[n] = Math.fround(0.04) + Math.fround(Math.fround(random >>> 8) * Math.fround(Math.fround(0.26) / 16777216));
  }
  return targets;
}

test('the same bits as the native library, with and without SIMD', () => {
  const line = execFileSync(process.env.ARM, { encoding: 'utf8' });
  assert.equal(swivel.isaName, 'sse2');
  for (const isa of ['scalar', 'sse2']) {
    swivel.useIsa(isa);
    assert.equal(swivel.isaName, isa);
    const crowd = swivel.crowd([1000]);
    crowd.write(Field.TARGET, manyArms());
    crowd.write(Field.POLE, [0.25, -1, 0.125]);
    crowd.write(Field.LENGTHS, [0.3, 0.26]);
    assert.equal(crowd.solve(), 1000);
    assert.ok(crowd.residuals().every((off) => off < 1e-6));
    assert.ok(line.endsWith(`digest ${crowd.digest().toString(16).padStart(16, '0')}\n`), line);
    crowd.dispose();
  }
});

test('digests are unsigned, and differ with any result', () => {
  const crowd = swivel.crowd([1]), seen = new Set();
  crowd.write(Field.LENGTHS, [1, 1]);
  for (let n = 0; n < 64; ++n) {
    crowd.write(Field.TARGET, [0.01 * n, 0.5, 1]), crowd.solve();
    assert.ok(crowd.digest() >= 0n);
    seen.add(crowd.digest());
  }
  assert.equal(seen.size, 64);
  crowd.dispose();
});

test('every name of swivel.h, with its number', () => {
  const header = readFileSync(process.env.HEADER, 'utf8').replace(/\/\/.*/g, '');
  assert.deepEqual(Feature, Object.fromEntries([...header.matchAll(/#define SWIVEL_(\w+) \(UINT64_C\(1\) << (\d+)\)/g)].map(([, name, bit]) => [name, 1n << BigInt(bit)])));
  const numbersOf = (name) => {
    let next = 0;
    const members = header.match(new RegExp(`typedef enum ${name} \\{(.*?)\\}`, 's'))[1].split(',').map((text) => text.trim()).filter(Boolean);
    return Object.fromEntries(members.map((text) => {
      const [key, given] = text.split('=').map((part) => part.trim());
      const value = given ? Number(new Function(`return ${given.replace(/u/g, '')}`)()) : next;
      next = value + 1;
      return [key.replace('SWIVEL_', ''), value];
    }).filter(([key]) => !key.endsWith('_END')));
  };
  for (const [names, kind] of [[Field, 'field'], [Flag, 'flag'], [Order, 'euler_order'], [Status, 'status']]) assert.deepEqual({ ...names }, numbersOf(`swivel_${kind}`));
  assert.equal(LANES, 16);
  assert.equal(MOST_TWIST_BONES, 7);
  assert.deepEqual(VERSION.split('.'), ['MAJOR', 'MINOR', 'PATCH'].map((part) => header.match(new RegExp(`SWIVEL_VERSION_${part} (\\d+)`))[1]));
});

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

test('every field has its own place in frames', () => {
  const everyFeature = Object.entries(Feature).filter(([name]) => !/AIM|CLAVICLE|COMPACT|POLE_INCOMING|POLE_NORMAL|POLE_DIRECTION|TWIST_BONES/.test(name)).reduce((sum, [, bit]) => sum | bit, 0n);
  const binding = swivel.bind({ elbowOffset: [0, 0, 1], wristOffset: [0, 0, 1], bend: [0, 1, 0] });
  for (const features of [everyFeature, Feature.WORLD | Feature.JOINTS | Feature.WITH_HAND | Feature.WITH_CLAVICLE | 3n * Feature.WITH_TWIST_BONES, Feature.WITH_AIM]) {
    const [viewed, copied] = [0, 1].map(() => swivel.crowd([{ limbCount: 20, binding }], features));
    for (const [name, field] of Object.entries(Field)) {
      const count = viewed.componentCount(field);
      if (count === 0) continue;
      const view = viewed.values(field);
      assert.equal(view.length, 20 * count, name);
      if (field >= Field.SHOULDER) continue;
      const value = [...viewed.read(field, { count: 1 })].map((x, n) => (Number.isNaN(x) ? 0.3 * n + 0.4 : x));
      copied.write(field, value);
      for (let n = 0; n < 20; ++n) view.set(value, n * count);
    }
    for (const crowd of [viewed, copied]) assert.equal(crowd.solve(), 20);
    for (const [name, field] of Object.entries(Field)) assert.deepEqual(viewed.componentCount(field) && viewed.read(field), copied.componentCount(field) && copied.read(field), name);
    assert.equal(viewed.find(Flag.BAD_INPUT), undefined);
    assert.equal(viewed.digest(), copied.digest());
    for (const crowd of [viewed, copied]) crowd.dispose();
  }
});

const slant = unit([0.2, 0.4, -0.4, 0.8]);
const chain = { shoulderRotation: slant, elbowRotation: unit([0.1, 0, 0, 1]), wristRotation: slant, elbowOffset: [0.3, 0, 0], wristOffset: [0.25, 0.02, 0], bend: [0, 0, 1] };

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

test('limits, their arcs, and what explains them', () => {
  const crowd = swivel.crowd([3], Feature.WITH_SHOULDER_CONE | Feature.WITH_FLEXION_LIMIT | Feature.WITH_ANGLE | Feature.WITH_SHOULDER_BOX, { shoulderOrder: Order.YXZ });
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

test('orders of Euler angles reach boxes, mirrors and joint angles', () => {
  const box = [...swivel.range(-0.2, 0.3), ...swivel.range(0.1, 0.4), ...swivel.range(-1, 2)];
  const angles = [Order.XYZ, Order.ZYX].map((shoulderOrder) => {
    const crowd = swivel.crowd([1], Feature.WITH_SHOULDER_BOX, { shoulderOrder });
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
    return [...all[0]];
  });
  assert.notDeepEqual(angles[0], angles[1]);
});

test('answers are about the limb and the group asked for', () => {
  const crowd = swivel.crowd([2, 3], Feature.WITH_SHOULDER_CONE | Feature.WITH_HUMERAL_TWIST);
  for (const group of [0, 1]) crowd.write(Field.LENGTHS, [1, 1], { group }), crowd.write(Field.TARGET, [0.2, 0.3, 1.2 + 0.1 * group], { group });
  crowd.write(Field.TARGET, [0, 0, 9], { group: 1, first: 2 });
  crowd.write(Field.SHOULDER_CONE, swivel.cone([0.6, 0, 1], 0.6), { group: 1, first: 1, count: 1 });
  crowd.write(Field.HUMERAL_TWIST, swivel.range(-0.4, 0.4), { group: 1, first: 1, count: 1 });
  crowd.solve();
  assert.deepEqual(crowd.find(Flag.CLAMPED_FAR), { group: 1, limb: 2 });
  assert.match(crowd.explain(2, 1), /out of reach/);
  assert.doesNotMatch(crowd.explain(1, 0), /out of reach/);
  assert.ok(crowd.residuals({ group: 1, first: 2 })[0] > 3 && crowd.residuals({ group: 1 })[0] < 1e-6);
  assert.deepEqual(crowd.allowedArcs(0, 0).length, 1);
  const arcs = crowd.allowedArcs(1, 1);
  assert.ok(arcs.length > 0 && !arcs.every(({ from, to }) => from[0] === to[0]));
  for (const { from, to } of arcs) close([Math.hypot(...from), Math.hypot(...to)], [1, 1], 1e-6);
  if (arcs.length > 1) assert.notDeepEqual(arcs[0], arcs[1]);
  close([...crowd.wrists({ group: 1, count: 1 })], [0.2, 0.3, 1.3], 2e-6);
  crowd.dispose();
});

test('calls beside solves see what views hold now', () => {
  const crowd = swivel.crowd([2], Feature.WITH_MOST_SWIVEL);
  crowd.write(Field.LENGTHS, [1, 1]);
  const target = crowd.values(Field.TARGET), normal = crowd.values(Field.NORMAL);
  target.set([0, 0.5, 1, 0, 0.5, 1]);
  crowd.solve();
  assert.match(crowd.explain(1), /reached/i);
  assert.ok(Math.hypot(...normal.slice(3)) > 0.99);
  target.set([0, 0, 9], 3);
  assert.doesNotMatch(crowd.explain(1), /^The target is reached/);
  assert.ok(crowd.residuals()[1] > 1);
  crowd.reset({ first: 1 });
  assert.deepEqual([...normal.slice(3)], [0, 0, 0]);
  assert.ok(Math.hypot(...normal.slice(0, 3)) > 0.99);
  crowd.dispose();
});

test('some limbs: blocks, masks, lists and budgets', () => {
  const crowd = swivel.crowd([40, 20], Feature.BUDGET);
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
  refuses(() => crowd.solve({ priorities: [[1], [1]] }), 'priorities and mostBlocks together');
  refuses(() => crowd.solve({ limb: [0] }), 'solve() takes blocks, mask, limbs, priorities, mostBlocks, not limb');
  refuses(() => crowd.solve([0]), 'not 0');
  refuses(() => crowd.solve({ limbs: [0.5] }), 'limbs is 0.5');
  refuses(() => crowd.solve({ priorities: [[1]], mostBlocks: 1 }), '1 priorities for 2 groups');
  refuses(() => crowd.solve({ priorities: [[1], [1, 2]], mostBlocks: 1 }), '2 priorities for the 20 limbs of group 1');
  refuses(() => crowd.solve({ limbs: [40] }), '40');
  crowd.dispose();
});

test('packed results and rows', () => {
  const crowd = swivel.crowd([20], Feature.COMPACT), plain = swivel.crowd([20]);
  for (const each of [crowd, plain]) each.write(Field.LENGTHS, [1, 1]), each.write(Field.TARGET, [0.2, 0.5, 1]), each.solve();
  refuses(() => crowd.values(Field.SHOULDER), 'compactRows()');
  close([...crowd.read(Field.SHOULDER)], [...plain.read(Field.SHOULDER)], 1e-4);
  assert.equal(crowd.compactRows().length, 2 * 16 * (3 + 2 + 2));
  assert.equal(crowd.resultRows().length, 0);
  const rows = plain.resultRows(), first = plain.fieldFirstRow(Field.SHOULDER);
  assert.equal(rows.length, 2 * 16 * (4 + 2 + 1));
  assert.equal(rows[(7 + first) * 16 + 3], plain.read(Field.SHOULDER)[4 * 19]);  // block 1, lane 3
  const target = plain.inputRows(), row = plain.fieldFirstRow(Field.TARGET);
  assert.deepEqual([0, 1, 2].map((c) => target[(row + c) * 16]), [0.2, 0.5, 1].map(Math.fround));
  assert.equal(plain.fieldRowCount(Field.TARGET), 3);
  for (const each of [crowd, plain]) each.dispose();
});

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
  refuses(() => crowd.write(Field.SHOULDER, [0, 0, 0, 1]), 'shoulder');
  refuses(() => crowd.write(Field.HAND, [0, 0, 0, 1]), 'hand');
  refuses(() => crowd.values(Field.HAND), 'hand');
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
  refuses(() => swivel.crowd([]), 'group');
  refuses(() => swivel.crowd(5), 'groups is 5');
  refuses(() => swivel.crowd([{ limbs: 5 }]), 'a group takes limbCount, binding, not limbs');
  refuses(() => swivel.crowd([1], 3), 'features is 3; give a BigInt');
  refuses(() => swivel.crowd([1], 1n << 64n), 'features is');
  refuses(() => swivel.crowd([1], Feature.POLE_DIRECTION), 'SWIVEL_WORLD');
  refuses(() => swivel.crowd([1], 0n, { order: 1 }), 'not order');
  refuses(() => swivel.crowd([71_582_800]), 'beyond what a pointer reaches');
  refuses(() => swivel.crowd([5_000_000]), 'give load() more megabytes');
  refuses(() => swivel.bind(), 'bind() takes shoulderRotation');
  refuses(() => swivel.bind({ elbowOffset: [0, 0, 1] }), 'wristOffset is undefined; give an array of numbers');
  refuses(() => swivel.bind({ ...chain, bend: [1, 0] }), 'bend has 2 numbers; give 3');
  refuses(() => swivel.bind({ ...chain, bend: chain.elbowOffset }), 'bend');
  refuses(() => swivel.cone([0, 0], 1), 'axis has 2 numbers; give 3');
  refuses(() => swivel.range(1, 0), 'least');
  refuses(() => swivel.turn(NaN), 'the angle is NaN');
  refuses(() => swivel.useIsa('avx2'), "no instruction set 'avx2'");
  assert.equal(crowd.digest(), before);
  assert.deepEqual(crowd.read(Field.TARGET), targets);
  const view = crowd.values(Field.SHOULDER);
  crowd.dispose();
  for (const call of ['solve', 'digest', 'inputRows', 'reset', 'residuals']) refuses(() => crowd[call](), 'this crowd is disposed of');
  refuses(() => crowd.values(Field.SHOULDER), 'this crowd is disposed of');
  refuses(() => crowd.read(Field.SHOULDER), 'this crowd is disposed of');
  assert.equal(view.length, 16);
});

const wasm = readFileSync(new URL('./node_modules/swivel-wasm/swivel.wasm', import.meta.url));
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
  const before = largest();
  for (let n = 0; n < 300; ++n)
    for (const features of [0n, Feature.COMPACT]) {
      const crowd = small.crowd([200, 300], features);
      for (const field of features ? [Field.TARGET] : [Field.TARGET, Field.SHOULDER, Field.FLAGS]) crowd.values(field, 1);
      crowd.write(Field.LENGTHS, [1, 1]), crowd.solve(), crowd.explain(0), crowd.allowedArcs(0), crowd.wrists(), crowd.jointAngles();
      for (const wrong of [() => crowd.values(Field.HAND), () => crowd.read(Field.HAND), () => small.crowd([100000], features)]) assert.throws(wrong);
      crowd.dispose();
      crowd.dispose();
    }
  assert.equal(largest(), before);
});

test("the README's first program", () => {
  const readme = readFileSync(new URL('./node_modules/swivel-wasm/README.md', import.meta.url), 'utf8');
  const program = readme.match(/```js\n(.*?)```/s)[1];
  const said = execFileSync(process.execPath, ['--input-type=module', '--eval', program], { encoding: 'utf8', cwd: dirname(fileURLToPath(import.meta.url)) });
  assert.match(said, /15\.07/);
});

test('the example page moves both wrists of a three.js skeleton to their targets', async () => {
  const page = readFileSync(new URL('./node_modules/swivel-wasm/examples/arms.html', import.meta.url), 'utf8');
  assert.ok(page.trimEnd().split('\n').length <= 40);
  let frame, shown;
  Object.assign(globalThis, { innerWidth: 8, innerHeight: 5, document: { body: { append() {} } } });
  globalThis.TestRenderer = class {  // no graphics here: it takes the frames
    setSize() {}
    setAnimationLoop(act) { frame = act; }
    render(scene) { scene.updateMatrixWorld(), shown = scene; }
  };
  const script = page.match(/<script type="module">(.*?)<\/script>/s)[1].replace('new THREE.WebGLRenderer(', 'new TestRenderer(');
  writeFileSync(new URL('./page.mjs', import.meta.url), `${script}\nglobalThis.pageArms = arms;`);
  await import('./page.mjs');
  const places = [100, 900].map((time) => {
    frame(time);
    return globalThis.pageArms.map(({ hand, target }) => {
      const place = [...hand.matrixWorld.elements.slice(12, 15)];
      close(place, [...target], 1e-6);
      return place;
    });
  });
  assert.ok(shown.children.length > 1);
  for (const side of [0, 1]) assert.ok(Math.hypot(...places[0][side].map((x, n) => x - places[1][side][n])) > 0.1);
});
