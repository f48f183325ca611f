// SPDX-License-Identifier: MIT
// The promise: what the page shows is in the picture and drawn as it is solved, and what it says fits the limb.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clip, demo, difference, drag, file, pixel, visit, write } from './harness.mjs';

const walk = write('walk.html', 'view', clip);
const crowd = write('look.html', 'demo', '--characters', '100', '--frames', '30');
/** Whether a character's joints are in the part of the picture that nothing covers. */
const isSeen = (page, character) => page.evaluate((who) => {
  const { stage, view } = swivelPage, box = (name) => document.querySelector(name).getBoundingClientRect();
  return stage.limbs.flatMap((limb) => Object.values(stage.pose(limb, who))).every((joint) => {
    const at = view.project(joint);
    return at !== null && at.x > 0 && at.x < box('aside').left && at.y > box('header').bottom && at.y < box('footer').top;
  });
}, character);

test('the camera follows a clip\'s only figure, wherever it walks', async () => {
  await visit(walk, async (page) => {
    const seen = async () => {
      const all = [];
      for (const share of [0, 0.25, 0.5, 0.99]) {
        await page.evaluate((at) => swivelPage.setFrame(Math.floor(at * swivelPage.stage.frameCount)), share);
        all.push(await isSeen(page, 0));
      }
      return all;
    };
    assert.deepEqual(await seen(), Array(4).fill(true));
    await page.evaluate(() => swivelPage.setFrame(0));  // it walks towards the camera, and past it
    await page.getByLabel('Follow').uncheck();
    assert.ok((await seen()).includes(false), 'without Follow the figure leaves the picture');
    await page.locator('canvas').focus();
    await page.keyboard.press('r');
    assert.equal(await isSeen(page, 0), true);
    await page.getByLabel('Follow').check();
    assert.deepEqual(await seen(), Array(4).fill(true));
  });
});

test('the camera looks at those that are drawn, and goes to a limb that N chooses', async () => {
  await visit(crowd, async (page) => {
    const looked = await page.evaluate(() => swivelPage.view.middle);
    assert.ok(looked < 20 && await isSeen(page, looked), `${looked}`);
    await page.keyboard.press('n');
    assert.equal(await page.evaluate(() => swivelPage.selection.character), looked);
    await page.evaluate(() => swivelPage.view.lookAt(99, true));
    assert.equal(await isSeen(page, looked), false);
    await page.keyboard.press('n');
    assert.deepEqual([await page.evaluate(() => swivelPage.selection.character), await isSeen(page, looked)], [looked, true]);
  }, { hash: '#drawn=20' });
});

test('at the top of a jump, the camera looks up to the figure', async () => {
  await visit(walk, async (page) => {
    const [jump, at] = await page.evaluate(() => {
      const { stage, view } = swivelPage, { figure } = view, height = (frame) => figure.at(0, frame).y;
      const top = Array.from({ length: figure.frameCount }, (_, frame) => frame).reduce((a, b) => (height(b) > height(a) ? b : a));
      swivelPage.setFrame(top);
      view.lookAt(0, true);
      const joints = Array.from({ length: figure.jointCount }, (_, joint) => figure.at(joint, top)).sort((a, b) => b.y - a.y);
      return [(height(top) - height(0)) / figure.height, view.project(joints[0].toArray()).y - document.querySelector('header').getBoundingClientRect().bottom];
    });
    assert.ok(jump > 0.1, `${jump} heights`);
    assert.ok(at > 0, `${at} pixels below the header`);
  });
});

test('of a lone row, many are seen', async () => {
  await visit(crowd, async (page) => {
    const seen = await Promise.all(Array.from({ length: 10 }, (_, who) => isSeen(page, who)));
    assert.ok(seen.filter((each) => each).length >= 5, `${seen}`);
  }, { hash: '#drawn=10' });
});

