// SPDX-License-Identifier: MIT
// The promise: poses of bodies go in and come out in swivel's own memory, in every form, by floats or by doubles.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag, PoseForm } from 'swivel-wasm';
import { close, plus, refuses, swivel, turned, unit } from './common.mjs';

// A body: hips, an arm with a joint in the upper arm, and a leg. Joints are turned at rest.
const random = (() => { let seed = 7; return () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5; })();
const some = (count, most) => Array.from({ length: count }, () => Math.fround(most * random()));
const parents = [-1, 0, 1, 2, 3, 0, 5, 6], translations = [0, 1, 0, 0.2, 0.4, 0, 0.1, 0, 0, 0.2, 0, 0, 0.26, 0, 0, -0.1, 0, 0, 0, -0.45, 0, 0, -0.4, 0];
const skeleton = { parents, translations, rotations: parents.flatMap(() => unit([...some(3, 0.2), 1])) };
const arm = { shoulder: 1, elbow: 3, wrist: 4, bend: [0, 0, 1] }, leg = { shoulder: 5, elbow: 6, wrist: 7, bend: [0, 0, -1] };
const limbs = [arm, leg], groups = limbs.map((joints) => ({ joints, features: Feature.POLE_INCOMING })), bodyCount = 35;
const at = (values, count, n) => [...values.slice(count * n, count * n + count)];
const eachBody = (act) => Array.from({ length: bodyCount }, (_, body) => act(body));
const bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];

// Poses in which elbow and knee are well bent, and roots.
const bent = { 3: [0, -1, 0, 1], 6: [1, 0, 0, 1] };
const poses = {
  rotations: eachBody(() => parents.flatMap((_, joint) => unit(plus(bent[joint] ?? [0, 0, 0, 1], some(4, 0.3))))).flat(),
  translations: eachBody(() => translations.map((x) => x + 0.1 * random())).flat(),
  scales: eachBody(() => parents.flatMap((_, joint) => new Array(3).fill(joint === 2 ? 1.25 : 1))).flat(),
  rootPosition: some(3 * bodyCount, 4), rootRotation: eachBody(() => unit(some(4, 1))).flat(), rootScale: some(bodyCount, 1).map((x) => 1 + x),
};
const give = (crowd, parts = poses) => Object.entries(parts).forEach(([part, values]) => crowd.pose(part).set(values));

// Own forward kinematics: each joint maps its own frame into its parent's.
const byRotations = ({ rotations }) => (body, joint, v) => {
  const n = body * parents.length + joint;
  return plus(at(poses.translations, 3, n), turned(unit(at(rotations, 4, n)), v.map((x) => x * poses.scales[3 * n])));
};
const wrist = (local, body, joint) => {
  let v = [0, 0, 0];
  for (; joint >= 0; joint = parents[joint]) v = local(body, joint, v);
  return plus(at(poses.rootPosition, 3, body), turned(at(poses.rootRotation, 4, body), v.map((x) => x * poses.rootScale[body])));
};
const asPosed = byRotations(poses);
// Every third body is left alone. Others move their wrists by a little.
const isLeft = (body) => body % 3 === 0;
const targets = limbs.map((joints) => eachBody((body) => plus(wrist(asPosed, body, joints.wrist), isLeft(body) ? [0, 0, 0] : some(3, 0.05))));

