#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks swivel on purpose, one mutation of mutations.toml at a time, and checks that the named test then fails.

The script copies the tree, with uncommitted changes, to a folder of its own, and changes only the copy. It builds the kernels at
-O1, for one lane, and also for SSE2 if a mutation asks for it. First, every named test must pass on the unchanged copy. Then the script
applies each mutation, builds only what its test runs, and the test must fail. These are failures: a pattern that its file does not
have exactly once, a mutant that does not compile, and a mutant that its test lets pass.
"""
import argparse
import fcntl
import re
import subprocess
import sys
import time
import tomllib
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
LONGEST_TEST = 120  # seconds; the slowest of the tests takes a tenth of that


class Failure(Exception):
    """Nothing can be said of any mutation."""


def locked(work):
    """A file that keeps others out of the folder as long as it is open."""
    lock = open(work / "lock", "w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise Failure(f"another run is at work in {work}; wait for it, or give --work another folder") from None
    return lock


def copy_tree(tree):
    """Makes the tree what git tracks, and will track, as it is now. Files that are right stay untouched, so little is rebuilt."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=SOURCE,
                            capture_output=True, text=True)
    if listed.returncode != 0:
        raise Failure(f"git cannot list the tree: {listed.stderr.strip()}")
    wanted = {name for name in listed.stdout.split("\0") if name and (SOURCE / name).is_file()}
    for old in tree.rglob("*"):
        if not old.is_dir() and str(old.relative_to(tree)) not in wanted:
            old.unlink()
    for name in wanted:
        source, copy = SOURCE / name, tree / name
        if not copy.is_file() or copy.read_bytes() != source.read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(source.read_bytes())
        copy.chmod(source.stat().st_mode)
    packages = Path("tests/gltf/node_modules")  # git ignores them, and tests of glTF judge by them
    if not (tree / packages).is_symlink():
        (tree / packages).symlink_to(SOURCE / packages)


class Build:
    """A build of the copy for one instruction set, and the tests in it."""

    def __init__(self, folder, tree, isa, with_python):
        self.folder = folder
        options = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_CXX_FLAGS_RELEASE": "-O1", "CMAKE_C_FLAGS_RELEASE": "-O1",
                   "SWIVEL_ISAS": isa, "SWIVEL_PYTHON_MODULE": "ON" if with_python else "OFF"}
        configured = subprocess.run(["cmake", "-S", tree, "-B", folder, "-G", "Ninja", *(f"-D{k}={v}" for k, v in options.items())],
                                    capture_output=True, text=True)
        if configured.returncode != 0:
            raise Failure(f"the copy of the tree cannot be configured:\n{configured.stdout}{configured.stderr}")
        # What CTest itself reads: it lists no commands of tests that are not built.
        self.commands = {}
        for file in folder.rglob("CTestTestfile.cmake"):
            for name, command in re.findall(r'^add_test\((?:\[=*\[)?(.+?)(?:\]=*\])? "([^"]+)"', file.read_text(), re.MULTILINE):
                self.commands[name] = Path(command)

    def targets(self, mutation):
        """What must be built for a mutation's test: its executable, however that is called now."""
        if mutation["killed_by"] not in self.commands:
            raise Failure(f"there is no test {mutation['killed_by']}, which shall kill: {mutation['name']}")
        command = self.commands[mutation["killed_by"]]
        built = [str(command.relative_to(self.folder))] if command.is_relative_to(self.folder) else []
        return built + mutation.get("build", [])

    def build(self, targets):
        """The compiler's words if that fails; else nothing. Without a target there is nothing to build: a script builds what it tests."""
        if not targets:
            return ""
        done = subprocess.run(["cmake", "--build", self.folder, "--target", *targets, "--", "--quiet"], capture_output=True,
                              text=True)
        return "" if done.returncode == 0 else done.stdout + done.stderr or "the build failed"

    def run(self, tests):
        """How each test ended: passed, or where it failed first, or how else it ended."""
        names = "|".join(re.escape(name) for name in tests)
        said = subprocess.run(["ctest", "--test-dir", self.folder, "-R", f"^({names})$", "--timeout", str(LONGEST_TEST),
                               "--output-on-failure"], capture_output=True, text=True, errors="replace").stdout
        lines = re.findall(r"^ *\d+/\d+ Test +#\d+: (\S+) \.+ *(?:\*\*\*)?(.+?) +[\d.]+ sec", said, re.MULTILINE)
        return {name: first_place(said) if ending == "Failed" else ending.replace("***", ", ").lower() for name, ending in lines}


