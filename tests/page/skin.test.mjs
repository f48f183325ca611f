// SPDX-License-Identifier: MIT
// The promise: a glTF file's own skin is drawn on the joints that the command writes into a file, and as the file has it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { difference, file, onPage, run, visit, write } from './harness.mjs';

const figure = fileURLToPath(new URL('../../tools/view/figure.glb', import.meta.url)), check = fileURLToPath(new URL('../gltf/check.mjs', import.meta.url));
const crowd = file('skins.toml', `[crowd]
characters = 3
limbs = "all"
size = [0.7, 1.3]
[limb.arms]
target.offset = [0.1, 0.3, 0.2]
clavicle.share = 0.5
[look]
target = [5, 2, 30]
max_deg = 90
`);

test('joints are where the command writes them, above and below limbs and of heads that look, too', async () => {
  const glb = file('skins.glb', ''), times = [0, 0.5, 1], said = run('solve', figure, '--crowd', crowd, '--out', glb);
  assert.equal(said.status, 0, said.stderr);
  await visit(write('skins.html', 'view', figure, '--crowd', crowd), async (page) => {
    const { nodes, head, face } = await page.evaluate(() => {
      const { nodes, head, face } = swivelPage.stage.data.skin;
      return { nodes, head: head.at(-1), face };
    });
    for (const who of [0, 1, 2]) {
      const written = JSON.parse(execFileSync('node', [check, 'pose', glb, '0', ...times.map(String)]));
      const count = (written[0].length - 3) / 3;  // three times the file's nodes, and a node for each character
      for (const [n, time] of times.entries()) {
        const drawn = await page.evaluate(([at, character]) => {
          const { stage, view: { bodies } } = swivelPage;
          swivelPage.setFrame(Math.round(at / stage.data.frame_seconds));
          let found;
          bodies.skins.poses.each(character, 1, (_, matrices) => { found = matrices.map((matrix) => matrix.toArray()); });
          return found;
        }, [time, who]);
        const off = nodes.map((node, joint) => Math.max(...drawn[joint].map((part, k) => Math.abs(part - written[n][who * count + node][k]))));
        assert.ok(Math.max(...off) < 2e-5, `character ${who}, ${time} s: ${off}`);
        const [m, unit] = [drawn[head], (v) => v.map((part) => part / Math.hypot(...v))];
        const line = unit([0, 1, 2].map((row) => [0, 1, 2].reduce((sum, column) => sum + m[4 * column + row] * face[column], 0)));
        const wanted = unit([5, 2, 30].map((part, axis) => part - m[12 + axis])), cosine = line.reduce((sum, part, axis) => sum + part * wanted[axis], 0);
        assert.ok(cosine > Math.cos(0.001), `character ${who} looks ${Math.acos(cosine)} rad beside the target`);
        assert.equal(await page.evaluate(() => swivelPage.stage.digestState()), 'equal');
      }
    }
  });
});

onPage('a skin is seen, a chosen limb in another colour; limbs\' own colours and large crowds are capsules',
  () => write('many.html', 'view', figure, '--limbs', 'all', '--characters', '301', '--frames', '2'), async (page) => {
  const colour = page.getByLabel('Colour limbs by'), isSkin = () => page.evaluate(() => swivelPage.view.bodies.skins.meshes[0].visible);
  assert.deepEqual([await page.evaluate(() => swivelPage.drawnCount), await isSkin(), await colour.inputValue()], [300, true, '-1']);
  await page.evaluate(() => {  // pictures of 300 take long
    swivelPage.drawFirst(9);
    swivelPage.home();
  });
  const chosen = await difference(page, () => page.evaluate(() => swivelPage.view.bodies.choose(swivelPage.stage.limbs[2], swivelPage.view.middle)));
  assert.ok(chosen.share > 0.0005, `${chosen.share}`);
  const { share } = await difference(page, () => colour.selectOption('Limb'));
  assert.ok(share > 0.02 && !await isSkin(), `${share}`);
  await colour.selectOption('Skin');
  assert.equal(await isSkin(), true);
  await page.evaluate(() => swivelPage.drawFirst(301));
  assert.equal(await isSkin(), false);
});

