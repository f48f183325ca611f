# SPDX-License-Identifier: MIT
"""The promise: feet stand on their supports while they are labelled or slow, whatever axis is up. What is carried can be saved and set
back, and supports change without a jump. All is judged by a forward kinematics in NumPy."""
import re
import unittest

import numpy as np

import bodies
import swivel
from arms import rotate, times
from swivel import BodyGroup, Feature, Field, FitGroup, Flag, Plant, Pose, Skeleton, Support

N, SECOND = 20, 60  # bodies, frames
HIPS, THIGH, SHIN, FOOT = range(4)
PARENTS = [-1, HIPS, THIGH, SHIN]
PLACES = np.array([(0, 0, 0), (0.1, 0, 0), (0, -0.45, 0), (0, -0.42, 0)])
BODY = np.arange(N)
WISH = -0.12  # of the shift: knees well bent
FEATURES = Feature.POLE_INCOMING | Feature.WITH_PLANT | Feature.WITH_FIT
BOUND = 3e-6 * 0.87 + 1.2e-6  # of a solve of a leg, and of the rounding of places 20 m from the origin


def about(axis, angle):
    half = np.asarray(angle)[..., None] / 2
    return np.concatenate([np.sin(half) * axis, np.cos(half)], axis=-1)


def back(q):
    return q * (-1, -1, -1, 1)


class Walkers:
    """Legs that walk in place, those of odd bodies on platforms that drift and turn."""

    def __init__(self, features=FEATURES, turn=(0, 0, 0, 1), up=None, plant=Plant(), far=None):
        """turn: from a world with +y up."""
        self.turn, self.far = np.array(turn), far
        self.places = rotate(self.turn, PLACES).astype(np.float32)
        options = {} if up is None else {"up": up}
        leg = BodyGroup(THIGH, SHIN, FOOT, bend=rotate(self.turn, (0, 0, -1.0)), plant=plant)
        self.crowd = swivel.Crowd([leg, FitGroup(drop=0.3, half=0.05)], features, skeleton=Skeleton(PARENTS, self.places), body_count=N, **options)
        self.crowd.write(Field.SHIFT_WISH, WISH, group=1)
        self.rotations = np.empty((N, 4, 4), np.float32)

    def phase(self, frame):
        return 2 * np.pi * (frame / SECOND + 0.07 * BODY)

    def turned(self, q):
        """As it is in a world with this axis up."""
        return times(times(self.turn, q), back(self.turn))

    def supports(self, frame):
        t = BODY % 2 * frame / SECOND
        places = np.stack([BODY + 0.05 * t, 0.01 * t, 0 * t], axis=1)
        return Support(rotate(self.turn, places), self.turned(about((0, 1.0, 0), 0.05 * t)).astype(np.float32))

    def solve(self, frame, support=None, **given):
        support = support or self.supports(frame)
        at = self.phase(frame)
        lift = np.maximum(0, np.cos(at))
        bend = 0.2 + 0.6 * lift**2
        self.rotations[:] = (0, 0, 0, 1)
        self.rotations[:, THIGH] = self.turned(about((1.0, 0, 0), -0.1 * np.sin(at) - bend / 2))
        self.rotations[:, SHIN] = self.turned(about((1.0, 0, 0), bend))
        root = np.stack([BODY, 0.86 + 0.008 * np.sin(2 * at), 0 * at], axis=1)
        self.root = rotate(self.turn, root).astype(np.float32).astype(float)
        far = (0, 0, 0) if self.far is None else self.far
        kind = np.float32 if self.far is None else float
        if self.crowd.component_count(Field.CONTACT):
            self.crowd.write(Field.CONTACT, np.cos(at) < 0)
        pose = Pose(self.rotations, root_position=(self.root + far).astype(kind), time=1 / SECOND,
                    support_position=(support.position + far).astype(kind), support_rotation=support.rotation)
        assert self.crowd.solve(pose=pose) == N and self.crowd.find(Flag.BAD_INPUT) is None
        self.plant, self.flags = self.crowd.read(Field.PLANT), self.crowd.read(Field.FLAGS)
        self.shift = self.crowd.read(Field.SHIFT, 1)[:, 0]

    def stand(self):
        """Whose feet are planted, with nothing left that fades."""
        return (self.flags & Flag.PLANTED > 0) & (self.plant[:, 9] == 0)

    def feet(self):
        """In the world, from solved poses and the shifts of their roots."""
        at, _ = bodies.forward(self.rotations.astype(float), self.places, parents=PARENTS)
        return at[:, FOOT] + self.root + rotate(self.turn, np.outer(self.shift, (0, 1, 0)))

    def state(self):
        return self.crowd.read(Field.PLANT), self.crowd.read(Field.SHIFT, 1)

    def set(self, state):
        self.crowd.write(Field.PLANT, state[0])
        self.crowd.write(Field.SHIFT, state[1], group=1)


