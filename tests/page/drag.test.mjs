// SPDX-License-Identifier: MIT
// The promise: what is dragged stays under the pointer, alone or everyone's, with any kind of pole, by mouse and by fingers. Each change can be
// taken back, to the last bit. The table of dragged goals gives the command the page's bits, and says what it does not hold.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, clip, digest, digests, drag, file, link, onDemo, onPage, pixel, pull, range, state, visit, write } from './harness.mjs';

const everyone = (page) => page.getByLabel("Drag everyone's"), undo = (page) => page.getByRole('button', { name: 'Undo' });
const letGo = (page) => page.getByRole('button', { name: 'Let go' }), letAllGo = (page) => page.getByRole('button', { name: 'Let all go' });
const table = (page) => page.getByRole('button', { name: 'Save as table' });

test('a wrist\'s target follows the pointer: one alone, and then everyone\'s by the same way; all are let go', async () => {
  const sizes = file('sizes.toml', '[crowd]\nsize = [0.7, 1.3]\n');
  await visit(write('sizes.html', 'view', clip, '--characters', '12', '--frames', '30', '--crowd', sizes), async (page) => {
    const targets = () => page.evaluate(() => swivelPage.stage.characters.map((_, n) => swivelPage.stage.goal(limbOf('left_arm'), n, 'target')));
    const off = async (from, x, y) => {
      const now = await pixel(page, 'target');
      return Math.hypot(now.x - from.x - x, now.y - from.y - y);
    };
    const untouched = await digest(page), start = await pull(page, 'target', -25, -10);
    assert.ok(await off(start, -25, -10) < 2, 'the target is under the pointer');
    assert.deepEqual([await state(page), (await digest(page)) === untouched], ['changed', false]);
    const before = await targets();
    await everyone(page).check();
    await pull(page, 'target', 15, 22);
    await pull(page, 'target', 22, -42);
    assert.ok(await off(start, 12, -30) < 2, 'and after two more drags');
    const size = await page.evaluate(() => swivelPage.stage.characters.map((each) => each.size));
    const moved = (await targets()).map((at, n) => at.map((x, axis) => (x - before[n][axis]) / size[n]));
    assert.ok(Math.hypot(...moved[7]) > 0.01, `${moved[7]}`);
    for (const n of [0, 5, 11]) moved[n].forEach((way, axis) => assert.ok(Math.abs(way - moved[7][axis]) < 1e-4, `${moved[n]} ${moved[7]}`));
    await letGo(page).click();
    assert.equal(await state(page), 'equal', 'everyone\'s of this limb are let go');
    await pull(page, 'target', 22, -42);
    await page.keyboard.press('Escape');
    await letAllGo(page).click();
    assert.deepEqual([await state(page), await digest(page), await letAllGo(page).isVisible()], ['equal', untouched, false]);
  }, link);
});

onDemo('a dragged pole turns the elbow and leaves the wrist; everyone\'s follow if asked', async (page) => {
  const poses = () => page.evaluate(() => [3, 7].map((n) => swivelPage.stage.pose(limbOf('left_arm'), n)));
  const move = async () => {
    const before = await poses();
    await pull(page, 'pole', 50, 70);
    const after = await poses();
    return [0, 1].map((n) => ['elbow', 'wrist'].map((joint) => Math.hypot(...before[n][joint].map((x, axis) => x - after[n][joint][axis]))));
  };
  const [[elbow, wrist], [other]] = await move();
  assert.ok(elbow > 0.001 && wrist < 1e-6 && other === 0, `${elbow} ${wrist} ${other}`);
  await everyone(page).check();
  const [, [followed]] = await move();
  assert.ok(followed > 0.001, `${followed}`);
});

test('everyone\'s poles that are directions go where the pointer points, whatever a character\'s size', async () => {
  const toml = file('direction.toml', '[limb.all]\npole.kind = "direction"\n');
  await visit(write('direction.html', 'view', clip, '--characters', '6', '--frames', '30', '--crowd', toml), async (page) => {
    const off = await page.evaluate(() => {
      const { stage } = swivelPage;
      return Math.max(...stage.limbs.flatMap((limb) => [0, 3, 5].flatMap((character) => [[0.6, 0, -0.8], [0, -0.6, 0.8], [0.8, 0.6, 0]].map((way) => {
        const origin = stage.origin(limb, character), length = stage.armLength(limb, character);
        stage.drag(limb, character, 'pole', origin.map((x, axis) => x + length * way[axis]), true);
        return apart(stage.goal(limb, character, 'pole').map((x, axis) => (x - origin[axis]) / length), way);
      }))));
    });
    assert.ok(off < 1e-5, `${off}`);
  });
});

onDemo('a choice by keys ends the drag of a handle', async (page) => {
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
});

