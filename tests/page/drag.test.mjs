// SPDX-License-Identifier: MIT
// The promise: what is dragged stays under the pointer, alone or everyone's, with any kind of pole, by mouse and by fingers.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clip, demo, drag, file, pixel, visit, write } from './harness.mjs';

const link = { hash: '#frame=20&character=3&limb=left_arm' };
const state = (page) => page.evaluate(() => swivelPage.stage.digestState());

test('everyone\'s goals follow the pointer, after a drag of one alone, too', async () => {
  await visit(demo, async (page) => {
    const wrists = () => page.evaluate(() => swivelPage.stage.characters.map((_, n) => swivelPage.stage.goal(swivelPage.stage.limbs[0], n, 'target')));
    const from = await pixel(page, 'target');
    await drag(page, from, { x: from.x - 25, y: from.y - 10 });
    const before = await wrists();
    await page.getByLabel("Drag everyone's").check();
    const to = { x: from.x + 12, y: from.y - 30 };
    await drag(page, await pixel(page, 'target'), { x: from.x - 10, y: from.y + 12 });
    await drag(page, await pixel(page, 'target'), to);
    const now = await pixel(page, 'target'), after = await wrists();
    assert.ok(Math.hypot(now.x - to.x, now.y - to.y) < 2, `${now.x} ${now.y}, pointer at ${to.x} ${to.y}`);
    const sizes = await page.evaluate(() => swivelPage.stage.characters.map(({ size }) => size));
    const moved = after.map((at, n) => at.map((coordinate, axis) => (coordinate - before[n][axis]) / sizes[n]));
    assert.ok(Math.hypot(...moved[7]) > 0.01, `${moved[7]}`);
    for (const n of [0, 5, 11]) moved[n].forEach((offset, axis) => assert.ok(Math.abs(offset - moved[7][axis]) < 1e-4, `${moved[n]} ${moved[7]}`));
    await page.getByRole('button', { name: 'Let go' }).click();
    assert.equal(await state(page), 'equal');
  }, link);
});

test('everyone\'s poles that are directions go where the pointer points, whatever a character\'s size', async () => {
  const toml = file('direction.toml', '[limb.all]\npole.kind = "direction"\n');
  const place = write('direction.html', 'view', clip, '--characters', '6', '--frames', '30', '--crowd', toml);
  await visit(place, async (page) => {
    const off = await page.evaluate(() => {
      const { stage } = swivelPage, worst = [];
      for (const limb of stage.limbs)
        for (const character of [0, 3, 5]) {
          const origin = stage.origin(limb, character), length = stage.armLength(limb, character);
          for (const way of [[0.6, 0, -0.8], [0, -0.6, 0.8], [0.8, 0.6, 0]]) {
            stage.drag(limb, character, 'pole', origin.map((coordinate, axis) => coordinate + length * way[axis]), true);
            const at = stage.goal(limb, character, 'pole').map((coordinate, axis) => (coordinate - origin[axis]) / length);
            worst.push(Math.hypot(...at.map((coordinate, axis) => coordinate - way[axis])));
          }
        }
      return Math.max(...worst);
    });
    assert.ok(off < 1e-5, `${off}`);
  });
});

test('a choice by keys ends the drag of a handle', async () => {
  await visit(demo, async (page) => {
    for (const key of ['n', 'Escape']) {
      const at = await pixel(page, 'target');
      await page.mouse.move(at.x, at.y);
      await page.mouse.down();
      await page.keyboard.press(key);
      await page.mouse.move(at.x + 30, at.y + 20, { steps: 3 });
      await page.mouse.up();
      assert.equal(await state(page), 'equal', key);
    }
    assert.equal(await page.evaluate(() => swivelPage.selection), null);
  }, link);
});

test('two fingers choose nothing, and a second one does not drag', async () => {
  await visit(demo, async (page) => {
    const client = await page.context().newCDPSession(page), places = new Map();
    const touch = (type) => client.send('Input.dispatchTouchEvent', { type, touchPoints: [...places].map(([id, { x, y }]) => ({ id, x, y })) });
    const down = (id, at) => touch('touchStart', places.set(id, at)), move = (id, at) => touch('touchMove', places.set(id, at));
    const up = (id) => touch('touchEnd', places.delete(id));
    const chosen = () => page.evaluate(() => swivelPage.selection && [swivelPage.selection.limb.name, swivelPage.selection.character]);
    const wrist = await pixel(page, 'wrist'), target = await pixel(page, 'target');
    await down(0, target);
    await down(1, { x: target.x - 90, y: target.y });
    await move(1, { x: target.x - 120, y: target.y + 60 });
    const now = await pixel(page, 'target');
    assert.ok(Math.hypot(now.x - target.x, now.y - target.y) < 2, 'the target stays under the first finger');
    await up(1);
    await up(0);
    assert.deepEqual(await chosen(), ['left_arm', 3]);
    await page.evaluate(() => swivelPage.select(null));
    await down(0, wrist);
    await down(1, { x: wrist.x - 90, y: wrist.y });
    await move(1, { x: wrist.x - 130, y: wrist.y + 10 });
    await up(0);
    await up(1);
    assert.equal(await chosen(), null);
  }, { ...link, hasTouch: true });
});

test('a hand that holds the other one has no ball, and follows that one', async () => {
  const toml = file('hold.toml', '[limb.left_arm]\nhold = "right_arm"\n');
  await visit(write('hold.html', 'view', clip, '--characters', '6', '--frames', '40', '--crowd', toml), async (page) => {
    const seen = () => page.evaluate(() => {
      const { stage } = swivelPage, wrists = ['left_arm', 'right_arm'].map((name) => stage.pose(stage.limbs.find((limb) => limb.name === name), 3).wrist);
      return { left: wrists[0], apart: wrists[0].map((x, axis) => x - wrists[1][axis]), length: stage.armLength(stage.limbs[0], 3), state: stage.digestState() };
    });
    const choose = (name) => page.evaluate((which) => {
      swivelPage.select({ limb: swivelPage.stage.limbs.find((limb) => limb.name === which), character: 3 });
      swivelPage.draw();
      return swivelPage.picker.handles.target.visible;
    }, name);
    await page.evaluate(() => { swivelPage.setFrame(20); swivelPage.look(swivelPage.stage.limbs[0], 3); });
    assert.equal(await choose('left_arm'), false);
    assert.equal(await choose('right_arm'), true);
    const before = await seen(), from = await pixel(page, 'target');
    await drag(page, from, { x: from.x + 8, y: from.y - 12 });
    const after = await seen(), off = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis])) / before.length;
    assert.deepEqual([before.state, after.state], ['equal', 'changed']);
    assert.ok(off(after.left, before.left) > 0.03, `it went ${off(after.left, before.left)}`);
    assert.ok(off(after.apart, before.apart) < 1e-5, `it slips by ${off(after.apart, before.apart)}`);
  });
});
