// SPDX-License-Identifier: MIT
// The promise: people can use the page: choose a limb, see and colour what was solved, play, follow, learn, by mouse, fingers and keyboard, in
// light and dark. What is dragged is in drag.test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, clip, demo, difference, file, link, onDemo, onPage, pixel, pull, state, until, visit, write } from './harness.mjs';

const chosen = (page) => page.evaluate(() => swivelPage.selection && [swivelPage.selection.limb.name, swivelPage.selection.character]);
const forearm = (page, name, character) => page.evaluate(([which, who]) => {
  const { elbow, wrist } = swivelPage.stage.pose(limbOf(which), who);
  return swivelPage.view.project(elbow.map((x, axis) => (x + wrist[axis]) / 2));
}, [name, character]);
/** Whether a character's joints are in the part of the picture that nothing covers. */
const isSeen = (page, character) => page.evaluate((who) => {
  const { stage, view } = swivelPage, box = (name) => document.querySelector(name).getBoundingClientRect();
  return stage.limbs.flatMap((limb) => Object.values(stage.pose(limb, who))).every((joint) => {
    const at = view.project(joint);
    return at !== null && at.x > 0 && at.x < box('aside').left && at.y > box('header').bottom && at.y < box('footer').top;
  });
}, character);

onDemo('a click chooses the limb under it, and the panel says why it is as it is; another place chooses nothing', async (page) => {
  await choose(page, null);
  const at = await forearm(page, 'right_arm', 3);
  await page.mouse.click(at.x, at.y);
  assert.deepEqual(await chosen(page), ['right_arm', 3]);
  assert.equal(await page.textContent('aside h3'), 'right arm of character 3');
  assert.equal(await page.textContent('.why'), await page.evaluate(() => swivelPage.stage.explain(swivelPage.selection.limb, 3)));
  await page.mouse.click(425, 6);  // the sky
  assert.equal(await chosen(page), null);
});

onDemo('limits: switches add them, sliders and the rim of the cone move them, flags say so', async (page) => {
  const flags = () => page.evaluate(() => swivelPage.stage.flags(limbOf('left_arm'), 3));
  const opening = () => page.evaluate(() => Math.acos(swivelPage.stage.field(limbOf('left_arm'), 'SHOULDER_CONE')[3]) * 180 / Math.PI);
  await page.getByText('Limits and weights').click();
  await page.locator('[data-field=SHOULDER_CONE]').check();
  await page.locator('.field').filter({ hasText: 'Shoulder cone' }).getByLabel('Opening').fill('35');
  assert.ok((await flags()) & (1 << 7 | 1 << 15), 'limited by the cone, or infeasible');
  assert.ok(Math.abs((await opening()) - 35) < 0.1);
  await pull(page, 'cone', 40, 40);
  assert.ok(Math.abs((await opening()) - 35) > 3, `${await opening()}`);
  const fields = await page.evaluate(() => Object.keys(swivelPage.fields));
  assert.ok(fields.length >= 11, `${fields}`);
  for (const field of fields) {
    await page.locator(`[data-field=${field}]`).check();
    assert.ok(await page.evaluate((name) => swivelPage.stage.has(limbOf('left_arm'), name), field), field);
    assert.equal((await flags()) >>> 30, 0, `${field}: bad input`);
  }
  for (const box of await page.locator('[data-field]').all()) await box.uncheck();
  assert.equal(await state(page), 'equal');
});

onDemo('overlays, colours, light and dark, drawn characters change the picture', async (page) => {
  await page.evaluate(() => swivelPage.fields.SHOULDER_CONE.set([50]));
  await pull(page, 'pole', -100, 0);  // at the elbow, its lines would lie on the limb
  await page.getByText('Limits and weights').click();
  await page.locator('[data-field=SHOULDER_CONE]').check();
  await page.getByText('Overlays', { exact: true }).click();
  const changes = async (act, min, name) => {
    const { share } = await difference(page, act);
    assert.ok(share > min, `${name}: ${share}`);
  };
  for (const overlay of ['spheres', 'circle', 'plane', 'middle', 'pole', 'limits'])
    await changes(() => page.evaluate((name) => document.querySelector(`[data-overlay=${name}]`).click(), overlay), 0.0001, overlay);
  for (const colour of ['Error', 'Flag', 'Flexion']) {
    await changes(() => page.getByLabel('Colour limbs by').selectOption(colour), 0.002, colour);
    assert.ok(await page.locator('.legend li').count() >= 5);
  }
  await changes(() => page.getByRole('button', { name: 'Light or dark' }).click(), 0.5, 'light or dark');
  await changes(() => page.evaluate(() => swivelPage.drawFirst(4)), 0.005, 'drawn characters');
  const colours = await page.evaluate(() => Object.values(swivelPage.picker.handles).map(({ material }) => material.color.getHexString()));
  assert.equal(new Set(colours).size, 5, `balls of ${colours}`);
});

