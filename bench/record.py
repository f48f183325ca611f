#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Records what swivel does on this machine: runs the whole suite, keeps its medians as bench/results/NAME.json, and fills
the pages that show results. NAME says the CPU and its best instruction set, such as epyc-zen4-avx512. The machine must be idle.

ozz-animation may be missing: its rows are left out then.

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
    parser.add_argument("--results", default=str(BENCH / "results"), metavar="FOLDER")
    parser.add_argument("--page", action="append", default=[], metavar="FILE", help="a page to fill, as for pages.py")
    parser.add_argument("--binary", default=str(BENCH.parent / "build/dev/bin/swivel-bench"), metavar="FILE")
    options = parser.parse_args(arguments)
    try:
        if not re.fullmatch(r"[\w-]+", options.name):
            raise Refused(f"{options.name} is not a name of letters, digits and hyphens")
        if not options.busy and os.getloadavg()[0] > IDLE:
            raise Refused(f"this machine is busy, its load is {os.getloadavg()[0]:.1f}; wait until it is below {IDLE}")
        result = Path(options.results) / f"{options.name}.json"
        if subprocess.run([options.binary, f"--benchmark_out={result}"], check=False).returncode:
            raise Refused("swivel_bench failed")
        write_short(result)
        if not any(name.startswith("frame_ozz/") for name in read_results(result)[1]):
            print("note: this build has no ozz-animation, so its rows are left out; -DSWIVEL_OZZ_DIR=FOLDER adds it", file=sys.stderr)
    except (Refused, OSError) as error:
        print(f"record.py: {error}", file=sys.stderr)
        return 2
    return pages.main(["--results", options.results, *(word for page in options.page for word in ("--page", page))])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
