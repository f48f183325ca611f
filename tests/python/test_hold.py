# SPDX-License-Identifier: MIT
"""The promise: two hands hold a prop, a hand holds a hand, and feet stand on slopes, judged by a forward kinematics in NumPy. Every argument
counts, and the bits are those of C.
  HOLDING: tests/capi/holding.c, which prints digests of the same bodies."""
import os
import re
import subprocess
import unittest

import numpy as np

import swivel
from arms import rotate, times
from bodies import angles, forward
from swivel import BodyGroup, Feature, Field, FitGroup, Flag, Ground, Pose, PropGroup, Skeleton

N, FRAMES = 20, 16
HIPS, CHEST, LEFT_ARM, LEFT_FOREARM, LEFT_HAND, RIGHT_ARM, RIGHT_FOREARM, RIGHT_HAND, THIGH, SHIN, FOOT = range(11)
PARENTS = [-1, HIPS, CHEST, LEFT_ARM, LEFT_FOREARM, CHEST, RIGHT_ARM, RIGHT_FOREARM, HIPS, THIGH, SHIN]
PLACES = np.float32([(0, 0.921875, 0), (0, 0.5, 0), (0.1875, 0, 0), (0.3125, 0, 0), (0.25, 0, 0), (-0.1875, 0, 0), (-0.3125, 0, 0), (-0.25, 0, 0),
                     (0.125, 0, 0), (0, -0.4375, 0), (0, -0.4375, 0)])
REST = np.float32([(0, 0, 0, 1), (0, 0, 0, 1), (0, -0.25, -0.25, 1), (0, -0.5, 0, 1), (0, 0, 0, 1), (0, 0.25, 0.25, 1), (0, 0.5, 0, 1), (0, 0, 0, 1),
                   (-0.125, 0, 0, 1), (0.25, 0, 0, 1), (-0.125, 0, 0, 1)])
LEG, LEFT, RIGHT, RIFLE = range(4)
BODY = np.arange(N)
TOE, HEEL = (0, -0.0625, 0.125), (0, -0.0625, -0.0625)
GROUND = Ground(HEEL, toe_clearance=0.015625, heel_clearance=0.03125, cos_most=0.96875, half=0.125)
PROP = PropGroup(joint=CHEST, most_move=0.03125)
LEFT_GRIP, RIGHT_GRIP = np.float32((0.125, 0, 0.0625, 0, 0, 0.25, 1)), np.float32((-0.125, 0, 0, 0.125, 0, 0, 1))
CLASP = np.float32((0.03125, -0.0625, 0, 0, 0.5, 0, 1))
ARM = Feature.POLE_INCOMING | Feature.WITH_HAND
AHEAD = 0.25 * (BODY % 3 - 1)  # how the ground climbs towards +z


def unit(q):
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def plane(probes):
    """The ground below feet, and its normals: a plane for each body, through the place from which its root starts."""
    x, _, z = probes.T.astype(float)
    ground = np.stack([x, AHEAD * z + 0.125 * (x - 0.25 * BODY), z], axis=1)
    return ground, np.stack([np.full(N, -0.125), np.ones(N), -AHEAD], axis=1)


