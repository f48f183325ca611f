// SPDX-License-Identifier: MIT
// The promise: feet stand on their supports while they are labelled, whatever axis is up. What is carried can be saved and set back, and
// supports change without a jump.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { defaultPlant, Feature, Field, Flag } from 'swivel-wasm';
import { close, plus, refuses, swivel, times, turned, unit } from './common.mjs';

const bodyCount = 20, second = 60, wish = -0.12, [, THIGH, SHIN, FOOT] = [0, 1, 2, 3];  // frames; of the shift: knees well bent
const features = Feature.POLE_INCOMING | Feature.WITH_PLANT | Feature.WITH_FIT, bodies = Array.from({ length: bodyCount }, (_, n) => n);
const back = ([x, y, z, w]) => [-x, -y, -z, w], at = (values, count, n) => [...values.slice(count * n, count * n + count)];
const about = (axis, angle) => [...axis.map((x) => x * Math.sin(angle / 2)), Math.cos(angle / 2)];
const apart = (a, b) => Math.hypot(...a.map((x, n) => x - b[n])), bitsOf = (values) => [...new Uint32Array(values.buffer, values.byteOffset, values.length)];
const bound = 3e-6 * 0.87 + 1.2e-6;  // of a solve of a leg, and of the rounding of places 20 m from the origin
const ground = bodies.map(() => ({ place: [0, 0, 0], rotation: [0, 0, 0, 1] }));

// Legs that walk in place, those of odd bodies on platforms that drift and turn. turn: from a world with +y up.
function walkers({ turn = [0, 0, 0, 1], up, plant, rootIsDouble, more = 0n } = {}) {
  const far = rootIsDouble ? [2 ** 33, -(2 ** 32), 2 ** 30] : [0, 0, 0];
  const places = [[0, 0, 0], [0.1, 0, 0], [0, -0.45, 0], [0, -0.42, 0]].map((v) => turned(turn, v)), turning = (q) => times(times(turn, q), back(turn));
  const joints = { shoulder: THIGH, elbow: SHIN, wrist: FOOT, bend: turned(turn, [0, 0, -1]) }, fit = { drop: 0.3, half: 0.05 };
  const crowd = swivel.bodies({ skeleton: { parents: [-1, 0, 1, 2], translations: places.flat() }, bodyCount, rootIsDouble, features: features | more,
    groups: [{ joints, ...(plant && { plant }) }, { fit }], ...(up && { up }) });
  crowd.write(Field.SHIFT_WISH, [wish], { group: 1 });
  crowd.pose('time').fill(1 / second);
  const [rotations, root, support, supportTurn] = ['rotations', 'rootPosition', 'supportPosition', 'supportRotation'].map((part) => crowd.pose(part));
  const phase = (frame, n) => 2 * Math.PI * (frame / second + 0.07 * n);
  const of = {
    crowd, rotations,
    supports: (frame) => bodies.map((n) => {
      const t = ((n % 2) * frame) / second;
      return { place: turned(turn, [n + 0.05 * t, 0.01 * t, 0]), rotation: turning(about([0, 1, 0], 0.05 * t)) };
    }),
    solve(frame, supports = of.supports(frame)) {
      for (const n of bodies) {
        const p = phase(frame, n), lift = Math.max(0, Math.cos(p)), bend = 0.2 + 0.6 * lift * lift;
        rotations.set([[0, 0, 0, 1], turning(about([1, 0, 0], -0.1 * Math.sin(p) - bend / 2)), turning(about([1, 0, 0], bend)), [0, 0, 0, 1]].flat(), 16 * n);
        root.set(plus(far, turned(turn, [n, 0.86 + 0.008 * Math.sin(2 * p), 0])), 3 * n);
        support.set(plus(far, supports[n].place), 3 * n), supportTurn.set(supports[n].rotation, 4 * n);
      }
      if (crowd.componentCount(Field.CONTACT)) crowd.write(Field.CONTACT, bodies.map((n) => Number(Math.cos(phase(frame, n)) < 0)));
      assert.equal(crowd.solve(), bodyCount);
      assert.equal(crowd.find(Flag.BAD_INPUT), undefined);
      of.plant = crowd.read(Field.PLANT), of.flags = crowd.read(Field.FLAGS), of.shift = crowd.read(Field.SHIFT, { group: 1 });
    },
    // Planted, with nothing left that fades.
    stands: (n) => Boolean(of.flags[n] & Flag.PLANTED) && of.plant[11 * n + 9] === 0,
    // In the world, from solved poses and the shifts of their roots.
    foot(n) {
      const at0 = plus([...root.slice(3 * n, 3 * n + 3)].map((x, c) => x - far[c]), turned(turn, [0, of.shift[3 * n], 0]));
      const [thigh, shin] = [THIGH, SHIN].map((joint) => unit(at(rotations, 4, 4 * n + joint)));
      const shank = plus(places[SHIN], turned(shin, places[FOOT]));
      return plus(at0, plus(places[THIGH], turned(thigh, shank)));
    },
    state: () => [crowd.read(Field.PLANT), crowd.read(Field.SHIFT, { group: 1 })],
    set: ([plant, shift]) => { crowd.write(Field.PLANT, plant), crowd.write(Field.SHIFT, shift, { group: 1 }); },
  };
  return of;
}

