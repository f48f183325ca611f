# SPDX-License-Identifier: MIT
"""Pictures as SVG text: lines, circles, words, arrows and the view of a scene in space. The same calls give the same bytes."""
import math
from html import escape

INK, SOFT, FAINT = "#22324a", "#5b6b80", "#a9b4c2"
BLUE, ORANGE, GREEN, RED, VIOLET = "#1f66b3", "#c9761a", "#23834a", "#b93a2b", "#7b4fa3"
GROUND = "#fbfaf5"


def number(value):
    text = f"{value:.1f}"
    return "0" if text in ("-0.0", "0.0") else text.removesuffix(".0")


class Picture:
    """A picture of width by height pixels; y grows downwards."""

    def __init__(self, width, height, title):
        self.width, self.height, self.title, self.parts = width, height, title, []

    def add(self, name, text=None, **attributes):
        values = "".join(f' {key.replace("_", "-")}="{number(value) if isinstance(value, (int, float)) else value}"'
                         for key, value in attributes.items() if value is not None)
        self.parts.append(f"  <{name}{values}/>" if text is None else f"  <{name}{values}>{escape(text)}</{name}>")

    def line(self, a, b, stroke=INK, width=2, dash=None):
        self.add("line", x1=a[0], y1=a[1], x2=b[0], y2=b[1], stroke=stroke, stroke_width=width, stroke_dasharray=dash,
                 stroke_linecap="butt" if dash else "round")

    def path(self, points, stroke=INK, width=2, fill="none", dash=None, closed=False, opacity=None):
        d = "M" + " L".join(f"{number(x)} {number(y)}" for x, y in points) + (" Z" if closed else "")
        self.add("path", d=d, fill=fill, stroke=stroke, stroke_width=width, stroke_dasharray=dash, stroke_linejoin="round",
                 opacity=None if opacity is None else f"{opacity:g}")

    def dot(self, at, radius=6, fill=INK, stroke=None):
        self.add("circle", cx=at[0], cy=at[1], r=radius, fill=fill, stroke=stroke, stroke_width=2 if stroke else None)

    def box(self, x, y, width, height, fill, stroke=None, radius=4):
        self.add("rect", x=x, y=y, width=width, height=height, rx=radius, fill=fill, stroke=stroke)

    def words(self, at, text, fill=INK, size=15, anchor="start", weight=None):
        self.add("text", text, x=at[0], y=at[1], fill=fill, font_size=size,
                 text_anchor=None if anchor == "start" else anchor, font_weight=weight)

    def arrow(self, a, b, stroke=INK, width=2, head=9):
        dx, dy = b[0] - a[0], b[1] - a[1]
        length = math.hypot(dx, dy)
        dx, dy = dx / length, dy / length
        foot = (b[0] - head * dx, b[1] - head * dy)
        self.line(a, foot, stroke, width)
        side = (-0.45 * head * dy, 0.45 * head * dx)
        self.path([b, (foot[0] + side[0], foot[1] + side[1]), (foot[0] - side[0], foot[1] - side[1])], stroke, 1, stroke,
                  closed=True)

    def svg(self):
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
            'font-family="DejaVu Sans, Helvetica, Arial, sans-serif">', f"  <title>{escape(self.title)}</title>",
            f'  <rect width="{self.width}" height="{self.height}" rx="8" fill="{GROUND}"/>', *self.parts, "</svg>", ""])


# ---- space: vectors are tuples

def plus(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


class View:
    """A scene seen from afar: `right` and `up` of the paper in space, pixels a unit, where the origin lies."""

    def __init__(self, towards_eye, up, scale, origin):
        back = unit(towards_eye)
        self.right = unit(cross(up, back))
        self.up = cross(back, self.right)
        self.scale, self.origin = scale, origin

    def __call__(self, point):
        return (self.origin[0] + self.scale * dot(point, self.right), self.origin[1] - self.scale * dot(point, self.up))


def circle(centre, axis, start, radius, first=0.0, last=360.0, steps=72):
    """Points of an arc about an axis, from degrees first to last counted from start, by the right hand."""
    u, v = unit(start), cross(unit(axis), unit(start))
    turns = [math.radians(first + (last - first) * n / steps) for n in range(steps + 1)]
    return [plus(plus(centre, u, radius * math.cos(t)), v, radius * math.sin(t)) for t in turns]
