# SPDX-License-Identifier: MIT
"""The promise: other programs read a cache as it stands, and what they read is what the library gives, bit for bit."""
import csv
import os
import re
import warnings
from pathlib import Path

import numpy as np
import zarr

from stage import CLIP, LIMITED, ROOT, STATE, WHOLE, Stage, digest_of, unittest
from swivel import Field

LIMBS = ["left_arm", "right_arm", "left_leg", "right_leg"]


def bits(numbers):
    return np.asarray(numbers, "<f4").view("<u4")


def table_of(path):
    """A table of poses by limb, frame and character."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {(row["limb"], int(row["frame"]), int(row["character"])): row for row in rows}


def rotation_of(row, joint):
    return bits([float(row[f"{joint}_{axis}"]) for axis in "xyzw"])


def opened(folder):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return zarr.open(str(folder), mode="r")


def arrays_of(group):
    """All arrays below a group of zarr by their paths, sorted."""
    found = {}
    group.visititems(lambda name, item: found.update({name: item}) if hasattr(item, "chunks") else None)
    return dict(sorted(found.items()))


def short_clip(path, frame_count):
    """The first frames of the clip as a file of its own."""
    head, _, motion = Path(CLIP).read_text().partition("Frames:")
    lines = motion.splitlines()
    path.write_text("\n".join([f"{head}Frames: {frame_count}", *lines[1:2 + frame_count]]) + "\n")
    return path


class Values(Stage):
    def assert_table(self, cache, table, limbs, frames, characters):
        for (name, frame, character), row in table.items():
            at = frame, limbs.index(name), character
            for joint in ("shoulder", "elbow", "wrist"):
                if joint in cache:
                    self.assertEqual(rotation_of(row, joint).tolist(), bits(cache[joint][at]).tolist(), (at, joint))
            self.assertEqual(int(row["flags"]), cache["flags"][at])
        self.assertEqual(len(table), len(frames) * len(limbs) * len(characters))

    def test_zarr_reads_what_solve_reads_from_the_library(self):
        """`swivel solve` reads its table's rotations by swivel_read, from crowds that know no cache."""
        targets = self.folder / "targets.csv"
        clip = short_clip(self.folder / "clip.bvh", 20)
        self.swivel("solve", clip, "--limbs", "all", "--export-targets", "all.csv", "--quiet")
        rows = (self.folder / "all.csv").read_text().splitlines()
        kept = [row for row in rows[1:] if row.startswith(("3,", "11,")) and "right" in row]
        targets.write_text("\n".join(rows[:1] + kept) + "\n")
        for name, toml, words in (("plain", "", ()), ("state", STATE, ()),
                                  ("given", LIMITED, ("--targets", targets, "--between", "hold"))):
            with self.subTest(crowd=name):
                folder = self.fill(self.store(name, *words, clip=clip, toml=toml, characters=45, frames=20, chunk="8,16"))
                options = ["--crowd", "crowd.toml"] if toml else []
                options += words[0:4] if name == "given" else []
                self.swivel("solve", clip, "--characters", 45, "--out", "solved.csv", "--quiet", *options)
                cache = opened(folder)
                limbs = LIMBS if toml else LIMBS[:2]
                self.assertEqual(cache["shoulder"].shape, (20, len(limbs), 45, 4))
                values = {name: cache[name][:] for name in ("shoulder", "elbow", "wrist", "flags") if name in cache}
                self.assert_table(values, table_of(self.folder / "solved.csv"), limbs, range(20), range(45))
                self.swivel("replay", folder, "--frames", "5:17", "--characters", "10:40", "--out", "part.csv", "--quiet")
                part = table_of(self.folder / "part.csv")
                self.assertEqual({key[1:] for key in part}, {(frame, who) for frame in range(5, 17) for who in range(10, 40)})
                self.assert_table(values, part, limbs, range(5, 17), range(10, 40))

    def test_digests_are_those_that_the_page_describes(self):
        """Of goals, state and attributes, by xxHash. `swivel check` proves those of results."""
        self.swivel("solve", CLIP, "--limbs", "all", "--export-targets", "targets.csv", "--quiet")
        folder = self.fill(self.store("cache", "--targets", "targets.csv", toml=WHOLE, characters=75, frames=23))
        cache, numbers, count = opened(folder), [], 0
        for name, digests in arrays_of(cache["goal_digest"]).items():
            for place in np.argwhere(digests[:]):
                self.assertEqual(digests[tuple(place)], digest_of((folder / name / ".".join(map(str, place))).read_bytes()), (name, place))
                count += 1
            numbers.append(digests[:].tobytes())
        self.assertGreater(count, 40)
        self.assertEqual(cache.attrs["goals_digest"], f"{digest_of(b''.join(numbers)):016x}")
        state = {name: cache[f"state/{name}"].ndim for name in (field.name.lower() for field in Field if field >= Field.SHOULDER) if f"state/{name}" in cache}
        self.assertGreater(len(state), 2)
        for (time, column), digest in np.ndenumerate(cache["state/digest"][:]):
            chunks = [(folder / "state" / name / ".".join([f"{time}.0.{column}", *"0" * (dimensions - 3)])).read_bytes() for name, dimensions in state.items()]
            self.assertEqual(digest, digest_of(np.array([digest_of(chunk) for chunk in chunks], "<u8").tobytes()), (time, column))
        text = re.sub(r'("(?:[^"\\]|\\.)*")|\s+', lambda match: match[1] or "", (folder / ".zattrs").read_text())
        before, digest = re.fullmatch(r'(.*),"digest":"([0-9a-f]{16})"\}', text).groups()
        self.assertEqual(digest, f"{digest_of((before + '}').encode()):016x}")

    def test_edges_of_chunks_are_empty(self):
        cache = self.fill(self.store("cache", toml=LIMITED, characters=20, frames=10))
        edge = np.fromfile(cache / "shoulder/1.0.0.0", "<f4").reshape(8, 4, 32, 4)
        self.assertTrue(np.isnan(edge[2:]).all() and np.isnan(edge[:, :, 20:]).all() and not np.isnan(edge[:2, :, :20]).any())