for (const [name, options] of Object.entries({
  'labels': {}, 'another axis up': { turn: unit([1, 0, 0, 1]), up: [0, 0, 2] }, 'roots in doubles': { rootIsDouble: true },
  'motion, without labels': { more: Feature.PLANT_BY_MOTION, plant: { speed: [0.8, 1], height: [-0.985, -0.97] } },
}))
  test(`a planted foot does not move on its support: ${name}`, () => {
    const walk = walkers(options), stood = [];
    let standing = 0, released = 0;
    for (let frame = 0; frame < 120; ++frame) {
      walk.solve(frame);
      const supports = walk.supports(frame);
      for (const n of bodies) {
        released += Number(Boolean(walk.flags[n] & Flag.RELEASED));
        assert.ok(walk.shift[3 * n] < 0.9 * wish);
        if (!walk.stands(n)) { stood[n] = undefined; continue; }
        const foot = turned(back(supports[n].rotation), plus(walk.foot(n), supports[n].place.map((x) => -x)));
        stood[n] ??= foot, ++standing;
        assert.ok(apart(foot, stood[n]) < bound, `body ${n} by ${apart(foot, stood[n])}`);
        assert.ok(walk.flags[n] & Flag.REACHED);
      }
    }
    assert.ok(standing > 600 && released > 20, `${standing} ${released}`);
    walk.crowd.dispose();
  });

test('what is carried can be saved and set back, in the same crowd or another', () => {
  const walk = walkers(), poses = [];
  for (let frame = 0; frame < 50; ++frame) walk.solve(frame);
  const saved = walk.state();
  for (let frame = 50; frame < 80; ++frame) walk.solve(frame), poses.push(bitsOf(walk.rotations));
  const end = walk.state().map(bitsOf), viewed = walkers(), view = viewed.crowd.values(Field.PLANT);
  for (const [each, isSet] of [[walk, true], [viewed, true], [walkers(), false]]) {
    if (isSet) each.set(saved);
    if (each === viewed) assert.deepEqual(view, saved[0]);
    const same = [];
    for (let frame = 50; frame < 80; ++frame) each.solve(frame), same.push(bitsOf(each.rotations).every((x, n) => x === poses[frame - 50][n]));
    assert.equal(same.every(Boolean), isSet);
    (isSet ? assert.deepEqual : assert.notDeepEqual)(each.state().map(bitsOf), end);
  }
  viewed.crowd.reset({ first: 3, count: 2 });
  assert.deepEqual(bodies.filter((n) => view[11 * n + 10] === 0), [3, 4]);
});

