// SPDX-License-Identifier: MIT
// The promise: the page opens from disk alone, gives the command's bits in every frame, and draws what the solver found, in the lesson step by
// step. What cannot be shown is said.
import assert from 'node:assert/strict';
import { copyFileSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertEqualBits, choose, clip, demo, difference, file, onDemo, onPage, pull, range, refusal, run, signed, tiny, visit, write } from './harness.mjs';

test('one classic inline script, no network, the command\'s digests, a picture that moves', async () => {
  const text = readFileSync(demo, 'utf8');
  assert.deepEqual([text.match(/<script/g).length, text.match(/<script data-digest="[0-9a-f]{16}">/g).length, text.match(/<\/script/g).length], [1, 1, 1]);
  assert.ok(text.includes('three.js authors') && text.includes('Permission is hereby granted'), "three's licence");
  await visit(demo, async (page) => {
    assert.equal(await page.title(), 'swivel demo – swivel');
    await assertEqualBits(page, [0, 1, 17, 239, 5]);
    const [digest, told] = await page.evaluate(() => [swivelPage.stage.digest(), [...document.querySelectorAll('.digest summary, .digest p:last-child')].map((part) => part.textContent).join('')]);
    assert.equal(told, `The same bits as the commandDigest ${digest}, the command's ${digest}`);
    assert.equal(await page.getByText(digest).isVisible(), false);
    await page.getByText('The same bits as the command').click();
    assert.equal(await page.getByText(digest).isVisible(), true);
    const { share, colours } = await difference(page, () => page.evaluate(() => swivelPage.setFrame(60)));
    assert.ok(colours > 100 && share > 0.01 && share < 0.9, `${colours} colours, ${share} of the picture changed`);
    assert.equal(await page.locator('.refusal').count(), 0);
  }, { isFresh: true });
});

const targets = file('targets.csv', 'frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n0,0,left_arm,10,16,-10,,,\n20,0,left_arm,8,20,-10,,,\n7,3,right_arm,40,10,0,30,0,-9\n');
copyFileSync(new URL('../../examples/hills.png', import.meta.url), join(process.env.WORK, 'hills.png'));
const hills = '[ground]\nheights = "hills.png"\nsize = [900, 60, 900]\n';

const crowds = {
  'arms and legs': '[crowd]\nlimbs = "all"\n',
  'clavicles, stretch, effectors and limits': `[limb.all]
clavicle.share = 0.5
effector = [0.5, 0.2, 0]
[limb.left_arm]
limits.flexion_deg = [10, 130]
limits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 80 }
`,
  'stretched bones without hands, directions as poles': `[limb.all]
hand = false
pole.kind = "direction"
target.offset = [0, 4, 3]
reach = { soft_far = 0.1, max_stretch = 1.4 }
`,
  'regions, and elbows that follow hands': `[limb.all]
target.offset = [0, 4, 3]
pole.kind = "hand"
limits.region = { cones = [{ opening_deg = 40 }, { axis = [0, 1, 0.3], opening_deg = 50 }], clip_margin_deg = 5 }
`,
  'aiming hands': `[limb.all]
aim = { axis = [0, 1, 0], flexion_deg = 60 }
effector = [0, 0.5, 0.2]
target.offset = [3, 4, 9]
`,
};
for (const [name, toml] of Object.entries(crowds))
  test(`the shader's elbows, wrists and errors are the library's: ${name}`, async () => {
    const place = write(`${name.replaceAll(/\W+/g, '_')}.html`, 'view', clip, '--characters', '30', '--frames', '300', '--crowd', file('crowd.toml', toml));
    await visit(place, async (page) => {
      await assertEqualBits(page, [0, 150, 299]);
      for (const frame of [0, 40, 120, 299]) {
        const [joints, errors] = await page.evaluate((at) => {
          swivelPage.setFrame(at);
          const { stage } = swivelPage, all = [...stage.characters.keys()];
          return [worstDrawn(all), Math.max(...stage.limbs.flatMap((limb) => {
            const drawn = swivelPage.readback(limb, all.length);
            return all.map((n) => Math.abs(drawn[2 * n][3] - stage.residual(limb, n)));
          }))];
        }, frame);
        assert.ok(joints > 0 && joints < 1e-5 && errors < 1e-5, `frame ${frame}: joints ${joints}, errors ${errors} limb lengths off`);
      }
    });
  });

