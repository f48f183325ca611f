#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of a result file of swivel_bench: swivel beside its rivals, beside what the machine can do, and beside itself. Each row has
its ratio, the goal of it where there is one, and says where swivel loses. Rows whose benchmarks did not run are left out.

usage: bench/tables.py RESULT.json
"""
import argparse
import sys
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from results import Refused, read_all  # noqa: E402

ISAS = {"avx512": "AVX-512", "avx2": "AVX2", "sse2": "SSE2", "neon64": "NEON", "scalar": "scalar"}
MEMORY = {"L1": "level 1 cache", "L2": "level 2 cache", "L3": "level 3 cache", "memory": "memory"}
LOOPS = {"loop_trig": "loop with two acos", "loop_light": "loop with one acos", "loop_roots": "loop with half-angle roots"}
LIMITED = {"cone+twist": "cone and twist", "full_arm": "full arm", "full_arm+box": "full arm and Euler box"}
SHARES = (5, 14, 50, 100)
NOISE = 1.03  # ratios nearer to 1 decide nothing
CALL_GOAL = 150  # nanoseconds that a call may take beside its kernel
BODY_GOAL = 110  # nanoseconds of a body with AVX-512
PLANT_GOAL, FIT_GOAL = 4.5, 2  # nanoseconds of a planted leg, and of a body's shift for two legs, with AVX-512
CHARACTER_GOAL = 200  # nanoseconds of character C with AVX-512
LOOP = "loop_trig/*"  # a goal only where the bound of the ports allows it
# The goals of release 0.2, as ratios of two benchmarks; the first that fits a row is its goal. They were set before that release was
# written, on 2026-11-22, by a run of the former library on a virtual EPYC (Zen 4, g++ 12.2, one thread). With AVX-512 a plain arm took
# 1.9 ns in cache, the bound of its ports 1.2, the loop with two acos 6.3, glm 53, IKTwoBoneJob 150 and a copy of its rows 2.6. The goals
# of bodies were set before bodies were written.
GOALS = (
    # rivals: at least so many times as fast
    ("P/*/L2", LOOP, 3.3),
    ("P/{best}/L2", "single_glm/*", 28),
    ("resident/{best}/L2", "frame_ozz/*", 45),
    ("frame/{best}/in_one", "frame_ozz/*", 12),
    ("bodies/{best}", "bodies_glm/*", 5),
    # the machine: at most so many times as long
    ("P/avx512/L2", "bound/*", 1.6),
    ("P/avx2/L2", "bound/*", 2.0),
    ("P/sse2/L2", "bound/*", 2.3),
    ("P/*/L2", "hand/*", 1.05),
    ("P/avx512/memory", "copy/P/memory", 1.2),
    ("P/avx2/memory", "copy/P/memory", 1.2),
    ("resident/*/memory", "copy/resident/memory", 1.2),
    ("threads/*", "copy_threads/*", 1.2),
    ("frame/*/in_one", "frame_bare/*", 1.3),
    ("bodies/{best}", "bound_bodies/*", 1.5),
    ("bodies/avx512", "goal_bodies/*", 1),
    ("plant/*", "bound_plant/*", 1.5),
    ("plant/avx512", "goal_plant/*", 1),
    ("fit/*", "bound_fit/*", 1.5),
    ("fit/avx512", "goal_fit/*", 1),
    ("look/*", "bound_look/*", 1.6),
    ("character/*/all", "bound_character/*", 1.5),
    ("character/avx512/all", "goal_character/*", 1),
    ("bodies_threads/2", "bodies_processes/2", 1.11),  # 0.9 times as fast
    # itself: at most so many times as long
    ("hard/*/one_in_64", "*", 1.3),
    ("hard/*/only", "*", 6),
    ("features/full_arm/*", "hand/*", 5),
    ("features/cone+twist/*", "hand/*", 4),
    ("features/box/*", "hand/*", 15),
    ("frame/*/in_one", "frame/*/apart", NOISE),
)


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
        self.context, self.times, self.notes = context, dict(times), notes
        self.isas = context.get("isas", "").split()
        self.best = self.isas[0] if self.isas else ""
        self.levels = {key.removeprefix("level_of/"): isa for key, isa in context.items() if key.startswith("level_of/")}
        for bound in (f"{family}/{isa}" for family in ("bound", "bound_production", "bound_forward", "bound_limbs", "bound_plant", "bound_fit", "bound_look",
                                                               "bound_character")
                      for isa in self.isas):
            parts = [self.ns(f"{bound}/{part}") for part in ("divider", "arithmetic")]
            if all(parts):  # the least time that divider and arithmetic allow
                self.times[bound] = max(parts)
        self.add_stages_of_bodies()
        self.add_feet()

    def add_stages_of_bodies(self):
        """What a body's stages take, as differences of jobs, and the sum of what bounds them."""
        self.times["goal_bodies/avx512"] = BODY_GOAL
        for isa in self.isas:
            bounds = [self.ns(bound) for bound in (f"bound_forward/{isa}", f"bound_limbs/{isa}", "bodies/copy")]
            if all(bounds):
                self.times[f"bound_bodies/{isa}"] = sum(bounds)
            whole, one, from_rows = (self.ns(f"{job}/{isa}") for job in ("bodies", "bodies_one_limb", "bodies_from_rows"))
            if whole and one and from_rows:
                forward, goals = (4 * one - whole) / 3, whole - from_rows
                self.times |= {f"body_stage/{isa}/forward": forward, f"body_stage/{isa}/goals": goals,
                               f"body_stage/{isa}/limbs": whole - forward - goals}

    def add_feet(self):
        """What plants add to a leg, and a shift and a look to a body, as differences of jobs."""
        for isa in self.isas:
            goals, planted, capped, fitted = (self.ns(f"feet/{isa}/{job}") for job in ("goals", "planted", "capped", "fitted"))
            if goals and planted and capped and fitted:
                self.times |= {f"plant/{isa}": (planted - goals) / 2, f"cap/{isa}": (capped - planted) / 2, f"fit/{isa}": fitted - capped}
            arms, look = (self.ns(f"looks/{isa}/{job}") for job in ("arms", "look"))
            if arms and look:
                self.times[f"look/{isa}"] = look - arms
        self.times |= {"goal_plant/avx512": PLANT_GOAL, "goal_fit/avx512": FIT_GOAL,
                       "goal_character/avx512": CHARACTER_GOAL}

    def ns(self, name):
        return self.times.get(name)

    def level_of(self, isa):
        """The rivals' level of flags whose registers are as wide."""
        return next((level for level, of in self.levels.items() if of == isa), None)

    def goal(self, own, other):
        """The goal of a ratio of two benchmarks, if it has one. The loop is none where the bound of the ports rules it out."""
        for mine, theirs, goal in GOALS:
            if fnmatchcase(own, mine.format(best=self.best)) and fnmatchcase(other, theirs):
                bound = self.ns("bound/" + own.split("/")[1]) if theirs == LOOP else None
                return None if bound and self.ns(other) / bound < goal else goal
        return None


