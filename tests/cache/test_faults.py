# SPDX-License-Identifier: MIT
"""The promise: what goes wrong with a cache is one line that says what, where and what to do, and nothing that was done is lost.

FULL_DISK: the library that full_disk.c makes."""
import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import unittest

import swivel
from stage import BUDGET, CLIP, LIMITED, SWIVEL, Stage, files_of, run

DISK = {"LD_PRELOAD": os.environ["FULL_DISK"]}


def flip(path, at=-1):
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)


def edit(path, change):
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))


class Disk(Stage):
    def test_a_full_disk_leaves_whole_chunks_and_the_rest_is_filled_later(self):
        for toml in (LIMITED, BUDGET):
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
                    self.fill(other, "--resume")
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

    def test_a_cache_that_may_not_be_read(self):
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        self.folder.chmod(0o755)
        for name in (".", ".zattrs", "elbow", "digest/0.0"):
            with self.subTest(file=name):
                cache = self.fill(self.store())
                (cache / name).chmod(0)
                for command in ("check", "replay"):
                    if (command, name) != ("replay", "elbow"):
                        self.assert_refused(run(command, cache, "--quiet", **nobody), "Permission denied; check its permissions and those of its folder")
                (cache / name).chmod(0o755)
                shutil.rmtree(cache)

    def test_a_cache_is_not_replaced(self):
        cache = self.fill(self.store())
        before = files_of(cache)
        self.assert_refused(run("store", CLIP, cache, "--quiet"), "is there already; remove it, or name another folder")
        self.assert_refused(run("store", "missing.bvh", cache, "--quiet"), "is there already")  # before the clip is read
        self.assert_refused(run("store", CLIP, self.folder / "none/cache", "--quiet"), "is no folder; make it first")
        self.assert_refused(run("fill", cache, "--quiet"), "20 of 20 chunks are done already; add --resume to go on, or --verify")
        self.assertEqual(files_of(cache), before)


