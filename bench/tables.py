#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of a result file of swivel_bench: swivel beside its rivals, beside what the machine can do, and beside itself. Each row has
its ratio, the goal of it where there is one, and says where swivel loses. Rows whose benchmarks did not run are left out.

usage: bench/tables.py RESULT.json
"""
import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from results import Refused, read_all  # noqa: E402

ISAS = {"avx512": "AVX-512", "avx2": "AVX2", "sse2": "SSE2", "neon64": "NEON", "scalar": "scalar"}
MEMORY = {"L1": "level 1 cache", "L2": "level 2 cache", "L3": "level 3 cache", "memory": "memory"}
LOOPS = {"loop_trig": "loop with two acos", "loop_light": "loop with one acos", "loop_roots": "loop with half-angle roots"}
LIMITED = {"cone+twist": "cone and twist", "full_arm": "full arm", "full_arm+box": "full arm and Euler box"}
SHARES = (5, 14, 50, 100)
BOUNDS = {"avx512": 1.6, "avx2": 2.0, "sse2": 2.3}
NOISE = 1.03  # ratios nearer to 1 decide nothing


@dataclass
class Table:
    title: str
    head: list
    rows: list
    notes: tuple = ()

    def text(self):
        columns = list(zip(*[self.head, *self.rows]))
        widths = [max(map(len, column)) for column in columns]
        lines = ["  ".join(cell.ljust(width) if n == 0 else cell.rjust(width) for n, (cell, width) in enumerate(zip(row, widths)))
                 for row in [self.head, *self.rows]]
        return "\n".join([self.title, *self.notes, "", *(line.rstrip() for line in lines)])

    def markdown(self):
        lines = ["| " + " | ".join(row) + " |" for row in [self.head, *self.rows]]
        lines.insert(1, "|" + "---|" * len(self.head))
        return "\n".join([*(f"{note}\n" for note in self.notes), *lines])


class Result:
    def __init__(self, context, times, notes):
        self.context, self.times, self.notes = context, times, notes
        self.isas = context.get("isas", "").split()
        self.best = self.isas[0] if self.isas else ""
        self.levels = {key.removeprefix("level_of/"): isa for key, isa in context.items() if key.startswith("level_of/")}

    def ns(self, name):
        return self.times.get(name)

    def level_of(self, isa):
        """The rivals' level of flags whose registers are as wide."""
        return next((level for level, of in self.levels.items() if of == isa), None)

    def bound(self, isa):
        """The least time of an arm of P that divider and arithmetic allow."""
        times = [self.ns(f"bound/{isa}/{part}") for part in ("divider", "arithmetic")]
        return max(times) if all(times) else None


def number(ns):
    return f"{ns:.0f}" if ns >= 99.5 else f"{ns:.1f}" if ns >= 9.95 else f"{ns:.2f}"


def judged(ratio, most):
    """Whether a ratio is at most its goal."""
    return "kept" if ratio <= most else "missed"


def rivals(result):
    """Who does the same work, and how many times as long it takes."""
    rows = []

    def row(work, isa, own, other, name, least=None):
        a, b = result.ns(own), result.ns(other)
        if a is None or b is None:
            return
        goal = f"{least:g}" if least else "–"
        verdict = judged(least, b / a) if least else "**swivel loses**" if b / a < 1 / NOISE else ""
        rows.append([work, ISAS.get(isa, isa), number(a), name, number(b), f"{b / a:.1f}", goal, verdict])

    for isa in result.isas:
        level = result.level_of(isa)
        for loop, name in LOOPS.items():
            row("P in cache", isa, f"P/{isa}/L2", f"{loop}/{level}", name, loop_goal(result, isa, level) if loop == "loop_trig" else None)
        row("P in cache", isa, f"P/{isa}/L2", f"single_glm/{level}", "glm, one arm at a time", 28 if isa == result.best else None)
    for isa in result.isas:
        level = result.level_of(isa)
        for own, work, goal in ((f"resident/{isa}/L2", "resident", 45), (f"frame/{isa}/in_one", "whole frame", 12)):
            row(work, isa, own, f"frame_ozz/{level}", "ozz-animation IKTwoBoneJob", goal if isa == result.best else None)
            row(work, isa, own, f"frame_glm/{level}", "glm, one arm at a time")
    return Table("Beside rivals: nanoseconds an arm, and how many times as fast swivel is",
                 ["work", "CPU level", "swivel", "rival", "its time", "ratio", "goal, at least", ""], rows)


def loop_goal(result, isa, level):
    """3.3, unless the ports alone take too long for it."""
    loop, bound = result.ns(f"loop_trig/{level}"), result.bound(isa)
    return None if not loop or not bound or loop / bound < 3.3 else 3.3


