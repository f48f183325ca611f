#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares two result files of swivel_bench: the medians of each benchmark, their ratio, and which moved.

usage: bench/compare.py OLD.json NEW.json
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from results import Refused, read_results  # noqa: E402


def compare(old, new, threshold):
    """Lines of the table, and how many benchmarks moved beyond the threshold, in percent."""
    lines, moved = [], 0
    both = [name for name in old if name in new]
    width = max([len(name) for name in both], default=0)
    for name in both:
        ratio = new[name] / old[name]
        beyond = not 1 / (1 + threshold / 100) <= ratio <= 1 + threshold / 100
        moved += beyond
        mark = ("  slower" if ratio > 1 else "  faster") if beyond else ""
        lines.append(f"{name:{width}} {old[name]:10.3f} {new[name]:10.3f} {ratio:7.3f}{mark}")
    if both:
        lines.insert(0, f"{'':{width}} {'old, ns':>10} {'new, ns':>10} {'new/old':>7}")
    lines += [f"only in the old file: {name}" for name in old if name not in new]
    lines += [f"only in the new file: {name}" for name in new if name not in old]
    return lines, moved


def main(arguments):
    parser = argparse.ArgumentParser(
        prog="compare.py", description="Compares the medians of two result files of swivel_bench.",
        epilog="Exit codes: 0 compared, 1 moved beyond the threshold with --fail, 2 bad usage or input.")
    parser.add_argument("old", metavar="OLD.json", help="result to compare with")
    parser.add_argument("new", metavar="NEW.json", help="result to judge")
    parser.add_argument("--threshold", type=float, default=5, metavar="PERCENT",
                        help="mark times that differ by more (default: 5)")
    parser.add_argument("--fail", action="store_true", help="exit with 1 if a benchmark became slower beyond the threshold")
    parser.add_argument("--other-cpu", action="store_true", help="compare results of different CPUs all the same")
    options = parser.parse_args(arguments)
    if not options.threshold >= 0:
        parser.error("--threshold is a percentage, 0 or more")
    try:
        old_context, old = read_results(options.old)
        new_context, new = read_results(options.new)
        cpus = [context.get("cpu", "unknown") for context in (old_context, new_context)]
        if cpus[0] != cpus[1] and not options.other_cpu:
            raise Refused(f"results of different CPUs, {cpus[0]} and {cpus[1]}; --other-cpu compares them all the same")
    except Refused as refused:
        print(f"compare.py: {refused}", file=sys.stderr)
        return 2
    for name, context in (("old", old_context), ("new", new_context)):
        print(f"{name}: commit {context.get('commit', 'unknown')}, {context.get('date', 'no date')}, "
              f"{context.get('cpu', 'unknown')}, {context.get('library_build', 'unknown build')}")
    lines, moved = compare(old, new, options.threshold)
    print("\n".join(lines))
    slower = sum(line.endswith("  slower") for line in lines)
    print(f"{moved} moved by more than {options.threshold:g} %, {slower} of them slower")
    return 1 if options.fail and slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
