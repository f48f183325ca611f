# SPDX-License-Identifier: MIT
"""The promise: what comes back poses arms as the header says, judged by a forward kinematics in NumPy, and is the same bits on
every instruction set and by every way to solve."""
import unittest

import numpy as np

import swivel
from arms import Sample, flexed, joints_at, quaternions, rotate, times
from swivel import Feature, Field, Flag

N = 1000


def crowd_of(sample, features=0, groups=None):
    crowd = swivel.Crowd(groups or len(sample.targets), features)
    crowd.write(Field.TARGET, sample.targets)
    crowd.write(Field.POLE, sample.poles)
    crowd.write(Field.LENGTHS, sample.lengths)
    return crowd


class Poses(unittest.TestCase):
    def test_wrists_are_at_their_targets_and_elbows_on_the_poles_side(self):
        sample = Sample(N)
        crowd = crowd_of(sample)
        crowd.solve()
        elbows, wrists = joints_at(crowd.read(Field.SHOULDER), crowd.read(Field.ELBOW), sample.lengths)
        off = np.linalg.norm(wrists - sample.targets, axis=1) / sample.lengths.sum(axis=1)
        self.assertLess(off.max(), 1e-6)
        side = np.cross(sample.targets, np.cross(sample.poles, sample.targets))
        self.assertTrue(np.all(np.sum(elbows * side, axis=1) > 0))
        np.testing.assert_array_equal(crowd.read(Field.FLAGS), Flag.REACHED)
        np.testing.assert_allclose(crowd.elbows(), elbows, atol=1e-6)
        np.testing.assert_allclose(crowd.wrists(), wrists, atol=1e-6)
        np.testing.assert_allclose(crowd.residuals(), off, atol=1e-7)

    def test_hands_in_the_world(self):
        sample, random = Sample(N), np.random.default_rng(2)
        parents, hands = quaternions(random, N), quaternions(random, N)
        places = random.normal(size=(N, 3)).astype(np.float32)
        scale = random.uniform(0.5, 2, N).astype(np.float32)
        world = lambda v: places + scale[:, None] * rotate(parents, v)
        arms = swivel.solve(world(sample.targets), world(sample.poles), sample.lengths, shoulder_position=places,
                            parent_rotation=parents, parent_scale=scale, hand=hands)
        _, wrists = joints_at(arms.shoulder, arms.elbow, sample.lengths)
        np.testing.assert_allclose(world(wrists), world(sample.targets), atol=4e-6)
        np.testing.assert_allclose(arms.wrist_position, world(wrists), atol=4e-6)
        posed = times(parents, times(arms.shoulder, times(flexed(arms.elbow), arms.wrist)))
        np.testing.assert_allclose(abs(np.sum(posed * hands, axis=1)), 1, atol=1e-6)

    def test_a_skeletons_own_joints(self):
        sample, random = Sample(N), np.random.default_rng(3)
        rest = quaternions(random, 3)
        upper, fore = np.array([0.3, 0.1, 0.0]), np.array([0.25, 0.0, 0.05])
        limb = swivel.bind(upper, fore, np.cross(upper, (0, 0, 1)), *rest)
        np.testing.assert_allclose(limb.lengths, [np.linalg.norm(upper), np.linalg.norm(fore)], rtol=1e-6)
        kept = swivel.Binding(**{name: getattr(limb, name) for name in dir(swivel.Binding) if name[0] != "_"})
        for binding in (limb, kept):
            crowd = swivel.Crowd([(N, binding)], Feature.JOINTS | Feature.WORLD)
            for field, values in ((Field.TARGET, sample.targets), (Field.POLE, sample.poles), (Field.SHOULDER_POSITION, (0, 0, 0))):
                crowd.write(field, values)
            crowd.solve()
            shoulder, elbow = crowd.read(Field.SHOULDER), crowd.read(Field.ELBOW)
            wrists = rotate(shoulder, upper) + rotate(times(shoulder, elbow), fore)
            reached = (crowd.read(Field.FLAGS) & Flag.REACHED) != 0
            self.assertGreater(reached.sum(), N / 2)
            np.testing.assert_allclose(wrists[reached], sample.targets[reached], atol=1e-6)

    def test_joints_of_a_skeleton(self):
        """Forward kinematics over the whole skeleton: a joint between the limb's, twist bones, children before parents."""
        random = np.random.default_rng(5)
        # wrist, twist, twist, roll of the forearm, elbow, roll of the upper arm, shoulder, chest, root
        parents = np.array([3, 3, 4, 4, 5, 6, 7, 8, -1])
        places = random.normal(scale=0.3, size=(9, 3))
        places[1] = 0.6 * places[0]
        places[2] = 0.1 * places[3]
        rest = quaternions(random, 9).astype(np.float64)

        def pose(local):
            turned, at = [None] * 9, [None] * 9
            for joint in range(8, -1, -1):
                above = parents[joint]
                turned[joint] = local[joint] if above < 0 else times(turned[above], local[joint])
                at[joint] = np.broadcast_to(places[joint], (N, 3)) if above < 0 else at[above] + rotate(turned[above], places[joint])
            return turned, at

        still = [np.broadcast_to(each, (N, 4)) for each in rest]
        turned, at = pose(still)
        limb = swivel.bind_joints(parents, places, 6, 4, 0, rotations=rest, twist_bones=[2, 1], bend=random.normal(size=3))
        kept = swivel.Binding(**{name: getattr(limb, name) for name in dir(swivel.Binding) if name[0] != "_"})
        self.assertEqual(repr(kept), repr(limb))
        self.assertEqual(limb.twist_from_arm.shape, (2, 4))
        crowd = swivel.Crowd([(N, kept)], Feature.JOINTS | Feature.WORLD | Feature.WITH_HAND | 2 * Feature.WITH_TWIST_BONES)
        reach = limb.lengths.sum()
        line = random.normal(size=(N, 3))
        line *= random.uniform(0.7, 0.9, (N, 1)) * reach / np.linalg.norm(line, axis=1)[:, None]
        targets, hands = at[6] + line, quaternions(random, N)
        for field, values in ((Field.TARGET, targets), (Field.POLE, at[6] + random.normal(size=(N, 3))), (Field.HAND, hands),
                              (Field.SHOULDER_POSITION, at[6]), (Field.PARENT_ROTATION, turned[7])):
            crowd.write(field, values)
        crowd.solve()
        local = list(still)
        local[6], local[4], local[0] = crowd.read(Field.SHOULDER), crowd.read(Field.ELBOW), crowd.read(Field.WRIST)
        twist = crowd.read(Field.TWIST_BONES)
        local[2], local[1] = twist[:, :4], twist[:, 4:]
        turned, at = pose(local)
        reached = (crowd.read(Field.FLAGS) & Flag.REACHED) != 0
        self.assertGreater(reached.sum(), N / 2)
        np.testing.assert_allclose(at[0][reached], targets[reached], atol=2e-6)
        np.testing.assert_allclose(abs(np.sum(turned[0] * hands, axis=1)), 1, atol=2e-6)
        with self.assertRaisesRegex(ValueError, "bind_joints: the elbow, joint 6, is not below the shoulder, joint 4"):
            swivel.bind_joints(parents, places, 4, 6, 0, rotations=rest)
        turned_none = swivel.bind_joints(parents, places, 6, 4, 0, twist_bones=[2, 1], bend=(1, 0, 0))
        given = swivel.bind_joints(parents, places, 6, 4, 0, np.tile((0, 0, 0, 1), (9, 1)), [2, 1], (1, 0, 0))
        self.assertEqual(repr(turned_none), repr(given))
        with self.assertRaisesRegex(ValueError, r"translations: expected shape \(9, 3\)"):
            swivel.bind_joints(parents, places[1:], 6, 4, 0)

    def test_limits_hold_and_arcs_tell_which_swivels_they_leave(self):
        sample = Sample(N)
        arms = swivel.solve(sample.targets, sample.poles, sample.lengths, shoulder_cone=swivel.cone((0, 0, 1), 1.2),
                            flexion_limit=swivel.flexion(0.3, 2.0))
        flexion = 2 * np.arctan2(arms.elbow[:, 1], arms.elbow[:, 0])
        self.assertTrue(np.all((flexion > 0.3 - 1e-5) & (flexion < 2.0 + 1e-5)))
        cosine = rotate(arms.shoulder, np.array([0.0, 0.0, 1.0]))[:, 2]
        feasible = (arms.flags & Flag.INFEASIBLE) == 0
        self.assertTrue(np.any(feasible) and np.any(~feasible))
        self.assertTrue(np.all(cosine[feasible] > np.cos(1.2) - 1e-6))
        crowd = crowd_of(sample, Feature.WITH_SHOULDER_CONE)
        crowd.write(Field.SHOULDER_CONE, swivel.cone((0, 0, 1), 1.2))
        arcs = [crowd.allowed_arcs(limb) for limb in range(N)]
        crowd.solve()
        infeasible = (crowd.read(Field.FLAGS) & Flag.INFEASIBLE) != 0
        np.testing.assert_array_equal([len(each) == 0 for each in arcs], infeasible)
        ends = np.concatenate(arcs)
        self.assertEqual(ends.shape[1:], (2, 2))
        np.testing.assert_allclose(np.linalg.norm(ends, axis=2), 1, atol=1e-5)

    def test_no_arms_give_no_arms(self):
        none = swivel.solve(np.empty((0, 3)), None, (0.3, 0.26), hand=np.empty((0, 4)))
        for name, shape in (("shoulder", (0, 4)), ("elbow", (0, 2)), ("wrist", (0, 4)), ("flags", (0,)), ("wrist_position", (0, 3)),
                            ("residual", (0,))):
            self.assertEqual(getattr(none, name).shape, shape)

    def test_things_say_what_they_are(self):
        binding = swivel.bind((0.5, 0, 0), (0.25, 0, 0), (0, 0, 1))
        np.testing.assert_array_equal(eval(repr(binding), {"Binding": swivel.Binding}).upper_from_arm, binding.upper_from_arm)
        self.assertIn("lengths=[0.5, 0.25]", repr(binding))
        self.assertIn("<Crowd of [5, 40] limbs", repr(swivel.Crowd([5, 40], Feature.WORLD)))
        self.assertIn("WORLD", repr(swivel.Crowd([5, 40], Feature.WORLD)))
        self.assertIn("<Check production<float>, wrist to target, ", "".join(map(repr, swivel.verify(50)[1])))

    def test_find_goes_from_flag_to_flag(self):
        crowd = swivel.Crowd([5, 40])
        for group in (0, 1):
            crowd.write(Field.TARGET, (0.3, 0.2, 0.4), group)
            crowd.write(Field.LENGTHS, (1, 1), group)
        crowd.write(Field.TARGET, (0, 0, 9), 1, first=33, count=1)
        crowd.write(Field.POLE, (np.nan, 0, 0), 0, first=4, count=1)
        self.assertIsNone(crowd.find(~0 & 0xffffffff))
        self.assertIn("target (nan, nan, nan) is not a number", swivel.Crowd([2, 3]).explain(limb=1, group=1))
        crowd.solve()
        self.assertEqual(crowd.find(Flag.CLAMPED_FAR | Flag.BAD_INPUT), (0, 4))
        self.assertEqual(crowd.find(Flag.CLAMPED_FAR | Flag.BAD_INPUT, 0, 5), (1, 33))
        self.assertIsNone(crowd.find(Flag.CLAMPED_FAR, 1, 34))
        self.assertIsNone(crowd.find(Flag.REACHED, 2))

    def test_explanations_of_many_bad_inputs_are_whole(self):
        crowd = swivel.Crowd([1], Feature.WORLD | Feature.WITH_HAND | Feature.WITH_INCOMING | Feature.WITH_SHOULDER_BOX |
                             Feature.WITH_WRIST_BOX | Feature.WITH_HAND_TWIST | Feature.WITH_REACH)
        for field in (Field.TARGET, Field.POLE, Field.HAND, Field.INCOMING_SHOULDER, Field.INCOMING_ELBOW,
                      Field.INCOMING_WRIST, Field.REACH, Field.HAND_TWIST, Field.SHOULDER_BOX, Field.WRIST_BOX):
            crowd.write(field, np.full_like(crowd.read(field)[0], -1.2345678e+20))
        crowd.solve()
        text = crowd.explain(limb=0)
        self.assertGreater(len(text), 1024)
        self.assertTrue(text.endswith(" The limb has its rest pose."), text[-100:])

    def test_the_digest_is_that_of_the_results(self):
        first, second = swivel.Crowd([5, 40]), swivel.Crowd([5, 40])
        for crowd in (first, second):
            for group in (0, 1):
                crowd.write(Field.TARGET, (0.3, 0.2, 0.4), group)
                crowd.write(Field.LENGTHS, (1, 1), group)
        self.assertEqual(first.digest(), second.digest())
        first.solve()
        self.assertNotEqual(first.digest(), second.digest())
        second.solve()
        self.assertEqual(first.digest(), second.digest())

    def test_joint_angles_rebuild_the_shoulder(self):
        sample = Sample(N)
        crowd = crowd_of(sample)
        crowd.solve()
        half = 0.5 * crowd.joint_angles(swivel.EulerOrder.XYZ)
        self.assertEqual(half.shape, (N, 7))
        turns = [np.insert(np.zeros((N, 3)), 3, np.cos(half[:, axis]), axis=1) for axis in range(3)]
        for axis in range(3):
            turns[axis][:, axis] = np.sin(half[:, axis])
        rebuilt = times(turns[0], times(turns[1], turns[2]))
        np.testing.assert_allclose(abs(np.sum(rebuilt * crowd.read(Field.SHOULDER), axis=1)), 1, atol=1e-6)
        np.testing.assert_allclose(2 * half[:, 3], 2 * np.arctan2(*crowd.read(Field.ELBOW).astype(float).T[::-1]), atol=1e-6)

    def test_far_from_the_origin(self):
        sample, home = Sample(N), np.array([4e6, -3e6, 5e6])
        far = lambda v: home + v.astype(float)
        keywords = dict(shoulder_position=home, origin=home)
        arms = swivel.solve(far(sample.targets), far(sample.poles), sample.lengths, **keywords)
        near = swivel.solve(sample.targets, sample.poles, sample.lengths, shoulder_position=(0, 0, 0))
        np.testing.assert_allclose(arms.wrist_position, near.wrist_position, atol=1e-6)

    def test_hands_that_aim(self):
        sample, forward = Sample(N), np.array([0.0, 0.0, 1.0])
        arms = swivel.solve(sample.targets * 3, sample.poles, sample.lengths, aim=swivel.aim(forward, 0.5))
        np.testing.assert_allclose(2 * np.arctan2(arms.elbow[:, 1], arms.elbow[:, 0]), 0.5, atol=1e-6)
        ray = rotate(times(arms.shoulder, flexed(arms.elbow)), forward)  # the hand is at rest, along the forearm
        _, wrists = joints_at(arms.shoulder, arms.elbow, sample.lengths)
        beside = np.linalg.norm(np.cross(sample.targets * 3 - wrists, ray), axis=1)
        reached = (arms.flags & Flag.REACHED) != 0
        self.assertGreater(reached.sum(), N / 2)
        self.assertLess(beside[reached].max(), 2e-6)

    def test_clavicles_take_their_share(self):
        sample, bone = Sample(N), np.array([0.15, 0.05, 0.0])
        arms = swivel.solve(sample.targets, sample.poles, sample.lengths, shoulder_position=(0, 0, 0), clavicle=(*bone, 0.3))
        turn = arms.clavicle_turn
        _, wrists = joints_at(arms.shoulder, arms.elbow, sample.lengths)
        wrists = rotate(turn, bone + wrists) - bone
        reached = (arms.flags & Flag.REACHED) != 0
        self.assertGreater(reached.sum(), N / 2)
        np.testing.assert_allclose(wrists[reached], sample.targets[reached], atol=1e-6)
        self.assertGreater(np.linalg.norm(turn[:, :3], axis=1).max(), 0.05)

    def test_mirrored_limits(self):
        axes = [(1, 2, 3), (-1, 0.5, 2)]
        cones = np.stack([swivel.cone(axis, 1.0) for axis in axes])
        mirrored = np.stack([swivel.cone((-x, y, z), 1.0) for x, y, z in axes])
        np.testing.assert_array_equal(swivel.mirror(Field.SHOULDER_CONE, cones), mirrored)
        np.testing.assert_array_equal(swivel.mirror(Field.SHOULDER_CONE, cones[0]), mirrored[0])
        np.testing.assert_allclose(swivel.mirror(Field.HUMERAL_TWIST, swivel.range(-0.2, 1.0)), swivel.range(-1.0, 0.2), atol=1e-7)


