# SPDX-License-Identifier: MIT
"""The promise: the documentation's programs run as they stand there."""
import contextlib
import io
import re
import unittest
from pathlib import Path

import numpy as np

import swivel
from arms import joints_at, rotate, times
from bodies import angles, forward

ROOT = Path(__file__).resolve().parents[2]


class Documentation(unittest.TestCase):
    def test_programs_run(self):
        text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertEqual(len(programs), 14)
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for program in programs:
                exec(program, names)
        self.assertIn("['REACHED', 'CLAMPED_FAR']", printed.getvalue())
        _, wrists = joints_at(names["arms"].shoulder, names["arms"].elbow, np.array([0.30, 0.26]))
        np.testing.assert_allclose(wrists[0], names["targets"][0], atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(names["shoulder"], axis=1), 1, atol=1e-6)
        self.assertIsNotNone(names["limited"].wrist)
        for group, side in enumerate((1, -1)):  # a skeleton's own joints, from the shoulders on
            upper, fore = names["upper_arms"][group], names["forearms"][group]
            shoulders = names["stand"] + (0.2 * side, 1.4, 0)
            elbows = shoulders + rotate(upper, (0.30 * side, 0, 0))
            wrists = elbows + rotate(times(upper, fore), (0.26 * side, 0, 0))
            self.assertEqual(len(wrists), 1000)
            np.testing.assert_allclose(wrists, names["stand"] + (0.1 * side, 1.3, 0.35), atol=1e-4)  # floats a kilometre off
            self.assertTrue(np.all(elbows[:, 1] < 1.3))
            np.testing.assert_allclose(fore[:, (0, 2)], 0, atol=1e-6)  # about the hinge alone, and forwards
            self.assertTrue(np.all(rotate(fore, (side, 0, 0))[:, 2] > 0.1))
        self.assertEqual(names["characters"].find(swivel.Flag.BAD_INPUT), None)
        knees, ankles = names["characters"].elbows(1), names["characters"].wrists(1)
        np.testing.assert_allclose(ankles[:100], (names["hips"] - (0, 0.8, 0))[:100], atol=1e-4)
        self.assertTrue(np.all(knees[:100, 2] > 0.1))  # forwards
        np.testing.assert_allclose(names["arm"].lengths, (0.30, 0.26), rtol=1e-6)
        self.assertEqual(names["arm"].twist_from_arm.shape, (1, 4))

        self.assertTrue(np.all(names["planted"]))
        at, _ = forward(names["walk"], names["skeleton"].translations, root=names["drawn_at"], parents=names["skeleton"].parents)
        locked = names["saved"][0][:, :3]
        np.testing.assert_allclose(at[:, names["FOOT"]], locked, atol=2e-4)  # floats a kilometre off

        self.assertEqual(names["climbers"].find(swivel.Flag.BAD_INPUT), None)
        foot = forward(names["climb"].rotations, names["raised"].translations, root=names["stand"], parents=names["raised"].parents)
        for point in ((0, -0.06, 0.12), (0, -0.06, -0.06)):  # toe and heel are not below the ground
            at = foot[0][:, names["FOOT"]] + rotate(foot[1][:, names["FOOT"]], np.array(point))
            self.assertGreater(np.min(at[:, 1] - 0.2 * at[:, 2]), -1e-4)
        self.assertTrue(np.all(names["held"]))
        hands, turned = forward(names["aiming"], names["arms_alone"].translations, root=names["stand"], parents=names["arms_alone"].parents)
        for hand, x in ((names["LEFT_HAND"], 0.15), (names["RIGHT_HAND"], -0.1)):
            np.testing.assert_allclose(hands[:, hand], names["stand"] + (x, 1.2, 0.35), atol=1e-4)
            self.assertLess(angles(turned[:, hand], np.array((0, 0, 0, 1.0))).max(), 1e-4)
        np.testing.assert_allclose(names["rifles"][:, :3], names["stand"] + (0, 1.2, 0.35), atol=1e-4)

        self.assertTrue(np.all(names["seen"]))
        place, turned = forward(names["watching"], names["spine"].translations, root=names["level"], parents=names["spine"].parents)
        eye = place[:, 2] + rotate(turned[:, 2], np.array((0, 0.08, 0.1)))
        line, to = rotate(turned[:, 2], np.array((0, 0, 1.0))), names["level"] + (0.8, 1.7, 2.5) - eye
        self.assertLess((np.linalg.norm(np.cross(line, to), axis=1) / np.linalg.norm(to, axis=1)).max(), 2e-4)  # floats a kilometre off
        np.testing.assert_allclose(names["sight"][:, 3:], line, atol=1e-5)

    def test_the_program_of_bodies_runs(self):
        text = (ROOT / "docs" / "howto" / "bodies.md").read_text(encoding="utf-8")
        [program] = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        names = {}
        exec(program, names)
        skeleton = names["skeleton"]
        at, _ = forward(names["rotations"], skeleton.translations, root=names["places"], parents=skeleton.parents)
        for joint, target in ((names["HAND"], names["hands"]), (names["FOOT"], names["feet"])):
            np.testing.assert_allclose(at[:, joint], target, atol=1e-5)


if __name__ == "__main__":
    unittest.main()
