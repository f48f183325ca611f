// SPDX-License-Identifier: MIT
// The promise: the package has every name of swivel.h, with its number. Bits are in scenes.test.mjs.
//   HEADER: swivel.h
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { defaultFit, defaultGround, defaultPlant, defaultProp, Feature, Field, Flag, LANES, MOST_TWIST_BONES, OnBadInput, Order, PoseForm, PoseSpace, Status, VERSION } from 'swivel-wasm';

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
