# SPDX-License-Identifier: MIT
"""The promise: whatever files and options hold, no command ends by a signal, hangs, takes more memory than it may, writes a number that is
none, or leaves anything behind when it fails.

    test_hostile_files.py                       300 command lines, each with a file or an option made hostile
    test_hostile_files.py --full                10,000
    test_hostile_files.py --count N --seed S    N of them, from seed S on; --keep FOLDER keeps what a fault was found in"""
import collections
import json
import random
import re
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np

from stage import EVIL, ROOT, SWIVEL, TOKEN, Stage, argument, bvh, check_all, command_with_page, files_of, measured, unittest

FIGURE, HILLS = Path(SWIVEL).parent.parent / "share/swivel/figure.glb", ROOT / "examples/hills.png"
MEMORY = 2048  # MiB
COUNT = argument("--count", 10_000 if "--full" in sys.argv else 300)

MILD = ("0", "-1", "1.5", "90", "-180", "7", "1e-6", "-1e6", "12")
NUMBERS = EVIL[:12] + ("nan", "-inf", "1e300", "-1e38", "1e-40", "-0.0", "90", "-180", "0x1p3", "")
WORDS = NUMBERS + ("-", ".", "nowhere/out", "x" * 1000, "left:", "#0", "#-1", "#99999", "Hips", "\u202e", "a,b,c", "source:left:a,b,c", "0,0,0")
TOML = """[crowd]
characters = 5
limbs = "all"
size = [0.8, 1.2]
loop = "auto"
[limb.arms]
limits.flexion_deg = [5, 150]
limits.shoulder_cone = { axis = [0, 0, 1], opening_deg = 80 }
swivel.max_deg_per_frame = 4
[look]
target = [60, 15, 160]
[ground]
heights = "hills.png"
size = [900, 60, 900]
contacts = "contacts.csv"
"""
AGENTS = """name,x,y,z,heading_deg,start,clip,size,build
Anna,0,0,0,90,0,0,1,0
Ben,2,0,-3,-45,9,0,0.95,0
"""
OPTIONS = ("--clip=0", "--fps=30", "--rest=3", "--up=y", "--arm=left:a,b,c", "--leg=right:#1,#2,#3", "--head=target:Head", "--limbs=legs", "--characters=3",
           "--seed=7", "--frames=9", "--speed=1", "--height=0.1", "--ground=hills.png", "--ground-size=900,60,900", "--between=linear", "--force", "--chunk=2,2",
           "--targets=targets.csv", "--contacts=contacts.csv", "--map=map.csv", "--threads=1")
TRIES = [  # the words of a command line; those that name an output begin with out
    *(("rig", clip, "--joints") for clip in ("clip.bvh", "along_x.bvh", "figure.glb")),
    *(("retarget", source, target, "--out", f"out{Path(target).suffix}") for source in ("clip.bvh", "along_x.bvh", "figure.glb") for target in ("clip.bvh", "along_x.bvh", "figure.glb")),
    ("inspect", "figure.glb", "--fps", "60"), ("inspect", "clip.bvh", "along_x.bvh"),
    ("retarget", "clip.bvh", "figure.glb", "--map", "map.csv", "--out", "out.glb"),
    ("retarget", "clip.bvh", "along_x.bvh", "figure.glb", "--root-motion", "--out", "out"),
    ("feet", "clip.bvh", "--root-motion", "--travel", "--out", "out.bvh"),
    ("feet", "clip.bvh", "--out", "out.bvh", "--export-contacts", "out.csv"), ("feet", "figure.glb", "--contacts", "contacts.csv", "--out", "out.glb"),
    ("feet", "along_x.bvh", "figure.glb", "--out", "out"),
    ("feet", "figure.glb", "--ground", "hills.png", "--ground-size", "9,1,9", "--out", "out.glb"),
    ("solve", "clip.bvh", "--crowd", "crowd.toml", "--out", "out.csv", "--export-targets", "out_targets.csv"), ("solve", "clip.bvh", "--targets", "targets.csv", "--out", "out.bvh"),
    ("solve", "figure.glb", "--crowd", "crowd.toml", "--out", "out.glb"), ("solve", "figure.glb", "--crowd", "agents.toml", "--out", "out.glb"),
    ("solve", "along_x.bvh", "--characters", "3", "--out", "out.csv"), ("solve", "along_x.bvh", "--view", "out.html"),
    ("view", "figure.glb", "--crowd", "crowd.toml", "--out", "out.html"), ("store", "along_x.bvh", "out", "--crowd", "crowd.toml"),
]


