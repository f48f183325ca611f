// SPDX-License-Identifier: MIT
// The promise: people can use the page: choose a limb, drag its goals and limits, play, learn, by mouse and keyboard, in light and dark.
//   ARM: tests/page/limb.cpp
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { demo, difference, drag, pixel, until, visit } from './harness.mjs';

/** Looks at character 3 from near; its left arm is chosen by a link. */
const link = { hash: '#frame=20&character=3&limb=left_arm' };

test('a dragged wrist gives the native library\'s elbow, bit for bit', async () => {
  await visit(demo, async (page) => {
    const from = await pixel(page, 'target'), before = await page.evaluate(() => swivelPage.stage.digest());
    await drag(page, from, { x: from.x - 60, y: from.y - 45 });
    const made = await page.evaluate(() => {
      const { stage, selection: { limb, character } } = swivelPage, { skeleton, memory } = stage, above = limb.chain.shoulder - 1;
      const bits = (array) => Array.from(new Uint8Array(array.buffer, array.byteOffset, array.byteLength)), { elbows, wrists } = stage.joints(limb, character, 1);
      const features = new BigUint64Array([stage.featuresOf(limb)]), rest = (numbers, parts) => numbers.slice(parts * above, parts * (above + 4));
      const floats = new Float32Array([...rest(skeleton.translations, 3), ...rest(skeleton.rotations, 4), ...limb.chain.bend]);
      const root = memory.bytes(stage.rootsAt + 32 * character, 32), input = memory.bytes(stage.input(limb, character, 'target').byteOffset, 272);
      const size = stage.poses.length / stage.characterCount, pose = stage.poses.slice(size * character + 4 * above, size * character + 4 * (above + 4));
      return {
        given: [features, floats, root, input].flatMap(bits), words: Array.from(new Uint32Array(pose.buffer), (word) => word.toString(16).padStart(8, '0')),
        doubles: [elbows, wrists].flatMap((v) => Array.from(new BigUint64Array(v.buffer, v.byteOffset, 3), (word) => word.toString(16).padStart(16, '0'))),
        state: stage.digestState(), digest: stage.digest(),
      };
    });
    assert.notEqual(made.digest, before);
    assert.equal(made.state, 'changed');
    const native = execFileSync(process.env.ARM, { input: Buffer.from(made.given), encoding: 'utf8' });
    assert.equal([...made.words, ...made.doubles].join(' '), native.trim());
    const now = await pixel(page, 'target');
    assert.ok(Math.hypot(now.x - from.x + 60, now.y - from.y + 45) < 2, 'the target is under the pointer');
    await page.getByRole('button', { name: 'Let go' }).click();
    assert.equal(await page.evaluate(() => swivelPage.stage.digest()), before);
  }, link);
});

test('a dragged pole turns the elbow and leaves the wrist; everyone\'s follow if asked', async () => {
  await visit(demo, async (page) => {
    const poses = () => page.evaluate(() => [3, 7].map((n) => swivelPage.stage.pose(swivelPage.stage.limbs[0], n)));
    const distance = (a, b) => Math.hypot(...a.map((c, n) => c - b[n]));
    const move = async () => {
      const before = await poses(), from = await pixel(page, 'pole');
      await drag(page, from, { x: from.x + 50, y: from.y + 70 });
      const after = await poses();
      return [0, 1].map((n) => [distance(before[n].elbow, after[n].elbow), distance(before[n].wrist, after[n].wrist)]);
    };
    const [[elbow, wrist], [other]] = await move();
    assert.ok(elbow > 0.001 && wrist < 1e-6 && other === 0, `${elbow} ${wrist} ${other}`);
    await page.getByLabel("Drag everyone's").check();
    const [, [followed]] = await move();
    assert.ok(followed > 0.001, `${followed}`);
  }, link);
});

