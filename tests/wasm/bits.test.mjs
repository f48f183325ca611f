// SPDX-License-Identifier: MIT
// The promise: the package gives the native library's bits, and has every name of swivel.h.
//   ARM: swivel's build of tests/package/arm.c. HEADER: swivel.h
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { defaultFit, defaultGround, defaultPlant, defaultProp, Feature, Field, Flag, LANES, MOST_TWIST_BONES, OnBadInput, Order, PoseForm, PoseSpace, Status, VERSION } from 'swivel-wasm';
import { swivel } from './common.mjs';

// The arms of tests/package/arm.c.
function manyArms() {
  const targets = new Float32Array(3000);
  let random = 1;
  for (let n = 0; n < targets.length; ++n) {
    random = (Math.imul(random, 1664525) + 1013904223) >>> 0;
    targets[n] = Math.fround(0.04) + Math.fround(Math.fround(random >>> 8) * Math.fround(Math.fround(0.26) / 16777216));
  }
  return targets;
}

test('the same bits as the native library', () => {
  const line = execFileSync(process.env.ARM, { encoding: 'utf8' });
  assert.equal(swivel.isaName, 'sse2');
  const crowd = swivel.crowd([1000]);
  crowd.write(Field.TARGET, manyArms());
  crowd.write(Field.POLE, [0.25, -1, 0.125]);
  crowd.write(Field.LENGTHS, [0.3, 0.26]);
  assert.equal(crowd.solve(), 1000);
  assert.ok(crowd.residuals().every((off) => off < 1e-6));
  assert.ok(line.endsWith(`digest ${crowd.digest().toString(16).padStart(16, '0')}\n`), line);
  crowd.dispose();
});

test('digests are unsigned, and differ with any result', () => {
  const crowd = swivel.crowd([1]), seen = new Set();
  crowd.write(Field.LENGTHS, [1, 1]);
  for (let n = 0; n < 64; ++n) {
    crowd.write(Field.TARGET, [0.01 * n, 0.5, 1]), crowd.solve();
    assert.ok(crowd.digest() >= 0n);
    seen.add(crowd.digest());
  }
  assert.equal(seen.size, 64);
  crowd.dispose();
});

test('every name of swivel.h, with its number', () => {
  const header = readFileSync(process.env.HEADER, 'utf8').replace(/\/\/.*/g, '');
  assert.deepEqual(Feature, Object.fromEntries([...header.matchAll(/#define SWIVEL_(\w+) \(UINT64_C\(1\) << (\d+)\)/g)].map(([, name, bit]) => [name, 1n << BigInt(bit)])));
  const numbersOf = (name) => {
    let next = 0;
    const members = header.match(new RegExp(`typedef enum ${name} \\{(.*?)\\}`, 's'))[1].split(',').map((text) => text.trim()).filter(Boolean);
    return Object.fromEntries(members.map((text) => {
      const [key, given] = text.split('=').map((part) => part.trim());
      const value = given ? Number(new Function(`return ${given.replace(/u/g, '')}`)()) : next;
      next = value + 1;
      return [key.replace('SWIVEL_', ''), value];
    }).filter(([key]) => !key.endsWith('_END')));
  };
  for (const [names, kind] of [[Field, 'field'], [Flag, 'flag'], [Order, 'euler_order'], [OnBadInput, 'on_bad_input'], [PoseForm, 'pose_form'], [PoseSpace, 'pose_space'], [Status, 'status']])
    assert.deepEqual({ ...names }, numbersOf(`swivel_${kind}`));
  for (const [constants, name] of [[defaultPlant, 'plant'], [defaultFit, 'fit'], [defaultGround, 'ground'], [defaultProp, 'prop']]) {
    const [, numbers] = header.match(new RegExp(`const swivel_${name} \\w+ = \\{(.*?)\\};`, 's'));
    assert.deepEqual(Object.values(constants).flat(), numbers.replace(/[{}f]/g, '').split(',').map(Number));
    const [, members] = header.match(new RegExp(`typedef struct swivel_${name} \\{(.*?)\\} swivel_${name};`, 's'));
    assert.deepEqual(Object.keys(constants), members.match(/\w+(?=[,;[])/g).map((member) => member.replace(/_(.)/g, (_, letter) => letter.toUpperCase())));
  }
  assert.equal(LANES, 16);
  assert.equal(MOST_TWIST_BONES, 7);
  assert.deepEqual(VERSION.split('.'), ['MAJOR', 'MINOR', 'PATCH'].map((part) => header.match(new RegExp(`SWIVEL_VERSION_${part} (\\d+)`))[1]));
});
