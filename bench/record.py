#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Records what swivel does on this machine: runs the whole suite, keeps its medians as bench/results/NAME.json, and fills docs/speed.md.
NAME says the CPU and its best instruction set, such as epyc-zen4-avx512. The machine must be idle.

usage: bench/record.py NAME [--busy]
"""
import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import pages  # noqa: E402
from results import Refused, read_results, write_short  # noqa: E402

BENCH = Path(__file__).resolve().parent
IDLE = 0.3  # processes ready to run, on average of the last minute


def main(arguments):
    parser = argparse.ArgumentParser(prog="record.py", description="Runs the whole suite and records its result.")
    parser.add_argument("name", metavar="NAME")
    parser.add_argument("--busy", action="store_true", help="on a machine that does something else, too; for trying this script")
    parser.add_argument("--binary", default=str(BENCH.parent / "build/dev/bench/swivel_bench"), metavar="FILE")
    options = parser.parse_args(arguments)
    try:
        if not re.fullmatch(r"[\w-]+", options.name):
            raise Refused(f"{options.name} is not a name of letters, digits and hyphens")
        if not options.busy and os.getloadavg()[0] > IDLE:
            raise Refused(f"this machine is busy, its load is {os.getloadavg()[0]:.1f}; wait until it is below {IDLE}")
        result = BENCH / "results" / f"{options.name}.json"
        if subprocess.run([options.binary, f"--benchmark_out={result}"], check=False).returncode:
            raise Refused("swivel_bench failed")
        write_short(result)
        if not any(name.startswith("frame_ozz/") for name in read_results(result)[1]):
            print("record.py: without ozz-animation; configure with -DSWIVEL_OZZ_DIR=FOLDER to have it", file=sys.stderr)
    except (Refused, OSError) as error:
        print(f"record.py: {error}", file=sys.stderr)
        return 2
    return pages.main([])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
