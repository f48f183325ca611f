# SPDX-License-Identifier: MIT
"""The promise: poses of bodies may be in the body's space, a solve says where joints are, and twist bones and clavicles turn along. All
is judged by a forward kinematics in NumPy."""
import unittest

import numpy as np

import bodies
import swivel
from arms import quaternions, rotate, times
from bodies import FOREARM, HAND, LIMBS, PELVIS, ROLL, UPPER_ARM, angles
from swivel import BodyGroup, Feature, Field, Flag, Pose, PoseSpace, Skeleton

N = 50
CLAVICLE, TWIST, FINGER = 8, 9, 10
PARENTS = [*bodies.PARENTS, PELVIS, FOREARM, HAND]
PARENTS[UPPER_ARM] = CLAVICLE
PLACES = np.float32([*bodies.PLACES, (0.05, 0.4, 0), (0.12, 0, 0), (0.08, 0.02, 0)])
ARM = BodyGroup(*LIMBS[0], bend=(0, 0, 1), twist_bones=[TWIST])
NEEDED = [HAND, FOREARM, ROLL, UPPER_ARM, PELVIS, CLAVICLE, TWIST]
BELOW = [UPPER_ARM, ROLL, FOREARM, TWIST, HAND, FINGER]
KEPT = [joint for joint in range(11) if joint not in BELOW]


def back(q):
    return q * (-1, -1, -1, 1)


def forward(rotations, roots={}):
    """In the body's space, or with roots in the world."""
    return bodies.forward(rotations, PLACES, 1.0, *roots.values(), parents=PARENTS)


