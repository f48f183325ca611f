# SPDX-License-Identifier: MIT
"""The promise: any layout of numbers goes in and comes out right, what lies well is not copied, views keep their crowd alive, and
mistakes are told with name, expected and given."""
import resource
import unittest
import weakref

import numpy as np

import swivel
from figures import Refusals, Sample
from swivel import Feature, Field

N = 100


class Copies(unittest.TestCase):
    def setUp(self):
        self.crowd = swivel.Crowd(N, Feature.WORLD)
        self.values = Sample(N).targets

    def check_written(self, given, wanted=None):
        self.crowd.write(Field.TARGET, np.zeros(3))
        self.crowd.write(Field.TARGET, given)
        np.testing.assert_array_equal(self.crowd.read(Field.TARGET), self.values if wanted is None else wanted)

    def test_every_layout_goes_in(self):
        values = self.values
        wide = np.full((2 * N, 7), 9, np.float32)
        wide[::2, 2:5] = values
        records = np.zeros(N, [("id", "u1"), ("place", "f4", 3), ("rest", "f8")])
        records["place"] = values
        frozen = values.copy()
        frozen.setflags(write=False)
        for given in (values, wide[::2, 2:5], records["place"], frozen, np.asfortranarray(values), values[::-1].copy()[::-1],
                      values[:, ::-1].copy()[:, ::-1],
                      values.astype(">f4"), values.astype(np.float64), values.tolist(), np.ma.array(values)):
            self.check_written(given)
        window = np.lib.stride_tricks.sliding_window_view(np.arange(N + 2, dtype=np.float32), 3)  # values within each other
        self.check_written(window, window)
        whole = np.arange(3 * N).reshape(N, 3) % 7
        for dtype in (np.int8, np.int64, np.uint16, np.float16, bool):
            self.check_written(whole.astype(dtype), whole.astype(dtype).astype(np.float32))

    def test_one_value_for_all(self):
        for one in ((1, 2, 3), np.float32([1, 2, 3]), np.broadcast_to(np.float32([1, 2, 3]), (N, 3))):
            self.check_written(one, np.tile(np.float32([1, 2, 3]), (N, 1)))
        self.crowd.write(Field.PARENT_SCALE, self.values[:, 1])
        np.testing.assert_array_equal(self.crowd.read(Field.PARENT_SCALE), self.values[:, 1])
        self.crowd.write(Field.PARENT_SCALE, 2.5)
        np.testing.assert_array_equal(self.crowd.read(Field.PARENT_SCALE), np.full(N, 2.5))

    def test_parts_of_groups(self):
        crowd = swivel.Crowd([20, N])
        crowd.write(Field.TARGET, self.values[:7], group=1, first=3, count=7)
        crowd.write(Field.TARGET, (5, 5, 5), group=1, first=N - 2)
        np.testing.assert_array_equal(crowd.read(Field.TARGET, 1, 3, 7), self.values[:7])
        np.testing.assert_array_equal(crowd.read(Field.TARGET, 1, 10, N - 12), np.full((N - 12, 3), np.nan))
        np.testing.assert_array_equal(crowd.read(Field.TARGET, 1, N - 2), np.full((2, 3), 5))
        np.testing.assert_array_equal(crowd.read(Field.TARGET), np.full((20, 3), np.nan))
        self.assertEqual(crowd.read(Field.TARGET, 1, N).shape, (0, 3))
        self.assertEqual((crowd.group_count, crowd.limb_count(1), crowd.block_count, crowd.lane_count), (2, N, 9, 144))
        self.assertEqual(crowd.limbs(1), range(32, 32 + N))

    def test_every_layout_comes_out(self):
        self.crowd.write(Field.TARGET, self.values)
        wide = np.full((2 * N, 7), 9, np.float32)
        for out in (np.zeros((N, 3), np.float32), wide[::2, 2:5], np.zeros((3, N), np.float32).T,
                    np.zeros((N, 3), np.float32)[::-1]):
            self.assertIs(self.crowd.read(Field.TARGET, out=out), out)
            np.testing.assert_array_equal(out, self.values)
        np.testing.assert_array_equal(wide[1::2], 9)
        np.testing.assert_array_equal(wide[:, [0, 1, 5, 6]], 9)
        far = np.zeros((N, 6))[:, ::2]
        self.assertIs(self.crowd.wrists(out=far), far)
        np.testing.assert_array_equal(far, self.crowd.wrists())

    def test_poses_in_place(self):
        pose = np.zeros(N, [("shoulder", "f4", 4), ("pad", "u1"), ("elbow", "f4", 2), ("flags", "u4"), ("goal", "f8", 3)])
        pose["goal"] = self.values + 1e6
        crowd = swivel.Crowd(N)
        crowd.solve(streams={"target": pose["goal"], "origin": (1e6, 1e6, 1e6), "shoulder": pose["shoulder"], "elbow": pose["elbow"],
                           "flags": pose["flags"]})
        for field in ("shoulder", "elbow", "flags"):
            np.testing.assert_array_equal(pose[field], crowd.read(Field[field.upper()]))
        self.assertTrue(np.any(pose["shoulder"] != 0) and not np.any(pose["pad"]))
        split = np.zeros((4, N), np.float32)
        crowd.solve(streams=[{"shoulder": split.T}])
        np.testing.assert_array_equal(split.T, pose["shoulder"])


