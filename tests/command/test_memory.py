# SPDX-License-Identifier: MIT
"""The promise: whichever request for memory fails, the command ends as it should. Either it does its work in full, or it says in one line that
memory lacks, with exit code 1. No signal ends it, and no unfinished file or folder stays.

Of each command line a spread of requests fails, each alone and each with all that follow. --full: 250 of them. All lines begin with the same
requests, of the parser; --version alone stands for these."""
import os
import re
import shutil
import signal
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from stage import PLACE, Stage, bvh, command_with_page, files_of, measured, unittest

FULL = "--full" in sys.argv
SAMPLE = 10  # of the requests of one command line, in each of both ways

ONE = ("--threads", "1")
LINES = [
    ("--version",), ("slove",), ("help", "solve"), ("info", "--json"),
    ("rig", "clip.bvh", "--joints"), ("rig", "clip.bvh", "--json", "--joints"), ("rig", "table.csv"),
    ("inspect", "clip.bvh", "--json"),
    ("solve", "clip.bvh", "--crowd", "crowd.toml", "--out", "o.csv", "--view", "v.html", "--export-targets", "t.csv", *ONE),
    ("solve", "clip.bvh", "--targets", "table.csv", "--out", "o.bvh", "--json", *ONE),
    ("view", "clip.bvh", "--characters", "3", *ONE), ("view", "full", *ONE), ("lab", "steps", "--json"),
    ("demo", "--characters", "3", "--frames", "2", "--view", "v.html", *ONE), ("demo", "--characters", "3", "--frames", "2", "--threads", "2"),
    ("store", "clip.bvh", "cache", "--targets", "table.csv"), ("store", "clip.bvh", "cache", "--crowd", "crowd.toml", "--no-poses"),
    ("fill", "empty", *ONE), ("fill", "empty", "--threads", "2"), ("fill", "full", *ONE), ("check", "full", *ONE),
    ("replay", "full", "--out", "o.csv", *ONE),
]
FAULT = "swivel: Segmentation fault; unfinished files are removed\n"
TIMES = re.compile(rb"\"cpu\": .*|[\d.]+ (million [a-z]+/s|s\b|ms\b)|\"[a-z_]*(seconds|per_second)\": [\d.e+-]+")


def timeless(out):
    """Without times, and without the CPU's name, which is "unknown" where /proc cannot be read."""
    return TIMES.sub(b"", out)


class Run:
    """A command line, run in a copy of the inputs, and what came of it."""

    def __init__(self, command, inputs, words, lacks=None):
        with tempfile.TemporaryDirectory(dir=PLACE) as made:
            folder, count = Path(made) / "f", Path(made) / "requests"
            shutil.copytree(inputs, folder)
            environment = {"LD_PRELOAD": os.environ["LACKING"], "SWIVEL_REQUESTS": str(count)} | ({"SWIVEL_LACKS": lacks} if lacks else {})
            self.code, self.out, said, _ = measured(command, words, folder, **environment)
            self.err = said.decode(errors="backslashreplace")
            self.requests = int(count.read_text()) if count.exists() and count.read_text() else None
            self.files = files_of(folder)


class Memory(Stage):
    def setUp(self):
        super().setUp()
        self.command, self.inputs = command_with_page(self.folder), self.folder / "inputs"
        self.inputs.mkdir()
        (self.inputs / "clip.bvh").write_text(bvh())
        (self.inputs / "table.csv").write_text("frame,character,limb,x,y,z\n0,0,left_arm,6,8,3\n1,0,right_arm,-6,8,3\n")
        (self.inputs / "crowd.toml").write_text("[limb.arms]\nlimits.flexion_deg = [5, 150]\nswivel.max_deg_per_frame = 4\n")
        for words in (("store", "clip.bvh", "empty"), ("store", "clip.bvh", "full"), ("fill", "full")):
            self.assertEqual(measured(self.command, (*words, "--quiet"), self.inputs)[0], 0)
        self.before = files_of(self.inputs)

    def faults_of(self, words, lacks, whole):
        run = Run(self.command, self.inputs, words, lacks)
        faults = []
        is_as_ever = (run.code, timeless(run.out), run.err) == (whole.code, timeless(whole.out), whole.err)
        says_why = run.code == 1 and re.fullmatch(r"swivel: not enough memory[^\n]*\n", run.err)
        is_loader = run.code == 127 and "loading shared libraries" in run.err
        # dlopen() of glibc 2.36, which oneTBB calls at its start, uses what malloc() did not give it.
        is_faulty = words[-2:] == ("--threads", "2")
        is_of_library = is_faulty and run.code == -signal.SIGSEGV and run.err == FAULT
        if not (is_as_ever or says_why or is_loader or is_of_library):
            faults.append(f"exit code {run.code}, {run.err!r}")
        if rest := [name for name in run.files if ".swivel-" in name]:
            faults.append(f"left {sorted(rest)[:3]}, said {run.err!r}")
        # A file is the old one or the new one.
        faults += [f"{name} is half done" for name, content in run.files.items() if ".swivel-" not in name and content not in (whole.files.get(name), self.before.get(name))]
        return [f"{' '.join(words)}, SWIVEL_LACKS={lacks}: {fault}" for fault in faults]

    def test_no_request_for_memory_that_fails_ends_a_run_otherwise(self):
        tries, shared = [], 0
        for words in LINES:
            whole = Run(self.command, self.inputs, words)
            self.assertEqual(whole.code, {"slove": 2, "rig table.csv": 1}.get(" ".join(words), 0), (words, whole.err))
            step = max((whole.requests - shared) // (250 if FULL else SAMPLE), 1)
            tries += [(words, f"{n}{rest}", whole) for n in range(whole.requests, shared, -step) for rest in ("", "-")]
            shared = shared or whole.requests - 100  # the first line's, but for what it alone asks for
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            faults = [fault for found in pool.map(lambda each: self.faults_of(*each), tries) for fault in found]
        print(f"{len(tries)} runs of {len(LINES)} command lines, {len(faults)} faults")
        self.assertEqual(faults, [], "\n".join(faults[:40]))


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--full"])
