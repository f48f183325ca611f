# SPDX-License-Identifier: MIT
"""Programs on pages. A block of code that holds nothing but

    // docs/snippets/NAME.cpp
or
    // docs/snippets/NAME.cpp: PART

is filled with that file's lines between `// [shown]`, or `// [PART]`, and `// [end]`. The files are built and run by the
test docs_snippets."""
import re
import textwrap

BLOCK = re.compile(r"^(?P<indent> *)```cpp\n *// docs/snippets/(?P<name>[\w.]+)(?:: (?P<part>\w+))?\n *```$", re.M)


class Missing(Exception):
    """A page asks for a program that is not there."""


def part_of(text, name, part):
    found = re.search(rf"^ *// \[{part}\]\n(.*?)^ *// \[end\]$", text, re.M | re.S)
    if not found:
        raise Missing(f"docs/snippets/{name} has no lines between // [{part}] and // [end]")
    return textwrap.dedent(found[1]).rstrip()


def fill_in(markdown, root):
    def filled(match):
        path = root / "docs/snippets" / match["name"]
        if not path.exists():
            raise Missing(f"docs/snippets/{match['name']} does not exist")
        code = part_of(path.read_text(), match["name"], match["part"] or "shown")
        return textwrap.indent(f"```cpp\n{code}\n```", match["indent"])
    return BLOCK.sub(filled, markdown)
