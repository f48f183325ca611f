#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fills docs/speed.md from the results in bench/results. A block

    <!-- bench: TABLE RESULT -->
    ...
    <!-- bench end -->

becomes that table of tables.py, of bench/results/RESULT.json. The pictures are drawn from the first result that the page names.

usage: bench/pages.py [--check]
"""
import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import plot  # noqa: E402
from results import Refused, read_all  # noqa: E402
from tables import TABLES, Result  # noqa: E402

BENCH = Path(__file__).resolve().parent
BLOCK = re.compile(r"^<!-- bench: (?P<table>\w+) (?P<result>[\w.-]+) -->\n(?P<text>.*?)^<!-- bench end -->$", re.M | re.S)


def filled(page, folder):
    """The page with every block as its result has it."""
    if page.count("<!-- bench: ") != len(BLOCK.findall(page)):
        raise Refused("a line <!-- bench: TABLE RESULT --> is not well-formed or has no line <!-- bench end --> below it")
    results = {}

    def block(match):
        if match["table"] not in TABLES:
            raise Refused(f"there is no table {match['table']}; there are {', '.join(TABLES)}")
        name = match["result"]
        if name not in results:
            results[name] = Result(*read_all(folder / f"{name}.json"))
        table = TABLES[match["table"]](results[name])
        return f"<!-- bench: {match['table']} {name} -->\n{table.markdown()}\n<!-- bench end -->"

    return BLOCK.sub(block, page)


def main(arguments):
    parser = argparse.ArgumentParser(prog="pages.py", description="Fills docs/speed.md, and draws its pictures.")
    parser.add_argument("--page", default=str(BENCH.parent / "docs/speed.md"), metavar="FILE")
    parser.add_argument("--results", default=str(BENCH / "results"), metavar="FOLDER")
    parser.add_argument("--check", action="store_true", help="exit with 1 if the page's tables are not those of the results")
    options = parser.parse_args(arguments)
    page = Path(options.page)
    try:
        old = page.read_text(encoding="utf-8")
        new = filled(old, Path(options.results))
    except (Refused, OSError) as error:
        print(f"pages.py: {error}", file=sys.stderr)
        return 2
    if options.check:
        if old != new:
            print(f"pages.py: {page} does not show its results; run bench/pages.py", file=sys.stderr)
        return int(old != new)
    page.write_text(new, encoding="utf-8")
    print(page)
    first = BLOCK.search(new)
    return plot.main([str(Path(options.results) / f"{first['result']}.json"), "--out", str(page.parent)]) if first else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