class Holders:
    """Bodies that hold a rifle, or with no prop each their right hand by the left, and stand on a leg."""

    def __init__(self, prop=PROP, ground=GROUND, link=None, in_chest=True):
        leg = BodyGroup(THIGH, SHIN, FOOT, bend=(0, 0, -1), ground=ground,
                        features=ARM | Feature.WITH_EFFECTOR | Feature.WITH_PLANT | Feature.WITH_GROUND)
        link = (RIFLE if prop else LEFT) if link is None else link
        left = BodyGroup(LEFT_ARM, LEFT_FOREARM, LEFT_HAND, bend=(0, 0, 1), features=ARM | (Feature.WITH_LINK if prop else 0), link=link)
        right = BodyGroup(RIGHT_ARM, RIGHT_FOREARM, RIGHT_HAND, bend=(0, 0, 1), features=ARM | Feature.WITH_LINK, link=link)
        self.crowd = swivel.Crowd([leg, left, right, *([prop] if prop else [])], skeleton=Skeleton(PARENTS, PLACES), body_count=N)
        self.crowd.write(Field.EFFECTOR, TOE)
        self.crowd.write(Field.GRIP, RIGHT_GRIP if prop else CLASP, RIGHT)
        self.prop = prop
        if prop:
            self.crowd.write(Field.GRIP, LEFT_GRIP, LEFT)
        ahead = 0.3125 + 0.015625 * BODY + (0 if in_chest else 0.125)
        self.goals = np.stack([0 * BODY, 0 * BODY - 0.0625, ahead] if prop and in_chest else [0.25 * BODY, 0 * BODY + 1.375, ahead], axis=1)
        if prop and not in_chest:
            self.crowd.write(Field.PROP_TURN, (0, 0.25, 0, 1), RIFLE)
        self.crowd.write(Field.PROP_PLACE if prop else Field.TARGET, self.goals, RIFLE if prop else LEFT)

    def pose(self, frame):
        self.rotations = np.tile(REST, (N, 1, 1))
        self.rotations[:, CHEST, 1] = 0.125 * (BODY % 3)
        self.roots = np.stack([0.25 * BODY, 0 * BODY, 0 * BODY + 0.0078125 * frame], axis=1).astype(np.float32)
        return Pose(self.rotations, root_position=self.roots, time=0.015625)

    def step(self, frame, asks=True):
        pose = self.pose(frame)
        self.crowd.write(Field.CONTACT, frame >= 2)
        if asks:
            assert self.crowd.solve(pose=pose, probes_only=True) == N
        ground, normals = plane(self.crowd.read(Field.PROBE))
        self.crowd.write(Field.GROUND, ground)
        self.crowd.write(Field.GROUND_NORMAL, normals)
        assert self.crowd.solve(pose=pose) == N
        assert self.crowd.find(Flag.BAD_INPUT) is None

    def solved(self, **given):
        for frame in range(FRAMES):
            self.step(frame, **given)
        self.places, self.turned = forward(self.rotations.astype(float), PLACES, root=self.roots, parents=PARENTS)
        self.flags = [self.crowd.read(Field.FLAGS, group) for group in range(self.crowd.group_count)]
        return self

    def digest(self, **given):
        return f"{self.solved(**given).crowd.digest():016x}"


def holding(place, turned, grip):
    """Where a hand is that has this grip on something, and how it is turned."""
    return place + rotate(turned, grip[:3].astype(float)), times(turned, unit(grip[3:].astype(float)))


class Bits(unittest.TestCase):
    def test_the_bits_of_c(self):
        said = subprocess.run([os.environ["HOLDING"]], capture_output=True, text=True, check=True).stdout.split()
        self.assertEqual([Holders().digest(), Holders(prop=None).digest()], said)

    def test_every_argument_counts(self):
        changed = Ground()._replace(heel=(0, -0.0625, -0.125))  # a heel at the wrist touches nothing, as one without clearance
        others = [Holders(ground=GROUND._replace(**{name: getattr(changed, name)})).digest() for name in Ground._fields]
        others += [Holders(prop=PROP._replace(joint=HIPS)).digest(), Holders(prop=PROP._replace(most_move=1)).digest()]
        others += [Holders().digest(asks=False), Holders().digest(), Holders(prop=None).digest(), Holders(prop=None, link=LEG).digest()]
        self.assertEqual(len(set(others)), len(others))