class Standing(unittest.TestCase):
    def check_standing(self, walkers):
        stood, standing, released = np.full((N, 3), np.nan), 0, 0
        for frame in range(180):
            walkers.solve(frame)
            support, stand = walkers.supports(frame), walkers.stand()
            feet = rotate(back(support.rotation.astype(float)), walkers.feet() - support.position)
            stood = np.where(stand[:, None], np.where(np.isnan(stood), feet, stood), np.nan)
            self.assertLess(np.linalg.norm(feet - stood, axis=1)[stand].max(initial=0), BOUND)
            self.assertTrue(np.all(walkers.flags[stand] & Flag.REACHED))
            self.assertTrue(np.all(walkers.shift < 0.9 * WISH))
            standing += stand.sum()
            released += np.sum(walkers.flags & Flag.RELEASED > 0)
        self.assertGreater(standing, 800)
        self.assertGreater(released, 30)

    def test_a_planted_foot_does_not_move_on_its_support(self):
        self.check_standing(Walkers())
        self.check_standing(Walkers(turn=(np.sqrt(0.5), 0, 0, np.sqrt(0.5)), up=(0, 0, 2)))

    def test_slow_feet_are_planted_without_labels(self):
        """And low: heights are over the root, which is at the hips."""
        walkers = Walkers(FEATURES | Feature.PLANT_BY_MOTION, plant=Plant(speed=(0.8, 1), height=[-0.985, -0.97]))
        self.check_standing(walkers)
        self.assertEqual(walkers.crowd.component_count(Field.CONTACT), 0)

    def test_far_from_the_origin_in_doubles(self):
        """And nobody need give frames, because nobody gives a position."""
        self.check_standing(Walkers(far=(2.0**33, -(2.0**32), 2.0**30)))

    def test_a_plant_of_its_own(self):
        """The longest time that is left to a point is the one that its plant says."""
        for plant, most in ((Plant(), 0.2 - 1 / SECOND), (Plant(stop=0.35), 0.35), (Plant(blend=0.45), 0.45 - 1 / SECOND)):
            walkers, left = Walkers(plant=plant), 0
            for frame in range(60):
                walkers.solve(frame)
                left = max(left, walkers.plant[:, 9].max())
            self.assertAlmostEqual(left, most, 6)


class State(unittest.TestCase):
    def test_what_is_carried_can_be_set_back(self):
        """In the same crowd or another: the replay has equal bits. Without it a new crowd goes another way."""
        walkers = Walkers()
        for frame in range(50):
            walkers.solve(frame)
        saved, poses = walkers.state(), []
        for frame in range(50, 80):
            walkers.solve(frame)
            poses.append(walkers.rotations.tobytes())
        end = [each.tobytes() for each in walkers.state()]
        for each, is_set in ((walkers, True), (Walkers(), True), (Walkers(), False)):
            if is_set:
                each.set(saved)
            same = []
            for frame in range(50, 80):
                each.solve(frame)
                same.append(each.rotations.tobytes() == poses[frame - 50])
            self.assertEqual(all(same), is_set)
            self.assertEqual([state.tobytes() for state in each.state()] == end, is_set)

    def test_reset_starts_anew(self):
        walkers = Walkers()
        for frame in range(20):
            walkers.solve(frame)
        walkers.crowd.reset(first=3, count=2)
        begun = walkers.crowd.read(Field.PLANT)[:, 10]
        self.assertEqual(np.flatnonzero(begun == 0).tolist(), [3, 4])

    def test_a_changed_support_moves_no_foot(self):
        walkers, changed = Walkers(), Walkers()
        some = np.arange(4, 7)
        ground = Support(np.zeros((N, 3)), np.tile(np.float32((0, 0, 0, 1)), (N, 1)))
        other = Support(ground.position.copy(), ground.rotation.copy())
        other.position[some] = np.stack([some, 0 * some + 0.25, 0 * some - 2], axis=1)
        other.rotation[some] = [(0.5, 0.3, 0.2 * n, 0.7) for n in some]
        standing = 0
        for frame in range(85):
            if frame == 66:
                changed.crowd.change_support(Support(), Support(other.position[some], other.rotation[some]), first=4, count=3)
            walkers.solve(frame, ground)
            changed.solve(frame, other if frame >= 66 else ground)
            is_changed = np.isin(BODY, some) & (frame >= 66)
            moved = np.linalg.norm(walkers.feet() - changed.feet(), axis=1)
            self.assertLess(moved.max(), 2e-6)
            self.assertEqual(moved[~is_changed].max(initial=0), 0)
            np.testing.assert_array_equal(np.any(walkers.plant != changed.plant, axis=1), is_changed)
            standing += changed.stand()[is_changed].sum()
        self.assertGreater(standing, 30)


