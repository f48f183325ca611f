# SPDX-License-Identifier: MIT
"""The promise: whichever request for memory fails, the command ends as it should. Either it does its work in full, or it says in one line that
memory lacks, with exit code 1. No signal ends it, and no unfinished file or folder stays.

Of each command line a spread of requests fails, each alone and each with all that follow. --full: 250 of them. All lines begin with the same
requests, of the parser; --version alone stands for these. See stage.py."""
import os
import re
import signal
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from stage import PLACE, Run, command_with_page, files_of, make_inputs

FULL = "--full" in sys.argv
SAMPLE = 10  # of the requests of one command line, in each of both ways

ONE = ("--threads", "1")
LINES = [
    ("--version",), ("slove",), ("help", "solve"), ("help", "--man"), ("completion", "zsh"), ("info", "--json"),
    ("rig", "clip.bvh", "--joints"), ("rig", "figure.glb", "--json", "--joints"), ("rig", "table.csv"),
    ("solve", "clip.bvh", "--crowd", "crowd.toml", "--out", "o.csv", "--report", "r.html", "--view", "v.html", "--export-targets", "t.csv", *ONE),
    ("solve", "clip.bvh", "--targets", "table.csv", "--out", "o.bvh", "--json", *ONE), ("solve", "figure.glb", "--out", "o.glb", *ONE),
    ("view", "clip.bvh", "--characters", "3", *ONE), ("view", "full", *ONE), ("steps", "--json"), ("steps", "clip.bvh", "--frame", "1"),
    ("demo", "--characters", "3", "--frames", "2", "--view", "v.html", *ONE), ("demo", "--characters", "3", "--frames", "2", "--threads", "2"),
    ("store", "clip.bvh", "cache", "--targets", "table.csv"), ("store", "clip.bvh", "cache", "--crowd", "crowd.toml", "--compress", "--json"),
    ("fill", "empty", *ONE), ("fill", "empty", "--threads", "2"), ("fill", "full", "--verify", "--json", *ONE), ("check", "full", *ONE),
    ("replay", "full", "--out", "o.csv", *ONE),
]
SLOW = [("verify", "--arms", "1", "--report", "r.html"), ("bench", "--seconds", "0.1", "--report", "r.html")]
FAULT = "swivel: a fault in swivel or in a library ends this run; unfinished files are removed; please report it\n"
TIMES = re.compile(rb"\"cpu\": .*|[\d.]+ (million [a-z]+/s|s\b|MB/s|ms\b)|\"[a-z_]*(seconds|per_second)\": [\d.e+-]+|limit .*|\"limit\": .*")


def timeless(out):
    """Without times, without the CPU's name, which is "unknown" where /proc cannot be read, and without what Blosc says on standard output."""
    return TIMES.sub(b"", out).replace(b"Error allocating memory!", b"")


class Memory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        made = tempfile.TemporaryDirectory(dir=PLACE)
        cls.addClassCleanup(made.cleanup)
        cls.command, cls.inputs = command_with_page(), Path(made.name) / "inputs"
        make_inputs(cls.inputs, cls.command)
        cls.before = files_of(cls.inputs)

    def faults_of(self, words, lacks, whole):
        run = Run(self.command, self.inputs, words, lacks)
        faults = []
        is_as_ever = (run.code, timeless(run.out), run.err) == (whole.code, timeless(whole.out), whole.err)
        says_why = run.code == 1 and re.fullmatch(r"swivel: not enough memory[^\n]*\n", run.err)
        is_loader = run.code == 127 and "loading shared libraries" in run.err
        # Blosc 1.21, and dlopen() of glibc 2.36, which oneTBB calls at its start, use what malloc() did not give them.
        is_faulty = "--compress" in words or words[-2:] == ("--threads", "2") or words in SLOW
        is_of_library = is_faulty and run.code == -signal.SIGSEGV and run.err == FAULT
        if not (is_as_ever or says_why or is_loader or is_of_library):
            faults.append(f"exit code {run.code}, {run.err!r}")
        if rest := [name for name in {*run.files, *run.folders} if ".swivel-" in name]:
            faults.append(f"left {sorted(rest)[:3]}, said {run.err!r}")
        # A file is the old one or the new one. Reports have times in them.
        faults += [f"{name} is half done" for name, content in run.files.items() if ".swivel-" not in name and name not in ("r.html",)
                   and content not in (whole.files.get(name), self.before.get(name))]
        return [f"{' '.join(words)}, SWIVEL_LACKS={lacks}: {fault}" for fault in faults]

    def check(self, lines, most):
        """most: of the requests of each line."""
        tries, shared = [], 0
        for words in lines:
            whole = Run(self.command, self.inputs, words)
            self.assertEqual(whole.code, {"slove": 2, "rig table.csv": 1}.get(" ".join(words), 0), (words, whole.err))
            step = max((whole.requests - shared) // most, 1)
            tries += [(words, f"{n}{rest}", whole) for n in range(whole.requests, shared, -step) for rest in ("", "-")]
            shared = shared or whole.requests - 100  # the first line's, but for what it alone asks for
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            faults = [fault for found in pool.map(lambda each: self.faults_of(*each), tries) for fault in found]
        print(f"{len(tries)} runs of {len(lines)} command lines, {len(faults)} faults")
        self.assertEqual(faults, [], "\n".join(faults[:40]))

    def test_no_request_for_memory_that_fails_ends_a_run_otherwise(self):
        self.check(LINES, 250 if FULL else SAMPLE)

    @unittest.skipUnless(FULL, "takes minutes")
    def test_nor_in_long_runs(self):
        self.check([LINES[0], *SLOW], 40)


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--full"])
