# SPDX-License-Identifier: MIT
"""The promise: poses of bodies go in and come out as NumPy arrays. Strided arrays are solved where they lie, and mistakes are told. Feet stand on
ground that is given a frame late. What other solves do is in test_scenes."""
import unittest

import numpy as np

import swivel
from figures import LIMBS, PLACES, Bodies, Refusals, crowd_of, flags_of
from swivel import Feature, Field, Flag, Pose

N = 50


class Solved(unittest.TestCase):
    def setUp(self):
        self.bodies = Bodies(N)

    def solved(self, features=Feature.WITH_HAND, **arrays):
        crowd = crowd_of(N, features)
        self.assertEqual(crowd.solve(streams=self.bodies.goals(), pose=Pose(**arrays)), N)
        self.assertFalse(np.any(flags_of(crowd) & Flag.BAD_INPUT))

    def test_what_is_left_out_rests(self):
        """Of the translations, scales and roots, and so is one value for all bodies."""
        given, ones = self.bodies.rotations, np.ones((8, 3))
        whole, short, out = given.copy(), given.copy(), np.zeros((N, 8, 4), np.float32)
        targets = [{"target": self.bodies.places[:, wrist] - self.bodies.root_position} for _, _, wrist in LIMBS]
        for rotations, members in ((whole, {}), (short, dict(translations=PLACES.tolist(), scales=ones, root_position=(0, 0, 0),
                                                             root_rotation=(0, 0, 0, 1), root_scale=1))):
            crowd_of(N, Feature.POLE_INCOMING).solve(streams=targets, pose=Pose(rotations, **members))
        np.testing.assert_array_equal(short, whole)
        crowd_of(N, Feature.POLE_INCOMING).solve(streams=targets, pose=Pose(given[0].tolist(), out=out))
        same = np.tile(given[0], (N, 1, 1))
        crowd_of(N, Feature.POLE_INCOMING).solve(streams=targets, pose=Pose(same))
        written = [joint for limb in LIMBS for joint in limb[:2]]  # no hands, so no wrists
        np.testing.assert_array_equal(out[:, written], same[:, written])
        self.assertFalse(np.any(np.delete(out, written, axis=1)))

    def test_strided_arrays_are_solved_where_they_lie(self):
        wanted = self.bodies.rotations.copy()
        self.solved(rotations=wanted, **self.bodies.members())
        random = np.random.default_rng(3)
        memory = random.integers(0, 256, (2 * N, 11, 40), np.uint8)
        views = [memory[::2, 2:10, 8:24].view(np.float32), memory[1::2, 1:9, 20:36].view(np.float32)]
        rotations, out = views
        rotations[:] = out[:] = self.bodies.rotations
        characters = np.zeros(N, [("name", "u1"), ("root", "f4", 3), ("pose", [("q", "f4", 4), ("t", "f4", 3)], 8)])
        characters["pose"]["q"], characters["pose"]["t"] = self.bodies.rotations, self.bodies.translations
        characters["root"] = self.bodies.root_position
        before = memory.copy()
        self.solved(rotations=rotations, out=out, **self.bodies.members())
        self.solved(rotations=rotations, **self.bodies.members())
        by_joint = np.ascontiguousarray(np.swapaxes(self.bodies.rotations, 0, 1)).swapaxes(0, 1)  # joints outside, bodies inside
        self.solved(rotations=by_joint, **self.bodies.members())
        self.solved(rotations=characters["pose"]["q"], **{**self.bodies.members(), "translations": characters["pose"]["t"],
                                                         "root_position": characters["root"]})
        for each in (rotations, out, by_joint, characters["pose"]["q"]):
            np.testing.assert_array_equal(each, wanted)
        for view in views:
            view[:] = self.bodies.rotations
        np.testing.assert_array_equal(memory, before)


