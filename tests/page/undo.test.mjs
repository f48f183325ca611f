// SPDX-License-Identifier: MIT
// The promise: each drag, each goal let go and each change of a field can be taken back, by key and by button, to the last bit.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clip, drag, file, pixel, visit, write } from './harness.mjs';

const toml = file('undo.toml', '[limb.all]\nlimits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 60 }\n');
const place = write('undo.html', 'view', clip, '--characters', '6', '--frames', '30', '--crowd', toml);
const link = { hash: '#frame=20&character=3&limb=left_arm' };
const digest = (page) => page.evaluate(() => swivelPage.stage.digest());
const undo = (page) => page.getByRole('button', { name: 'Undo' });

test('every kind of change is one step, and all are taken back in turn', async () => {
  await visit(place, async (page) => {
    await page.getByText('Limits and weights').click();
    const pull = async (name) => {
      const from = await page.evaluate((which) => swivelPage.view.project(swivelPage.view.toClip(swivelPage.picker.handles[which].getWorldPosition(swivelPage.view.camera.position.clone()))), name);
      await drag(page, from, { x: from.x + 50, y: from.y + 30 });
    };
    const sweep = async (name) => {  // a slider of the shoulder cone, by the mouse
      const box = await page.locator('.field').filter({ hasText: 'Shoulder cone' }).getByLabel(name).boundingBox();
      await drag(page, { x: box.x + box.width * 0.3, y: box.y + box.height / 2 }, { x: box.x + box.width * 0.8, y: box.y + box.height / 2 });
    };
    const cone = page.locator('[data-field=SHOULDER_CONE]'), opening = () => page.evaluate(() => swivelPage.fields.SHOULDER_CONE.box.querySelector('input[type=range]').value);
    const steps = [() => pull('target'), () => pull('pole'), () => page.getByRole('button', { name: 'Let go' }).click(), () => pull('cone'), () => sweep('Opening'),
      () => cone.uncheck(), () => page.locator('[data-field=FLEXION_LIMIT]').check(), () => page.getByLabel("Drag everyone's").check(), () => pull('target'),
      () => page.getByRole('button', { name: 'Let all go' }).click()];
    assert.equal(await undo(page).isVisible(), false);
    const seen = [[await digest(page), await opening()]];
    for (const step of steps) {
      await step();
      const now = [await digest(page), await opening()];
      if (step !== steps[7]) seen.push(now);  // the switch says what a drag does, and changes nothing
    }
    const last = seen.pop();
    assert.equal(await page.evaluate(() => swivelPage.undo.before.length), seen.length);
    assert.notDeepEqual(last, seen.at(-1));
    await page.locator('canvas').focus();
    while (seen.length > 0) {
      await (seen.length % 2 ? page.keyboard.press('Control+z') : undo(page).click());
      assert.deepEqual([await digest(page), await opening()], seen.pop(), `step ${seen.length}`);
    }
    assert.deepEqual([await undo(page).isVisible(), await cone.isChecked(), await page.evaluate(() => swivelPage.stage.digestState())], [false, true, 'equal']);
    await page.keyboard.press('Control+z');
    assert.equal(await page.evaluate(() => swivelPage.stage.digestState()), 'equal');
    await page.keyboard.press('h');
    assert.ok(await page.getByText('Ctrl+Z').isVisible());
  }, link);
});

test('keys with Ctrl do nothing else, and the last 64 steps are kept', async () => {
  await visit(place, async (page) => {
    await page.keyboard.press('Control+h');
    await page.keyboard.press('z');
    assert.equal(await page.locator('dialog').isVisible(), false);
    const from = await pixel(page, 'target');
    await drag(page, from, { x: from.x - 30, y: from.y });
    await page.evaluate(() => { for (let n = 0; n < 70; ++n) swivelPage.letAllGo(); });
    assert.equal(await page.evaluate(() => swivelPage.undo.before.length), 64);
  }, link);
});
