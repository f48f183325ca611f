#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares two builds of swivel_bench, run in turns: the same machine, the same minutes. Of each row it takes the ratio of both times in
each round, and the median of these ratios. A row is slower if the new one was slower in every round.

usage: bench/in_turns.py OLD NEW [--rounds 7] [--filter REGEX] [--core 0]
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).resolve().parent))
from results import Refused, read_results  # noqa: E402


def measured(binary, options, folder):
    path = Path(folder) / "result.json"
    command = [binary, f"--benchmark_out={path}", f"--benchmark_filter={options.filter}", "--benchmark_repetitions=3",
               "--benchmark_min_time=0.02"]
    if options.core is not None:
        command = ["taskset", "-c", options.core, *command]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        raise Refused(f"{binary} failed: {done.stderr.strip().splitlines()[-1] if done.stderr.strip() else 'it says nothing'}")
    return read_results(path)


def ratios(options):
    """Of each row that both have: the ratio new by old in each round, and both least times."""
    rounds = {}
    with tempfile.TemporaryDirectory() as folder:
        for turn in range(options.rounds):
            first = turn % 2  # in every other round the new one goes first, so that neither gains by its place
            times = [None, None]
            for which in (first, 1 - first):
                times[which] = measured((options.old, options.new)[which], options, folder)
            old, new = times
            for name in old.keys() & new.keys():
                rounds.setdefault(name, []).append((old[name], new[name]))
            print(f"round {turn + 1} of {options.rounds}", file=sys.stderr)
    return rounds


def main(arguments):
    parser = argparse.ArgumentParser(prog="in_turns.py", description="Compares two builds of swivel_bench, run in turns.",
                                     epilog="Exit codes: 0 none slower, 1 some rows are slower, 2 bad usage or a run that fails.")
    parser.add_argument("old", metavar="OLD", help="swivel_bench of the former library")
    parser.add_argument("new", metavar="NEW", help="swivel_bench to judge")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--filter", default=".", metavar="REGEX", help="rows to run, as for --benchmark_filter")
    parser.add_argument("--core", help="the core to run on, by taskset; not for rows with threads")
    parser.add_argument("--threshold", type=float, default=3, metavar="PERCENT", help="mark rows that are slower by more (default: 3)")
    options = parser.parse_args(arguments)
    try:
        rounds = ratios(options)
    except (Refused, OSError) as error:
        print(f"in_turns.py: {error}", file=sys.stderr)
        return 2
    slower = 0
    print(f"{'':48} {'old, ns':>9} {'new, ns':>9} {'new/old':>8} {'from':>6} {'to':>6}")
    for name, pairs in sorted(rounds.items()):
        each = sorted(new / old for old, new in pairs)
        middle = median(each)
        mark = "  slower" if middle > 1 + options.threshold / 100 and each[0] > 1 else ""
        slower += bool(mark)
        print(f"{name:48} {min(old for old, _ in pairs):9.2f} {min(new for _, new in pairs):9.2f} {middle:8.3f} {each[0]:6.2f} "
              f"{each[-1]:6.2f}{mark}")
    print(f"{slower} of {len(rounds)} rows are slower by more than {options.threshold:g} %")
    return int(slower > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