class Rows(unittest.TestCase):
    def test_rows_are_the_crowds_memory(self):
        crowd, sample = swivel.Crowd(N), Sample(N)
        lanes = np.arange(N)
        crowd.rows(Field.TARGET)[lanes // 16, :, lanes % 16] = sample.targets
        np.testing.assert_array_equal(crowd.read(Field.TARGET), sample.targets)
        shoulder, flags = crowd.rows(Field.SHOULDER), crowd.rows(Field.FLAGS)
        self.assertFalse(np.any(flags))
        crowd.solve()
        np.testing.assert_array_equal(shoulder[lanes // 16, :, lanes % 16], crowd.read(Field.SHOULDER))
        np.testing.assert_array_equal(flags[lanes // 16, 0, lanes % 16], crowd.read(Field.FLAGS))
        with self.assertRaisesRegex(ValueError, "read-only"):
            shoulder[0] = 1

    def test_crowds_are_freed(self):
        class Traced(swivel.Crowd):
            pass
        crowd = Traced(N)
        rows, gone = crowd.rows(Field.TARGET), weakref.ref(crowd)
        del crowd
        self.assertIsNotNone(gone())
        del rows
        self.assertIsNone(gone())

    def test_own_rows_as_arguments(self):
        crowd = swivel.Crowd(16, Feature.WORLD)
        crowd.rows(Field.PARENT_SCALE)[0, 0] = np.arange(16)
        crowd.write(Field.PARENT_SCALE, crowd.rows(Field.PARENT_SCALE)[0, 0])
        np.testing.assert_array_equal(crowd.read(Field.PARENT_SCALE), np.arange(16))
        with self.assertRaisesRegex(ValueError, "parent_scale: the array is the crowd's own rows"):
            crowd.read(Field.PARENT_SCALE, out=crowd.rows(Field.PARENT_SCALE)[0, 0])


class Mistakes(Refusals):
    def test_shapes_and_types(self):
        crowd = swivel.Crowd(N, Feature.WORLD)
        write, read = crowd.write, crowd.read
        self.refuses(ValueError, "target: expected shape (100, 3), or (3,) for all limbs, got (99, 3)", write, Field.TARGET,
                   np.zeros((99, 3)))
        self.refuses(ValueError, "parent_scale: expected shape (100,), or () for all limbs, got (100, 1)", write, Field.PARENT_SCALE,
                   np.zeros((N, 1)))
        self.refuses(ValueError, "target: not an array of numbers", write, Field.TARGET, [[1, 2], [3]])
        self.refuses(TypeError, "target: expected numbers that can become float32, got dtype complex64", write, Field.TARGET,
                   np.zeros((N, 3), np.complex64))
        self.refuses(TypeError, "got dtype <U1", write, Field.TARGET, ("a", "b", "c"))
        self.refuses(ValueError, "shoulder: expected shape (100, 4), got (100, 3)", read, Field.SHOULDER,
                   out=np.zeros((N, 3), np.float32))
        self.refuses(TypeError, "shoulder: expected dtype float32, got float64", read, Field.SHOULDER, out=np.zeros((N, 4)))
        self.refuses(TypeError, "shoulder: expected an array to write to, got list", read, Field.SHOULDER, out=[])
        frozen = np.zeros((N, 4), np.float32)
        frozen.setflags(write=False)
        self.refuses(ValueError, "shoulder: the array is read-only", read, Field.SHOULDER, out=frozen)
        self.refuses(ValueError, "out: expected shape (100, 3), got (3,)", crowd.wrists, out=np.zeros(3))
        self.refuses(ValueError, "origins: expected shape (100, 3), or (3,) for all limbs, got (2,)", crowd.write_doubles,
                   Field.TARGET, np.zeros(3), (1, 2))
        self.refuses(ValueError, "mask: expected shape (112,), one for each lane, got (100,)", crowd.solve, mask=np.ones(N, bool))
        self.refuses(TypeError, "mask: expected an array of bool", crowd.solve, mask=np.ones(112))
        self.refuses(ValueError, "pole: expected shape (5, 3)", swivel.solve, np.zeros((5, 3)), np.zeros((4, 3)), (1, 1))

    def test_the_librarys_own_words(self):
        crowd = swivel.Crowd(N)
        self.refuses(ValueError, "shoulder is a result; write takes inputs and what is carried", crowd.write, Field.SHOULDER, 0)
        self.refuses(ValueError, "group 0, hand: not part of this group; create it with Feature.WITH_HAND", crowd.read, Field.HAND)
        self.refuses(ValueError, "no instruction set 'mmx'", swivel.use_isa, "mmx")
        for name, runs in swivel.isas():
            if not runs:
                self.refuses(RuntimeError, name, swivel.use_isa, name)

    def test_names_and_numbers(self):
        crowd = swivel.Crowd(N)
        self.refuses(ValueError, "there is no field 99", crowd.read, 99)
        self.refuses(ValueError, "there is no order of axes 6", swivel.Crowd, 1, 0, 6)
        self.refuses(ValueError, "group is -1", crowd.read, Field.TARGET, -1)
        self.refuses(TypeError, "expected a number of limbs, (number of limbs, binding) or a Group, got 'x'", swivel.Crowd, ["x"])
        for wrong in ((1, 2), (None, None), (), (1, None, "WORLD"), (1, None, 0, 0, 0, 0, None, 0, None, 0)):
            self.refuses(TypeError, "expected a number of limbs, (number of limbs, binding) or a Group, got (", swivel.Crowd, [wrong])
        self.refuses(ValueError, "there is no way to treat bad input 2; give a member of swivel.OnBadInput", swivel.Crowd, 1, on_bad_input=2)
        self.refuses(ValueError, "features is -1", swivel.Crowd, [swivel.Group(1, features=-1)])
        self.refuses(ValueError, "streams of group 0: there is no key 'tagret'; there are origin, target,", crowd.solve,
                   streams={"tagret": 0})
        self.refuses(ValueError, "streams: expected one for each of 1 groups, got 2", crowd.solve, streams=[{}, {}])
        self.refuses(ValueError, "priorities: expected one entry for each of 1 groups, got 2", crowd.choose, [1, 1], 1)
        self.refuses(ValueError, "max_blocks is -1", crowd.choose, [1], -1)
        self.refuses(ValueError, "urgency: expected shape (7,), got (6,)", crowd.choose, [1], 1, np.zeros(6, np.float32))
        self.refuses(TypeError, "urgency: expected dtype float32, got float64", crowd.choose, [1], 1, np.zeros(7))
        self.refuses(ValueError, "urgency: its numbers must lie side by side", crowd.choose, [1], 1, np.zeros(14, np.float32)[::2])
        self.refuses(ValueError, "urgency: its numbers must lie side by side, and aligned", crowd.choose, [1], 1,
                   np.zeros(29, np.uint8)[1:].view(np.float32))
        self.refuses(ValueError, "group 1 does not exist; this crowd has 1", crowd.solve, groups=[1])
        self.refuses(ValueError, "group 0 is named twice", crowd.solve, groups=[0, 0])
        self.refuses(ValueError, "streams: expected one for each of 0 groups, got 1", crowd.solve, groups=[], streams={})
        self.refuses(ValueError, "numbers of a value side by side", crowd.solve, blocks=(0, 1),
                   streams={"shoulder": np.zeros((4, N), np.float32).T})
        self.refuses(ValueError, "give shoulder_position=", swivel.solve, (0, 0, 1), None, (1, 1), parent_rotation=(0, 0, 0, 1))
        self.refuses(ValueError, "give lengths= or binding=", swivel.solve, (0, 0, 1), None)
        self.refuses(TypeError, "unexpected keyword argument 'hond'", swivel.solve, (0, 0, 1), None, (1, 1), hond=1)

    def test_memory(self):
        before = resource.getrlimit(resource.RLIMIT_AS)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_AS, before)
        resource.setrlimit(resource.RLIMIT_AS, (16 << 30, before[1]))  # the crowd takes 120 GB
        self.refuses(MemoryError, "bytes", swivel.Crowd, 2**31 - 64)


if __name__ == "__main__":
    unittest.main()
