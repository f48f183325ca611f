// SPDX-License-Identifier: MIT
// The promise: two hands hold a prop, a hand holds a hand, and feet stand on slopes. Every argument counts, and the bits are those of C.
//   HOLDING: the build of tests/capi/holding.c, which prints digests of the same bodies
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { defaultGround, defaultProp, Feature, Field, Flag } from 'swivel-wasm';
import { close, plus, refuses, swivel, times, turned, unit } from './common.mjs';

const bodyCount = 20, frameCount = 16, bodies = Array.from({ length: bodyCount }, (_, n) => n);
const [HIPS, CHEST, LEFT_HAND, RIGHT_HAND, FOOT] = [0, 1, 4, 7, 10], [LEG, LEFT, RIGHT, RIFLE] = [0, 1, 2, 3];
const parents = [-1, 0, 1, 2, 3, 1, 5, 6, 0, 8, 9];
const translations = [[0, 0.921875, 0], [0, 0.5, 0], [0.1875, 0, 0], [0.3125, 0, 0], [0.25, 0, 0], [-0.1875, 0, 0], [-0.3125, 0, 0], [-0.25, 0, 0], [0.125, 0, 0], [0, -0.4375, 0], [0, -0.4375, 0]];
const rest = [[0, 0, 0, 1], [0, 0, 0, 1], [0, -0.25, -0.25, 1], [0, -0.5, 0, 1], [0, 0, 0, 1], [0, 0.25, 0.25, 1], [0, 0.5, 0, 1], [0, 0, 0, 1], [-0.125, 0, 0, 1], [0.25, 0, 0, 1], [-0.125, 0, 0, 1]];
const limb = (shoulder, bend) => ({ shoulder, elbow: shoulder + 1, wrist: shoulder + 2, bend: [0, 0, bend] });
const toe = [0, -0.0625, 0.125], leftGrip = [0.125, 0, 0.0625, 0, 0, 0.25, 1], rightGrip = [-0.125, 0, 0, 0.125, 0, 0, 1], clasp = [0.03125, -0.0625, 0, 0, 0.5, 0, 1];
const theGround = { heel: [0, -0.0625, -0.0625], toeClearance: 0.015625, heelClearance: 0.03125, cosMost: 0.96875, half: 0.125 }, theProp = { joint: CHEST, mostMove: 0.03125 };
const arm = Feature.POLE_INCOMING | Feature.WITH_HAND, at = (values, count, n) => [...values.slice(count * n, count * n + count)];
const apart = (a, b) => Math.hypot(...a.map((x, n) => x - b[n])), alike = (a, b) => Math.min(apart(a, b), apart(a, b.map((x) => -x)));
const bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];

// A plane for each body, through the place from which its root starts.
const ahead = (n) => 0.25 * ((n % 3) - 1), height = (n, [x, , z]) => ahead(n) * z + 0.125 * (x - 0.25 * n), normal = (n) => [-0.125, 1, -ahead(n)];

// Bodies that hold a rifle, or with no prop each their right hand by the left, and stand on a leg.
function holders({ prop = theProp, ground = theGround, link = prop ? RIFLE : LEFT, rootIsDouble } = {}) {
  const groups = [
    { joints: limb(8, -1), features: arm | Feature.WITH_EFFECTOR | Feature.WITH_PLANT | Feature.WITH_GROUND, ground },
    { joints: limb(2, 1), features: arm | (prop ? Feature.WITH_LINK : 0n), link }, { joints: limb(5, 1), features: arm | Feature.WITH_LINK, link }, ...(prop ? [{ prop }] : [])];
  const crowd = swivel.bodies({ skeleton: { parents, translations: translations.flat() }, bodyCount, groups, rootIsDouble });
  crowd.write(Field.EFFECTOR, toe), crowd.write(Field.GRIP, prop ? rightGrip : clasp, { group: RIGHT });
  if (prop) crowd.write(Field.GRIP, leftGrip, { group: LEFT });
  const goals = bodies.map((n) => (prop ? [0, -0.0625, 0.3125 + 0.015625 * n] : [0.25 * n, 1.375, 0.3125 + 0.015625 * n]));
  crowd.write(prop ? Field.PROP_PLACE : Field.TARGET, goals.flat(), { group: prop ? RIFLE : LEFT });
  crowd.pose('time').fill(0.015625);
  const [rotations, roots] = ['rotations', 'rootPosition'].map((part) => crowd.pose(part));
  const of = {
    crowd, rotations, goals,
    pose(frame) {
      for (const n of bodies) {
        rotations.set(rest.flat(), 44 * n), rotations[44 * n + 4 * CHEST + 1] = 0.125 * (n % 3);
        roots.set([0.25 * n, 0, 0.0078125 * frame], 3 * n);
      }
      crowd.write(Field.CONTACT, [Number(frame >= 2)]);
    },
    step(frame, asks = true) {
      of.pose(frame);
      if (asks) assert.equal(crowd.solve({ probesOnly: true }), bodyCount);
      const probes = crowd.read(Field.PROBE), points = bodies.map((n) => at(probes, 3, n));
      crowd.write(Field.GROUND, points.flatMap((p, n) => [p[0], height(n, p), p[2]])), crowd.write(Field.GROUND_NORMAL, bodies.flatMap(normal));
      assert.equal(crowd.solve(), bodyCount);
      assert.equal(crowd.find(Flag.BAD_INPUT), undefined);
    },
    play(asks) {
      for (let frame = 0; frame < frameCount; ++frame) of.step(frame, asks);
      of.flags = Array.from({ length: crowd.groupCount }, (_, group) => crowd.read(Field.FLAGS, { group }));
      return of;
    },
    digest(asks) {
      const digest = of.play(asks).crowd.digest().toString(16).padStart(16, '0');
      crowd.dispose();
      return digest;
    },
    // Where a joint is in the world, and how it is turned.
    joint(n, joint) {
      if (joint < 0) return { place: at(roots, 3, n), rotation: [0, 0, 0, 1] };
      const above = of.joint(n, parents[joint]);
      return { place: plus(above.place, turned(above.rotation, translations[joint])), rotation: times(above.rotation, unit(at(rotations, 4, 11 * n + joint))) };
    },
  };
  return of;
}
// Where a hand is that has a grip on something.
const held = ({ place, rotation }, grip) => ({ place: plus(place, turned(rotation, grip.slice(0, 3))), rotation: times(rotation, unit(grip.slice(3))) });
const frameOf = (values, n) => ({ place: at(values, 7, n).slice(0, 3), rotation: at(values, 7, n).slice(3) });
function checkHand(hand, wanted) {
  assert.ok(apart(hand.place, wanted.place) < 3e-6 && alike(hand.rotation, wanted.rotation) < 3e-6, `${JSON.stringify(hand)} is not ${JSON.stringify(wanted)}`);
}