const elements = { ROTATIONS: 4, MATRIX_ROWS: 12, MATRIX_COLUMNS: 16, MATRIX_COLUMNS3: 12 };
const element = { MATRIX_ROWS: (row, column) => 4 * row + column, MATRIX_COLUMNS: (row, column) => 4 * column + row, MATRIX_COLUMNS3: (row, column) => 3 * column + row };
for (const [name, count] of Object.entries(elements))
  test(`wrists reach their targets, and goals left alone give poses back: ${name}`, () => {
    const form = PoseForm[name], crowd = swivel.bodies({ skeleton, bodyCount, groups, form }), rotations = crowd.pose('rotations');
    assert.equal(rotations.length, bodyCount * parents.length * count);
    const place = element[name], frame = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const local = !place ? byRotations({ rotations }) : (body, joint, v) => {
      const of = at(rotations, count, body * parents.length + joint);
      return [0, 1, 2].map((row) => of[place(row, 3)] + v.reduce((sum, x, column) => sum + of[place(row, column)] * x, 0));
    };
    // At rest first.
    const rest = (joint, v) => plus(at(translations, 3, joint), turned(at(skeleton.rotations, 4, joint), v));
    if (place) for (const v of frame) close(local(bodyCount - 1, 3, v), rest(3, v), 1e-6);
    else close(at(rotations, 4, 8 * bodyCount - 1), at(skeleton.rotations, 4, 7), 1e-6);

    if (!place) give(crowd);
    else {
      give(crowd, { rootPosition: poses.rootPosition, rootRotation: poses.rootRotation, rootScale: poses.rootScale });
      eachBody((body) => parents.forEach((_, joint) => {
        const [o, ...axes] = frame.map((v) => asPosed(body, joint, v));
        for (const row of [0, 1, 2])
          [...axes.map((axis) => axis[row] - o[row]), o[row]].forEach((x, column) => (rotations[count * (8 * body + joint) + place(row, column)] = x));
      }));
      for (const part of ['translations', 'scales']) refuses(() => crowd.pose(part), `the pose's matrices hold ${part}; give them there`);
    }
    const before = rotations.slice();
    limbs.forEach((_, group) => crowd.values(Field.TARGET, group).set(targets[group].flat()));
    assert.equal(crowd.solve(), bodyCount);
    limbs.forEach((joints, group) => eachBody((body) => {
      close(wrist(local, body, joints.wrist), targets[group][body], 4e-6);
      assert.equal(crowd.read(Field.FLAGS, { group })[body], Flag.REACHED);
    }));
    const ofBody = count * parents.length;
    eachBody((body) => (isLeft(body) ? close : assert.notDeepEqual)(at(rotations, ofBody, body), at(before, ofBody, body), 2e-5));

    crowd.dispose();
  });

test('a weight of 0 keeps the pose, and one of 1 changes nothing', () => {
  const solvedWith = (weight) => {
    const crowd = swivel.bodies({ skeleton, bodyCount, groups });
    give(crowd, poses);
    if (weight !== undefined) crowd.pose('weight').fill(weight);
    limbs.forEach((_, group) => crowd.values(Field.TARGET, group).set(targets[group].flat()));
    crowd.solve();
    const rotations = Array.from(crowd.pose('rotations'));
    crowd.dispose();
    return rotations;
  };
  const crowd = swivel.bodies({ skeleton, bodyCount, groups });
  give(crowd, poses);
  assert.deepEqual(solvedWith(0), Array.from(crowd.pose('rotations')));
  assert.deepEqual(solvedWith(1), solvedWith(undefined));
  assert.notDeepEqual(solvedWith(0.5), solvedWith(1));
  crowd.dispose();
});