class Documentation(Stage):
    def test_programs_run(self):
        """The page's programs, in a folder with the cache that they read."""
        text = (ROOT / "docs/cache.md").read_text(encoding="utf-8")
        programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertGreaterEqual(len(programs), 2)
        self.swivel("store", CLIP, "crowd.cache", "--characters", 100, "--limbs", "all", "--frames", 20, "--quiet")
        self.swivel("fill", "crowd.cache", "--quiet")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        names = {}
        for program in programs:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                exec(program, names)
        self.assertEqual(names["crowd"]["shoulder"].shape, (20, 4, 100, 4))

    def test_the_schema_is_the_cache(self):
        """Every array of the page is in a cache that has everything, with its type and dimensions, and the other way round."""
        text = (ROOT / "docs/cache.md").read_text(encoding="utf-8")
        rows = {name: (kind, dimensions) for name, kind, dimensions in re.findall(r"^\| `([a-z_/]+)` \| `\\?([<|][a-z]\d)` \| ([a-z_, ]+) \|", text, re.M)}
        self.swivel("solve", CLIP, "--export-targets", "targets.csv", "--limbs", "all", "--quiet")
        folder = self.store("cache", "--targets", "targets.csv", toml=WHOLE, characters=20, frames=4, chunk="2,16")
        found = arrays_of(opened(folder))
        self.assertEqual({name for name in found if not name.startswith(("state/", "goal_digest/"))}, {name for name in rows if not name.startswith("state/")})
        for name, (kind, dimensions) in rows.items():
            with self.subTest(array=name):
                self.assertEqual((found[name].dtype.str, found[name].attrs["_ARRAY_DIMENSIONS"]), (kind, dimensions.split(", ")))


if __name__ == "__main__":
    unittest.main()