/** A page of a figure that is one arm of four joints, with these nodes, meshes and so on beside. */
function armPage(name, translations, end, more) {
  const nodes = ['hips', 'LeftArm', 'LeftForeArm', 'LeftHand'].map((joint, n) => ({ name: joint, translation: translations[n], children: [n + 1] }));
  const gltf = file(`${name}.gltf`, JSON.stringify({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [...nodes, end], ...more }));
  return write(`${name}.html`, 'view', gltf, '--crowd', file('bend.toml', '[limb.left_arm]\nbend = [0, 0, 1]\n'));
}

test('textures, and meshes that hang on joints, ask nothing of a network', async () => {
  const bytes = Buffer.from(new Float32Array([0, 0, 0, 0, 0.1, 0, 0.1, 0, 0, 0, 0, 0, 1, 1, 0]).buffer).toString('base64');
  const place = armPage('hung', [[0, 1, 0], [0.2, 0.5, 0], [0.3, 0, 0], [0.3, 0, 0]], { name: 'glove', translation: [0, 0.1, 0], mesh: 0 }, {
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }], textures: [{ source: 0 }], images: [{ uri: 'elsewhere.png' }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [0.1, 0.1, 0] }, { bufferView: 1, componentType: 5126, count: 3, type: 'VEC2' }],
    bufferViews: [{ buffer: 0, byteLength: 36 }, { buffer: 0, byteOffset: 36, byteLength: 24 }],
    buffers: [{ byteLength: 60, uri: `data:application/octet-stream;base64,${bytes}` }],
  });
  await visit(place, async (page) => {
    const at = await page.evaluate(() => {
      const { bones: [{ inverse, joint }], poses } = swivelPage.view.bodies.skins;
      let at;
      poses.each(0, 1, (_, matrices) => { at = matrices[joint].clone().multiply(inverse).toArray().slice(12, 15); });
      return at;
    });
    [0.8, 1.6, 0].forEach((part, axis) => assert.ok(Math.abs(at[axis] - part) < 1e-6, `${at}`));
    assert.equal((await difference(page, () => {})).share, 0, 'it is drawn, and nothing is said on the console');
  });
});

test('a mesh that cannot be read is said, and capsules are drawn', async () => {
  const place = armPage('packed', Array(4).fill([0, 0.3, 0]), { name: 'glove', mesh: 0 }, {
    extensionsUsed: ['KHR_draco_mesh_compression'], extensionsRequired: ['KHR_draco_mesh_compression'],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, extensions: { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: 0 } } } }] }],
    accessors: [{ componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 1] }],
    bufferViews: [{ buffer: 0, byteLength: 4 }], buffers: [{ byteLength: 4, uri: 'data:application/octet-stream;base64,AAAAAA==' }],
  });
  await visit(place, async (page) => {
    assert.match(await page.textContent('.notice'), /^The figure's skin cannot be drawn: .*[^.]\.$/);
    assert.equal(await page.evaluate(() => swivelPage.view.bodies.skins), null);
  });
});

onPage('heads look at the pointer, bodies and bits stay',
  () => write('heads.html', 'view', figure, '--limbs', 'all', '--characters', '4'), async (page) => {
  /** How far each face is turned from the point that heads look at, in degrees, and how all joints that are not of the neck lie. */
  const look = () => page.evaluate(() => {
    const { stage, view } = swivelPage, { poses } = view.bodies.skins, { head, face } = stage.data.skin;
    const found = [];
    poses.each(0, 4, (_, matrices) => {
      const matrix = matrices[head.at(-1)].clone(), line = view.camera.position.clone().set(...face).transformDirection(matrix);
      const from = view.camera.position.clone().setFromMatrixPosition(matrix);
      const bodies = matrices.filter((_, joint) => !poses.heads.below.includes(joint)).map(({ elements }) => [...elements]);
      found.push([poses.heads.at ? line.angleTo(view.camera.position.clone().set(...poses.heads.at).sub(from)) * 180 / Math.PI : NaN, bodies]);
    });
    return found;
  });
  await page.mouse.move(300, 250);
  const [left, bits] = [await look(), await page.evaluate(() => swivelPage.stage.digestState())];
  assert.equal(bits, 'equal');
  for (const [off] of left) assert.ok(off < 1, `${off} degrees`);
  const { share } = await difference(page, () => page.mouse.move(60, 400));
  assert.ok(share > 0.0005, `${share}`);
  const right = await look();
  right.forEach(([off, bodies], n) => {
    assert.ok(off < 1, `${off} degrees`);
    assert.deepEqual(bodies, left[n][1]);
  });
  await page.evaluate(() => swivelPage.lead(null));
  assert.ok(Number.isNaN((await look())[0][0]));
});
