// SPDX-License-Identifier: MIT
// The promise: the table of dragged goals gives the command the page's bits, in every frame, and says what it does not hold.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { clip, drag, file, pixel, visit, write } from './harness.mjs';

const crowd = ['view', clip, '--characters', '6', '--frames', '10'];
const button = (page) => page.getByRole('button', { name: 'Save as table' });
const digests = (page) => page.evaluate(() => Array.from({ length: swivelPage.stage.frameCount }, (_, frame) => {
  swivelPage.setFrame(frame);
  return swivelPage.stage.digest();
}));
async function save(page, name) {
  const [download] = await Promise.all([page.waitForEvent('download'), button(page).click()]);
  await download.saveAs(join(process.env.WORK, name));
  return readFileSync(join(process.env.WORK, name), 'utf8').trim().split('\n');
}
const choose = (page, character, name) => page.evaluate(([who, which]) => {
  swivelPage.select({ limb: swivelPage.stage.limbs.find((limb) => limb.name === which), character: who });
  swivelPage.view.lookAt(who, true);
  swivelPage.draw();
}, [character, name]);
async function pull(page, part, x, y) {
  const from = await pixel(page, part);
  await drag(page, from, { x: from.x + x, y: from.y + y });
}
/** Of a table, a page by the command: the digests that it holds, once its own are the same. */
async function solved(name, words, table) {
  let native;
  await visit(write(name, ...words, '--targets', join(process.env.WORK, table)), async (page) => {
    native = await page.evaluate(() => swivelPage.stage.data.digests);
    assert.deepEqual(await digests(page), native);
  });
  return native;
}

test('goals of one and of everyone, targets and poles', async () => {
  await visit(write('save.html', ...crowd), async (page) => {
    assert.equal(await button(page).isVisible(), false);
    const untouched = await digests(page);
    await choose(page, 2, 'left_arm');
    await pull(page, 'target', -30, -25);
    await page.evaluate(() => swivelPage.setFrame(7));
    await pull(page, 'pole', 60, 20);
    await choose(page, 4, 'right_arm');
    await page.getByLabel("Drag everyone's").check();
    await pull(page, 'target', 20, -35);
    const before = await page.evaluate(() => [swivelPage.stage.frame, swivelPage.stage.digest()]);
    const [header, ...rows] = await save(page, 'saved.csv'), cells = rows.map((row) => row.split(','));
    assert.deepEqual(await page.evaluate(() => { swivelPage.stage.solve(); return [swivelPage.stage.frame, swivelPage.stage.digest()]; }), before);
    assert.equal(header, 'frame,character,limb,x,y,z,pole_x,pole_y,pole_z');
    assert.equal(rows.length, 10 * 7);
    assert.deepEqual([...new Set(cells.map(([, character, limb, ...numbers]) => `${limb} ${character} ${numbers.slice(3).every((cell) => cell !== '')}`))].sort(),
      ['left_arm 2 true', ...[0, 1, 2, 3, 4, 5].map((n) => `right_arm ${n} false`)]);
    const dragged = await digests(page);
    dragged.forEach((digest, frame) => assert.notEqual(digest, untouched[frame]));
    assert.deepEqual(await solved('saved.html', crowd, 'saved.csv'), dragged);
  });
});

test('a crowd file\'s offsets come once, everyone\'s poles that are directions, state', async () => {
  const toml = file('save.toml', '[limb.all]\ntarget.offset = [0.3, 2.1, -1.7]\npole.kind = "direction"\nswivel.most_deg_per_frame = 3\n'), words = [...crowd, '--crowd', toml];
  await visit(write('save_offset.html', ...words), async (page) => {
    await choose(page, 1, 'right_arm');
    await page.getByLabel("Drag everyone's").check();
    await pull(page, 'pole', 50, 30);
    await page.getByLabel("Drag everyone's").uncheck();
    await pull(page, 'target', 25, -20);
    await save(page, 'saved_offset.csv');
    assert.deepEqual(await solved('saved_offset.html', words, 'saved_offset.csv'), await digests(page));
  });
});

test('what a table does not hold is said, and too many rows are refused', async () => {
  const toml = file('fixed.toml', '[limb.all]\npole.fixed = [0, -20, -40]\n');
  await visit(write('lacks.html', ...crowd, '--crowd', toml), async (page) => {
    const lack = () => page.getByText('The table does not hold').allTextContents();
    await choose(page, 2, 'left_arm');
    await pull(page, 'target', -20, -20);
    assert.deepEqual(await lack(), []);
    await pull(page, 'pole', 50, 0);
    await page.evaluate(() => swivelPage.fields.REACH.box.querySelector('[data-field]').click());
    assert.deepEqual(await lack(), ['The table does not hold limits and weights, nor poles that the crowd file sets.']);
    const rows = await save(page, 'lacks.csv');
    assert.ok(rows.length === 11 && rows[1].endsWith(',,,'), rows[1]);
    await page.evaluate(() => { swivelPage.stage.frameCount = 2_000_001; });
    await button(page).click();
    assert.match(await page.textContent('.notice'), /^This table would have 2,000,001 rows, and 2,000,000 are the most/);
  }, { spoils: true });
});
