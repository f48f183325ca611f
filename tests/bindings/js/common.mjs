// SPDX-License-Identifier: MIT
// What the tests of the package for the web share. They run beside an installed swivel-wasm, by `node --test`.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { load, SwivelError } from 'swivel-wasm';

export const swivel = await load();
export const wasm = readFileSync(new URL('./node_modules/swivel-wasm/swivel.wasm', import.meta.url));

// A call throws a SwivelError of one line, with this text in it.
export const refuses = (act, text) =>
  assert.throws(act, (error) => error instanceof SwivelError && error.message.includes(text) && !error.message.includes('\n') || assert.fail(error));

export const close = (a, b, within) => a.forEach((x, n) => assert.ok(Math.abs(x - b[n]) <= within, `${a} is not ${b}`));
export const unit = (q) => q.map((x) => x / Math.hypot(...q));

const slant = unit([0.2, 0.4, -0.4, 0.8]);
// A skeleton of three joints that are turned at rest, and the limb that they are.
export const slanted = { parents: [-1, 0, 1], translations: [0, 0, 0, 0.3, 0, 0, 0.25, 0.02, 0], rotations: [...slant, ...unit([0.1, 0, 0, 1]), ...slant] };
export const limb = { shoulder: 0, elbow: 1, wrist: 2, bend: [0, 0, 1] };
