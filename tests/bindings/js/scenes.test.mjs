// SPDX-License-Identifier: MIT
// The promise: what goes in by the package's names goes to the library as it is, and what comes out is the library's. Crowds of the
// corpus are played frame by frame; their digests, poses and answers are those of C++.
//   SCENES: what tools/digest/print_scenes.cpp wrote
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { Feature, Field } from 'swivel-wasm';
import { refuses, swivel } from './common.mjs';

const scenes = JSON.parse(readFileSync(process.env.SCENES, 'utf8'));
const numbers = (values) => values.map((x) => x ?? NaN);  // null is NaN
const camel = (name) => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase());
// An object with names as the package has them. The fields of a structure's own members, too.
const named = (given) => (given?.constructor === Object ? Object.fromEntries(Object.entries(given).map(([name, value]) => [camel(name), named(value)])) : given);

function regionOf({ axes, angles, corners, directions, margin, max_cones, forbidden }) {
  const cones = axes.map((axis, n) => ({ axis, angle: angles[n] }));
  return swivel.region().addCones(cones, true).addPolygon(corners).addDirections(directions, margin, max_cones).forbid(forbidden).mirrored();
}
function groupOf({ features, region, ...given }) {
  const options = named(given);
  if (features) options.features = features.reduce((all, name) => all | Feature[name], 0n);
  return region ? { ...options, region: regionOf(region) } : options;
}
function crowdOf({ groups, skeleton, body_count, up, form, space, root_is_double }) {
  const all = groups.map(groupOf);
  return skeleton ? swivel.bodies({ skeleton, bodyCount: body_count, groups: all, up, form, space, rootIsDouble: Boolean(root_is_double) }) : swivel.crowd(all);
}

// isViewed: inputs go into views of the memory, which a solve takes in.
function give(crowd, { carried = [], inputs, doubles = [], pose = {} }, outputs, isViewed = false) {
  for (const { group, body, was, now } of carried) {
    const limbs = { group, first: body, count: 1 };
    if (was) crowd.changeSupport(was, now, limbs); else crowd.reset(limbs);
  }
  inputs.forEach((fields, group) => Object.entries(fields).forEach(([name, values]) => {
    if (isViewed && !doubles.length) crowd.values(Field[name.toUpperCase()], group).set(numbers(values));
    else crowd.write(Field[name.toUpperCase()], numbers(values), { group });
  }));
  doubles.forEach((fields, group) => Object.entries(fields).forEach(([name, values]) => crowd.positions(Field[name.toUpperCase()], group).set(numbers(values))));
  for (const [part, values] of Object.entries(pose)) crowd.pose(camel(part)).set(numbers(values));
  for (const part of outputs) crowd.pose(camel(part)).fill(0);
}

// FNV-1a of words, in which all NaN are one.
function digestOf(parts) {
  let hash = 0x811c9dc5;
  for (const values of parts) {
    const words = new Uint32Array(values.buffer, values.byteOffset, values.length);
    values.forEach((x, n) => (hash = Math.imul(hash ^ (Number.isNaN(x) ? 0x7fc00000 : words[n]), 0x01000193)));
  }
  return hash >>> 0;
}
function writtenParts({ space, outputs, frames }) {
  const has = (part) => outputs.includes(part) || part in frames[0].pose;
  const chosen = [['results', 'rotations'], space ? ['translation_results', 'translations'] : [], ['joint_rotations'], ['joint_positions']];
  return chosen.map((parts) => parts.find(has)).filter(Boolean).map(camel);
}

function* play(scene, crowd, isViewed) {
  const written = scene.skeleton ? writtenParts(scene) : [];
  for (const frame of scene.frames) {
    give(crowd, frame, scene.outputs ?? [], isViewed);
    const mask = Array.from({ length: Math.ceil(crowd.blockCount / 2) }, (_, word) => (word ? 0 : frame.mask));
    const solved = crowd.solve(frame.mask === undefined ? {} : { mask });
    yield { solved, digest: crowd.digest().toString(16), poses: digestOf(written.map((part) => crowd.pose(part))).toString(16) };
  }
}
const wanted = ({ solved, digest, poses }) => ({ solved, digest, poses });