def number(ns):
    return f"{ns:.0f}" if ns >= 99.5 else f"{ns:.1f}" if ns >= 9.95 else f"{ns:.2f}"


def judged(ratio, most):
    """Whether a ratio is at most its goal."""
    return "kept" if ratio <= most else "missed"


def row(result, cells, own, other, name, rival=False):
    """What swivel's benchmark takes beside another's: both times, their ratio, its goal and whether it is kept. There is no row if one of
    them did not run. The ratio says how many times as long swivel takes; beside a rival, how many times as fast it is."""
    a, b = result.ns(own), result.ns(other)
    if a is None or b is None:
        return []
    goal = result.goal(own, other)
    if rival:
        verdict = judged(goal, b / a) if goal else "**swivel loses**" if b / a < 1 / NOISE else ""
    else:
        verdict = judged(a / b, goal) if goal else ""
    ratio = f"{b / a:.1f}" if rival else f"{a / b:.2f}"
    return [[*cells, number(a), name, number(b), ratio, f"{goal:g}" if goal else "–", verdict]]


def rivals(result):
    """Who does the same work, and how many times as long it takes."""
    rows = []
    for isa in result.isas:
        level = result.level_of(isa)
        for loop, name in (*LOOPS.items(), ("single_glm", "glm, one arm at a time")):
            rows += row(result, ["P in cache", ISAS[isa]], f"P/{isa}/L2", f"{loop}/{level}", name, rival=True)
    for isa in result.isas:
        level = result.level_of(isa)
        for own, work in ((f"resident/{isa}/L2", "resident"), (f"frame/{isa}/in_one", "whole frame")):
            rows += row(result, [work, ISAS[isa]], own, f"frame_ozz/{level}", "ozz-animation IKTwoBoneJob", rival=True)
            rows += row(result, [work, ISAS[isa]], own, f"frame_glm/{level}", "glm, one arm at a time", rival=True)
    for isa in result.isas:
        rows += row(result, ["bodies", ISAS[isa]], f"bodies/{isa}", f"bodies_glm/{result.level_of(isa)}", "glm, one body at a time", rival=True)
        rows += row(result, ["characters", ISAS[isa]], f"character/{isa}/all", f"character_glm/{result.level_of(isa)}", "glm, one at a time", rival=True)
    return Table("Beside rivals: nanoseconds an arm or a body, and how many times as fast swivel is",
                 ["work", "CPU level", "swivel", "rival", "its time", "ratio", "goal, at least", ""], rows)