def limits(result):
    """What the machine can do, and how many times as long swivel takes."""
    rows = []

    def row(work, own, other, name, most=None):
        a, b = result.ns(own), result.ns(other) if isinstance(other, str) else other
        if a is None or b is None:
            return
        rows.append([work, number(a), name, number(b), f"{a / b:.2f}", f"{most:g}" if most else "–", judged(a / b, most) if most else ""])

    best, level = result.best, result.level_of(result.best)
    for isa in result.isas:
        row(f"P in cache, {ISAS[isa]}", f"P/{isa}/L2", result.bound(isa), "bound of the ports", BOUNDS.get(isa))
    for isa in result.isas:
        row(f"P in cache, {ISAS[isa]}", f"P/{isa}/L2", f"hand_staged/{isa}", "the same stages by hand", 1.05)
        row(f"P in cache, {ISAS[isa]}", f"P/{isa}/L2", f"hand/{isa}", "by hand, at once", 1.05)
    for isa in result.isas:
        row(f"P out of cache, {ISAS[isa]}", f"P/{isa}/memory", "copy/P/memory", "copy of its rows", 1.2 if isa in ("avx512", "avx2") else None)
    row("resident out of cache", f"resident/{best}/memory", "copy/resident/memory", "copy of its rows", 1.2)
    for threads in thread_counts(result):
        for what, name in (("P", "P"), ("resident", "resident")):
            row(f"{name} out of cache, {threads} threads", f"threads/{threads}/{what}/memory", f"copy_threads/{threads}/{what}/memory",
                f"{threads} copies", 1.2)
    row("whole frame", f"frame/{best}/in_one", f"frame_bare/{level}", "bare loop", 1.3)
    for threads in thread_counts(result):
        for arms in (16384, 262144):
            row(f"whole frame, {arms:,} arms, {threads} threads", f"frame_threads/{threads}/{arms}", f"bare_threads/{threads}/{arms}",
                "as many bare loops")
    return Table("Beside the machine: nanoseconds an arm, and how many times as long swivel takes",
                 ["work", "swivel", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def thread_counts(result):
    return sorted({int(name.split("/")[1]) for name in result.times if name.startswith("threads/")} - {1})


def itself(result):
    """What a kind of work costs beside a simpler one."""
    rows = []

    def row(work, own, other, name, most=None):
        a, b = result.ns(own), result.ns(other)
        if a is None or b is None:
            return
        rows.append([work, number(a), name, number(b), f"{a / b:.2f}", f"{most:g}" if most else "–", judged(a / b, most) if most else ""])

    best = result.best
    for isa in result.isas:
        row(f"one hard arm in 64, {ISAS[isa]}", f"hard/{isa}/one_in_64", f"P/{isa}/L2", "ordinary arms", 1.3)
        row(f"hard arms only, {ISAS[isa]}", f"hard/{isa}/only", f"P/{isa}/L2", "ordinary arms", 6)
    for kind in ("poles", "sizes", "numbers"):
        row(f"hard {kind}, one in 64", f"hard/{best}/{kind}/one_in_64", f"P/{best}/L2", "ordinary arms", 1.3)
        row(f"hard {kind} only", f"hard/{best}/{kind}/only", f"P/{best}/L2", "ordinary arms", 6)
    row("resident, one hard arm in 64", f"hard/{best}/resident/one_in_64", f"resident/{best}/L2", "ordinary arms", 1.3)
    row("resident, hard arms only", f"hard/{best}/resident/only", f"resident/{best}/L2", "ordinary arms", 6)
    former = f"hand/{best}"
    for name, most in (("full_arm", 5), ("cone+twist", 4), ("box", 15)):
        row(f"{LIMITED.get(name, 'Euler box')}{shares_text(result, f'features/{name}/{best}')}", f"features/{name}/{best}", former,
            "P by hand, at once", most)
    for step, most in (("apart", NOISE), ("write", None), ("solve", None), ("read", None)):
        row("whole frame in one call", f"frame/{best}/in_one", f"frame/{best}/{step}",
            "write, solve, read" if step == "apart" else f"its {step} alone", most)
    for isa in result.isas:
        for level, place in MEMORY.items():
            row(f"solve and read, {place}, {ISAS[isa]}", f"read/{isa}/{level}", f"read_hand/{isa}/{level}", "by hand, ordinary stores", NOISE)
    return Table("Beside itself: nanoseconds an arm, and how many times as long it takes",
                 ["work", "takes", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def shares_text(result, name):
    notes = result.notes.get(name, {})
    if "limited" not in notes:
        return ""
    return f", {notes['limited']:.0%} limited, {notes['infeasible']:.0%} infeasible"


def calls(result):
    """Calls of few arms: nanoseconds a call, and what is not the kernel's."""
    rows = []
    for isa in result.isas:
        for arms in (1, 16, 64, 256):
            here, kernel = result.ns(f"calls/here/{isa}/{arms}"), result.ns(f"calls/hand/{isa}/{arms}")
            if here is None or kernel is None:
                continue
            others = [result.ns(f"calls/{kind}/{isa}/{arms}") for kind in ("job", "frame")]
            rows.append([f"{arms}, {ISAS[isa]}", number(here), number(kernel), f"{max(here - kernel, 0):.0f}", "150",
                         judged(here - kernel, 150), *(number(ns) if ns else "–" for ns in others)])
    few, many = (result.ns(f"calls/frame/{result.best}/{arms}") for arms in (16, 256))
    if few and many:
        fixed = few - 16 * (many - few) / 240
        rows.append(["16 of a frame", number(few), number(few - fixed), f"{fixed:.0f}", "150", judged(fixed, 150), "–", "–"])
    return Table("Calls: nanoseconds a call", ["arms", "on this thread", "kernel", "difference", "goal, at most", "", "default job",
                                               "frame, on this thread"], rows,
                 ("The kernel is the one by hand. Of a frame it is what 16 arms more take in calls of up to 256.",))


def held(result):
    """Whole limbs by the share that limits hold back."""
    rows = []
    for name, text in LIMITED.items():
        for kind in ("limited", "infeasible"):
            names = [f"limits/{name}/free/0/{result.best}", *(f"limits/{name}/{kind}/{share}/{result.best}" for share in SHARES)]
            if all(result.ns(each) for each in names):
                counted = [result.notes[each].get(kind, 0) for each in names]
                rows.append([f"{text}, {kind}", *(f"{number(result.ns(each))}" for each in names),
                             ", ".join(f"{share:.0%}" for share in counted)])
    return Table("Whole limbs: nanoseconds an arm, by the share of limbs that their limits hold back",
                 ["limits", "0 %", *(f"{share} %" for share in SHARES), "counted shares"], rows,
                 ("Limited: the limits forbid the swivel that is wished for. Infeasible: they forbid every swivel. All other limbs are free.",))


def memory(result):
    """Solving, and reading right after it, by level of memory."""
    rows = []
    for isa in result.isas:
        for family, text in (("P", "P"), ("read", "P, and read the rows"), ("read_hand", "the same by hand, ordinary stores"),
                             ("read_fields", "P, and `swivel_read`"), ("resident", "resident"), ("read_resident", "resident, and read"),
                             ("compact", "P, compact"), ("read_compact", "P, compact, and read")):
            times = [result.ns(f"{family}/{isa}/{level}") for level in MEMORY]
            if all(times):
                rows.append([f"{text}, {ISAS[isa]}", *map(number, times)])
    return Table("By the level of memory that the rows are in: nanoseconds an arm", ["", *MEMORY.values()], rows)


def features(result):
    """Sets of features, from rows to rows."""
    rows = []
    plain = result.ns(f"P/{result.best}/L2")
    for name in result.times:
        if name.startswith("features/") and plain:
            feature, ns = name.split("/")[1], result.ns(name)
            rows.append([feature.replace("_", " ") + shares_text(result, name), number(ns), f"{ns / plain:.1f}"])
    return Table("Features: nanoseconds an arm, and beside a plain arm", ["features", "takes", "ratio"], sorted(rows, key=lambda r: float(r[2])))


def threads(result):
    """How many times as fast several threads are as one."""
    rows = []
    for family, text in (("threads", "P"), ("frame_threads", "whole frame")):
        for count in thread_counts(result):
            for arms in ("64", "1024", "16384", "262144", "P/memory", "resident/memory"):
                one, all_ns = result.ns(f"{family}/1/{arms}"), result.ns(f"{family}/{count}/{arms}")
                if one and all_ns:
                    what = f"{int(arms):,} arms" if arms.isdigit() else arms.replace("/", ", in ")
                    rows.append([f"{text}, {what}", str(count), number(one), number(all_ns), f"{one / all_ns:.2f}",
                                 "**swivel loses**" if one / all_ns < 1 / NOISE else ""])
    return Table("Threads: nanoseconds an arm by the clock on the wall", ["work", "threads", "one thread", "all of them", "ratio", ""], rows)


TABLES = {"rivals": rivals, "limits": limits, "itself": itself, "calls": calls, "held": held, "memory": memory, "features": features,
          "threads": threads}


def main(arguments):
    parser = argparse.ArgumentParser(prog="tables.py", description="Prints the tables of a result file of swivel_bench.")
    parser.add_argument("result", metavar="RESULT.json")
    parser.add_argument("--markdown", action="store_true", help="as the pages have them")
    options = parser.parse_args(arguments)
    try:
        result = Result(*read_all(options.result))
    except Refused as refused:
        print(f"tables.py: {refused}", file=sys.stderr)
        return 2
    for make in TABLES.values():
        table = make(result)
        if table.rows:
            print(table.markdown() if options.markdown else table.text(), end="\n\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
