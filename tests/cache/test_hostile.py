# SPDX-License-Identifier: MIT
"""The promise: whatever a cache holds, no command on it ends by a signal, hangs, takes more memory than is given and some, or changes a
byte outside the cache.

    test_hostile.py                       300 hostile caches
    test_hostile.py --full                10,000
    test_hostile.py --count N --seed S    N of them, from seed S on; --keep leaves those that failed"""
import collections
import multiprocessing
import os
import shutil
import subprocess
import sys
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

from hostile import make
from stage import BUDGET, CLIP, SWIVEL, Stage, files_of, unittest

MEMORY = 128  # MiB, of --memory
# MiB beside it: attributes of 4 MiB as JSON. A page takes 1 GiB at most, and the small ones here a tenth of that.
MORE = 128
SECONDS = 60  # a command that takes longer hangs


def argument(name, otherwise):
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else otherwise


COUNT, SEED = argument("--count", 10_000 if "--full" in sys.argv else 300), argument("--seed", 0)


def measured(program, words, folder):
    """The exit code, what was said on stderr, and the most memory that was resident, in MiB."""
    process = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    timer = threading.Timer(SECONDS, process.kill)
    timer.start()
    said = process.stderr.read()
    process.stderr.close()
    _, status, used = os.wait4(process.pid, 0)
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, said, used.ru_maxrss / 1024


def kept(folder):
    """All that is in a folder: kinds, sizes, times of writing, the first bytes, and where links lead. Some files are sparse and huge."""
    found = {}
    for path in sorted(folder.rglob("*")):
        status, holds = path.lstat(), None
        if path.is_symlink():
            holds = os.readlink(path)
        elif path.is_file():
            with path.open("rb") as file:
                holds = file.read(1 << 20)
        found[str(path.relative_to(folder))] = (status.st_mode, status.st_size, status.st_mtime_ns, holds)
    return found


class Hostile(Stage):
    def setUp(self):
        super().setUp()
        # The command, with a page's program beside it.
        (self.folder / "bin").mkdir()
        (self.folder / "share/swivel").mkdir(parents=True)
        (self.folder / "share/swivel/view.html").write_text('<script data-digest="">start(/*crowd*/null)</script>')
        self.program = shutil.copy(SWIVEL, self.folder / "bin/swivel")
        shape = dict(characters=20, frames=6, chunk="2,16")
        self.bases = [self.store("plain", **shape), self.fill(self.store("limited", toml=BUDGET, **shape)),
                      self.fill(self.store("packed", "--compress", toml=BUDGET, **shape)), self.fill(self.store("filled", **shape)),
                      self.fill(self.store("poses", "--store", "poses", **shape)), self.fill(self.store("to close", "--store", "poses", toml=BUDGET, **shape))]
        self.swivel("check", self.bases[-2], "--quiet")
        # Makers read much. A command's memory begins with that of the process which starts it, so they are others.
        self.makers = ProcessPoolExecutor(os.cpu_count(), multiprocessing.get_context("spawn"))
        self.addCleanup(self.makers.shutdown)
        self.most = collections.Counter()
        self.codes = collections.Counter()

    def try_one(self, seed):
        """Faults of one hostile cache, as texts."""
        place = self.folder / str(seed)
        outside, work = place / "outside", place / "work"
        base = self.bases[seed % len(self.bases)]
        shutil.copytree(base, work / "cache")
        outside.mkdir()
        (outside / "folder").mkdir()
        (outside / "folder/0.0").write_bytes(b"eight by")
        (outside / "file").write_bytes(b"not swivel's")
        said = self.makers.submit(make, work / "cache", outside, seed, base.name == "packed").result()
        before, faults = kept(outside), []
        threads, memory = ("--threads", "2"), ("--memory", f"{MEMORY}M")
        for words in (("replay", "cache", *memory, "--out", "out.csv"), ("view", "cache"), ("check", "cache", *memory), ("fill", "cache", "--verify", *memory),
                      ("check", "cache", *memory)):
            code, text, used = measured(self.program, (*words, *threads, "--quiet"), work)
            self.most[words[0]] = max(self.most[words[0]], used)
            self.codes[words[0], code] += 1
            if code not in (0, 1):
                faults.append(f"{words}: exit code {code}: {text[-300:]}")
            if code == 1 and not (text.startswith(b"swivel: ") and text.count(b"\n") == 1 and len(text) < 2000):
                faults.append(f"{words}: {text[-300:]}")
            if used > MEMORY + MORE:
                faults.append(f"{words}: {used:.0f} MiB")
            if kept(outside) != before:
                faults.append(f"{words}: the outside has changed")
                break
        left = sorted(set(os.listdir(work)) - {"cache", "cache.html", "out.csv"})
        if left:
            faults.append(f"left behind: {left}")
        if not faults or "--keep" not in sys.argv:
            shutil.rmtree(place)
        return [f"seed {seed}, {'; '.join(said)}: {fault}" for fault in faults]

    def test_hostile_caches(self):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            faults = []
            for seed, of_one in zip(range(SEED, SEED + COUNT), pool.map(self.try_one, range(SEED, SEED + COUNT))):
                faults += of_one
                if seed % 1000 == 999:
                    print(f"up to seed {seed}: {len(faults)} faults", flush=True)
        print(f"{COUNT} hostile caches; exit codes {dict(sorted(self.codes.items()))}; most MiB {({name: round(most) for name, most in self.most.items()})}")
        self.assertEqual(faults, [], "\n" + "\n".join(faults[:20]))
        self.assertGreater(self.codes["check", 1], self.codes["check", 0] // 4)
        if COUNT >= 300:  # some get through, so what is behind the first checks is reached, too
            self.assertGreater(self.codes["check", 0], COUNT // 20)
            for command in ("fill", "replay", "view"):
                self.assertGreater(self.codes[command, 0], COUNT // 40, command)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
