# SPDX-License-Identifier: MIT
"""The promise: a crowd of any size is stored and filled within the memory that is given, and the run says what limited it.

    test_large.py            a million limbs, 8 frames, 512 MiB
    test_large.py --full     ten million limbs, and a small disk that gets full; needs root and some 5 GB"""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

from stage import CLIP, SWIVEL, Stage, files_of, run

EVERYTHING = """
[crowd]
limbs = "all"
[limb.all]
hand = true
twist_bones = 4
effector = [0, -0.4, 0]
[limb.all.weights]
pole = 0.5
[limb.all.reach]
most_stretch = 1.1
[limb.arms.clavicle]
share = 0.2
[limb.arms.limits]
flexion_deg = [0, 150]
humeral_twist_deg = [-90, 90]
forearm_twist_deg = [-90, 90]
[limb.arms.limits.shoulder_cone]
axis = [0, 0.5, 1]
opening_deg = 80
[limb.arms.limits.hand_cone]
axis = [0, 0.5, 1]
opening_deg = 80
"""
STATE = """
[limb.all.swivel]
most_deg_per_second = 900
[budget]
blocks = 3000
"""
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
        replayed, memory = self.measured("replay", cache, "--json", "--quiet")
        print(f"replay: {replayed['chunks_proved']} chunks, {memory:.0f} MiB resident")
        self.assertEqual(replayed["chunks_proved"], stored["chunks"])
        self.assertLess(memory, 64)  # of one chunk, whatever the crowd's size
        table = ("--frames", f"{frames - 1}:{frames}", "--out", self.folder / "frame.csv")
        replayed, memory = self.measured("replay", cache, *table, "--json", "--quiet")
        print(f"a table of one frame: {replayed['chunks_proved']} chunks, {memory:.0f} MiB resident")
        self.assertLess(memory, 64 + (stored["poses_bytes"] / frames + 40 * characters) / 2**20)  # of the frame, and who is in it
        done = run("check", cache, "--memory", "512M")
        self.assertEqual(done.returncode, 0, done.stderr)
        print(done.stdout)

    def test_the_least_memory_is_enough(self):
        """Chunks so big that each one counts, with all features, state and goals of one's own, filled and compared."""
        (self.folder / "crowd.toml").write_text(EVERYTHING)
        self.swivel("solve", CLIP, "--crowd", "crowd.toml", "--export-targets", "targets.csv", "--quiet")
        for name, toml in (("stateless", EVERYTHING), ("budget", EVERYTHING + STATE)):
            with self.subTest(crowd=name):
                (self.folder / "crowd.toml").write_text(toml)
                cache = self.folder / name
                self.swivel("store", CLIP, cache, "--crowd", "crowd.toml", "--targets", "targets.csv", "--characters", 32_768, "--frames", 32,
                            "--chunk", "16,16384", "--quiet")
                for times, words in ((1, ()), (1, ("--verify",)), (2, ("--verify",))):
                    refused = run("fill", cache, "--threads", "2", "--memory", "1M", "--quiet", *words)
                    least = int(re.search(r"takes (\d+) MiB of memory", refused.stderr)[1])
                    filled, memory = self.measured("fill", cache, "--threads", "2", "--memory", f"{times * least}M", "--json", "--quiet", *words)
                    print(f"fill {name} {' '.join(words)}: {memory:.0f} MiB resident of {times * least}")
                    self.assertEqual(filled["chunks_compared" if words else "chunks_written"], 4)
                    self.assertLessEqual(memory, times * least)
                shutil.rmtree(cache)

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