def limits(result):
    """What the machine can do, and how many times as long swivel takes."""
    rows = []
    best, level = result.best, result.level_of(result.best)
    for other, name in (("bound", "bound of the ports"), ("hand", "the same stages by hand"), ("hand_staged", "by hand, in loops over strips")):
        for isa in result.isas:
            rows += row(result, [f"P in cache, {ISAS[isa]}"], f"P/{isa}/L2", f"{other}/{isa}", name)
    for isa in result.isas:
        rows += row(result, [f"P out of cache, {ISAS[isa]}"], f"P/{isa}/memory", "copy/P/memory", "copy of its rows")
    rows += row(result, ["resident out of cache"], f"resident/{best}/memory", "copy/resident/memory", "copy of its rows")
    for threads in thread_counts(result):
        for what in ("P", "resident"):
            rows += row(result, [f"{what} out of cache, {threads} threads"], f"threads/{threads}/{what}/memory",
                        f"copy_threads/{threads}/{what}/memory", f"{threads} copies")
    rows += row(result, ["whole frame"], f"frame/{best}/in_one", f"frame_bare/{level}", "bare loop")
    for threads in thread_counts(result):
        for arms in (16384, 262144):
            rows += row(result, [f"whole frame, {arms:,} arms, {threads} threads"], f"frame_threads/{threads}/{arms}",
                        f"bare_threads/{threads}/{arms}", "as many bare loops")
    return Table("Beside the machine: nanoseconds an arm, and how many times as long swivel takes",
                 ["work", "swivel", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def thread_counts(result):
    return sorted({int(name.split("/")[1]) for name in result.times if name.startswith("threads/")} - {1})


def itself(result):
    """What a kind of work costs beside a simpler one."""
    rows, best = [], result.best
    hard = [(f"hard/{isa}", f"P/{isa}/L2", f"hard arms, {ISAS[isa]}") for isa in result.isas]
    hard += [(f"hard/{best}/{kind}", f"P/{best}/L2", f"hard {kind}") for kind in ("poles", "sizes", "numbers")]
    hard += [(f"hard/{best}/resident", f"resident/{best}/L2", "resident, hard arms")]
    for family, ordinary, what in hard:
        rows += row(result, [f"{what}, one in 64"], f"{family}/one_in_64", ordinary, "ordinary arms")
        rows += row(result, [f"{what}, only these"], f"{family}/only", ordinary, "ordinary arms")
    for name in ("full_arm", "cone+twist", "box"):
        own = f"features/{name}/{best}"
        rows += row(result, [LIMITED.get(name, "Euler box") + shares_text(result, own)], own, f"hand/{best}", "P by hand")
    for step in ("apart", "write", "solve", "read"):
        rows += row(result, ["whole frame in one call"], f"frame/{best}/in_one", f"frame/{best}/{step}",
                    "write, solve, read" if step == "apart" else f"its {step} alone")
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

    def add(arms, here, kernel, *others):
        rows.append([arms, number(here), number(kernel), f"{here - kernel:+.0f}", f"{CALL_GOAL}", judged(here - kernel, CALL_GOAL),
                     *(number(ns) if ns else "–" for ns in others)])

    for isa in result.isas:
        for arms in (1, 16, 64, 256):
            here, kernel, job, frame = (result.ns(f"calls/{kind}/{isa}/{arms}") for kind in ("here", "hand", "job", "frame"))
            if here and kernel:
                add(f"{arms}, {ISAS[isa]}", here, kernel, job, frame)
    few, many = (result.ns(f"calls/frame/{result.best}/{arms}") for arms in (16, 256))
    if few and many:
        add("16 of a frame", few, 16 * (many - few) / 240, None, None)
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
        for family, text in (("P", "P"), ("read", "P, and read the rows"), ("read_fields", "P, and `swivel_read`"),
                             ("resident", "resident"), ("read_resident", "resident, and read")):
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


def production(result):
    """The production limb: what each feature adds, the bound of the ports, and the steps of a whole frame."""
    rows = []
    for isa in result.isas:
        steps = [name for name in result.times if name.startswith(f"production/{isa}/") and name.split("/")[2][0].isdigit()]
        last = None
        for name in sorted(steps, key=lambda each: int(each.split("/")[2].split("_")[0])):
            ns, feature = result.ns(name), name.split("/")[2].split("_", 1)[1].replace("_", " ")
            rows.append([f"in cache, {ISAS[isa]}", *((feature, number(ns), "–") if last is None
                                                     else (f"with {feature}", number(ns), f"{ns - last:+.1f} to the line above"))])
            last = ns
        if last and (bound := result.ns(f"bound_production/{isa}")):
            rows.append([f"in cache, {ISAS[isa]}", "bound of the ports", number(bound), f"the limb takes {last / bound:.2f} times as long"])
        if ns := result.ns(f"production/{isa}/in_one"):
            rows.append([f"16,384 limbs, {ISAS[isa]}", "whole frame in one call", number(ns),
                         shares_text(result, f"production/{isa}/in_one").removeprefix(", ") or "–"])
    for step, text in (("write", "its write alone"), ("solve", "its solve alone"), ("read", "its read alone"), ("copy", "a copy of its structures")):
        if ns := result.ns(f"production/{result.best}/{step}"):
            rows.append([f"16,384 limbs, {ISAS[result.best]}", text, number(ns), "–"])
    return Table("The production limb: nanoseconds a limb", ["work", "", "takes", "beside"], rows)


def bodies(result):
    """Character B: its stages with their shares, all of it beside what bounds it, and threads beside processes."""
    rows, best = [], result.best
    for stage, text, bound in (("forward", "poses in, forward kinematics", "bound_forward"), ("goals", "goals in", ""),
                               ("limbs", "four limbs, joints out", "bound_limbs")):
        own = f"body_stage/{best}/{stage}"
        if ns := result.ns(own):
            what = f"{text}, {ISAS[best]}: {ns / result.ns(f'bodies/{best}'):.0%}"
            rows += row(result, [what], own, f"{bound}/{best}", "bound of the ports") or [[what, number(ns), *["–"] * 4, ""]]
    for isa in result.isas:
        for other, name in ((f"bound_bodies/{isa}", "both bounds and a copy"), ("bodies/copy", "copy of the same bytes"),
                            (f"goal_bodies/{isa}", "the goal")):
            rows += row(result, [f"all, {ISAS[isa]}"], f"bodies/{isa}", other, name)
    rows += row(result, ["all, two threads"], "bodies_threads/2", "bodies_processes/2", "two processes side by side")
    return Table("Bodies: nanoseconds a body, and how many times as long swivel takes",
                 ["work", "swivel", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def feet(result):
    """What plants and shifts add to legs that have goals anyway, and a look to arms."""
    rows = []
    for isa in result.isas:
        for own, text in (("plant", "a planted leg"), ("fit", "a shift for two legs"), ("look", "a look of four joints")):
            for other, name in (("bound", "bound of the ports"), ("goal", "the goal")):
                rows += row(result, [f"{text}, {ISAS[isa]}"], f"{own}/{isa}", f"{other}_{own}/{isa}", name)
    return Table("Feet and looks: nanoseconds more than limbs with goals take",
                 ["work", "swivel", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def character(result):
    """Character C, its parts, and the sum of what bounds them."""
    rows = []
    for isa in result.isas:
        for part in ("legs", "look", "arms"):
            if ns := result.ns(f"character/{isa}/{part}"):
                rows.append([f"{part} alone, {ISAS[isa]}", number(ns), *["–"] * 4, ""])
        for other, name in ((f"bound_character/{isa}", "its stages' bounds"), (f"goal_character/{isa}", "the goal")):
            rows += row(result, [f"a character, {ISAS[isa]}"], f"character/{isa}/all", other, name)
    return Table("Characters: nanoseconds a character, and how many times as long swivel takes",
                 ["work", "swivel", "beside it", "its time", "ratio", "goal, at most", ""], rows)


def threads(result):
    """How many times as fast several threads are as one."""
    rows = []
    for family, text in (("threads", "P"), ("frame_threads", "whole frame")):
        for count in thread_counts(result):
            for arms in ("64", "1024", "16384", "262144", "P/memory", "resident/memory"):
                one, all_ns = result.ns(f"{family}/1/{arms}"), result.ns(f"{family}/{count}/{arms}")
                if one and all_ns:
                    what = f"{text}, {int(arms):,} arms" if arms.isdigit() else arms.replace("/", ", in ")
                    rows.append([what, str(count), number(one), number(all_ns), f"{one / all_ns:.2f}",
                                 "no gain" if one / all_ns < 1 / NOISE else ""])
    return Table("Threads: nanoseconds an arm by the clock on the wall", ["work", "threads", "one thread", "all of them", "ratio", ""], rows)


def machine(result):
    return f"{result.context.get('cpu', 'unknown')}, with {ISAS.get(result.best, result.best)}"


def summary(result):
    """What the README shows of a result."""
    best, level = result.best, result.level_of(result.best)
    rows = []
    for work, own, other in (("a plain arm, rows in cache", f"P/{best}/L2", f"single_glm/{level}"),
                             ("the same with parent frames and a skeleton's rotations", f"resident/{best}/L2", ""),
                             ("a whole frame of 16,384 arms: an engine's own structures in and out", f"frame/{best}/in_one", f"frame_glm/{level}")):
        a, b = result.ns(own), result.ns(other)
        if a:
            rows.append([work, number(a), *((number(b), f"{b / a:.1f}") if b else ("–", "–"))])
    return Table("In short: nanoseconds an arm", [machine(result), "swivel", "one at a time", "ratio"], rows)


TABLES = {"rivals": rivals, "limits": limits, "itself": itself, "calls": calls, "held": held, "memory": memory, "features": features,
          "production": production, "bodies": bodies, "feet": feet, "character": character, "threads": threads, "summary": summary}


def arm(result):
    """What the README's list says."""
    return f"{number(result.times[f'P/{result.best}/L2'])} nanoseconds on one core with {ISAS[result.best]}"


def answer(result):
    """What the frequent questions say."""
    best, plain = result.best, result.times[f"P/{result.best}/L2"]
    limited = [f"{result.times[f'features/{name}/{best}'] / plain:.0f}" for name in ("at_rest", "cone+twist", "full_arm")]
    return (f"On one thread ({machine(result)}), an arm takes {number(plain)} nanoseconds with rows in cache. "
            f"From and to an engine's own structures it takes {number(result.times[f'frame/{best}/in_one'])}. "
            f"A whole limb takes about {limited[0]} times as long as a plain arm. With a cone and a twist it takes about {limited[1]} "
            f"times as long. With a hand, an incoming pose, weights and two limits it takes about {limited[2]} times as long.")


SENTENCES = {"arm": arm, "answer": answer}


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
