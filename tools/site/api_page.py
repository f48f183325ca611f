# SPDX-License-Identifier: MIT
"""Makes the reference page from swivel.h. First come the paragraphs and tables of the head comment, then every declaration below its
comment. Every public name gets an anchor, and every mention of it in prose becomes a link."""
import re
from html import escape

# Where a chapter starts: the first name declared in it.
CHAPTERS = {
    "SWIVEL_VERSION_MAJOR": "Constants and enumerations",
    "swivel_binding": "Structures",
    "swivel_version": "Version and errors",
    "swivel_default_crowd_def": "Making a crowd",
    "swivel_block_count": "A crowd's shape and rows",
    "swivel_write": "In and out",
    "swivel_solve": "Solving",
    "swivel_frame": "Whole frames",
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


# ---- prose

def linked(text, names):
    """Mentions of public names as links, everything else as it stands."""
    def link(match):
        name, call = match[1], match[2] or ""
        code = f"`{name}{call}`"
        return f"[{code}](#{name})" if name in names else code
    text = re.sub(r"\*(?=\w)", r"\\*", escape(text, quote=False))
    return re.sub(r"\b((?:swivel|SWIVEL)_\w+)(\(\))?", link, text)


def table(lines, names):
    """Rows of columns two or more spaces apart; a row that names no field heads those below it."""
    rows, width, out, heads = [], 0, [], []
    for line in lines:
        cells = re.split(r"\s{2,}", line.strip())
        if len(line) - len(line.lstrip()) > 10:  # goes on with the field above
            cells = [""] + cells
        rows.append(cells)
        width = max(width, len(cells))
    for cells in rows:
        field = cells[0] == "" or cells[0].startswith(("SWIVEL_", "and "))
        if not field:
            heads = [cells[0].capitalize()] + cells[1:] + heads[len(cells):]
            out += ["", "| " + " | ".join(heads) + " |", "|---" * width + "|"]
            continue
        cells += [""] * (width - len(cells))
        out.append("| " + " | ".join(linked(cell, names).replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(out) + "\n"


def paragraph(lines, names):
    if any(re.search(r"\S\s{3,}\S", line) for line in lines):
        return table(lines, names)
    out, item = [], False
    for line in lines:
        indent = len(line) - len(line.lstrip())
        if line.startswith("- "):
            out.append(("" if item == "dash" else "\n") + linked(line, names))
            item = "dash"
        elif item == "dash" and indent == 2:
            out.append("  " + linked(line.strip(), names))
        elif indent == 2:  # the start of an entry; its text goes on further in
            out.append(("\n- " if not item else "- ") + linked(line.strip(), names))
            item = True
        elif indent == 4 and not item:  # code
            out.append("    " + line)
        else:
            out.append(("  " if indent else "\n" if item else "") + linked(line.strip(), names))
            item = item and indent > 2
    return "\n".join(out) + "\n"


def prose(text, names, heading=None):
    """Paragraphs of a comment; one that starts in capitals gets a heading, if these are wanted."""
    out = []
    for lines in [block.split("\n") for block in re.split(r"\n\n+|\n(?=[A-Z]{3,}[A-Z ]*\. )", text)]:
        lead = re.match(r"([A-Z]{2}[A-Z ]+)(?:\.|,(?= in this order)) ?", lines[0])
        if lead and heading:
            title = lead[1].capitalize()
            out.append(f"{heading} {title}\n")
            if lead[0].rstrip().endswith("."):
                lines[0] = lines[0][lead.end():]
        code = [line for line in lines if line.startswith("    ")]
        if code and code == [line for line in lines[1:]] and lines[0].endswith(":"):
            out += [linked(lines[0], names) + "\n", "```c", *[line[4:] for line in code], "```\n"]
        else:
            out.append(paragraph(lines, names))
    return "\n".join(out)


# ---- declarations

def items(body):
    """[(comment, code)] in order: what stands together belongs together, a comment to the declaration below it."""
    found, comment, code, depth = [], [], [], 0
    def done():
        if comment or code:
            found.append(("\n".join(comment), "\n".join(code)))
        comment.clear(), code.clear()
    for line in body.splitlines():
        if not line.strip():
            if depth == 0:
                done()
            elif code:
                code.append(line)
            continue
        if line.startswith("//"):
            if code:
                done()
            comment.append(line[3:])
            continue
        code.append(line)
        depth += line.partition("//")[0].count("{") - line.partition("//")[0].count("}")
    done()
    return found


def code_block(code):
    api = "SWIVEL_API "
    lines = []
    for line in code.split("\n"):
        goes_on = line.startswith(" " * 20) and any(api in above for above in code.split("\n"))
        lines.append(line[len(api):] if goes_on or line.startswith(api) else line)
    return "```c\n" + "\n".join(lines) + "\n```\n"


def reference(header):
    head, body = head_and_rest(header)
    declared = items(body)
    names = set(public_names(body))
    missing = set(CHAPTERS) - names
    if missing:
        raise Unread(f"swivel.h declares no {', '.join(sorted(missing))}, where a chapter of the reference starts")
    out, given = ["## The manual\n", prose(head, names, "###")], set()
    for comment, code in declared:
        own = [name for name in public_names(code) if name not in given]  # a function's body names others
        given.update(own)
        for name in own:
            if name in CHAPTERS:
                out.append(f"## {CHAPTERS[name]}\n")
        if own:
            shown = [name for name in own if name.startswith("swivel_")] or own[:1]
            out.append("### " + ", ".join(f"`{name}`" for name in shown) + f" {{#{own[0]}}}\n")
            out.append("".join(f'<a id="{name}"></a>' for name in own[1:]) + "\n")
        if comment:
            out.append(prose(comment, names))
        if code:
            out.append(code_block(code))
    return "\n".join(out)