test('roots in doubles: a body far away has the bits of one at the origin', () => {
  const solvedAt = (origin) => {
    const crowd = swivel.bodies({ skeleton, bodyCount, groups, rootIsDouble: true });
    give(crowd, { ...poses, rootPosition: eachBody(() => origin).flat() });
    limbs.forEach((_, group) => {
      const view = crowd.positions(Field.TARGET, group);
      assert.ok(view instanceof Float64Array && view.every(Number.isNaN) && crowd.positions(Field.TARGET, group) === view);
      eachBody((body) => view.set(plus(origin, targets[group][body].map((x, n) => Math.round((x - poses.rootPosition[3 * body + n]) * 2 ** 20) / 2 ** 20)), 3 * body));
    });
    assert.ok(crowd.pose('rootPosition') instanceof Float64Array);
    assert.equal(crowd.solve({ groups: [1] }) + crowd.solve({ groups: [0] }), 2 * bodyCount);
    refuses(() => crowd.values(Field.TARGET), 'TARGET is in doubles, as the root is; positions() gives it');
    refuses(() => crowd.positions(Field.FLAGS), 'FLAGS is no position; values() gives it');
    refuses(() => crowd.positions(Field.POLE), 'pole');
    const rotations = crowd.pose('rotations').slice();
    crowd.dispose();
    return rotations;
  };
  const near = solvedAt([0, 0, 0]);
  assert.deepEqual(bitsOf(solvedAt([2 ** 24, -(2 ** 23), 2 ** 22])), bitsOf(near));
  const crowd = swivel.bodies({ skeleton, bodyCount, groups });
  give(crowd);
  limbs.forEach((_, group) => crowd.positions(Field.TARGET, group).set(targets[group].flat()));
  assert.equal(crowd.positions(Field.TARGET), crowd.values(Field.TARGET));
  crowd.solve();
  close([...crowd.pose('rotations')], [...near], 1e-5);
  crowd.dispose();
});

test('parts start at rest', () => {
  const [little, all] = [[], Object.keys(poses)].map((parts) => {
    const crowd = swivel.bodies({ skeleton, bodyCount, groups });
    for (const part of parts) crowd.pose(part);
    limbs.forEach((_, group) => crowd.write(Field.TARGET, [0.5, 0.7, 0.3], { group })), crowd.solve();
    const rotations = bitsOf(crowd.pose('rotations'));
    crowd.dispose();
    return rotations;
  });
  assert.deepEqual(all, little);
});

test('some bodies, some groups, and results elsewhere', () => {
  const crowd = swivel.bodies({ skeleton, bodyCount, groups: [{ ...groups[0], features: Feature.POLE_INCOMING | Feature.WITH_HAND }, { joints: leg }], features: Feature.POLE_INCOMING });
  assert.deepEqual([0, 1].map((group) => crowd.features(group) & (Feature.BODY | Feature.WITH_HAND)), [Feature.BODY | Feature.WITH_HAND, Feature.BODY]);
  assert.deepEqual([crowd.limbCount(1), crowd.firstLimb(1), crowd.blockCount], [bodyCount, 0, 3]);
  give(crowd);
  const rotations = crowd.pose('rotations'), results = crowd.pose('results'), before = rotations.slice(), rest = results.slice();
  limbs.forEach((_, group) => crowd.write(Field.TARGET, targets[group].flat(), { group }));
  crowd.write(Field.TARGET, [NaN, 0, 0], { first: 20, count: 1 });
  const turnedJoints = () => [...new Set([...results].flatMap((x, n) => (x === rest[n] ? [] : [`${n >> 5}:${(n >> 2) & 7}`])))];
  assert.equal(crowd.solve({ limbs: [2], groups: [0] }), 1);
  assert.deepEqual(turnedJoints(), ['2:1', '2:3', '2:4']);
  assert.equal(crowd.solve({ mask: [0, 4] }), 1);
  assert.deepEqual(turnedJoints().slice(3), ['34:1', '34:3', '34:4', '34:5', '34:6']);
  assert.equal(crowd.solve({ priorities: [[...new Array(16).fill(0), 1, ...new Array(18).fill(0)]], mostBlocks: 1 }), 16);
  assert.deepEqual(bitsOf(rotations), bitsOf(before));
  assert.deepEqual(crowd.find(Flag.BAD_INPUT), { group: 0, limb: 20 });
  assert.deepEqual(at(results, 4, 8 * 20 + 1), at(before, 4, 8 * 20 + 1));  // it keeps its incoming pose
  refuses(() => crowd.solve({ priorities: [[1], [1]], mostBlocks: 1 }), '2 priorities for bodies; give one list');
  crowd.dispose();
});

