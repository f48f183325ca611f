#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fills the pages that show results of bench/results: docs/speed.md, README.md and docs/faq.md. A block

    <!-- bench: TABLE RESULT -->
    ...
    <!-- bench end -->

becomes that table of tables.py, of bench/results/RESULT.json. Within a line, <!-- bench: SENTENCE RESULT -->...<!-- bench end --> becomes
that sentence. The pictures are drawn from the first result that the first page names.

usage: bench/pages.py [--check]
"""
import argparse
import re
import sys
from functools import lru_cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import plot  # noqa: E402
from results import Refused, read_all  # noqa: E402
from tables import SENTENCES, TABLES, Result  # noqa: E402

BENCH = Path(__file__).resolve().parent
PAGES = [str(BENCH.parent / page) for page in ("docs/speed.md", "README.md", "docs/faq.md")]
BLOCK = re.compile(r"<!-- bench: (?P<what>\w+) (?P<result>[\w.-]+) -->(?P<text>.*?)<!-- bench end -->", re.S)


@lru_cache
def read_result(name, folder):
    return Result(*read_all(folder / f"{name}.json"))


def filled(page, folder):
    """The page with every block as its result has it."""
    if not page.count("<!-- bench: ") == page.count("<!-- bench end -->") == len(BLOCK.findall(page)):
        raise Refused("a line <!-- bench: TABLE RESULT --> is not well-formed or has no line <!-- bench end --> below it")

    def block(match):
        what, name, is_table = match["what"], match["result"], match["text"].startswith("\n")
        kind, known = ("table", TABLES) if is_table else ("sentence", SENTENCES)
        if what not in known:
            raise Refused(f"there is no {kind} {what}; there are {', '.join(known)}")
        result = read_result(name, folder)
        try:
            text = f"\n{TABLES[what](result).markdown()}\n" if is_table else SENTENCES[what](result)
        except KeyError as error:
            raise Refused(f"the result {name} has no {error}, which the sentence {what} says") from error
        return f"<!-- bench: {what} {name} -->{text}<!-- bench end -->"

    return BLOCK.sub(block, page)


def main(arguments):
    parser = argparse.ArgumentParser(prog="pages.py", description="Fills the pages that show results, and draws the pictures of the first.")
    parser.add_argument("--page", action="append", metavar="FILE", help="a page to fill (default: docs/speed.md, README.md, docs/faq.md)")
    parser.add_argument("--results", default=str(BENCH / "results"), metavar="FOLDER")
    parser.add_argument("--check", action="store_true", help="exit with 1 if a page does not show its results")
    options = parser.parse_args(arguments)
    pages, folder = [Path(page) for page in options.page or PAGES], Path(options.results)
    try:
        old = [page.read_text(encoding="utf-8") for page in pages]
        new = [filled(text, folder) for text in old]
    except (Refused, OSError) as error:
        print(f"pages.py: {error}", file=sys.stderr)
        return 2
    stale = [(page, text) for page, before, text in zip(pages, old, new) if text != before]
    if options.check:
        for page, _ in stale:
            print(f"pages.py: {page} does not show its results; run bench/pages.py", file=sys.stderr)
        return int(bool(stale))
    for page, text in stale:
        page.write_text(text, encoding="utf-8")
        print(page)
    first = BLOCK.search(new[0])
    return plot.main([str(folder / f"{first['result']}.json"), "--out", str(pages[0].parent)]) if first else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