class Ground(unittest.TestCase):
    def test_feet_stand_on_it_below_the_last_solves_probes(self):
        toe, features = np.array((0, -0.06, 0.12)), Feature.POLE_INCOMING | Feature.WITH_HAND | Feature.WITH_EFFECTOR | Feature.WITH_PLANT
        skeleton = swivel.Skeleton(parents=[-1, 0, 1, 2], translations=[(0, 0.93, 0), (0.1, 0, 0), (0, -0.45, 0), (0, -0.42, 0)])
        foot = swivel.BodyGroup(1, 2, 3, bend=(0, 0, -1), ground=swivel.Ground(heel=(0, -0.06, -0.06)))
        crowd = swivel.Crowd([foot], features | Feature.WITH_GROUND | Feature.WITH_HAND_TRANSFORM, skeleton=skeleton, body_count=N)
        crowd.write(Field.EFFECTOR, toe)
        roots, probes, feet = (np.zeros((N, count), np.float32) for count in (3, 3, 7))
        ground = np.full((N, 3), np.nan, np.float32)
        for frame in range(60):
            roots[:, 2] = 0.1 * np.arange(N) + 0.02 * min(frame, 30)
            roots[:, 1] = 0.2 * roots[:, 2]
            pose = Pose(np.tile(np.float32((0, 0, 0, 1)), (N, 4, 1)), root_position=roots, time=1 / 60)
            streams = {"contact": frame >= 30, "ground": ground, "ground_normal": (0, 1, -0.2), "probe": probes, "hand_transform": feet}
            self.assertEqual(crowd.solve(pose=pose, streams=streams), N)
            once = np.cross(feet[:, 3:6], toe)
            toes = feet[:, :3] + toe + 2 * (feet[:, 6:] * once + np.cross(feet[:, 3:6], once))
            # On a slope that begins 0.1 above the root; no ground is known in the first frame.
            np.testing.assert_allclose(toes[:, 1] - 0.2 * toes[:, 2], 0.1 if frame else -0.024, atol=1e-5)
            np.testing.assert_allclose(toes[:, ::2], probes[:, ::2], atol=1e-5)
            ground[:] = probes
            ground[:, 1] = 0.1 + 0.2 * probes[:, 2]
        self.assertTrue(np.all(crowd.read(Field.FLAGS) & Flag.PLANTED))


class State(Refusals):
    def setUp(self):
        self.bodies = Bodies(N)

    def play(self, crowd, frame):
        rotations, contact = self.bodies.rotations.copy(), np.float32((np.arange(N) + frame) % 5 < 3)
        members = {**self.bodies.members(), "root_position": self.bodies.root_position + np.float32((0, 0, 0.01 * frame))}
        crowd.solve(streams=[{"contact": contact}] * 2, pose=Pose(rotations, time=1 / 60, **members))
        return rotations

    def test_frames_are_played_again_from_what_was_saved(self):
        crowd, other = (crowd_of(N, Feature.WITH_PLANT | Feature.POLE_INCOMING) for _ in range(2))
        for frame in range(10):
            self.play(crowd, frame)
        state, digest = crowd.save(), crowd.state_digest()
        wanted = [self.play(crowd, frame) for frame in range(10, 20)]
        self.assertNotEqual(crowd.state_digest(), digest)
        for each in (crowd, other):
            each.load(state)
            self.assertEqual((each.save(), each.state_digest()), (state, digest))
            np.testing.assert_array_equal([self.play(each, frame) for frame in range(10, 20)], wanted)

        size, later = len(state) // N, crowd.save()
        crowd.load(state[:3 * size], first=7, count=3)
        crowd.reset_bodies(first=8, count=1)
        self.assertEqual(crowd.save(first=7, count=1) + crowd.save(9, 1), state[:size] + state[2 * size:3 * size])
        self.assertEqual(crowd.save(8, 1)[4:], bytes(size - 4))
        self.assertEqual(crowd.save(0, 7) + crowd.save(10), later[:7 * size] + later[10 * size:])
        self.refuses(ValueError, f"state: expected {size} bytes for 1 bodies, got {size - 1}", crowd.load, state[1:size], 3, 1)
        self.refuses(ValueError, "state 0 is of another kind of crowd", crowd.load, bytes(len(state)))
        self.refuses(ValueError, "group 1 has 3 limbs, group 0 has 2", swivel.Crowd([swivel.Group(2), swivel.Group(3)]).save, 0, 1)