class Damage(Stage):
    def test_poses_that_changed_are_named_and_made_again(self):
        damaged = r"1 of 20 chunks were damaged and are written again, the first is 2\.1: "
        cases = {"shoulder/2.0.1.0": ("shoulder differs", "a file of its poses is missing or damaged"),
                 "flags/2.0.1": ("flags differs", "a file of its poses is missing or damaged"),
                 "digest/2.1": ("digest differs", None),
                 "state/elbow/2.0.1.0": ("a file of its state is missing or damaged",) * 2}
        for packed, words in enumerate(((), ("--compress",))):
            cache = self.fill(self.store("cache", *words, toml=BUDGET))
            before = files_of(cache)
            for name, what in cases.items():
                with self.subTest(file=name, words=words):
                    flip(cache / name, 0 if packed else -1)  # what is packed begins with the version of its format
                    done = run("check", cache, "--quiet")
                    if what[packed]:
                        self.assert_refused(done, damaged + what[packed])
                    else:
                        self.assert_refused(done, r"1 of 20 chunks are not done, the first is 2\.1; run swivel fill --resume")
                        self.fill(cache, "--resume")
                    self.assertEqual(files_of(cache), before)
            shutil.rmtree(cache)

    def test_every_damaged_chunk_is_named(self):
        cache = self.fill(self.store(toml=LIMITED))
        before = files_of(cache)
        files = ("elbow/0.0.1.0", "flags/2.0.3", "twist_bones/4.0.0.0.0")
        differences = [{"chunk": "4.0", "what": "twist_bones differs"}, {"chunk": "0.1", "what": "elbow differs"}, {"chunk": "2.3", "what": "flags differs"}]
        lines = "".join(f"again    chunk {each['chunk']} was not what its goals give: {each['what']}; it is written again\n" for each in differences)

        def said(*words, code):
            for name in files:
                flip(cache / name)
            done = run(*words)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual(files_of(cache), before)
            return done

        done = said("check", cache, code=1)
        self.assertEqual(done.stdout, lines)
        self.assert_refused(done, r"3 of 20 chunks were damaged and are written again, the first is 4\.0: twist_bones differs; run swivel check once more")
        self.assertEqual(json.loads(said("check", cache, "--json", code=1).stdout)["written_again"], differences)
        self.assertEqual(said("check", cache, "--quiet", code=1).stdout, "")
        self.assertIn("chunks   0 written, 20 compared and 3 of them written again, 0 were done\n" + lines, said("fill", cache, "--verify", code=0).stdout)
        self.assertEqual(json.loads(said("fill", cache, "--verify", "--json", code=0).stdout)["written_again"], differences)
        self.assertEqual(said("fill", cache, "--verify", "--quiet", code=0).stdout, "")

    def test_a_rate_is_of_what_was_written(self):
        cache = self.store()
        self.assertRegex(self.swivel("fill", cache), r"; the disk [0-9.]+ s, \d+ MB/s\n")
        self.assertRegex(self.swivel("fill", cache, "--verify"), r"; the disk [0-9.]+ s\n")

    def test_files_that_are_gone_or_cut_are_made_again(self):
        for toml in (LIMITED, BUDGET):
            cache = self.fill(self.store("cache", toml=toml))
            before = files_of(cache)
            names = ["elbow/1.0.2.0", "digest/1.2", "twist_bones/1.0.2.0.0"] + (["state/flags/1.0.2"] if toml == BUDGET else [])
            for name in names:
                for damage in (os.remove, lambda path: os.truncate(path, 3)):
                    with self.subTest(file=name):
                        damage(cache / name)
                        said = json.loads(self.swivel("fill", cache, "--verify", "--json", "--quiet"))
                        again = [each["chunk"] for each in said["written_again"]]
                        self.assertEqual(again or said["chunks_written"], 1 if name.startswith("digest") else ["1.2"])
                        self.assertEqual(files_of(cache), before)
            shutil.rmtree(cache)

    def test_what_is_not_done_is_named(self):
        cache = self.fill(self.store(), "--shard", "1/2")
        self.assert_refused(run("check", cache, "--quiet"), r"10 of 20 chunks are not done, the first is 1\.0; run swivel fill --resume")
        self.assert_refused(run("replay", cache, "--quiet"), r"chunk 1\.0 is not done, so nothing proves it; run swivel fill --resume")
        self.swivel("replay", cache, "--frames", "0:8", "--characters", "0:32", "--quiet")

    def test_goals_that_changed_are_reported(self):
        whole = self.fill(self.store(toml=BUDGET))
        names = ["clip/wrist/0.0.0", "clip/position/0.0.0", "character/size/1", "chosen/1.0.1"]
        for name in names:
            for damage, what in ((flip, "is damaged"), (os.remove, "is missing"), (lambda path: os.truncate(path, 5), "is damaged")):
                with self.subTest(file=name, what=what):
                    cache = shutil.copytree(whole, self.folder / "damaged")
                    damage(cache / name)
                    before = files_of(cache)
                    for command in (("fill", cache, "--verify"), ("check", cache), ("replay", cache)):
                        done = run(*command, "--quiet")
                        self.assert_refused(done, f"{cache / name}: {what}; goals cannot be computed again: take the file from a copy")
                    self.assertEqual(files_of(cache), before)
                    shutil.rmtree(cache)

    def test_poses_without_goals_are_reported(self):
        cache = self.fill(self.store("cache", "--store", "poses"))
        self.swivel("check", cache, "--quiet")
        self.assertFalse((cache / "clip").exists())
        self.assertIn("right    20 chunks: their poses have their digests\n", self.swivel("check", cache))
        for command in ("replay", "fill", "view"):
            words = ("--resume",) if command == "fill" else ()
            self.assert_refused(run(command, cache, *words, cwd=self.folder), "keeps poses and no goals, so nothing can be solved again")
        flip(cache / "elbow/3.0.1.0")
        os.remove(cache / "flags/4.0.2")
        done = run("check", cache)
        self.assert_refused(done, r"2 of 20 chunks are damaged, the first is 3\.1; the cache keeps no goals, so take their files from a copy")
        files = lambda time, column: " ".join(f"{name}/{time}.0.{column}{'' if name == 'flags' else '.0'}" for name in ("shoulder", "elbow", "wrist", "flags")) + f" digest/{time}.{column}"
        self.assertEqual(done.stdout, f"damaged  chunk 3.1: {files(3, 1)}\ndamaged  chunk 4.2: {files(4, 2)}\n")
        self.assertEqual(json.loads(run("check", cache, "--json").stdout)["damaged"],
                         [{"chunk": chunk, "files": files(*map(int, chunk.split("."))).split()} for chunk in ("3.1", "4.2")])
        self.assertEqual(run("check", cache, "--quiet").stdout, "")


