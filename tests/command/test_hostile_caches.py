# SPDX-License-Identifier: MIT
"""The promise: whatever a cache holds, no command on it ends by a signal, hangs, takes more memory than it may, or changes a byte outside
the cache.

    test_hostile_caches.py                       150 hostile caches
    test_hostile_caches.py --full                10,000
    test_hostile_caches.py --count N --seed S    N of them, from seed S on"""
import collections
import os
import random
import re
import shutil
import sys

from stage import EVIL, LIMITED, TOKEN, WHOLE, Stage, argument, check_all, command_with_page, digest_of, measured, unittest

MEMORY = 1024 + 128  # MiB: what a cache may take, and beside it attributes of 4 MiB as JSON
COUNT = argument("--count", 10_000 if "--full" in sys.argv else 150)


class Maker:
    """Makes a good cache hostile, by a seed. outside: a folder that no command may touch."""

    def __init__(self, cache, outside, seed):
        self.cache, self.outside, self.choose, self.said = cache, outside, random.Random(seed), []
        makes = (self.evil, self.evil, self.sealed, self.sealed, self.bytes_, self.long_file, self.link, self.link, self.pipe, self.trap)
        for _ in range(self.choose.randint(1, 3)):
            make = self.choose.choice(makes)
            path = self.any_of(make)
            if path:
                make(path)
                self.said.append(f"{make.__name__} {path.relative_to(cache)}")

    def any_of(self, make):
        found = [path for path in sorted(self.cache.rglob("*")) if not path.is_symlink() and (path.is_file() and path.stat().st_size <= 1 << 20 or path.is_dir() and make == self.link)]
        if make == self.sealed:
            found = [path for path in found if path == self.cache / ".zattrs"]
        if make == self.evil:
            found = [path for path in found if path.name.startswith(".z")]
        return self.choose.choice(found) if found else None

    def evil(self, path):
        tokens = TOKEN.findall(path.read_text(errors="replace"))
        tokens[self.choose.randrange(len(tokens))] = self.choose.choice(EVIL)
        path.write_text("".join(tokens))

    def sealed(self, path):
        """Another number among the attributes, and a digest that fits: of the text without blanks and without the digest."""
        text = "".join(TOKEN.findall(path.read_text(errors="replace")))
        text = re.sub(r',"digest":"[0-9a-f]{16}"}$', "}", text)
        numbers = list(re.finditer(r"(?<=[:,\[])-?\d[\d.e+-]*", text))
        if not numbers:
            return
        at = self.choose.choice(numbers)
        content = (text[:at.start()] + self.choose.choice(EVIL) + text[at.end():]).encode()
        path.write_bytes(content[:-1] + f',"digest":"{digest_of(content):016x}"}}'.encode())

    def bytes_(self, path):
        content = bytearray(path.read_bytes()) or bytearray(b"0")
        at = self.choose.randrange(len(content))
        self.choose.choice((lambda: content.insert(at, 7), lambda: content.pop(at), lambda: content.__setitem__(at, content[at] ^ 1)))()
        path.write_bytes(content)

    def long_file(self, path):
        os.truncate(path, self.choose.choice((1 << 20, 1 << 31, 1 << 33)))

    def link(self, path):
        to = shutil.move(path, self.outside / f"{len(list(self.outside.iterdir()))}-{path.name}")
        path.symlink_to(self.choose.choice((to, self.outside / "nothing", path)))

    def pipe(self, path):
        path.unlink()
        self.choose.choice((os.mkfifo, os.mkdir))(path)

    def trap(self, path):
        """Something where commands write or remove."""
        to = path.parent / self.choose.choice(("1.1", "1.0.1.0", "1.0.0", ".swivel-1-0"))
        if not os.path.lexists(to):
            self.choose.choice((os.mkfifo, lambda new: new.symlink_to(self.outside / "file")))(to)


def kept(folder):
    """All that is in a folder: kinds, sizes, times of writing, and where links lead. Some files are sparse and huge."""
    found = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        found[str(path.relative_to(folder))] = (status.st_mode, status.st_size, status.st_mtime_ns, os.readlink(path) if path.is_symlink() else None)
    return found


class Hostile(Stage):
    def setUp(self):
        super().setUp()
        self.program = command_with_page(self.folder)
        shape = dict(characters=20, frames=6, chunk="2,16")
        self.bases = [self.store("plain", **shape), self.fill(self.store("limited", toml=LIMITED, **shape)), self.fill(self.store("state", toml=WHOLE, **shape)),
                      self.fill(self.store("goals", "--no-poses", **shape)), self.fill(self.store("boxes", toml="[carry]\n", **shape))]
        self.codes = collections.Counter()

    def try_one(self, seed):
        """Faults of one hostile cache, as texts."""
        place = self.folder / str(seed)
        outside, work = place / "outside", place / "work"
        shutil.copytree(self.bases[seed % len(self.bases)], work / "cache")
        outside.mkdir()
        (outside / "file").write_bytes(b"not swivel's")
        made = Maker(work / "cache", outside, seed)
        before, faults = kept(outside), []
        for words in (("replay", "cache", "--out", "out.csv"), ("view", "cache"), ("check", "cache"), ("fill", "cache"), ("check", "cache")):
            code, _, text, used = measured(self.program, (*words, "--threads", "2", "--quiet"), work)
            self.codes[words[0], code] += 1
            if code not in (0, 1) or (code == 1 and not (text.startswith(b"swivel: ") and text.count(b"\n") == 1 and len(text) < 2000)):
                faults.append(f"{words}: exit code {code}: {text[-300:]}")
            if used > MEMORY:
                faults.append(f"{words}: {used:.0f} MiB")
            if kept(outside) != before:
                faults.append(f"{words}: the outside has changed")
        left = sorted(set(os.listdir(work)) - {"cache", "cache.html", "out.csv"})
        if left:
            faults.append(f"left behind: {left}")
        shutil.rmtree(place)
        return [f"seed {seed}, {'; '.join(made.said)}: {fault}" for fault in faults]

    def test_hostile_caches(self):
        check_all(self, "hostile caches", self.try_one, COUNT, self.codes)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
