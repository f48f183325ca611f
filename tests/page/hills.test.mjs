// SPDX-License-Identifier: MIT
// The promise: feet that stand on hills have the command's bits, however a frame was reached, also where one is dragged.
import assert from 'node:assert/strict';
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { clip, difference, drag, file, pixel, visit, write } from './harness.mjs';

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
const digests = (page, frames) => page.evaluate((list) => list.map((frame) => {
  swivelPage.setFrame(frame);
  return [swivelPage.stage.digest(), swivelPage.stage.digestState()];
}), frames);

test('the command\'s bits, played or scrubbed, and the shader\'s limbs and shadows on the hills', async () => {
  await visit(hills, async (page) => {
    const all = await digests(page, [...Array(150).keys()]);
    assert.ok(all.every(([, state]) => state === 'equal'));
    const order = [149, 3, 64, 63, 130, 0, 100, 65];
    assert.deepEqual(await digests(page, order), order.map((frame) => all[frame]));
    const [joints, feet] = await page.evaluate(() => {
      const { stage, view } = swivelPage, off = (a, b) => Math.hypot(...a.map((coordinate, axis) => coordinate - b[axis]));
      swivelPage.setFrame(100);
      swivelPage.draw();
      let joints = 0, feet = 0;
      for (const limb of stage.limbs) {
        const drawn = swivelPage.readback(limb, stage.characterCount);
        stage.characters.forEach(({ place, size }, n) => {
          const { elbow, wrist } = stage.pose(limb, n);
          [elbow, wrist].forEach((joint, which) => { joints = Math.max(joints, off(joint.map((x, axis) => x - place[axis]), drawn[2 * n + which]) / stage.armLength(limb, n)); });
          if (limb.name.endsWith('leg')) feet = Math.max(feet, Math.abs(wrist[1] - stage.groundHeight(wrist[0], wrist[2])) / view.figure.height / size);
        });
      }
      return [joints, feet];
    });
    assert.ok(joints > 0 && joints < 1e-5, `${joints} of a limb`);
    assert.ok(feet < 0.3, `an ankle is ${feet} heights from the ground`);
    const apart = await page.evaluate(() => {  // "Off by" and how far the end of a limb is seen from its ball
      const { stage } = swivelPage;
      return [20, 100].flatMap((frame) => {
        swivelPage.setFrame(frame);
        return stage.limbs.flatMap((limb) => stage.characters.map(({ size }, n) => {
          const goal = stage.goal(limb, n, 'target'), { position } = swivelPage.picker.handles.target, end = position.clone().fromArray(stage.pose(limb, n).wrist);
          if (stage.has(limb, 'EFFECTOR')) {
            const [x, y, z, w] = stage.crowd.hands({ group: limb.index, first: n, count: 1 });
            end.addScaledVector(position.clone().fromArray(stage.read(limb, n, 'EFFECTOR')).applyQuaternion({ x, y, z, w }), size);
          }
          return Math.abs(end.distanceTo(position.clone().fromArray(goal)) / stage.armLength(limb, n) - stage.residual(limb, n));
        }));
      });
    });
    assert.ok(Math.max(...apart) < 1e-4, `${Math.max(...apart)} of a limb`);
    const { share, colours } = await difference(page, () => page.evaluate(() => swivelPage.setFrame(20)));
    assert.ok(colours > 100 && share > 0.01, `${colours} colours, ${share} changed`);
    const slides = await page.evaluate(() => {  // as drawn, and how fast the offset of a planted point fades
      const { stage } = swivelPage;
      return [20, 100, 110, 120].flatMap((frame) => {
        swivelPage.setFrame(frame);
        swivelPage.draw();
        return stage.limbs.flatMap((limb) => {
          const drawn = swivelPage.readback(limb, stage.characterCount), isLeg = limb.name.endsWith('leg');
          return stage.characters.map((_, n) => [drawn[2 * n + 1][3],
            isLeg && stage.flags(limb, n) & 2 ** 17 ? Math.hypot(...stage.read(limb, n, 'PLANT').subarray(6, 9)) / stage.armLength(limb, n) : -1]);
        });
      });
    });
    assert.ok(slides.every(([drawn, slide]) => Math.abs(drawn - slide) < 1e-5), `${slides}`);
    assert.ok(slides.some(([drawn]) => drawn > 0.01) && slides.some(([drawn]) => drawn === 0) && slides.some(([drawn]) => drawn < 0), `${slides}`);
    const slid = await difference(page, () => page.getByLabel('Colour limbs by').selectOption('Slide'));
    assert.ok(slid.share > 0.002, `${slid.share}`);
    await page.evaluate(() => swivelPage.select({ limb: swivelPage.stage.limbs.find(({ name }) => name === 'left_arm'), character: 2 }));
    assert.equal(await page.textContent('.why'), 'It goes along with its body.');
  });
});

