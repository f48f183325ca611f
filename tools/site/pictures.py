#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/ that show what swivel does: solves by the Python package, drawn by matplotlib.

    PYTHONPATH=build/dev/python tools/site/pictures.py docs/pictures
    PYTHONPATH=build/dev/python tools/site/pictures.py --check docs/pictures   # do the files there show what is drawn now?

The check compares what is seen: areas, lines and words. So it does not depend on how matplotlib's version writes them down."""
import io
import re
import sys
from pathlib import Path

import matplotlib
import numpy as np

import swivel
from swivel import BodyGroup, Feature, Field, Flag, LookGroup, Plant, Pose, ShiftGroup, Skeleton

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

INK, GREY, PALE, ORANGE, RED, GREEN = "#22324a", "#5b6b80", "#a9b4c2", "#c9761a", "#b93a2b", "#23834a"
plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "swivel", "font.family": "DejaVu Sans", "font.size": 14, "text.color": INK,
                     "axes.edgecolor": INK, "axes.linewidth": 2, "axes.spines.top": False, "axes.spines.right": False, "lines.solid_capstyle": "round",
                     "figure.facecolor": "#fbfaf5", "axes.facecolor": "none", "xtick.major.size": 0, "ytick.major.size": 0})


def picture(height, left, bottom, right, top):
    """A figure 760 pixels wide with a plot between these pixels, counted from below; a point of a font is a pixel."""
    figure = plt.figure(figsize=(760 / 72, height / 72))
    axes = figure.add_axes((left / 760, bottom / height, (right - left) / 760, (top - bottom) / height))
    return figure, axes


def seen(svg):
    """For each panel and colour how large areas or how long lines are, and where they begin and end, in pixels. And each text with its place."""
    marks = dict(re.findall(r'<path id="(\w+)" d="([^"]*)"', svg))
    parts = []
    for n, panel in enumerate(svg.split('<g id="axes_')):
        parts += [(n, d, (0, 0), style) for d, style in re.findall(r'<path d="([^"]*)"[^>]*style="([^"]*)"', panel)]
        parts += [(n, marks[mark], (x, y), style) for mark, x, y, style in re.findall(r'<use xlink:href="#(\w+)" x="([^"]*)" y="([^"]*)" style="([^"]*)"', panel)]
    found = {}
    for panel, d, place, style in parts:
        is_area, colour = "fill: #" in style, "".join(re.findall("#[0-9a-f]{6}", style))
        for curve in d.split("M")[1:] if colour else ():
            points = np.array(re.findall(r"-?[\d.]+(?:e-?\d+)?", curve), float).reshape(-1, 2) + np.array(place, float)
            x, y = np.concatenate((points, points[:1])).T if is_area else points.T
            size = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2 if is_area else np.sum(np.hypot(np.diff(x), np.diff(y)))
            found.setdefault((panel, colour, is_area), []).append((size, x.min(), y.min(), x.max(), y.max()))
    sizes = {each: (abs(np.sum(rows, axis=0)[0]), *np.min(rows, axis=0)[1:3], *np.max(rows, axis=0)[3:]) for each, rows in found.items()}
    texts = [(words, re.findall(r'[xy]="([-.\d]+)"|translate\(([-.\d]+) ([-.\d]+)\)', tag)) for tag, words in re.findall("<text([^>]*)>([^<]*)", svg)]
    return sizes, [words for words, _ in texts], [float(number) for _, places in texts for place in places for number in place if number]


def are_alike(one, other):
    """To a tenth of a pixel, or a thousandth of a size."""
    (sizes, words, places), (of_other, other_words, other_places) = seen(one), seen(other)
    return sizes.keys() == of_other.keys() and words == other_words and np.allclose(places, other_places, atol=0.1) and all(
        np.allclose(size, of_other[each], rtol=1e-3, atol=0.1) for each, size in sizes.items())


# ---- hips, and a leg of thigh, shin and foot on each side; seen from the side, forwards is +z. Knees go forwards.
BONE, HIPS, ANKLE = 0.45, 0.84, 0.08
SKELETON = Skeleton([-1, 0, 1, 2, 0, 4, 5], np.float32([(0, HIPS, 0), (0.1, 0, 0), (0, -BONE, 0), (0, -BONE, 0), (-0.1, 0, 0), (0, -BONE, 0), (0, -BONE, 0)]))


def leg(thigh, features):
    return BodyGroup(thigh, thigh + 1, thigh + 2, bend=(0, 0, -1), features=features | Feature.POLE_INCOMING | Feature.WITH_PLANT)


def solved(crowd, pose, time, root=(0, 0, 0)):
    """The pose of one figure after a solve, and the places of its joints."""
    rotations, places = pose.copy(), np.zeros((1, 7, 3), np.float32)
    crowd.solve(pose=Pose(rotations, joint_positions=places, root_position=np.float32(root), time=time))
    return rotations, places[0]


