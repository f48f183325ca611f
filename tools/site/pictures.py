#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/pictures. The same script gives the same bytes; a test compares them with what is committed.

usage: tools/site/pictures.py [FOLDER]     (default: docs/pictures)
"""
import math
import sys
from pathlib import Path

from drawing import (BLUE, FAINT, GREEN, INK, ORANGE, RED, SOFT, VIOLET, Picture, View, circle, cross, dot, plus, unit)

SHOULDER, WRIST, UPPER, FORE = (0.0, 0.0, 0.0), (1.55, 0.1, 0.15), 1.0, 0.95


def elbow_circle(wrist=WRIST):
    """Centre, axis, radius of the circle on which the elbow can be."""
    distance = math.sqrt(dot(wrist, wrist))
    along = (distance ** 2 + UPPER ** 2 - FORE ** 2) / (2 * distance)
    axis = unit(wrist)
    return plus(SHOULDER, axis, along), axis, math.sqrt(UPPER ** 2 - along ** 2)


def side_of(pole, axis):
    """The direction from the line to the pole, across the line."""
    return unit(plus(pole, axis, -dot(pole, axis)))


def bone(picture, view, a, b, stroke=INK, width=9):
    picture.line(view(a), view(b), stroke, width)


def ring(picture, view, points, stroke, width=2, dash=None):
    picture.path([view(p) for p in points], stroke, width, dash=dash)


def swivel_circle():
    picture = Picture(760, 400, "The elbow's circle and the pole")
    view = View((-0.75, 0.5, 1.0), (0, 1, 0), 205, (190, 275))
    centre, axis, radius = elbow_circle()
    side = side_of((0.3, 1.0, 0.25), axis)
    pole = plus(plus(centre, side, 1.0), axis, 0.25)
    elbow = plus(centre, side, radius)
    plane = [plus(plus(centre, axis, a), side, b) for a, b in ((-1.05, -0.28), (1.15, -0.28), (1.15, 1.02), (-1.05, 1.02))]
    picture.path([view(p) for p in plane], "#b9cdec", 1, "#e6eefa", closed=True)
    picture.line(view(SHOULDER), view(WRIST), SOFT, 1.5, "6 5")
    for degrees in (75, 150, 225, 290):
        other = circle(centre, axis, side, radius, degrees, degrees + 1, 1)[0]
        bone(picture, view, SHOULDER, other, "#d9dee6", 6)
        bone(picture, view, other, WRIST, "#d9dee6", 6)
        picture.dot(view(other), 5, "#e6b981")
    ring(picture, view, circle(centre, axis, side, radius), ORANGE, 2.5)
    bone(picture, view, SHOULDER, elbow)
    bone(picture, view, elbow, WRIST, width=8)
    picture.line(view(elbow), view(pole), RED, 2, "3 4")
    picture.dot(view(pole), 6, RED)
    picture.dot(view(SHOULDER), 10, BLUE)
    picture.dot(view(elbow), 9, ORANGE)
    picture.dot(view(WRIST), 10, GREEN)
    normal = unit(cross(WRIST, pole))
    picture.arrow(view(centre), view(plus(centre, normal, 0.62)), VIOLET, 2.5)
    labels(picture, view, [(SHOULDER, (-14, 30), "shoulder", BLUE, "end"), (WRIST, (16, 22), "wrist", GREEN, "start"),
                           (elbow, (18, -2), "elbow", ORANGE, "start"), (pole, (14, 4), "pole", RED, "start"),
                           (plus(centre, normal, 0.62), (10, 12), "normal n = line × pole", VIOLET, "start")])
    picture.words((748, 30), "swivel plane: through shoulder, elbow and wrist", "#4a73b5", anchor="end")
    picture.words((748, 386), "elbow's circle: the one freedom a wrist target leaves", ORANGE, anchor="end")
    return picture


def labels(picture, view, entries):
    for point, (dx, dy), text, fill, anchor in entries:
        x, y = view(point)
        picture.words((x + dx, y + dy), text, fill, anchor=anchor)


def arm_frame():
    picture = Picture(760, 330, "The arm frame: rest pose and flexion")
    view = View((-0.95, 0.42, -0.5), (0, 1, 0), 215, (150, 245))
    rest_elbow, rest_wrist = (0, 0, 1.0), (0, 0, 1.95)
    bent = (0, 0.95 * math.sin(1.0), 1 + 0.95 * math.cos(1.0))
    for axis, end, text, fill, shift in (((1, 0, 0), 0.8, "x", RED, (-20, -10)), ((0, 1, 0), 0.85, "y", GREEN, (10, 2)),
                                         ((0, 0, 1), 2.4, "z: along the bones", BLUE, (-40, -12))):
        tip = tuple(end * part for part in axis)
        picture.arrow(view(SHOULDER), view(tip), fill, 2)
        labels(picture, view, [(tip, shift, text, fill, "start")])
    bone(picture, view, rest_elbow, rest_wrist, "#cdd4de", 8)
    bone(picture, view, SHOULDER, rest_elbow)
    bone(picture, view, rest_elbow, bent, width=8)
    ring(picture, view, circle(rest_elbow, (-1, 0, 0), (0, 0, 1), 0.62, 4, 51), ORANGE, 2.5)
    hinge = plus(rest_elbow, (1, 0, 0), 0.42)
    picture.line(view(plus(rest_elbow, (1, 0, 0), -0.3)), view(hinge), RED, 2, "4 4")
    picture.dot(view(SHOULDER), 10, BLUE)
    picture.dot(view(rest_elbow), 9, ORANGE)
    picture.dot(view(bent), 9, GREEN)
    picture.dot(view(rest_wrist), 7, "#cdd4de")
    labels(picture, view, [(SHOULDER, (0, 32), "shoulder", BLUE, "middle"), (bent, (14, 4), "wrist, bent", GREEN, "start"),
                           (rest_wrist, (0, 32), "wrist at rest", SOFT, "middle"), (rest_elbow, (0, 32), "elbow", ORANGE, "middle")])
    x, y = view(circle(rest_elbow, (-1, 0, 0), (0, 0, 1), 0.66, 26, 27, 1)[0])
    picture.words((x + 10, y - 8), "flexion about −x, 0 to π", ORANGE)
    return picture


def axes(picture, at, turn, size=34, text=None):
    """A frame on the paper: x and y turned by degrees."""
    for fill, degrees in ((RED, turn), (GREEN, turn + 90)):
        t = math.radians(degrees)
        picture.arrow(at, (at[0] + size * math.cos(t), at[1] - size * math.sin(t)), fill, 2.2, 7)
    picture.dot(at, 4, INK)
    if text:
        picture.words((at[0] + 8, at[1] + 22), text, INK, 14)


def spaces():
    picture = Picture(760, 400, "World, parent, arm frame and joints")
    joints = {"chest": (250, 235), "clavicle": (300, 150), "shoulder": (375, 135), "elbow": (505, 205), "wrist": (630, 130)}
    picture.path([(225, 330), (232, 190), (262, 130), (318, 128), (352, 190), (345, 330)], "#d4dae3", 2, "#eef1f5", closed=True)
    picture.dot((292, 88), 34, "#eef1f5", "#d4dae3")
    names = list(joints)
    for a, b in zip(names, names[1:]):
        picture.line(joints[a], joints[b], "#c3ccd8" if a in ("chest", "clavicle") else INK, 8)
    picture.path([(40, 330), (720, 330)], FAINT, 1.5, dash="2 5")
    axes(picture, (60, 325), 0, 44)
    picture.words((50, 352), "WORLD: targets, poles and hands,", INK, 14)
    picture.words((50, 372), "with SWIVEL_WORLD", SOFT, 14)
    axes(picture, joints["clavicle"], 12)
    picture.words((222, 176), "parent", INK, 14, "end")
    picture.words((222, 194), "joint", INK, 14, "end")
    picture.line((228, 172), (290, 154), FAINT, 1.2)
    axes(picture, joints["shoulder"], -24)
    axes(picture, joints["elbow"], 31)
    picture.words((395, 58), "arm frame: origin at the shoulder,", VIOLET, 14)
    picture.words((395, 77), "lies in the parent joint as the binding says", VIOLET, 14)
    picture.line((412, 84), (381, 126), VIOLET, 1.2)
    picture.words((395, 262), "SHOULDER, ELBOW, WRIST with SWIVEL_JOINTS:", INK, 14)
    picture.words((395, 282), "each joint's rotation in the joint above it", SOFT, 14)
    for a, b in (("shoulder", "elbow"), ("elbow", "wrist")):
        middle = tuple((p + q) / 2 for p, q in zip(joints[a], joints[b]))
        picture.line((middle[0], 246), (middle[0], middle[1] + 10), FAINT, 1.2)
    picture.dot(joints["wrist"], 6, INK)
    picture.dot(joints["wrist"], 13, "none", RED)
    picture.words((650, 126), "target", RED, 14)
    return picture


def arc_points(centre, radius, first, last, steps=60):
    turns = [math.radians(first + (last - first) * n / steps) for n in range(steps + 1)]
    return [(centre[0] + radius * math.cos(t), centre[1] - radius * math.sin(t)) for t in turns]


def limits():
    picture = Picture(760, 420, "Limits as lines on the swivel's circle")
    centre, radius = (235, 215), 150
    lines = [(205, -0.30, ORANGE, "cone"), (318, -0.62, VIOLET, "twist")]  # direction of the allowed side, C
    for degrees, c, fill, _ in lines:
        t = math.radians(degrees)
        n, along = (math.cos(t), -math.sin(t)), (math.sin(t), math.cos(t))
        foot = (centre[0] + c * radius * n[0], centre[1] + c * radius * n[1])
        ends = [(foot[0] + s * 178 * along[0], foot[1] + s * 178 * along[1]) for s in (1, -1)]
        away = [(x - 26 * n[0], y - 26 * n[1]) for x, y in ends]
        picture.path([ends[0], ends[1], away[1], away[0]], "none", 1, fill, closed=True, opacity=0.13)
        picture.line(*ends, fill, 2)
    picture.line((centre[0] - 195, centre[1]), (centre[0] + 200, centre[1]), FAINT, 1)
    picture.line((centre[0], centre[1] - 185), (centre[0], centre[1] + 185), FAINT, 1)
    picture.path(arc_points(centre, radius, 0, 360), FAINT, 3, closed=True)
    ends = [sorted((degrees - math.degrees(math.acos(c)), degrees + math.degrees(math.acos(c)))) for degrees, c, *_ in lines]
    first = ends[0][0]  # the cone allows 97.5 to 312.5 degrees, the twist all but an arc about 138
    gap = ((318 + math.degrees(math.acos(-0.62))) % 360, (318 - math.degrees(math.acos(-0.62))) % 360)
    picture.path(arc_points(centre, radius, first, gap[0]), GREEN, 8)
    picture.path(arc_points(centre, radius, gap[1], ends[0][1]), GREEN, 8)
    wish, taken = arc_points(centre, radius, 0, 0, 1)[0], arc_points(centre, radius, ends[0][1], ends[0][1], 1)[0]
    if 360 - ends[0][1] > first:
        taken = arc_points(centre, radius, first, first, 1)[0]
    picture.line(wish, taken, INK, 1.2, "3 4")
    picture.dot(wish, 8, "#ffffff", INK)
    picture.dot(taken, 8, RED)
    picture.words((wish[0] + 16, wish[1] - 10), "wish: φ = 0, the pole's side", INK)
    picture.words((taken[0] + 16, taken[1] + 24), "taken: the nearest", RED)
    picture.words((taken[0] + 16, taken[1] + 44), "allowed swivel, one square root", RED)
    picture.words((centre[0] + 6, 40), "sin φ", SOFT, 14)
    picture.words((centre[0] + 160, centre[1] + 20), "cos φ", SOFT, 14)
    legend = [(ORANGE, "shoulder cone: A cos φ + B sin φ ≥ C"), (VIOLET, "twist: another such line"),
              (GREEN, "arcs that every limit allows"), (FAINT, "tinted: the side that a line forbids")]
    for row, (fill, text) in enumerate(legend):
        y = 52 + 26 * row
        picture.line((448, y - 5), (476, y - 5), fill, 5)
        picture.words((486, y), text, INK, 14)
    return picture


def soft(d, reach, width):
    if d <= reach - width:
        return d
    return d - (d - reach + width) ** 2 / (4 * width) if d < reach + width else reach


def soft_reach():
    picture = Picture(760, 400, "Soft reach and stretch")
    left, bottom, least = 70, 335, 0.5
    reach, width, most, last = 1.0, 0.18, 1.15, 1.5

    def place(x, y):
        return left + 640 * (x - least), bottom - 400 * (y - least)

    picture.path([place(reach - width, least), place(reach + width, least), place(reach + width, 1.22),
                  place(reach - width, 1.22)], "none", 0, ORANGE, closed=True, opacity=0.09)
    for x, text in ((reach - width, "R − s"), (reach, "R"), (reach + width, "R + s")):
        picture.line(place(x, least), place(x, 1.22), FAINT, 1, "3 4")
        picture.words((place(x, 0)[0], bottom + 20), text, SOFT, 14, "middle")
    picture.arrow(place(least, least), place(last + 0.06, least), INK)
    picture.arrow(place(least, least), place(least, 1.24), INK)
    picture.path([place(least, least), place(1.2, 1.2)], FAINT, 1.5, dash="5 5")
    picture.path([place(reach, reach), place(most, most), place(last, most)], GREEN, 2.5, dash="8 4")
    picture.path([place(least, least), place(reach, reach), place(last, reach)], RED, 2.5)
    steps = [least + (last - least) * n / 100 for n in range(101)]
    picture.path([place(x, soft(x, reach, width)) for x in steps], ORANGE, 4)
    picture.words((place(last + 0.06, 0)[0], bottom + 44), "wanted distance from the shoulder", INK, 14, "end")
    picture.words((left + 12, 44), "distance of the wrist", INK, 14)
    picture.words((place(last, 0)[0], place(0, most)[1] - 10), "stretched up to 1.15", GREEN, 14, "end")
    picture.words((place(last, 0)[0], place(0, reach)[1] - 10), "hard: a corner, the elbow pops", RED, 14, "end")
    picture.words((place(last, 0)[0], place(0, reach)[1] + 24), "soft: eased into R", ORANGE, 14, "end")
    picture.words((place(0.68, 0)[0] + 14, place(0, 0.68)[1] + 16), "at the target", SOFT, 14)
    return picture


def reach_bands():
    picture = Picture(760, 190, "Flags along the distance of the target")
    bands = [(30, 156, "#f3dcd8", "CLAMPED_NEAR", RED), (156, 262, "#fbe8cf", "SOFTENED", ORANGE),
             (262, 482, "#dcefe2", "REACHED", GREEN), (482, 606, "#fbe8cf", "SOFTENED", ORANGE),
             (606, 733, "#f3dcd8", "CLAMPED_FAR", RED)]
    for left, right, fill, text, ink in bands:
        picture.box(left, 78, right - left - 3, 46, fill, radius=3)
        picture.words(((left + right) / 2 - 1, 106), text, ink, 13, "middle")
    for x, text in ((30, "shoulder"), (156, "R near − s"), (262, "R near + s"), (482, "R far − s"), (606, "R far + s")):
        picture.line((x, 126), (x, 136), SOFT, 1.2)
        picture.words((x, 153), text, SOFT, 13, "start" if x == 30 else "middle")
    picture.dot((30, 66), 7, BLUE)
    picture.line((38, 66), (715, 66), FAINT, 1.5, "4 4")
    picture.words((30, 34), "Where the target is, and what the flags say of it", INK, 15)
    picture.words((30, 178), "Zones without a soft reach have no width: the bands then meet at R.", SOFT, 13)
    return picture


def blocks():
    picture = Picture(760, 330, "Limbs in blocks, components in rows")
    left, top, cell = 138, 92, 25
    rows = ["TARGET x", "TARGET y", "TARGET z", "POLE x", "…", "LENGTHS fore"]
    for row, text in enumerate(rows):
        y = top + row * (cell + 4)
        picture.words((left - 12, y + 18), text, INK, 13, "end")
        for lane in range(16):
            fill = "#f3dcd8" if lane > 12 else "#dbe7f6" if lane != 4 else "#f6c98e"
            picture.box(left + lane * cell, y, cell - 2, cell, fill, radius=2)
    for lane in range(16):
        picture.words((left + lane * cell + 11.5, top - 8), str(lane), SOFT, 11, "middle")
    picture.words((left, 40), "one block: 16 limbs", INK, 15, weight="bold")
    picture.words((left, 62), "a lane is a limb", SOFT, 13)
    right = left + 16 * cell + 14
    picture.words((right, top + 18), "a row: one component of 16", INK, 13)
    picture.words((right, top + 36), "limbs, 64 bytes", INK, 13)
    picture.words((right, top + 96), "the next block has", SOFT, 13)
    picture.words((right, top + 114), "limbs 16 to 31", SOFT, 13)
    for x, fill, text in ((left, "#f6c98e", "limb 4"), (left + 90, "#f3dcd8", "padding: a group of 13 limbs ends, the next starts a block")):
        picture.box(x, 288, 16, 16, fill, radius=2)
        picture.words((x + 24, 301), text, SOFT, 13)
    return picture


def seen_along(picture, centre, title, hint):
    """An arm seen from its wrist towards the shoulder: the line is a point, normals go right of poles."""
    picture.dot(centre, 58, "none", ORANGE)
    picture.dot(centre, 5, GREEN)
    picture.words((centre[0], 36), title, INK, 15, "middle", "bold")
    picture.words((centre[0], 250), hint, SOFT, 13, "middle")


def on_circle(centre, radius, degrees):
    return arc_points(centre, radius, degrees, degrees, 1)[0]


def wishes():
    picture = Picture(760, 290, "Four ways to say where the elbow goes")
    centres = [(105, 140), (290, 140), (475, 140), (655, 140)]
    for centre, title, hint in zip(centres, ("pole point", "pole direction", "plane normal", "swivel angle"),
                                   ("towards a place", "the same everywhere", "the elbow's axis", "on from the pole")):
        seen_along(picture, centre, title, hint)
    point, way, normal, angle = centres
    picture.dot(on_circle(point, 92, 250), 6, RED)
    picture.line(point, on_circle(point, 92, 250), RED, 1.5, "3 4")
    for shift in (-46, 46):
        picture.arrow((way[0] + shift, 184), (way[0] + shift, 228), RED, 1.8, 8)
    picture.arrow(normal, on_circle(normal, 84, 0), VIOLET, 2.2, 9)
    picture.path([(normal[0] + 12, 140), (normal[0] + 12, 152), (normal[0], 152)], SOFT, 1.2)
    picture.line(angle, on_circle(angle, 84, 270), RED, 1.5, "3 4")
    picture.path(arc_points(angle, 40, 270, 312), BLUE, 3)
    picture.words((angle[0] + 20, 218), "φ", BLUE)
    for centre, degrees in zip(centres, (250, 270, 270, 312)):
        elbow = on_circle(centre, 58, degrees)
        picture.line(centre, elbow, INK, 6)
        picture.dot(elbow, 8, ORANGE)
        picture.dot(centre, 6, GREEN)
    picture.words((380, 278), "The arm seen from its wrist (green) towards the shoulder. Orange: the elbow and its circle.", SOFT, 13,
                  "middle")
    return picture


PICTURES = {"wishes": wishes, "swivel_circle": swivel_circle, "arm_frame": arm_frame, "spaces": spaces, "limits": limits,
            "soft_reach": soft_reach, "reach_bands": reach_bands, "blocks": blocks}


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parents[2] / "docs/pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in PICTURES.items():
        (folder / f"{name}.svg").write_text(draw().svg(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
