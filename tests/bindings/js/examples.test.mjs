// SPDX-License-Identifier: MIT
// The promise: the README's programs and the example page do what they say.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { close, swivel, wasm } from './common.mjs';

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