test('a changed support moves no foot', () => {
  const walk = walkers(), changed = walkers(), some = [4, 5, 6], view = changed.crowd.values(Field.PLANT);
  const other = ground.map((support, n) => (some.includes(n) ? { place: [n, 0.25, -2], rotation: [0.5, 0.3, 0.2 * n, 0.7].map(Math.fround) } : support));
  let standing = 0;
  for (let frame = 0; frame < 85; ++frame) {
    if (frame === 66) {
      const before = view.slice();
      changed.crowd.changeSupport({}, { position: some.flatMap((n) => other[n].place), rotation: some.flatMap((n) => other[n].rotation) }, { first: 4, count: 3 });
      assert.deepEqual(bodies.filter((n) => at(view, 11, n).some((x, c) => x !== before[11 * n + c])), some);
    }
    walk.solve(frame, ground), changed.solve(frame, frame < 66 ? ground : other);
    for (const n of bodies) {
      const isChanged = frame >= 66 && some.includes(n);
      assert.ok(apart(walk.foot(n), changed.foot(n)) <= (isChanged ? 2e-6 : 0));
      standing += Number(isChanged && changed.stands(n));
    }
  }
  assert.ok(standing > 30, standing);
  changed.crowd.changeSupport({ position: [1, 2, 3], rotation: [0, 0, 0, 2] }, { position: [1, 2, 3] });  // one for all
  close([...view], [...changed.plant], 0);
});

test('what is wrong with feet is refused in one line', () => {
  const leg = { joints: { shoulder: THIGH, elbow: SHIN, wrist: FOOT, bend: [0, 0, -1] }, features };
  const make = (groups, options = {}) => swivel.bodies({ skeleton: { parents: [-1, 0, 1, 2], translations: [0, 0, 0, 0.1, 0, 0, 0, -0.45, 0, 0, -0.42, 0] }, bodyCount: 1, groups, ...options });
  const withPlant = (plant) => [{ ...leg, plant }, { fit: {} }];
  refuses(() => make(withPlant(0.1)), 'plant takes lock, unlock, stop, blend, again, run, longest, speed, height, not 0.1');
  refuses(() => make(withPlant({ look: 1 })), 'not look');
  refuses(() => make(withPlant({ lock: '1' })), 'plant.lock is "1"; give a number');
  refuses(() => make(withPlant({ speed: [1] })), 'plant.speed has 1 numbers; give 2');
  refuses(() => make(withPlant({ run: 2 })), 'group 0, plant.run is 2; it is 0 to 1');
  refuses(() => make([leg, { fit: { half: -1 } }]), 'group 1, fit.half is -1; it is 0 to 1000');
  refuses(() => make([leg, { fit: {}, joints: leg.joints }]), 'a group of shifts takes fit, onBadInput, not joints');
  refuses(() => make([leg, { fit: {} }, { fit: {} }]), 'a body has one shift');
  refuses(() => make([leg]), 'no group is SWIVEL_FIT; add one');
  refuses(() => make([leg, { fit: {} }], { up: [0, 1] }), 'up has 2 numbers; give 3');
  refuses(() => make([leg, { fit: {} }], { up: [0, 0, 0] }), 'up is 0, 0, 0; give an axis');
  const crowd = make([leg, { fit: {} }]);
  refuses(() => crowd.solve(), 'the pose has no time');
  refuses(() => crowd.changeSupport({}, { place: [0, 0, 0] }), 'now takes position, rotation, not place');
  refuses(() => crowd.changeSupport({ position: [1, 2] }, {}), '2 numbers for was.position of 1 bodies; give 3, or 3 for each body');
  refuses(() => crowd.changeSupport({}, {}, { group: 1 }), 'group 1 does not plant');
  refuses(() => crowd.write(Field.GOAL, [0]), 'goal');
  assert.deepEqual([crowd.features(1) & Feature.FIT, crowd.componentCount(Field.SHIFT, 1), crowd.componentCount(Field.TARGET, 1)], [Feature.FIT, 3, 0]);
  crowd.dispose();
});

test('a plant of its own: the longest time that is left to a point is the one that it says', () => {
  for (const [plant, most] of [[undefined, 0.2 - 1 / second], [defaultPlant, 0.2 - 1 / second], [{ stop: 0.35 }, 0.35], [{ blend: 0.45 }, 0.45 - 1 / second]]) {
    const walk = walkers({ plant });
    let left = 0;
    for (let frame = 0; frame < 60; ++frame) walk.solve(frame), left = Math.max(left, ...bodies.map((n) => walk.plant[11 * n + 9]));
    close([left], [most], 1e-6);
    walk.crowd.dispose();
  }
});
