# SPDX-License-Identifier: MIT
"""Makes hostile caches out of a good one: mutations of its files, with digests that fit again where that leads deeper. Digests are
XXH3 by libxxhash itself."""
import ctypes
import json
import math
import os
import random
import re
import shutil
import socket
import struct

XXHASH = ctypes.CDLL("libxxhash.so.0")
XXHASH.XXH3_64bits.restype = ctypes.c_uint64
XXHASH.XXH3_64bits.argtypes = (ctypes.c_char_p, ctypes.c_size_t)

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[][{}:,]|[^][{}:,\s"]+')
EVIL = ("0", "1", "2", "15", "17", "-1", "256", "65536", "1048576", "1073741824", "2147483647", "2147483648", "4294967295", "4294967296",
        "9223372036854775808", "18446744073709551615", "1e+30", "1.5", "null", "true", '"x"', "[]", "{}", "[[[[[[[[[[[[]]]]]]]]]]]]")
SIZES = ("frames", "characters", "chunk_frames", "chunk_characters", "clip_frames", "budget_blocks")
MOST_SPARSE = 64 << 20  # bytes that the maker itself reads


def digest_of(content):
    return XXHASH.XXH3_64bits(content, len(content)) or 1


def reseal_attributes(path, change=lambda tokens: None):
    """Changes the attributes' tokens and gives them a digest that fits: of the text without blanks and without the digest."""
    tokens = TOKEN.findall(path.read_text())
    at = len(tokens) - 5  # , "digest" : "..." }
    assert tokens[at + 1] == '"digest"', tokens[at:]
    del tokens[at:at + 4]
    change(tokens)
    digest = digest_of("".join(tokens).encode())
    tokens[-1:] = [",", '"digest"', ":", f'"{digest:016x}"', "}"]
    path.write_text("".join(tokens))


def reseal_goals(cache):
    """Digests of the goals as they are now."""
    numbers = b""
    for description in sorted((cache / "goal_digest").rglob(".zarray"), key=lambda path: str(path.parent)):
        name = description.parent.relative_to(cache / "goal_digest")
        counts = json.loads(description.read_text())["shape"]
        if math.prod(counts) > 1 << 16:
            return
        of_array = b""
        for index in range(math.prod(counts)):
            place = []
            for count in reversed(counts):
                index, rest = divmod(index, count)
                place.insert(0, str(rest))
            chunk = cache / name / ".".join(place)
            of_array += struct.pack("<Q", digest_of(chunk.read_bytes()) if chunk.is_file() and chunk.stat().st_size <= MOST_SPARSE else 0)
        (description.parent / ".".join("0" for _ in counts)).write_bytes(of_array)
        numbers += of_array

    def change(tokens):
        tokens[tokens.index('"goals_digest"') + 2] = f'"{digest_of(numbers):016x}"'
    reseal_attributes(cache / ".zattrs", change)


def describe(cache):
    """Gives all arrays the shapes that the attributes ask for, and the goals' chunks the sizes."""
    attributes = json.loads((cache / ".zattrs").read_text())
    sizes = [attributes[name] for name in SIZES[:5]]
    if not all(isinstance(size, int) and 0 < size < 1 << 40 for size in sizes):
        return
    frames, characters, chunk_frames, chunk_characters, clip_frames = sizes
    times, columns = -(-frames // chunk_frames), -(-characters // chunk_characters)
    whole = {"frame": (frames, chunk_frames), "character": (characters, chunk_characters), "clip_frame": (clip_frames, clip_frames),
             "block": (-(-characters // 16), chunk_characters // 16), "chunk": (times, 1), "column": (columns, 1)}
    for description in cache.rglob(".zarray"):
        array = json.loads(description.read_text())
        for n, name in enumerate(json.loads((description.parent / ".zattrs").read_text())["_ARRAY_DIMENSIONS"]):
            if name in whole:
                array["shape"][n], array["chunks"][n] = whole[name]
            elif name.removesuffix("_chunk") in whole:
                length, chunk = whole[name.removesuffix("_chunk")]
                array["shape"][n] = array["chunks"][n] = -(-length // chunk) if chunk else 0
        description.write_text(json.dumps(array))
        size = math.prod(array["chunks"]) * int(array["dtype"][2])
        if size < MOST_SPARSE and (cache / "goal_digest" / description.parent.relative_to(cache)).is_dir():
            for chunk in description.parent.glob("[0-9]*"):
                os.truncate(chunk, size)


class Maker:
    """One hostile cache, by a seed. cache: to be changed. outside: a folder that no command may touch."""

    def __init__(self, cache, outside, seed, is_packed):
        self.cache, self.outside, self.is_packed, self.choose = cache, outside, is_packed, random.Random(seed)
        self.said = []

    def any_of(self, folders):
        """A file or folder of the cache that is still one, by its name."""
        found = [path for path in sorted(self.cache.rglob("*")) if not path.is_symlink() and (path.is_dir() if folders else path.is_file())]
        return self.choose.choice(found) if found else None

    def away(self, path):
        """What is at the path goes outside, with all that it holds."""
        to = self.outside / f"{len(list(self.outside.iterdir()))}-{path.name}"
        shutil.move(path, to)
        return to

    def link(self, folders):
        path = self.any_of(folders)
        self.said.append(f"link {path}")
        to = self.away(path) if self.choose.random() < 0.7 else self.choose.choice(list(self.outside.rglob("*")))
        if path.is_dir():
            shutil.rmtree(path)
        path.unlink(missing_ok=True)
        path.symlink_to(os.path.relpath(to, path.parent) if self.choose.random() < 0.3 else to)

    def trap(self):
        """A link or a pipe where commands write or remove."""
        folder = self.cache / self.choose.choice(("shoulder", "elbow", "flags", "digest", "state", "clip", "goal_digest"))
        if not folder.is_dir() or folder.is_symlink():
            return
        path = folder if self.choose.random() < 0.4 else folder / self.choose.choice(("0.0", "1.1", "0.0.0.0", "1.0.1.0", "1.0.0", ".swivel-1-0", "clip"))
        self.said.append(f"trap {path}")
        if path.is_dir():
            path.symlink_to(self.away(path))
            return
        path.unlink(missing_ok=True)
        if self.choose.random() < 0.4:
            os.mkfifo(path)
        else:
            path.symlink_to(self.outside / self.choose.choice(("file", "folder", "nothing")))

    def other_kind(self):
        path = self.any_of(self.choose.random() < 0.2)
        shutil.rmtree(path) if path.is_dir() else path.unlink()
        kind = self.choose.choice(("fifo", "fifo", "folder", "socket", "loop", "file"))
        self.said.append(f"{kind} {path}")
        if kind == "fifo":
            os.mkfifo(path)
        elif kind == "folder":
            path.mkdir()
        elif kind == "loop":
            path.symlink_to(path.name)
        elif kind == "file":
            path.write_bytes(b"\0" * 8)
        else:
            with socket.socket(socket.AF_UNIX) as made:
                try:
                    made.bind(str(path))
                except OSError:  # the path is too long for a socket
                    os.mkfifo(path)

    def bytes_(self):
        path = self.any_of(False)
        if path.stat().st_size > MOST_SPARSE:
            return
        content = bytearray(path.read_bytes()) or bytearray(b"0")
        for _ in range(self.choose.randint(1, 4)):
            at = self.choose.randrange(len(content))
            kind = self.choose.randrange(4)
            if kind == 0:
                content[at] ^= 1 << self.choose.randrange(8)
            elif kind == 1:
                content[at] = self.choose.randrange(256)
            elif kind == 2:
                del content[at:at + self.choose.randint(1, 9)]
                content = content or bytearray(b"0")
            else:
                content[at:at] = self.choose.randbytes(self.choose.randint(1, 9))
        if self.choose.random() < 0.2:
            content = content[:self.choose.randrange(len(content) + 1)]
        self.said.append(f"bytes {path}")
        path.write_bytes(content)

    def long_file(self):
        path = self.any_of(False)
        size = self.choose.choice((1 << 20, 1 << 26, 1 << 31, 1 << 33))
        self.said.append(f"{size} bytes {path}")
        os.truncate(path, size)

    def garbage_json(self):
        path = self.choose.choice(sorted(path for path in self.cache.rglob(".z*") if path.is_file() and not path.is_symlink()))
        text = path.read_text(errors="replace")
        made = self.choose.randrange(5)
        if made == 0:
            text = "[" * self.choose.choice((10, 1000, 1_000_000))
        elif made == 1:
            depth = self.choose.choice((7, 12, 100_000))
            text = text.replace("{", '{"a": ' + "[" * depth + "]" * depth + ", ", 1)
        elif made == 2:
            text = "[" + "[]," * 1_000_000 + "0]"
        else:
            tokens = TOKEN.findall(text)
            for _ in range(self.choose.randint(1, 3)):
                tokens[self.choose.randrange(len(tokens))] = self.choose.choice(EVIL)
            text = "".join(tokens)
        self.said.append(f"json {path} {made}")
        path.write_text(text)

    def wrong_name(self):
        path = self.any_of(self.choose.random() < 0.2)
        name = self.choose.choice(("0.0", "00.0", "-1.0", "9999999999.0", "18446744073709551616.0", "0.0.0.0.0", "", ".", ".swivel-1-0", ".swivel-1-x",
                                   ".zarray", ".zgroup", "x" * 255)) or os.fsdecode(b"\xff\xfe")
        to = path.parent / name
        self.said.append(f"name {path} {name!r}")
        if name == ".":
            (path.parent / ".swivel-12-3").symlink_to(self.outside)
        elif not os.path.lexists(to):
            path.rename(to)

    def number(self):
        """A number of the attributes, whose digest fits."""
        path = self.cache / ".zattrs"
        name, value = None, self.choose.choice(EVIL)

        def change(tokens):
            nonlocal name
            names = [n for n, token in enumerate(tokens) if tokens[n + 1:n + 2] == [":"] and tokens[n + 2] not in "[{"]
            lists = [n for n, token in enumerate(tokens) if re.match(r"[-0-9n]", token) and tokens[n - 1] in ",["]
            at = self.choose.choice(names) + 2 if self.choose.random() < 0.7 else self.choose.choice(lists)
            name = tokens[at - 2]
            tokens[at] = value
        reseal_attributes(path, change)
        self.said.append(f"number {name} {value}")

    def size(self):
        """A size, which the arrays' descriptions and the goals' files follow."""
        name, value = self.choose.choice(SIZES), self.choose.choice(EVIL)
        if name in ("frames", "characters") and value in ("65536", "1048576"):
            value = "1073741824"  # a crowd of the others' size is in order, and takes its time

        def change(tokens):
            tokens[tokens.index(f'"{name}"') + 2] = value
        reseal_attributes(self.cache / ".zattrs", change)
        self.said.append(f"size {name} {value}")
        if self.choose.random() < 0.8:
            describe(self.cache)
            if not self.is_packed:
                reseal_goals(self.cache)

    def goals(self):
        """Numbers of the goals, whose digests fit."""
        chunks = [path for group in ("clip", "character", "given", "chosen") for path in sorted((self.cache / group).rglob("[0-9]*")) if path.is_file()]
        path = self.choose.choice(chunks)
        content = bytearray(path.read_bytes())
        for _ in range(self.choose.randint(1, 50)):
            at = 4 * self.choose.randrange(max(len(content) // 4, 1))
            content[at:at + 4] = self.choose.choice((b"\xff" * 4, b"\0\0\x80\x7f", b"\0\0\xc0\x7f", self.choose.randbytes(4)))[:len(content) - at]
        path.write_bytes(content)
        self.said.append(f"goals {path}")
        reseal_goals(self.cache)

    def make(self):
        first = [self.number, self.size] + ([self.goals] if not self.is_packed and (self.cache / "clip").is_dir() else [])
        others = (self.trap, self.trap, lambda: self.link(False), lambda: self.link(True), self.other_kind, self.bytes_, self.long_file, self.garbage_json, self.wrong_name)
        if self.choose.random() < 0.5:
            self.choose.choice(first)()
        for _ in range(self.choose.randint(0 if self.said else 1, 2)):
            self.choose.choice(others)()
        return self.said


def make(*arguments):
    """Makes a hostile cache, and says how."""
    return Maker(*arguments).make()