class Parts(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(5)
        self.rotations, other = (quaternions(random, 11 * N).reshape(N, 11, 4) for _ in range(2))
        other[:, [PELVIS, CLAVICLE, ROLL]] = self.rotations[:, [PELVIS, CLAVICLE, ROLL]]
        self.roots = {"root_position": random.normal(size=(N, 3)).astype(np.float32), "root_rotation": quaternions(random, N),
                      "root_scale": random.uniform(0.5, 2, N).astype(np.float32)}
        self.places, self.turned = forward(self.rotations, self.roots)
        self.goal_places, self.goal_turned = forward(other, self.roots)

    def solve(self, features, frame, **pose):
        crowd = swivel.Crowd(ARM, features | Feature.WITH_HAND, skeleton=Skeleton(PARENTS, PLACES), body_count=N)
        self.assertEqual(crowd.solve(frames={"hand": self.goal_turned[:, HAND], **frame}, pose=Pose(**pose, **self.roots)), N)
        self.assertIsNone(crowd.find(Flag.BAD_INPUT))
        return crowd

    def goals(self):
        return {"target": self.goal_places[:, HAND], "pole": self.goal_places[:, FOREARM]}

    def test_in_the_bodys_space_what_hangs_below_moves_along(self):
        """So relative to its parent nothing changes but rotations of the limb and its twist bone."""
        places, rotations = (each.astype(np.float32) for each in forward(self.rotations))
        out, out_places, before, before_places = rotations.copy(), places.copy(), rotations.copy(), places.copy()
        self.solve(0, self.goals(), rotations=rotations, translations=places, space=PoseSpace.IN_BODY, out=out, out_translations=out_places)
        np.testing.assert_array_equal(rotations, before)
        np.testing.assert_array_equal(places, before_places)
        self.solve(0, self.goals(), rotations=rotations, translations=places, space=PoseSpace.IN_BODY)
        np.testing.assert_array_equal(rotations, out)
        np.testing.assert_array_equal(places, out_places)
        position, rotation, scale = self.roots.values()
        np.testing.assert_allclose(position + scale[:, None] * rotate(rotation, places[:, HAND]), self.goal_places[:, HAND], atol=1e-5)
        self.assertLess(angles(times(rotation, rotations[:, HAND]), self.goal_turned[:, HAND]).max(), 1e-5)
        np.testing.assert_array_equal(rotations[:, KEPT], before[:, KEPT])
        np.testing.assert_array_equal(places[:, KEPT], before_places[:, KEPT])
        for joint in BELOW:
            parent = PARENTS[joint]
            local = rotate(back(rotations[:, parent]), places[:, joint] - places[:, parent])
            np.testing.assert_allclose(local, np.tile(PLACES[joint], (N, 1)), atol=1e-5)
        for joint in (ROLL, FINGER):
            self.assertLess(angles(times(back(rotations[:, PARENTS[joint]]), rotations[:, joint]), self.rotations[:, joint]).max(), 1e-5)

    def test_where_joints_are_after_a_solve(self):
        """Of those that the arm needs, relative to the root; in both spaces, and in the caller's structures."""
        local, (places, rotations) = self.rotations.copy(), (each.astype(np.float32) for each in forward(self.rotations))
        for pose in ({"rotations": local}, {"rotations": rotations, "translations": places, "space": PoseSpace.IN_BODY}):
            joints = np.zeros((N, 11), [("name", "u1"), ("rotation", "f4", 4), ("place", "f4", 3)])
            for part in ("rotation", "place"):
                joints[part] = np.nan
            crowd = self.solve(Feature.WITH_RECORD, self.goals(), joint_rotations=joints["rotation"], joint_places=joints["place"], **pose)
            np.testing.assert_allclose(crowd.wrists(), self.goal_places[:, HAND], atol=1e-5)
            at, turned = forward(local)
            np.testing.assert_allclose(joints["place"][:, NEEDED], at[:, NEEDED], atol=1e-5)
            self.assertLess(angles(joints["rotation"][:, NEEDED], turned[:, NEEDED]).max(), 1e-4)
            others = np.delete(joints, NEEDED, axis=1)
            self.assertTrue(np.all(np.isnan(others["place"])) and np.all(np.isnan(others["rotation"])))

    def test_a_twist_bone_takes_its_half(self):
        """Of how far the hand's twist changes, beside the forearm's turn."""
        bone = self.places[:, HAND] - self.places[:, FOREARM]
        half = np.random.default_rng(6).uniform(-0.7, 0.7, (N, 1))  # of half the angle
        about = lambda angle: np.concatenate([np.sin(angle) * bone / np.linalg.norm(bone, axis=1, keepdims=True), np.cos(angle)], axis=1)
        rotations = self.rotations.copy()
        crowd = self.solve(Feature.POLE_INCOMING, {"target": self.places[:, HAND], "hand": times(about(half), self.turned[:, HAND])}, rotations=rotations)
        self.assertEqual(crowd.component_count(Field.TWIST_BONES), 4)  # their joint alone asks for it
        _, turned = forward(rotations, self.roots)
        wanted = times(about(half / 2), self.turned[:, TWIST])
        self.assertLess(angles(turned[:, TWIST], wanted).max(), 1e-4)

    def test_a_clavicle_turns_by_its_share(self):
        """Of the angle from the incoming wrist to the target: by none of it, or by all."""
        shares, rotations = np.arange(N) % 2, self.rotations.copy()
        frame = {"target": self.goal_places[:, HAND], "clavicle": shares.astype(np.float32)}
        self.solve(Feature.WITH_CLAVICLE | Feature.POLE_INCOMING, frame, rotations=rotations)
        turn = times(forward(rotations, self.roots)[1][:, CLAVICLE], back(self.turned[:, CLAVICLE]))
        way = lambda places: (lambda to: to / np.linalg.norm(to, axis=1, keepdims=True))(places - self.places[:, CLAVICLE])
        was, wanted = way(self.places[:, HAND]), way(self.goal_places[:, HAND])
        np.testing.assert_allclose(rotate(turn, was), np.where(shares[:, None], wanted, was), atol=1e-5)
        self.assertLess(angles(turn[::2], np.tile((0.0, 0, 0, 1), (N // 2, 1))).max(), 1e-6)

    def test_twist_bones_have_the_number_that_features_say(self):
        make = lambda **options: swivel.Crowd(ARM._replace(**options), skeleton=Skeleton(PARENTS, PLACES), body_count=1)
        bones = lambda features: make(features=features | Feature.WITH_HAND).features() & 7 * Feature.WITH_TWIST_BONES
        self.assertEqual([bones(Feature(0)), bones(Feature.WITH_TWIST_BONES)], [Feature.WITH_TWIST_BONES] * 2)
        for text, options in (("Feature.WITH_TWIST_BONES needs Feature.WITH_HAND", {}),
                              ("its features have 2 twist bones, its joints 1", {"features": Feature.WITH_HAND | 2 * Feature.WITH_TWIST_BONES}),
                              ("there are 8 twist bones", {"features": Feature.WITH_HAND, "twist_bones": [TWIST] * 8})):
            with self.assertRaisesRegex(ValueError, text):
                make(**options)


if __name__ == "__main__":
    unittest.main()
