# SPDX-License-Identifier: MIT
"""The promise: --threads 1 starts no thread, whatever the command, and gives the bits of many threads.

NO_THREADS names the library of no_threads.c."""
import os
import shutil
import unittest

from stage import BUDGET, CLIP, LIMITED, Stage, run


class OneThread(Stage):
    def alone(self, *words, threads=1):
        return run(*words, "--threads", threads, "--quiet", cwd=self.folder, env=os.environ | {"LD_PRELOAD": os.environ["NO_THREADS"]})

    def assert_alone(self, *words):
        done = self.alone(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)

    def test_caches(self):
        for toml in (LIMITED, BUDGET):  # the second carries state
            with self.subTest(toml=toml):
                many, one = self.store("many", toml=toml), self.folder / "one"
                shutil.copytree(many, one)
                self.fill(many, "--threads", 2)
                self.assert_alone("fill", one)
                self.assert_same(one, many)
                for words in (("fill", one, "--verify"), ("fill", one, "--resume"), ("check", one), ("replay", one), ("replay", one, "--out", "o.csv")):
                    self.assert_alone(*words)
                shutil.rmtree(many), shutil.rmtree(one)
        poses = self.fill(self.store("poses", "--store", "poses"))
        self.assert_alone("check", poses)

    def test_crowds(self):
        self.assert_alone("solve", CLIP, "--characters", 600, "--out", "o.csv")
        self.assert_alone("demo", "--characters", 600, "--frames", 2)

    def test_two_threads_are_seen(self):
        self.assertEqual(self.alone("fill", self.store(), threads=2).returncode, 99)


if __name__ == "__main__":
    unittest.main()
