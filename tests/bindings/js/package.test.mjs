// SPDX-License-Identifier: MIT
// The promise: the package has every name of the public headers, with its number, and loads from bytes, a response or an address. The README's programs and
// the example page do what they say. Bits are in scenes.test.mjs.
//   HEADERS: their description, headers.json
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { defaultGround, defaultPlant, defaultProp, defaultShift, Feature, Field, Flag, Kind, LANES, load, MAX_TWIST_BONES, OnBadInput, Order, PoseForm, PoseSpace, Status, SwivelError, VERSION } from 'swivel-wasm';
import { close, wasm } from './common.mjs';

test('every name of the public headers, with its number', () => {
  const headers = Object.values(JSON.parse(readFileSync(process.env.HEADERS, 'utf8')));
  const [constants, enumerations, structures] = ['constants', 'enumerations', 'structures'].map((kind) => Object.assign({}, ...headers.map((header) => header[kind])));
  const numbersOf = (name, numberOf = Number) => Object.fromEntries(Object.entries(enumerations[`swivel_${name}`]).filter(([key]) => !key.endsWith('_END'))
    .map(([key, value]) => [key.replace(/SWIVEL_(KIND_)?/, ''), numberOf(value)]));
  assert.deepEqual({ ...Feature }, numbersOf('features', BigInt));
  for (const [names, kind] of [[Field, 'field'], [Flag, 'flag'], [Order, 'euler_order'], [OnBadInput, 'on_bad_input'], [PoseForm, 'pose_form'], [PoseSpace, 'pose_space'], [Status, 'status'], [Kind, 'kind']])
    assert.deepEqual({ ...names }, numbersOf(kind));
  for (const [constants, name] of [[defaultPlant, 'plant'], [defaultShift, 'shift_def'], [defaultGround, 'ground'], [defaultProp, 'prop_def']]) {
    const members = Object.entries(structures[`swivel_${name}`].members).filter(([name]) => name !== 'size');
    assert.deepEqual(Object.entries(constants), members.map(([member, { default: value }]) => [member.replace(/_(.)/g, (_, letter) => letter.toUpperCase()), value]));
  }
  assert.equal(LANES, 16);
  assert.equal(MAX_TWIST_BONES, 7);
  assert.deepEqual(VERSION.split('.').map(Number), ['MAJOR', 'MINOR', 'PATCH'].map((part) => constants[`SWIVEL_VERSION_${part}`]));
});

test('load() takes bytes, a response or an address, and says what is wrong', async () => {
  for (const source of [wasm, new Response(wasm), `data:application/wasm;base64,${wasm.toString('base64')}`, undefined])
    assert.equal((await load({ wasm: source })).isaName, 'sse2');
  for (const [given, says] of [
    [{ megabytes: 1 }, 'megabytes is 1; give 2 to 4096'],
    [{ memory: 8 }, 'load() takes megabytes, wasm, not memory'],
    [8, 'load() takes megabytes, wasm, not 8'],
    [{ wasm: new Uint8Array(8) }, 'what came is not swivel.wasm'],
    [{ wasm: new Response('<!doctype html>') }, 'it starts with "<!do"'],
    [{ wasm: wasm.subarray(0, 5000) }, 'or the file is damaged'],
    [{ wasm: new Response('', { status: 404 }) }, '404'],
  ]) await assert.rejects(load(given), (error) => error instanceof SwivelError && error.message.includes(says) || assert.fail(error));
});

test("the README's programs", () => {
  const readme = readFileSync(new URL('./node_modules/swivel-wasm/README.md', import.meta.url), 'utf8');
  const programs = [...readme.matchAll(/```js\n(.*?)```/gs)].map(([, program]) => program).filter((program) => program.includes('console.log'));
  const said = programs.map((program) =>
    execFileSync(process.execPath, ['--input-type=module', '--eval', program], { encoding: 'utf8', cwd: dirname(fileURLToPath(import.meta.url)) }));
  [/^100 true\n$/, /15\.07/].forEach((what, n) => assert.match(said[n], what));
});

test('the example page moves both wrists of a three.js skeleton to their targets', async () => {
  const page = readFileSync(new URL('./node_modules/swivel-wasm/examples/arms.html', import.meta.url), 'utf8');
  assert.ok(page.trimEnd().split('\n').length <= 40);
  let frame, shown;
  Object.assign(globalThis, { innerWidth: 8, innerHeight: 5, document: { body: { append() {} } } });
  globalThis.TestRenderer = class {  // no graphics here: it takes the frames
    setSize() {}
    setAnimationLoop(act) { frame = act; }
    render(scene) { scene.updateMatrixWorld(), shown = scene; }
  };
  const script = page.match(/<script type="module">(.*?)<\/script>/s)[1].replace('new THREE.WebGLRenderer(', 'new TestRenderer(');
  writeFileSync(new URL('./page.mjs', import.meta.url), `${script}\nglobalThis.pageArms = arms;`);
  await import('./page.mjs');
  const places = [100, 900].map((time) => {
    frame(time);
    return globalThis.pageArms.map(({ hand, target }) => {
      const place = [...hand.matrixWorld.elements.slice(12, 15)];
      close(place, [...target], 1e-6);
      return place;
    });
  });
  assert.ok(shown.children.length > 1);
  for (const side of [0, 1]) assert.ok(Math.hypot(...places[0][side].map((x, n) => x - places[1][side][n])) > 0.1);
});
