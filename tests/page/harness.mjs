// SPDX-License-Identifier: MIT
//
// Opens pages in headless Chromium. A page that asks anything of a network, or says anything on its console, fails its test.
//   SWIVEL: the command. CHROMIUM. WORK: a folder for pages.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { close, forget, keep, leave, open, show, take } from './tabs.mjs';

const { SWIVEL, WORK } = process.env;
export const clip = ['/usr/share/assimp/models/BVH/01_01.bvh', `${process.env.SWIVEL_TEST_DATA}/bvh/cmu_01_01_forward_jump.bvh`].find((file) => existsSync(file));
after(close);

/** Writes a file into the folder for pages. */
export function file(name, text) {
  writeFileSync(join(WORK, name), text);
  return join(WORK, name);
}
/** Writes a page by the command, and returns its place. */
export function write(name, ...words) {
  const file = join(WORK, name);
  forget(file);
  execFileSync(SWIVEL, [...words, words[0] === 'view' ? '--out' : '--view', file], { cwd: WORK, stdio: 'pipe' });
  return file;
}
/** A crowd of 12 for all tests that need no other one. */
export const demo = write('demo.html', 'demo', '--characters', '12');
keep(demo);
/** A page as small as they come. */
export const tiny = write('tiny.html', 'demo', '--characters', '2', '--frames', '3');
export const run = (...words) => spawnSync(SWIVEL, words, { cwd: WORK, encoding: 'utf8' });

/**
 * Opens a page, which stands still; use gets playwright's page. before: run in the page before its script. isFresh: opens it, though a test
 * has left it open. spoils: it is not for other tests. reducedMotion, colorScheme: of the system. options: of a context.
 */
export async function visit(file, use, { before, hash = '', isFresh = false, spoils = false, reducedMotion = 'reduce', colorScheme = 'light', ...options } = {}) {
  const tab = await take(file, { viewport: { width: 800, height: 500 }, ...options }, isFresh);
  let isGood = false;
  try {
    await show(tab, file, { hash, media: { reducedMotion, colorScheme }, isFresh, before });
    await tab.page.evaluate(() => innerWidth > 760 && document.body.classList.contains('wide') && window.swivelPage?.togglePanel?.());
    await use(tab.page);
    assert.deepEqual(tab.faults, []);
    isGood = !spoils;
  } finally {
    leave(tab, isGood);
  }
}

/** A test of one page. make: gives its file. use, options: as visit() has them. */
export const onPage = (name, make, use, options) => test(name, () => visit(make(), use, options));
/** Looks at character 3 of the demo from near; its left arm is chosen by a link. */
export const link = { hash: '#frame=20&character=3&limb=left_arm' };
export const onDemo = (name, use, options = link) => onPage(name, () => demo, use, options);

/** What a page shows in place of a crowd. before: as visit() has it. */
export async function refusal(place, { before } = {}) {
  const tab = await take(place, { viewport: { width: 800, height: 500 } });
  try {
    await open(tab, '', before);
    await tab.page.evaluate(() => document.getAnimations().forEach((each) => each.finish()));  // what comes after a second
    return await tab.page.innerText('.refusal', { timeout: 10_000 });
  } finally {
    leave(tab, false);
  }
}

/** A page's text with the digest that its script has now: FNV-1a of 64 bits. */
export function signed(text) {
  const begin = text.indexOf('data-digest="') + 13, script = Buffer.from(text.slice(begin + 18, text.indexOf('</script>')));
  const digest = script.reduce((sum, byte) => BigInt.asUintN(64, (sum ^ BigInt(byte)) * 0x100000001b3n), 0xcbf29ce484222325n);
  return text.slice(0, begin) + digest.toString(16).padStart(16, '0') + text.slice(begin + 16);
}

/** Where a part of the chosen limb is on the page: a joint, a goal ("target", "pole"), or another handle ("cone", "hips", "ground"). */
export const pixel = (page, part) => page.evaluate((which) => {
  const { stage, view, picker: { handles }, selection: { limb, character } } = swivelPage;
  if (which === 'target' || which === 'pole') return view.project(stage.goal(limb, character, which));
  if (which in handles) return view.project(view.toClip(handles[which].getWorldPosition(view.camera.position.clone())));
  return view.project(stage.pose(limb, character)[which]);
}, part);

/** Chooses a character's limb by its name. Without one, nothing is chosen. */
export const choose = (page, name, character) => page.evaluate(([which, who]) => {
  swivelPage.select(which && { limb: limbOf(which), character: who });
  swivelPage.draw();
}, [name, character]);

/** Digests of frames, each with whether it is the command's: "equal", or "changed" by the user. */
export const digests = (page, frames) => page.evaluate((list) => list.map((frame) => {
  swivelPage.setFrame(frame);
  return [swivelPage.stage.digest(), swivelPage.stage.digestState()];
}), frames);
export const digest = (page) => page.evaluate(() => swivelPage.stage.digest());
export const state = (page) => page.evaluate(() => swivelPage.stage.digestState());
export const assertEqualBits = async (page, frames) => assert.deepEqual((await digests(page, frames)).map(([, state]) => state), frames.map(() => 'equal'));
export const range = (count) => [...Array(count).keys()];

/** How much of the picture differs between two moments, as a share of its pixels. */
export async function difference(page, act) {
  const take = () => page.evaluateHandle(() => {  // its pixels stay in the page
    window.isSeen = true;
    swivelPage.draw();
    const from = document.querySelector('canvas'), small = document.createElement('canvas'), context = small.getContext('2d');
    [small.width, small.height] = [320, 200];
    context.drawImage(from, 0, 0, 320, 200);
    window.isSeen = false;
    return context.getImageData(0, 0, 320, 200).data;
  });
  const before = await take();
  await act();
  await page.evaluate(() => new Promise(requestAnimationFrame));  // details tell of their opening later
  const after = await take();
  return page.evaluate(([a, b]) => {
    const colours = new Set();
    let count = 0;
    for (let n = 0; n < a.length; n += 4) {
      count += [0, 1, 2].some((c) => Math.abs(a[n + c] - b[n + c]) > 12);
      colours.add(a[n] << 16 | a[n + 1] << 8 | a[n + 2]);
    }
    return { share: count / (a.length / 4), colours: colours.size };
  }, [before, after]);
}

/** Waits until a value that the page gives is one that is wanted. */
export async function until(page, value, isWanted) {
  for (let tries = 0; tries < 200; ++tries) {
    if (isWanted(await page.evaluate(value))) return;
    await page.waitForTimeout(50);
  }
  assert.fail(`${value} did not come`);
}

/** A drag of a goal or handle of the chosen limb by so many pixels. Returns where it began. */
export async function pull(page, part, x, y) {
  const from = await pixel(page, part);
  await drag(page, from, { x: from.x + x, y: from.y + y });
  return from;
}
/** A drag of the mouse from one place to another, in steps. */
export async function drag(page, from, to) {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
  await page.mouse.move(to.x, to.y);
  await page.mouse.up();
}
