// SPDX-License-Identifier: MIT
// The promise: spine, neck, head and eyes look at a target. Every argument counts, and the bits are those of C.
//   LOOKING: the build of tests/capi/looking.c, which prints a digest of the same bodies
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { defaultLook, Feature, Field, Flag } from 'swivel-wasm';
import { plus, refuses, swivel, times, turned, unit } from './common.mjs';

const bodyCount = 20, frameCount = 16, bodies = Array.from({ length: bodyCount }, (_, n) => n);
const [SPINE, NECK, HEAD, LEFT_EYE, RIGHT_EYE] = [1, 2, 3, 4, 5], [ARM, BODY, LEFT, RIGHT] = [0, 1, 2, 3];
const parents = [-1, 0, 1, 2, 3, 3, 1, 6, 7];
const translations = [[0, 0.875, 0], [0, 0.25, 0], [0, 0.375, 0], [0, 0.125, 0.0625], [0.03125, 0.125, 0.125], [-0.03125, 0.125, 0.125], [0.1875, 0.25, 0], [0.3125, 0, 0], [0.25, 0, 0]];
const rest = [[0, 0, 0, 1], [0, 0.125, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1], [0, -0.25, -0.25, 1], [0, -0.5, 0, 1], [0, 0, 0, 1]];
const theLook = { joints: [SPINE, NECK, HEAD], share: [1, 1, 2], cosMost: [0.96875, 0.875, 0.625], eye: [0, 0.125, 0.125], axis: [0, -0.125, 1], rate: 4 };
const theEye = { cosMost: 0.75, cosFull: 0.25, cosNone: -0.25, fadeDistance: 0.125, rate: 0 };
const at = (values, count, n) => [...values.slice(count * n, count * n + count)];

function lookers(look = theLook) {
  const groups = [{ joints: { shoulder: 6, elbow: 7, wrist: 8, bend: [0, 0, 1] }, features: Feature.POLE_INCOMING | Feature.WITH_HAND }, { look },
    { look: { ...theEye, joints: [LEFT_EYE] } }, { look: { ...theEye, joints: [RIGHT_EYE] } }];
  const crowd = swivel.bodies({ skeleton: { parents, translations: translations.flat() }, bodyCount, groups });
  crowd.pose('time').fill(0.015625);
  const [rotations, roots] = ['rotations', 'rootPosition'].map((part) => crowd.pose(part));
  const of = {
    crowd,
    ball: (n, frame) => [roots[3 * n] + 0.25 * (frame - 8), 1.5, 0.125 * (n - 4)],
    step(frame) {
      for (const n of bodies) rotations.set(rest.flat(), 36 * n), roots.set([0.25 * n, 0, 0.0078125 * frame], 3 * n);
      const balls = bodies.flatMap((n) => of.ball(n, frame));
      crowd.write(Field.TARGET, balls);
      for (const group of [BODY, LEFT, RIGHT]) crowd.write(Field.LOOK_TARGET, balls, { group });
      assert.equal(crowd.solve(), bodyCount);
      return of;
    },
    play() {
      for (let frame = 0; frame < frameCount; ++frame) of.step(frame);
      return of;
    },
    digest() {
      const digest = of.play().crowd.digest().toString(16).padStart(16, '0');
      crowd.dispose();
      return digest;
    },
    // Where a joint is in the world, and how it is turned.
    joint(n, joint) {
      if (joint < 0) return { place: at(roots, 3, n), rotation: [0, 0, 0, 1] };
      const above = of.joint(n, parents[joint]);
      return { place: plus(above.place, turned(above.rotation, translations[joint])), rotation: times(above.rotation, unit(at(rotations, 4, 9 * n + joint))) };
    },
  };
  return of;
}

test('the bits of C', () => {
  const said = execFileSync(process.env.LOOKING, { encoding: 'utf8' }).trim();
  assert.equal(lookers().digest(), said);
});

test('every argument counts', () => {
  const others = { share: 1, cosMost: 0.5, eye: [0, 0, 0], axis: [0, 0, 1], cosFull: 0.9, cosNone: -0.5, fadeDistance: 2, rate: 1 };
  assert.deepEqual(Object.keys(others), Object.keys(defaultLook));
  const digests = Object.entries(others).map(([name, other]) => lookers({ ...theLook, [name]: other }).digest());
  digests.push(lookers().digest(), lookers({ ...theLook, joints: [SPINE, HEAD], share: [1, 2], cosMost: [0.96875, 0.625] }).digest());
  assert.equal(new Set(digests).size, 10);
});

test('lines of sight meet the ball', () => {
  const of = lookers({ ...theLook, rate: 0 }).play();
  for (const [group, joint, eye, axis] of [[BODY, HEAD, theLook.eye, theLook.axis], [LEFT, LEFT_EYE, [0, 0, 0], [0, 0, 1]], [RIGHT, RIGHT_EYE, [0, 0, 0], [0, 0, 1]]]) {
    const sights = of.crowd.read(Field.SIGHT, { group }), flags = of.crowd.read(Field.FLAGS, { group });
    let meets = 0;
    for (const n of bodies) {
      const { place, rotation } = of.joint(n, joint), from = plus(place, turned(rotation, eye)), line = turned(rotation, unit(axis));
      at(sights, 6, n).forEach((x, c) => assert.ok(Math.abs(x - [...from, ...line][c]) < 3e-6));
      const to = of.ball(n, frameCount - 1).map((x, c) => x - from[c]), cosine = to.reduce((sum, x, c) => sum + x * line[c], 0) / Math.hypot(...to);
      if (flags[n] & Flag.REACHED) assert.ok(cosine > 1 - 1e-8), ++meets;
    }
    assert.ok(meets > 5, `group ${group} has ${meets}`);
  }
  assert.equal(of.crowd.features(BODY) & Feature.LOOK, Feature.LOOK);
  of.crowd.dispose();
});

test('what is wrong with a look is refused in one line', () => {
  refuses(() => lookers(1), 'look takes joints, share, cosMost, eye, axis, cosFull, cosNone, fadeDistance, rate, not 1');
  refuses(() => lookers({ ...theLook, cos_most: 1 }), 'not cos_most');
  refuses(() => lookers({}), 'look.joints is undefined; give numbers of joints');
  refuses(() => lookers({ joints: [-1] }), 'look.joints is -1; give a whole number');
  refuses(() => lookers({ joints: [] }), 'group 1, look.joint_count is 0; it is 1 to 8');
  refuses(() => lookers({ joints: Array(9).fill(HEAD) }), 'group 1, look.joint_count is 9; it is 1 to 8');
  refuses(() => lookers({ ...theLook, share: [1, 2] }), 'look.share has 2 numbers; give 3');
  refuses(() => lookers({ ...theLook, cosMost: '1' }), 'look.cosMost is "1"; give a number');
  refuses(() => lookers({ ...theLook, fadeDistance: null }), 'look.fadeDistance is null; give a number');
  refuses(() => lookers({ ...theLook, cosFull: -1 }), 'cos_full is 0.001 more');
  refuses(() => swivel.bodies({ skeleton: { parents: [-1], translations: [0, 0, 0] }, bodyCount: 1, groups: [{ look: { joints: [0] }, link: 0 }] }), 'a group that looks takes look, onBadInput, not link');
});
