# SPDX-License-Identifier: MIT
"""The command as the tests in Python run it: a folder for each test, runs with their time and memory measured, hostile words, figures, and crowds
to store.

SWIVEL names the command, LACKING the library of lacking.c. SWIVEL_TEST_DATA may hold the clip; Debian's assimp-testmodels has it."""
import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SWIVEL = os.environ["SWIVEL"]
PLACE = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # outputs are synced, and memory does not wait for that
SECONDS = 60  # a command that takes longer hangs
PLACES = (Path("/usr/share/assimp/models/BVH/01_01.bvh"), Path(os.environ.get("SWIVEL_TEST_DATA", "")) / "bvh/cmu_01_01_forward_jump.bvh")
CLIP = next((str(place) for place in PLACES if place.is_file()), None)

LIMITED = (ROOT / "tests/command/limited.toml").read_text()
STATE = LIMITED + """
[limb.all.swivel]
max_deg_per_second = 900
"""
WHOLE = f"""{STATE}
[look]
target = [60, 15, 160]
[ground]
heights = "{ROOT}/examples/hills.png"
size = [900, 60, 900]
"""

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[][{}:,]|[^][{}:,\s"]+')  # of JSON
EVIL = ("0", "1", "15", "17", "-1", "65536", "1073741824", "2147483648", "4294967296", "9223372036854775808", "1e+30", "1.5", "null", '"x"', "[]", "{}",
        "[[[[[[[[[[[[]]]]]]]]]]]]", "[" * 100_000)

XXHASH = ctypes.CDLL("libxxhash.so.0")
XXHASH.XXH3_64bits.restype = ctypes.c_uint64
XXHASH.XXH3_64bits.argtypes = (ctypes.c_char_p, ctypes.c_size_t)


def digest_of(content):
    """Of bytes, as docs/cache.md says."""
    return XXHASH.XXH3_64bits(content, len(content)) or 1


def run(*words, **options):
    return subprocess.run([SWIVEL, *map(str, words)], capture_output=True, text=True, **options)


def files_of(folder):
    """All that is in a folder by its name within it: files with their bytes, folders with None."""
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in sorted(Path(folder).rglob("*"))}


def bvh(along_x=False):
    """A figure that stands and swings its arms, as BVH. along_x: where no joint turns, its bones are along x, as in some sets of motion."""
    lines, turns = ["HIERARCHY"], []

    def joint(kind, name, offset, turned, *children):
        lines.extend([f"{kind} {name}", "{", "OFFSET {} {} {}".format(*offset)])
        if kind != "End":
            lines.append("CHANNELS " + ("6 Xposition Yposition Zposition " if kind == "ROOT" else "3 ") + "Zrotation Yrotation Xrotation")
            turns.append((name, turned))
        for child in children:
            joint(*child)
        lines.append("}")

    def limb(side, names, start, turned, bone):
        nested = ("End", "Site", (0, 0, 1), 0)
        for name, offset, angle in reversed([*zip(names, (start, bone, bone, (0, 0, 2)), (turned, 0, 0, 0))]):
            nested = ("JOINT", side + name, offset, angle, nested)
        return nested

    legs, arms = ("UpLeg", "Leg", "Foot", "ToeBase"), ("Arm", "ForeArm", "Hand")
    if along_x:
        limbs = [limb(side, legs, (sign, 0, 0), -90, (4, 0, 0)) for side, sign in (("Left", 1), ("Right", -1))]
        trunk = ("JOINT", "Spine", (0, 0, 0), 90, ("JOINT", "Head", (4, 0, 0), 0, ("End", "Site", (1, 0, 0), 0)),
                 limb("Left", arms, (3, -2, 0), -90, (3, 0, 0)), limb("Right", arms, (3, 2, 0), 90, (3, 0, 0)))
    else:
        limbs = [limb(side, legs, (sign, 0, 0), 0, (0, -4, 0)) for side, sign in (("Left", 1), ("Right", -1))]
        trunk = ("JOINT", "Spine", (0, 0, 0), 0, ("JOINT", "Head", (0, 4, 0), 0, ("End", "Site", (0, 1, 0), 0)),
                 *(limb(side, arms, (2 * sign, 3, 0), 0, (3 * sign, 0, 0)) for side, sign in (("Left", 1), ("Right", -1))))
    joint("ROOT", "Hips", (0, 0, 0), 0, *limbs, trunk)
    swing = lambda name: 0 if "Arm" not in name else -3 if along_x or "Left" in name else 3  # forwards
    frames = [[0, 8, 0] + [number for name, turned in turns for number in (turned, swing(name) * min(f, 24 - f), 0)] for f in range(25)]
    return "\n".join([*lines, "MOTION", f"Frames: {len(frames)}", "Frame Time: 0.0333333", *(" ".join(map(str, frame)) for frame in frames)]) + "\n"


def argument(name, otherwise):
    """A whole number of the command line."""
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else otherwise


def check_all(test, what, faults_of, count, codes):
    """Tries `count` inputs from --seed on. faults_of: of a seed, as texts. codes: how often each command ended with each exit code, which faults_of
    counts. Some inputs get through each command and some do not, so what is behind the first checks is reached, too."""
    seed = argument("--seed", 0)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [fault for of_one in pool.map(faults_of, range(seed, seed + count)) for fault in of_one]
    print(f"{count} {what}; exit codes {dict(sorted(codes.items()))}")
    test.assertEqual(faults, [], "\n" + "\n".join(faults[:20]))
    if count >= 150:
        for command in {command for command, _ in codes}:
            test.assertGreater(min(codes[command, 0], codes[command, 1]), 0, command)


def command_with_page(folder):
    """A copy of the command with a page's program beside it, which need not work."""
    for part in ("bin", "share/swivel"):
        (folder / part).mkdir(parents=True)
    (folder / "share/swivel/view.html").write_text('<script data-digest="">start(/*crowd*/null)</script>')
    return shutil.copy(SWIVEL, folder / "bin/swivel")


def measured(program, words, folder=None, **environment):
    """The exit code, what was said on stdout and on stderr, and the most memory that was resident, in MiB."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as complaint:
        process = subprocess.Popen([program, *map(str, words)], cwd=folder, env=os.environ | environment, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=complaint)
        timer = threading.Timer(SECONDS, process.kill)
        timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        complaint.seek(0)
        return process.returncode, out.read(), complaint.read(), used.ru_maxrss / 1024


class Stage(unittest.TestCase):
    """A folder for each test, and the commands' outcomes checked on the way."""

    place = PLACE

    def setUp(self):
        made = tempfile.TemporaryDirectory(dir=self.place)
        self.addCleanup(made.cleanup)
        self.folder = Path(made.name)

    def swivel(self, *words, **options):
        done = run(*words, cwd=self.folder, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout

    def store(self, name="cache", *words, clip=CLIP, toml="", characters=100, frames=40, chunk="8,32"):
        if toml:
            (self.folder / "crowd.toml").write_text(toml)
            words += ("--crowd", "crowd.toml")
        self.swivel("store", clip, name, "--characters", characters, "--frames", frames, "--chunk", chunk, "--quiet", *words)
        return self.folder / name

    def fill(self, cache, *words):
        self.swivel("fill", cache, "--quiet", *words)
        return cache

    def assert_same(self, one, other):
        """File by file; names first, since they tell more."""
        one, other = files_of(one), files_of(other)
        self.assertEqual(sorted(one), sorted(other))
        self.assertEqual([name for name in one if one[name] != other[name]], [])

    def assert_refused(self, done, what, code=1):
        """One line that says what."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertRegex(done.stderr, f"^swivel: .*{what}")
