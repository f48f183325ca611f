// SPDX-License-Identifier: MIT
// The promise: feet that stand on hills have the command's bits, however a frame was reached, also where one is dragged. Hips and ground are
// dragged, too, and boxes are between hands.
import assert from 'node:assert/strict';
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertEqualBits, choose, clip, difference, digests, file, onPage, pixel, pull, range, state, visit, write } from './harness.mjs';

copyFileSync(new URL('../../examples/hills.png', import.meta.url), join(process.env.WORK, 'hills.png'));
const toml = file('hills.toml', `[crowd]
limbs = "all"
size = [0.8, 1.2]
[ground]
heights = "hills.png"
size = [900, 60, 900]
`);
const words = ['view', clip, '--characters', '12', '--frames', '150', '--crowd', toml];
const hills = write('hills.html', ...words);

/** Chooses a limb of character 3 in a frame, whose feet are then above the bar. */
async function lookAt(page, name, frame) {
  await choose(page, name, 3);
  await page.evaluate((at) => {
    swivelPage.setFrame(at);
    swivelPage.look(swivelPage.selection.limb, 3);
    for (const place of [swivelPage.view.camera.position, swivelPage.view.controls.target]) place.y -= 0.35;
    swivelPage.view.controls.update();
    swivelPage.draw();
  }, frame);
}
/** Of each character in leg lengths: how high its hip, root and the ground below it are, where its ankles are, and how high above the ground. */
const seen = (page) => page.evaluate(() => {
  const { stage } = swivelPage, legs = ['left_leg', 'right_leg'].map(limbOf);
  return stage.characters.map((_, n) => {
    const length = stage.armLength(legs[0], n), [x, y, z] = stage.root(n), ankles = legs.map((leg) => stage.pose(leg, n).wrist);
    return { hip: stage.shoulder(legs[0], n)[1] / length, root: y / length, ground: stage.groundHeight(x, z) / length, at: [x, z], length,
      ankles: ankles.map((ankle) => ankle.map((c) => c / length)), above: ankles.map((ankle) => (ankle[1] - stage.groundHeight(ankle[0], ankle[2])) / length) };
  });
});

onPage('the command\'s bits, played or scrubbed, and the shader\'s limbs and slides', () => hills, async (page) => {
  const all = await digests(page, range(150)), order = [149, 3, 64, 63, 130, 0, 100, 65];
  assert.ok(all.every(([, isEqual]) => isEqual === 'equal'));
  assert.deepEqual(await digests(page, order), order.map((frame) => all[frame]));
  const slides = [];
  for (const frame of [20, 100, 110, 120]) {
    const { joints, apart, drawn } = await page.evaluate((at) => {
      swivelPage.setFrame(at);
      const { stage } = swivelPage, who = [...stage.characters.keys()], joints = worstDrawn(who);
      /** "Off by", and how far the end of a limb is seen from its ball. */
      const offs = (limb) => who.map((n) => {
        const { position } = swivelPage.picker.handles.target, end = position.clone().fromArray(stage.pose(limb, n).wrist);
        if (stage.has(limb, 'EFFECTOR')) {
          const [x, y, z, w] = stage.crowd.hands({ group: limb.index, first: n, count: 1 });
          end.addScaledVector(position.clone().fromArray(stage.read(limb, n, 'EFFECTOR')).applyQuaternion({ x, y, z, w }), stage.characters[n].size);
        }
        return Math.abs(end.distanceTo(position.clone().fromArray(stage.goal(limb, n, 'target'))) / stage.armLength(limb, n) - stage.residual(limb, n));
      });
      /** As drawn, and how fast the offset of a planted point fades. */
      const slide = (limb) => {
        const read = swivelPage.readback(limb, who.length), isPlanted = (n) => limb.name.endsWith('leg') && stage.flags(limb, n) & 2 ** 17;
        return who.map((n) => [read[2 * n + 1][3], isPlanted(n) ? Math.hypot(...stage.read(limb, n, 'PLANT').subarray(6, 9)) / stage.armLength(limb, n) : -1]);
      };
      return { joints, apart: Math.max(...stage.limbs.flatMap(offs)), drawn: stage.limbs.flatMap(slide) };
    }, frame);
    assert.ok(joints > 0 && joints < 1e-5 && apart < 1e-4, `joints are ${joints}, ends ${apart} of a limb off`);
    assert.ok((await seen(page)).every(({ above }) => Math.max(...above.map(Math.abs)) < 0.6), 'ankles are near the ground');
    slides.push(...drawn);
  }
  assert.ok(slides.every(([drawn, slide]) => Math.abs(drawn - slide) < 1e-5), `${slides}`);
  assert.ok(slides.some(([drawn]) => drawn > 0.01) && slides.some(([drawn]) => drawn === 0) && slides.some(([drawn]) => drawn < 0), `${slides}`);
  const slid = await difference(page, () => page.getByLabel('Colour limbs by').selectOption('Slide'));
  assert.ok(slid.share > 0.002, `${slid.share}`);
  await choose(page, 'left_arm', 2);
  assert.equal(await page.textContent('.why'), 'It goes along with its body.');
});

