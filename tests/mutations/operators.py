#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws faults of the formulas and of the code around them, by a seed, and says which test sees each.

A fault exchanges an operator (+ and -, < and <=, == and !=, & and |), takes the second value of every select(), or leaves out a
statement. All are compiled once, into a copy of the tree for one lane, and chosen by an environment variable (mutant.h). Each test runs
once to find which faults it comes across. Then each fault is alive in these tests, the quickest first, until one fails. With --matrix all
of them run: the table says which tests see what no other sees. Faults that do not compile are left out. A test that runs into its time
limit decides nothing, because the machine may be busy: a fault with which no test fails, and some run out of time, is undecided.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import subprocess
import sys
import time
from pathlib import Path

from run import SOURCE, Build, Failure, copy_tree, locked

AREAS = {"library": (("core", "simd", "batch"), 400), "tools": (("tools/rig", "tools/feet", "tools/formats", "tools/crowd"), 100)}
SEED = 20261129
MOST = 4096  # as mutant.h has it
OPERATOR = re.compile(r"(?<=[\w)\]]) (\+|-|<=|>=|<|>|==|!=|&|\|) (?=[\w(-])")
STATEMENT = re.compile(r"^\s*(?!return\b|using\b|throw\b|delete\b|goto\b|else\b)(?:[\w.\[\]]|->|::)+(?: [-+*/|&^]?= [^;]*|\([^;]*\));$")
NO_CODE = re.compile(r"^\s*(#|template\b|using\b|static_assert\b|requires\b|friend\b|constexpr\b|inline constexpr\b|static constexpr\b)|operator")


def code_of(text):
    """The text with blanks for comments and for what stands in quotes."""
    blank = lambda found: re.sub(r"[^\n]", " ", found.group())  # noqa: E731
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', blank, text, flags=re.DOTALL)


def sites_in(path, text):
    """Each place as file, line, column, how many characters it replaces, and by what; {} becomes the fault's number."""
    before = "{"
    for number, line in enumerate(code_of(text).split("\n"), 1):
        if not NO_CODE.search(line):
            for found in OPERATOR.finditer(line):
                op = found.group(1)
                yield path, number, found.start(1), len(op), f"{op} swivel_mutants::Other{{{{{{}}}}}} {op}"
            for found in re.finditer(r"(?<![\w:])select\((?!const\b)", line):
                yield path, number, found.end(), 0, "swivel_mutants::Never{{{}}} && "
            if STATEMENT.match(line) and before[-1] in ";{})":
                yield path, number, len(line) - len(line.lstrip()), 0, "if (swivel_mutants::is_alive({})) {{}} else "
        before = line.strip() or before


def changed_lines(revision):
    """The lines that differ from a revision, by file."""
    lines, file = collections.defaultdict(set), ""
    said = subprocess.run(["git", "diff", "-U0", revision], cwd=SOURCE, capture_output=True, text=True, check=True).stdout
    for line in said.splitlines():
        if line.startswith("+++ b/"):
            file = line[6:]
        if found := re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line):
            first, count = int(found[1]), int(found[2] or 1)
            lines[file].update(range(first, first + count))
    return lines


def drawn(options):
    """The faults, in the order of their files."""
    changed = changed_lines(options.diff) if options.diff else None
    listed = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True, check=True).stdout.split()
    faults = []
    for folders, count in (AREAS[area] for area in options.area or AREAS):
        files = [name for name in listed if name.startswith(tuple(f"{folder}/" for folder in folders)) and name.endswith((".h", ".cpp"))]
        sites = [site for name in files for site in sites_in(name, (SOURCE / name).read_text()) if changed is None or site[1] in changed[name]]
        wanted = min(len(sites), options.count or (count if changed is None else len(sites)))
        faults += random.Random(options.seed).sample(sites, wanted)
    if len(faults) > MOST:
        raise Failure(f"{len(faults)} faults are more than mutant.h has room for, {MOST}; give --count")
    return sorted(faults)


def write_faults(tree, faults, dropped):
    """Writes all faults but the dropped ones into the copy."""
    by_file = collections.defaultdict(list)
    for number, fault in enumerate(faults):
        by_file[fault[0]].append((number, fault))
    for name, of_file in by_file.items():
        lines = (SOURCE / name).read_text().split("\n")
        for number, (_, line, column, length, text) in sorted(of_file, key=lambda each: each[1][1:3], reverse=True):
            if number not in dropped:
                old = lines[line - 1]
                lines[line - 1] = old[:column] + text.format(number) + old[column + length:]
        text = '#include "tests/mutations/mutant.h"\n' + "\n".join(lines)
        if (tree / name).read_text() != text:
            (tree / name).write_text(text)


def build_all(build, tree, faults):
    """Builds everything, and drops faults on lines of which the compiler complains. Returns those that it dropped."""
    dropped = set()
    for _ in range(12):
        write_faults(tree, faults, dropped)
        done = subprocess.run(["cmake", "--build", build.folder, "--", "-k", "0"], capture_output=True, text=True)
        if done.returncode == 0:
            return dropped
        blamed = {(str(Path(file).relative_to(tree)), int(line) - 1)
                  for file, line in re.findall(rf"({re.escape(str(tree))}/[^:\n]+):(\d+):\d+: ?(?:error|  ?required)", done.stdout)}
        more = {number for number, fault in enumerate(faults) if fault[:2] in blamed} - dropped
        if not more:
            raise Failure(f"the copy does not compile, whatever is left out:\n{done.stdout[-3000:]}")
        dropped |= more
    raise Failure("after twelve rounds the copy still does not compile")


