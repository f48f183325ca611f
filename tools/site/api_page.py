# SPDX-License-Identifier: MIT
"""Makes the reference page from swivel.h. First comes the head comment, then every declaration below its comment, as they stand in the
header. Every public name gets an anchor."""
import re

# Where a chapter starts: the first name declared in it.
CHAPTERS = {
    "SWIVEL_VERSION_MAJOR": "Constants and enumerations",
    "swivel_binding": "Structures",
    "swivel_version": "Version and errors",
    "swivel_default_crowd_def": "Making a crowd",
    "swivel_block_count": "A crowd's shape and rows",
    "swivel_write": "In and out",
    "swivel_solve": "Solving",
    "swivel_streams": "Streams",
    "swivel_reset": "Continuity, allowed swivels, joint angles",
    "swivel_range": "Values of limits and turns",
    "swivel_forward": "Forward kinematics",
    "swivel_isa_name": "Instruction sets",
}
NAME = re.compile(r"\b(?:swivel|SWIVEL)_\w+")
NOT_OURS_TO_CALL = {"SWIVEL_API", "SWIVEL_SHARED"}  # how the header is compiled


class Unread(Exception):
    """The header has a shape that this script does not know."""


def public_names(code):
    """Names declared by lines of code, in order."""
    code = re.sub(r"//.*", "", code)
    names = re.findall(r"^#define (SWIVEL_\w+)", code, re.M)
    names += re.findall(r"\b(swivel_\w+)\((?!\*)", code)
    names += re.findall(r"^typedef \w+ (swivel_\w+)", code, re.M)
    names += re.findall(r"[{,]\s*(SWIVEL_\w+)(?=[\s,=}])", code)
    return [name for name in dict.fromkeys(names) if name not in NOT_OURS_TO_CALL]


def head_and_rest(header):
    head, found, rest = header.partition("#pragma once\n")
    body = re.search(r'extern "C" \{\n#endif\n(.*)#ifdef __cplusplus\n\}', rest, re.S)
    if not found or not body:
        raise Unread("swivel.h: no #pragma once, or no extern \"C\" around its declarations")
    lines = [line[3:] for line in head.splitlines() if line.startswith("//")]
    return "\n".join(lines[1:]).strip("\n"), body[1]  # without the licence


def items(body):
    """Blocks of lines: what stands together belongs together, and a comment begins a block."""
    blocks, block, depth = [], [], 0
    for line in [*body.splitlines(), ""]:
        is_new = not line.strip() or (line.startswith("//") and block and not block[-1].startswith("//"))
        if block and is_new and depth == 0:
            blocks.append("\n".join(block))
            block = []
        if line.strip() or block:
            block.append(line)
        code = line.partition("//")[0]
        depth += code.count("{") - code.count("}")
    return blocks


def manual(head):
    """The head comment as Markdown: its program is code, all else is text."""
    text = re.sub(r"(?m)^(?!    ).*$", lambda line: re.sub(r"([*_<])", r"\\\1", line[0]), head)
    return re.sub(r"(?m)^(?!    )(.*)\n(?=    )", r"\1\n\n", text) + "\n"


def reference(header):
    head, body = head_and_rest(header)
    missing = set(CHAPTERS) - set(public_names(body))
    if missing:
        raise Unread(f"swivel.h declares no {', '.join(sorted(missing))}, where a chapter of the reference starts")
    out, given = ["## The manual\n", manual(head)], set()
    for block in items(body):
        own = [name for name in public_names(block) if name not in given]  # a function's body names others
        given.update(own)
        out += [f"## {CHAPTERS[name]}\n" for name in own if name in CHAPTERS]
        if own:
            shown = [name for name in own if name.startswith("swivel_")] or own[:1]
            out.append("### " + ", ".join(f"`{name}`" for name in shown) + f" {{#{own[0]}}}\n")
            out.append("".join(f'<a id="{name}"></a>' for name in own[1:]) + "\n")
        out.append(f"```c\n{block}\n```\n")
    return "\n".join(out)