def standing():
    pose = np.zeros((1, 7, 4), np.float32)
    pose[..., 3] = 1
    for thigh in (1, 4):
        pose[0, thigh, [0, 3]], pose[0, thigh + 1, [0, 3]] = (-np.sin(0.2), np.cos(0.2)), (np.sin(0.4), np.cos(0.4))
    return pose


# ---- a foot over time: where the animation has it, and where it is sent
def foot_over_time(knots, is_down):
    """Times, places as animated and as sent, and flags; knots are time, place and speed of a curve of cubics."""
    crowd, times = swivel.Crowd(leg(1, Feature.WITH_RECORD), skeleton=SKELETON, body_count=1), np.arange(0, knots[-1][0] + 0.001, 0.01)
    animated, sent, flags = [], [], []
    for time in times:
        (t, a, speed), (end, b, end_speed) = next(pair for pair in zip(knots, knots[1:]) if time <= pair[1][0] + 1e-9)
        u = (time - t) / (end - t)
        v = 1 - u
        animated.append(v * v * (1 + 2 * u) * a + u * u * (3 - 2 * u) * b + (end - t) * u * v * (v * speed - u * end_speed))
        crowd.write(Field.CONTACT, float(is_down(time)))
        solved(crowd, standing(), 0.01, (0, 0, animated[-1]))
        sent.append(crowd.read(Field.SOLVED_GOAL)[0, 2])
        flags.append(int(crowd.read(Field.FLAGS)[0]))
    return times, np.array(animated), np.array(sent) - sent[0] + animated[0], np.array(flags)


def first(times, flags, flag, after=0.0):
    return times[(times >= after) & (flags & flag > 0)][0]


def chart(times, animated, sent, span, low, high):
    """A chart of a foot's place against time, with the stretch of the contact below it."""
    figure, axes = picture(350, 60, 50, 740, 310)
    axes.set(xlim=(times[0], times[-1]), ylim=(low, high), xticks=[], yticks=[])
    axes.plot(times, animated, color=PALE, lw=3)
    axes.plot(times, sent, color=ORANGE, lw=4)
    axes.axvspan(*span, -20 / 260, -8 / 260, color=GREEN, alpha=0.45, lw=0, clip_on=False)
    axes.text(times[-1], low - 42 * (high - low) / 260, "time", ha="right")
    axes.text(times[0] + 0.01, high + 12 * (high - low) / 260, "place of the foot along its way")
    return figure, axes


def upright(axes, time, words, align="center"):
    low, high = axes.get_ylim()
    top = high - 0.1 * (high - low)
    axes.plot([time, time], [low, top], color=PALE, lw=1, ls=(0, (3, 4)))
    axes.text(time, top + 0.02 * (high - low), words, color=GREY, ha=align)


def stretch(axes, start, end, words, height):
    axes.plot([start, end], [height, height], color=GREEN, lw=2, marker="|", ms=10, mew=2)
    axes.text((start + end) / 2, height + 0.035 * np.ptp(axes.get_ylim()), words, color=GREEN, ha="center")


def feet_plant():
    down, up = 0.5, 1.1
    times, animated, sent, flags = foot_over_time([(0, 0, 0), (0.5, 0.5, 0.8), (0.64, 0.54, -0.1), (1.1, 0.44, -0.2), (1.6, 1.0, 0.8)], lambda time: down <= time < up)
    locked = first(times, flags, Flag.PLANTED)
    free = first(times, flags, Flag.RELEASED, locked)
    seen = (times >= 0.3) & (times <= 1.4)
    figure, axes = chart(times[seen], animated[seen], sent[seen], (down, up), 0.25, 0.75)
    upright(axes, locked, "locks"), upright(axes, free, "is released")
    stretch(axes, locked, locked + Plant().stop_time, "stop_time", 0.345), stretch(axes, free, free + Plant().release_time, "release_time", 0.345)
    axes.text(0.8, 0.17, "the label says: in contact", color=GREEN, ha="center")
    axes.text(0.82, 0.57, "stands: not a bit changes", color=ORANGE, ha="center")
    axes.text(0.86, 0.435, "as animated: it slides", color=GREY, ha="center")
    return figure


