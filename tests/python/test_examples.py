# SPDX-License-Identifier: MIT
"""The promise: the documentation's programs run as they stand there, and the reach test draws what reaching is."""
import contextlib
import importlib.util
import io
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib import image

import swivel
from arms import joints_at, rotate, times

ROOT = Path(__file__).resolve().parents[2]
REACH = ROOT / "tools" / "python" / "examples" / "reach.py"


class Documentation(unittest.TestCase):
    def test_programs_run(self):
        text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertEqual(len(programs), 9)
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

    def test_flag_words_of_several_bits_have_names(self):
        """NumPy's numbers are not Python's: enum refuses them for a word that is no single bit."""
        text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        line = re.search(r"^print\(\[swivel\.Flag.*$", text, re.MULTILINE)[0]
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(line, {"swivel": swivel, "arms": swivel.solve([[0.0, 0.0, 9.0]], (0.0, 0.0, 1.0), (0.3, 0.26))})
        if sys.version_info >= (3, 11):  # before, only a single bit has a name
            self.assertEqual(printed.getvalue(), "['CLAMPED_FAR|SWIVEL_UNDEFINED']\n")


class Reach(unittest.TestCase):
    def test_the_curves_are_those_of_reaching(self):
        spec = importlib.util.spec_from_file_location("reach", REACH)
        reach = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(reach)
        targets, ways = reach.solve_line(200)
        d = np.linalg.norm(targets, axis=1) / reach.REACH
        eased = np.where(d < 0.85, d, np.where(d > 1.15, 1, d - (d - 0.85) ** 2 / (4 * 0.15)))
        plain, soft, stretched = ways.values()
        np.testing.assert_allclose(plain.residual, np.maximum(0, d - 1), atol=1e-6)
        np.testing.assert_allclose(soft.residual, d - eased, atol=1e-6)
        np.testing.assert_allclose(stretched.stretch, np.minimum(1.1, d / eased), atol=1e-6)
        _, wrists = joints_at(soft.shoulder, soft.elbow, np.array(reach.LENGTHS))
        np.testing.assert_allclose(np.linalg.norm(wrists, axis=1) / reach.REACH, eased, atol=1e-6)

    def test_the_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "reach.png"
            run = subprocess.run([sys.executable, "-B", str(REACH), str(out)], capture_output=True, text=True, check=True)
            self.assertRegex(run.stdout, r"500 targets, 7\d% of them within reach")
            picture = image.imread(out)[..., :3]
        height, width, _ = picture.shape
        self.assertGreater(width, 1000)
        for top in (0, height // 2):  # lines in colour in each of the four
            for left in (0, width // 2):
                part = picture[top:top + height // 2, left:left + width // 2]
                self.assertGreater(np.mean(np.ptp(part, axis=2) > 0.3), 0.003)


if __name__ == "__main__":
    unittest.main()
