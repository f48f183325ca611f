# SPDX-License-Identifier: MIT
"""What the tests of caches share: the command, crowds to store, and a cache's files as bytes.

SWIVEL names the command. SWIVEL_TEST_DATA may hold the clip; Debian's assimp-testmodels has it."""
import ctypes
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SWIVEL = os.environ["SWIVEL"]
PLACES = (Path("/usr/share/assimp/models/BVH/01_01.bvh"), Path(os.environ.get("SWIVEL_TEST_DATA", "")) / "bvh/cmu_01_01_forward_jump.bvh")
CLIP = next(str(place) for place in PLACES if place.is_file())

LIMITED = (ROOT / "tests/cache/limited.toml").read_text()
STATE = LIMITED + """
[limb.all.swivel]
most_deg_per_second = 900
"""
WHOLE = f"""{STATE}
[look]
target = [60, 15, 160]
[ground]
heights = "{ROOT}/examples/hills.png"
size = [900, 60, 900]
"""


XXHASH = ctypes.CDLL("libxxhash.so.0")
XXHASH.XXH3_64bits.restype = ctypes.c_uint64
XXHASH.XXH3_64bits.argtypes = (ctypes.c_char_p, ctypes.c_size_t)


def digest_of(content):
    """Of bytes, as docs/cache.md says."""
    return XXHASH.XXH3_64bits(content, len(content)) or 1


def run(*words, **options):
    return subprocess.run([SWIVEL, *map(str, words)], capture_output=True, text=True, **options)


def files_of(cache):
    """Every file of a cache by its name within it, with its bytes."""
    return {str(path.relative_to(cache)): path.read_bytes() for path in sorted(Path(cache).rglob("*")) if path.is_file()}


class Stage(unittest.TestCase):
    """A folder for each test, and the commands' outcomes checked on the way."""

    place = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # each chunk is synced, and memory does not wait for that

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
