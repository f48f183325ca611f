// SPDX-License-Identifier: MIT
//
// The promise: WebAssembly computes a cache's poses and digests from its goals, bit for bit, by nothing but what docs/cache.md says of the files.
//   SWIVEL: the command. CLIP: a motion file. PACKAGE, MODULE: the package for the web, and the page's module, which has swivel_goals().
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { createXXHash3 } from 'hash-wasm';
import * as zarr from 'zarrita';

const { SWIVEL, CLIP, PACKAGE, MODULE } = process.env;
const { instantiate } = await import(`${PACKAGE}/instantiate.js`);
const { carried, Feature, Field, OnBadInput } = await import(`${PACKAGE}/layout.js`);
const { Swivel } = await import(`${PACKAGE}/swivel.js`);

/** The names of results, in their order. The cache has their arrays under the same names in small letters. */
const RESULTS = Object.keys(Field).filter((name) => Field[name] >= Field.SHOULDER);

const folder = mkdtempSync(join(tmpdir(), 'swivel-cache-'));
after(() => rmSync(folder, { recursive: true }));

// ---- structures of C, as tools/crowd/goals.h and include/swivel/swivel.h have them, from the cache's numbers

const doubles = (...numbers) => Buffer.from(new Float64Array(numbers.flat()).buffer);
const floats = (...numbers) => Buffer.from(new Float32Array(numbers.flat(2).map((number) => number ?? NaN)).buffer);
const words = (...numbers) => Buffer.from(new Uint32Array(numbers).buffer);

const regionBytes = ({ first, half_spaces: halfSpaces }) => Buffer.concat([
  words(first[0], first.length - 1, ...first, ...Array(25 - first.length).fill(0)),
  ...halfSpaces.map(({ axis, cosine, is_edge: isEdge }) => Buffer.concat([floats(axis, [cosine]), words(isEdge)])), Buffer.alloc(20 * (64 - halfSpaces.length))]);
const planBytes = (p, isLook, clearance) => Buffer.concat([
  doubles(p.target_point, p.target_offset, p.effector, p.pole_fixed, p.shoulder_place, p.bones.flat()), floats(p.weights),
  words(p.has_target_point, p.has_pole_fixed, p.pole, p.holds_pole, p.hand_is_local, p.goes_along, isLook ? 1 : 0, p.holds), floats(clearance)]);
const groundBytes = ({ size, place, columns, rows }) => Buffer.concat([doubles(size, place), words(columns, rows)]);
/** Bytes of a goal_root and a goal_input, and where the goals of that begin. */
const ROOT = 32, INPUT = 272, GOAL = { target: 0, pole: 24, hand: 48, weights: 64 };

/** Members of a goal_source and of a goal_character, in their order. */
const SOURCE = ['elbow', 'wrist', 'hand', 'lengths', 'origin', 'root', 'carried', 'parent', 'shoulder', 'elbow_local', 'wrist_local', 'contact', 'carries', 'stand', 'leaves', 'lands', 'next'];
const CHARACTER = ['size', 'place', 'start', 'wish', 'first', 'count', 'carries'];

/** The limbs, and a look, which is the last one. */
const limbsOf = ({ limbs, look }) => [...limbs, ...(look ? [{ ...look, isLook: true, features: 0, fixed: [] }] : [])];

/** Everything that zarrita reads of a cache, whole. */
async function open(path) {
  const files = { get: async (key) => { try { return new Uint8Array(readFileSync(join(path, key))); } catch { return undefined; } } };
  const root = await zarr.open.v2(zarr.root(files), { kind: 'group', attrs: true }), { attrs } = root;
  const read = async (name) => (await zarr.get(await zarr.open.v2(root.resolve(name), { kind: 'array' })));
  const readAll = (...names) => Promise.all(names.map(read));
  const clip = await readAll(...SOURCE.map((name) => `clip/${name}`));
  const limbs = limbsOf(attrs);
  const frames = attrs.clip_frames;
  const part = ({ data, shape }, index) => data.subarray(index * shape[2], (index + 1) * shape[2]);
  const sources = limbs.map((_, limb) => Buffer.concat(Array.from({ length: frames }, (__, frame) =>
    Buffer.concat(clip.map((array) => Buffer.from(part(array, limb * frames + frame).slice().buffer))))));
  const [size, place, start, wish, first, count, carries] = (await readAll(...CHARACTER.map((name) => `character/${name}`))).map(({ data }) => data);
  const heights = attrs.ground?.columns > 0 ? (await read('ground/height')).data : undefined;
  return { attrs, limbs, read, root, sources, heights, size, place, start, first, count, wish, carries };
}

