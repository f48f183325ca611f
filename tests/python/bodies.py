# SPDX-License-Identifier: MIT
"""A small skeleton for the tests, random poses of it, and their forward kinematics: NumPy in double."""
import numpy as np

import swivel
from arms import quaternions, rotate, times

FOOT, SHIN, THIGH, HAND, FOREARM, ROLL, UPPER_ARM, PELVIS = range(8)
PARENTS = [SHIN, THIGH, PELVIS, FOREARM, ROLL, UPPER_ARM, PELVIS, -1]
PLACES = np.float32([(0, -0.4, 0), (0, -0.45, 0), (0.1, -0.1, 0), (0.25, 0, 0), (0.2, 0, 0), (0.1, 0.02, 0), (0.2, 0.5, 0), (0, 1, 0)])
LIMBS = [(UPPER_ARM, FOREARM, HAND), (THIGH, SHIN, FOOT)]


def crowd_of(n, features=0):
    """An arm and a leg of n bodies, and their shift if they fit."""
    groups = [swivel.BodyGroup(*limb, bend=(0, 0, side)) for limb, side in zip(LIMBS, (1, -1))]
    shifts = [swivel.FitGroup()] * bool(features & swivel.Feature.WITH_FIT)
    return swivel.Crowd([*groups, *shifts], features, skeleton=swivel.Skeleton(PARENTS, PLACES), body_count=n)


def forward(rotations, places, scales, root, root_rotation, root_scale):
    """Places (n, joints, 3) and rotations (n, joints, 4) of all joints in the world. Parents come after their children."""
    n, joints = len(rotations), len(PARENTS)
    at, turned, sized = np.zeros((n, joints + 1, 3)), np.zeros((n, joints + 1, 4)), np.zeros((n, joints + 1, 1))
    at[:, -1], turned[:, -1], sized[:, -1, 0] = root, root_rotation, root_scale  # where a parent -1 is
    for joint in reversed(range(joints)):
        parent = PARENTS[joint]
        at[:, joint] = at[:, parent] + sized[:, parent] * rotate(turned[:, parent], places[:, joint])
        turned[:, joint] = times(turned[:, parent], rotations[:, joint])
        sized[:, joint] = sized[:, parent] * scales[:, joint, :1]
    return at[:, :-1], turned[:, :-1] / np.linalg.norm(turned[:, :-1], axis=-1, keepdims=True)


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
        return forward(rotations, self.translations, self.scales, self.root_position, self.root_rotation, self.root_scale)

    def members(self):
        return {name: getattr(self, name) for name in ("translations", "scales", *self.roots())}

    def roots(self):
        return {name: getattr(self, name) for name in ("root_position", "root_rotation", "root_scale")}

    def goals(self):
        """A frame for each group, of this second pose."""
        return [{"target": self.places[:, limb[2]], "pole": self.places[:, limb[1]], "hand": self.turned[:, limb[2]]}
                for limb in LIMBS]