test('the bits of C', () => {
  const said = execFileSync(process.env.HOLDING, { encoding: 'utf8' }).trim().split('\n');
  assert.deepEqual([holders().digest(), holders({ prop: null }).digest()], said);
});

test('every argument counts', () => {
  const changed = { ...defaultGround, heel: [0, -0.0625, -0.125] };  // a heel at the wrist touches nothing, as one without clearance
  const digests = Object.keys(theGround).map((name) => holders({ ground: { ...theGround, [name]: changed[name] } }).digest());
  digests.push(holders({ prop: { ...theProp, joint: HIPS } }).digest(), holders({ prop: { ...theProp, mostMove: defaultProp.mostMove } }).digest());
  digests.push(holders().digest(false), holders().digest(), holders({ prop: null }).digest(), holders({ prop: null, link: LEG }).digest());
  assert.equal(new Set(digests).size, 11);
});

test('a prop in two hands, which both reach it where it moves no further than it may', () => {
  const of = holders().play(), frames = of.crowd.values(Field.PROP_FRAME, RIFLE), most = 0.03125 * 0.5625;
  let reached = 0, moved = 0;
  for (const n of bodies) {
    const rifle = frameOf(frames, n), goal = held(of.joint(n, CHEST), [...of.goals[n], 0, 0, 0, 1]), move = apart(rifle.place, goal.place);
    assert.ok(move < most + 1e-6 && alike(rifle.rotation, goal.rotation) < 1e-6);
    if (of.flags[RIFLE][n] !== Flag.REACHED) {
      assert.equal(of.flags[RIFLE][n], Flag.CLAMPED_FAR), close([move], [most], 1e-6);
      continue;
    }
    checkHand(of.joint(n, LEFT_HAND), held(rifle, leftGrip)), checkHand(of.joint(n, RIGHT_HAND), held(rifle, rightGrip));
    assert.ok(of.flags[LEFT][n] & of.flags[RIGHT][n] & Flag.REACHED);
    ++reached, moved += Number(move > 1e-3);
  }
  assert.ok(reached > 5 && reached < 18 && moved > 0, `${reached} ${moved}`);
  of.crowd.dispose();
});

test('a hand holds a hand', () => {
  const of = holders({ prop: null }).play(), frames = of.crowd.read(Field.HAND_FRAME, { group: LEFT });
  let reached = 0;
  for (const n of bodies) {
    checkHand(frameOf(frames, n), of.joint(n, LEFT_HAND));
    if (!(of.flags[RIGHT][n] & Flag.REACHED)) continue;
    checkHand(of.joint(n, RIGHT_HAND), held(of.joint(n, LEFT_HAND), clasp)), ++reached;
  }
  assert.ok(reached > 10, reached);
  assert.equal(of.crowd.features(LEFT) & Feature.WITH_HAND_FRAME, Feature.WITH_HAND_FRAME);
  of.crowd.dispose();
});