class Groups(unittest.TestCase):
    """Each group gets what a crowd of its own gets, bit for bit."""

    def setUp(self):
        self.sample, random = Sample(40), np.random.default_rng(6)
        self.hands = quaternions(random, 40)
        self.limb = swivel.bind((0.3, 0, 0), (0.25, 0, 0), (0, 0, 1))
        self.plain = swivel.Group(40, features=Feature.WITH_SHOULDER_CONE)
        self.bound = swivel.Group(20, self.limb, Feature.WORLD | Feature.JOINTS | Feature.WITH_HAND)

    def fill(self, crowd, plain=None, bound=None):
        """Inputs of the groups with these numbers."""
        sample = self.sample
        if plain is not None:
            for field, values in ((Field.TARGET, sample.targets), (Field.POLE, sample.poles), (Field.LENGTHS, sample.lengths),
                                  (Field.SHOULDER_CONE, swivel.cone((0, 1, 1), 1.0))):
                crowd.write(field, values, plain)
        if bound is not None:
            for field, values in ((Field.TARGET, sample.targets[:20]), (Field.POLE, sample.poles[:20]), (Field.HAND, self.hands[:20]),
                                  (Field.SHOULDER_POSITION, (0, 0, 0))):
                crowd.write(field, values, bound)

    def results(self, crowd, group):
        return {field.name: crowd.read(field, group) for field in Field
                if field >= Field.SHOULDER and crowd.component_count(field, group) > 0}

    def check_same(self, found, wanted):
        self.assertEqual(found.keys(), wanted.keys())
        for name in wanted:
            np.testing.assert_array_equal(found[name], wanted[name], name)

    def alone(self):
        plain, bound = swivel.Crowd(self.plain), swivel.Crowd([self.bound])
        self.fill(plain, plain=0)
        self.fill(bound, bound=0)
        plain.solve(), bound.solve()
        return self.results(plain, 0), self.results(bound, 0)

    def test_different_features_in_one_solve(self):
        crowd = swivel.Crowd([self.plain, self.bound])
        self.fill(crowd, plain=0, bound=1)
        self.assertEqual(crowd.solve(), 60)
        wanted_plain, wanted_bound = self.alone()
        self.check_same(self.results(crowd, 0), wanted_plain)
        self.check_same(self.results(crowd, 1), wanted_bound)
        self.assertEqual((crowd.features(0), crowd.features(1)), (self.plain.features, self.bound.features))
        self.assertEqual([crowd.component_count(Field.ELBOW, group) for group in (0, 1)], [2, 4])
        self.assertEqual([crowd.component_count(Field.HAND, group) for group in (0, 1)], [0, 4])
        for group, count in ((0, 40), (1, 20)):  # rows are a group's own, and start at its first limb
            limbs = np.arange(count)
            np.testing.assert_array_equal(crowd.rows(Field.ELBOW, group)[limbs // 16, :, limbs % 16], crowd.read(Field.ELBOW, group))
            self.assertEqual(crowd.result_rows(group).shape[0], -(-count // 16))
        self.assertFalse(np.shares_memory(crowd.input_rows(0), crowd.input_rows(1)))
        with self.assertRaisesRegex(ValueError, "group 0, hand: not part of this group; create it with Feature.WITH_HAND"):
            crowd.rows(Field.HAND, 0)
        with self.assertRaisesRegex(ValueError, "group 1: Feature.WITH_AIM excludes Feature.WITH_REACH"):
            swivel.Crowd([1, swivel.Group(1, features=Feature.WITH_AIM | Feature.WITH_REACH)])

    def test_what_a_group_does_not_say_is_the_crowds(self):
        crowd = swivel.Crowd([3, swivel.Group(4), swivel.Group(5, features=0), (6, self.limb)], Feature.WITH_REACH)
        self.assertEqual([crowd.features(group) for group in range(4)], [Feature.WITH_REACH] * 2 + [0, Feature.WITH_REACH])
        angles = np.radians((70, 20, 50))
        boxes = np.concatenate([swivel.range(angle - 0.05, angle + 0.05) for angle in angles])

        def shoulders(crowd, group):
            for field, values in ((Field.TARGET, self.sample.targets), (Field.LENGTHS, self.sample.lengths), (Field.SHOULDER_BOX, boxes)):
                crowd.write(field, values, group)
            crowd.solve()
            return crowd.read(Field.SHOULDER, group)

        def of_order(order):
            return shoulders(swivel.Crowd(40, Feature.WITH_SHOULDER_BOX, order), 0)

        self.assertTrue(np.any(of_order(swivel.EulerOrder.XYZ) != of_order(swivel.EulerOrder.ZXY)))
        own = swivel.Group(40, shoulder_order=swivel.EulerOrder.ZXY)
        crowd = swivel.Crowd([40, own], Feature.WITH_SHOULDER_BOX, swivel.EulerOrder.XYZ)
        np.testing.assert_array_equal(shoulders(crowd, 0), of_order(swivel.EulerOrder.XYZ))
        np.testing.assert_array_equal(shoulders(crowd, 1), of_order(swivel.EulerOrder.ZXY))

    def test_some_groups(self):
        wanted_plain, wanted_bound = self.alone()
        crowd = swivel.Crowd([self.plain, self.bound, self.plain])
        self.fill(crowd, plain=0, bound=1)
        self.fill(crowd, plain=2)
        before = self.results(crowd, 1)
        self.assertEqual(crowd.solve(groups=[0, 2]), 80)
        self.check_same(self.results(crowd, 0), wanted_plain)
        self.check_same(self.results(crowd, 1), before)
        self.check_same(self.results(crowd, 2), wanted_plain)
        self.assertEqual(crowd.solve(groups=np.array([1]), mask=np.ones(crowd.lane_count, bool)), 20)
        self.check_same(self.results(crowd, 1), wanted_bound)
        self.assertEqual(crowd.solve(groups=[]), 0)
        with self.assertRaisesRegex(ValueError, "riorities"):
            crowd.solve(groups=[0], priorities=[1, 1, 1], most_blocks=1)

    def test_frames_are_those_of_the_groups_as_named(self):
        wanted_plain, wanted_bound = self.alone()
        for groups in ([0, 1], [1, 0]):
            crowd = swivel.Crowd([self.plain, self.bound, 7])
            self.fill(crowd, plain=0, bound=1)
            plain = {"shoulder": np.zeros((40, 4), np.float32), "elbow": np.zeros((40, 2), np.float32)}
            bound = {"hand": self.hands[:20], "wrist": np.zeros((20, 4), np.float32), "elbow": np.zeros((20, 4), np.float32)}
            frames = [plain, bound] if groups == [0, 1] else [bound, plain]
            self.assertEqual(crowd.solve(groups=groups, frames=frames), 60)
            for frame, wanted in ((plain, wanted_plain), (bound, wanted_bound)):
                for name in set(frame) - {"hand"}:
                    np.testing.assert_array_equal(frame[name], wanted[name.upper()], name)
        crowd.solve(groups=[1], frames=bound)  # one group, one dict
        with self.assertRaisesRegex(ValueError, "frames: expected one for each of 2 groups, got 3"):
            crowd.solve(groups=[0, 1], frames=[{}, {}, {}])

    def test_bad_input_keeps_the_pose_or_rests(self):
        keeps = swivel.Group(40, on_bad_input=swivel.OnBadInput.KEEP_POSE)
        crowd = swivel.Crowd([keeps, 40])
        for group in (0, 1):
            for field, values in ((Field.TARGET, self.sample.targets), (Field.LENGTHS, self.sample.lengths)):
                crowd.write(field, values, group)
        crowd.solve()
        good = crowd.read(Field.SHOULDER)
        targets = self.sample.targets[::-1].copy()
        targets[::3] = np.nan
        bad = np.isnan(targets[:, 0])
        for outs in ([good.copy() for _ in range(2)], [np.asfortranarray(good) for _ in range(2)]):  # in place, and through a copy
            flags = np.zeros(40, np.uint32)
            crowd.solve(frames=[{"target": targets, "shoulder": outs[0], "flags": flags}, {"target": targets, "shoulder": outs[1]}])
            np.testing.assert_array_equal(flags[bad], Flag.BAD_INPUT)
            np.testing.assert_array_equal(outs[0][bad], good[bad])
            np.testing.assert_array_equal(outs[1][bad], np.tile(np.float32((0, 0, 0, 1)), (bad.sum(), 1)))
            np.testing.assert_array_equal(outs[0][~bad], outs[1][~bad])
            self.assertTrue(np.any(outs[0][~bad] != good[~bad]))
            for group in (0, 1):
                np.testing.assert_array_equal(crowd.read(Field.SHOULDER, group), outs[group])
        rests = swivel.Crowd(40, on_bad_input=swivel.OnBadInput.KEEP_POSE)  # for all groups
        rests.write(Field.LENGTHS, (1, 1))
        rests.write(Field.TARGET, (0, 1, 1))
        rests.solve()
        before = rests.read(Field.SHOULDER)
        rests.write(Field.TARGET, (np.nan, 0, 0))
        rests.solve()
        np.testing.assert_array_equal(rests.read(Field.SHOULDER), before)

    def test_urgency_is_the_callers(self):
        crowd = swivel.Crowd([16, 16, 16])
        mine, others = np.zeros((2, 3), np.float32)
        picked = lambda mask: mask.reshape(3, 16)[:, 0].tolist()
        turns = [picked(crowd.choose([2, 1, 1], 1, mine)) for _ in range(400)]
        np.testing.assert_allclose(np.sum(turns, axis=0), (200, 100, 100), atol=2)  # as often as priorities say
        self.assertFalse(np.any(others))
        self.assertEqual(picked(crowd.choose([1, 3, 1], 1)), [False, True, False])  # without: priorities alone
        self.assertEqual(picked(crowd.choose([1, 3, 1], 1)), [False, True, False])
        crowd.choose([1, 2, 4], 1, others)
        np.testing.assert_array_equal(abs(others), (1, 2, 0))
        crowd.solve(priorities=[1, 1, 1], most_blocks=1, urgency=others)
        np.testing.assert_array_equal(abs(others), (2, 0, 1))


class Bits(unittest.TestCase):
    def results(self, crowd):
        return b"".join(crowd.read(field).tobytes() for field in (Field.SHOULDER, Field.ELBOW, Field.FLAGS))

    def test_every_instruction_set_gives_the_same(self):
        before = swivel.isa_name()
        self.addCleanup(swivel.use_isa, before)
        found = set()
        for name, runs in swivel.isas():
            if runs:
                swivel.use_isa(name)
                self.assertEqual(swivel.isa_name(), name)
                crowd = crowd_of(Sample(N), Feature.WITH_SHOULDER_CONE)
                crowd.write(Field.SHOULDER_CONE, swivel.cone((0, 1, 1), 1.0))
                crowd.solve()
                found.add(self.results(crowd))
        self.assertEqual(len(found), 1)

    def test_every_way_to_solve_gives_the_same(self):
        sample = Sample(N)
        whole = crowd_of(sample)
        whole.solve()
        wanted = self.results(whole)

        def blocks(crowd):
            for block in range(crowd.block_count):
                self.assertEqual(crowd.solve(blocks=(block, 1), on_this_thread=True), min(16, N - 16 * block))

        def active(crowd):
            lanes = np.zeros(crowd.lane_count, bool)
            lanes[crowd.limbs()] = np.arange(N) % 2 == 0
            self.assertEqual(crowd.solve(mask=lanes), (N + 1) // 2)
            crowd.solve(blocks=(0, crowd.block_count), mask=~lanes, on_this_thread=True)

        def chosen(crowd):
            urgency = np.zeros(crowd.block_count, np.float32)
            for _ in range(4):
                crowd.solve(mask=crowd.choose([np.ones(N)], crowd.block_count // 4 + 1, urgency))

        def budget(crowd):
            urgency = np.zeros(crowd.block_count, np.float32)
            solved = sum(crowd.solve(priorities=[1.0], most_blocks=20, urgency=urgency) for _ in range(4))
            self.assertEqual(solved, N + 17 * 16)

        def frame(crowd):
            out = {"shoulder": np.zeros((N, 4), np.float32), "flags": np.zeros(N, np.uint32)}
            crowd.solve(frames={"target": sample.targets, "pole": sample.poles, **out})
            np.testing.assert_array_equal(out["shoulder"], whole.read(Field.SHOULDER))
            np.testing.assert_array_equal(out["flags"], whole.read(Field.FLAGS))

        def frame_blocks(crowd):
            for first in range(0, crowd.block_count, 9):
                crowd.solve(frames=[{"target": sample.targets}], blocks=(first, min(9, crowd.block_count - first)), on_this_thread=True)

        def limbs(crowd):
            self.assertEqual(crowd.solve(limbs=[]), 0)
            self.assertEqual(crowd.solve(limbs=np.random.default_rng(4).permutation(N)), N)

        def chosen_frame(crowd):
            out = np.full((N, 4), 7, np.float32)
            odd = crowd.limbs()[1::2]
            crowd.solve(limbs=odd, frames={"target": sample.targets, "shoulder": out})
            np.testing.assert_array_equal(out[1::2], whole.read(Field.SHOULDER)[1::2])
            np.testing.assert_array_equal(out[::2], 7)
            crowd.solve(limbs=crowd.limbs()[::2])

        ways = [blocks, active, limbs, frame, frame_blocks, chosen_frame, chosen, budget]
        for way in ways:
            crowd = crowd_of(sample)
            way(crowd)
            self.assertEqual(self.results(crowd), wanted)

    def test_packed_words(self):
        crowd = crowd_of(Sample(N))
        crowd.solve()
        packed, rotations = crowd.pack(), crowd.read(Field.SHOULDER)

        def words_of(field, count):
            first = crowd.packed_row(field)
            return np.moveaxis(packed[:, first:first + count], 1, 2).reshape(-1, count)[crowd.limbs()]
        forearm = np.array([0.1, 0.2, 0.3])  # a rotation is within 1.54e-4 rad
        unpacked = swivel.unpack_rotations(words_of(Field.SHOULDER, 3))
        apart = rotate(unpacked, forearm) - rotate(rotations, forearm)
        self.assertLess(np.linalg.norm(apart, axis=1).max(), 1.54e-4 * np.linalg.norm(forearm))
        np.testing.assert_array_equal(swivel.unpack_rotations(words_of(Field.SHOULDER, 3)[7]), unpacked[7])
        halves = words_of(Field.ELBOW, 2).copy().view(np.float16)
        np.testing.assert_array_equal(halves, crowd.read(Field.ELBOW).astype(np.float16))
        low, high = words_of(Field.FLAGS, 2).T.astype(np.uint32)
        np.testing.assert_array_equal(low | high << 16, crowd.read(Field.FLAGS))

    def test_the_lectures_steps(self):
        entities, closing_error = swivel.steps((1.1, 1.1, 1.1), (1.1, 1.1, 0), 1.4, 1.3)
        of = {each.name: each for each in entities}
        self.assertEqual(len(of), len(entities))
        self.assertLess(closing_error, 1e-14)
        blades = [swivel.blade_name(n) for n in range(32)]
        elbow = [of["p_e"].coefficients[blades.index(blade)] for blade in ("e1", "e2", "e3")]
        np.testing.assert_allclose(elbow, (0.980883, 0.980883, -0.189039), atol=1e-6)
        self.assertIn("step 1", repr(of["S1"]))
        self.assertIn("sphere", of["S1"].meaning)
        for wrong in (lambda: swivel.steps((9, 0, 0), (0, 1, 0), 1, 1), lambda: swivel.steps((1, 0), (0, 1, 0), 1, 1),
                      lambda: swivel.blade_name(32), lambda: swivel.blade_name(-1)):
            self.assertRaises(ValueError, wrong)
        for shape in ((2,), (1, 3), (4, 3), ()):  # it takes one arm
            with self.assertRaises(ValueError) as refused:
                swivel.steps(np.ones(shape), (0, 1, 0), 1, 1)
            self.assertEqual(str(refused.exception), f"target: expected shape (3,), got {shape}")

    def test_the_library_checks_itself(self):
        passed, checks = swivel.verify(arm_count=200, seed=3)
        self.assertTrue(passed)
        self.assertTrue(all(0 <= check.max <= check.max_limit and check.name and check.set for check in checks))


if __name__ == "__main__":
    unittest.main()