// ---- digests

const hasher = await createXXHash3();

/** XXH3 of bytes, as hash-wasm computes it; never 0. */
const digestOf = (bytes) => BigInt(`0x${hasher.init().update(bytes).digest()}`) || 1n;
/** Of a typed array, such as a chunk of goals, as little-endian numbers. */
const digestOfNumbers = (data) => digestOf(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
/** Of the attributes: their text without the blanks between its words, and without the digest itself, which comes last. */
function proveAttributes(text) {
  const [, before, digest] = /^(.*),"digest":"([0-9a-f]{16})"}$/.exec(text.replace(/("(?:[^"\\]|\\.)*")|\s+/g, '$1'));
  assert.equal(digestOf(new TextEncoder().encode(`${before}}`)).toString(16).padStart(16, '0'), digest);
}

/** Every place in a grid, the last dimension's counted first. */
const placesIn = (counts) => counts.reduce((places, count) => places.flatMap((place) => Array.from({ length: count }, (_, n) => [...place, n])), [[]]);

/** Computes every digest of the goals again. Returns how many there are. */
async function proveGoals({ root, attrs }) {
  const names = [...[...SOURCE, 'position'].map((name) => `clip/${name}`), ...CHARACTER.map((name) => `character/${name}`)];
  if (attrs.ground?.columns > 0) names.push('ground/height');
  if (attrs.has_given) names.push('given/target', 'given/pole', 'given/hand');
  let count = 0;
  const all = [];
  for (const name of names.sort()) {
    const array = await zarr.open.v2(root.resolve(name), { kind: 'array' });
    const digests = await zarr.get(await zarr.open.v2(root.resolve(`goal_digest/${name}`), { kind: 'array' }));
    all.push(...digests.data);
    for (const [n, place] of placesIn(digests.shape).entries()) {
      if (digests.data[n] === 0n) continue;
      assert.equal(digestOfNumbers((await array.getChunk(place)).data), digests.data[n], `${name}/${place}`);
      ++count;
    }
  }
  assert.equal(digestOfNumbers(new BigUint64Array(all)).toString(16).padStart(16, '0'), attrs.goals_digest);
  return count;
}

/** Computes every digest of the state again. Returns how many there are. */
async function proveState({ root, read }) {
  const open = (name) => zarr.open.v2(root.resolve(`state/${name}`), { kind: 'array' });
  const found = await Promise.allSettled(RESULTS.map((name) => open(name.toLowerCase())));
  const arrays = found.filter(({ status }) => status === 'fulfilled').map(({ value }) => value);
  if (arrays.length === 0) return 0;
  const { data, shape } = await read('state/digest');
  for (const [n, [time, column]] of placesIn(shape).entries()) {
    const chunks = await Promise.all(arrays.map((array) => array.getChunk([time, 0, column, ...array.shape.slice(3).map(() => 0)])));
    assert.equal(digestOfNumbers(new BigUint64Array(chunks.map((chunk) => digestOfNumbers(chunk.data)))), data[n], `state/${time}.${column}`);
  }
  return data.length;
}

// ---- crowds

/** The joint of a limb whose rotation a field of the cache is. */
const JOINTS = { SHOULDER: 1, ELBOW: 2, WRIST: 3 };
const twistBoneCount = ({ features }) => Number(BigInt(features) / Feature.WITH_TWIST_BONES % 8n);

/** The joints of all limbs: of each the one above its shoulder, shoulder, elbow, wrist, and twist bones below the elbow. */
function skeletonOf(limbs) {
  const parents = [], translations = [], rotations = [], add = (parent, place = [0, 0, 0], rotation = [0, 0, 0, 1]) => {
    translations.push(...place);
    rotations.push(...rotation);
    return parents.push(parent) - 1;
  };
  const chains = limbs.map((limb) => {
    const { chain } = limb, shoulder = add(add(-1), limb.goals.shoulder_place, chain.shoulder_rotation);
    const elbow = add(shoulder, chain.elbow_offset, chain.elbow_rotation), wrist = add(elbow, chain.wrist_offset, chain.wrist_rotation);
    return { shoulder, elbow, wrist, twistBones: Array.from({ length: twistBoneCount(limb) }, () => add(elbow)), bend: chain.bend };
  });
  return { skeleton: { parents, translations, rotations }, chains };
}

/** How a look's joints turn. */
const lookOf = ({ joint_count: count, axis, cos_most: cosMost }, { shoulder }) => ({ joints: Array.from({ length: count }, (_, n) => shoulder + n), axis, cosMost });

/** A column of characters, solved frame by frame. */
class Column {
  constructor(memory, cache, first) {
    Object.assign(this, { memory, cache, first, swivel: new Swivel(memory) });
    const { limbs, attrs: { chunk_characters: most, characters } } = cache, { skeleton, chains } = skeletonOf(limbs);
    this.count = Math.min(most, characters - first);
    const who = Array.from({ length: this.count }, (_, n) => first + n);
    this.characters = this.keep(Buffer.concat(who.map((c) => Buffer.concat([
      doubles(cache.size[c], Array.from(cache.place.subarray(3 * c, 3 * c + 3))), words(cache.start[c]), floats(cache.wish[c]), words(cache.first[c], cache.count[c], cache.carries[c], 0)]))));
    this.ground = cache.heights ? [this.keep(groundBytes(cache.attrs.ground)), this.keep(Buffer.from(cache.heights.slice().buffer))] : [0, 0];
    this.plans = this.keep(Buffer.concat(limbs.map(({ goals, isLook, clearances }) => planBytes(goals, isLook, clearances?.[0] ?? 0))));
    this.sources = this.keep(words(...cache.sources.map((bytes) => this.keep(bytes))));
    this.roots = memory.allocate(ROOT * this.count);
    this.inputs = memory.allocate(INPUT * limbs.length * this.count);
    const groups = limbs.map((limb, n) => (limb.isLook ? { look: lookOf(limb, chains[n]) } : {
      joints: chains[n], features: BigInt(limb.features), shoulderOrder: limb.shoulder_order, wristOrder: limb.wrist_order, onBadInput: OnBadInput.REST_POSE,
      ...(limb.goals.holds > 0 ? { link: limb.goals.holds - 1 } : {}),
      ...(limb.region ? { region: this.swivel.region(new Uint8Array(regionBytes(limb.region))) } : {}),
      ...(limb.clearances ? { ground: { toeClearance: limb.clearances[0], heelClearance: limb.clearances[1], half: 0 }, plant: { run: 1 } } : {}) }));
    if (limbs.some(({ features }) => BigInt(features) & Feature.WITH_FIT)) groups.push({ fit: {} });
    this.crowd = this.swivel.bodies({ skeleton, bodyCount: this.count, groups });
    limbs.forEach(({ fixed }, group) => {
      for (const { field, value } of fixed) this.crowd.write(field, value.slice(0, this.crowd.componentCount(field, group)), { group });
    });
    this.poseSize = memory.calls.swivel_goal_pose_size(this.crowd.crowd);
    this.poses = this.keep(Buffer.alloc(4 * this.poseSize * this.count));
  }
  keep(bytes) {
    const at = this.memory.allocate(bytes.length);
    this.memory.bytes(at, bytes.length).set(bytes);
    return at;
  }
  /** Puts goals from a table in place of the clip's. */
  give(frame, [target, pole, hand]) {
    const { memory, cache: { limbs, attrs: { characters } } } = this;
    for (let n = 0; n < this.count; ++n)
      limbs.forEach(({ goals }, limb) => {
        const at = (frame * limbs.length + limb) * characters + this.first + n, input = this.inputs + (n * limbs.length + limb) * INPUT;
        if (Number.isNaN(target.data[3 * at])) return;
        memory.doubles(input + GOAL.target, 3).set(target.data.subarray(3 * at, 3 * at + 3));
        memory.floats(input + GOAL.hand, 4).set(hand.data.subarray(4 * at, 4 * at + 4));
        memory.floats(input + GOAL.weights, 2).set(goals.weights.slice(0, 2));
        if (Number.isNaN(pole.data[3 * at])) return;
        memory.doubles(input + GOAL.pole, 3).set(pole.data.subarray(3 * at, 3 * at + 3));
        memory.floats(input + GOAL.weights, 3)[2] = goals.weights[2];
      });
  }
  solve(frame, given) {
    const { memory, crowd, cache: { limbs, attrs: { frame_seconds: seconds }, start, count } } = this, { calls } = memory;
    calls.swivel_goals(this.plans, this.sources, limbs.length, frame, ...this.ground, this.characters, this.count, this.roots, this.inputs);
    for (let group = 0; group < crowd.groupCount; ++group) {
      if (!carried.some((field) => crowd.componentCount(field, group) > 0)) continue;
      for (let n = 0; n < this.count; ++n) if ((frame + start[this.first + n]) % count[this.first + n] === 0) crowd.reset({ group, first: n, count: 1 });
    }
    if (given) this.give(frame, given);
    memory.borrow((borrowed) => {
      const job = borrowed.structure('swivel_job').at;
      memory.check(calls.swivel_goals_solve(crowd.crowd, ...this.ground, seconds, this.characters, this.roots, this.inputs, this.poses, job));
    });
  }
  digest() { return this.memory.calls.swivel_goals_digest(this.crowd.crowd, this.poses); }
  /** Whether a limb has a field. A look has as many joints as turn. */
  has(name, limb) {
    const { isLook, joint_count: count } = this.cache.limbs[limb], joint = JOINTS[name];
    return isLook && joint ? joint <= count : this.crowd.componentCount(Field[name], limb) > 0;
  }
  /** A field of a limb, as the cache has it: local rotations from the poses, all else from rows. */
  read(name, limb) {
    const joint = JOINTS[name], all = this.memory.floats(this.poses, this.poseSize * this.count);
    if (!joint) return this.crowd.read(Field[name], { group: limb });
    const before = this.cache.limbs.slice(0, limb).reduce((sum, each) => sum + 4 + twistBoneCount(each), 0);
    const at = (n) => n * this.poseSize + 4 * (before + joint);
    return Float32Array.from({ length: 4 * this.count }, (_, n) => all[at(n >> 2) + n % 4]);
  }
  dispose() { this.crowd.dispose(); }
}

// What a crowd's limbs have alike. Limbs may have unlike numbers of twist bones, for which the cache's array has room; digests have them.
const COMPARED = RESULTS.filter((name) => name !== 'TWIST_BONES');
const LIMITED = `${readFileSync(new URL('limited.toml', import.meta.url), 'utf8')}
[limb.arms]
effector = [0, -0.4, 0]
`;
// Legs without hands, arms with boxes of two orders, one of which holds the other.
const UNLIKE = `
[crowd]
limbs = "all"
[limb.legs]
hand = false
[limb.left_arm]
hold = "right_arm"
[limb.left_arm.limits.shoulder_box]
order = "ZYX"
x_deg = [-80, 80]
[limb.right_arm.limits.shoulder_box]
order = "XYZ"
x_deg = [-80, 80]
`;
const STATE = `${LIMITED}
[limb.all.swivel]
most_deg_per_second = 900
`;

const HILLS = `
[crowd]
limbs = "all"
[ground]
heights = "hills.png"
size = [900, 60, 900]
`;
// The same motion twice is two clips: characters wrap within their own.
const WHOLE = `${HILLS}
[look]
target = [60, 15, 160]
[carry]
share = 0.5
`;
const CLIPS = HILLS.replace('limbs', `clips = [{ file = "${CLIP}" }]\nlimbs`);

for (const [name, toml, options] of [
  ['a plain crowd', '', []], ['limits, clavicles, twist bones', LIMITED, []], ['unlike limbs', UNLIKE, []], ['state', STATE, []], ['hills', HILLS, []], ['several clips', CLIPS, []], ['heads and boxes', WHOLE, []],
  ['targets of one\'s own', LIMITED, ['targets']],
])
  test(`wasm replays ${name}`, async () => {
    const run = (...list) => execFileSync(SWIVEL, list, { cwd: folder, stdio: 'pipe' });
    rmSync(join(folder, 'cache'), { recursive: true, force: true });
    writeFileSync(join(folder, 'crowd.toml'), toml);
    copyFileSync(new URL('../../examples/hills.png', import.meta.url), join(folder, 'hills.png'));
    if (options[0] === 'targets') {
      run('solve', CLIP, '--limbs', 'all', '--export-targets', 'all.csv', '--quiet');
      const rows = readFileSync(join(folder, 'all.csv'), 'utf8').split('\n');
      writeFileSync(join(folder, 'targets.csv'), `${rows[0]}\n${rows.slice(1).filter((row) => /^(3|11),.*right/.test(row)).join('\n')}\n`);
      options.splice(0, 1, '--targets', 'targets.csv', '--between', 'hold');
    }
    run('store', CLIP, 'cache', '--frames', '23', '--characters', '75', '--chunk', '8,32', '--quiet', ...(toml ? ['--crowd', 'crowd.toml'] : []), ...options);
    run('fill', 'cache', '--quiet');
    const cache = await open(join(folder, 'cache')), { attrs, limbs } = cache;
    const given = attrs.has_given ? await Promise.all(['target', 'pole', 'hand'].map((each) => cache.read(`given/${each}`))) : undefined;
    const names = COMPARED.filter((name) => existsSync(join(folder, 'cache', name.toLowerCase(), '.zarray')));
    const stored = Object.fromEntries(await Promise.all(names.map(async (name) => [name, await cache.read(name.toLowerCase())])));
    assert.ok(await proveGoals(cache) > 18);
    assert.equal(await proveState(cache), ['state', 'hills', 'several clips', 'heads and boxes'].includes(name) ? 9 : 0);
    proveAttributes(readFileSync(join(folder, 'cache/.zattrs'), 'utf8'));
    const digests = await cache.read('digest');
    let compared = 0, solvedLimbs = 0;
    for (const first of [0, 32, 64]) {
      const memory = await instantiate({ wasm: readFileSync(MODULE), megabytes: 64 }), column = new Column(memory, cache, first);
      let words = [];
      for (let frame = 0; frame < attrs.frames; ++frame) {
        column.solve(frame, given);
        if (frame % attrs.chunk_frames === 0) words = [];
        words.push(column.digest());
        const time = Math.floor(frame / attrs.chunk_frames), [, columnCount] = digests.shape;
        if ((frame + 1) % attrs.chunk_frames === 0 || frame + 1 === attrs.frames)
          assert.equal(digests.data[time * columnCount + first / attrs.chunk_characters], digestOfNumbers(new BigUint64Array(words)), `digest of chunk ${time}, characters from ${first} on`);
        limbs.forEach((_, limb) => {
          for (const name of names) {
            if (!column.has(name, limb)) continue;
            const parts = JOINTS[name] ? 4 : column.crowd.componentCount(Field[name], limb);
            const { data } = stored[name], at = ((frame * limbs.length + limb) * attrs.characters + first) * parts;
            const wanted = new Uint32Array(data.slice(at, at + column.count * parts).buffer);
            const numbers = column.read(name, limb), found = new Uint32Array(numbers.buffer, numbers.byteOffset, numbers.length);
            assert.deepEqual(found, wanted, `${name} of limb ${limb}, frame ${frame}, characters from ${first} on`);
            compared += wanted.length;
          }
          solvedLimbs += column.count;
        });
      }
      column.dispose();
    }
    assert.equal(solvedLimbs, 23 * 75 * limbs.length);
    assert.ok(compared >= solvedLimbs * 9);
  });
