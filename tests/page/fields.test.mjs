// SPDX-License-Identifier: MIT
// The promise: switches and sliders show what the chosen limbs have, take away a crowd file's limits, and change all or nothing.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, clip, file, state, visit, write } from './harness.mjs';

const toml = file('limits.toml', `[limb.arms]
limits.flexion_deg = [20, 70]
limits.humeral_twist_deg = [-30, 50]
[limb.legs]
limits.flexion_deg = [0, 120]
reach = { soft_far = 0.2 }
`);
const limited = write('limits.html', 'view', clip, '--limbs', 'all', '--characters', '4', '--frames', '30', '--crowd', toml);
const box = (page, field) => page.locator(`[data-field=${field}]`);
const bars = (page, field) => box(page, field).locator('xpath=ancestor::div[1]').locator('input[type=range]').evaluateAll((all) => all.map(({ value }) => Number(value)));

test('switches and sliders follow the chosen kind of limb', async () => {
  await visit(limited, async (page) => {
    await page.getByText('Limits and weights').click();
    for (const name of ['left_arm', 'right_arm']) {
      await choose(page, name, 1);
      assert.deepEqual(await bars(page, 'FLEXION_LIMIT'), [20, 70], name);
      assert.deepEqual(await bars(page, 'HUMERAL_TWIST'), [-30, 50], name);
      assert.equal(await box(page, 'REACH').isChecked(), false);
    }
    await choose(page, 'right_leg', 1);
    assert.deepEqual(await bars(page, 'FLEXION_LIMIT'), [0, 120]);
    assert.equal((await bars(page, 'REACH'))[0], 0.2);
    assert.deepEqual([await box(page, 'REACH').isChecked(), await box(page, 'HUMERAL_TWIST').isChecked()], [true, false]);
    await choose(page, null);
    assert.deepEqual(await box(page, 'REACH').evaluate((input) => [input.checked, input.indeterminate]), [true, true]);
    assert.equal(await state(page), 'equal');
  });
});

test('a limit of the crowd file can be switched off and on', async () => {
  await visit(limited, async (page) => {
    await page.getByText('Limits and weights').click();
    const flexions = () => page.evaluate(() => {
      const { stage } = swivelPage, max = (kind) => Math.max(...stage.limbs.filter(({ name }) => name.endsWith(kind))
        .flatMap((limb) => stage.characters.map((_, n) => stage.flexion(limb, n) * 180 / Math.PI)));
      return [max('arm'), max('leg')];
    });
    await page.evaluate(() => {  // targets near the shoulder bend the elbow as far as they may
      const { stage } = swivelPage;
      stage.limbs.forEach((limb) => stage.characters.forEach((_, n) => {
        stage.drag(limb, n, 'target', stage.origin(limb, n).map((coordinate, axis) => coordinate + [0.2, 0.1, 0.3][axis] * stage.armLength(limb, n)));
      }));
    });
    const [arms, legs] = await flexions();
    assert.ok(Math.abs(arms - 70) < 0.1 && Math.abs(legs - 120) < 0.1, `${arms} ${legs}`);
    await choose(page, 'left_arm', 1);
    await box(page, 'FLEXION_LIMIT').uncheck();
    const [free, kept] = await flexions();
    assert.ok(free > 100 && Math.abs(kept - 120) < 0.1, `${free} ${kept}`);
    await choose(page, 'left_leg', 1);
    await box(page, 'FLEXION_LIMIT').uncheck();
    assert.equal(await page.evaluate(() => swivelPage.stage.limbs.some((limb) => swivelPage.stage.has(limb, 'FLEXION_LIMIT'))), false);
    assert.ok((await flexions())[1] > 125);
    assert.equal(await state(page), 'changed');
    await box(page, 'FLEXION_LIMIT').check();
    assert.ok(Math.abs((await flexions())[1] - 120) < 0.1);
  });
});

test('weights say how much of the clip is kept, and a pole\'s counts where it is moved', async () => {
  const place = write('weights.html', 'view', clip, '--characters', '4', '--frames', '30', '--crowd', file('weights.toml', '[limb.left_arm]\nweights.position = 0.5\n'));
  await visit(place, async (page) => {
    await page.getByText('Limits and weights').click();
    await choose(page, 'left_arm', 1);
    const weights = box(page, 'WEIGHTS').locator('xpath=ancestor::div[1]'), weigh = (name, value) => weights.getByLabel(name).fill(value);
    const joint = (name) => page.evaluate((part) => swivelPage.stage.pose(swivelPage.selection.limb, 1)[part], name);
    const move = (part, by) => page.evaluate(([which, step]) => {
      const { stage, selection: { limb } } = swivelPage;
      swivelPage.drag(which, stage.goal(limb, 1, which).map((coordinate, axis) => coordinate + step[axis]));
    }, [part, by]);
    const apart = (a, b) => Math.hypot(...a.map((coordinate, axis) => coordinate - b[axis]));
    assert.deepEqual([await bars(page, 'WEIGHTS'), await state(page)], [[0.5, 1, 1], 'equal']);
    await weigh('Pole', '0');
    assert.deepEqual([await bars(page, 'WEIGHTS'), await state(page)], [[0.5, 1, 0], 'changed']);
    const [wrist, elbow] = [await joint('wrist'), await joint('elbow')];
    await move('pole', [9, 1, 3]);
    assert.ok(apart(await joint('elbow'), elbow) === 0, 'a pole of no weight says nothing');
    await weigh('Pole', '1');
    assert.ok(apart(await joint('elbow'), elbow) > 0.1, 'a pole that is moved counts');
    await page.evaluate(() => swivelPage.letAllGo());
    await move('target', [0, -2, 0]);
    const half = apart(await joint('wrist'), wrist);
    await box(page, 'WEIGHTS').uncheck();
    const whole = apart(await joint('wrist'), wrist);
    assert.ok(half > 0.1 && Math.abs(whole / half - 2) < 1e-3, `${half} ${whole}`);
    await box(page, 'WEIGHTS').check();
    await weigh('Position', '0');
    assert.ok(apart(await joint('wrist'), wrist) < 1e-4);
  });
});

test('a change that fails leaves the crowd as it was, and is told', async () => {
  await visit(write('full.html', 'demo', '--characters', '12', '--frames', '30'), async (page) => {
    await page.getByText('Limits and weights').click();
    await page.evaluate(() => {  // takes all of the module's memory but for a rest
      const { memory } = swivelPage.stage;
      for (let size = 1 << 24; size >= 4096; size /= 2) for (let at; (at = memory.calls.malloc(size)) !== 0;) (window.taken ??= []).push(at);
    });
    await box(page, 'SHOULDER_BOX').click();
    assert.match(await page.textContent('.notice'), /^Shoulder box stays as it was: /);
    assert.equal(await box(page, 'SHOULDER_BOX').isChecked(), false);
    assert.equal(await page.getByRole('button', { name: 'Undo' }).isVisible(), false);
    await page.evaluate(() => swivelPage.setFrame(7));
    assert.equal(await state(page), 'equal');
    await page.evaluate(() => window.taken.forEach((at) => swivelPage.stage.memory.free(at)));
    await box(page, 'SHOULDER_BOX').click();
    assert.equal(await page.textContent('.notice'), '');
    assert.equal(await box(page, 'SHOULDER_BOX').isChecked(), true);
  });
});