test('panel, overlays and lesson show the limb that is solved, with clavicle, effector and any pole', async () => {
  for (const [left, right] of [['point', 'normal'], ['incoming', 'point']]) {
    const all = '[limb.all]\ntarget.offset = [0, 2, 1]\nclavicle.share = 0.6\neffector = [0.5, 0.2, 0]\npole.angle_deg = 20\n';
    const toml = file('poles.toml', `${all}[limb.left_arm]\npole.kind = "${left}"\n[limb.right_arm]\npole.kind = "${right}"\n`);
    await visit(write('poles.html', 'view', clip, '--characters', '4', '--frames', '60', '--crowd', toml), async (page) => {
      for (const [name, pole] of [['left_arm', left], ['right_arm', right]]) {
        await choose(page, name, 2);
        const seen = await page.evaluate(async () => {
          const { stage, view, lesson, selection: { limb } } = swivelPage;
          view.lookAt(2, true);
          lesson.box.open = true;
          await new Promise((resolve) => setTimeout(resolve, 100));
          swivelPage.setFrame(40);
          swivelPage.draw();
          const pose = stage.pose(limb, 2), facts = [...document.querySelectorAll('aside dt')];
          const label = (text) => [...document.querySelectorAll('.labels span')].find((each) => each.textContent === text).style.transform.match(/-?[\d.]+/g).map(Number);
          const labelOff = (text, at) => Math.hypot(label(text)[0] - 8 - view.project(at).x, label(text)[1] + 22 - view.project(at).y);
          return { sides: [apart(pose.shoulder, pose.elbow), apart(pose.elbow, pose.wrist), apart(pose.shoulder, pose.wrist)], lengths: limb.sources.lengths(stage.clipFrame(2)).map((length) => stage.characters[2].size * length),
            moved: apart(pose.shoulder, stage.origin(limb, 2)), flexion: parseFloat(facts.find((each) => each.textContent === 'Flexion').nextSibling.textContent),
            labels: [labelOff('pe', pose.elbow), labelOff('pw', pose.wrist)], names: facts.map(({ textContent }) => textContent) };
        });
        const [upper, fore, whole] = seen.sides, flexion = 180 - Math.acos((upper ** 2 + fore ** 2 - whole ** 2) / (2 * upper * fore)) * 180 / Math.PI;
        assert.ok(seen.moved > 0.01 * upper, 'the clavicle turns');
        assert.ok(seen.names.includes('Effector\'s target') && !seen.names.includes('Target'), `${seen.names}`);
        seen.lengths.forEach((length, bone) => assert.ok(Math.abs(length / seen.sides[bone] - 1) < 1e-5, `${pole}: ${seen.sides} ${seen.lengths}`));
        assert.ok(Math.abs(seen.flexion - flexion) < 0.11, `${pole}: ${seen.flexion} ${flexion}`);
        assert.ok(Math.max(...seen.labels) < 0.5, `${pole}, ${name}: labels are ${seen.labels} pixels from elbow and wrist`);
      }
    });
  }
});

onDemo('the lesson shows the library\'s entities, step by step, while the arm is dragged', async (page) => {
  const heading = () => page.textContent('.lesson h3'), summary = page.getByText('The lecture, step by step');
  await summary.focus();
  await page.keyboard.press('ArrowRight');  // while it is closed, keys are not its own
  const open = await difference(page, async () => {
    await summary.click();
    await page.locator('.labels span').first().waitFor();
  });
  assert.ok(open.share > 0.003, `${open.share}`);
  const wanted = [['pw', 'πswivel', 'S1', 'S2', 'PP', 'pe'], ['lse', 'lew', 'c4', 'qe'], ['pze', 'πM', 'πe', 'lM'], ['q12'], ['c3', 'q3', 'qs']];
  for (const [step, names] of wanted.entries()) {
    assert.deepEqual(await page.locator('.entities dt').allTextContents(), names);
    assert.ok((await heading()).startsWith(`${step + 1}. `));
    assert.doesNotMatch(await page.textContent('.lesson'), /[a-z]_|\bpi|\^/, 'names are typeset');
    assert.ok(await page.locator('.labels span:visible').count() > 0);
    const text = await page.locator('.entities dd').last().textContent();
    await pull(page, 'target', 6, -6);
    assert.notEqual(await page.locator('.entities dd').last().textContent(), text);
    await page.getByRole('button', { name: 'Next', exact: true }).click();
  }
  assert.ok((await heading()).startsWith('1. '));
  await summary.focus();
  await page.keyboard.press('ArrowRight');
  assert.ok((await heading()).startsWith('2. '));
  const off = await page.textContent('.lesson .hint');
  assert.ok(Number(off.match(/[\d.]+e-\d\d/)[0]) < 1e-12, off);
  await pull(page, 'target', -260, -100);
  assert.match(await page.textContent('.lesson p'), /too far by/);
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
      await choose(page, name, 0);
      assert.match(await page.textContent('.lesson'), expected);
    }
    assert.doesNotMatch(await page.textContent('.lesson'), /\b(arms?|wrist|elbow|shoulder|forearm)\b/i, 'of a leg');
  });
});

test('a crowd that carries state has the command\'s digests, in whatever order its frames are looked at', async () => {
  const toml = file('state.toml', '[budget]\nblocks = 3\n[limb.all]\nswivel.max_deg_per_frame = 2\n');
  await visit(write('state.html', 'view', clip, '--characters', '100', '--frames', '40', '--crowd', toml), (page) => assertEqualBits(page, [...range(40), 20, 21, 0, 1, 39, 2]));
});

