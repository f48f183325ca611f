# SPDX-License-Identifier: MIT
"""The promise: spine, neck, head and eyes look at a target, judged by a forward kinematics in NumPy. Every argument counts, and the bits are
those of C.
  LOOKING: tests/capi/looking.c, which prints a digest of the same bodies."""
import os
import re
import subprocess
import unittest

import numpy as np

import swivel
from arms import rotate
from bodies import forward
from swivel import BodyGroup, Feature, Field, Flag, LookGroup, Pose, Skeleton

N, FRAMES = 20, 16
HIPS, SPINE, NECK, HEAD, LEFT_EYE, RIGHT_EYE, UPPER_ARM, FOREARM, HAND = range(9)
PARENTS = [-1, HIPS, SPINE, NECK, HEAD, HEAD, SPINE, UPPER_ARM, FOREARM]
PLACES = np.float32([(0, 0.875, 0), (0, 0.25, 0), (0, 0.375, 0), (0, 0.125, 0.0625), (0.03125, 0.125, 0.125), (-0.03125, 0.125, 0.125),
                     (0.1875, 0.25, 0), (0.3125, 0, 0), (0.25, 0, 0)])
REST = np.float32([(0, 0, 0, 1), (0, 0.125, 0, 1), (0, 0, 0, 1), (0, 0, 0, 1), (0, 0, 0, 1), (0, 0, 0, 1), (0, -0.25, -0.25, 1), (0, -0.5, 0, 1),
                   (0, 0, 0, 1)])
ARM, BODY, LEFT, RIGHT = range(4)
CHAIN = LookGroup([SPINE, NECK, HEAD], share=(1, 1, 2), cos_most=(0.96875, 0.875, 0.625), eye=(0, 0.125, 0.125), axis=(0, -0.125, 1), rate=4)
EYE = LookGroup([LEFT_EYE], cos_most=0.75, cos_full=0.25, cos_none=-0.25, fade_distance=0.125, rate=0)


class Lookers:
    def __init__(self, chain=CHAIN, eye=EYE):
        arm = BodyGroup(UPPER_ARM, FOREARM, HAND, bend=(0, 0, 1), features=Feature.POLE_INCOMING | Feature.WITH_HAND)
        groups = [arm, chain, eye, eye._replace(joints=[RIGHT_EYE])]
        self.crowd = swivel.Crowd(groups, skeleton=Skeleton(PARENTS, PLACES), body_count=N)

    def step(self, frame, weight=None):
        n = np.arange(N)
        self.rotations = np.tile(REST, (N, 1, 1))
        self.roots = np.stack([0.25 * n, 0 * n, 0 * n + 0.0078125 * frame], axis=1).astype(np.float32)
        self.balls = np.stack([self.roots[:, 0] + 0.25 * (frame - 8), 0 * n + 1.5, 0.125 * (n - 4)], axis=1).astype(np.float32)
        self.crowd.write(Field.TARGET, self.balls)
        for group in (BODY, LEFT, RIGHT):
            self.crowd.write(Field.LOOK_TARGET, self.balls, group)
        assert self.crowd.solve(pose=Pose(self.rotations, root_position=self.roots, time=0.015625, weight=weight)) == N
        return self

    def played(self):
        for frame in range(FRAMES):
            self.step(frame)
        return self

    def digest(self):
        return f"{self.played().crowd.digest():016x}"


