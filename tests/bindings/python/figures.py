# SPDX-License-Identifier: MIT
"""Arms and a small skeleton for the tests, random poses of it, and refusals."""
import re
import unittest

import numpy as np

import swivel
from swivel import Feature, Field, Pose


class Refusals(unittest.TestCase):
    def refuses(self, error, text, call, *arguments, **keywords):
        """The call raises just this error, with this text in its one line."""
        with self.subTest(text), self.assertRaisesRegex(error, re.escape(text)) as caught:
            call(*arguments, **keywords)
        self.assertIs(type(caught.exception), error)
        self.assertNotIn("\n", str(caught.exception))


def quaternions(random, n):
    q = random.normal(size=(n, 4))
    return (q / np.linalg.norm(q, axis=1, keepdims=True)).astype(np.float32)


class Sample:
    """n arms within reach: targets, poles, lengths as float32."""

    def __init__(self, n, seed=1):
        random = np.random.default_rng(seed)
        self.lengths = random.uniform(0.2, 0.4, size=(n, 2)).astype(np.float32)
        far, near = self.lengths.sum(axis=1), abs(self.lengths[:, 0] - self.lengths[:, 1])
        way = random.normal(size=(n, 3))
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        self.targets = (way * (near + random.uniform(0.1, 0.95, n) * (far - near))[:, None]).astype(np.float32)
        self.poles = random.normal(size=(n, 3)).astype(np.float32)


FOOT, SHIN, THIGH, HAND, FOREARM, ROLL, UPPER_ARM, PELVIS = range(8)
PARENTS = [SHIN, THIGH, PELVIS, FOREARM, ROLL, UPPER_ARM, PELVIS, -1]
PLACES = np.float32([(0, -0.4, 0), (0, -0.45, 0), (0.1, -0.1, 0), (0.25, 0, 0), (0.2, 0, 0), (0.1, 0.02, 0), (0.2, 0.5, 0), (0, 1, 0)])
LIMBS = [(UPPER_ARM, FOREARM, HAND), (THIGH, SHIN, FOOT)]


def limb_of(elbow, wrist, bend=(0, 0, 1)):
    """The binding of three joints that are not turned at rest."""
    return swivel.bind_joints([-1, 0, 1], [(0, 0, 0), elbow, wrist], 0, 1, 2, bend=bend)


def flags_of(crowd):
    """Of all limbs, group by group."""
    return np.concatenate([crowd.read(Field.FLAGS, group) for group in range(crowd.group_count)])


def crowd_of(n, features=0):
    """An arm and a leg of n bodies, and their shift if they fit."""
    groups = [swivel.BodyGroup(*limb, bend=(0, 0, side)) for limb, side in zip(LIMBS, (1, -1))]
    shifts = [swivel.ShiftGroup()] * bool(features & Feature.WITH_PELVIS_FIT)
    return swivel.Crowd([*groups, *shifts], features, skeleton=swivel.Skeleton(PARENTS, PLACES), body_count=n)


class Bodies:
    """n bodies with every member of a pose, and a second pose of theirs, whose wrists and hands are goals in reach."""

    def __init__(self, n, seed=1):
        random = np.random.default_rng(seed)
        self.rotations = quaternions(random, 8 * n).reshape(n, 8, 4)
        self.other = quaternions(random, 8 * n).reshape(n, 8, 4)
        self.other[:, [PELVIS, ROLL]] = self.rotations[:, [PELVIS, ROLL]]
        self.translations = (PLACES * random.uniform(0.8, 1.2, (n, 8, 1))).astype(np.float32)
        self.scales = np.repeat(random.uniform(0.8, 1.2, (n, 8, 1)), 3, axis=2).astype(np.float32)
        self.root_position = random.normal(size=(n, 3)).astype(np.float32)
        self.root_rotation = quaternions(random, n)
        self.root_scale = random.uniform(0.5, 2, n).astype(np.float32)
        self.places, self.turned = self.at(self.other)

    def at(self, rotations):
        """Places of all joints in the world, and rotations from the root, as the library has them while no limb is moved."""
        n = len(rotations)
        crowd, places, turned = crowd_of(n, Feature.POLE_INCOMING), np.zeros((n, 8, 3), np.float32), np.zeros((n, 8, 4), np.float32)
        for group in range(len(LIMBS)):
            crowd.write(Field.TARGET, (0, 0, 0), group)
        crowd.solve(pose=Pose(rotations.copy(), joint_positions=places, joint_rotations=turned, weight=0.0, **self.members()))
        axis, cosine = self.root_rotation[:, None, :3], self.root_rotation[:, None, 3:]
        in_world = places + 2 * np.cross(axis, np.cross(axis, places) + cosine * places)
        return self.root_position[:, None] + self.root_scale[:, None, None] * in_world, turned

    def members(self):
        return {name: getattr(self, name) for name in ("translations", "scales", *self.roots())}

    def roots(self):
        return {name: getattr(self, name) for name in ("root_position", "root_rotation", "root_scale")}

    def goals(self):
        """A frame for each group, of this second pose."""
        return [{"target": self.places[:, limb[2]], "pole": self.places[:, limb[1]], "hand": self.turned[:, limb[2]]}
                for limb in LIMBS]
