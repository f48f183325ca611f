#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/pictures/clip_feet.svg: the legs of a recorded walk while they are in contact, with legs of 0.8, before and after
`swivel feet`. The walk is not in the repository: CMU's 02_01 as BVH.

    tools/site/clip_feet_picture.py build/release/bin/swivel cmu_02_01_walk.bvh docs/pictures/clip_feet.svg"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

INK, GREY, RED, GREEN = "#22324a", "#5b6b80", "#b93a2b", "#23834a"
LEGS = [[side + joint for joint in ("UpLeg", "Leg", "Foot", "ToeBase")] for side in ("Left", "Right")]
JOINTS = re.compile(r"(ROOT|JOINT|End)\s+(\S+)\s*\{\s*OFFSET\s+(\S+)\s+(\S+)\s+(\S+)(?:\s+CHANNELS\s+\d+((?:\s+[XYZ]\w+)+))?|\}")
BONES = r"((?:JOINT|ROOT) (?:Left|Right)(?:Leg|Foot)\s*\{\s*OFFSET) (\S+) (\S+) (\S+)"


def scaled(text, legs):
    return re.sub(BONES, lambda m: m[1] + "".join(f" {float(m[n]) * legs:.6f}" for n in (2, 3, 4)), text)


def rotation(axis, degrees):
    turn, (i, j) = np.eye(3), {"X": (1, 2), "Y": (2, 0), "Z": (0, 1)}[axis]
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turn[[i, i, j, j], [i, j, i, j]] = cos, -sin, sin, cos
    return turn


def places(text):
    """Of each frame: joint -> place."""
    head, motion = text.split("MOTION")
    joints, open_joints = {}, [None]  # name -> parent, offset, channels
    for kind, name, *offset, channels in JOINTS.findall(head):
        if not kind:  # a closing brace
            open_joints.pop()
            continue
        if kind != "End":
            joints[name] = open_joints[-1], np.array(offset, float), channels.split()
        open_joints.append(name)
    for line in motion.strip().splitlines()[2:]:
        values, at = iter(map(float, line.split())), {}
        for joint, (parent, offset, channels) in joints.items():
            place, turn = offset.copy(), np.eye(3)
            for channel in channels:
                value = next(values)
                if channel.endswith("position"):
                    place["XYZ".index(channel[0])] = value
                else:
                    turn = turn @ rotation(channel[0], value)
            above, upper = at[parent] if parent else (np.zeros(3), np.eye(3))
            at[joint] = above + upper @ place, upper @ turn
        yield {joint: place for joint, (place, _) in at.items()}


def contacts(table, count):
    """Of each leg: whether it is in contact in each frame."""
    on = {"left_leg": [False] * count, "right_leg": [False] * count}
    for row in table.splitlines()[1:]:
        frame, limb, contact = row.split(",")
        on[limb][int(frame):] = [contact == "on"] * (count - int(frame))
    return on["left_leg"], on["right_leg"]


def main(swivel, walk, out):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = Path(walk).read_text(encoding="ascii").replace("\r", "")
        (folder / "before.bvh").write_text(scaled(source, 0.8))
        run = [Path(swivel).resolve(), "feet", "--quiet"]
        subprocess.run([*run, Path(walk).resolve(), "--export-contacts", "c.csv"], cwd=folder, check=True)
        subprocess.run([*run, "before.bvh", "--contacts", "c.csv", "--out", "after.bvh"], cwd=folder, check=True)
        clips = [list(places((folder / f"{clip}.bvh").read_text())) for clip in ("before", "after")]
        legs_on = contacts((folder / "c.csv").read_text(), len(clips[0]))
    lines, height = [], 0
    way = clips[0][-1]["Hips"] - clips[0][0]["Hips"]
    way = np.array([way[0], 0, way[2]]) / np.hypot(way[0], way[2])
    level = np.array([[place @ way, place[1]] for frame in clips[0] for leg in LEGS for place in (frame[leg[0]], frame[leg[3]])])
    scale = 700 / np.ptp(level[:, 0])
    for clip, words, colour in zip(clips, ("before", "after"), (RED, GREEN)):
        floor = height + 40 + scale * np.ptp(level[:, 1])

        def point(place):
            return f"{30 + scale * (place @ way - level[:, 0].min()):.1f} {floor - scale * (place[1] - level[:, 1].min()):.1f}"

        lines.append(f'  <text x="24" y="{height + 26}" fill="{GREY}" font-size="14">{words}</text>')
        for leg, on in zip(LEGS, legs_on):
            path = "".join(" M" + " L".join(point(clip[frame][joint]) for joint in leg) for frame in range(0, len(clip), 6) if on[frame])
            lines.append(f'  <path d="{path[1:]}" fill="none" stroke="{INK}" stroke-width="1" opacity="0.45"/>')
            toes = "".join((" L" if on[frame - 2] else " M") + point(clip[frame][leg[3]]) for frame in range(2, len(clip), 2) if on[frame])
            lines.append(f'  <path d="M{toes[2:]}" fill="none" stroke="{colour}" stroke-width="4.4" stroke-linecap="round"/>')
        height = int(floor) + 14
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 {height}" font-family="DejaVu Sans, Helvetica, Arial, sans-serif">\n'
            f'  <title>The legs of a walk while they are in contact</title>\n  <rect width="760" height="{height}" rx="8" fill="#fbfaf5"/>\n')
    Path(out).write_text(head + "\n".join(lines) + "\n</svg>\n", encoding="ascii")


if __name__ == "__main__":
    main(*sys.argv[1:])
