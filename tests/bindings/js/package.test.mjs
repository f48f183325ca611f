// SPDX-License-Identifier: MIT
// The promise: the package has every name of the public headers, with its number, and loads from bytes, a response or an address. The README's programs and
// the example page do what they say. Bits are in scenes.test.mjs.
//   INCLUDE: the folder of the headers
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { defaultGround, defaultPlant, defaultProp, defaultShift, Feature, Field, Flag, Kind, LANES, load, MAX_TWIST_BONES, OnBadInput, Order, PoseForm, PoseSpace, Status, SwivelError, VERSION } from 'swivel-wasm';
import { close, wasm } from './common.mjs';

test('every name of the public headers, with its number', () => {
  const header = ['swivel.h', 'swivel_bodies.h'].map((name) => readFileSync(join(process.env.INCLUDE, name), 'utf8')).join('').replace(/\/\/.*/g, '');
  assert.deepEqual(Feature, Object.fromEntries([...header.matchAll(/#define SWIVEL_(\w+) \(UINT64_C\(1\) << (\d+)\)/g)].map(([, name, bit]) => [name, 1n << BigInt(bit)])));
  const numbersOf = (name) => {
    let next = 0;
    const members = header.match(new RegExp(`typedef enum ${name} \\{(.*?)\\}`, 's'))[1].split(',').map((text) => text.trim()).filter(Boolean);
    return Object.fromEntries(members.map((text) => {
      const [key, given] = text.split('=').map((part) => part.trim());
      const value = given ? Number(new Function(`return ${given.replace(/u/g, '')}`)()) : next;
      next = value + 1;
      return [key.replace(/SWIVEL_(KIND_)?/, ''), value];
    }).filter(([key]) => !key.endsWith('_END')));
  };
  for (const [names, kind] of [[Field, 'field'], [Flag, 'flag'], [Order, 'euler_order'], [OnBadInput, 'on_bad_input'], [PoseForm, 'pose_form'], [PoseSpace, 'pose_space'], [Status, 'status'], [Kind, 'kind']])
    assert.deepEqual({ ...names }, numbersOf(`swivel_${kind}`));
  for (const [constants, name] of [[defaultPlant, 'plant'], [defaultShift, 'shift_def'], [defaultGround, 'ground'], [defaultProp, 'prop_def']]) {
    const [, numbers] = header.match(new RegExp(`const swivel_${name} \\w+ = \\{(?:sizeof\\(\\w+\\), )?(.*?)\\};`, 's'));
    assert.deepEqual(Object.values(constants).flat(), numbers.replace(/[{}f]/g, '').split(',').map(Number));
    const [, members] = header.match(new RegExp(`typedef struct swivel_${name} \\{(?:\\s*size_t size;)?(.*?)\\} swivel_${name};`, 's'));
    assert.deepEqual(Object.keys(constants), members.match(/\w+(?=[,;[])/g).map((member) => member.replace(/_(.)/g, (_, letter) => letter.toUpperCase())));
  }
  assert.equal(LANES, 16);
  assert.equal(MAX_TWIST_BONES, 7);
  assert.deepEqual(VERSION.split('.'), ['MAJOR', 'MINOR', 'PATCH'].map((part) => header.match(new RegExp(`SWIVEL_VERSION_${part} (\\d+)`))[1]));
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
  [/15\.07/, /^100\n$/, /true\n$/, /^true/].forEach((what, n) => assert.match(said[n], what));
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
