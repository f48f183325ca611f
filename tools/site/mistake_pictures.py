# SPDX-License-Identifier: MIT
"""One body as Crowd.draw() shows it: as it should be, and with seven mistakes in its input that no call refuses. pictures.py draws it."""
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
FEATURES = Feature.WITH_HAND | Feature.WITH_RECORD
PANEL = 1.35  # half of a panel's side, metres


def about(axis, angle):
    return np.float32([*(np.sin(angle / 2) * np.array(axis, float)), np.cos(angle / 2)])


def times(a, b):
    """Hamilton's product of x, y, z, w: b first, then a."""
    u, v = a[:3], b[:3]
    return np.append(a[3] * v + b[3] * u + np.cross(u, v), a[3] * b[3] - u @ v)


def turned(q, v):
    return times(times(q, np.append(v, 0)), q * (-1, -1, -1, 1))[:3]


def rotations():
    """A step: arms hang and swing, knees and elbows are bent."""
    pose = np.tile(np.float32((0, 0, 0, 1)), (len(NAMES), 1))
    turns = {"l_thigh": ((1, 0, 0), -0.5), "l_shin": ((1, 0, 0), 0.6), "r_thigh": ((1, 0, 0), 0.25), "r_shin": ((1, 0, 0), 0.4),
             "l_upper": ((0, 0, 1), -1.2), "l_fore": ((0, 1, 0), -0.7), "r_upper": ((0, 0, 1), 1.1), "r_fore": ((0, 1, 0), 0.9)}
    for name, (axis, angle) in turns.items():
        pose[NAMES.index(name)] = about(axis, angle)
    return pose


def world(pose):
    """Places and rotations of all joints, by forward kinematics."""
    places, turns = [], []
    for joint, parent in enumerate(PARENTS):
        above, at = (about((0, 1, 0), ROOT_TURN), ROOT) if parent < 0 else (turns[parent], places[parent])
        places.append(at + turned(above, PLACES[joint]))
        turns.append(times(above, pose[joint]))
    return np.array(places), np.array(turns)


def drawn(mistake=None):
    """The names, lines and colours of the body, solved with this mistake."""
    pose = rotations()
    places, turns = world(pose)
    groups, goals = [], []
    for name, bend in LIMBS.items():
        first = NAMES.index(name)
        groups.append(BodyGroup(first, first + 1, first + 2, bend=(0, 0, -bend if mistake == "the bend the other way" else bend)))
        target = places[first + 2] + (0.04, 0.05, 0.03)
        pole = places[first + 1] + turned(about((0, 1, 0), ROOT_TURN), np.array((0, 0, -bend * 0.4)))
        goals.append([target, pole, turns[first + 2]])
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
    elif mistake == "matrices transposed":
        pose = pose * np.float32((-1, -1, -1, 1))
    elif mistake == "the root forgotten":
        root = {}
    crowd = swivel.Crowd(groups, FEATURES, skeleton=Skeleton(PARENTS, PLACES), body_count=1)
    for group, (target, pole, hand) in enumerate(goals):
        for field, value in ((Field.TARGET, target), (Field.POLE, pole), (Field.HAND, hand)):
            crowd.write(field, np.float32([value]), group)
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
    axes.set_title(title, size=13)


MISTAKES = ["y and z exchanged", "quaternions w first", "matrices transposed", "targets from the root", "the bend the other way",
            "the root forgotten", "targets in centimetres"]


def mistakes():
    width, height = 760, 430  # pixels; panels of 180, with a title above each
    figure = plt.figure(figsize=(width / 72, height / 72))
    for n, mistake in enumerate([None, *MISTAKES]):
        left, bottom = 8 + 188 * (n % 4), (222, 8)[n // 4]
        show(figure.add_axes((left / width, bottom / height, 180 / width, 180 / height)), mistake or "as it should be", *drawn(mistake))
    return figure