class Metadata(Stage):
    def test_damaged_metadata(self):
        whole = self.fill(self.store(toml=LIMITED))
        changes = [
            (".zattrs", lambda path: os.truncate(path, 100), "is no JSON object: it was changed or cut"),
            (".zattrs", os.remove, r"\.zattrs: is missing; take it from a copy, or make the cache anew in another folder"),
            (".zattrs", lambda path: edit(path, lambda a: a.update(swivel_cache=1)),
             "the cache has format 1, this swivel reads format 2; make it anew by swivel store, or use the swivel that made it"),
            (".zattrs", lambda path: edit(path, lambda a: a.update(characters=101)), "was changed: its digest is another"),
            (".zattrs", lambda path: edit(path, lambda a: a["limbs"][0].update(priority=2)), "was changed: its digest is another"),
            (".zattrs", lambda path: edit(path, lambda a: a.pop("swivel_cache")), "describes no cache of swivel"),
            ("shoulder/.zarray", lambda path: edit(path, lambda a: a.update(shape=[40, 4, 101, 4])),
             r"shape is \[40,4,101,4\] instead of \[40,4,100,4\]: it was changed"),
            ("elbow/.zarray", lambda path: edit(path, lambda a: a.update(zarr_format=3)), "zarr_format is 3 instead of 2"),
            ("flags/.zarray", lambda path: edit(path, lambda a: a.update(dtype="<f4")), 'dtype is "<f4" instead of "<u4"'),
            ("digest/.zarray", os.remove, "digest/.zarray: is missing; take it from a copy, or make the cache anew"),
            (".zgroup", os.remove, r"/\.zgroup: is missing; take it from a copy"),
            ("clip/.zgroup", os.remove, r"clip/\.zgroup: is missing"),
            ("elbow/.zattrs", os.remove, r"elbow/\.zattrs: is missing"),
            ("elbow/.zattrs", lambda path: edit(path, lambda a: a.update(_ARRAY_DIMENSIONS=[])), r"_ARRAY_DIMENSIONS is \[\] instead of"),
            ("clip/wrist/.zarray", lambda path: os.truncate(path, 10), "is no JSON object"),
            ("goal_digest/clip/wrist/0.0.0", lambda path: path.write_bytes(bytes(8)), "goal_digest: was changed: its digest is another"),
            ("goal_digest/character/size/0", os.remove, "goal_digest/character/size/0: is missing or damaged"),
        ]
        for name, change, what in changes:
            with self.subTest(what=what):
                cache = shutil.copytree(whole, self.folder / "damaged")
                change(cache / name)
                before = files_of(cache)
                for words in (("fill", cache, "--verify"), ("check", cache), ("replay", cache), ("view", cache)):
                    self.assert_refused(run(*words, "--quiet", cwd=self.folder), what)
                self.assertEqual(files_of(cache), before)
                shutil.rmtree(cache)

    def test_what_is_no_cache(self):
        (self.folder / "empty").mkdir()
        (self.folder / "file").write_text("no cache\n")
        for name in ("empty", "file", "missing"):
            self.assert_refused(run("fill", self.folder / name, "--quiet"), f"{name}: is no cache of swivel; swivel store makes one")

    def test_options_that_are_wrong(self):
        cache = self.store()
        for words, what in ((("--shard", "0/4"), "write i/n with i from 1 to n, such as 1/4, or auto"), (("--shard", "5/4"), "write i/n"),
                            (("--shard", "x"), "write i/n"), (("--memory", "1K"), "is not an amount of memory from 1M on"),
                            (("--memory", "much"), "is not an amount of memory"), (("--threads", "-1"), "--threads")):
            self.assert_refused(run("fill", cache, *words), what, code=2)
        self.assert_refused(run("fill", cache, "--memory", "1M", "--quiet"), r"one chunk takes \d+ MiB of memory with \d+ threads that solve, and --memory is 1 MiB; give more, use fewer threads, or store the crowd in smaller chunks")
        for words, what in ((("--frames", "8:8"), "write A:B with 0 <= A < B <= 40"), (("--characters", "0:101"), "write A:B"),
                            (("--frames", "a"), "write A:B"), (("--frames", "1:2:3"), "write A:B")):
            self.assert_refused(run("replay", cache, *words), what, code=2)
        for words in (("--limbs", "all"), ("--frames", "3"), ("--crowd", "crowd.toml"), ("--seed", "1")):
            self.assert_refused(run("view", cache, *words), f"{words[0]}: the cache has its crowd already; leave the option out", code=2)
        self.assert_refused(run("view", cache, "--characters", "101"), "--characters 101: the cache has 100$", code=2)
        for chunk in ("8", "8,17", "0,16", "8,16,1"):
            done = run("store", CLIP, self.folder / "other", "--chunk", chunk)
            self.assert_refused(done, "write FRAMES,CHARACTERS, such as 8,4096", code=2)


