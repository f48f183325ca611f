# SPDX-License-Identifier: MIT
"""The promise: a crowd of any size is stored, filled, proved and replayed within the memory of some chunks.

    test_large.py            a million limbs, 8 frames, 512 MiB
    test_large.py --full     ten million limbs; needs some 5 GB"""
import os
import re
import subprocess
import sys
import unittest

from stage import CLIP, SWIVEL, Stage

FULL = "--full" in sys.argv


class Large(Stage):
    place = os.environ.get("WORK")  # a disk

    def measured(self, *words):
        """What a command says, and the most memory that it had resident, in MiB."""
        process = subprocess.Popen([SWIVEL, *map(str, words)], stdout=subprocess.PIPE, text=True)
        said = process.stdout.read()
        process.stdout.close()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        print(f"{words[0]}: {used.ru_maxrss / 1024:.0f} MiB resident\n{said}")
        return said, used.ru_maxrss / 1024

    def test_a_crowd_within_its_memory(self):
        characters, frames = (5_000_000, 4) if FULL else (500_000, 8)
        cache = self.folder / "cache"
        said, memory = self.measured("store", CLIP, cache, "--characters", characters, "--frames", frames)
        chunks = re.search(r"frames in (\d+) chunks", said)[1]
        self.assertLess(memory, 512)
        said, memory = self.measured("fill", cache)
        self.assertLess(memory, 512)
        self.assertIn(f"chunks   {chunks} written, 0 left as they were\n", said)
        said, memory = self.measured("replay", cache, "--frames", frames - 1, "--out", self.folder / "frame.csv")
        self.assertLess(memory, 64)  # of one chunk, whatever the crowd's size
        said, memory = self.measured("check", cache)
        self.assertLess(memory, 512)
        self.assertIn(f"right    {chunks} chunks", said)


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--full"])
