#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/speed.md from a result file of swivel_bench: speed.svg, nanoseconds an arm against the crowd's size,
roofline.svg, what the kernels do beside what this machine can do, and limits.svg, nanoseconds an arm against the share of limbs that
limits hold back. The same file gives the same bytes.

usage: bench/plot.py RESULT.json     (python3-matplotlib)
"""
import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from results import Refused, read_results  # noqa: E402

# Okabe and Ito's colours, told apart by everyone, and marks that do not need them.
STYLES = [("#0072B2", "o"), ("#D55E00", "s"), ("#009E73", "^"), ("#CC79A7", "D"), ("#56B4E9", "v")]
ISA_TEXT = {"avx512": "AVX-512", "avx2": "AVX2", "sse2": "SSE2", "neon64": "NEON", "scalar": "scalar"}
LEVELS = ["L1", "L2", "L3", "memory"]


def number(context, key):
    try:
        return float(context[key])
    except (KeyError, ValueError) as error:
        raise Refused(f"the result does not say {key}; write it with swivel_bench --benchmark_out=...") from error


def growth_of(times, isa):
    """[(arms, nanoseconds an arm)], by arms."""
    prefix = f"growth/{isa}/"
    return sorted((int(name[len(prefix):]), ns) for name, ns in times.items() if name.startswith(prefix))


def limits_of(times):
    """By limits and kind: [(percent of limbs, nanoseconds an arm)], by percent. Free limbs start both kinds."""
    curves = {}
    for name, ns in times.items():
        if name.startswith("limits/"):
            _, limits, kind, share, _ = name.split("/")
            for each in ("limited", "infeasible") if kind == "free" else (kind,):
                curves.setdefault((limits, each), []).append((int(share), ns))
    return {key: sorted(points) for key, points in curves.items()}


def roofline_of(context, times, isas):
    """Of problem P: operations a byte, operations a nanosecond, roofs, and what was reached in each level of memory."""
    operations = sum(number(context, f"ops/{kind}") for kind in ("roots", "divisions", "multiplications", "additions"))
    return {
        "intensity": operations / number(context, "row_bytes"),
        "peaks": {isa: number(context, f"flops_per_ns/{isa}") for isa in isas},
        "slopes": {level: number(context, f"copy_bytes_per_ns/{level}") for level in LEVELS},
        "reached": {isa: {level: operations / times[f"P/{isa}/{level}"] for level in LEVELS if f"P/{isa}/{level}" in times}
                    for isa in isas},
    }


def new_figure(plt, title, context):
    figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
    figure.patch.set_facecolor("white")
    axes.set_title(f"{title}\n{context.get('cpu', 'unknown CPU')}, one thread", fontsize=11)
    axes.grid(True, which="major", color="#dddddd", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return figure, axes


def plain_ticks(plt, axis, steps):
    """1,000 instead of a power of ten; a tick at each of the steps of a decade."""
    axis.set_major_locator(plt.LogLocator(subs=steps, numticks=50))
    axis.set_major_formatter(plt.FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1 else f"{value:g}"))
    axis.set_minor_locator(plt.NullLocator())


def draw_speed(plt, context, times, isas):
    figure, axes = new_figure(plt, "Problem P: time an arm against the crowd's size", context)
    for (color, marker), isa in zip(STYLES, isas):
        points = growth_of(times, isa)
        if points:
            axes.loglog(*zip(*points), color=color, marker=marker, markersize=5, label=ISA_TEXT.get(isa, isa))
    axes.set_xlabel("arms in the crowd")
    axes.set_ylabel("nanoseconds an arm")
    plain_ticks(plt, axes.xaxis, (1,))
    plain_ticks(plt, axes.yaxis, (1, 2, 5))
    axes.legend(frameon=False)
    return figure


def draw_limits(plt, context, times, isas):
    figure, axes = new_figure(plt, f"Whole limbs, {ISA_TEXT.get(isas[0], isas[0])}: time an arm against the share held back", context)
    curves = limits_of(times)
    for (color, marker), limits in zip(STYLES, sorted({limits for limits, _ in curves})):
        for kind, line in (("limited", "--"), ("infeasible", "-")):
            axes.plot(*zip(*curves[limits, kind]), color=color, marker=marker, markersize=5, linestyle=line,
                      label=f"{limits.replace('_', ' ').replace('+', ', ')}: {kind}")
    axes.set_xlabel("% of limbs whose limits forbid the wish (limited) or every swivel (infeasible)")
    axes.set_ylabel("nanoseconds an arm")
    axes.set_ylim(bottom=0)
    axes.legend(frameon=False, fontsize=9)
    return figure


def draw_roofline(plt, context, times, isas):
    roofline = roofline_of(context, times, isas)
    figure, axes = new_figure(plt, "Problem P under this machine's roofs", context)
    top = max(roofline["peaks"].values())
    left, right = 0.05, 50
    for level, slope in roofline["slopes"].items():
        end = min(top / slope, right)
        axes.loglog([left, end], [left * slope, end * slope], color="#888888", linewidth=1)
        # Along the roof, near its left end; the angle is meant in the units of both axes.
        axes.text(left * 1.1, left * 1.1 * slope * 1.08, f"{level} {slope:.0f} GB/s", fontsize=8, color="#555555",
                  rotation=math.degrees(math.atan(slope)), rotation_mode="anchor", transform_rotates_text=True, zorder=5,
                  bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.2})
    for (color, marker), isa in zip(STYLES, isas):
        peak, reached = roofline["peaks"][isa], roofline["reached"][isa]
        start = peak / max(roofline["slopes"].values())
        axes.plot([start, right], [peak, peak], color=color, linewidth=1.5)
        axes.annotate(f"{ISA_TEXT.get(isa, isa)} {peak:.0f}", (right, peak), fontsize=8, color=color, ha="right",
                      xytext=(0, 3), textcoords="offset points")
        # Rings around dots, as both may be in one place.
        for level, fill, size, place in (("L1", color, 5, "in cache"), ("memory", "none", 9, "out of cache")):
            if level in reached:
                axes.plot(roofline["intensity"], reached[level], linestyle="none", marker=marker, markersize=size,
                          color=color, markerfacecolor=fill, label=f"{ISA_TEXT.get(isa, isa)}, {place}")
    axes.set_xlim(left, right)
    axes.set_xlabel("operations a byte of rows")
    axes.set_ylabel("GFLOP/s, none fused")
    plain_ticks(plt, axes.xaxis, (1,))
    plain_ticks(plt, axes.yaxis, (1, 2, 5))
    axes.legend(frameon=False, fontsize=8, loc="lower right")
    return figure


def main(arguments):
    parser = argparse.ArgumentParser(prog="plot.py", description="Draws speed.svg, roofline.svg and limits.svg from a result file "
                                                                 "of swivel_bench.")
    parser.add_argument("result", metavar="RESULT.json", help="a full run's result")
    parser.add_argument("--out", metavar="FOLDER", default=str(Path(__file__).resolve().parent.parent / "docs"),
                        help="where to write them (default: docs)")
    options = parser.parse_args(arguments)
    try:
        context, times = read_results(options.result)
        isas = context.get("isas", "").split()
        if not any(growth_of(times, isa) for isa in isas):
            raise Refused(f"{options.result}: no growth/ in it; run swivel_bench without a filter")
        if not limits_of(times):
            raise Refused(f"{options.result}: no limits/ in it; run swivel_bench without a filter")
        try:
            import matplotlib
        except ImportError as error:
            raise Refused("matplotlib is missing; install python3-matplotlib and use /usr/bin/python3") from error
        matplotlib.use("svg")
        matplotlib.rcParams.update({"svg.hashsalt": "swivel", "svg.fonttype": "path", "font.family": "DejaVu Sans",
                                    "font.size": 10, "xtick.labelsize": 9, "ytick.labelsize": 9})
        from matplotlib import pyplot as plt
        draws = {"speed.svg": draw_speed, "roofline.svg": draw_roofline, "limits.svg": draw_limits}
        figures = {name: draw(plt, context, times, isas) for name, draw in draws.items()}
        for name, figure in figures.items():
            path = Path(options.out) / name
            figure.savefig(path, metadata={"Date": None, "Creator": None})
            print(path)
    except Refused as refused:
        print(f"plot.py: {refused}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"plot.py: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
