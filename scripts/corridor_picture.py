"""Draws the corridor in which a stroke is followed (docs/capture.md), for a pen that is half way through a bent stroke,
and beside it the nodes of a stroke and of a smaller path that are paired.

    python3 scripts/corridor_picture.py docs/images/corridor.svg
"""

import math
import sys

WIDTH, LEAD, SPACING, FOLLOW = 0.06, 0.03 + 0.02, 0.02, 1.0  # [em]; twice the spacing of the library, to be seen
SCALE, LEFT, TOP = 700, 110, 590  # of the picture, y down


def polyline(corners, step):
    points = [corners[0]]
    for a, b in zip(corners, corners[1:]):
        count = round(math.dist(a, b) / step)
        points += [tuple(p + (q - p) * i / count for p, q in zip(a, b)) for i in range(1, count + 1)]
    return points


def unit(x, y):
    size = math.hypot(x, y)
    return (x / size, y / size)


def xy(point):
    return f"{LEFT + SCALE * point[0]:.1f},{TOP - SCALE * point[1]:.1f}"


def path(points, **style):
    style = " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())
    return f'<path d="M{" L".join(xy(p) for p in points)}" fill="none" {style}/>'


def label(point, text, color="#333"):
    x, y = xy(point).split(",")
    return f'<text x="{x}" y="{y}" fill="{color}">{text}</text>'


stroke = polyline([(0.0, 0.7), (0.56, 0.7), (0.56, 0.14)], SPACING)
last = len(stroke) - 1
tangents = [unit(*(q - p for p, q in zip(stroke[max(0, i - 1)], stroke[min(last, i + 1)]))) for i in range(last + 1)]
corner = {i for i in range(1, last) if math.dist(stroke[i], (0.56, 0.7)) < 0.03}

drawn = polyline([(0.035, 0.665), (0.5, 0.655), (0.565, 0.62), (0.6, 0.42)], 0.01)  # begun below and to the right
own = (drawn[0][0] - stroke[0][0], drawn[0][1] - stroke[0][1])


def is_free(tip, i):
    (tx, ty), (px, py) = tangents[i], stroke[i]
    ex, ey = tip[0] - px, tip[1] - py
    along = (ex - own[0]) * tx + (ey - own[1]) * ty
    late = own[0] * tangents[0][0] * tx  # a start beyond the stroke's may be made up for
    along = along - max(0.0, -late) if along > max(0.0, -late) else min(along - min(0.0, -late), 0.0)
    across, aside = -ex * ty + ey * tx, -own[0] * ty + own[1] * tx
    low, high = min(0.0, aside), max(0.0, aside)
    across = max(across - high, low - across, 0.0)
    return (abs(along) <= LEAD and across <= WIDTH) or (i in corner and math.hypot(along, across) <= WIDTH)


reached = {0}
for tip in drawn:
    now = set()
    for i in range(last + 1):
        if is_free(tip, i) and (i in reached or i - 1 in reached or i - 1 in now):
            now.add(i)
    reached = now or reached

shifted = [tuple(p + o for p, o in zip(point, own)) for point in stroke]
parts = [
    path(stroke, stroke="#f3e3c3", stroke_width=2 * WIDTH * SCALE, stroke_linejoin="round"),
    path(shifted, stroke="#f3e3c3", stroke_width=2 * WIDTH * SCALE, stroke_linejoin="round"),
    path(stroke, stroke="#999", stroke_width=2),
    path(drawn, stroke="#1565c0", stroke_width=4, stroke_linecap="round"),
]
for i, point in enumerate(stroke):
    x, y = xy(point).split(",")
    fill = "#c62828" if i in reached else "#bbb" if i < min(reached) else "#fff"
    parts.append(f'<circle cx="{x}" cy="{y}" r="5" fill="{fill}" stroke="#555" stroke-width="1.5"/>')
x, y = xy(drawn[-1]).split(",")
parts.append(f'<circle cx="{x}" cy="{y}" r="8" fill="#1565c0"/>')
parts += [
    label((-0.09, 0.692), "start"),
    label((0.04, 0.54), "the pen, begun beside the start", "#1565c0"),
    label((0.0, 0.78), "corridor: the stroke, and where it was begun, each 0.06 em to both sides"),
    label((0.66, 0.45), "the pen now", "#1565c0"),
    label((0.17, 0.42), "reached in order,", "#c62828"),
    label((0.17, 0.385), "abreast of the pen", "#c62828"),
    label((0.6, 0.11), "end: accepted within the slack"),
]
# The whole: a pen that writes the stroke by a fifth smaller, and slanted.
NODES, RIGHT = 16, 1.14  # fewer nodes than the library has, to be seen; of the second part of the picture [em]


def nodes(points):
    arcs = [0.0]
    for a, b in zip(points, points[1:]):
        arcs.append(arcs[-1] + math.dist(a, b))
    chosen = [min(range(len(arcs)), key=lambda i, k=k: abs(arcs[i] - arcs[-1] * k / (NODES - 1))) for k in range(NODES)]
    return [points[i] for i in chosen]


def moved(points):
    return [(x + RIGHT, y) for x, y in points]


fine = polyline([(0.0, 0.7), (0.56, 0.7), (0.56, 0.14)], 0.002)
smaller = polyline([(0.07, 0.63), (0.49, 0.655), (0.53, 0.22)], 0.002)
model, pen = moved(nodes(fine)), moved(nodes(smaller))
parts.append(path(moved(fine), stroke="#999", stroke_width=2))
parts.append(path(moved(smaller), stroke="#1565c0", stroke_width=4, stroke_linecap="round"))
parts += [path(pair, stroke="#c62828", stroke_width=1.5, stroke_dasharray="4 3") for pair in zip(model, pen)]
for points, fill in ((model, "#fff"), (pen, "#1565c0")):
    for point in points:
        x, y = xy(point).split(",")
        parts.append(f'<circle cx="{x}" cy="{y}" r="5" fill="{fill}" stroke="#555" stroke-width="1.5"/>')
parts += [
    label((RIGHT, 0.78), "as a whole, at the lift: each node of the stroke and its pair"),
    label((RIGHT + 0.07, 0.53), "the pen: a fifth smaller,", "#1565c0"),
    label((RIGHT + 0.07, 0.495), "short at both ends, slanted", "#1565c0"),
    label((RIGHT + 0.07, 0.42), "an affine map takes these", "#c62828"),
    label((RIGHT + 0.07, 0.385), "away: what is left counts", "#c62828"),
]
with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1470 550" ')
    file.write('font-family="sans-serif" font-size="17">\n')
    file.write('<rect width="1470" height="550" fill="#fff"/>\n' + "\n".join(parts) + "\n</svg>\n")