onPage('a dragged foot, let go again, and as a table for the command', () => hills, async (page) => {
  await lookAt(page, 'right_leg', 70);
  const from = await pull(page, 'target', 25, -30), to = await pixel(page, 'target');  // let go, it sinks to the ground
  assert.ok(Math.abs(to.x - from.x - 25) < 2 && to.y > from.y - 29, `${to.x - from.x} ${to.y - from.y}`);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save as table' }).click()]);
  await download.saveAs(join(process.env.WORK, 'foot.csv'));
  assert.equal(await state(page), 'changed');
  const frames = [0, 69, 70, 149, 71], dragged = await digests(page, frames);
  await visit(write('foot_again.html', ...words, '--targets', join(process.env.WORK, 'foot.csv')), async (again) => {
    assert.deepEqual(await digests(again, frames), dragged.map(([digest]) => [digest, 'equal']));
  });
  await page.evaluate(() => swivelPage.letAllGo());
  await assertEqualBits(page, [70]);
});

onPage('dragged hips go down as far as they may, with the feet where they stand; let go, undone, and everyone\'s',
  () => hills, async (page) => {
  await lookAt(page, 'left_leg', 20);  // they stand
  const before = await seen(page), down = async () => (await seen(page)).map(({ hip }, n) => before[n].hip - hip);
  await pull(page, 'hips', 0, 60);
  (await down()).forEach((by, n) => assert.ok(n === 3 ? by > 0.05 && by < 0.21 : by === 0, `${n} went down by ${by}`));
  const off = (await seen(page)).flatMap(({ ankles }, n) => ankles.map((ankle, leg) => Math.hypot(...ankle.map((x, axis) => x - before[n].ankles[leg][axis]))));
  assert.ok(Math.max(...off) < 0.02, `a foot went ${Math.max(...off)} away`);
  assert.equal(await state(page), 'changed');
  assert.deepEqual([await page.getByRole('button', { name: 'Save as table' }).isVisible(), await page.getByRole('button', { name: 'Let all go' }).isVisible()], [false, true]);
  await page.getByRole('button', { name: 'Undo' }).click();
  await assertEqualBits(page, [20]);
  await page.getByLabel("Drag everyone's").check();
  await pull(page, 'hips', 0, 60);
  const all = await down();  // some have come down for their slope already
  assert.ok(all.filter((by) => by > 0.05).length > 6 && all.every((by) => by > -1e-3), `${all}`);
  await page.getByRole('button', { name: 'Let go', exact: true }).click();
  (await down()).forEach((by, n) => assert.ok(n === 3 ? Math.abs(by) < 0.01 : by === all[n], `${n}: ${by}`));
  await page.getByRole('button', { name: 'Let all go' }).click();
  await assertEqualBits(page, [20, 149, 20]);
});

test('boxes are between the hands of those who carry one, and are seen', async () => {
  const carrying = file('boxes.toml', '[crowd]\nlimbs = "all"\nsize = [0.8, 1.2]\nlegs = [0.8, 1.2]\n[ground]\n[carry]\nshare = 0.5\nsize = [6, 4, 5]\n');
  await visit(write('boxes.html', 'view', clip, '--characters', '12', '--frames', '60', '--crowd', carrying), async (page) => {
    await assertEqualBits(page, [0, 59, 30]);
    const boxes = await page.evaluate(() => {
      const { stage, view: { bodies: { boxes: { carriers, meshes: [mesh] } } } } = swivelPage;
      return carriers.map((character, n) => {
        const matrix = mesh.matrixWorld.clone();
        mesh.getMatrixAt(n, matrix);
        const hand = (name) => mesh.position.clone().fromArray(stage.pose(limbOf(name), character).wrist).applyMatrix4(matrix.clone().invert()).toArray();
        return { up: matrix.elements[5] / stage.characters[character].size, ahead: matrix.elements[10] / stage.characters[character].size, hands: [hand('left_arm'), hand('right_arm')] };
      });
    });
    assert.ok(boxes.length > 2 && boxes.length < 10, `${boxes.length} boxes`);
    for (const { up, ahead, hands } of boxes) {
      assert.ok(up > 0.8 && ahead > 0.7, `${up} ${ahead}`);  // the figures face +z
      hands.forEach(([x, y, z], n) => {  // in its axes, of size 1: beside it, behind its middle
        const palm = (n % 2 ? -x : x) - 3;
        assert.ok(palm > 0.1 && palm < 1.5 && Math.abs(y) < 1e-3 && z < -0.5 && z > -2.5, `${x} ${y} ${z}`);
      });
    }
    const { share } = await difference(page, () => page.evaluate(() => swivelPage.view.bodies.boxes.meshes.forEach((mesh) => { mesh.visible = false; })));
    assert.ok(share > 0.002, `${share} of the picture`);
  });
});

