# SPDX-License-Identifier: MIT
"""The promise: a Region is what its cones and polygons say, by geometry in NumPy, and groups keep it."""
import unittest

import numpy as np

import swivel
from arms import Sample, joints_at, rotate
from bodies import LIMBS, PARENTS, PLACES
from swivel import Feature, Field, Flag, Region

CONES = np.float32([(0, 0, 1), (1, 0, 0.5), (1, 1, -1)]), np.float32([0.5, 0.4, 0.6])


def unit(v):
    v = np.asarray(v, float)
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def directions(n, seed=3):
    return unit(np.random.default_rng(seed).normal(size=(n, 3)))


def in_cone(d, axis, angle):
    return np.arccos(np.clip(unit(d) @ unit(axis), -1, 1)) <= angle


def cones():
    region = Region()
    region.add_cones(*CONES)
    return region


def solved(region, features=0):
    """500 arms at random, their upper arms' directions, and their flags."""
    sample = Sample(500)
    crowd = swivel.Crowd(swivel.Group(500, features=features, region=region))
    for field, values in ((Field.TARGET, sample.targets), (Field.POLE, sample.poles), (Field.LENGTHS, sample.lengths)):
        crowd.write(field, values)
    return crowd, sample


class Regions(unittest.TestCase):
    def test_cones_and_their_bridges(self):
        axes, angles = CONES
        some = directions(20000)
        rooms = cones().room(some)
        inside = np.any([in_cone(some, axis, angle) for axis, angle in zip(axes, angles)], axis=0)
        self.assertTrue(np.all(rooms[inside] >= -1e-6))
        bridged = (rooms > 0) & ~inside
        self.assertGreater(bridged.sum(), 200)
        # Between neighbours the narrowest path is allowed: every direction on the arc from axis to axis.
        for a, b in zip(unit(axes), unit(axes[1:])):
            arc = unit([(1 - t) * a + t * b for t in np.linspace(0, 1, 101)])
            self.assertTrue(np.all(cones().room(arc) > 0))
        # What is in no bridge is at most as far from the arc as the wider cone.
        arcs = np.concatenate([unit([(1 - t) * a + t * b for t in np.linspace(0, 1, 401)]) for a, b in zip(unit(axes), unit(axes[1:]))])
        away = np.arccos(np.clip(some @ arcs.T, -1, 1)).min(axis=1)
        self.assertTrue(np.all(away[rooms > 0] <= angles.max() + 1e-3))
        closed = Region()
        closed.add_cones(*CONES, closed=True)
        self.assertGreater((closed.room(some) > 0).sum(), (rooms > 0).sum())
        self.assertEqual(cones().room(some[0]), rooms[0])

    def test_polygons_forbidden_cones_and_mirrors(self):
        some = directions(5000)
        octant = Region()
        octant.add_polygon(np.eye(3, dtype=np.float32))
        np.testing.assert_array_equal(octant.room(some) >= 0, np.all(some >= 0, axis=1))
        octant.forbid((1, 1, 1), 0.3)
        np.testing.assert_array_equal(octant.room(some) >= 0, np.all(some >= 0, axis=1) & ~in_cone(some, (1, 1, 1), 0.3))
        np.testing.assert_array_equal(octant.mirrored().room(some * (-1, 1, 1)), octant.room(some))

    def test_what_a_clip_does(self):
        clip = unit(np.stack([np.sin(np.linspace(0, 2, 200)), np.full(200, 0.3), np.cos(np.linspace(0, 2, 200))], axis=1))
        region = Region()
        region.add_directions(clip, np.radians(5), most_cones=4)
        wide = unit(clip + np.tan(np.radians(4.9)) * unit(np.cross(clip, directions(200))))  # 4.9 degrees around
        self.assertTrue(np.all(region.room(wide) >= 0))
        one = Region()
        one.add_directions(clip, np.radians(5), 1)
        some = directions(5000)
        self.assertLess((region.room(some) >= 0).sum(), 0.7 * (one.room(some) >= 0).sum())

    def test_arms_keep_it(self):
        region = cones()
        region.forbid((0, 0, 1), 0.2)
        crowd, sample = solved(region)
        crowd.solve()
        elbows = joints_at(crowd.read(Field.SHOULDER), crowd.read(Field.ELBOW), sample.lengths)[0]
        flags, rooms = crowd.read(Field.FLAGS), region.room(elbows)
        kept = (flags & Flag.INFEASIBLE) == 0
        self.assertTrue(np.all(rooms[kept] >= -1e-6))
        self.assertTrue(np.all(rooms[~kept] < 1e-6))
        for some in (kept & (flags & Flag.LIMITED_REGION > 0), kept & (flags & Flag.LIMITED_REGION == 0), ~kept):
            self.assertGreater(some.sum(), 20)

    def test_one_cone_is_the_shoulders_cone(self):
        axis, angle = (0.3, 0.5, 1), 0.9
        region = Region()
        region.add_cones([axis], angle)
        ours, sample = solved(region)
        other, _ = solved(None, Feature.WITH_SHOULDER_CONE)
        other.write(Field.SHOULDER_CONE, swivel.cone(axis, angle))
        ours.solve(), other.solve()
        elbows = [joints_at(crowd.read(Field.SHOULDER), crowd.read(Field.ELBOW), sample.lengths)[0] for crowd in (ours, other)]
        np.testing.assert_allclose(*elbows, atol=2e-4)
        limited = ours.read(Field.FLAGS) & Flag.LIMITED_REGION > 0
        np.testing.assert_array_equal(limited, other.read(Field.FLAGS) & Flag.LIMITED_SHOULDER_CONE > 0)
        self.assertGreater(limited.sum(), 50)

    def test_bodies_keep_it(self):
        arm = swivel.BodyGroup(*LIMBS[0], bend=(0, 0, 1), region=cones())
        crowd = swivel.Crowd([arm], skeleton=swivel.Skeleton(PARENTS, PLACES), body_count=50)
        self.assertTrue(crowd.features(0) & Feature.WITH_REGION)
        rotations = np.tile(np.float32((0, 0, 0, 1)), (50, len(PARENTS), 1))
        crowd.write(Field.TARGET, (0.3 * directions(50) + (0.2, 1.5, 0)).astype(np.float32))
        crowd.solve(pose=swivel.Pose(rotations))
        bind = swivel.bind_joints(PARENTS, PLACES, *LIMBS[0], bend=(0, 0, 1))
        # The upper arm's own axis at rest, in the arm frame, is +z; so the shoulder's turn there says where it points.
        upper = rotate(rotations[:, LIMBS[0][0]], rotate(bind.upper_from_arm, (0, 0, 1)))
        conjugate = bind.parent_from_arm * np.float32((-1, -1, -1, 1))
        rooms = cones().room(rotate(conjugate, upper))
        kept = (crowd.read(Field.FLAGS) & Flag.INFEASIBLE) == 0
        self.assertTrue(np.all(rooms[kept] >= -1e-5))
        self.assertGreater(kept.sum(), 10)

    def test_refusals(self):
        for text, call in (("the margin, 0, is not in 0.01 to 1", lambda: Region().add_directions([(1, 0, 0)], 0)),
                           ("9 cones are not 1 to 6", lambda: Region().add_directions([(1, 0, 0)], 0.1, 9)),
                           ("there are no directions", lambda: Region().add_directions(np.empty((0, 3)), 0.1)),
                           ("cones 0 and 1 are opposite", lambda: Region().add_cones([(1, 0, 0), (-1, 0, 0)], 0.1)),
                           ("give a convex polygon", lambda: Region().add_polygon(np.eye(3)[::-1])),
                           ("the angle of cone 0, 4, is not", lambda: Region().forbid((1, 0, 0), 4)),
                           ("direction 0, (0, 0, 0), has no direction", lambda: Region().room((0, 0, 0))),
                           ("the axis of cone 0, (0, 0, 0), has no", lambda: Region().forbid((0, 0, 0), 1)),
                           ("found no cones that hold all these directions",
                            lambda: Region().add_directions(np.vstack([np.eye(3), -np.eye(3)]), 0.1, 1)),
                           ("axes: expected shape (n, 3), got (3,)", lambda: Region().add_cones((1, 0, 0), 0.1)),
                           ("the region allows nothing", lambda: swivel.Crowd(swivel.Group(1, region=Region()))),
                           ("WITH_REGION needs a region", lambda: swivel.Crowd(1, Feature.WITH_REGION))):
            with self.subTest(text), self.assertRaises(ValueError) as raised:
                call()
            self.assertIn(text, str(raised.exception))
        with self.assertRaisesRegex(TypeError, "region: expected a Region, got 3"):
            swivel.Crowd(swivel.Group(1, region=3))


if __name__ == "__main__":
    unittest.main()