test('a late character is drawn alone beside the first ones, as it is solved', async () => {
  await visit(crowd, async (page) => {
    for (const change of [() => {}, () => swivelPage.setFrame(20), () => swivelPage.drawFirst(5)]) {
      await page.evaluate(change);
      const off = await page.evaluate(() => {
        const { stage, selection: { limb }, view } = swivelPage, count = view.bodies.drawnCount, drawn = swivelPage.readback(limb, count + 1);
        return [...Array(count).keys(), 83].map((who, n) => {
          const { elbow, wrist } = stage.pose(limb, who), { place } = stage.characters[who];
          return Math.max(...[elbow, wrist].flatMap((joint, which) => joint.map((c, axis) => Math.abs(c - place[axis] - drawn[2 * n + which][axis]))));
        });
      });
      assert.ok(off.length === (await page.evaluate(() => swivelPage.drawnCount)) + 1 && Math.max(...off) < 1e-4, `${off}`);
    }
    const at = await page.evaluate(() => {
      const { elbow, wrist } = swivelPage.stage.pose(swivelPage.stage.limbs[1], 83);
      return swivelPage.view.project(elbow.map((c, n) => (c + wrist[n]) / 2));
    });
    await page.evaluate(() => swivelPage.select(null));
    await page.mouse.click(at.x, at.y);
    assert.deepEqual(await page.evaluate(() => [swivelPage.selection?.limb.name, swivelPage.selection?.character]), ['right_arm', 83]);
  }, { hash: '#character=83&limb=left_arm&drawn=20' });
});

test('figures have shadows in the first picture', async () => {
  await visit(crowd, async (page) => {
    const { share } = await difference(page, () => page.evaluate(() => {
      for (const mesh of swivelPage.view.bodies.meshes) mesh.visible = !('SHADOW' in mesh.material.defines);
    }));
    assert.ok(share > 0.01, `${share}`);
  }, { hash: '#drawn=20' });
});

test('a leg has a leg\'s words', async () => {
  const place = write('legs.html', 'view', clip, '--limbs', 'all', '--characters', '2', '--frames', '30');
  await visit(place, async (page) => {
    const words = (name) => page.evaluate((which) => {
      const { stage } = swivelPage;
      swivelPage.select({ limb: stage.limbs.find((limb) => limb.name === which), character: 1 });
      const [limb, , limits] = document.querySelectorAll('aside > details');
      return [limb, limits].flatMap((part) => [part.textContent, ...Array.from(part.querySelectorAll('.field [title]'), ({ title }) => title)]).join(' ');
    }, name);
    const arm = await words('right_arm'), leg = await words('left_leg');
    for (const [ofArm, ofLeg] of [['Wrist', 'Ankle'], ['Elbow', 'Knee'], ['arm lengths', 'leg lengths'], ['Shoulder cone', 'Hip cone'], ['Humeral twist', 'Thigh twist'],
      ['Hand cone', 'Foot cone'], ['Forearm twist', 'Shin twist'], ['Wrist box', 'Ankle box'], ['the upper arm', 'the thigh']])
      assert.deepEqual([arm.includes(ofArm), arm.includes(ofLeg), leg.includes(ofArm), leg.includes(ofLeg)], [true, false, false, true], `${ofArm}: ${arm} | ${leg}`);
    assert.doesNotMatch(leg, /\b(arms?|wrist|elbow|shoulder|forearm|humeral)\b/i);
    await page.evaluate(() => swivelPage.select(null));
    assert.match(await page.textContent('aside'), /Shoulder cone or hip cone/);
    await page.evaluate(() => {
      swivelPage.lesson.box.open = true;
      swivelPage.select({ limb: swivelPage.stage.limbs.find(({ name }) => name === 'left_leg'), character: 0 });
    });
    await page.locator('.lesson h3:not(:empty)').waitFor();
    assert.doesNotMatch(await page.textContent('.lesson'), /\b(arms?|wrist|elbow|shoulder|forearm)\b/i);
  });
});