onPage('dragged ground rises below the one who stands there, as far as the pointer goes, and feet stand on it',
  () => hills, async (page) => {
  await lookAt(page, 'left_leg', 20);  // they stand
  const before = await seen(page);
  let from;
  const { share } = await difference(page, async () => { from = await pull(page, 'ground', 0, -60); });
  assert.ok(share > 0.02, `${share} of the picture changed`);
  const after = await seen(page), by = after[3].ground - before[3].ground, rise = after[3].root - before[3].root, at = await pixel(page, 'ground');
  assert.ok(Math.abs(at.y - (from.y - 60)) < 1.5, `the ball is at ${at.y}, the pointer at ${from.y - 60}`);
  assert.ok(by > 0.2 && rise > by / 2 && rise < by, `the ground rises by ${by}, the body by ${rise}`);  // with the ground of the lower foot, on the mound's side
  const { far, wide, legs } = await page.evaluate(() => {  // far: beyond the mound and the heights beside it. wide: of those that changed, in its radius
    const { mounds: [{ x, z, radius }], ground: { size, middle, columns, rows, own, pointers }, memory } = swivelPage.stage;
    const places = (axis, count) => Array.from({ length: count }, (_, n) => middle[axis] + size[axis] * (n / (count - 1) - 0.5)), [xs, zs] = [places(0, columns), places(2, rows)];
    const ways = Array.from(memory.floats(pointers[1], own.length), (height, n) => (height === own[n] ? 0 : Math.hypot(xs[n % columns] - x, zs[Math.floor(n / columns)] - z)));
    return { far: radius + 2 * Math.max(size[0] / (columns - 1), size[2] / (rows - 1)), wide: Math.max(...ways) / radius, legs: radius / swivelPage.stage.legLength(3) };
  });
  assert.ok(wide > 0.5 && wide < 1 && legs >= 3, `the mound is ${wide} of its radius wide, which is ${legs} legs`);
  for (const [n, { above, at: [x, z], length }] of after.entries()) {
    const isFar = Math.hypot(x - before[3].at[0], z - before[3].at[1]) > far + length;
    above.forEach((foot, leg) => assert.ok(Math.abs(foot - before[n].above[leg]) <= (isFar ? 0 : 0.06), `foot ${leg} of ${n} is ${foot} over the ground, ${before[n].above[leg]} before`));
  }
  assert.equal(await state(page), 'changed');
  await page.getByRole('button', { name: 'Undo' }).click();
  await assertEqualBits(page, [20]);
  await pull(page, 'ground', 0, 40);  // one place, one mound
  await pull(page, 'ground', 0, 400);
  assert.deepEqual(await page.evaluate(() => swivelPage.stage.mounds.map(({ height, radius }) => height / radius)), [-0.5]);
  assert.ok((await seen(page))[3].ground < before[3].ground);
  await page.getByRole('button', { name: 'Let all go' }).click();
  await assertEqualBits(page, [20, 149, 20]);
});

test('the ball of the ground stays under the pointer where the camera follows, and beyond the picture of the ground', async () => {
  for (const middle of [0, 5000]) {
    const place = file('middle.toml', `[crowd]\nlimbs = "legs"\n[ground]\nheights = "hills.png"\nsize = [900, 60, 900]\nmiddle = [${middle}, 0, 0]\n`);
    await visit(write('middle.html', 'view', clip, '--frames', '30', '--crowd', place), async (page) => {
      await choose(page, 'left_leg', 0);
      await page.evaluate(() => {
        for (const at of [swivelPage.view.camera.position, swivelPage.view.controls.target]) at.y -= 0.35;
        swivelPage.view.controls.update();
        swivelPage.draw();
      });
      const from = await pull(page, 'ground', 0, -30), at = await pixel(page, 'ground'), [mound] = await page.evaluate(() => swivelPage.stage.mounds);
      assert.ok(Math.abs(at.y - (from.y - 30)) < 1.5 && mound.height > 0, `the ball is at ${at.y}, the pointer at ${from.y - 30}`);
    });
  }
});
