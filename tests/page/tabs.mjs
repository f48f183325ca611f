// SPDX-License-Identifier: MIT
//
// Pages that stay open. An opening takes a second of a CPU or two, so a page that a test has left is made new by its own means:
// what was changed is taken back. A page that does not become what it was at first is opened again.
import { chromium } from 'playwright-core';

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--enable-unsafe-swiftshader', '--use-gl=angle', '--use-angle=swiftshader', '--webgl-antialiasing-mode=none'],
});
export const close = () => browser.close();

/** Draws on the canvas only while window.isSeen is set: SwiftShader takes 0.1 s for a picture, and 1 s for the first. Readbacks draw elsewhere. */
function drawIfSeen() {
  const { prototype } = WebGL2RenderingContext;
  for (const name of ['drawArrays', 'drawArraysInstanced', 'drawElements', 'drawElementsInstanced', 'drawRangeElements']) {
    const draw = prototype[name];
    prototype[name] = function (...words) {
      if (window.isSeen || this.getParameter(this.FRAMEBUFFER_BINDING) !== null) draw.apply(this, words);
    };
  }
}

/** In the page: what tests ask of it again and again. */
function help() {
  window.limbOf = (name) => swivelPage.stage.limbs.find((limb) => limb.name === name);
  window.apart = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis]));
  /** How far the shader has elbows and wrists from where the library has them, in limb lengths, at worst. characters: those that are drawn. */
  window.worstDrawn = (characters) => {
    const { stage } = swivelPage;
    swivelPage.draw();
    return Math.max(...stage.limbs.flatMap((limb) => {
      const drawn = swivelPage.readback(limb, characters.length);
      return characters.flatMap((who, n) => ['elbow', 'wrist'].map((joint, which) => {
        const { place } = stage.characters[who], at = stage.pose(limb, who)[joint].map((x, axis) => x - place[axis]);
        return window.apart(at, drawn[2 * n + which]) / stage.armLength(limb, who);
      }));
    }));
  };
}

/** In the page, once it is ready: remembers how it is, and defines window.renew(). */
function remember() {
  const { stage, view, drawnCount, theme } = swivelPage, { size, covered } = view, { className } = document.body;
  const inputs = [...document.querySelectorAll('input, select')], folds = [...document.querySelectorAll('details')];
  /** All of the page that is not hidden, and the camera; how fast it solves is left out. */
  const look = () => {
    const { camera, controls, followed } = view;
    const parts = [...document.body.children].filter(({ tagName }) => tagName !== 'SCRIPT').map((part) => part.cloneNode(true));
    for (const part of parts) part.querySelectorAll('.speed, [hidden]').forEach((each) => each.remove());
    const states = inputs.map(({ value, checked, indeterminate, disabled }) => [value, checked, indeterminate, disabled]);
    const numbers = [...camera.position.toArray(), ...controls.target.toArray()].map((number) => number.toFixed(6));
    return [...parts.map(({ outerHTML }) => outerHTML), ...states, ...numbers, document.body.className, stage.frame, stage.digest(), followed, swivelPage.drawnCount, swivelPage.theme].join('\n');
  };
  const { changes } = stage, first = look(), values = inputs.map(({ value, checked }) => ({ value, checked })), open = folds.map((fold) => fold.open);
  const putChangesBack = () => stage.restore({ ...changes, pins: new Map(changes.pins) });
  const putBack = (input, { value, checked }) => {
    if (input.value === value && input.checked === checked) return;
    Object.assign(input, input.type === 'checkbox' ? { checked } : { value });
    input.dispatchEvent(new Event(input.type === 'range' ? 'input' : 'change', { bubbles: true }));
  };
  /** Makes the page as it was; whether that went. */
  window.renew = async () => {
    swivelPage.player.pause();
    swivelPage.help.close();
    document.activeElement?.blur();
    putChangesBack();
    swivelPage.select(null);  // switches and sliders follow
    inputs.forEach((input, n) => putBack(input, values[n]));
    putChangesBack();
    Object.assign(swivelPage.undo, { before: [], gesture: null });
    Object.assign(swivelPage, { chosen: 0 });
    folds.forEach((fold, n) => { fold.open = open[n]; });
    const lesson = document.querySelector('.lesson'), step = parseInt(lesson.textContent, 10) || 1;
    for (let n = 1; n < step; ++n) lesson.querySelector('button').click();
    lesson.querySelectorAll(':scope > :not(.row)').forEach((each) => each.replaceChildren());
    document.body.className = className;
    swivelPage.setTheme(theme);
    swivelPage.lead(null);
    stage.setFrame(0);
    swivelPage.drawFirst(drawnCount);
    await new Promise(requestAnimationFrame);  // folds tell of it later
    view.resize(size.width, size.height, covered.right, covered.top, covered.bottom);  // how fast it solves takes a line or two
    swivelPage.home();
    swivelPage.follow(stage.characterCount === 1);
    swivelPage.say('');
    swivelPage.canvas.style.cursor = '';
    return look() === first;
  };
}

