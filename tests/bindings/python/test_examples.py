# SPDX-License-Identifier: MIT
"""The promise: the documentation's programs run as they stand there, and what they ask for is reached."""
import contextlib
import io
import re
import unittest
from pathlib import Path

import numpy as np

import swivel
from swivel import Flag

ROOT = Path(__file__).resolve().parents[3]


def names_of(page, count):
    """The variables that a page's programs leave, run one after the other, and what they print."""
    programs = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / page).read_text(encoding="utf-8"), re.DOTALL)
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        for program in programs:
            exec(program, names)
    assert len(programs) == count, f"{page} has {len(programs)} programs"
    return names, printed.getvalue()


class Documentation(unittest.TestCase):
    def test_programs_run(self):
        names, printed = names_of("python.md", 14)
        self.assertIn("['REACHED', 'CLAMPED_FAR']", printed)
        np.testing.assert_allclose(names["arms"].wrist_position[0], names["targets"][0], atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(names["shoulder"], axis=1), 1, atol=1e-6)
        self.assertIsNotNone(names["limited"].wrist)
        for crowd in ("characters", "climbers"):
            self.assertIsNone(names[crowd].find(Flag.BAD_INPUT))
        np.testing.assert_allclose(names["characters"].wrists(1)[:100], (names["hips"] - (0, 0.8, 0))[:100], atol=1e-4)
        self.assertTrue(np.all(names["characters"].elbows(1)[:100, 2] > 0.1))  # forwards
        np.testing.assert_allclose(names["arm"].lengths, (0.30, 0.26), rtol=1e-6)
        self.assertEqual(names["arm"].twist_from_arm.shape, (1, 4))
        for what in ("planted", "held", "seen"):  # by the flags of all bodies
            self.assertTrue(np.all(names[what]), what)
        np.testing.assert_allclose(names["rifles"][:, :3], names["stand"] + (0, 1.2, 0.35), atol=1e-4)

    def test_the_program_of_bodies_runs(self):
        names, _ = names_of("howto/bodies.md", 1)
        crowds = [crowd for crowd in names.values() if isinstance(crowd, swivel.Crowd)]
        self.assertEqual([crowd.find(Flag.BAD_INPUT | Flag.CLAMPED_FAR | Flag.CLAMPED_NEAR) for crowd in crowds], [None])


if __name__ == "__main__":
    unittest.main()