test('a dragged foot, let go again, and as a table for the command', async () => {
  await visit(hills, async (page) => {
    await page.evaluate(() => {
      swivelPage.setFrame(70);
      swivelPage.select({ limb: swivelPage.stage.limbs.find(({ name }) => name === 'right_leg'), character: 3 });
      swivelPage.view.lookAt(3, true);
      for (const at of [swivelPage.view.camera.position, swivelPage.view.controls.target]) at.y -= 0.35;  // the feet are above the bar
      swivelPage.view.controls.update();
      swivelPage.draw();
    });
    const from = await pixel(page, 'target');
    await drag(page, from, { x: from.x + 25, y: from.y - 30 });
    const seen = await pixel(page, 'target');  // let go, it sinks to the ground
    assert.ok(Math.abs(seen.x - from.x - 25) < 2 && seen.y > from.y - 29, `${seen.x - from.x} ${seen.y - from.y}`);
    const [[, changed]] = await digests(page, [70]), [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save as table' }).click()]);
    assert.equal(changed, 'changed');
    await download.saveAs(join(process.env.WORK, 'foot.csv'));
    const dragged = (await digests(page, [0, 69, 70, 149, 71])).map(([digest]) => digest);
    await visit(write('foot_again.html', ...words, '--targets', join(process.env.WORK, 'foot.csv')), async (again) => {
      assert.deepEqual(await digests(again, [0, 69, 70, 149, 71]), dragged.map((digest) => [digest, 'equal']));
    });
    await page.evaluate(() => swivelPage.letAllGo());
    assert.equal(await page.evaluate(() => swivelPage.stage.digestState()), 'equal');
  });
});

test('dragged hips go down as far as they may, with the feet where they stand; let go, undone, and everyone\'s', async () => {
  await visit(hills, async (page) => {
    const seen = () => page.evaluate(() => {
      const { stage } = swivelPage, legs = stage.limbs.filter(({ name }) => name.endsWith('leg'));
      return stage.characters.map((_, n) => ({ hip: stage.shoulder(legs[0], n)[1], feet: legs.map((leg) => stage.pose(leg, n).wrist), length: stage.armLength(legs[0], n) }));
    });
    const pull = async (pixels) => {
      const from = await page.evaluate(() => swivelPage.view.project(swivelPage.picker.handles.hips.position.toArray()));
      await drag(page, from, { x: from.x, y: from.y + pixels });
    };
    await page.evaluate(() => {
      swivelPage.setFrame(20);  // they stand
      swivelPage.select({ limb: swivelPage.stage.limbs[0], character: 3 });
      swivelPage.look(swivelPage.stage.limbs[0], 3);
      swivelPage.draw();
    });
    const before = await seen();
    await pull(60);
    const low = await seen();
    for (const [n, { hip, feet, length }] of before.entries()) {
      const down = (hip - low[n].hip) / length, off = Math.max(...feet.flatMap((foot, leg) => foot.map((x, axis) => Math.abs(x - low[n].feet[leg][axis])))) / length;
      assert.ok(n === 3 ? down > 0.05 && down < 0.21 : down === 0, `${n} went down by ${down}`);
      assert.ok(off < 0.02, `a foot of ${n} went ${off} away`);
    }
    assert.deepEqual((await digests(page, [20])).map(([, state]) => state), ['changed']);
    assert.deepEqual([await page.getByRole('button', { name: 'Save as table' }).isVisible(), await page.getByRole('button', { name: 'Let all go' }).isVisible()], [false, true]);
    await page.getByRole('button', { name: 'Undo' }).click();
    assert.deepEqual((await digests(page, [20])).map(([, state]) => state), ['equal']);
    await page.getByLabel("Drag everyone's").check();
    await pull(60);
    const all = await seen();
    const down = before.map(({ hip, length }, n) => (hip - all[n].hip) / length);  // some have come down for their slope already
    assert.ok(down.filter((by) => by > 0.05).length > 6 && down.every((by) => by > -1e-3), `${down}`);
    await page.getByRole('button', { name: 'Let go', exact: true }).click();
    const still = await seen();
    assert.ok(Math.abs(still[3].hip - before[3].hip) < 0.01 * before[3].length && still.every(({ hip }, n) => n === 3 || hip === all[n].hip));
    await page.getByRole('button', { name: 'Let all go' }).click();
    assert.deepEqual((await digests(page, [20, 149, 20])).map(([, state]) => state), ['equal', 'equal', 'equal']);
  });
});

test('boxes are between the hands of those who carry one, and are seen', async () => {
  const carrying = file('boxes.toml', `[crowd]
limbs = "all"
size = [0.8, 1.2]
legs = [0.8, 1.2]
[ground]
[carry]
share = 0.5
size = [6, 4, 5]
`);
  await visit(write('boxes.html', 'view', clip, '--characters', '12', '--frames', '60', '--crowd', carrying), async (page) => {
    assert.ok((await digests(page, [0, 59, 30])).every(([, state]) => state === 'equal'));
    const [count, hands, axes] = await page.evaluate(() => {
      const { stage, view: { bodies: { boxes } } } = swivelPage, hands = [], axes = [];
      boxes.carriers.forEach((character, n) => {
        const matrix = boxes.meshes[0].matrixWorld.clone();
        boxes.meshes[0].getMatrixAt(n, matrix);
        const side = (name) => stage.pose(stage.limbs.find((limb) => limb.name === name), character).wrist;
        axes.push([matrix.elements[5], matrix.elements[10]].map((part) => part / stage.characters[character].size));
        hands.push(...['left_arm', 'right_arm'].map((name) => boxes.meshes[0].position.clone().fromArray(side(name)).applyMatrix4(matrix.clone().invert()).toArray()));
      });
      return [boxes.meshes[0].count, hands, axes];
    });
    assert.ok(axes.every(([up, ahead]) => up > 0.8 && ahead > 0.7), `${axes}`);  // the figures face +z
    assert.ok(count > 2 && count < 10 && hands.length === 2 * count, `${count} boxes`);
    hands.forEach(([x, y, z], n) => {  // in its axes, of size 1: beside it, behind its middle
      const palm = (n % 2 ? -x : x) - 3;
      assert.ok(palm > 0.1 && palm < 1.5 && Math.abs(y) < 1e-3 && z < -0.5 && z > -2.5, `${x} ${y} ${z}`);
    });
    const { share } = await difference(page, () => page.evaluate(() => swivelPage.view.bodies.boxes.meshes.forEach((mesh) => { mesh.visible = false; })));
    assert.ok(share > 0.002, `${share} of the picture`);
  });
});

test('dragged ground rises below the one who stands there, as far as the pointer goes, and feet stand on it', async () => {
  await visit(hills, async (page) => {
    const seen = () => page.evaluate(() => {
      const { stage } = swivelPage, legs = stage.limbs.filter(({ name }) => name.endsWith('leg'));
      return stage.characters.map((_, n) => {
        const root = Array.from(stage.root(n)), over = legs.map((leg) => stage.pose(leg, n).wrist).map(([x, y, z]) => y - stage.groundHeight(x, z));
        return { root, over, ground: stage.groundHeight(root[0], root[2]), length: stage.armLength(legs[0], n) };
      });
    });
    const look = () => page.evaluate(() => {
      swivelPage.setFrame(20);  // they stand
      swivelPage.select({ limb: swivelPage.stage.limbs[0], character: 3 });
      swivelPage.look(swivelPage.stage.limbs[0], 3);
      for (const at of [swivelPage.view.camera.position, swivelPage.view.controls.target]) at.y -= 0.35;  // the feet are above the bar
      swivelPage.view.controls.update();
      swivelPage.draw();
    });
    const handle = () => page.evaluate(() => {
      const { position } = swivelPage.picker.handles.ground;
      return { ...swivelPage.view.project(position.toArray()), height: position.y };
    });
    await look();
    const before = await seen(), from = await handle();
    const { share } = await difference(page, () => drag(page, from, { x: from.x, y: from.y - 60 }));
    assert.ok(share > 0.02, `${share} of the picture changed`);
    const after = await seen(), at = await handle(), by = (after[3].ground - before[3].ground) / after[3].length;
    assert.ok(Math.abs(at.y - (from.y - 60)) < 1.5, `the ball is at ${at.y}, the pointer at ${from.y - 60}`);
    const rise = (after[3].root[1] - before[3].root[1]) / after[3].length;  // with the ground of the lower foot, on the mound's side
    assert.ok(by > 0.2 && rise > by / 2 && rise < by, `the ground rises by ${by}, the body by ${rise}`);
    const far = await page.evaluate(() => {  // beyond the mound and the heights beside it
      const { mounds: [{ radius }], ground: { size, columns, rows } } = swivelPage.stage;
      return radius + 2 * Math.max(size[0] / (columns - 1), size[2] / (rows - 1));
    });
    for (const [n, { root, over, length }] of after.entries()) {
      const away = Math.hypot(root[0] - before[3].root[0], root[2] - before[3].root[2]);
      if (away > far + length) assert.deepEqual(over, before[n].over);
      else over.forEach((foot, leg) => assert.ok(Math.abs(foot - before[n].over[leg]) < 0.06 * length, `foot ${leg} of ${n} is ${foot / length} over the ground, ${before[n].over[leg] / length} before`));
    }
    assert.deepEqual((await digests(page, [20])).map(([, state]) => state), ['changed']);
    await page.getByRole('button', { name: 'Undo' }).click();
    assert.deepEqual((await digests(page, [20])).map(([, state]) => state), ['equal']);
    await drag(page, from, { x: from.x, y: from.y + 40 });  // one place, one mound
    await drag(page, await handle(), { x: from.x, y: from.y + 400 });
    const deep = await seen(), mounds = await page.evaluate(() => swivelPage.stage.mounds);
    assert.deepEqual(mounds.map(({ height, radius }) => height / radius), [-0.5]);
    assert.ok(deep[3].ground < before[3].ground);
    await page.getByRole('button', { name: 'Let all go' }).click();
    assert.deepEqual((await digests(page, [20, 149, 20])).map(([, state]) => state), ['equal', 'equal', 'equal']);
  });
});

test('the ball of the ground stays under the pointer where the camera follows, and beyond the picture', async () => {
  for (const [name, middle] of [['on', [0, 0, 0]], ['off', [5000, 0, 0]]]) {
    const place = file(`${name}.toml`, `[crowd]\nlimbs = "legs"\n[ground]\nheights = "hills.png"\nsize = [900, 60, 900]\nmiddle = [${middle}]\n`);
    await visit(write(`${name}.html`, 'view', clip, '--frames', '30', '--crowd', place), async (page) => {
      await page.evaluate(() => {
        swivelPage.select({ limb: swivelPage.stage.limbs[0], character: 0 });
        for (const at of [swivelPage.view.camera.position, swivelPage.view.controls.target]) at.y -= 0.35;
        swivelPage.view.controls.update();
        swivelPage.draw();
      });
      const handle = () => page.evaluate(() => swivelPage.view.project(swivelPage.picker.handles.ground.position.toArray()));
      const from = await handle();
      await drag(page, from, { x: from.x, y: from.y - 30 });
      const at = await handle(), [mound] = await page.evaluate(() => swivelPage.stage.mounds);
      assert.ok(Math.abs(at.y - (from.y - 30)) < 1.5 && mound.height > 0, `${name}: the ball is at ${at.y}, the pointer at ${from.y - 30}`);
    });
  }
});