test('a foot on a slope by two calls', () => {
  const of = holders().play();
  for (const n of bodies) {
    const foot = of.joint(n, FOOT), across = Math.hypot(...normal(n));
    const over = (point) => { const p = plus(foot.place, turned(foot.rotation, point)); return (p[1] - height(n, p)) / across; };
    assert.equal(of.flags[LEG][n] & (Flag.PLANTED | Flag.REACHED), Flag.PLANTED | Flag.REACHED);
    close([over(toe)], [theGround.toeClearance], 3e-6);
    assert.ok(over(theGround.heel) > theGround.heelClearance - 3e-6);
  }
  of.crowd.dispose();
});

test('probesOnly finds probes and changes nothing else, in views too', () => {
  const of = holders(), { crowd, rotations } = of;
  for (const frame of [0, 1, 2]) of.step(frame);
  of.pose(3);
  const fields = Object.values(Field).filter((field) => crowd.componentCount(field) > 0), views = fields.map((field) => crowd.values(field));
  const before = views.map(bitsOf), posed = bitsOf(rotations);
  assert.equal(crowd.solve({ probesOnly: true, groups: [LEG] }), bodyCount);
  assert.deepEqual(fields.filter((_, n) => bitsOf(views[n]).some((bits, k) => bits !== before[n][k])), [Field.PROBE]);
  assert.deepEqual(bitsOf(rotations), posed);
  assert.deepEqual(crowd.values(Field.PROBE), crowd.read(Field.PROBE));
  crowd.dispose();
});

test('with roots in doubles, places of ground are doubles, and those of a prop on a joint are the joint\'s', () => {
  const digests = [0, 2 ** 33].map((far) => {
    const { crowd, pose } = holders({ rootIsDouble: true }), [root, support] = ['rootPosition', 'supportPosition'].map((part) => crowd.pose(part));
    const ground = crowd.positions(Field.GROUND), place = crowd.positions(Field.PROP_PLACE, RIFLE);
    assert.ok(ground instanceof Float64Array && place instanceof Float64Array);
    pose(0);
    for (const n of bodies) {
      root.set([0.25 * n + far, 0, -far], 3 * n), support.set([0.25 * n + far, 0, -far], 3 * n);
      ground.set([0.25 * n + far, 0.0625, -far], 3 * n), place.set([0, -0.0625, 0.3125], 3 * n);
    }
    assert.equal(crowd.solve(), bodyCount);
    assert.ok(crowd.read(Field.FLAGS, { group: RIFLE }).every((flags) => flags === Flag.REACHED));
    const digest = crowd.digest();
    crowd.dispose();
    return digest;
  });
  assert.equal(digests[0], digests[1]);
});

test('what is wrong with what hands hold is refused in one line', () => {
  refuses(() => holders({ ground: 0.1 }), 'ground takes heel, toeClearance, heelClearance, cosMost, half, not 0.1');
  refuses(() => holders({ ground: { toe_clearance: 1 } }), 'not toe_clearance');
  refuses(() => holders({ ground: { half: '1' } }), 'ground.half is "1"; give a number');
  refuses(() => holders({ ground: { heel: [1] } }), 'ground.heel has 1 numbers; give 3');
  refuses(() => holders({ ground: { cosMost: 2 } }), 'group 0, ground.cos_most is 2; it is 0 to 1');
  refuses(() => holders({ prop: { wrist: 1 } }), 'prop takes joint, mostMove, not wrist');
  refuses(() => holders({ prop: { joint: 1.5 } }), 'prop.joint is 1.5; give the number of a joint, or -1');
  refuses(() => holders({ prop: { joint: 11 } }), "group 3, prop.joint is 11; it is -1, or one of the skeleton's 11 joints");
  refuses(() => holders({ prop: { joint: -2 } }), 'group 3, prop.joint is -2');
  refuses(() => holders({ link: 9 }), 'group 1 is linked to group 9, which does not exist; there are 4');
  refuses(() => holders({ link: -1 }), 'link is -1; give a whole number');
  refuses(() => holders({ link: LEG }), 'group 3 is SWIVEL_PROP, and 0 limbs are linked to it');
  refuses(() => swivel.bodies({ skeleton: { parents: [-1], translations: [0, 0, 0] }, bodyCount: 1, groups: [{ prop: {}, link: 0 }] }), "a prop's group takes prop, onBadInput, not link");
  const { crowd } = holders();
  refuses(() => crowd.solve({ groups: [LEFT, RIGHT] }), 'name both');
  refuses(() => crowd.solve({ groups: [LEFT, RIGHT, RIFLE], probesOnly: true }), 'names no group that is SWIVEL_WITH_GROUND');
  refuses(() => crowd.solve({ sample: () => undefined }), 'not sample');
  assert.deepEqual([crowd.features(RIFLE) & Feature.PROP, crowd.componentCount(Field.PROP_FRAME, RIFLE), crowd.componentCount(Field.TARGET, RIFLE)], [Feature.PROP, 7, 0]);
  crowd.dispose();
});
