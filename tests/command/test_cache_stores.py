# SPDX-License-Identifier: MIT
"""The promise: a cache has the same bytes, whoever fills it and however often it is interrupted: one process, one thread or many, shards,
ranks of MPI, workers of Dask, tasks of Slurm, two writers at once. A crowd of any size is stored, filled, proved and replayed within the memory
of some chunks.

    test_cache_stores.py                  the large crowd has a million limbs, 8 frames, 512 MiB
    test_cache_stores.py --full Large     ten million limbs; needs some 5 GB"""
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

from stage import CLIP, LIMITED, ROOT, STATE, SWIVEL, Stage, files_of, measured, run, unittest

FULL = "--full" in sys.argv
CROWDS = {"plain": "", "limited": LIMITED, "state": STATE}


class SameBytes(Stage):
    def test_four_shards_leave_what_one_process_leaves(self):
        for name, toml in CROWDS.items():
            with self.subTest(crowd=name):
                empty = self.store(f"{name}-empty", toml=toml)
                one = self.fill(shutil.copytree(empty, self.folder / f"{name}-one"))
                four = shutil.copytree(empty, self.folder / f"{name}-four")
                order = ["3/4", "1/4", "4/4", "2/4"]
                for shard in order:
                    self.assertEqual(self.fill(four, "--shard", shard), four)
                self.assert_same(one, four)
                self.assertGreater(len(files_of(one)), len(files_of(empty)))
                self.swivel("check", one, "--quiet")

    def test_one_thread_starts_none_and_changes_nothing(self):
        def alone(*words, threads=1):
            return run(*words, "--threads", threads, "--quiet", cwd=self.folder, env=os.environ | {"LD_PRELOAD": os.environ["LACKING"], "SWIVEL_NO_THREADS": "1"})

        many, one = self.store("many", toml=STATE), self.folder / "one"
        shutil.copytree(many, one)
        self.fill(many, "--threads", 2)
        for words in (("fill", one), ("fill", one), ("check", one), ("replay", one, "--out", "o.csv"),
                      ("solve", CLIP, "--characters", 600, "--out", "o.csv"), ("demo", "--characters", 600, "--frames", 2)):
            done = alone(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        self.assert_same(one, many)
        self.assertEqual(alone("check", one, threads=2).returncode, 99)  # the library sees threads

    def test_two_writers_of_the_same_chunks_both_finish(self):
        empty = self.store(toml=STATE, characters=300)
        one = self.fill(shutil.copytree(empty, self.folder / "one"))
        two = shutil.copytree(empty, self.folder / "two")
        writers = [subprocess.Popen([SWIVEL, "fill", two, "--quiet"], stderr=subprocess.PIPE, text=True) for _ in range(2)]
        self.assertEqual([writer.communicate()[1] for writer in writers], ["", ""])
        self.assertEqual([writer.returncode for writer in writers], [0, 0])
        self.assert_same(one, two)

    def test_killed_ten_times_and_resumed(self):
        choose = random.Random(7)
        for name in ("limited", "state"):
            with self.subTest(crowd=name):
                empty = self.store(f"{name}-empty", toml=CROWDS[name], characters=2000, frames=64)
                began = time.monotonic()
                one = self.fill(shutil.copytree(empty, self.folder / f"{name}-one"))
                whole = time.monotonic() - began
                killed, kills = shutil.copytree(empty, self.folder / f"{name}-killed"), 0
                while kills < 10:
                    process = subprocess.Popen([SWIVEL, "fill", killed, "--quiet"])
                    time.sleep(choose.uniform(0, whole / 4))
                    process.send_signal(signal.SIGKILL)
                    if process.wait() == 0:  # it was done before: once more from the start
                        shutil.rmtree(killed)
                        shutil.copytree(empty, killed)
                    kills += 1
                self.fill(killed)
                self.swivel("check", killed, "--quiet")
                self.swivel("check", one, "--quiet")
                self.assert_same(one, killed)  # check has removed what killed writers left


class Engines(Stage):
    def setUp(self):
        super().setUp()
        self.empty = self.store("empty", toml=STATE)
        self.one = self.fill(shutil.copytree(self.empty, self.folder / "one"))
        self.other = shutil.copytree(self.empty, self.folder / "other")
        self.path = f"{os.path.dirname(SWIVEL)}:{os.environ['PATH']}"

    def example(self, *command, **more):
        done = subprocess.run(command, cwd=self.folder, env=os.environ | {"PATH": self.path, **more}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_ranks_of_mpi(self):
        self.example("bash", str(ROOT / "examples/cache/mpi.sh"), str(self.other), "4", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        self.assert_same(self.one, self.other)

    def test_workers_of_dask(self):
        said = self.example(sys.executable, str(ROOT / "examples/cache/dask_fill.py"), str(self.other))
        self.assertRegex(said, r"^2 workers wrote \d+ chunks\n")
        self.assert_same(self.one, self.other)

    def test_array_of_slurm(self):
        """The script, with the variables that Slurm gives each task."""
        script, done = str(ROOT / "examples/cache/slurm.sbatch"), 0
        for task in (2, 0, 3, 1):
            said = self.example("bash", script, str(self.other), SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT="4", SLURM_CPUS_PER_TASK="1")
            done += int(re.search(r"^chunks   (\d+) written, 0 left", said)[1])
        self.assertEqual(done, 20)
        self.assert_same(self.one, self.other)


class Large(Stage):
    place = os.environ.get("WORK")  # a disk

    def within(self, memory, *words):
        """What a command says, which takes no more memory than so many MiB."""
        code, said, _, used = measured(SWIVEL, words)
        print(f"{words[0]}: {used:.0f} MiB resident\n{said.decode()}")
        self.assertEqual(code, 0)
        self.assertLess(used, memory)
        return said.decode()

    def test_a_crowd_within_its_memory(self):
        characters, frames = (5_000_000, 4) if FULL else (500_000, 8)
        cache = self.folder / "cache"
        chunks = re.search(r"frames in (\d+) chunks", self.within(512, "store", CLIP, cache, "--characters", characters, "--frames", frames))[1]
        self.assertIn(f"chunks   {chunks} written, 0 left as they were\n", self.within(512, "fill", cache))
        self.within(64, "replay", cache, "--frames", frames - 1, "--out", self.folder / "frame.csv")  # of one chunk, whatever the crowd's size
        self.assertIn(f"right    {chunks} chunks", self.within(512, "check", cache))


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--full"])
