// SPDX-License-Identifier: MIT
// All tests of the page in one process, so in one browser: node tests/page/all.mjs, or node --test-name-pattern=TEXT tests/page/all.mjs
// for some, with the variables that web.cmake sets.
import { readdirSync } from 'node:fs';

for (const name of readdirSync(new URL('.', import.meta.url)).sort())
  if (name.endsWith('.test.mjs')) await import(`./${name}`);