def make_inputs(folder, program):
    folder.mkdir()
    for name, along_x in (("clip.bvh", False), ("along_x.bvh", True)):
        (folder / name).write_text(bvh(along_x))
    shutil.copy(FIGURE, folder)
    shutil.copy(HILLS, folder)
    (folder / "crowd.toml").write_text(TOML)
    (folder / "agents.toml").write_text('[crowd]\nlimbs = "all"\nagents = "agents.csv"\n')
    (folder / "agents.csv").write_text(AGENTS)
    (folder / "targets.csv").write_text("frame,character,limb,x,y,z\n0,0,left_arm,4,12,3\n6,0,right_leg,-1,1,1\n")
    for words in (("feet", "clip.bvh", "--export-contacts", "contacts.csv"), ("retarget", "clip.bvh", "figure.glb", "--export-map", "map.csv", "--out", "o.glb")):
        subprocess.run([program, *words, "--quiet"], cwd=folder, check=True)
    (folder / "o.glb").unlink()


class Maker:
    """Makes one command line hostile, by a seed: a file that it reads, or its words."""

    def __init__(self, folder, words, seed):
        self.choose, self.words, self.said = random.Random(seed), list(words), []
        named = [folder / word for word in words if (folder / word).is_file()]
        named += [folder / more for more in ("hills.png", "contacts.csv") if "crowd.toml" in words]
        named += [folder / "agents.csv"] if "agents.toml" in words else []
        if self.choose.random() < 0.2:
            self.options()
            return
        path = self.choose.choice(named)
        makes = {".glb": (self.of_json, self.of_json, self.of_floats, self.bytes_), ".png": (self.of_png, self.of_png, self.bytes_)}
        for _ in range(self.choose.randint(1, 3)):
            make = self.choose.choice(makes.get(path.suffix, (self.numbers, self.numbers, self.numbers, self.bytes_)))
            make(path)
            self.said.append(f"{make.__name__} {path.name}")

    def options(self):
        name = self.choose.choice(OPTIONS)
        at = self.choose.randrange(1, len(self.words))
        change = self.choose.choice(("more", "more", "value", "other", "twice", "none"))
        if change in ("more", "other"):
            self.words.append(name if change == "more" else name.split("=")[0] + "=" + self.choose.choice(WORDS))
        elif change == "value":
            self.words[at] = self.choose.choice(WORDS)
        elif change == "twice":
            self.words.insert(at, self.words[at])
        else:
            del self.words[at]
        self.said.append(change)

    def numbers(self, path):
        """Other numbers: mostly such as a clip may have, else none that it may, or any word of the file."""
        parts = re.split(r"([^\s,=\[\]{}]+)", path.read_text(errors="replace"))
        numbers = [at for at in range(1, len(parts), 2) if re.fullmatch(r"[-+\d.e]+", parts[at])]
        if not numbers:
            return
        for _ in range(self.choose.choice((1, 3, 30))):
            parts[self.choose.choice(numbers)] = self.choose.choice(MILD)
        if self.choose.random() < 0.2:
            parts[self.choose.randrange(1, len(parts), 2)] = self.choose.choice(NUMBERS + (parts[self.choose.randrange(1, len(parts), 2)],))
        path.write_text("".join(parts))

    def bytes_(self, path):
        content = bytearray(path.read_bytes()) or bytearray(b"0")
        at = self.choose.randrange(len(content))
        self.choose.choice((lambda: content.insert(at, 7), lambda: content.pop(at), lambda: content.__setitem__(at, content[at] ^ 1), lambda: content.__delitem__(slice(at, None))))()
        path.write_bytes(content)

    def of_json(self, path):
        """Another token of a GLB's JSON, with lengths that fit."""
        content = path.read_bytes()
        length = struct.unpack_from("<I", content, 12)[0] if len(content) >= 20 else 0
        tokens = TOKEN.findall(content[20:20 + length].decode(errors="replace"))
        if not tokens:
            return
        tokens[self.choose.randrange(len(tokens))] = self.choose.choice(EVIL[:-1] + (self.choose.choice(tokens),))
        text = "".join(tokens).encode()
        text += b" " * (-len(text) % 4)
        rest = content[20 + length:]
        path.write_bytes(b"glTF" + struct.pack("<III", 2, 20 + len(text) + len(rest), len(text)) + b"JSON" + text + rest)

    def of_floats(self, path):
        """Other floats in a GLB's buffer: one, or a run of equal ones."""
        content = bytearray(path.read_bytes())
        start = 28 + struct.unpack_from("<I", content, 12)[0]
        if start + 4 > len(content):
            return
        at = self.choose.randrange(start, len(content) - 3, 4)
        value = struct.pack("<f", self.choose.choice((float("nan"), float("inf"), 3e38, -3e38, 1e-40, 0.0, 1.0, -1.0, 1e10)))
        for place in range(at, min(at + 4 * self.choose.choice((1, 1, 4, 100)), len(content) - 3), 4):
            content[place:place + 4] = value
        path.write_bytes(content)

    def of_png(self, path):
        """Another byte within a part of a PNG, with a checksum that fits."""
        content = bytearray(path.read_bytes())
        at = 8
        parts = []
        while at + 12 <= len(content):
            length = struct.unpack_from(">I", content, at)[0]
            if at + 12 + length > len(content):
                break
            parts.append((at, length))
            at += 12 + length
        if not parts:
            return
        at, length = self.choose.choice(parts)
        place = at + 8 + self.choose.randrange(max(length, 1))
        content[place] ^= 1 << self.choose.randrange(8)
        struct.pack_into(">I", content, at + 8 + length, zlib.crc32(content[at + 4:at + 8 + length]))
        path.write_bytes(content)