class Compared(unittest.TestCase):
    def setUp(self):
        self.bodies, self.crowd = Bodies(N), crowd_of(N, Feature.POLE_INCOMING)

    def compared(self, rotations, group, body, scale=1):
        joints = dict(zip(("shoulder", "elbow", "wrist"), LIMBS[group]))
        places = {name: scale * self.bodies.at(self.bodies.rotations)[0][body, joint] for name, joint in joints.items()}
        return self.crowd.compare(Pose(rotations, **self.bodies.members()), body=body, group=group, **places)

    def test_what_disagrees_is_named(self):
        right = self.bodies.rotations
        for group in (0, 1):
            body = max(body for body in range(N) if self.compared(right, group, body)[0])  # others are bent to the other side
            text = self.compared(right, group, body)[1]
            self.assertRegex(text, "^The pose agrees")
            for rotations, scale, cause in ((np.roll(right, 1, axis=-1), 1, "joint rotations are stored as w, x, y, z"),
                                            (right * np.float32([-1, -1, -1, 1]), 1, "joint rotations are the inverse ones"),
                                            (right, 100, "centimetres instead of metres")):
                agrees, text = self.compared(rotations, group, body, scale)
                self.assertFalse(agrees)
                self.assertIn(cause, text)

    def test_mistakes(self):
        places = dict(shoulder=(0, 0, 0), elbow=(0, 0, 1), wrist=(0, 1, 1))
        pose = Pose(self.bodies.rotations)
        for given, error in ((dict(body=N), ValueError), (dict(group=2), ValueError), (dict(wrist=(1, 2)), ValueError),
                             (dict(elbow=(0, np.nan, 0)), ValueError), (dict(pose=None), TypeError)):
            with self.assertRaises(error):
                self.crowd.compare(**{"pose": pose, "body": 0, **places, **given})


class Mistakes(Refusals):
    def solve_fails(self, error, text, *arguments, streams=None, **keywords):
        self.refuses(error, text, crowd_of(2).solve, streams=streams, pose=Pose(*arguments, **keywords))

    def test_poses(self):
        good, matrices = np.zeros((2, 8, 4), np.float32), np.zeros((2, 8, 4, 4), np.float32)
        frozen = good.copy()
        frozen.setflags(write=False)
        fails = self.solve_fails
        fails(ValueError, "rotations: expected shape (2, 8, 4), got (3, 8, 4)", np.zeros((3, 8, 4), np.float32))
        fails(ValueError, "out: expected shape (2, 8, 4), got (8, 4)", good, out=good[0])
        fails(ValueError, "rotations: expected shape (2, 8, 4), or (8, 4) for all bodies, got (2, 4)", good[:, 0], out=good)
        fails(TypeError, "rotations: expected dtype float32, got float64", good.astype(float))
        fails(TypeError, "rotations: expected an array to write to, got list", good.tolist())
        fails(ValueError, "rotations: the array is read-only", frozen)
        side_by_side = "the numbers of a value must lie side by side, and joints and bodies apart; give an array that numpy.asc"
        for wrong in (np.zeros((2, 8, 8), np.float32)[..., ::2], good[::-1], np.asfortranarray(good),
                      np.lib.stride_tricks.as_strided(good, strides=(0, 16, 4))):
            fails(ValueError, "rotations: " + side_by_side, wrong)
            fails(ValueError, "out: " + side_by_side, good, out=wrong)
        fails(ValueError, "matrices: " + side_by_side, matrices=np.zeros((2, 8, 3, 5), np.float32)[..., :4])
        fails(ValueError, "matrices: expected shape (2, 8, 4, 4), got (2, 8, 5, 4)", matrices=np.zeros((2, 8, 5, 4), np.float32))
        fails(ValueError, "out: its matrices lie in another order", matrices=matrices, out=np.swapaxes(matrices.copy(), 2, 3))
        fails(ValueError, "the pose has no rotations and matrices; give one of the two")
        fails(ValueError, "the pose has both rotations and matrices; give one of the two", good, matrices)
        fails(ValueError, "the pose has matrices and scales, which matrices hold", matrices=matrices, scales=np.ones((8, 3)))
        fails(ValueError, "scales: expected shape (2, 8, 3), or (8, 3) for all bodies, got (3,)", good, scales=(1, 1, 1))
        fails(ValueError, "root_rotation: expected shape (2, 4), or (4,) for all bodies, got (4, 4)", good, root_rotation=np.eye(4))
        fails(ValueError, "root_position is float64, so targets are, too", good, root_position=np.zeros(3))
        fails(ValueError, "a body's origin is its root in doubles", good, streams=[{"origin": (0, 0, 0)}, {}])

    def test_spaces_and_outputs(self):
        good, places, space = np.zeros((2, 8, 4), np.float32), np.zeros((2, 8, 3), np.float32), swivel.PoseSpace.IN_BODY
        fails = self.solve_fails
        fails(ValueError, "there is no space of poses 2; give a member of swivel.PoseSpace", good, space=2)
        fails(TypeError, "space: expected a member of swivel.PoseSpace, got 'LOCAL'", good, space="LOCAL")
        fails(TypeError, "translations: expected an array to write to, got list", good, space=space, translations=places.tolist())
        fails(ValueError, "the pose has out_translations, but only translations in the body's space change", good, out_translations=places)
        fails(ValueError, "the pose has out, but no out_translations, and", good, space=space, translations=places, out=good.copy())
        fails(ValueError, "joint_positions: expected shape (2, 8, 3), got (2, 8, 4)", good, joint_positions=good.copy())
        fails(TypeError, "joint_rotations: expected an array to write to, got bool", good, joint_rotations=True)

    def test_crowds(self):
        crowd = crowd_of(2)
        self.refuses(TypeError, "pose: expected a Pose, got ndarray", crowd.solve, pose=np.zeros((2, 8, 4), np.float32))
        self.refuses(ValueError, "give the job their pose", crowd.solve)
        self.refuses(ValueError, "this crowd has no bodies, so it takes no pose", swivel.Crowd(2).solve, pose=Pose())
        self.refuses(ValueError, "priorities: expected one entry for the bodies, got 2", crowd.choose, [1, 1], 1)