class Held(unittest.TestCase):
    def check_hand(self, bodies, hand, place, turned, where=slice(None)):
        self.assertLess(np.linalg.norm(bodies.places[:, hand] - place, axis=1)[where].max(), 3e-6)
        self.assertLess(angles(bodies.turned[:, hand], turned)[where].max(), 5e-6)

    def check_both_hands(self, bodies, where=slice(None)):
        frame = bodies.crowd.read(Field.PROP_FRAME, RIFLE).astype(float)
        for hand, grip, group in ((LEFT_HAND, LEFT_GRIP, LEFT), (RIGHT_HAND, RIGHT_GRIP, RIGHT)):
            self.check_hand(bodies, hand, *holding(frame[:, :3], frame[:, 3:], grip), where)
            self.assertTrue(np.all(bodies.flags[group][where] & Flag.REACHED))
        return frame

    def test_a_prop_in_two_hands(self):
        """It goes where it is put, as near to that as both hands reach."""
        bodies = Holders(prop=PropGroup(), in_chest=False).solved()
        frame = self.check_both_hands(bodies)
        self.assertTrue(np.all(bodies.flags[RIFLE] == Flag.REACHED))
        moved = np.linalg.norm(frame[:, :3] - bodies.goals, axis=1)
        self.assertLess(moved[0], 1e-6)
        self.assertGreater(moved[-1], 0.01)
        self.assertLess(angles(frame[:, 3:], np.tile(unit(np.array((0, 0.25, 0, 1.0))), (N, 1))).max(), 2e-6)

    def test_a_prop_on_a_joint_that_hardly_moves(self):
        bodies = Holders().solved()
        chest = bodies.places[:, CHEST] + rotate(bodies.turned[:, CHEST], bodies.goals)
        moved = np.linalg.norm(bodies.crowd.read(Field.PROP_FRAME, RIFLE)[:, :3] - chest, axis=1)
        most = 0.03125 * 0.5625
        reached = bodies.flags[RIFLE] == Flag.REACHED
        self.assertTrue(np.all(reached | (bodies.flags[RIFLE] == Flag.CLAMPED_FAR)))
        self.assertTrue(0 < np.sum(reached & (moved > 1e-3)) and np.sum(~reached) > 0)
        self.assertLess(moved.max(), most + 1e-6)
        np.testing.assert_allclose(moved[~reached], most, atol=1e-6)
        self.check_both_hands(bodies, reached)
        stays = Holders(prop=PROP._replace(most_move=0)).solved()
        np.testing.assert_allclose(stays.crowd.read(Field.PROP_FRAME, RIFLE)[:, :3], chest, atol=1e-6)

    def test_a_hand_holds_a_hand(self):
        bodies = Holders(prop=None).solved()
        reached = bodies.flags[RIGHT] & Flag.REACHED > 0
        self.assertGreater(np.sum(reached), 10)
        left = bodies.places[:, LEFT_HAND], bodies.turned[:, LEFT_HAND]
        self.check_hand(bodies, RIGHT_HAND, *holding(*left, CLASP), reached)
        frame = bodies.crowd.read(Field.HAND_FRAME, LEFT)  # which a group has by itself that is held
        self.check_hand(bodies, LEFT_HAND, frame[:, :3], frame[:, 3:])
        self.assertEqual(bodies.crowd.features(LEFT) & (Feature.WITH_HAND_FRAME | Feature.SENT), Feature.WITH_HAND_FRAME)


