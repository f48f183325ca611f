#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A reach test: targets on a line from near the shoulder to beyond the arm's reach, solved plainly, with a soft zone, and with a
soft zone and stretch. Writes a picture of where the wrists go and how the elbow opens.

    python3 reach.py reach.png
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

import swivel

LENGTHS = (0.30, 0.26)
REACH = sum(LENGTHS)
HEIGHT = 0.12  # of the line above the shoulder
# Soft zone far and near as shares of the reach, most stretch, least distance: swivel.Field.REACH.
WAYS = {
    "plain": (0.0, 0.0, 1.0, 0.0),
    "soft zone of 15 %": (0.15, 0.0, 1.0, 0.0),
    "soft zone, stretch up to 1.1": (0.15, 0.0, 1.1, 0.0),
}
STYLES = (("#c44e52", 3, "-"), ("#4c72b0", 3, "-"), ("#55a868", 1.8, "--"))  # colour, width, dashes
Places = npt.NDArray[np.float64]


def solve_line(count: int) -> tuple[Places, dict[str, swivel.Arms]]:
    """Targets along the line, and the arms of each way: one call solves all of them."""
    targets = np.zeros((count, 3))
    targets[:, 1] = HEIGHT
    targets[:, 2] = np.linspace(0.05, 1.25 * REACH, count)
    elbow_down = (0.0, -1.0, 0.0)
    return targets, {name: swivel.solve(targets, elbow_down, LENGTHS, reach=reach) for name, reach in WAYS.items()}


def draw_arms(axes: plt.Axes, targets: Places, arms: swivel.Arms, name: str) -> None:
    """A few arms from the side: z to the right, y up."""
    for n in np.linspace(0, len(targets) - 1, 9).astype(int):
        joints = np.stack([np.zeros(3), arms.elbow_position[n], arms.wrist_position[n]])
        axes.plot(joints[:, 2], joints[:, 1], "o-", color=plt.cm.plasma(0.85 * n / len(targets)), lw=2, ms=4)
        axes.plot(targets[n, 2], targets[n, 1], "x", color="black", ms=7)
    axes.axhline(HEIGHT, color="0.8", lw=1, zorder=0)
    axes.add_patch(plt.Circle((0, 0), REACH, fill=False, color="0.6", ls=":"))
    axes.set(title=f"The arms, {name}", xlabel="forward", ylabel="up", aspect="equal", xlim=(-0.1, 0.75), ylim=(-0.3, 0.3))


def draw_ways(axes: tuple[plt.Axes, plt.Axes], targets: Places, ways: dict[str, swivel.Arms]) -> None:
    wanted = np.linalg.norm(targets, axis=1) / REACH
    for (name, arms), (colour, width, dashes) in zip(ways.items(), STYLES):
        flexion = 2 * np.degrees(np.arctan2(arms.elbow[:, 1], arms.elbow[:, 0]))
        axes[0].plot(wanted, 100 * arms.residual, color=colour, lw=width, ls=dashes, label=name)
        axes[1].plot(wanted, flexion, color=colour, lw=width, ls=dashes, label=name)
    for each in axes:
        each.axvline(1, color="0.6", ls=":")
        each.set(xlabel="target's distance, arm lengths")
        each.grid(alpha=0.3)
    axes[0].set(title="How far the wrist stays off", ylabel="% of the arm's length")
    axes[1].set(title="How the elbow opens", ylabel="flexion, degrees")
    axes[0].legend(frameon=False)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draws a reach test of one arm.")
    parser.add_argument("out", nargs="?", default="reach.png", help="picture to write (default: %(default)s)")
    out: str = parser.parse_args().out
    targets, ways = solve_line(500)
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.5), layout="constrained")
    draw_arms(axes[0, 0], targets, ways["plain"], "plain")
    draw_arms(axes[0, 1], targets, ways["soft zone, stretch up to 1.1"], "soft and stretched")
    draw_ways((axes[1, 0], axes[1, 1]), targets, ways)
    figure.savefig(out, dpi=110)
    reached = np.mean((ways["plain"].flags & swivel.Flag.REACHED) != 0)
    print(f"{out}: {len(targets)} targets, {reached:.0%} of them within reach")


if __name__ == "__main__":
    main()