def feet_break():
    times, animated, sent, flags = foot_over_time([(0, 0, 0), (0.3, 0, 0), (0.5, 0.05, 0.45), (1.0, 0.275, 0.45), (1.3, 0.34, 0), (2, 0.34, 0)], lambda time: time >= 0.1)
    broke = first(times, flags, Flag.BROKE_AWAY)
    anew = first(times, flags, Flag.PLANTED, broke + 0.02)
    seen, unlock = (times >= 0.05) & (times <= 1.8), 2 * BONE * Plant().unlock_radius
    figure, axes = chart(times[seen], animated[seen], sent[seen], (0.1, 1.8), -0.06, 0.4)
    axes.fill_between([0.1, broke], -0.06, unlock, color=ORANGE, alpha=0.09, lw=0)
    axes.plot([0.1, broke], [unlock, unlock], color=PALE, lw=1, ls=(0, (3, 4)))
    axes.text(0.12, unlock + 0.014, "unlock_radius", color=GREY)
    upright(axes, broke, "breaks away", "right"), upright(axes, anew, "below relock_speed: locks", "left")
    stretch(axes, broke, broke + Plant().release_time, "release_time", -0.04)
    axes.text(0.9, -0.134, "the label says: in contact, all the time", color=GREEN, ha="center")
    axes.text(0.3, 0.02, "stands", color=ORANGE, ha="center")
    axes.text(0.58, 0.13, "as animated", color=GREY, ha="right")
    return figure


# ---- legs from the side
def stepping(features, animated, ahead):
    """Joints of legs whose points go where they are written, in place of where the animation has them; and the new pose."""
    shifts = [ShiftGroup()] * bool(features & Feature.WITH_PELVIS_FIT)
    crowd = swivel.Crowd([leg(1, features), leg(4, features), *shifts], skeleton=SKELETON, body_count=1)
    for group, place in enumerate(((0.1, ANKLE, -0.2), (-0.1, *ahead))):
        crowd.write(Field.TARGET, place, group), crowd.write(Field.CONTACT, 1.0, group)
    return solved(crowd, animated, 0.01)


def draw_leg(axes, middle, places, thigh, colour, width=6, style="-"):
    hip, knee, ankle = places[thigh:thigh + 3, 1:] @ ((0, 1), (1, 0)) + (middle, 0)  # ahead, up
    heel = ankle - (0.05, ANKLE)
    axes.plot(*zip(hip, knee, ankle, heel, heel + (0.22, 0)), color=colour, lw=width, ls=style, solid_joinstyle="round")
    axes.plot(*knee, "o", color=colour, ms=9)


def feet_reach():
    figure, axes = picture(330, 0, 0, 760, 330)
    axes.set(xlim=(-0.46, 3.54), ylim=(-65 / 190, 265 / 190), xticks=[], yticks=[])
    axes.axis("off")
    animated, places = stepping(Feature(0), standing(), (ANKLE, 0.22))
    lower, farther, step = (ANKLE - 0.19, 0.22), (ANKLE, 0.38), 0.19
    panels = [("as animated,\non flat ground", places, 0), ("a step down:\none leg is too short", stepping(Feature(0), animated, lower)[1], step),
              ("with a shift\nboth legs reach", stepping(Feature.WITH_PELVIS_FIT, animated, lower)[1], step),
              ("a step too long: with a\ncap the knee stays bent", stepping(Feature.WITH_CAP, animated, farther)[1], 0)]
    for n, (words, joints, down) in enumerate(panels):
        middle = 0.97 * n
        axes.text(middle + 0.03, 1.15, words, ha="center", linespacing=1.4)
        axes.plot(middle + np.array((-0.42, 0.08, 0.08, 0.46)), (0, 0, -down, -down), color=INK, lw=2)
        if n == 3:
            draw_leg(axes, middle, stepping(Feature(0), animated, farther)[1], 4, RED, 2.5, (0, (3, 2)))
        draw_leg(axes, middle, joints, 1, PALE), draw_leg(axes, middle, joints, 4, ORANGE)
        axes.plot(middle + joints[0, 2], joints[0, 1], "o", color=INK, ms=18)
    axes.plot(0.97 + lower[1], lower[0], "o", color=RED, ms=9)
    axes.annotate("", (1.8, panels[2][1][0, 1] - 0.02), (1.8, places[0, 1]), arrowprops={"arrowstyle": "->", "color": GREEN, "lw": 2.5, "shrinkA": 0, "shrinkB": 0})
    axes.text(2.92, -0.25, "dashed: without one", color=RED, ha="center")
    return figure