class Stops(Stage):
    def test_a_signal_ends_a_store_and_leaves_nothing(self):
        (self.folder / "crowd.toml").write_text(BUDGET)
        crowd = ("--crowd", self.folder / "crowd.toml", "--characters", "200000", "--frames", "200")
        # Many small files, so that the signal comes while they are written: of characters, of the budget's choice.
        for name, words in (("character/size", ("--chunk", "200,16")), ("chosen", ("--chunk", "1,65536"))):
            with self.subTest(writes=name):
                place = self.folder / "cache"
                process = subprocess.Popen([SWIVEL, "store", CLIP, place, *crowd, *words, "--quiet"], stderr=subprocess.PIPE, text=True)
                part = self.folder / f".swivel-{process.pid}-0" / name
                while process.poll() is None and not any(part.glob("[0-9]*")):
                    pass
                process.send_signal(signal.SIGINT)
                said = process.communicate()[1]
                self.assertEqual((process.returncode, said), (-2, "swivel: Interrupt; unfinished files are removed\n"))
                self.assertEqual([path.name for path in self.folder.iterdir()], ["crowd.toml"])

    def test_a_terminal_shows_how_far_a_store_is(self):
        terminal, end = pty.openpty()
        process = subprocess.Popen([SWIVEL, "store", CLIP, self.folder / "cache", "--characters", "200000", "--chunk", "1,16"], stdout=subprocess.DEVNULL,
                                   stderr=end, env=os.environ | {"TERM": "xterm"})
        os.close(end)
        said = ""
        while "of 200000 characters" not in said:
            said += os.read(terminal, 1000).decode()
        process.send_signal(signal.SIGINT)
        try:
            while more := os.read(terminal, 1000).decode():
                said += more
        except OSError:  # nobody writes any more
            pass
        os.close(terminal)
        self.assertEqual(process.wait(), -2)
        self.assertRegex(said, r"\x1b\[Kswivel: Interrupt; unfinished files are removed\s*$")
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
        self.fill(cache, "--resume")

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
        self.assertEqual(swivel.fill_cache(cache, 0, 2)["written"], 10)
        done = swivel.fill_cache(cache)
        self.assertEqual((done["written"], done["skipped"], done["compared"], done["written_again"]), (10, 10, 0, []))
        flip(cache / "elbow/2.0.1.0")
        self.assertEqual(swivel.fill_cache(cache, verify=True)["written_again"], ["2.1: elbow differs"])
        flip(cache / "clip/wrist/0.0.0")
        with self.assertRaisesRegex(RuntimeError, "clip/wrist/0.0.0: is damaged"):
            swivel.fill_cache(cache, verify=True)
        with self.assertRaisesRegex(ValueError, "index: it must be below count"):
            swivel.fill_cache(cache, 2, 2)


if __name__ == "__main__":
    unittest.main()
