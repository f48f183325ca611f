# SPDX-License-Identifier: MIT
"""The promise: what goes wrong with a cache is one line that says what, where and what to do, and nothing that was done is lost.
Wrong options and damaged metadata are in tests/transcripts/cache_refusals.txt."""
import os
import shutil
import signal
import subprocess
import sys
import unittest

import swivel
from stage import CLIP, LIMITED, STATE, SWIVEL, Stage, files_of, run

DISK = {"LD_PRELOAD": os.environ["LACKING"]}


def flip(path, at=-1):
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)


class Disk(Stage):
    def test_a_full_disk_leaves_whole_chunks_and_the_rest_is_filled_later(self):
        for toml in (LIMITED, STATE):
            empty = self.store("empty", toml=toml, characters=150)
            one = self.fill(shutil.copytree(empty, self.folder / "one"))
            for count in (0, 1000, 1_500_000, 2_500_000):
                with self.subTest(bytes=count):
                    other = shutil.copytree(empty, self.folder / "other")
                    done = run("fill", other, "--quiet", env=os.environ | DISK | {"SWIVEL_DISK_BYTES": str(count)})
                    self.assert_refused(done, f"{other}/[a-z_/]*[0-9.]+: cannot be written: No space left on device; free some space")
                    left, wanted = files_of(other), files_of(one)
                    self.assertEqual([name for name in left if left[name] != wanted[name]], [])
                    self.assertEqual(count > 1000, any(name.startswith("digest/0") for name in left))
                    self.fill(other)
                    self.assert_same(one, other)
                    shutil.rmtree(other)
            shutil.rmtree(empty)
            shutil.rmtree(one)

    def test_a_store_that_does_not_fit_leaves_nothing(self):
        for count in (0, 20, 100, 1000, 10_000):
            with self.subTest(bytes=count):
                place = self.folder / str(count)
                place.mkdir()
                done = run("store", CLIP, place / "cache", "--quiet", env=os.environ | DISK | {"SWIVEL_DISK_BYTES": str(count)})
                self.assert_refused(done, "No space left on device; free some space")
                self.assertEqual(list(place.iterdir()), [])

    def test_a_folder_that_may_only_be_read(self):
        cache = self.store()
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        self.folder.chmod(0o755)
        for path in [cache, *cache.rglob("*")]:
            path.chmod(0o555 if path.is_dir() else 0o444)
        before = files_of(cache)
        self.assert_refused(run("fill", cache, "--quiet", **nobody), "Permission denied; check the folder and its permissions")
        self.assert_refused(run("store", CLIP, cache / "other", "--quiet", **nobody), "Permission denied; check the folder and its permissions")
        cache.chmod(0o444)  # nobody may search it
        self.assert_refused(run("store", CLIP, cache / "clip/other", "--quiet", **nobody), "clip: cannot be reached: Permission denied; check the path and its permissions")
        cache.chmod(0o555)
        self.assertEqual(files_of(cache), before)
        for path in [cache, *cache.rglob("*")]:
            path.chmod(0o755)
        self.fill(cache)
        self.swivel("check", cache, "--quiet")
        self.assertEqual(run("check", cache, "--quiet", **nobody).returncode, 0)  # a closed cache is only read


class Stops(Stage):
    def test_a_signal_ends_a_store_and_leaves_nothing(self):
        place = self.folder / "cache"
        process = subprocess.Popen([SWIVEL, "store", CLIP, place, "--characters", "200000", "--frames", "200", "--chunk", "200,16", "--quiet"],
                                   stderr=subprocess.PIPE, text=True)  # many small files, so that the signal comes while they are written
        part = self.folder / f".swivel-{process.pid}-0/character/size"
        while process.poll() is None and not any(part.glob("[0-9]*")):
            pass
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        self.assertEqual((process.returncode, said), (-2, "swivel: Interrupt; unfinished files are removed\n"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_signal_ends_a_fill_that_may_go_on(self):
        cache = self.store(characters=4000, frames=400)
        process = subprocess.Popen([SWIVEL, "fill", cache, "--quiet"], stderr=subprocess.PIPE, text=True)
        while not any((cache / "digest").glob("[0-9]*")):
            pass
        process.terminate()
        said = process.communicate()[1]
        self.assertEqual((process.returncode, said), (-15, "swivel: Terminated; unfinished files are removed\n"))
        self.assertEqual([path for path in cache.rglob(".swivel-*")], [])
        self.fill(cache)

    def test_a_signal_ends_a_fill_in_python(self):
        cache = self.store(characters=4000, frames=2000)
        program = f"import swivel; swivel.fill_cache({str(cache)!r}, threads=1)"
        process = subprocess.Popen([sys.executable, "-c", program], stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not any((cache / "digest").glob("[0-9]*")):
            pass
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        self.assertEqual(process.returncode, -2, said)
        self.assertRegex(said, r"KeyboardInterrupt\s*$")
        self.assertLess(sum(1 for _ in (cache / "digest").glob("[0-9]*")), 31_250)
        self.assertEqual([path for path in cache.rglob(".swivel-*")], [])


class Python(Stage):
    def test_a_message_names_any_folder(self):
        for name in (b"none", "g\u00e9n\u00e9".encode(), b"\xff\xfe"):
            folder = os.fsencode(self.folder) + b"/" + name
            with self.assertRaises(RuntimeError) as refused:
                swivel.fill_cache(folder)
            self.assertEqual(str(refused.exception), f"{os.fsdecode(folder)}: is no cache of swivel; swivel store makes one")

    def test_what_a_fill_did(self):
        cache = self.store()
        self.assertEqual(swivel.fill_cache(cache, 0, 2), {"written": 10, "left": 0, "limbs": 10 * 8 * 32 * 2 - 2 * 8 * 28 * 2})
        done = swivel.fill_cache(cache)
        self.assertEqual((done["written"], done["left"]), (10, 10))
        flip(cache / "clip/wrist/0.0.0")
        with self.assertRaisesRegex(RuntimeError, "clip/wrist/0.0.0: is damaged"):
            swivel.fill_cache(cache)
        with self.assertRaisesRegex(ValueError, "index: it must be below count"):
            swivel.fill_cache(cache, 2, 2)


if __name__ == "__main__":
    unittest.main()