test('a click chooses the limb under it, another place chooses nothing', async () => {
  await visit(demo, async (page) => {
    await page.evaluate(() => swivelPage.select(null));
    const at = await page.evaluate(() => {
      const { stage, view } = swivelPage, { elbow, wrist } = stage.pose(stage.limbs[1], 3);
      return view.project(elbow.map((c, n) => (c + wrist[n]) / 2));
    });
    await page.mouse.click(at.x, at.y);
    const chosen = await page.evaluate(() => [swivelPage.selection.limb.name, swivelPage.selection.character, document.querySelector('aside h3').textContent, document.querySelector('.why').textContent,
      swivelPage.stage.explain(swivelPage.selection.limb, swivelPage.selection.character)]);
    assert.deepEqual(chosen.slice(0, 3), ['right_arm', 3, 'right arm of character 3']);
    assert.equal(chosen[3], chosen[4]);
    await page.mouse.click(30, 400);
    assert.equal(await page.evaluate(() => swivelPage.selection), null);
    const low = await page.evaluate(() => {  // an arm whose hand is below the bar
      const { stage, view } = swivelPage, arm = stage.limbs[1], { shoulder, elbow, wrist } = stage.pose(arm, 3);
      const middle = shoulder.map((c, n) => (c + elbow[n]) / 2);
      for (let tries = 0; tries < 200 && view.isSeen(wrist); ++tries) {
        for (const at of [view.camera.position, view.controls.target]) at.y += 0.02;
        view.controls.update();
      }
      return { ...view.project(middle), isSeen: [middle, wrist].map((point) => view.isSeen(point)) };
    });
    assert.deepEqual(low.isSeen, [true, false]);
    await page.mouse.click(low.x, low.y);
    const all = await page.evaluate(() => swivelPage.pointsOf(swivelPage.selection.limb, swivelPage.selection.character).map((point) => swivelPage.view.isSeen(point)));
    assert.ok(all.length >= 4 && all.every((isSeen) => isSeen), `${all}`);
  }, link);
});

test('limits: switches add them, sliders and the rim of the cone move them, flags say so', async () => {
  await visit(demo, async (page) => {
    const flags = () => page.evaluate(() => swivelPage.stage.flags(swivelPage.stage.limbs[0], 3));
    await page.getByText('Limits and weights').click();
    await page.locator('[data-field=SHOULDER_CONE]').check();
    await page.locator('.field').filter({ hasText: 'Shoulder cone' }).getByLabel('Opening').fill('35');
    assert.ok((await flags()) & (1 << 7 | 1 << 15), 'limited by the cone, or infeasible');
    const rim = () => page.evaluate(() => {
      const { x, y, z } = swivelPage.picker.handles.cone.getWorldPosition(swivelPage.view.camera.position.clone());
      return swivelPage.view.project(swivelPage.view.toClip({ x, y, z }));
    });
    const opening = () => page.evaluate(() => Math.acos(swivelPage.stage.field(swivelPage.stage.limbs[0], 'SHOULDER_CONE')[3]) * 180 / Math.PI);
    assert.ok(Math.abs((await opening()) - 35) < 0.1);
    const from = await rim(), digest = await page.evaluate(() => swivelPage.stage.digest());
    await drag(page, from, { x: from.x + 40, y: from.y + 40 });
    assert.ok(Math.abs((await opening()) - 35) > 3, `${await opening()}`);
    assert.notEqual(await page.evaluate(() => swivelPage.stage.digest()), digest);
    for (const field of ['FLEXION_LIMIT', 'HUMERAL_TWIST', 'SHOULDER_BOX', 'WRIST_BOX', 'HAND_CONE', 'FOREARM_TWIST', 'HAND_TWIST', 'WEIGHTS', 'REACH', 'MOST_SWIVEL']) {
      await page.locator(`[data-field=${field}]`).check();
      assert.ok(await page.evaluate((name) => swivelPage.stage.has(swivelPage.stage.limbs[0], name), field), field);
      assert.equal(await page.evaluate(() => swivelPage.stage.flags(swivelPage.stage.limbs[0], 3) >>> 30), 0, `${field}: bad input`);
    }
    for (const box of await page.locator('[data-field]').all()) await box.uncheck();
    assert.equal(await page.evaluate(() => swivelPage.stage.digestState()), 'equal');
  }, link);
});

test('overlays, colours, light and dark, drawn characters change the picture', async () => {
  await visit(demo, async (page) => {
    await page.evaluate(() => swivelPage.fields.SHOULDER_CONE.set([50]));
    const pole = await pixel(page, 'pole');
    await drag(page, pole, { x: pole.x - 100, y: pole.y });  // at the elbow, its lines would lie on the limb
    await page.getByText('Limits and weights').click();
    await page.locator('[data-field=SHOULDER_CONE]').check();
    await page.getByText('Overlays', { exact: true }).click();
    for (const overlay of ['spheres', 'circle', 'plane', 'middle', 'pole', 'cones']) {
      const { share } = await difference(page, () => page.evaluate((name) => document.querySelector(`[data-overlay=${name}]`).click(), overlay));
      assert.ok(share > 0.0001, `${overlay}: ${share}`);
    }
    for (const colour of ['Error', 'Flag', 'Flexion']) {
      const { share } = await difference(page, () => page.getByLabel('Colour limbs by').selectOption(colour));
      assert.ok(share > 0.002, `${colour}: ${share}`);
      assert.ok(await page.locator('.legend li').count() >= 5);
    }
    const theme = await difference(page, () => page.getByRole('button', { name: 'Light or dark' }).click());
    assert.ok(theme.share > 0.5);
    const drawn = await difference(page, () => page.evaluate(() => swivelPage.drawFirst(4)));
    assert.ok(drawn.share > 0.005, `${drawn.share}`);
  }, link);
});