const tabs = [];  // each: its page, its context's options as a key, the file that it shows, what went wrong, whether a test has it
const contexts = new Map();  // by their options: a new one opens a window of its own, which takes as long as a page

async function newTab(key) {
  if (!contexts.has(key)) contexts.set(key, await browser.newContext({ ...JSON.parse(key), reducedMotion: 'reduce' }));
  const page = await contexts.get(key).newPage(), devtools = await page.context().newCDPSession(page), tab = { page, devtools, key, faults: [] };
  page.on('console', (message) => {  // a driver's advice is about the test, which reads pixels
    if (!message.text().includes('GL Driver Message (OpenGL, Performance')) tab.faults.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => tab.faults.push(`error: ${error.message}`));
  page.on('dialog', (dialog) => tab.faults.push(`dialog: ${dialog.message()}`));
  page.on('request', (request) => { if (request.url() !== tab.url && !/^(blob|data):/.test(request.url())) tab.faults.push(`request: ${request.url()}`); });
  await devtools.send('Page.enable');
  await page.addInitScript(drawIfSeen);
  await page.addInitScript(help);
  tabs.push(tab);
  return tab;
}

const kept = new Set();
/** Tabs that show this file go on showing it. */
export const keep = (file) => kept.add(file);

/** A tab that shows nothing that must stay, or a new one. It must be left again. options: of a context. isFresh: not one that shows the file. */
export async function take(file, options, isFresh = false) {
  const key = JSON.stringify(options), free = tabs.filter((tab) => !tab.isTaken && tab.key === key);
  const tab = free.find((each) => !isFresh && each.file === file) ?? free.find((each) => !kept.has(each.file)) ?? await newTab(key);
  return Object.assign(tab, { isTaken: true, faults: [], url: `file://${encodeURI(file)}` });
}
/** isGood: it may show its file to another test. */
export function leave(tab, isGood) {
  tab.isTaken = false;
  if (!isGood) tab.file = null;
}
/** A page that is written again is another one. */
export const forget = (file) => tabs.filter((tab) => tab.file === file).forEach((tab) => { tab.file = null; });

/** Opens a tab's page. before: run in it before its script. */
export async function open({ page, url, devtools }, hash = '', before = null) {
  const script = before && await devtools.send('Page.addScriptToEvaluateOnNewDocument', { source: `(${before})()` });
  if (page.url().split('#')[0] === url) {  // going there would change the hash alone
    await page.evaluate((to) => history.replaceState(null, '', location.pathname + to), hash);
    await page.reload();
  } else {
    await page.goto(url + hash);
  }
  if (script) await devtools.send('Page.removeScriptToEvaluateOnNewDocument', script);
}
/** Shows a page, which stands still, as it is when it is opened. isFresh: opens it whatever the tab shows. */
export async function show(tab, file, { hash, media, isFresh, before }) {
  const { page, url } = tab, medium = JSON.stringify(media);
  await page.mouse.move(0, 0);
  if (!isFresh && !before && tab.file === file && tab.media === medium && await page.evaluate(() => window.renew())) return follow(page, hash);
  await page.emulateMedia(media);
  await open(tab, isFresh ? hash : '', before);
  const isCrowd = await page.evaluate(() => window.swivelPage?.ready.then(() => true));
  Object.assign(tab, { file: isCrowd && !isFresh && !before ? file : null, media: medium });
  if (!tab.file) return;
  await page.evaluate(remember);
  await follow(page, hash);
}
const follow = (page, hash) => hash && page.evaluate((to) => {
  history.replaceState(null, '', to);
  dispatchEvent(new Event('hashchange'));
}, hash);