def floats_of_motion(content):
    """All floats of a GLB's animations."""
    length = struct.unpack_from("<I", content, 12)[0]
    gltf, data = json.loads(content[20:20 + length]), content[28 + length:]
    for animation in gltf.get("animations", ()):
        for sampler in animation["samplers"]:
            for accessor in (gltf["accessors"][sampler["input"]], gltf["accessors"][sampler["output"]]):
                if accessor["componentType"] == 5126 and "bufferView" in accessor and "sparse" not in accessor:
                    view = gltf["bufferViews"][accessor["bufferView"]]
                    count = accessor["count"] * {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
                    if view.get("byteStride") is None and view.get("buffer", 0) == 0:
                        yield np.frombuffer(data, "<f4", count, view.get("byteOffset", 0) + accessor.get("byteOffset", 0))


def numbers_are_finite(path):
    if path.suffix == ".glb":
        return all(np.isfinite(floats).all() for floats in floats_of_motion(path.read_bytes()))
    return path.suffix not in (".bvh", ".csv") or not re.search(rb"[\s,](-?nan|-?inf)\b", path.read_bytes())


class Hostile(Stage):
    def setUp(self):
        super().setUp()
        self.program = command_with_page(self.folder)
        make_inputs(self.folder / "inputs", self.program)
        for words in TRIES:
            shutil.copytree(self.folder / "inputs", self.folder / "good")
            code, _, complaint, _ = measured(self.program, words, self.folder / "good")
            self.assertEqual((code, complaint), (0, b""), words)
            shutil.rmtree(self.folder / "good")
        self.codes = collections.Counter()

    def faults_of(self, seed):
        """Faults of one hostile command line, as texts."""
        work = self.folder / str(seed)
        shutil.copytree(self.folder / "inputs", work)
        made = Maker(work, TRIES[seed % len(TRIES)], seed)
        before, faults = files_of(work), []
        code, out, complaint, used = measured(self.program, made.words, work)
        self.codes[made.words[0], code] += 1
        after = files_of(work)
        changed = sorted(name for name in {*before, *after} if before.get(name, b"") != after.get(name, b""))
        if code not in (0, 1, 2):
            faults.append(f"exit code {code}: {complaint[-300:]}")
        # Where one of several clips fails, the command goes on to the next. Each that fails has a line.
        several = complaint.endswith((b" clips failed\n", b" clips failed or are garbage\n"))
        if code == 1 and not several and not (complaint.startswith(b"swivel: ") and complaint.count(b"\n") == 1 and len(complaint) < 2000):
            faults.append(f"says {complaint[:300]} ... {complaint[-100:]}, {complaint.count(10)} lines")
        if used > MEMORY:
            faults.append(f"{used:.0f} MiB")
        if code and changed and not several:
            faults.append(f"fails, and changes {changed}")
        faults += [f"{name} is left" for name in changed if ".swivel-" in name]
        if code == 0:
            faults += [f"{name} has numbers that are none" for name in changed if after[name] is not None and not numbers_are_finite(work / name)]
            faults += [f"says {found}" for found in set(re.findall(rb"(?m)^(?!written)[^\n]*[ (]-?(?:nan|inf)\b[^\n]*", out))]
        if faults and "--keep" in sys.argv:
            shutil.copytree(work, Path(sys.argv[sys.argv.index("--keep") + 1]) / str(seed), dirs_exist_ok=True)
        shutil.rmtree(work)
        return [f"seed {seed}, {' '.join(made.words)[:300]}; {', '.join(made.said)}: {fault}" for fault in faults]

    def test_hostile_files_and_options(self):
        check_all(self, "hostile command lines", self.faults_of, COUNT, self.codes)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