test('a limb has the legend\'s colour of its gravest flag', async () => {
  await visit(demo, async (page) => {
    await page.getByLabel('Colour limbs by').selectOption('Flag');
    await page.evaluate(() => {  // a pole behind the shoulder, where a cone does not let the elbow go
      const { stage, selection: { limb, character } } = swivelPage;
      swivelPage.drag('pole', stage.shoulder(limb, character).map((x, axis) => x - (axis === 2 ? 5 : 0)));
    });
    /** The legend's name for the colour in the middle of character 3's left upper arm, whatever light falls on it. */
    const seen = () => page.evaluate(() => {
      const { stage, view } = swivelPage, limb = stage.limbs.find(({ name }) => name === 'left_arm'), pose = stage.pose(limb, 3);
      swivelPage.select(null);
      window.isSeen = true;
      swivelPage.draw();
      const from = document.querySelector('canvas'), copy = document.createElement('canvas'), context = copy.getContext('2d');
      [copy.width, copy.height] = [from.width, from.height];
      context.drawImage(from, 0, 0);
      window.isSeen = false;
      const at = view.project(pose.shoulder.map((x, axis) => (x + pose.elbow[axis]) / 2)), scale = from.width / from.clientWidth;
      const light = context.getImageData(at.x * scale, at.y * scale, 1, 1).data.slice(0, 3);
      const alike = (colour) => colour.reduce((sum, c, n) => sum + c * light[n], 0) / Math.hypot(...colour);
      const entries = [...document.querySelectorAll('.legend li')].map((entry) =>
        [alike(getComputedStyle(entry.firstChild).backgroundColor.match(/\d+/g).map(Number)), entry.textContent]);
      return entries.reduce((best, entry) => (entry[0] > best[0] ? entry : best))[1];
    });
    const cone = (degrees) => page.evaluate((value) => {
      swivelPage.fields.SHOULDER_CONE.set([value]);
      const box = document.querySelector('[data-field=SHOULDER_CONE]');
      if (!box.checked) box.click();
    }, degrees);
    assert.equal(await seen(), 'reached');
    await cone(5);
    assert.equal(await seen(), 'infeasible');
    await cone(80);
    assert.equal(await seen(), 'limited');
    await cone(170);
    await page.evaluate(() => {
      swivelPage.select({ limb: swivelPage.stage.limbs.find(({ name }) => name === 'left_arm'), character: 3 });
      swivelPage.drag('target', swivelPage.stage.pose(swivelPage.selection.limb, 3).shoulder.map((x, axis) => x + (axis === 1 ? -5 : 0)));
    });
    assert.equal(await seen(), 'out of reach');
  }, link);
});

test('the lesson shows the library\'s entities, step by step, while the arm is dragged', async () => {
  await visit(demo, async (page) => {
    const open = await difference(page, async () => {
      await page.getByText('The lecture, step by step').click();
      await page.locator('.labels span').first().waitFor();
    });
    assert.ok(open.share > 0.003, `${open.share}`);
    const wanted = [['pw', 'πswivel', 'S1', 'S2', 'PP', 'pe'], ['lse', 'lew', 'c4', 'qe'], ['pze', 'πM', 'πe', 'lM'], ['q12'], ['c3', 'q3', 'qs']];
    for (const [step, names] of wanted.entries()) {
      assert.deepEqual(await page.locator('.entities dt').allTextContents(), names);
      assert.ok((await page.textContent('.lesson h3')).startsWith(`${step + 1}. `));
      assert.doesNotMatch(await page.textContent('.lesson'), /[a-z]_|\bpi|\^/, 'names are typeset');
      assert.ok(await page.locator('.labels span:visible').count() > 0);
      const text = await page.locator('.entities dd').last().textContent(), from = await pixel(page, 'target');
      await drag(page, from, { x: from.x + 6, y: from.y - 6 });
      assert.notEqual(await page.locator('.entities dd').last().textContent(), text);
      await page.getByRole('button', { name: 'Next', exact: true }).click();
    }
    assert.ok((await page.textContent('.lesson h3')).startsWith('1. '));
    const off = await page.textContent('.lesson .hint');
    assert.ok(Number(off.match(/[\d.]+e-\d\d/)[0]) < 1e-12, off);
    const from = await pixel(page, 'target');
    await drag(page, from, { x: from.x - 260, y: from.y - 100 });
    assert.match(await page.textContent('.lesson p'), /too far by/);
  }, link);
});

