// SPDX-License-Identifier: MIT
// All tests of the page in one process, so in one browser: node tests/page/all.mjs, with --test-name-pattern=TEXT for some.
import { readdirSync } from 'node:fs';

for (const name of readdirSync(new URL('.', import.meta.url)).sort())
  if (name.endsWith('.test.mjs')) await import(`./${name}`);
