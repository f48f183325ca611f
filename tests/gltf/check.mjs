// SPDX-License-Identifier: MIT
// What others make of glTF files, as JSON on stdout, for the tests.
//   node check.mjs validate FILE...             Khronos' validator: each file's messages, of every severity
//   node check.mjs pose FILE ANIMATION TIME...  three.js: world matrices (column after column) of all nodes at each time
import { readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import validator from 'gltf-validator';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

async function validate(file) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    maxIssues: 0,
    externalResourceFunction: async (uri) => new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
  });
  return { file, errors: report.issues.numErrors, messages: report.issues.messages };
}

// What a browser has and node does not. No picture is needed, so each is one pixel.
globalThis.self = globalThis;
globalThis.createImageBitmap = async () => ({ width: 1, height: 1, close() {} });
globalThis.ProgressEvent = class {};
THREE.FileLoader.prototype.load = function (url, onLoad, onProgress, onError) {
  const source = url.startsWith('data:') || url.startsWith('blob:') ? url : undefined;
  const bytes = source ? fetch(source).then((r) => r.arrayBuffer()) : readFile(decodeURIComponent(url)).then((b) => new Uint8Array(b).buffer);
  bytes.then(onLoad, onError);
};

async function pose(file, animation, times) {
  const bytes = new Uint8Array(await readFile(file)).buffer;
  const gltf = await new GLTFLoader().parseAsync(bytes, dirname(file) + '/');
  const count = gltf.parser.json.nodes.length;
  const nodes = [];
  for (let n = 0; n < count; ++n) nodes.push(await gltf.parser.getDependency('node', n));
  const root = new THREE.Group();
  for (const node of nodes) if (!node.parent || !nodes.includes(node.parent)) root.add(node);
  const mixer = new THREE.AnimationMixer(root);
  const action = mixer.clipAction(gltf.animations[animation]);
  action.setLoop(THREE.LoopOnce).clampWhenFinished = true;
  action.play();
  return times.map((time) => {
    mixer.setTime(time);
    root.updateMatrixWorld(true);
    return nodes.map((node) => node.matrixWorld.toArray());
  });
}

const [command, ...rest] = process.argv.slice(2);
let answer;
if (command === 'validate') answer = await Promise.all(rest.map(validate));
if (command === 'pose') answer = await pose(rest[0], Number(rest[1]), rest.slice(2).map(Number));
if (!answer) throw new Error('validate FILE... or pose FILE ANIMATION TIME...');
process.stdout.write(JSON.stringify(answer));