test('the lesson leaves keys alone while it is closed, and errors that are not the solver\'s', async () => {
  await visit(demo, async (page) => {
    const summary = page.getByText('The lecture, step by step');
    await summary.focus();
    await page.keyboard.press('ArrowRight');
    await summary.click();
    await page.locator('.lesson h3:not(:empty)').waitFor();
    assert.ok((await page.textContent('.lesson h3')).startsWith('1. '));
    await summary.focus();
    await page.keyboard.press('ArrowRight');
    assert.ok((await page.textContent('.lesson h3')).startsWith('2. '));
    assert.equal(await page.evaluate(() => {
      swivelPage.stage.swivel.steps = () => { throw new TypeError('a fault'); };
      try { swivelPage.setFrame(3); } catch (error) { return error.message; }
      return 'hidden';
    }), 'a fault');
  }, { ...link, spoils: true });
});

test('the page is light or dark as the system, and plays at once, unless the system asks for less motion or the link names a frame', async () => {
  const opened = async (options) => {
    let playing, theme;
    await visit(demo, async (page) => {
      [theme, ...playing] = await page.evaluate(() => [document.documentElement.dataset.theme, swivelPage.player.isPlaying, document.querySelector('.play').textContent]);
      assert.equal(theme, options.colorScheme ?? 'light');
      if (playing[0]) await until(page, () => swivelPage.stage.frame, (frame) => frame > 0);
      else assert.equal(await page.evaluate(() => swivelPage.stage.frame), options.hash ? 20 : 0);
      await page.evaluate(() => swivelPage.player.pause());
    }, { ...options, isFresh: true });
    return playing;
  };
  const moves = { reducedMotion: 'no-preference' };
  assert.deepEqual(await opened(moves), [true, 'Pause']);
  assert.deepEqual(await opened({ ...moves, hash: '#character=3' }), [true, 'Pause']);
  assert.deepEqual(await opened({ ...moves, ...link, colorScheme: 'dark' }), [false, 'Play']);
  assert.deepEqual(await opened({ reducedMotion: 'reduce' }), [false, 'Play']);
});

test('play, pause and play within one picture play at one speed', async () => {
  await visit(demo, async (page) => {
    const ticks = await page.evaluate(async () => {
      const { player } = swivelPage, times = [], { tick } = player;
      player.tick = (now) => {
        times.push(now);
        tick.call(player, now);
      };
      [0, 1, 2].forEach(() => player.toggle());
      while (times.length < 6) await new Promise(requestAnimationFrame);
      player.pause();
      return times;
    });
    assert.equal(new Set(ticks).size, ticks.length, `${ticks}`);
  });
});

test('links: the first characters and the chosen one are drawn; frames and limbs that there are', async () => {
  await visit(demo, async (page) => {
    const go = async (hash) => {
      await page.evaluate((to) => new Promise((resolve) => {
        addEventListener('hashchange', () => setTimeout(resolve), { once: true });
        location.hash = to;
      }), hash);
      return page.textContent('.notice');
    };
    const drawn = () => page.evaluate(() => [swivelPage.drawnCount, Number(document.querySelector('[aria-label=Drawn]').value)]);
    const shown = () => page.evaluate(() => {
      const { meshes, extra } = swivelPage.view.bodies, [count, ...others] = new Set(meshes.map((mesh) => mesh.geometry.instanceCount));
      return [others.length ? others : count, extra, swivelPage.selection?.character];
    });
    assert.equal(await go('#drawn=4'), '');
    assert.deepEqual(await drawn(), [4, 4]);
    assert.equal(await go('#character=9&limb=left_arm'), '');
    assert.deepEqual(await drawn(), [4, 4]);
    assert.deepEqual(await shown(), [5, 9, 9]);
    await page.evaluate(() => swivelPage.select(null));
    assert.deepEqual(await shown(), [5, 9, undefined], 'who was chosen last stays');
    assert.equal(await go('#character=6'), '');
    assert.deepEqual(await shown(), [5, 6, 6]);
    assert.equal(await go('#drawn=8'), '');
    assert.deepEqual(await shown(), [8, null, 6]);
    assert.match(await go('#character=12&limb=left_arm'), /^No character 12 here \(0 to 11\)\.$/);
    assert.match(await go('#frame=240'), /^No frame 240 here \(0 to 239\)\.$/);
    assert.match(await go('#character=2&limb=left_wing'), /^No limb left_wing here \(left_arm, right_arm\)\.$/);
    assert.match(await go('#frame=240&character=-1&limb=tail&drawn=0'), /^0 characters cannot .*1 to 12.* No frame 240 .* No character -1 .* No limb tail /);
    assert.equal(await go('#frame=3&character=10&limb=left_arm'), '');
    assert.equal(await page.evaluate(() => swivelPage.stage.frame), 3);
  });
});