test('frames have the digests of C++', () => {
  for (const scene of scenes) {
    const crowd = crowdOf(scene);
    let n = 0;
    for (const found of play(scene, crowd)) assert.deepEqual(found, wanted(scene.frames[n]), `${scene.name}, frame ${n++}`);
    scene.answers.forEach(({ explain, allowed_arcs, joint_angles, ...answers }, group) => {
      const { shoulder_order, wrist_order } = scene.groups[group], place = { group };
      // The angles' last bits are the platform's own mathematical functions'.
      const same = (found, wanted) => {
        assert.equal(found.length, wanted.length);
        numbers(wanted).forEach((x, n) => assert.ok(Object.is(found[n], x) || Math.abs(found[n] - x) <= 1e-14 * Math.abs(x), `${scene.name}, group ${group}: ${found}`));
      };
      assert.equal(crowd.explain(0, group), explain);
      for (const [name, values] of Object.entries(answers)) same(crowd[name](place), values);
      same(crowd.jointAngles({ group, shoulderOrder: wrist_order, wristOrder: shoulder_order, family: 1 }), joint_angles);
      same(crowd.allowedArcs(0, group).flatMap(({ from, to }) => [...from, ...to]), allowed_arcs.map(Math.fround));
    });
    crowd.dispose();
  }
});

test('views of every field have the same bits, in and out', () => {
  const seen = new Set();
  for (const scene of scenes) {
    const crowd = crowdOf(scene), views = [], isInDoubles = (field) => scene.frames.some(({ doubles = [] }) => doubles.some((fields) => Object.keys(fields).some((name) => Field[name.toUpperCase()] === field)));
    for (let group = 0; group < crowd.groupCount; ++group)
      for (const field of Object.values(Field)) if (crowd.componentCount(field, group) > 0 && !isInDoubles(field)) views.push({ field, group, view: crowd.values(field, group) });
    let n = 0;
    for (const found of play(scene, crowd, true)) {
      assert.deepEqual(found, wanted(scene.frames[n]), `${scene.name}, frame ${n++}`);
      for (const { field, group, view } of views) assert.deepEqual(view, crowd.read(field, { group }), `${scene.name}: field ${field} of group ${group}`);
    }
    views.forEach(({ field }) => seen.add(field));
    crowd.dispose();
  }
  assert.deepEqual(Object.keys(Field).filter((name) => !seen.has(Field[name])), []);
});

test('what is carried can be saved and set back in another crowd, views too, and is reset for some', () => {
  const carried = ['NORMAL', 'PLANT', 'PLANT_ROTATION', 'CONTACT_STATE', 'SHIFT', 'LIFT', 'LOOK_TURNS'].map((name) => Field[name]), seen = new Set();
  for (const scene of scenes.filter(({ name }) => name.startsWith('standing'))) {
    const [crowd, other] = [crowdOf(scene), crowdOf(scene)];
    for (const _ of play(scene, crowd));
    for (let group = 0; group < crowd.groupCount; ++group)
      for (const field of carried.filter((each) => crowd.componentCount(each, group))) {
        const view = other.values(field, group), saved = crowd.read(field, { group }), each = crowd.componentCount(field, group);
        other.write(field, saved, { group });
        assert.deepEqual(view, saved);
        if (saved.some((x) => x !== 0)) seen.add(field);
        other.reset({ group, first: 1, count: 2 });
        assert.ok(view.every((x, n) => x === (n >= each && n < 3 * each ? 0 : saved[n])));
      }
    crowd.dispose(), other.dispose();
  }
  assert.deepEqual([...seen].sort((a, b) => a - b), carried.sort((a, b) => a - b));
});

test('regions have the room of C++', () => {
  const { probes, rooms, ...given } = scenes.flatMap(({ groups }) => groups).find(({ region }) => region).region, region = regionOf(given);
  assert.deepEqual(rooms.map((_, n) => region.room(probes.slice(3 * n, 3 * n + 3))), rooms.map(Math.fround));
});