class Bodies(unittest.TestCase):
    def test_the_bits_of_c(self):
        said = subprocess.run([os.environ["LOOKING"]], capture_output=True, text=True, check=True).stdout.split()
        for isa, runs in swivel.isas():
            if runs:
                swivel.use_isa(isa)
                self.assertEqual([Lookers().digest()], said)

    def test_every_argument_counts(self):
        others = {"joints": [SPINE, HEAD], "share": 1, "cos_most": 0.5, "eye": (0, 0, 0), "axis": (0, 0, 1), "cos_full": 0.9, "cos_none": -0.5, "fade_distance": 2, "rate": 1}
        chain = CHAIN._replace(joints=[SPINE, HEAD], share=(1, 2), cos_most=(0.96875, 0.625))
        digests = [Lookers(chain if name == "joints" else CHAIN._replace(**{name: other})).digest() for name, other in others.items()]
        self.assertEqual(set(others), set(LookGroup._fields) - {"on_bad_input"})
        self.assertEqual(len({*digests, Lookers().digest()}), len(others) + 1)

    def test_lines_of_sight_meet_the_ball(self):
        of = Lookers(CHAIN._replace(rate=0)).played()
        places, turned = forward(of.rotations, PLACES, root=of.roots, parents=PARENTS)
        for group, joint, look in ((BODY, HEAD, CHAIN), (LEFT, LEFT_EYE, EYE), (RIGHT, RIGHT_EYE, EYE)):
            axis = np.array(look.axis) / np.linalg.norm(look.axis)
            eyes = places[:, joint] + rotate(turned[:, joint], np.array(look.eye, float))
            lines = rotate(turned[:, joint], axis)
            sight = of.crowd.read(Field.SIGHT, group)
            np.testing.assert_allclose(sight[:, :3], eyes, atol=3e-6)
            np.testing.assert_allclose(sight[:, 3:], lines, atol=3e-6)
            to = of.balls - eyes
            off = np.linalg.norm(np.cross(lines, to), axis=1) / np.linalg.norm(to, axis=1)
            meets = of.crowd.read(Field.FLAGS, group) & Flag.REACHED != 0
            self.assertGreater(np.count_nonzero(meets), 5)
            self.assertLess(off[meets].max(), 1e-4)

    def test_the_line_goes_at_its_rate_and_may_be_carried(self):
        free = CHAIN._replace(cos_most=-1)
        of = Lookers(free).step(0)
        lines = [of.crowd.read(Field.SIGHT, BODY)[:, 3:]]
        saved = of.crowd.read(Field.LOOK_TURNS, BODY)
        for frame in (15, 15, 15):
            lines.append(of.step(frame).crowd.read(Field.SIGHT, BODY)[:, 3:])
            turns = 2 * np.arcsin(np.linalg.norm(lines[-1] - lines[-2], axis=1) / 2)
            self.assertLess(turns[12:].max(), 4 * 0.015625 + 1e-5)  # of those that have the ball ahead
        self.assertTrue(np.any(of.crowd.read(Field.FLAGS, BODY) & Flag.LIMITED_STEP))
        other = Lookers(free)
        other.crowd.write(Field.LOOK_TURNS, saved, BODY)
        np.testing.assert_array_equal(other.step(15).crowd.read(Field.SIGHT, BODY)[:, 3:], lines[1])
        other.crowd.reset(BODY)
        self.assertFalse(np.any(other.step(15).crowd.read(Field.FLAGS, BODY) & Flag.LIMITED_STEP))

    def test_no_target_and_no_weight_keep_the_pose(self):
        of = Lookers()
        of.crowd.write(Field.LOOK_WEIGHT, 0, BODY)
        of.step(8)
        np.testing.assert_array_equal(of.rotations[:, :LEFT_EYE], np.tile(REST, (N, 1, 1))[:, :LEFT_EYE])
        self.assertFalse(np.any(of.crowd.read(Field.FLAGS, BODY) & Flag.BAD_INPUT))

    def test_a_weight_takes_its_part_of_all_turns(self):
        none, some, whole = Lookers().step(12, 0), Lookers().step(12, np.float32([0.5] * N)), Lookers().step(12, 1)
        np.testing.assert_array_equal(none.rotations, np.tile(REST, (N, 1, 1)))
        np.testing.assert_array_equal(whole.rotations, Lookers().step(12).rotations)
        unit = lambda q: q / np.linalg.norm(q, axis=-1, keepdims=True)
        way = lambda of: 2 * np.arccos(np.clip(np.abs(np.sum(unit(of.rotations[:, HEAD]) * unit(REST[HEAD]), axis=1)), 0, 1))
        self.assertGreater(way(whole).max(), 0.1)
        np.testing.assert_allclose(way(some), way(whole) / 2, atol=3e-3)


class Mistakes(unittest.TestCase):
    def test_one_clear_line(self):
        for error, text, look in ((TypeError, "look.joints: expected numbers of joints, got 'x'", LookGroup("x")),
                                  (ValueError, "look.joints is -1", LookGroup([-1])),
                                  (ValueError, "group 1, look.joint_count is 0; it is 1 to 8", LookGroup([])),
                                  (ValueError, "group 1, look.joint_count is 9; it is 1 to 8", LookGroup([HEAD] * 9)),
                                  (ValueError, "look.joints[1], joint 1, is not below the one before, joint 3", LookGroup([HEAD, SPINE])),
                                  (ValueError, "look.share: expected shape (3,), or () for all joints, got (2,)", CHAIN._replace(share=(1, 2))),
                                  (TypeError, "look.rate: expected a number, got None", CHAIN._replace(rate=None)),
                                  (TypeError, "expected a member of OnBadInput in a LookGroup", CHAIN._replace(on_bad_input="x")),
                                  (ValueError, "group 1 turns joint 4, which is also joint 4 of group 2", EYE)):
            with self.assertRaisesRegex(error, re.escape(text)) as caught:
                Lookers(look)
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaisesRegex(ValueError, "the crowd def has no skeleton"):
            swivel.Crowd(CHAIN)


if __name__ == "__main__":
    unittest.main()
