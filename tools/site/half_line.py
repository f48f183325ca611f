#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sweeps a wrist over a sphere of targets and counts where the elbow jumps: with a fixed pole, a direction, and Feature.POLE_HALF_LINE.

    PYTHONPATH=build/dev/python tools/site/half_line.py                                  # prints the table
    PYTHONPATH=build/dev/python tools/site/half_line.py docs/pictures/half_line.svg      # and draws the picture

Each of the million steps is at most 0.2 degrees long. A jump is a step that turns the swivel plane by more than 20 degrees. The program
fails if the half-line has one further than 10 degrees from pole_behind."""
import sys

import numpy as np
from pictures import INK, direction, picture, plt

import swivel
from swivel import Feature, Field, Group

STEP, JUMP, NEAR = np.radians((0.2, 20, 10))
BEHIND = np.float32((0, -1, 0))  # where the elbow points at rest; the poles lie there, too
ARM = np.float32((1, 1))
WAYS = {"fixed pole": 0, "direction": Feature.WORLD | Feature.POLE_DIRECTION, "half-line": Feature.POLE_HALF_LINE}
LEVELS, COLOURS = (0, 0.5, 2, 5, 20, 180), ("#eef3ea", "#bcd9bf", "#f0d9a8", "#e39b4a", "#b93a2b")  # degrees in a step


def angles(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1))


def sphere():
    """Rings about an axis that is no direction of interest, one after the other: every point is a step from the one before."""
    polar = np.arange(STEP / 2, np.pi, STEP)
    rings = []
    for each in polar:
        count = int(np.ceil(2 * np.pi * np.sin(each) / STEP)) + 1
        azimuth = np.linspace(0, 2 * np.pi, count)
        rings.append(np.stack((np.sin(each) * np.cos(azimuth), np.sin(each) * np.sin(azimuth), np.full(count, np.cos(each))), axis=-1))
    axes, _ = np.linalg.qr(np.array(((1, 2, 3), (-2, 1, 1), (1, -1, 2)), float))
    return np.concatenate(rings) @ axes


def normals(features, directions):
    """The normals of the swivel planes of arms whose wrists lie in these directions."""
    crowd = swivel.Crowd(Group(len(directions), features=features))
    crowd.write(Field.TARGET, np.float32(1.5 * directions))
    crowd.write(Field.LENGTHS, ARM)
    if features & Feature.WORLD:
        crowd.write(Field.SHOULDER_POSITION, np.zeros(3, np.float32))
    crowd.solve()
    x, y, z, w = crowd.read(Field.SHOULDER).astype(float).T
    return np.stack((1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)), axis=-1)


def table():
    """Prints a line for each way to give a pole. Returns how often the half-line's elbow jumps far from pole_behind."""
    swept = sphere()
    far = angles(swept[1:], BEHIND) > NEAR
    print(f"{len(swept)} targets\n{'':12} jumps  further than 10 degrees from pole_behind  largest step there, degrees")
    far_jumps = {}
    for name, features in WAYS.items():
        planes = normals(features, swept)
        steps = angles(planes[:-1], planes[1:])
        far_jumps[name] = np.sum(far & (steps > JUMP))
        print(f"{name:12} {np.sum(steps > JUMP):5} {far_jumps[name]:42} {np.degrees(np.max(steps[far])):30.1f}")
    return far_jumps["half-line"]


def steps_on(grid, features):
    """The larger of the turns of the swivel plane for a step in two ways across each direction."""
    side = np.cross(grid, np.where(np.abs(grid[:, :1]) < 0.6, (1.0, 0, 0), (0, 1.0, 0)))
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    here = normals(features, grid)
    turns = [angles(here, normals(features, np.cos(STEP) * grid + np.sin(STEP) * way)) for way in (side, np.cross(grid, side))]
    return np.degrees(np.maximum(*turns))


def drawn():
    figure, axes = picture(330, 10, 40, 750, 320)
    axes.set(xlim=(0, 7.4), ylim=(-1.3, 1.5))
    axes.axis("off")
    grid = np.linspace(-1, 1, 241)
    x, y = np.meshgrid(grid, grid)
    is_on, rim = x * x + y * y < 0.999, np.radians(np.arange(361))
    for n, (name, features) in enumerate(WAYS.items()):
        steps = np.full(x.shape, np.nan)
        steps[is_on] = steps_on(direction(x[is_on], y[is_on]).astype(float), features)
        middle = 1.2 + 2.5 * n
        axes.contourf(grid + middle, grid, steps, levels=LEVELS, colors=COLOURS)
        axes.plot(np.cos(rim) + middle, np.sin(rim), color=INK, lw=2)
        axes.text(middle, 1.2, name, ha="center")
    for n, (low, high, colour) in enumerate(zip(LEVELS, LEVELS[1:], COLOURS)):
        axes.plot(0.3 + 1.45 * n, -1.22, "s", color=colour, ms=13, mec=INK, mew=0.5, clip_on=False)
        axes.text(0.42 + 1.45 * n, -1.29, f"{low} to {high}°")
    return figure


if __name__ == "__main__":
    far_jumps = table()
    if len(sys.argv) > 1:
        drawn().savefig(sys.argv[1], metadata={"Date": None, "Creator": None})
        plt.close()
    sys.exit("the half-line has jumps elsewhere" if far_jumps else 0)