// Where the objects of a scene have members, from the scene on: names with dots between them.
function keysOf(value, path = '') {
  if (Array.isArray(value)) return value[0]?.constructor === Object ? value.flatMap((each) => keysOf(each, path)) : [];
  if (value?.constructor !== Object) return [];
  return Object.entries(value).flatMap(([name, member]) => [path + name, ...keysOf(member, `${path}${name}.`)]);
}
/** With edit(object) in the place of each object that has the member there. */
function edited(value, [name, ...names], edit) {
  if (Array.isArray(value)) return value[0]?.constructor === Object ? value.map((each) => edited(each, [name, ...names], edit)) : value;
  if (value[name] === undefined) return value;
  return names.length === 0 ? edit(value) : { ...value, [name]: edited(value[name], names, edit) };
}
/** Scenes by the paths of the members that they have. */
function scenesByMember() {
  const of = new Map();
  for (const scene of scenes) for (const path of new Set(keysOf(scene))) of.set(path, [...(of.get(path) ?? []), scene]);
  return of;
}

test('every argument counts: whatever is left out, some scene goes another way, or is refused', () => {
  const of = scenesByMember();
  const given = [...of.keys()].filter((path) => /^(groups|skeleton|up$|frames.(inputs|pose|doubles|carried)\.)/.test(path) && !/probes|rooms/.test(path));
  assert.ok(given.length > 100);
  const counts = (scene, path) => {
    let crowd;
    try {
      const less = edited(scene, path.split('.'), ({ [path.split('.').at(-1)]: _, ...rest }) => rest);
      crowd = crowdOf(less);
      let n = 0;
      for (const found of play(less, crowd)) if (JSON.stringify(found) !== JSON.stringify(wanted(scene.frames[n++]))) return true;
      return false;
    } catch (error) {
      return true;
    } finally {
      crowd?.dispose();
    }
  };
  assert.deepEqual(given.filter((path) => !of.get(path).some((scene) => counts(scene, path))), []);
});

test('every member of what bodies are made of refuses what it is not, in one line that names it', () => {
  const of = scenesByMember(), members = [...of.keys()].filter((path) => /^(groups\.((plant|ground|shift|prop|look|joints)\.\w+|link)|up|frames\.carried\.(was|now)\.\w+)$/.test(path));
  assert.ok(members.length >= 40, `${members}`);
  for (const path of members) {
    const names = path.split('.'), name = (names.length < 3 || names[1] === 'joints' ? names.slice(-1) : names.slice(-2)).map(camel).join('.');
    for (const wrong of name === 'twistBones' ? ['x'] : ['x', Array(14).fill(0.5)]) {  // which may be any number of joints
      const scene = edited(of.get(path)[0], names, (given) => ({ ...given, [names.at(-1)]: wrong }));
      refuses(() => { for (const _ of play(scene, crowdOf(scene))); }, name);
    }
  }
});

test('every feature, input and part of a pose is in some scene', () => {
  let features = 0n;
  const fields = new Set(), parts = new Set();
  for (const scene of scenes) {
    const crowd = crowdOf(scene);
    scene.groups.forEach((_, group) => (features |= crowd.features(group)));
    crowd.dispose();
    for (const { inputs, doubles = [], pose = {} } of scene.frames) {
      [...inputs, ...doubles].forEach((given) => Object.keys(given).forEach((name) => fields.add(name.toUpperCase())));
      [...Object.keys(pose), ...(scene.outputs ?? [])].forEach((name) => parts.add(camel(name)));
    }
  }
  assert.deepEqual(Object.keys(Feature).filter((name) => !(features & Feature[name])), ['JOINTS']);  // bindings' own: answers.test.mjs
  assert.deepEqual(Object.keys(Field).filter((name) => Field[name] < Field.SHOULDER && !fields.has(name)), []);
  const has = 'poses have rotations, translations, scales, results, translationResults, jointRotations, jointPositions, rootPosition, rootRotation, rootScale, time, supportPosition, supportRotation, weight';
  assert.deepEqual([...parts].sort(), has.replace('poses have ', '').split(', ').sort());
});
