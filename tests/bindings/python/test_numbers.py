# SPDX-License-Identifier: MIT
"""The promise: what comes back is the same bits by every way to solve, and things say what they are."""
import unittest

import numpy as np

import swivel
from figures import Refusals, Sample, limb_of, quaternions
from swivel import Feature, Field, Flag

N = 1000


def crowd_of(sample, features=0, groups=None):
    crowd = swivel.Crowd(groups or len(sample.targets), features)
    crowd.write(Field.TARGET, sample.targets)
    crowd.write(Field.POLE, sample.poles)
    crowd.write(Field.LENGTHS, sample.lengths)
    return crowd


class Calls(Refusals):
    def test_one_call_gives_what_a_crowd_gives(self):
        """With every argument, in the world and with hands."""
        sample, random = Sample(N), np.random.default_rng(2)
        world = {"shoulder_position": random.normal(size=(N, 3)).astype(np.float32), "parent_rotation": quaternions(random, N),
                 "parent_scale": random.uniform(0.5, 2, N).astype(np.float32)}
        for given in ({}, {"hand": quaternions(random, N)}, world, {**world, "hand": quaternions(random, N)}):
            arms = swivel.solve(sample.targets, sample.poles, sample.lengths, **given)
            crowd = crowd_of(sample, Feature.WITH_HAND * ("hand" in given) | Feature.WORLD * ("parent_scale" in given))
            for name, values in given.items():
                crowd.write(Field[name.upper()], values)
            crowd.solve()
            for name, values in (("shoulder", crowd.read(Field.SHOULDER)), ("elbow", crowd.read(Field.ELBOW)), ("flags", crowd.read(Field.FLAGS)),
                                 ("wrist_position", crowd.wrists()), ("residual", crowd.residuals()), ("wrist", crowd.read(Field.WRIST) if "hand" in given else None)):
                np.testing.assert_array_equal(getattr(arms, name), values, name)

    def test_a_binding_is_that_of_its_joints(self):
        """In any order, and it may be kept and restored."""
        places, rest, bend = [(0, 0, 0), (0.3, 0, 0), (0.25, 0.1, 0)], quaternions(np.random.default_rng(5), 3), (0, 0, 1)
        bound = swivel.bind_joints([-1, 0, 1], places, 0, 1, 2, rotations=rest, bend=bend)
        self.assertEqual(repr(swivel.bind_joints([1, 2, -1], places[::-1], 2, 1, 0, rotations=rest[::-1], bend=bend)), repr(bound))
        np.testing.assert_allclose([abs(np.sum(turn * getattr(bound, name))) for turn, name in zip(rest, ("shoulder_rest", "elbow_rest", "wrist_rest"))],
                                   np.linalg.norm(rest, axis=1), rtol=1e-6)
        np.testing.assert_allclose(bound.lengths, np.linalg.norm(places[1:], axis=1), rtol=1e-6)
        self.assertEqual(repr(swivel.Binding(**{name: getattr(bound, name) for name in dir(swivel.Binding) if name[0] != "_"})), repr(bound))
        self.assertEqual(swivel.bind_joints([-1, 0, 1, 1], [*places, (0.1, 0, 0)], 0, 1, 2, twist_bones=[3]).twist_from_arm.shape, (1, 4))
        self.refuses(ValueError, "bind_joints: the elbow, joint 0, is not below the shoulder, joint 1", swivel.bind_joints, [-1, 0, 1], places, 1, 0, 2)
        self.refuses(ValueError, "translations: expected shape (3, 3)", swivel.bind_joints, [-1, 0, 1], places[1:], 0, 1, 2)

    def test_no_arms_give_no_arms(self):
        none = swivel.solve(np.empty((0, 3)), None, (0.3, 0.26), hand=np.empty((0, 4)))
        for name, shape in (("shoulder", (0, 4)), ("elbow", (0, 2)), ("wrist", (0, 4)), ("flags", (0,)), ("wrist_position", (0, 3)),
                            ("residual", (0,))):
            self.assertEqual(getattr(none, name).shape, shape)

    def test_things_say_what_they_are(self):
        binding = limb_of((0.5, 0, 0), (0.25, 0, 0))
        np.testing.assert_array_equal(eval(repr(binding), {"Binding": swivel.Binding}).upper_from_arm, binding.upper_from_arm)
        self.assertIn("lengths=[0.5, 0.25]", repr(binding))
        self.assertIn("<Crowd of [5, 40] limbs", repr(swivel.Crowd([5, 40], Feature.WORLD)))
        self.assertIn("WORLD", repr(swivel.Crowd([5, 40], Feature.WORLD)))


