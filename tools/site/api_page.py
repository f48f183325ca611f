# SPDX-License-Identifier: MIT
"""Makes the reference page from the C headers. Of each comes the head comment first, then every declaration below its comment, as they stand
in the header. Every public name gets an anchor."""
import re

# The headers in their order on the page, and the chapter that each one's head comment starts.
HEADERS = {
    "swivel.h": "The manual",
    "swivel_bodies.h": "Bodies",
    "swivel_regions.h": "Reach regions",
    "swivel_explain.h": "Answers in words",
}
# Where any other chapter starts: the first name declared in it.
CHAPTERS = {
    "SWIVEL_VERSION_MAJOR": "Version and errors",
    "swivel_flag": "Flags",
    "swivel_kind": "Kinds of groups, and features",
    "swivel_field": "Fields",
    "swivel_binding": "Binding a skeleton",
    "swivel_limb_def": "Making a crowd",
    "swivel_group_count": "A crowd's shape and rows",
    "swivel_write": "In and out",
    "swivel_stream": "Streams",
    "swivel_blocks": "Solving",
    "swivel_range": "Values of limits and turns",
    "swivel_forward": "Forward kinematics, allowed swivels, joint angles",
    "swivel_pack": "Packed results",
    "swivel_isa_name": "Instruction sets",
    "swivel_pose_form": "Poses of bodies",
}
NAME = re.compile(r"\b(?:swivel|SWIVEL)_\w+")
NOT_OURS_TO_CALL = {"SWIVEL_API", "SWIVEL_SHARED"}  # how the header is compiled


class Unread(Exception):
    """A header has a shape that this script does not know."""


def public_names(code):
    """Names declared by lines of code, in order."""
    code = re.sub(r"//.*", "", code)
    names = re.findall(r"^#define (SWIVEL_\w+)", code, re.M)
    names += re.findall(r"\b(swivel_\w+)\((?!\*)", code)
    names += re.findall(r"^typedef \w+ (swivel_\w+)", code, re.M)
    names += re.findall(r"[{,]\s*(SWIVEL_\w+)(?=[\s,=}])", code)
    return [name for name in dict.fromkeys(names) if name not in NOT_OURS_TO_CALL]


def head_and_rest(name, header):
    head, found, rest = header.partition("#pragma once\n")
    body = re.search(r'extern "C" \{\n#endif\n(.*)#ifdef __cplusplus\n\}', rest, re.S)
    if not found or not body:
        raise Unread(f"{name}: no #pragma once, or no extern \"C\" around its declarations")
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
    """A head comment as Markdown."""
    return re.sub(r"([*_<])", r"\\\1", head) + "\n"


def reference(headers):
    """headers: the text of each, by its name in HEADERS."""
    out, given = [], set()
    for header, chapter in HEADERS.items():
        head, body = head_and_rest(header, headers[header])
        out += [f"## {chapter}\n", f"`#include <swivel/{header}>`\n", manual(head)]
        for block in items(body):
            own = [name for name in public_names(block) if name not in given]  # a function's body names others
            given.update(own)
            out += [f"## {CHAPTERS[name]}\n" for name in own if name in CHAPTERS]
            if own:
                shown = [name for name in own if name.startswith("swivel_")] or own[:1]
                out.append("### " + ", ".join(f"`{name}`" for name in shown) + f" {{#{own[0]}}}\n")
                out.append("".join(f'<a id="{name}"></a>' for name in own[1:]) + "\n")
            out.append(f"```c\n{block}\n```\n")
    if missing := set(CHAPTERS) - given:
        raise Unread(f"no header declares {', '.join(sorted(missing))}, where a chapter of the reference starts")
    return "\n".join(out)
