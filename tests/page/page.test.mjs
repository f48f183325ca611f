// SPDX-License-Identifier: MIT
// The promise: the page opens from disk alone, gives the command's bits in every frame, and draws what the solver found.
import assert from 'node:assert/strict';
import { readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { clip, demo, difference, file, refusal, run, signed, tiny, visit, write } from './harness.mjs';

const state = (page, frames) => page.evaluate((list) => list.map((frame) => {
  swivelPage.setFrame(frame);
  return swivelPage.stage.digestState();
}), frames);

test('one classic inline script, no network, the command\'s digests, a picture that moves', async () => {
  const text = readFileSync(demo, 'utf8');
  assert.equal(text.match(/<script/g).length, 1);
  assert.match(text, /<script data-digest="[0-9a-f]{16}">/);
  assert.equal(text.match(/<\/script/g).length, 1);
  assert.ok(text.includes('three.js authors') && text.includes('Permission is hereby granted'), "three's licence");
  await visit(demo, async (page) => {
    assert.equal(await page.title(), 'swivel demo – swivel');
    assert.deepEqual(await state(page, [0, 1, 17, 239, 5]), Array(5).fill('equal'));
    const [digest, told] = await page.evaluate(() => [swivelPage.stage.digest(), document.querySelector('.digest').textContent]);
    assert.equal(told, `The same bits as the commandDigest ${digest}, the command's ${digest}`);
    assert.deepEqual([await page.getByText('The same bits as the command').isVisible(), await page.getByText(digest).isVisible()], [true, false]);
    await page.getByText('The same bits as the command').click();
    assert.equal(await page.getByText(digest).isVisible(), true);
    const { share, colours } = await difference(page, () => page.evaluate(() => swivelPage.setFrame(60)));
    assert.ok(colours > 100, `${colours} colours`);
    assert.ok(share > 0.01 && share < 0.9, `${share} of the picture changed`);
  }, { isFresh: true, isJudged: true });
});

const crowds = {
  'arms and legs': [['--limbs', 'all', '--characters', '30', '--frames', '300']],
  'clavicles, stretch, effectors and limits': [['--characters', '30', '--frames', '300'], `[limb.all]
clavicle.share = 0.5
effector = [0.5, 0.2, 0]
[limb.left_arm]
limits.flexion_deg = [10, 130]
limits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 80 }
`],
  'stretched bones without hands, directions as poles': [['--characters', '30', '--frames', '300'], `[limb.all]
hand = false
pole.kind = "direction"
target.offset = [0, 4, 3]
reach = { soft_far = 0.1, most_stretch = 1.4 }
`],
  'regions, and elbows that follow hands': [['--characters', '30', '--frames', '300'], `[limb.all]
target.offset = [0, 4, 3]
pole.kind = "hand"
limits.region = { cones = [{ opening_deg = 40 }, { axis = [0, 1, 0.3], opening_deg = 50 }], clip_margin_deg = 5 }
`],
  'aiming hands': [['--characters', '30', '--frames', '300'], `[limb.all]
aim = { axis = [0, 1, 0], flexion_deg = 60 }
effector = [0, 0.5, 0.2]
target.offset = [3, 4, 9]
`],
};
for (const [name, [words, toml]] of Object.entries(crowds))
  test(`the shader's elbows, wrists and errors are the library's: ${name}`, async () => {
    const more = toml ? ['--crowd', file('crowd.toml', toml)] : [];
    const place = write(`${name.replaceAll(/\W+/g, '_')}.html`, 'view', clip, ...words, ...more);
    await visit(place, async (page) => {
      assert.deepEqual(await state(page, [0, 150, 299]), Array(3).fill('equal'));
      const [worst, wrong] = await page.evaluate(() => {
        const { stage } = swivelPage, count = stage.characterCount;
        let most = 0, wrong = 0;
        for (const frame of [0, 40, 120, 299]) {
          swivelPage.setFrame(frame);
          swivelPage.draw();
          for (const limb of stage.limbs) {
            const drawn = swivelPage.readback(limb, count);
            for (let n = 0; n < count; ++n) {
              const { elbow, wrist } = stage.pose(limb, n), { place } = stage.characters[n];
              wrong = Math.max(wrong, Math.abs(drawn[2 * n][3] - stage.residual(limb, n)));
              [elbow, wrist].forEach((joint, which) => {
                const off = Math.hypot(...joint.map((coordinate, axis) => coordinate - place[axis] - drawn[2 * n + which][axis]));
                most = Math.max(most, off / stage.armLength(limb, n));
              });
            }
          }
        }
        return [most, wrong];
      });
      assert.ok(worst > 0 && worst < 1e-5, `${worst} arm lengths`);
      assert.ok(wrong < 1e-5, `errors are wrong by ${wrong} arm lengths`);
    });
  });

test('panel, overlays and lesson show the limb that is solved, with clavicle, effector and any pole', async () => {
  for (const [left, right] of [['point', 'normal'], ['incoming', 'point']]) {
    const all = '[limb.all]\ntarget.offset = [0, 2, 1]\nclavicle.share = 0.6\neffector = [0.5, 0.2, 0]\npole.angle_deg = 20\n';
    const toml = file('poles.toml', `${all}[limb.left_arm]\npole.kind = "${left}"\n[limb.right_arm]\npole.kind = "${right}"\n`);
    const place = write('poles.html', 'view', clip, '--characters', '4', '--frames', '60', '--crowd', toml);
    await visit(place, async (page) => {
      for (const [name, pole] of [['left_arm', left], ['right_arm', right]]) {
        const seen = await page.evaluate(async (which) => {
          const { stage, view, lesson } = swivelPage, limb = stage.limbs.find((each) => each.name === which);
          swivelPage.select({ limb, character: 2 });
          view.lookAt(2, true);
          lesson.box.open = true;
          await new Promise((resolve) => setTimeout(resolve, 100));
          swivelPage.setFrame(40);
          swivelPage.draw();
          const pose = stage.pose(limb, 2), off = (a, b) => Math.hypot(...a.map((coordinate, axis) => coordinate - b[axis]));
          const label = (text) => [...document.querySelectorAll('.labels span')].find((each) => each.textContent === text).style.transform.match(/-?[\d.]+/g).map(Number);
          const apart = (text, at) => Math.hypot(label(text)[0] - 8 - view.project(at).x, label(text)[1] + 22 - view.project(at).y);
          const facts = [...document.querySelectorAll('aside dt')], flexion = parseFloat(facts.find((each) => each.textContent === 'Flexion').nextSibling.textContent);
          return { sides: [off(pose.shoulder, pose.elbow), off(pose.elbow, pose.wrist), off(pose.shoulder, pose.wrist)], lengths: limb.sources.lengths(stage.clipFrame(2)).map((length) => stage.characters[2].size * length),
            moved: off(pose.shoulder, stage.origin(limb, 2)), flexion, labels: [apart('pe', pose.elbow), apart('pw', pose.wrist)], names: facts.map(({ textContent }) => textContent), closing: document.querySelector('.lesson .hint').textContent };
        }, name);
        const [upper, fore, whole] = seen.sides, flexion = 180 - Math.acos((upper ** 2 + fore ** 2 - whole ** 2) / (2 * upper * fore)) * 180 / Math.PI;
        assert.ok(seen.moved > 0.01 * upper, 'the clavicle turns');
        assert.ok(seen.names.includes('Effector\'s target') && !seen.names.includes('Target'), `${seen.names}`);
        seen.lengths.forEach((length, bone) => assert.ok(Math.abs(length / seen.sides[bone] - 1) < 1e-5, `${pole}: ${seen.sides} ${seen.lengths}`));
        assert.ok(Math.abs(seen.flexion - flexion) < 0.11, `${pole}: ${seen.flexion} ${flexion}`);
        assert.ok(Math.max(...seen.labels) < 0.5, `${pole}, ${name}: labels are ${seen.labels} pixels from elbow and wrist`);
        assert.ok(!seen.closing.includes('The lecture knows no limits'), seen.closing);
      }
    });
  }
});

test('the lesson says where the solver goes another way', async () => {
  const limbs = [['left_arm', 'aim = { axis = [0, 1, 0], flexion_deg = 60 }', /This limb aims/],
    ['right_arm', 'target.offset = [3, 0, 0]\npole.angle_deg = 40', /The elbow is 40\.0° from where the limb's own pole wishes it: limits, an angle, weights or a step turn it/],
    ['left_leg', 'target.offset = [0, 3, 0]\nweights.position = 0.3', /The lecture knows no limits: .* hold the leg that you see 0\.\d+ leg lengths from this one/]];
  const toml = file('lessons.toml', limbs.map(([name, lines]) => `[limb.${name}]\n${lines}\n`).join(''));
  await visit(write('lessons.html', 'view', clip, '--limbs', 'all', '--frames', '5', '--crowd', toml), async (page) => {
    await page.getByText('The lecture, step by step').click();
    await page.locator('.lesson h3', { hasText: '1. ' }).waitFor();
    for (const [name, , expected] of limbs) {
      await page.evaluate((which) => swivelPage.select({ limb: swivelPage.stage.limbs.find((limb) => limb.name === which), character: 0 }), name);
      assert.match(await page.textContent('.lesson'), expected);
    }
  });
});

test('a crowd that carries state has the command\'s digests, in whatever order its frames are looked at', async () => {
  const toml = file('state.toml', '[budget]\nblocks = 3\n[limb.all]\nswivel.most_deg_per_frame = 2\n');
  const place = write('state.html', 'view', clip, '--characters', '100', '--frames', '40', '--crowd', toml);
  await visit(place, async (page) => {
    assert.deepEqual(await state(page, [...Array(40).keys()]), Array(40).fill('equal'));
    assert.deepEqual(await state(page, [20, 21, 0, 1, 39, 2]), Array(6).fill('equal'));
  });
});

test('goals of one\'s own are the command\'s, too', async () => {
  const csv = file('targets.csv', 'frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n0,0,left_arm,10,16,-10,,,\n20,0,left_arm,8,20,-10,,,\n7,3,right_arm,40,10,0,30,0,-9\n');
  const toml = file('pole_weight.toml', '[limb.all]\nweights.pole = 0.6\n');
  const place = write('given.html', 'view', clip, '--characters', '5', '--frames', '30', '--targets', csv, '--between', 'linear', '--crowd', toml);
  await visit(place, async (page) => assert.deepEqual(await state(page, [0, 7, 10, 29]), Array(4).fill('equal')));
});

test('a page of a cache has the command\'s digests, too', async () => {
  rmSync(join(process.env.WORK, 'crowd.zarr'), { recursive: true, force: true });
  const toml = file('cached.toml', '[crowd]\nlimbs = "all"\n[look]\ntarget = [60, 15, 160]\n[carry]\nshare = 0.5\n');
  assert.equal(run('store', clip, 'crowd.zarr', '--characters', '20', '--frames', '5', '--no-poses', '--crowd', toml).status, 0);
  assert.equal(run('fill', 'crowd.zarr').status, 0);
  await visit(write('cache.html', 'view', 'crowd.zarr'), async (page) => assert.deepEqual(await state(page, [0, 1, 4]), Array(3).fill('equal')));
});

test('a long clip opens', async () => {
  await visit(write('long.html', 'demo', '--characters', '2'), async (page) => {
    const frames = await page.evaluate(async () => {  // the clip 450 times: more than the module's memory was without it
      const { data } = swivelPage.stage, long = (text) => text.repeat(450), canvas = document.createElement('canvas');
      document.body.replaceChildren(canvas);
      const page = await swivelView.start({ ...data, frame_count: 450 * data.frame_count, positions: long(data.positions),
        limbs: data.limbs.map((limb) => ({ ...limb, sources: long(limb.sources) })) });
      page.setFrame(100);
      return [page.stage.frameCount, page.stage.digestState()];
    });
    assert.deepEqual(frames, [108000, 'equal']);
  });
});

test('a page\'s program and a command that do not fit get a sentence', async () => {
  const text = readFileSync(tiny, 'utf8');
  const refused = (name, from, to) => {
    assert.notEqual(text.replace(from, to), text);
    return refusal(file(name, signed(text.replace(from, to))));
  };
  assert.equal(signed(text), text);
  assert.match(await refused('version.html', /"version":"[\d.]+"/, '"version":"9.8.7"'), /the command is swivel 9\.8\.7, and the page's program is swivel \d/);
  assert.match(await refused('plan.html', /"plan":"..../, '"plan":"'), /wrote 213 bytes for the plan of left_arm, and the page's program expects 216/);
});

test('names from files are text', async () => {
  const evil = '</script><img/src=x/onerror=alert(1)>"\'&';
  const text = readFileSync(clip, 'utf8').replace(/ROOT \S+/, `ROOT ${evil}`);
  const name = '<img src=x onerror=alert(1)>"\'&.bvh';
  const place = write('names.html', 'view', file(name, text), '--frames', '5');
  await visit(place, async (page) => {
    assert.equal(await page.textContent('h1'), name);
    assert.equal(await page.evaluate(() => swivelPage.view.figure.joints[0].name), evil);
    assert.equal(await page.locator('img').count(), 0);
  }, { isJudged: true });
});

test('a browser without WebGL 2 or SIMD, or with small textures, gets a sentence', async () => {
  const place = tiny;
  const expect = (words, before) => visit(place, async (page) => assert.ok((await page.textContent('body')).includes(words)), { before });
  const words = await refusal(place, { before: () => {
    const { getParameter } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.getParameter = function (name) { return name === WebGL2RenderingContext.MAX_TEXTURE_SIZE ? 1024 : getParameter.call(this, name); };
  } });
  assert.match(words, /graphics cannot hold .*: a texture has 1024 texels a side, and they take \d+\. Take fewer --frames/);
  await expect('This browser has no WebGL 2', () => { HTMLCanvasElement.prototype.getContext = () => null; });
  await expect('This browser has no WebAssembly with SIMD', () => { WebAssembly.validate = () => false; });
  await expect('This browser has no WebAssembly,', () => { delete window.WebAssembly; });
});