test('what is wrong with bodies is refused in one line', () => {
  const bodies = (given) => swivel.bodies({ skeleton, bodyCount, groups, ...given });
  refuses(() => bodies({ features: 1 }), 'features is 1; give a BigInt');
  refuses(() => bodies({ joints: 1 }), 'bodies() takes skeleton, bodyCount, groups, features, form, space, rootIsDouble, up, not joints');
  refuses(() => bodies({ form: 4 }), 'form is 4; give one of PoseForm');
  refuses(() => bodies({ space: 2 }), 'space is 2; give one of PoseSpace');
  refuses(() => bodies({ bodyCount: 1.5 }), 'bodyCount is 1.5');
  refuses(() => bodies({ bodyCount: 0 }), 'no bodies; give at least one');
  refuses(() => bodies({ groups: 8 }), 'groups is 8; give a list, such as [{ joints: ');
  refuses(() => bodies({ groups: [{ limbCount: 3 }] }), 'a group of bodies takes joints, features, shoulderOrder, wristOrder, onBadInput, plant, ground, link, region, not limbCount');
  refuses(() => bodies({ groups: [{}] }), "a limb's joints takes shoulder");
  refuses(() => bodies({ groups: [{ joints: { ...arm, wrist: 9 } }] }), 'group 0: ');
  refuses(() => bodies({ groups: [{ joints: arm }, { joints: { ...arm, shoulder: 2 } }] }), "a body's limbs hang beside each other");
  refuses(() => bodies({ skeleton: undefined }), 'a skeleton takes parents');
  refuses(() => bodies({ skeleton: { ...skeleton, translations: [0] } }), 'translations has 1 numbers; give 24');
  refuses(() => swivel.crowd([{ limbCount: 1, joints: arm }]), 'not joints');
  const crowd = bodies();
  refuses(() => crowd.pose('rotation'), 'poses have rotations, translations, scales, results, translationResults, jointRotations, jointPlaces, rootPosition, rootRotation, rootScale, time, supportPosition, supportRotation, weight, not "rotation"');
  refuses(() => crowd.pose('translationResults'), "only translations in the body's space change");
  crowd.dispose();
  for (const call of [() => crowd.pose('rotations'), () => crowd.pose('scales'), () => crowd.solve()]) refuses(call, 'this crowd is disposed of');
  // 2^32 bytes of rotations
  const chain = Array.from({ length: 1024 }, (_, n) => n - 1);
  refuses(() => bodies({ skeleton: { parents: chain, translations: chain.flatMap(() => [1, 0, 0]) }, bodyCount: 2 ** 18, groups: [groups[0]] }), 'give load() more megabytes');
});

test('a pose is compared with where an engine has a limb', () => {
  const crowd = swivel.bodies({ skeleton, bodyCount, groups });
  give(crowd);
  const places = (factor = 1) => Object.fromEntries(['shoulder', 'elbow', 'wrist'].map((name) => [name, wrist(asPosed, 4, leg[name]).map((x) => factor * x)]));
  const right = crowd.compare(4, places(), 1);
  assert.ok(right.agrees, right.text), assert.match(right.text, /^The pose agrees/);
  const far = crowd.compare(4, places(100), 1);
  assert.ok(!far.agrees), assert.match(far.text, /centimetres instead of metres/);
  const rotations = crowd.pose('rotations');
  for (let n = 0; n < rotations.length; n += 4) rotations.set([rotations[n + 3], ...rotations.slice(n, n + 3)], n);
  assert.match(crowd.compare(4, places(), 1).text, /^The pose's joint rotations are stored as w, x, y, z/);
  refuses(() => crowd.compare(bodyCount, places()), `body is ${bodyCount}; give a whole number from 0 to ${bodyCount - 1}`);
  refuses(() => crowd.compare(0, { shoulder: [0, 0, 0], elbow: [0, 0, 0], wrist: [0, 0] }), 'wrist');
});