# ---- a look: how far each joint turns
def look_round():
    joints = ("spine", PALE, 1, 0.99), ("chest", GREEN, 1, 0.98), ("neck", RED, 2, 0.85), ("head", ORANGE, 4, 0.5)
    names, colours, shares, max = zip(*joints)
    look = LookGroup([0, 1, 2, 3], share=shares, cos_max=max, rate=0)
    degrees = np.arange(181)
    angles = np.radians(degrees)
    crowd = swivel.Crowd(look, skeleton=Skeleton([-1, 0, 1, 2], np.float32([(0, 1, 0), (0, 0.2, 0), (0, 0.25, 0), (0, 0.1, 0)])), body_count=181)
    crowd.write(Field.LOOK_TARGET, np.stack((2 * np.sin(angles), np.full(181, 1.55), 2 * np.cos(angles)), axis=1))
    rotations = np.tile(np.float32((0, 0, 0, 1)), (181, 4, 1))
    crowd.solve(pose=Pose(rotations))
    edges = np.cumsum([np.zeros(181), *np.degrees(2 * np.arctan2(rotations[..., 1], rotations[..., 3])).T], axis=0)
    figure, axes = picture(370, 70, 60, 730, 320)
    axes.set(xlim=(0, 180), ylim=(0, 122), xticks=range(0, 181, 45), yticks=(45, 90))
    axes.tick_params(colors=INK, pad=6)
    full, none = np.degrees(np.arccos((look.cos_full, look.cos_none)))
    axes.axvspan(full, none, color=PALE, alpha=0.2, lw=0)
    axes.text((full + none) / 2, 125, "fades", color=GREY, ha="center")
    axes.plot([0, 120], [0, 120], color=PALE, lw=1, ls=(0, (3, 4)))
    axes.text(82, 97, "to the target", color=GREY, ha="right")
    for below, above, name, colour in zip(edges, edges[1:], names, colours):
        axes.fill_between(degrees, below, above, color=colour, alpha=0.35, lw=0)
        axes.plot(degrees, above, color=colour, lw=2.5)
        axes.text(64, (below[64] + above[64]) / 2, name, ha="center", va="center_baseline")
    axes.text(180, -21, "degrees between the target and ahead", ha="right")
    axes.text(2, 125, "degrees turned")
    return figure


# ---- a region: what a clip's upper arm does, on a disc that is all directions, with equal areas
def direction(x, y):
    far2 = np.minimum(x * x + y * y, 1)
    scale = 2 * np.sqrt(1 - far2)
    return np.stack((scale * x, scale * y, 1 - 2 * far2), axis=-1).astype(np.float32)


def region():
    along = np.arange(241)
    turn, far = np.radians(80 - 230 * along / 240), 0.55 + 0.05 * np.sin(along / 8)  # up, out to the side, down; it sways
    x, y = far * np.cos(turn), far * np.sin(turn)
    grid = (np.arange(201) - 100) / 100
    across, up = np.meshgrid(grid, grid)
    is_on = across**2 + up**2 < 1
    figure, axes = picture(380, 20, 10, 740, 370)
    axes.set(xlim=(-1.2, 3.6), ylim=(-1.2, 1.2))
    axes.axis("off")
    shares = []
    for max_cones, colour in ((1, PALE), (6, GREEN)):
        around = swivel.Region()
        around.add_directions(direction(x, y), np.radians(5), max_cones)
        rooms = np.reshape(around.room(direction(across, up).reshape(-1, 3)), across.shape)
        axes.contourf(grid, grid, rooms, levels=(0, 2), colors=colour, alpha=0.5)
        shares.append(100 * np.sum(is_on & (rooms >= 0)) / np.sum(is_on))
    rim = np.radians(np.arange(0, 361, 2))
    axes.plot(np.cos(rim), np.sin(rim), color=INK, lw=2)
    axes.plot(x, y, color=ORANGE, lw=3.2)
    for height, colour, words in ((0.55, ORANGE, "where the clip's upper arm points"), (0.28, GREEN, f"the region: {shares[1]:.0f} % of all directions"),
                                  (0.01, PALE, f"one cone around it: {shares[0]:.0f} %")):
        axes.plot(1.33, height + 0.04, "s", color=colour, ms=15, alpha=0.7, mew=0)
        axes.text(1.46, height, words)
    axes.text(1.27, -0.33, "The disc is all directions, of equal areas.\nThe arm at rest is its middle.", color=GREY, va="top", linespacing=1.4)
    return figure


def main(folder, is_check):
    import half_line  # here, because both take their style from this file
    import mistake_pictures

    drawings = {draw.__name__: draw for draw in (feet_plant, feet_break, feet_reach, look_round, region, mistake_pictures.mistakes)}
    for name, draw in (drawings | {"half_line": half_line.drawn}).items():
        path, drawn = Path(folder) / f"{name}.svg", io.StringIO()
        draw().savefig(drawn, metadata={"Date": None, "Creator": None})
        if not is_check:
            path.write_text(drawn.getvalue(), encoding="utf-8")
        elif not are_alike(path.read_text(encoding="utf-8"), drawn.getvalue()):
            sys.exit(f"{path} is not what swivel does; run tools/site/pictures.py docs/pictures")


if __name__ == "__main__":
    main(sys.argv[-1], "--check" in sys.argv)