class Groups(unittest.TestCase):
    def setUp(self):
        self.sample = Sample(40)

    def test_frames_are_those_of_the_groups_as_named(self):
        """Groups have fields and rows of their own, and what a group does not say is the crowd's."""
        limb = limb_of((0.3, 0, 0), (0.25, 0, 0))
        bound = swivel.Group(20, limb, Feature.WORLD | Feature.JOINTS | Feature.WITH_HAND)
        crowd = swivel.Crowd([swivel.Group(40), bound, swivel.Group(5, features=0), (6, limb)], Feature.WITH_SHOULDER_CONE)
        self.assertEqual([crowd.features(group) for group in range(4)], [Feature.WITH_SHOULDER_CONE, bound.features, 0, Feature.WITH_SHOULDER_CONE])
        hands = quaternions(np.random.default_rng(6), 20)
        for field, of_plain, of_bound in ((Field.TARGET, self.sample.targets, self.sample.targets[:20]), (Field.POLE, self.sample.poles, self.sample.poles[:20]),
                                          (Field.LENGTHS, self.sample.lengths, None), (Field.SHOULDER_CONE, swivel.cone((0, 1, 1), 1.0), None),
                                          (Field.HAND, None, hands), (Field.SHOULDER_POSITION, None, (0, 0, 0))):
            for group, values in enumerate((of_plain, of_bound)):
                self.assertEqual(crowd.component_count(field, group) > 0, values is not None or field == Field.LENGTHS)
                if values is not None:
                    crowd.write(field, values, group)
        self.assertEqual(crowd.solve(groups=[0, 1]), 60)
        wanted = [{name: crowd.read(Field[name.upper()], group) for name in ("shoulder", "elbow")} for group in (0, 1)]
        self.assertEqual([each["elbow"].shape for each in wanted], [(40, 2), (20, 4)])
        for group, count in ((0, 40), (1, 20)):
            limbs = np.arange(count)
            np.testing.assert_array_equal(crowd.rows(Field.ELBOW, group)[limbs // 16, :, limbs % 16], wanted[group]["elbow"])
            self.assertEqual(crowd.rows(Field.ELBOW, group).shape[0], -(-count // 16))
        for groups in ([0, 1], [1, 0]):
            frames = [{name: np.zeros_like(values) for name, values in wanted[group].items()} for group in groups]
            frames[groups.index(1)]["hand"] = hands
            self.assertEqual(crowd.solve(groups=groups, streams=frames), 60)
            for group, frame in zip(groups, frames):
                for name, values in wanted[group].items():
                    np.testing.assert_array_equal(frame[name], values, name)
        crowd.solve(groups=[1], streams={"hand": hands})  # one group, one dict

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
            crowd.solve(streams=[{"target": targets, "shoulder": outs[0], "flags": flags}, {"target": targets, "shoulder": outs[1]}])
            np.testing.assert_array_equal(flags[bad], Flag.BAD_INPUT)
            np.testing.assert_array_equal(outs[0][bad], good[bad])
            np.testing.assert_array_equal(outs[1][bad], np.tile(np.float32((0, 0, 0, 1)), (bad.sum(), 1)))
            np.testing.assert_array_equal(outs[0][~bad], outs[1][~bad])
            self.assertTrue(np.any(outs[0][~bad] != good[~bad]))
            for group in (0, 1):
                np.testing.assert_array_equal(crowd.read(Field.SHOULDER, group), outs[group])

    def test_urgency_is_the_callers(self):
        crowd = swivel.Crowd([16, 16, 16])
        mine, others = np.zeros((2, 3), np.float32)
        picked = lambda mask: mask.reshape(3, 16)[:, 0].tolist()
        crowd.choose([2, 1, 1], 1, mine)
        self.assertTrue(np.any(mine) and not np.any(others))
        for _ in range(2):  # without: priorities alone
            self.assertEqual(picked(crowd.choose([1, 3, 1], 1)), [False, True, False])
        crowd.choose([1, 2, 4], 1, others)
        np.testing.assert_array_equal(abs(others), (1, 2, 0))
        self.assertEqual(crowd.solve(mask=crowd.choose([1, 1, 1], 1, others)), 16)
        np.testing.assert_array_equal(abs(others), (2, 0, 1))


class Bits(Refusals):
    def results(self, crowd):
        return b"".join(crowd.read(field).tobytes() for field in (Field.SHOULDER, Field.ELBOW, Field.FLAGS))

    def test_an_instruction_set_is_chosen(self):
        self.addCleanup(swivel.use_isa, swivel.isa_name())
        digests = set()
        for name in [name for name, runs in swivel.isas() if runs]:
            swivel.use_isa(name)
            self.assertEqual(swivel.isa_name(), name)
            crowd = crowd_of(Sample(N))
            crowd.solve()
            digests.add(crowd.digest())
        self.assertEqual(len(digests), 1)

    def test_every_way_to_solve_gives_the_same(self):
        sample = Sample(N)
        whole = crowd_of(sample)
        whole.solve()
        wanted, count = self.results(whole), whole.block_count
        even, urgency = np.zeros(whole.lane_count, bool), np.zeros(count, np.float32)
        even[whole.limbs()] = np.arange(N) % 2 == 0
        choose = lambda crowd: {"mask": crowd.choose([np.ones(N)], count // 4 + 1, urgency)}
        out, some = ({"shoulder": np.full((N, 4), 7, np.float32), "flags": np.full(N, 7, np.uint32)} for _ in range(2))
        inputs, here = {"target": sample.targets, "pole": sample.poles}, {"on_this_thread": True}
        ways = [  # jobs, and how many limbs each of them solves
            ([{"blocks": (block, 1), **here} for block in range(count)], [min(16, N - 16 * block) for block in range(count)]),
            ([{"mask": even}, {"blocks": (0, count), "mask": ~even, **here}], [N // 2, N // 2]),
            ([{"mask": np.zeros(whole.lane_count, bool)}, {"mask": np.ones(whole.lane_count, bool)}], [0, N]),  # padding, too
            ([{"streams": {**inputs, **out}}], [N]),
            ([{"streams": [inputs], "blocks": (first, 9), **here} for first in range(0, count, 9)], [9 * 16] * 6 + [N - 6 * 9 * 16]),
            ([{"mask": ~even, "streams": {"target": sample.targets, **some}}, {"mask": even}], [N // 2, N // 2]),
            ([choose] * 4, [16 * 16] * 3 + [N - 3 * 16 * 16 + 16]),
        ]
        for jobs, solved in ways:
            crowd = crowd_of(sample)
            self.assertEqual([crowd.solve(**(job(crowd) if callable(job) else job)) for job in jobs], solved)
            self.assertEqual(self.results(crowd), wanted)
        for name in out:
            np.testing.assert_array_equal(out[name], whole.read(Field[name.upper()]))
            np.testing.assert_array_equal(some[name][1::2], out[name][1::2])
            np.testing.assert_array_equal(some[name][::2], 7)

    def test_packed_words(self):
        crowd = crowd_of(Sample(N))
        crowd.solve()
        packed = crowd.pack()

        def words_of(field, count):
            first = crowd.packed_row(field)
            return np.moveaxis(packed[:, first:first + count], 1, 2).reshape(-1, count)[crowd.limbs()]
        unpacked = swivel.unpack_rotations(words_of(Field.SHOULDER, 3))
        np.testing.assert_allclose(abs(np.sum(unpacked * crowd.read(Field.SHOULDER), axis=1)), 1, atol=1e-6)
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
        self.assertAlmostEqual(of["p_e"].coefficients[blades.index("e3")], -0.189039, 6)
        self.assertIn("step 1", repr(of["S1"]))
        for wrong in (lambda: swivel.steps((9, 0, 0), (0, 1, 0), 1, 1), lambda: swivel.blade_name(32), lambda: swivel.blade_name(-1)):
            self.assertRaises(ValueError, wrong)
        for shape in ((2,), (1, 3)):  # it takes one arm
            self.refuses(ValueError, f"target: expected shape (3,), got {shape}", swivel.steps, np.ones(shape), (0, 1, 0), 1, 1)

    def test_the_library_checks_itself(self):
        passed, checks = swivel.verify(arm_count=200, seed=3)
        self.assertTrue(passed)
        self.assertIn("<Check production<float>, wrist to target, ", "".join(map(repr, checks)))
        self.assertTrue(all(0 <= check.max <= check.max_limit and check.name and check.set for check in checks))


if __name__ == "__main__":
    unittest.main()