class Drawn(Refusals):
    def test_lines_of_a_body(self):
        crowd, pose = crowd_of(2, Feature.POLE_INCOMING | Feature.WITH_RECORD), Pose(np.tile(np.float32((0, 0, 0, 1)), (2, 8, 1)))
        self.refuses(ValueError, "draw: pose is null; give the one of the last solve", crowd.draw, limb=0)
        crowd.solve(streams=[{"target": np.tile(np.float32(target), (2, 1))} for target in ((0.6, 1.4, 0.2), (0.1, 0.2, 0.1))], pose=pose)
        names, lines, colors = crowd.draw(limb=1, pose=pose)
        self.assertEqual((lines.shape, colors.shape), ((len(names), 2, 3), (len(names), 4)))
        self.assertEqual(set(names), {"axis_x", "axis_y", "axis_z", "bone", "incoming", "bend", "target", "miss"})
        ends = np.array([line[1] for name, line in zip(names, lines) if name == "bone"])
        for group in range(2):
            self.assertLess(np.min(np.linalg.norm(ends - crowd.wrists(group)[1], axis=1)), 1e-5)
        self.assertEqual(colors[names.index("target")].tolist(), [255, 255, 0, 255])
        self.assertEqual(crowd.draw(limb=1, group=0, pose=pose)[0].count("target"), 1)

    def test_lines_of_an_arm(self):
        arm = swivel.Crowd(1)
        arm.write(Field.TARGET, (0.3, 0.1, 1)), arm.write(Field.LENGTHS, (1, 1))
        arm.solve()
        names, lines, _ = arm.draw(limb=0)
        self.assertEqual(names, ["target", "bone", "bone", "miss", "pole"])
        np.testing.assert_array_equal(lines[0], np.tile(np.float32((0.3, 0.1, 1)), (2, 1)))
        self.refuses(ValueError, "this crowd has no bodies, so it has no pose", arm.draw, limb=0, pose=Pose())


if __name__ == "__main__":
    unittest.main()