test('goals of one\'s own are the command\'s', async () => {
  const toml = file('pole_weight.toml', '[limb.all]\nweights.pole = 0.6\n');
  const place = write('given.html', 'view', clip, '--characters', '5', '--frames', '30', '--targets', targets, '--between', 'linear', '--crowd', toml);
  await visit(place, (page) => assertEqualBits(page, [0, 7, 10, 29]));
});

const limited = `${readFileSync(new URL('../command/limited.toml', import.meta.url), 'utf8')}
[limb.all.swivel]
max_deg_per_second = 900
`;
const look = '[look]\ntarget = [60, 15, 160]\n', box = (order) => `limits.shoulder_box = { order = "${order}", x_deg = [-80, 80] }\n`;
const caches = {
  'limits, clavicles, twist bones, state, heads and targets of one\'s own': [`${limited}${hills}${look}`, '--targets', targets],
  'boxes between hands, and several clips': [`[crowd]\nlimbs = "all"\nclips = [{ file = "${clip}" }]\n${hills}${look}[carry]\nshare = 0.5\n`],
  'unlike limbs, one of which holds another': [`[crowd]\nlimbs = "all"\n[limb.legs]\nhand = false\n[limb.left_arm]\nhold = "right_arm"\n${box('ZYX')}[limb.right_arm]\n${box('XYZ')}`],
};
for (const [name, [toml, ...options]] of Object.entries(caches))
  test(`the page of a cache has the command's bits: ${name}`, async () => {
    rmSync(join(process.env.WORK, 'crowd.zarr'), { recursive: true, force: true });
    for (const words of [['store', clip, 'crowd.zarr', '--characters', '20', '--frames', '9', '--no-poses', '--crowd', file('cached.toml', toml), ...options], ['fill', 'crowd.zarr']])
      assert.equal(run(...words).stderr, '');
    await visit(write('cache.html', 'view', 'crowd.zarr'), (page) => assertEqualBits(page, [...range(9), 3]));
  });

onPage('a long clip opens', () => write('long.html', 'demo', '--characters', '2'), async (page) => {
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

test('names from files are text', async () => {
  const evil = '</script><img/src=x/onerror=alert(1)>"\'&', name = '<img src=x onerror=alert(1)>"\'&.bvh';
  const place = write('names.html', 'view', file(name, readFileSync(clip, 'utf8').replace(/ROOT \S+/, `ROOT ${evil}`)), '--frames', '5');
  await visit(place, async (page) => {
    assert.equal(await page.textContent('h1'), name);
    assert.equal(await page.evaluate(() => swivelPage.view.figure.joints[0].name), evil);
    assert.equal(await page.locator('img').count(), 0);
  });
});

test('a browser without WebGL 2 or SIMD, or with small textures, gets a sentence, and so does a command of another version', async () => {
  const refusals = [
    [/graphics cannot hold .*: a texture has 1024 texels a side, and they take \d+\. Take fewer --frames/, () => {
      const { getParameter } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.getParameter = function (name) { return name === WebGL2RenderingContext.MAX_TEXTURE_SIZE ? 1024 : getParameter.call(this, name); };
    }],
    [/This browser has no WebGL 2/, () => { HTMLCanvasElement.prototype.getContext = () => null; }],
    [/This browser has no WebAssembly with SIMD/, () => { WebAssembly.validate = () => false; }],
    [/This browser has no WebAssembly,/, () => { delete window.WebAssembly; }],
  ];
  for (const [words, before] of refusals) assert.match(await refusal(tiny, { before }), words);

  const text = readFileSync(tiny, 'utf8');
  assert.equal(signed(text), text);
  for (const [words, from, to] of [[/the command is swivel 9\.8\.7, and the page's program is swivel \d/, /"version":"[\d.]+"/, '"version":"9.8.7"'],
    [/wrote 213 bytes for the plan of left_arm, and the page's program expects 216/, /"plan":"..../, '"plan":"']])
    assert.match(await refusal(file('other.html', signed(text.replace(from, to)))), words);
});

test('a page that is cut anywhere behind its head, or of which one bit was changed, shows no crowd and says so', async () => {
  const whole = readFileSync(tiny), script = whole.indexOf('<script'), data = whole.indexOf('swivelView.start('), end = whole.indexOf('</script>'), sentence = whole.indexOf('</p>');
  assert.ok(sentence < 800 && script < data && data < end, 'the sentence comes early');
  const spread = (from, to, count) => range(count).map((n) => Math.floor(from + (to - from) * (n + 0.5) / count));
  for (const at of [sentence, script, script + 10, ...spread(script, end, 2), end - 1, end, end + 8])
    assert.match(await refusal(file('cut.html', whole.subarray(0, at))), /^This page has not arrived whole\. If this stays, its file is cut or damaged/, `cut at ${at} of ${whole.length}`);
  for (const at of [...spread(script + 21, script + 37, 2), ...spread(script + 39, data, 3), ...spread(data + 20, end, 3)]) {
    const bytes = Buffer.from(whole);
    bytes[at] ^= 1;
    assert.match(await refusal(file('changed.html', bytes)), /^This page (has not arrived whole|is damaged: its data are not those that swivel view wrote)/, `bit 0 of byte ${at}`);
  }
});
