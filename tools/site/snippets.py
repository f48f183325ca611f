#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs on pages. A block of code below a line

    <!-- docs/snippets/NAME.cpp -->
or
    <!-- docs/snippets/NAME.cpp: PART -->
or
    <!-- examples/NAME.c: PART -->

holds that file's lines between `// [shown]`, or `// [PART]`, and `// [end]`. So pages read the same in the repository and on the site.
The tests docs_snippets and those of examples build and run the files. Run as a program, this script writes the lines into the pages."""
import re
import sys
import textwrap
from pathlib import Path

MARK = r"<!-- (?:docs/snippets|examples)/"
BLOCK = re.compile(r"^(?P<indent> *)<!-- (?P<file>(?:docs/snippets|examples)/\w+\.(?P<language>c|cpp))(?:: (?P<part>\w+))? -->\n"
                   r"(?P<code> *```(?P=language)\n(?:.*\n)*? *```)$", re.M)


class Missing(Exception):
    """A page asks for a program that is not there, or shows another."""


def part_of(text, file, part):
    found = re.search(rf"^ *// \[{part}\]\n(.*?)^ *// \[end\]$", text, re.M | re.S)
    if not found:
        raise Missing(f"{file} has no lines between // [{part}] and // [end]")
    return textwrap.dedent(found[1]).rstrip()


def code_of(match, root):
    """What the block must hold."""
    path = root / match["file"]
    if not path.exists():
        raise Missing(f"{match['file']} does not exist")
    code = part_of(path.read_text(encoding="utf-8"), match["file"], match["part"] or "shown")
    return textwrap.indent(f"```{match['language']}\n{code}\n```", match["indent"])


def check(markdown, root):
    """Raises Missing where a page shows another program than the one that is tested."""
    if len(re.findall(MARK, markdown)) != len(BLOCK.findall(markdown)):
        raise Missing("a line <!-- docs/snippets/... --> or <!-- examples/... --> has no block of code below it")
    if len(re.findall(r"^ *```c(?:pp)?$", markdown, re.M)) != len(BLOCK.findall(markdown)):
        raise Missing("a block of C or C++ has no line <!-- docs/snippets/... --> above it, so nothing builds it")
    for match in BLOCK.finditer(markdown):
        if any(match["code"].count(open) != match["code"].count(close) for open, close in ("{}", "()")):
            raise Missing(f"what it shows of {match['file']} opens a brace and does not close it")
        if match["code"] != code_of(match, root):
            raise Missing(f"does not show {match['file']} as it is; run tools/docs --update")


def filled(markdown, root):
    return BLOCK.sub(lambda match: match[0].replace(match["code"], code_of(match, root)), markdown)


def without_marks(markdown):
    """For the site, whose readers have no use for them."""
    return re.sub(rf"^ *{MARK}.*-->\n", "", markdown, flags=re.M)


def main():
    root = Path(__file__).resolve().parents[2]
    for page in sorted((root / "docs").rglob("*.md")):
        before = page.read_text(encoding="utf-8")
        try:
            after = filled(before, root)
            check(after, root)
        except Missing as error:
            sys.exit(f"{page.relative_to(root)}: {error}")
        if after != before:
            page.write_text(after, encoding="utf-8")
            print(f"wrote the programs of {page.relative_to(root)}")


if __name__ == "__main__":
    main()
