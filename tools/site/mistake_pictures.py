#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws one body as Crowd.draw() shows it: as it should be, and with seven mistakes in its input that no call refuses.

    PYTHONPATH=build/dev/python tools/site/mistake_pictures.py mistakes.svg"""
import sys

import numpy as np
from matplotlib.collections import LineCollection
from pictures import INK, plt

import swivel
from swivel import BodyGroup, Feature, Field, Pose, Skeleton

# A pelvis with two legs, and a chest with two arms, 1.7 m tall; it faces z.
NAMES = ["pelvis", "l_thigh", "l_shin", "l_foot", "r_thigh", "r_shin", "r_foot", "chest", "l_upper", "l_fore", "l_hand", "r_upper", "r_fore", "r_hand"]
PARENTS = [-1, 0, 1, 2, 0, 4, 5, 0, 7, 8, 9, 7, 11, 12]
PLACES = np.float32([(0, 0.95, 0), (0.1, -0.05, 0), (0, -0.45, 0), (0, -0.42, 0), (-0.1, -0.05, 0), (0, -0.45, 0), (0, -0.42, 0), (0, 0.45, 0),
                     (0.2, 0, 0), (0.29, 0, 0), (0.26, 0, 0), (-0.2, 0, 0), (-0.29, 0, 0), (-0.26, 0, 0)])
LIMBS = {"l_thigh": -1, "r_thigh": -1, "l_upper": 1, "r_upper": 1}  # the first joint, and where flexion carries the lower bone along z
ROOT, ROOT_TURN = np.array((2.0, 0.0, -1.0)), 0.6
AHEAD = np.array((np.sin(ROOT_TURN), 0, np.cos(ROOT_TURN)))
FEATURES = Feature.WITH_HAND | Feature.WITH_RECORD
PANEL = 1.35  # half of a panel's height, metres


def about(axis, angle):
    return np.float32([*(np.sin(angle / 2) * np.array(axis, float)), np.cos(angle / 2)])


def rotations():
    """A step: arms hang and swing, knees and elbows are bent."""
    pose = np.tile(np.float32((0, 0, 0, 1)), (len(NAMES), 1))
    turns = {"l_thigh": ((1, 0, 0), -0.5), "l_shin": ((1, 0, 0), 0.6), "r_thigh": ((1, 0, 0), 0.25), "r_shin": ((1, 0, 0), 0.4),
             "l_upper": ((0, 0, 1), -1.2), "l_fore": ((0, 1, 0), -0.7), "r_upper": ((0, 0, 1), 1.1), "r_fore": ((0, 1, 0), 0.9)}
    for name, (axis, angle) in turns.items():
        pose[NAMES.index(name)] = about(axis, angle)
    return pose


def world(pose):
    """Places and rotations of all joints, by a solve that corrects nothing. The pelvis, which has no turn of its own, takes the root's."""
    places, turns = np.zeros((1, len(NAMES), 3), np.float32), np.zeros((1, len(NAMES), 4), np.float32)
    crowd = swivel.Crowd([group(name) for name in LIMBS], skeleton=Skeleton(PARENTS, PLACES), body_count=1)
    crowd.solve(pose=Pose([about((0, 1, 0), ROOT_TURN), *pose[1:]], weight=0.0, joint_positions=places, joint_rotations=turns,
                          out=np.zeros((1, len(NAMES), 4), np.float32)))
    return places[0] + ROOT, turns[0]


def group(name, is_bent_the_other_way=False):
    first = NAMES.index(name)
    return BodyGroup(first, first + 1, first + 2, bend=(0, 0, -LIMBS[name] if is_bent_the_other_way else LIMBS[name]))


def drawn(mistake=None):
    """The names, lines and colours of the body, solved with this mistake."""
    pose = rotations()
    places, turns = world(pose)
    goals = []
    for name, bend in LIMBS.items():
        first = NAMES.index(name)
        goals.append([places[first + 2] + (0.04, 0.05, 0.03), places[first + 1] - 0.4 * bend * AHEAD, turns[first + 2]])
    root = {"root_position": np.float32(ROOT), "root_rotation": about((0, 1, 0), ROOT_TURN)}
    for goal in goals:
        if mistake == "y and z exchanged":
            goal[:2] = goal[0][[0, 2, 1]], goal[1][[0, 2, 1]]
        elif mistake == "targets from the root":
            goal[:2] = goal[0] - ROOT, goal[1] - ROOT
        elif mistake == "targets in centimetres":
            goal[:2] = 100 * goal[0], 100 * goal[1]
    if mistake == "quaternions w first":
        pose = np.ascontiguousarray(pose[:, [3, 0, 1, 2]])
    elif mistake == "matrices of the other order":
        pose = pose * np.float32((-1, -1, -1, 1))
    elif mistake == "the root forgotten":
        root = {}
    groups = [group(name, mistake == "the bend the other way") for name in LIMBS]
    crowd = swivel.Crowd(groups, FEATURES, skeleton=Skeleton(PARENTS, PLACES), body_count=1)
    for n, values in enumerate(goals):
        for field, value in zip((Field.TARGET, Field.POLE, Field.HAND), values):
            crowd.write(field, np.float32([value]), n)
    given = Pose(pose[np.newaxis].astype(np.float32), out=np.zeros((1, len(NAMES), 4), np.float32), **root)
    crowd.solve(pose=given)
    return crowd.draw(limb=0, pose=given)


def show(axes, title, names, lines, colors):
    """Seen from the side and a little from above, around where the body should be."""
    flat = np.stack((lines[..., 2] - 0.45 * lines[..., 0], lines[..., 1] - 0.12 * lines[..., 0]), axis=-1)
    middle = np.array((ROOT[2] - 0.45 * ROOT[0], 0.9 - 0.12 * ROOT[0]))
    are_points = np.all(lines[:, 0] == lines[:, 1], axis=1)
    widths = [4 if name == "bone" else 2 for name in names]
    axes.add_collection(LineCollection(flat[~are_points], colors=colors[~are_points] / 255, linewidths=np.array(widths)[~are_points]))
    axes.scatter(*flat[are_points, 0].T, s=60, c=colors[are_points] / 255, zorder=3)
    axes.set(xlim=middle[0] + np.array((-PANEL, PANEL)), ylim=middle[1] + np.array((-PANEL, PANEL)), xticks=[], yticks=[], facecolor=INK)
    axes.set_title(title)


MISTAKES = ["y and z exchanged", "quaternions w first", "matrices of the other order", "targets from the root", "the bend the other way",
            "the root forgotten", "targets in centimetres"]


def main():
    figure, panels = plt.subplots(2, 4, figsize=(16, 8.4), layout="constrained")
    for axes, mistake in zip(panels.flat, [None, *MISTAKES]):
        show(axes, mistake or "as it should be", *drawn(mistake))
    figure.savefig(sys.argv[1], metadata={"Date": None})


if __name__ == "__main__":
    main()