def first_place(said):
    for place in (r"(test_[\w.]+:\d+): FAILED", r"(test_[\w.]+:\d+)", r"^(?:FAIL|ERROR): (\w+)"):  # Catch, RapidCheck, Python
        if found := re.search(place, said, re.MULTILINE):
            return found.group(1)
    return "failed"


def verdict_on(mutation, tree, build):
    """Applies a mutation, asks its test, and takes it back. The word that counts comes first."""
    file = tree / mutation["file"]
    text = file.read_text() if file.is_file() else ""
    find, replace = mutation["find"].lstrip("\n"), mutation["replace"].lstrip("\n")
    if text.count(find) != 1:
        return f"does not match: the text stands {text.count(find)} times in {mutation['file']}"
    test = mutation["killed_by"]
    file.write_text(text.replace(find, replace))
    try:
        error = build.build(build.targets(mutation))
        if error:
            print(error, file=sys.stderr)
            return "does not compile"
        ending = build.run([test]).get(test, "not run")
    finally:
        file.write_text(text)
    if ending in ("passed", "not run"):
        return f"SURVIVED: {test} {ending}"
    return f"killed by {test}, {ending}"


def must_pass(build, mutations):
    """Builds the tests and runs them before anything is broken."""
    targets = sorted({target for mutation in mutations for target in build.targets(mutation)})
    error = build.build(targets)
    if error:
        raise Failure(f"the tree does not compile as it is:\n{error}")
    tests = {mutation["killed_by"] for mutation in mutations}
    endings = build.run(tests)
    for test in sorted(tests):
        if (ending := endings.get(test, "not run")) != "passed":
            raise Failure(f"{test} does not pass as it is: {ending}")


def mutations_like(patterns):
    with open(Path(__file__).with_name("mutations.toml"), "rb") as file:
        every = tomllib.load(file)["mutation"]
    for pattern in patterns:
        if not any(pattern.lower() in mutation["name"].lower() for mutation in every):
            raise Failure(f"no mutation's name has '{pattern}' in it; see --list")
    return [m for m in every if not patterns or any(pattern.lower() in m["name"].lower() for pattern in patterns)]


def run_all(mutations, work):
    """Yields each mutation with its verdict and the seconds it took."""
    tree = work / "tree"
    tree.mkdir(parents=True, exist_ok=True)
    lock = locked(work)  # noqa: F841
    copy_tree(tree)
    number = 0
    for isa in dict.fromkeys(mutation.get("isa", "scalar") for mutation in mutations):
        mine = [mutation for mutation in mutations if mutation.get("isa", "scalar") == isa]
        begin = time.monotonic()
        build = Build(work / isa, tree, isa, any("swivel_python" in mutation.get("build", []) for mutation in mine))
        must_pass(build, mine)
        print(f"-- {isa}: all tests pass as long as nothing is broken, {time.monotonic() - begin:.0f} s", flush=True)
        for mutation in mine:
            number += 1
            print(f"[{number}/{len(mutations)}] {mutation['name']}: ", end="", flush=True)
            begin = time.monotonic()
            verdict = verdict_on(mutation, tree, build)
            seconds = time.monotonic() - begin
            print(f"{verdict}, {seconds:.0f} s", flush=True)
            yield mutation, verdict, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="PATTERN", action="append", default=[], help="those with this in their name; may be repeated")
    parser.add_argument("--list", action="store_true", help="name the mutations, and their tests, and do nothing")
    parser.add_argument("--work", type=Path, default=SOURCE / "build" / "mutations", help="the folder to work in (%(default)s)")
    arguments = parser.parse_args()
    begin = time.monotonic()
    try:
        mutations = mutations_like(arguments.only)
        if arguments.list:
            for mutation in mutations:
                print(f"{mutation['name']}: {mutation['killed_by']}")
            return 0
        results = list(run_all(mutations, arguments.work.resolve()))
    except Failure as failure:
        print(f"run.py: {failure}", file=sys.stderr)
        return 1
    killed = sum(verdict.startswith("killed") for _, verdict, _ in results)
    print("".join(f"\n{mutation['name']}: {verdict}" for mutation, verdict, _ in results if not verdict.startswith("killed")))
    print(f"{killed} of {len(results)} mutations killed, {time.monotonic() - begin:.0f} s")
    return killed != len(results)


if __name__ == "__main__":
    sys.exit(main())