onDemo('two fingers choose nothing, and a second one does not drag', async (page) => {
  const client = await page.context().newCDPSession(page), places = new Map();
  const touch = (type) => client.send('Input.dispatchTouchEvent', { type, touchPoints: [...places].map(([id, { x, y }]) => ({ id, x, y })) });
  const down = (id, at) => touch('touchStart', places.set(id, at)), move = (id, at) => touch('touchMove', places.set(id, at));
  const up = (id) => touch('touchEnd', places.delete(id));
  const chosen = () => page.evaluate(() => swivelPage.selection?.character);
  const wrist = await pixel(page, 'wrist'), target = await pixel(page, 'target');
  await down(0, target);
  await down(1, { x: target.x - 90, y: target.y });
  await move(1, { x: target.x - 120, y: target.y + 60 });
  const now = await pixel(page, 'target');
  assert.ok(Math.hypot(now.x - target.x, now.y - target.y) < 2, 'the target stays under the first finger');
  await up(1), await up(0);
  assert.equal(await chosen(), 3);
  await choose(page, null);
  await down(0, wrist);
  await down(1, { x: wrist.x - 90, y: wrist.y });
  await move(1, { x: wrist.x - 130, y: wrist.y + 10 });
  await up(0), await up(1);
  assert.equal(await chosen(), undefined);
}, { ...link, hasTouch: true });

test('a hand that holds the other one has no ball, and follows that one', async () => {
  const toml = file('hold.toml', '[limb.left_arm]\nhold = "right_arm"\n');
  await visit(write('hold.html', 'view', clip, '--characters', '6', '--frames', '40', '--crowd', toml), async (page) => {
    const wrists = () => page.evaluate(() => ['left_arm', 'right_arm'].map((name) => swivelPage.stage.pose(limbOf(name), 3).wrist));
    const hasBall = async (name) => {
      await choose(page, name, 3);
      return page.evaluate(() => swivelPage.picker.handles.target.visible);
    };
    await page.evaluate(() => { swivelPage.setFrame(20); swivelPage.look(swivelPage.stage.limbs[0], 3); });
    assert.deepEqual([await hasBall('left_arm'), await hasBall('right_arm')], [false, true]);
    const [left, right] = await wrists(), length = await page.evaluate(() => swivelPage.stage.armLength(limbOf('left_arm'), 3));
    await pull(page, 'target', 8, -12);
    const ways = (await wrists()).map((at, n) => at.map((x, axis) => (x - [left, right][n][axis]) / length));
    assert.equal(await state(page), 'changed');
    assert.ok(Math.hypot(...ways[0]) > 0.03 && Math.hypot(...ways[0].map((x, axis) => x - ways[1][axis])) < 1e-5, `they went ${ways}`);
  });
});

// ---- undo
const cone = file('undo.toml', '[limb.all]\nlimits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 60 }\n');
const undone = write('undo.html', 'view', clip, '--characters', '6', '--frames', '30', '--crowd', cone);

onPage('every kind of change is one step, and all are taken back in turn, by key and by button', () => undone, async (page) => {
  await page.getByText('Limits and weights').click();
  const sweep = async (name) => {  // a slider of the shoulder cone, by the mouse
    const box = await page.locator('.field').filter({ hasText: 'Shoulder cone' }).getByLabel(name).boundingBox(), y = box.y + box.height / 2;
    await drag(page, { x: box.x + box.width * 0.3, y }, { x: box.x + box.width * 0.8, y });
  };
  const box = (name) => page.locator(`[data-field=${name}]`);
  const look = async () => [await digest(page), await page.evaluate(() => swivelPage.fields.SHOULDER_CONE.box.querySelector('input[type=range]').value)];
  const steps = [() => pull(page, 'target', 50, 30), () => pull(page, 'pole', 50, 30), () => letGo(page).click(), () => pull(page, 'cone', 50, 30), () => sweep('Opening'),
    () => box('SHOULDER_CONE').uncheck(), () => box('FLEXION_LIMIT').check(), async () => { await everyone(page).check(); await pull(page, 'target', 50, 30); },
    () => letAllGo(page).click()];
  assert.equal(await undo(page).isVisible(), false);
  const seen = [await look()];
  for (const step of steps) {
    await step();
    seen.push(await look());
  }
  const last = seen.pop();
  assert.notDeepEqual(last, seen.at(-1));
  assert.equal(await page.evaluate(() => swivelPage.undo.before.length), seen.length);
  await page.locator('canvas').focus();
  while (seen.length > 0) {
    await (seen.length % 2 ? page.keyboard.press('Control+z') : undo(page).click());
    assert.deepEqual(await look(), seen.pop(), `step ${seen.length}`);
  }
  await page.keyboard.press('Control+z');
  assert.deepEqual([await undo(page).isVisible(), await box('SHOULDER_CONE').isChecked(), await state(page)], [false, true, 'equal']);
}, link);