class Standing(unittest.TestCase):
    def test_a_foot_on_a_slope_by_two_calls(self):
        bodies = Holders().solved()
        self.assertTrue(np.all(bodies.flags[LEG] & Flag.PLANTED))
        self.assertTrue(np.all(bodies.flags[LEG] & Flag.REACHED))

        def heights(point):
            places = bodies.places[:, FOOT] + rotate(bodies.turned[:, FOOT], np.array(point))
            ground, normals = plane(places)
            return (places[:, 1] - ground[:, 1]) / np.linalg.norm(normals, axis=1)
        np.testing.assert_allclose(heights(TOE), GROUND.toe_clearance, atol=5e-6)
        self.assertGreater(heights(HEEL).min(), GROUND.heel_clearance - 5e-6)

    def test_probes_only_changes_nothing_else(self):
        bodies = Holders()
        for frame in range(3):
            bodies.step(frame)
        crowd, pose = bodies.crowd, bodies.pose(3)
        read = lambda: {field: crowd.read(field).tobytes() for field in Field if crowd.component_count(field)}
        before, posed = read(), bodies.rotations.copy()
        probes, plants = np.zeros((N, 3), np.float32), np.zeros((N, 11), np.float32)
        crowd.solve(groups=[LEG], pose=pose, frames={"probe": probes, "plant": plants}, probes_only=True)
        after = read()
        self.assertEqual([field for field in before if before[field] != after[field]], [Field.PROBE])
        np.testing.assert_array_equal(bodies.rotations, posed)
        np.testing.assert_array_equal(probes, crowd.read(Field.PROBE))
        self.assertFalse(np.any(plants))

    def test_far_roots_in_doubles(self):
        """Nobody need give frames. Where they are given, places are doubles: of the ground in the world, of a prop on a joint in its frame."""
        for prop, in_chest in ((PROP, True), (PropGroup(), False)):
            all_bodies = []
            for origin in (np.zeros(3), np.array((2.0**33, 0, -(2.0**32)))):
                bodies = Holders(prop, in_chest=in_chest)
                for frame in range(FRAMES):
                    pose = bodies.pose(frame)._replace(root_position=bodies.roots + origin, support_position=origin)
                    ground, normals = plane(bodies.roots)
                    place = bodies.goals + (0 if in_chest else origin)
                    frames = [{"contact": frame >= 2, "ground": ground + origin, "ground_normal": normals}, {}, {}, {"prop_place": place}]
                    bodies.crowd.solve(pose=pose, frames=frames)
                    bodies.crowd.solve(pose=pose._replace(time=0))
                self.assertIsNone(bodies.crowd.find(Flag.BAD_INPUT))
                self.assertGreater(np.sum(bodies.crowd.read(Field.FLAGS, RIFLE) == Flag.REACHED), 5)
                all_bodies.append(bodies)
            near, far = all_bodies
            self.assertEqual(near.crowd.digest(), far.crowd.digest())
            np.testing.assert_array_equal(near.rotations, far.rotations)


class Mistakes(unittest.TestCase):
    def fails(self, error, text, call, *arguments, **keywords):
        with self.assertRaisesRegex(error, re.escape(text)) as caught:
            call(*arguments, **keywords)
        self.assertNotIn("\n", str(caught.exception))

    def test_one_clear_line(self):
        fails = self.fails
        fails(TypeError, "ground: expected a Ground, got 0.1", Holders, ground=0.1)
        fails(TypeError, "ground.half: expected a number, got 'x'", Holders, ground=Ground(half="x"))
        fails(ValueError, "ground.heel: expected shape (1, 3)", Holders, ground=Ground(heel=(1, 2)))
        fails(ValueError, "group 0, ground.cos_most is 2; it is 0 to 1", Holders, ground=Ground(cos_most=2))
        fails(TypeError, "prop.joint: expected a whole number, got 1.5", Holders, prop=PropGroup(1.5))
        fails(TypeError, "prop.most_move: expected a number, got None", Holders, prop=PropGroup(most_move=None))
        fails(ValueError, "group 3, prop.joint is 11; it is -1, or one of the skeleton's 11 joints", Holders, prop=PropGroup(11))
        fails(TypeError, "expected a member of OnBadInput in a PropGroup, got PropGroup(joint=-1", Holders, prop=PropGroup(on_bad_input="x"))
        fails(ValueError, "group 1 is linked to group 9, which does not exist; there are 4", Holders, link=9)
        fails(ValueError, "link is -1", Holders, link=-1)
        fails(TypeError, "expected whole numbers in a BodyGroup", Holders, link="x")
        fails(ValueError, "group 3 is Feature.PROP, and 0 limbs are linked to it", Holders, link=LEG)
        bodies = Holders()
        fails(ValueError, "name both", bodies.crowd.solve, pose=bodies.pose(0), groups=[LEFT, RIGHT])
        fails(ValueError, "the job is for probes_only, but names no group that is Feature.WITH_GROUND; leave it out", bodies.crowd.solve,
              pose=bodies.pose(0), groups=[LEFT, RIGHT, RIFLE], probes_only=True)
        fails(ValueError, "the crowd def has no skeleton", swivel.Crowd, PropGroup())


if __name__ == "__main__":
    unittest.main()
