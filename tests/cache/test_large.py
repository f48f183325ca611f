# SPDX-License-Identifier: MIT
"""The promise: a crowd of any size is stored and filled within the memory that is given, and the run says what limited it.

    test_large.py            a million limbs, 8 frames, 512 MiB
    test_large.py --full     ten million limbs, and a small disk that gets full; needs root and some 5 GB"""
import json
import os
import resource
import shutil
import subprocess
import sys
import unittest

from stage import CLIP, SWIVEL, Stage, files_of, run

FULL = "--full" in sys.argv


class Large(Stage):
    place = os.environ.get("WORK")  # a disk

    def measured(self, *words):
        """The JSON that a command prints, and the most memory that it had resident, in MiB."""
        process = subprocess.Popen([SWIVEL, *map(str, words)], stdout=subprocess.PIPE, text=True)
        said = process.stdout.read()
        process.stdout.close()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return json.loads(said), used.ru_maxrss / 1024

    def test_a_crowd_within_its_memory(self):
        characters, frames = (5_000_000, 4) if FULL else (500_000, 8)
        cache = self.folder / "cache"
        stored, memory = self.measured("store", CLIP, cache, "--characters", characters, "--frames", frames, "--json", "--quiet")
        print(f"store: {stored['goals_bytes'] / 1e6:.0f} MB of goals, {stored['poses_bytes'] / 1e6:.0f} MB of poses, {memory:.0f} MiB resident")
        self.assertLess(memory, 512)
        filled, memory = self.measured("fill", cache, "--memory", "512M", "--json", "--quiet")
        print(f"fill: {filled['limbs']} limbs in {filled['seconds']:.1f} s; solver {filled['solver_seconds']:.1f} s, "
              f"disk {filled['disk_seconds']:.1f} s, limit {filled['limit']}, {memory:.0f} MiB resident")
        self.assertLess(memory, 512)
        self.assertEqual(filled["limbs"], 2 * characters * frames)
        self.assertEqual(filled["chunks_written"], stored["chunks"])
        self.swivel("replay", cache, "--frames", f"{frames - 1}:{frames}", "--characters", f"{characters - 10}:{characters}", "--quiet")
        done = run("check", cache, "--memory", "512M")
        self.assertEqual(done.returncode, 0, done.stderr)
        print(done.stdout)

    @unittest.skipUnless(FULL, "needs a disk of its own: tools/test --full cache")
    def test_a_small_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        empty = self.store("empty", characters=2000, frames=64)
        one = self.fill(shutil.copytree(empty, self.folder / "one"))
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4M", "tmpfs", disk], check=True)
        self.addCleanup(subprocess.run, ["umount", disk])
        other = shutil.copytree(empty, disk / "other")
        self.assert_refused(run("fill", other, "--quiet"), "No space left on device; free some space")
        left, wanted = files_of(other), files_of(one)
        self.assertTrue(any(name.startswith("digest/0") for name in left))
        self.assertEqual([name for name in left if left[name] != wanted[name]], [])
        subprocess.run(["mount", "-o", "remount,size=64M", disk], check=True)
        self.fill(other, "--resume")
        self.assert_same(one, other)


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--full"])
