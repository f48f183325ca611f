// SPDX-License-Identifier: MIT
// The promise: a region is what its cones and polygons say, and groups keep it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feature, Field, Flag } from 'swivel-wasm';
import { refuses, swivel, turned, unit } from './common.mjs';

const dot = (a, b) => a.reduce((sum, x, n) => sum + x * b[n], 0);
// Directions spread evenly over the sphere.
const directions = Array.from({ length: 2000 }, (_, n) => {
  const z = 1 - (2 * n + 1) / 2000, across = Math.sqrt(1 - z * z), turn = n * Math.PI * (3 - Math.sqrt(5));
  return [across * Math.cos(turn), across * Math.sin(turn), z];
});
const inCone = (direction, { axis, angle }) => dot(direction, unit(axis)) >= Math.cos(angle);
const cones = [{ axis: [0, 0, 2], angle: 0.5 }, { axis: [1, 0, 0.5], angle: 0.4 }, { axis: [1, 1, -1], angle: 0.6 }];
const count = (region) => directions.filter((direction) => region.room(direction) >= 0).length;

test('cones, bridges, forbidden cones and mirrors', () => {
  const region = swivel.region().addCones(cones), out = { axis: [0, 0, 1], angle: 0.3 };
  for (const direction of directions) if (cones.some((cone) => inCone(direction, cone))) assert.ok(region.room(direction) > -1e-6);
  assert.ok(region.room([0.5, 0, 0.75]) > 0);  // between the first two
  assert.ok(count(swivel.region().addCones(cones, true)) > count(region));
  const before = count(region);
  region.forbid(out);
  assert.ok(count(region) < before);
  for (const direction of directions) {
    if (inCone(direction, out)) assert.ok(region.room(direction) < 1e-6);
    assert.equal(region.mirrored().room([-direction[0], direction[1], direction[2]]), region.room(direction));
  }
});

test('polygons, and what a clip does', () => {
  const octant = swivel.region().addPolygon([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  for (const direction of directions) assert.equal(octant.room(direction) >= 0, direction.every((x) => x >= 0));
  const clip = Array.from({ length: 100 }, (_, n) => [Math.sin(n / 50), 0.3, Math.cos(n / 50)]);
  const four = swivel.region().addDirections(clip.flat(), 0.1), one = swivel.region().addDirections(clip.flat(), 0.1, 1);
  for (const direction of clip) assert.ok(four.room(direction) > 0);
  assert.ok(count(four) < 0.7 * count(one));
});

test('arms keep their region', () => {
  const region = swivel.region().addCones(cones), crowd = swivel.crowd([{ limbCount: 500, region }]);
  assert.ok(crowd.features() & Feature.WITH_REGION);
  crowd.write(Field.LENGTHS, [1, 1]);
  crowd.write(Field.TARGET, directions.filter((_, n) => n % 4 === 0).flat());
  crowd.write(Field.POLE, directions.filter((_, n) => n % 4 === 1).reverse().flat());
  crowd.solve();
  const shoulder = crowd.read(Field.SHOULDER), flags = crowd.read(Field.FLAGS);
  let moved = 0, infeasible = 0;
  for (let n = 0; n < 500; ++n) {
    const room = region.room(turned([...shoulder.slice(4 * n, 4 * n + 4)], [0, 0, 1]));
    assert.equal((flags[n] & Flag.INFEASIBLE) !== 0, room < -1e-6);
    moved += flags[n] === (Flag.REACHED | Flag.LIMITED_REGION), infeasible += room < -1e-6;
  }
  assert.ok(moved > 20 && infeasible > 20, `${moved}, ${infeasible}`);
  crowd.dispose();
});

test('regions that cannot be are refused, and stay as they were', () => {
  const region = swivel.region().addCones(cones), room = region.room([0, 0, 1]);
  refuses(() => region.addCones([{ axis: [1, 0, 0], angle: 0.1 }, { axis: [-1, 0, 0], angle: 0.1 }]), 'cones 0 and 1 are opposite');
  refuses(() => region.addCones([{ axis: [1, 0, 0], opening: 1 }]), 'a cone takes axis, angle, not opening');
  refuses(() => region.addCones({ axis: [1, 0, 0], angle: 1 }), 'give a list of { axis, angle }');
  refuses(() => region.addPolygon([1, 0, 0, 0, 1]), 'corners has 5 numbers; give 6');
  refuses(() => region.addDirections([1, 0, 0], 0), 'the margin, 0, is not in 0.01 to 1');
  refuses(() => region.addDirections([1, 0, 0], 0.1, -1), 'mostCones is -1');
  refuses(() => region.forbid({ axis: [0, 0, 0], angle: 1 }), 'has no direction');
  assert.equal(region.room([0, 0, 1]), room);
  refuses(() => swivel.crowd([{ limbCount: 1, region: {} }]), 'give what region() made');
  refuses(() => swivel.crowd([{ limbCount: 1, region: swivel.region() }]), 'the region allows nothing');
  refuses(() => swivel.crowd([1], Feature.WITH_REGION), 'WITH_REGION needs a region');
});