class Mistakes(unittest.TestCase):
    def fails(self, error, text, call, *arguments, **keywords):
        with self.assertRaisesRegex(error, re.escape(text)) as caught:
            call(*arguments, **keywords)
        self.assertNotIn("\n", str(caught.exception))

    def test_one_clear_line(self):
        leg = BodyGroup(THIGH, SHIN, FOOT, bend=(0, 0, -1), features=FEATURES)
        make = lambda *groups, **options: swivel.Crowd(groups, skeleton=Skeleton(PARENTS, PLACES), body_count=1, **options)
        fails, with_plant = self.fails, lambda **constants: leg._replace(plant=Plant(**constants))
        fails(TypeError, "plant: expected a Plant, got 0.1", make, leg._replace(plant=0.1), FitGroup())
        fails(TypeError, "plant.lock: expected a number, got 'x'", make, with_plant(lock="x"), FitGroup())
        fails(ValueError, "group 0, plant.run is 2; it is 0 to 1", make, with_plant(run=2), FitGroup())
        fails(ValueError, "plant.speed: expected shape (1, 2), or (2,) for all limbs, got (3,)", make, with_plant(speed=(1, 2, 3)), FitGroup())
        fails(TypeError, "fit.drop: expected a number, got None", make, leg, FitGroup(drop=None))
        fails(ValueError, "group 1, fit.half is -1; it is 0 to 1000", make, leg, FitGroup(half=-1))
        fails(TypeError, "expected a member of OnBadInput in a FitGroup, got FitGroup(drop=0.1", make, leg, FitGroup(on_bad_input="x"))
        fails(ValueError, "group 2 is Feature.FIT, and group 1 too", make, leg, FitGroup(), FitGroup())
        fails(ValueError, "group 0 is Feature.WITH_FIT, but no group is Feature.FIT; add one", make, leg)
        fails(ValueError, "the crowd def has no skeleton", swivel.Crowd, FitGroup())
        fails(ValueError, "up is 0, 0, 0; give an axis", make, leg, FitGroup(), up=(0, 0, 0))
        fails(ValueError, "up: expected shape (1, 3)", make, leg, FitGroup(), up=(0, 1))
        crowd, pose = make(leg, FitGroup()), Pose(np.tile(np.float32((0, 0, 0, 1)), (1, 4, 1)))
        fails(ValueError, "the pose has no time", crowd.solve, pose=pose)
        fails(ValueError, "time: expected shape (1,)", crowd.solve, pose=pose._replace(time=(1, 2)))
        fails(ValueError, "support_rotation: expected shape (1, 4)", crowd.solve, pose=pose._replace(time=0, support_rotation=np.eye(3)))
        fails(TypeError, "was: expected a Support, got None", crowd.change_support, None, Support())
        fails(ValueError, "now.position: expected shape (1, 3), or (3,) for all bodies, got (2,)", crowd.change_support, Support(), Support((1, 2)))
        fails(ValueError, "change_support: group 1 does not plant; create it with Feature.WITH_PLANT", crowd.change_support, Support(), Support(), 1)
        fails(ValueError, "goal is a result; write takes inputs and what is carried", crowd.write, Field.GOAL, np.zeros(7))
        fails(TypeError, "unexpected keyword argument 'contact'", swivel.solve, (0, 0, 1), None, (1, 1), contact=1)


if __name__ == "__main__":
    unittest.main()