def ending_of(build, test, seconds, **environment):
    """How a test ends: passed, failed or timed out."""
    done = subprocess.run(["ctest", "--test-dir", build.folder, "-R", f"^{re.escape(test)}$", "--timeout", str(int(10 * seconds + 20))],
                          env={**os.environ, **environment}, capture_output=True, text=True)
    if done.returncode == 0:
        return "passed"
    return "timed out" if "***Timeout" in done.stdout else "failed"


def tests_of_faults(build, work, faults):
    """The tests that come across each fault, the quickest first, with their seconds. Tests that fail without any fault are left out."""
    meeting = collections.defaultdict(list)
    met = work / "met"
    met.mkdir(exist_ok=True)
    tests = sorted(name for name, command in build.commands.items() if command.is_relative_to(build.folder))
    for test in tests:
        begin = time.monotonic()
        ending = ending_of(build, test, 60, SWIVEL_MUTANTS_MET=str(met / test))
        seconds, found = time.monotonic() - begin, set()
        for file in met.glob(f"{test}.*"):
            found.update(int(number) for number in file.read_text().split())
            file.unlink()
        for number in found if ending == "passed" else ():
            meeting[number].append((seconds, test))
        if ending != "passed":
            print(f"-- {test} {ending} without any fault, so it is left out", flush=True)
    return {number: sorted(meeting[number]) for number in range(len(faults))}


def verdict_on(build, number, tests, matrix):
    """The tests that fail with this fault, the first one or all, and those that ran into their time limit before."""
    killers, timed_out = [], []
    for seconds, test in tests:
        ending = ending_of(build, test, seconds, SWIVEL_MUTANT=str(number))
        if ending == "timed out":
            timed_out.append(test)
        elif ending == "failed":
            killers.append(test)
            if not matrix:
                break
    return killers, timed_out


def words_for(tests, killers, timed_out):
    if killers:
        return f"seen by {', '.join(killers)}"
    if timed_out:
        return f"undecided, out of time in {', '.join(timed_out)}"
    return "SURVIVED" if tests else "no test comes across it"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--area", choices=AREAS, action="append", help="draw from this area alone; may be repeated")
    parser.add_argument("--count", type=int, help="how many faults of each area (400 of the library, 100 of the tools)")
    parser.add_argument("--seed", type=int, default=SEED, help="draws other faults (%(default)s)")
    parser.add_argument("--diff", metavar="REVISION", help="only on lines that differ from this revision; all of them without --count")
    parser.add_argument("--matrix", action="store_true", help="run all tests of each fault, not only until one fails")
    parser.add_argument("--list", action="store_true", help="name the faults, and do nothing")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="tests that run at once (%(default)s)")
    parser.add_argument("--work", type=Path, default=SOURCE / "build" / "mutations", help="the folder to work in (%(default)s)")
    options = parser.parse_args()
    begin = time.monotonic()
    try:
        faults = drawn(options)
    except Failure as failure:
        print(f"operators.py: {failure}", file=sys.stderr)
        return 1
    name = lambda number: f"{faults[number][0]}:{faults[number][1]}:{faults[number][2] + 1} {faults[number][4].format('')}"  # noqa: E731
    if options.list or not faults:
        print(*map(name, range(len(faults))), sep="\n", end="\n" if faults else "")
        if not faults:
            print("no fault can be made on these lines", file=sys.stderr)
        return 0
    try:
        work = options.work.resolve() / "operators"
        tree = work / "tree"
        tree.mkdir(parents=True, exist_ok=True)
        lock = locked(work)  # noqa: F841
        copy_tree(tree)
        build = Build(work / "scalar", tree, "scalar", False)
        dropped = build_all(build, tree, faults)
        tests = tests_of_faults(build, work, faults)
        print(f"-- {len(faults) - len(dropped)} of {len(faults)} faults compile, {time.monotonic() - begin:.0f} s", flush=True)
        alive = [number for number in range(len(faults)) if number not in dropped]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            verdicts = dict(zip(alive, pool.map(lambda number: verdict_on(build, number, tests[number], options.matrix), alive)))
    except Failure as failure:
        print(f"operators.py: {failure}", file=sys.stderr)
        return 1
    for number in alive:
        print(f"{name(number)}: {words_for(tests[number], *verdicts[number])}")
    (work / "table.json").write_text(json.dumps([{"fault": name(number), "met_by": [test for _, test in tests[number]],
                                                  "seen_by": killers, "timed_out": timed_out}
                                                 for number, (killers, timed_out) in verdicts.items()], indent=1))
    seen = sum(bool(killers) for killers, _ in verdicts.values())
    undecided = sum(bool(timed_out) and not killers for killers, timed_out in verdicts.values())
    print(f"\n{seen} of {len(alive)} faults seen, {undecided} undecided, {time.monotonic() - begin:.0f} s; "
          f"the table is {work / 'table.json'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