test('bad input is a dash, and its target is shown as it was given', async () => {
  const csv = file('bad.csv', 'frame,character,limb,x,y,z\n0,0,left_arm,1e30,0,0\n0,0,right_arm,1,0,-2\n');
  await visit(write('bad.html', 'view', clip, '--frames', '1', '--targets', csv), async (page) => {
    const fact = (name) => page.evaluate((which) => [...document.querySelectorAll('aside dt')].find((each) => each.textContent === which).nextSibling.textContent, name);
    assert.equal(await fact('Off by'), '–');
    const off = await page.evaluate(() => {
      const { stage } = swivelPage, [limb] = stage.limbs, drawn = swivelPage.readback(limb, 1), { elbow, wrist } = stage.pose(limb, 0);
      return Math.max(...[elbow, wrist].flatMap((joint, n) => joint.map((c, axis) => Math.abs(c - drawn[n][axis]))));
    });
    assert.ok(off < 1e-4, `it is drawn ${off} from its rest pose`);
    assert.match(await fact('Target'), /^1e\+30, 0\.0+, 0\.0+$/);
    await page.evaluate(() => swivelPage.selectNext());
    assert.match(await fact('Target'), /^1\.0+, 0\.0+, -2\.0+$/);
    assert.match(await fact('Off by'), /^\d+(\.\d+)? arm lengths$/);
  }, { hash: '#character=0&limb=left_arm' });
});

test('how fast it solves is a mean, in a unit that suits, or unsaid', async () => {
  await visit(demo, async (page) => {
    const after = (seconds, frames) => page.evaluate(([each, count]) => {
      const { stage } = swivelPage;
      stage.solve = () => { stage.seconds = each; };
      for (let n = 0; n < count; ++n) swivelPage.setFrame(n % stage.frameCount);
      return document.querySelector('.speed').textContent;
    }, [seconds, frames]);
    assert.equal(await after(0, 60), '24 limbs solved in less than 0.1 ms');
    assert.equal(await after(2e-5, 60), '24 limbs solved in less than 0.1 ms: 1.2 million a second');
    assert.equal(await after(2e-3, 60), '24 limbs solved in 2.0 ms: 12 thousand a second');
    assert.equal(await after(1, 60), '24 limbs solved in 1000.0 ms: 24 a second');
    await page.evaluate(() => { delete swivelPage.stage.solve; });
  });
});

test('goals that were moved can all be let go when nothing is chosen', async () => {
  await visit(crowd, async (page) => {
    const all = page.getByRole('button', { name: 'Let all go' }), state = () => page.evaluate(() => swivelPage.stage.digestState());
    assert.equal(await all.isVisible(), false);
    await page.getByLabel("Drag everyone's").check();
    const from = await pixel(page, 'target');
    await drag(page, from, { x: from.x + 20, y: from.y - 20 });
    await page.keyboard.press('Escape');
    assert.deepEqual([await page.evaluate(() => swivelPage.selection), await state(), await all.isVisible()], [null, 'changed', true]);
    await all.click();
    assert.deepEqual([await state(), await all.isVisible()], ['equal', false]);
  }, { hash: '#character=3&limb=left_arm&drawn=5' });
});

test('handles have colours of their own, and a rim that is seen on any ground', async () => {
  await visit(crowd, async (page) => {
    const colours = await page.evaluate(() => Object.values(swivelPage.picker.handles).map((mesh) => [mesh, ...mesh.children].map(({ material }) => material.color.getHexString('srgb-linear'))));
    assert.equal(new Set(colours.map(([own]) => own)).size, 5, `${colours}`);
    for (const [own, rim] of colours) assert.ok(rim !== undefined && parseInt(rim.slice(2, 4), 16) < 64, `${own}: ${rim}`);
    const pole = await pixel(page, 'pole');
    await drag(page, pole, { x: pole.x - 100, y: pole.y });  // else the target's ball hides a part of it
    const { share } = await difference(page, () => page.evaluate(() => { swivelPage.picker.handles.pole.children[0].visible = false; }));
    assert.ok(share > 0.0001, `${share}`);
  }, { hash: '#character=3&limb=left_arm&drawn=5' });
});