onDemo('a limb has the legend\'s colour of its gravest flag', async (page) => {
  await page.getByLabel('Colour limbs by').selectOption('Flag');
  await page.evaluate(() => {  // a pole behind the shoulder, where a cone does not let the elbow go
    const { stage, selection: { limb, character } } = swivelPage;
    swivelPage.drag('pole', stage.shoulder(limb, character).map((x, axis) => x - (axis === 2 ? 5 : 0)));
  });
  /** The legend's name for the colour in the middle of character 3's left upper arm, whatever light falls on it, with a cone this wide. */
  const seen = (opening) => page.evaluate((degrees) => {
    const { stage, view } = swivelPage, pose = stage.pose(limbOf('left_arm'), 3), box = document.querySelector('[data-field=SHOULDER_CONE]');
    swivelPage.fields.SHOULDER_CONE.set([degrees]);
    if (!box.checked) box.click();
    swivelPage.select(null);
    window.isSeen = true;
    swivelPage.draw();
    const from = document.querySelector('canvas'), copy = document.createElement('canvas'), context = copy.getContext('2d');
    [copy.width, copy.height] = [from.width, from.height];
    context.drawImage(from, 0, 0);
    window.isSeen = false;
    const at = view.project(pose.shoulder.map((x, axis) => (x + stage.pose(limbOf('left_arm'), 3).elbow[axis]) / 2)), scale = from.width / from.clientWidth;
    const light = context.getImageData(at.x * scale, at.y * scale, 1, 1).data.slice(0, 3);
    const alike = (entry) => {
      const colour = getComputedStyle(entry.firstChild).backgroundColor.match(/\d+/g).map(Number);
      return colour.reduce((sum, c, n) => sum + c * light[n], 0) / Math.hypot(...colour);
    };
    return [...document.querySelectorAll('.legend li')].reduce((best, entry) => (alike(entry) > alike(best) ? entry : best)).textContent;
  }, opening);
  assert.deepEqual([await seen(170), await seen(5), await seen(80)], ['reached', 'infeasible', 'limited']);
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

onDemo('links choose what there is, and say what there is not; the first characters and the chosen one are drawn, as they are solved', async (page) => {
  const go = async (hash) => {
    await page.evaluate((to) => new Promise((resolve) => {
      addEventListener('hashchange', () => setTimeout(resolve), { once: true });
      location.hash = to;
    }), hash);
    return page.textContent('.notice');
  };
  const drawn = () => page.evaluate(() => {
    const { drawnCount, selection, view: { bodies } } = swivelPage, late = bodies.extra === null ? [] : [bodies.extra];
    return [drawnCount, bodies.extra, selection?.character, worstDrawn([...Array(drawnCount).keys(), ...late]) < 1e-5];
  });
  assert.equal(await go('#drawn=4'), '');
  assert.deepEqual((await drawn()).slice(0, 2), [4, null]);
  assert.equal(await go('#character=9&limb=left_arm'), '');
  assert.deepEqual(await drawn(), [4, 9, 9, true]);
  await choose(page, null);
  assert.deepEqual(await drawn(), [4, 9, undefined, true], 'who was chosen last stays');
  assert.equal(await go('#frame=3&character=6'), '');
  assert.deepEqual(await drawn(), [4, 6, 6, true]);
  assert.equal(await go('#drawn=8'), '');
  assert.deepEqual(await drawn(), [8, null, 6, true]);
  assert.match(await go('#character=12&limb=left_arm'), /^No character 12 here \(0 to 11\)\.$/);
  assert.match(await go('#character=2&limb=left_wing'), /^No limb left_wing here \(left_arm, right_arm\)\.$/);
  assert.match(await go('#frame=240&character=-1&limb=tail&drawn=0'), /^0 characters cannot .*1 to 12.* No frame 240 here \(0 to 239\)\. No character -1 .* No limb tail /);
  assert.equal(await page.evaluate(() => swivelPage.stage.frame), 3);
}, {});

onDemo('keyboard: play, steps, ends, choice, help, follow', async (page) => {
  const frame = () => page.evaluate(() => swivelPage.stage.frame);
  await page.locator('canvas').focus();
  for (const [key, wanted] of [['End', 239], ['ArrowRight', 0], ['ArrowLeft', 239], ['Home', 0]]) {
    await page.keyboard.press(key);
    assert.equal(await frame(), wanted, key);
  }
  await page.keyboard.press('n');
  assert.deepEqual(await chosen(page), ['right_arm', 3]);
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
  assert.equal(await chosen(page), null);
  await page.locator('.scrub').fill('100');
  assert.equal(await frame(), 100);
  const ticks = await page.evaluate(async () => {  // play, pause and play within one picture play at one speed
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
}, { ...link, spoils: true });

test('the camera follows a clip\'s only figure, wherever it walks, and goes to a limb that N chooses', async () => {
  await visit(write('walk.html', 'view', clip), async (page) => {
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
  await visit(demo, async (page) => {
    const middle = await page.evaluate(() => swivelPage.view.middle), far = middle > 5 ? 0 : 11;
    await page.evaluate((who) => swivelPage.view.lookAt(who, true), far);
    assert.deepEqual([await isSeen(page, far), await isSeen(page, middle)], [true, false]);
    await choose(page, 'left_arm', middle);
    await page.keyboard.press('n');
    assert.deepEqual([await chosen(page), await isSeen(page, middle)], [['right_arm', middle], true]);
  });
});

onDemo('a phone sees mostly the crowd, the panel below when asked, and a touch chooses', async (page) => {
  const at = await pixel(page, 'wrist'), boxOf = (name) => page.locator(name).boundingBox();
  await choose(page, null);
  await page.touchscreen.tap(at.x, at.y);
  assert.equal((await chosen(page))[1], 3);
  const [above, under] = [await boxOf('header'), await boxOf('footer')];
  assert.equal(await page.locator('aside').isVisible(), false);
  assert.ok(under.y - above.y - above.height > 700 * 2 / 3, `${under.y - above.y - above.height} pixels`);
  await page.getByRole('button', { name: 'Panel' }).tap();
  const box = await boxOf('aside');
  assert.ok(box.width < 400 && box.y > 300);
  for (const part of [page.getByText('The same bits as the command'), ...await page.getByRole('navigation').getByRole('button').all()]) {
    const { x, width } = await part.boundingBox();
    assert.ok(x >= 0 && x + width <= 390, `${x} ${width}`);
  }
  assert.ok((await pixel(page, 'target')).y < box.y, 'the chosen limb is above the panel');
}, { ...link, viewport: { width: 390, height: 700 }, hasTouch: true, isMobile: true });

/**
 * Switches on all that swivel_draw() gives of the chosen limb, and nothing else. Tells the shapes' names, how many are given and drawn, whether each
 * is drawn in its place and colour, and whether some are the bones as solved.
 */
async function drawShapes(page) {
  await page.getByText('Overlays', { exact: true }).click();
  for (const box of await page.locator('[data-overlay]:visible').all())
    await box.setChecked(!['spheres', 'circle', 'plane', 'middle', 'trail'].includes(await box.getAttribute('data-overlay')));
  return page.evaluate(() => {
    const { stage, view: { marks }, selection: { limb, character } } = swivelPage, near = 1e-4 * stage.armLength(limb, character), drawn = [];
    marks.traverse((node) => {  // balls that one may drag are less deep, or are the rim of such a ball
      if (!node.isMesh || node.parent.isMesh || node.parent.parent?.parent !== marks) return;
      const half = node.position.clone().set(0, (node.geometry.parameters.height ?? 0) / 2, 0).applyQuaternion(node.quaternion);
      const middle = node.position.clone().add(node.parent.parent.position);
      drawn.push({ from: middle.clone().sub(half).toArray(), to: middle.clone().add(half).toArray(), color: node.material.color.getHex('srgb-linear') });
    });
    const shapes = stage.shapes(limb, character), isLike = (a, b) => apart(a.from, b.from) < near && apart(a.to, b.to) < near;
    const isDrawn = (shape) => drawn.some((mark) => mark.color === shape.color >>> 8 && isLike(mark, shape));
    const { shoulder, elbow, wrist } = stage.pose(limb, character), bones = [[shoulder, elbow], [elbow, wrist]].map(([from, to]) => ({ from, to }));
    return { names: [...new Set(shapes.map(({ name }) => name))], counts: [shapes.length, drawn.length], areDrawn: shapes.every(isDrawn),
      areSolved: bones.every((bone) => shapes.some((shape) => shape.name === 'bone' && isLike(shape, bone))) };
  });
}
const hasAll = (names, wanted) => assert.deepEqual(wanted.filter((name) => !names.includes(name)), [], `${names}`);
const colour = (page, name) => page.locator(`.swatch[title="${name}"]`).evaluate((swatch) => getComputedStyle(swatch).backgroundColor);

onDemo('all that swivel_draw() gives of the chosen limb is drawn where it is solved, each shape by one switch with its colour', async (page) => {
  await page.getByText('Limits and weights').click();
  for (const field of ['SHOULDER_CONE', 'HAND_CONE']) await page.locator(`[data-field=${field}]`).check();
  const { names, counts: [given, drawn], areDrawn, areSolved } = await drawShapes(page);
  hasAll(names, ['bone', 'incoming', 'bend', 'axis_x', 'axis_y', 'axis_z', 'target', 'pole', 'wish', 'cone']);
  assert.deepEqual([drawn, areDrawn, areSolved], [given, true, true]);
  assert.deepEqual([await colour(page, 'pole'), await colour(page, 'axis x')], ['rgb(255, 0, 255)', 'rgb(255, 0, 0)']);
  assert.equal(await page.locator('[data-overlay=ground]').isVisible(), false, 'an arm has no ground');
  assert.ok(await page.evaluate(() => {
    const swatch = document.querySelector('.swatch[title=pole]');
    swivelPage.setFrame(21);
    return swatch.isConnected;
  }), 'a hint stays from frame to frame');
});

onDemo('a miss is drawn where a limb is off its target, by its weight or out of reach, and not where it has reached it', async (page) => {
  /** Sends the hand so many arm lengths straight below the shoulder. Tells whether it reaches what it is sent to, and the misses drawn. */
  const send = (lengths) => page.evaluate((below) => {
    const { stage, selection: { limb, character } } = swivelPage, length = stage.armLength(limb, character);
    swivelPage.drag('target', stage.shoulder(limb, character).map((x, axis) => x - (axis === 1 ? below * length : 0)));
    return [(stage.flags(limb, character) & 1) === 1, stage.shapes(limb, character).filter(({ name }) => name === 'miss').length];
  }, lengths);
  assert.deepEqual([await send(0.8), await send(2)], [[true, 0], [false, 1]]);
  await page.getByText('Limits and weights').click();
  await page.locator('[data-field=WEIGHTS]').check();
  await page.evaluate(() => swivelPage.fields.WEIGHTS.set([0.5, 1, 1]));
  assert.deepEqual(await send(0.8), [true, 1], 'half of the way is reached');
});

test('an aiming arm is drawn with its elbow\'s circle about the line to its target, on which its limits\' arcs are', async () => {
  const toml = file('aims.toml', `[limb.all]
aim = { axis = [0, 1, 0], flexion_deg = 60 }
target.offset = [3, 4, 9]
limits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 170 }
`);
  await visit(write('aims.html', 'view', clip, '--characters', '2', '--frames', '30', '--crowd', toml), async (page) => {
    await choose(page, 'left_arm', 1);
    const { count, arcs, depthTest, off } = await page.evaluate(() => {
      const { stage, view: { marks }, selection: { limb, character } } = swivelPage, rings = [];
      marks.traverse((node) => { if (node.geometry?.type === 'TorusGeometry' && node.parent.parent.parent === marks) rings.push(node); });  // the spheres' are deeper
      const [{ position, quaternion, geometry: { parameters: { radius } }, material: { depthTest }, parent }] = rings;
      const centre = position.clone().add(parent.parent.position), axis = position.clone().set(0, 0, 1).applyQuaternion(quaternion);
      const offRing = (place) => {
        const from = centre.clone().fromArray(place).sub(centre);
        return Math.max(Math.abs(from.dot(axis)), Math.abs(from.length() - radius)) / stage.armLength(limb, character);
      };
      const arcs = stage.shapes(limb, character).filter(({ name }) => name === 'allowed').flatMap(({ from, to }) => [from, to]);
      return { count: rings.length, arcs: arcs.length, depthTest, off: Math.max(...[stage.pose(limb, character).elbow, ...arcs].map(offRing)) };
    });
    assert.deepEqual([count, depthTest], [1, false], 'one circle, which nothing hides');
    assert.ok(arcs > 0 && off < 1e-4, `${arcs} ends of arcs, ${off} arm lengths off the circle`);
  });
});

test('feet are drawn with their ground and the body\'s shift; an arm that goes along has no target to miss', async () => {
  const toml = file('drawn.toml', '[crowd]\nlimbs = "all"\n[ground]\n');
  await visit(write('drawn.html', 'view', clip, '--characters', '2', '--frames', '30', '--crowd', toml), async (page) => {
    await page.evaluate(() => swivelPage.setFrame(9));
    await choose(page, 'left_leg', 1);
    const { names, counts: [given, drawn], areDrawn, areSolved } = await drawShapes(page);
    hasAll(names, ['bone', 'goal', 'probe', 'ground', 'shift']);
    assert.deepEqual([drawn, areDrawn, areSolved], [given, true, true]);
    assert.equal(await colour(page, 'ground'), 'rgb(160, 82, 45)');
    const arm = await page.evaluate(() => {
      const limb = limbOf('left_arm');
      return swivelPage.stage.shapes(limb, 1).filter(({ group }) => group === limb.index).map(({ name }) => name);
    });
    assert.deepEqual(['bend', 'target', 'axis_x', 'axis_y', 'axis_z', 'miss'].filter((name) => arm.includes(name)), ['bend'], 'without axes in the air');
  });
});

onDemo('a trail shows where the chosen wrist has been, through frames in order', async (page) => {
  const points = () => page.evaluate(() => {
    const lines = [];
    swivelPage.view.marks.traverse((node) => { if (node.isLine) lines.push([...node.geometry.attributes.position.array].map((c, n) => c + node.parent.parent.position.toArray()[n % 3])); });
    return lines.flat();
  });
  await page.getByText('Overlays', { exact: true }).click();
  await page.locator('[data-overlay=trail]').check();
  const wrists = await page.evaluate(() => [10, 11, 12, 13].map((frame) => {
    swivelPage.setFrame(frame);
    return swivelPage.stage.pose(swivelPage.selection.limb, 3).wrist;
  }));
  const drawn = await points();
  assert.equal(drawn.length, 12);
  wrists.flat().forEach((part, n) => assert.ok(Math.abs(part - drawn[n]) < 1e-4, `${part} ${drawn[n]}`));
  await page.evaluate(() => swivelPage.setFrame(40));
  assert.equal((await points()).length, 3);
});

onPage('a leg has a leg\'s words',
  () => write('legs.html', 'view', clip, '--limbs', 'all', '--characters', '2', '--frames', '30'), async (page) => {
  const words = async (name) => {
    await choose(page, name, 1);
    return page.evaluate(() => {
      const [limb, , limits] = document.querySelectorAll('aside > details');
      return [limb, limits].flatMap((part) => [part.textContent, ...Array.from(part.querySelectorAll('.field [title]'), ({ title }) => title)]).join(' ');
    });
  };
  const arm = await words('right_arm'), leg = await words('left_leg');
  for (const [ofArm, ofLeg] of [['Wrist', 'Ankle'], ['Elbow', 'Knee'], ['arm lengths', 'leg lengths'], ['Shoulder cone', 'Hip cone'], ['Humeral twist', 'Thigh twist'],
    ['Hand cone', 'Foot cone'], ['Forearm twist', 'Shin twist'], ['Wrist box', 'Ankle box'], ['the upper arm', 'the thigh']])
    assert.deepEqual([arm.includes(ofArm), leg.includes(ofLeg)], [true, true], `${ofArm}: ${arm} | ${leg}`);
  assert.doesNotMatch(leg, /\b(arms?|wrist|elbow|shoulder|forearm|humeral)\b/i);
});

test('bad input is a dash, and its target is shown as it was given', async () => {
  const csv = file('bad.csv', 'frame,character,limb,x,y,z\n0,0,left_arm,1e30,0,0\n0,0,right_arm,1,0,-2\n');
  await visit(write('bad.html', 'view', clip, '--limbs', 'all', '--frames', '1', '--targets', csv), async (page) => {
    const fact = (name) => page.evaluate((which) => [...document.querySelectorAll('aside dt')].find((each) => each.textContent === which).nextSibling.textContent, name);
    assert.equal(await fact('Off by'), '–');
    assert.match(await fact('Target'), /^1e\+30, 0\.0+, 0\.0+$/);
    assert.ok((await page.evaluate(() => worstDrawn([0]))) < 1e-5, 'it is drawn in its rest pose');
    await choose(page, 'right_arm', 0);
    assert.match(await fact('Target'), /^1\.0+, 0\.0+, -2\.0+$/);
    assert.match(await fact('Off by'), /^\d+(\.\d+)? arm lengths$/);
  }, { hash: '#character=0&limb=left_arm' });
});