onPage('keys with Ctrl do nothing else, and the last 64 steps are kept', () => undone, async (page) => {
  await page.keyboard.press('Control+h');
  await page.keyboard.press('z');
  assert.equal(await page.locator('dialog').isVisible(), false);
  await pull(page, 'target', -30, 0);
  await page.evaluate(() => { for (let n = 0; n < 70; ++n) swivelPage.letAllGo(); });
  assert.equal(await page.evaluate(() => swivelPage.undo.before.length), 64);
}, link);

// ---- tables
const crowd = ['view', clip, '--characters', '6', '--frames', '10'];
async function save(page, name) {
  const [download] = await Promise.all([page.waitForEvent('download'), table(page).click()]);
  await download.saveAs(join(process.env.WORK, name));
  return readFileSync(join(process.env.WORK, name), 'utf8').trim().split('\n');
}
/** A page that the command makes of a table has these digests, which are its own. */
async function assertSolved(name, words, saved, wanted) {
  await visit(write(name, ...words, '--targets', join(process.env.WORK, saved)), async (page) => {
    assert.deepEqual(await digests(page, range(10)), wanted.map(([bits]) => [bits, 'equal']));
  });
}
const near = async (page, name, character) => {
  await choose(page, name, character);
  await page.evaluate((who) => swivelPage.view.lookAt(who, true), character);
};

onPage('a table has goals of one and of everyone, targets and poles', () => write('save.html', ...crowd), async (page) => {
  assert.equal(await table(page).isVisible(), false);
  await near(page, 'left_arm', 2);
  await pull(page, 'target', -30, -25);
  await page.evaluate(() => swivelPage.setFrame(7));
  await pull(page, 'pole', 60, 20);
  await near(page, 'right_arm', 4);
  await everyone(page).check();
  await pull(page, 'target', 20, -35);
  const before = await digest(page), [header, ...rows] = await save(page, 'saved.csv');
  assert.deepEqual(await page.evaluate(() => { swivelPage.stage.solve(); return [swivelPage.stage.frame, swivelPage.stage.digest()]; }), [7, before]);
  assert.equal(header, 'frame,character,limb,x,y,z,pole_x,pole_y,pole_z');
  assert.equal(rows.length, 10 * 7);
  const kinds = rows.map((row) => row.split(',')).map(([, character, limb, , , , ...pole]) => `${limb} ${character} ${pole.every((cell) => cell !== '')}`);
  assert.deepEqual([...new Set(kinds)].sort(), ['left_arm 2 true', ...range(6).map((n) => `right_arm ${n} false`)]);
  const dragged = await digests(page, range(10));
  assert.ok(dragged.every(([, isEqual]) => isEqual === 'changed'));
  await assertSolved('saved.html', crowd, 'saved.csv', dragged);
});

test('a table has a crowd file\'s offsets once, everyone\'s poles that are directions, and state', async () => {
  const toml = file('save.toml', '[limb.all]\ntarget.offset = [0.3, 2.1, -1.7]\npole.kind = "direction"\nswivel.max_deg_per_frame = 3\n'), words = [...crowd, '--crowd', toml];
  await visit(write('save_offset.html', ...words), async (page) => {
    await near(page, 'right_arm', 1);
    await everyone(page).check();
    await pull(page, 'pole', 50, 30);
    await everyone(page).uncheck();
    await pull(page, 'target', 25, -20);
    await save(page, 'saved_offset.csv');
    await assertSolved('saved_offset.html', words, 'saved_offset.csv', await digests(page, range(10)));
  });
});

test('what a table does not hold is said, and too many rows are refused', async () => {
  const toml = file('fixed.toml', '[limb.all]\npole.fixed = [0, -20, -40]\n');
  await visit(write('lacks.html', ...crowd, '--crowd', toml), async (page) => {
    const lack = () => page.getByText('The table does not hold').allTextContents();
    await near(page, 'left_arm', 2);
    await pull(page, 'target', -20, -20);
    assert.deepEqual(await lack(), []);
    await pull(page, 'pole', 50, 0);
    await page.evaluate(() => swivelPage.fields.REACH.box.querySelector('[data-field]').click());
    assert.deepEqual(await lack(), ['The table does not hold limits and weights, nor poles that the crowd file sets.']);
    const rows = await save(page, 'lacks.csv');
    assert.ok(rows.length === 11 && rows[1].endsWith(',,,'), rows[1]);
    await page.evaluate(() => { swivelPage.stage.frameCount = 2_000_001; });
    await table(page).click();
    assert.match(await page.textContent('.notice'), /^This table would have 2,000,001 rows, and 2,000,000 are the most/);
  }, { spoils: true });
});