test('keyboard: play, steps, ends, choice, help, follow', async () => {
  await visit(demo, async (page) => {
    const frame = () => page.evaluate(() => swivelPage.stage.frame);
    await page.locator('canvas').focus();
    await page.keyboard.press('End');
    assert.equal(await frame(), 239);
    await page.keyboard.press('ArrowRight');
    assert.equal(await frame(), 0);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await frame(), 239);
    await page.keyboard.press('Home');
    assert.equal(await frame(), 0);
    await page.keyboard.press('n');
    assert.equal(await page.evaluate(() => swivelPage.selection.limb.name), 'right_arm');
    await page.keyboard.press('f');
    assert.equal(await page.evaluate(() => swivelPage.view.followed), 3);
    await page.keyboard.press(' ');
    await until(page, () => swivelPage.stage.frame, (now) => now > 0);
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => swivelPage.player.isPlaying), false);
    await page.keyboard.press('h');
    assert.ok(await page.getByText('play or pause').isVisible());
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    assert.equal(await page.evaluate(() => swivelPage.selection), null);
    await page.locator('.scrub').fill('100');
    assert.equal(await frame(), 100);
  }, link);
});

test('a phone sees mostly the crowd, the panel below when asked, and a touch chooses', async () => {
  await visit(demo, async (page) => {
    const at = await pixel(page, 'wrist');
    await page.evaluate(() => swivelPage.select(null));
    await page.touchscreen.tap(at.x, at.y);
    assert.equal(await page.evaluate(() => swivelPage.selection?.character), 3);
    const [above, under] = await Promise.all(['header', 'footer'].map((part) => page.locator(part).boundingBox()));
    assert.equal(await page.locator('aside').isVisible(), false);
    assert.ok(under.y - above.y - above.height > 700 * 2 / 3, `${under.y - above.y - above.height} pixels`);
    await page.getByRole('button', { name: 'Panel' }).tap();
    const box = await page.locator('aside').boundingBox();
    assert.ok(box.width < 400 && box.y > 300);
    for (const part of [page.getByText('The same bits as the command'), ...await page.getByRole('navigation').getByRole('button').all()]) {
      const { x, width } = await part.boundingBox();
      assert.ok(x >= 0 && x + width <= 390, `${x} ${width}`);
    }
    const header = await page.locator('header').boundingBox(), head = await page.evaluate(() => {
      const { stage, view, selection: { limb, character } } = swivelPage, [x, y, z] = stage.shoulder(limb, character);
      return view.project([x, y + 0.17 * view.figure.height, z]);
    });
    assert.ok(head.y > header.y + header.height && (await pixel(page, 'target')).y < box.y, `${head.y}`);
  }, { ...link, viewport: { width: 390, height: 700 }, hasTouch: true, isMobile: true });
});

test('a trail shows where the chosen wrist has been, through frames in order', async () => {
  await visit(demo, async (page) => {
    const trail = page.locator('[data-overlay=trail]'), points = () => page.evaluate(() => {
      const lines = [];
      swivelPage.view.marks.traverse((node) => { if (node.isLine) lines.push([...node.geometry.attributes.position.array].map((c, n) => c + node.parent.parent.position.toArray()[n % 3])); });
      return lines.flat();
    });
    await page.getByText('Overlays', { exact: true }).click();
    await trail.check();
    const wrists = await page.evaluate(() => [10, 11, 12, 13].map((frame) => {
      swivelPage.setFrame(frame);
      return swivelPage.stage.pose(swivelPage.selection.limb, swivelPage.selection.character).wrist;
    }));
    const drawn = await points();
    assert.equal(drawn.length, 12);
    wrists.flat().forEach((part, n) => assert.ok(Math.abs(part - drawn[n]) < 1e-4, `${part} ${drawn[n]}`));
    await page.evaluate(() => swivelPage.setFrame(40));
    assert.equal((await points()).length, 3);
  }, link);
});
