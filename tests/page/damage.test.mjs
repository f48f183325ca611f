// SPDX-License-Identifier: MIT
// The promise: a page whose file was cut or changed says so, and shows no crowd.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { refusal, tiny as place, visit } from './harness.mjs';

const whole = readFileSync(place);
const script = whole.indexOf('<script'), end = whole.indexOf('</script>');
const spread = (from, to, count) => Array.from({ length: count }, (_, n) => Math.floor(from + (to - from) * (n + 0.5) / count));

async function shown(bytes) {
  const damaged = `${place}.damaged.html`;
  writeFileSync(damaged, bytes);
  return refusal(damaged);
}

test('a page that is cut anywhere behind its head', async () => {
  const sentence = whole.indexOf('</p>');
  assert.ok(sentence < 800, 'the sentence comes early');
  for (const at of [sentence, script, script + 10, ...spread(script, end, 2), end - 1, end, end + 8])
    assert.match(await shown(whole.subarray(0, at)), /^This page has not arrived whole\. If this stays, its file is cut or damaged/, `cut at ${at} of ${whole.length}`);
});

test('a page of whose program or data one bit was changed', async () => {
  const data = whole.indexOf('swivelView.start('), begin = whole.indexOf('>', script) + 1;
  assert.ok(begin < data && data < end);
  for (const at of [...spread(script + 21, script + 37, 2), ...spread(begin, data, 3), ...spread(data + 20, end, 3)]) {
    const bytes = Buffer.from(whole);
    bytes[at] ^= 1;
    assert.match(await shown(bytes), /^This page (has not arrived whole|is damaged: its data are not those that swivel view wrote)/, `bit 0 of byte ${at}`);
  }
});

test('a page that is whole shows its crowd and no sentence', async () => {
  await visit(place, async (page) => assert.equal(await page.locator('.refusal').count(), 0), { isJudged: true });
});
