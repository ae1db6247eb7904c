"""Scores of 200 sessions with known faults, each against a count of the recorded trace written again with NumPy.

A session draws the strokes of one character or two along their middle lines, a little disturbed, with one fault or two.
The count takes what was measured from the recording, and from the drawing only which stroke each pen-down is and
which part of it each sample.

Some faults cannot be told from geometry (docs/practice.md, "What cannot be recognised"). The templates alone decide
which strokes a fault is drawn in:

- A stroke with a fault has no other within DISTINCT of it, nor have strokes that are swapped among themselves and
  those between them. This is the mean distance of 32 points at equal arc length, forwards or backwards.
- A stroke is reversed, or written twice, only where its ends are farther apart than OPEN.
- A part of a stroke is within PART of the whole, is not turned against it by more than TURNED, and is nearer to it than
  to any stroke still to come by half of DISTINCT. A character is broken off in its third stroke or later, so that those
  before tell where it lies.
- A stroke is left out only where two others remain, for the same reason.
- What is lost in the middle of a stroke is at most a fifth of it. Where it is more than a quarter, the parts are not
  taken for one stroke.
"""

import collections
import functools
import math

import numpy as np
import pytest

import calligraphy as cal
from test_pen_kinematics import dtw

SESSIONS = 200
RATE = 1000.0
DISTINCT = 0.1  # [em], twice that by which another order has to fit better
OPEN = 0.1  # [em]
PART = 0.25  # [em], to be within what an unmatched pen-down and an unmatched stroke cost together
TURNED = math.radians(45)  # the direction of a stroke is known up to about 60 degrees
GAP = 0.13  # mean share of a stroke that may be lost in its middle; the motion is up to 1.5 times as fast as its mean
BOUNCE = 0.05  # the longest lift that does not end a pen-down [s]
UNSEEN = 0.1  # the longest run of lost samples that does not [s]
LOST = (0.11, 0.14)  # a lost run, longer than that [s]
NOISE, REST = 1.5e-5, 600  # of the sensor [m], ticks
DEPTH, HEIGHT = -1e-4, 5e-3  # of the pen below and above the paper [m]

FAULTS = (
    "none",
    "swapped",
    "reversed",
    "retried",  # reversed, and once more as it should be
    "twice",
    "abandoned",
    "unfinished",  # the recording ends with the pen on the paper
    "missing",
    "nothing",
    "begun late",
    "recorded late",
    "lost samples",
    "lost run",  # more than 100 ms: two pen-downs
    "bounce",
    "noise",  # of the sensor, while the pen rests at the end of each stroke
)
OF_THE_RECORDING = ("recorded late", "lost samples", "bounce", "noise")  # which go together with any of the others


class Line:
    """A polyline with its length along the way: straight elements as they are, each curve as 400 chords.

    Chords of a curve of 40 mm are 0.1 mm long: where it bends with a radius of 10 mm, they are within 0.13 um of it.
    """

    def __init__(self, points):
        self.points = np.asarray(points, float)
        self.arc = np.concatenate([[0.0], np.hypot(*np.diff(self.points, axis=0).T).cumsum()])
        self.length = self.arc[-1]

    def at(self, arc):
        return np.column_stack([np.interp(arc, self.arc, axis) for axis in self.points.T])

    def even(self, count, begin=0.0, end=1.0):
        return self.at(np.linspace(begin, end, count) * self.length)

    def distances(self, points):
        """Of each point from the nearest segment."""
        if len(self.points) == 1:
            return np.hypot(*(points - self.points).T)
        start, along = self.points[:-1], np.diff(self.points, axis=0)
        square = np.maximum((along**2).sum(1), 1e-30)
        x, y = (points[:, None, i] - start[None, :, i] for i in range(2))
        share = np.clip((x * along[:, 0] + y * along[:, 1]) / square, 0.0, 1.0)
        x -= share * along[:, 0]
        y -= share * along[:, 1]
        return np.sqrt((x * x + y * y).min(axis=1))


def middle_line(stroke):
    """The true stroke [em]: L is a straight line, C a cubic Bezier curve."""
    control, points, at = np.asarray(stroke.control_points), [], 0
    for element in stroke.elements:
        if element == "L":
            points += [control[at], control[at + 1]]
            at += 1
        else:
            t = np.linspace(0.0, 1.0, 401)[:, None]
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            points += list(sum(w * p for w, p in zip(weights, control[at : at + 4])))
            at += 3
    assert at == len(control) - 1
    return Line(points)


@functools.cache
def lines_of(code):
    return [middle_line(stroke) for stroke in cal.built_in_characters()[code].strokes()]


def apart(one, other):
    """Mean distance of points at equal arc length, in the direction in which it is less."""
    return min(np.hypot(*(one - way).T).mean() for way in (other, other[::-1]))


@functools.cache
def shape_distances(code):
    shapes = [line.even(32) for line in lines_of(code)]
    return np.array([[apart(one, other) for other in shapes] for one in shapes])


def is_distinct(code, strokes):
    """Whether each of these is apart from all others."""
    distances = shape_distances(code)
    return all(distances[i, j] >= DISTINCT for i in strokes for j in range(len(distances)) if i != j)


def part_is_known(code, stroke, begin, end, to_come=()):
    whole, *others = (lines_of(code)[i].even(32) for i in (stroke, *to_come))
    part = lines_of(code)[stroke].even(32, begin, end)
    own = apart(part, whole)
    (x, y), (u, v) = ((shape - shape.mean(axis=0)).T for shape in (whole, part))
    turned = math.atan2((x * v - y * u).sum(), (x * u + y * v).sum())
    return own <= PART and abs(turned) < TURNED and all(apart(part, other) >= own + DISTINCT / 2 for other in others)


# Drawing


class Drawn:
    """A pen-down as it was meant: of which stroke, from where to where, and whether it is the one that counts."""

    def __init__(self, character, stroke, begin=0.0, end=1.0, backwards=False, extra=False, bent=0.0):
        self.character, self.stroke, self.begin, self.end = character, stroke, begin, end
        self.backwards, self.extra, self.bent = backwards, extra, bent
        self.bounces = self.gap = False

    @property
    def is_broken(self):
        return self.bounces or self.gap


def meant(rng, fault, codes, faulty):
    """The pen-downs of a session, or None where this character has no stroke for the fault."""
    code, pens = codes[faulty], []
    lines, count = lines_of(code), len(lines_of(code))
    stroke = int(rng.integers(count))
    order = list(range(count))
    one = [Drawn(faulty, stroke)]
    if fault == "nothing":
        return []
    if fault in ("none", "lost samples", "noise"):
        pass
    elif fault == "swapped":
        if count < 2:
            return None
        first, second = sorted(int(i) for i in rng.choice(count, 2, replace=False))
        among = shape_distances(code)[first : second + 1, first : second + 1]
        if (among + np.eye(len(among)) < DISTINCT).any():
            return None
        order[first], order[second] = second, first
    elif fault == "unfinished":
        order, codes = order[: stroke + 1], codes[: faulty + 1]
    elif fault == "abandoned":
        share = rng.uniform(0.2, 0.8)
        if 1 < count and stroke < 2 or not part_is_known(code, stroke, 0.0, share, range(stroke + 1, count)):
            return None
        order, one = order[: stroke + 1], [Drawn(faulty, stroke, 0.0, share)]
        codes = codes[: faulty + 1]
    elif not is_distinct(code, [stroke]):
        return None
    elif fault in ("reversed", "retried"):
        if np.hypot(*(lines[stroke].points[-1] - lines[stroke].points[0])) < OPEN:
            return None
        one = [Drawn(faulty, stroke, backwards=True, extra=fault == "retried")]
        if fault == "retried":
            one.append(Drawn(faulty, stroke))
    elif fault == "twice":
        if np.hypot(*(lines[stroke].points[-1] - lines[stroke].points[0])) < OPEN:
            return None
        one = [Drawn(faulty, stroke), Drawn(faulty, stroke, bent=0.08, extra=True)][:: rng.choice([-1, 1])]
    elif fault == "missing":
        if count < 3:
            return None
        one = []
    elif fault == "begun late":
        share = rng.uniform(0.1, 0.4)
        if not part_is_known(code, stroke, share, 1.0):
            return None
        one = [Drawn(faulty, stroke, share)]
    elif fault in ("lost run", "bounce"):
        if fault == "lost run" and lines[stroke].length < 0.5:
            return None
        one[0].gap, one[0].bounces = fault == "lost run", fault == "bounce"
    for character, text in enumerate(codes):
        for i in order if character == faulty else range(len(lines_of(text))):
            pens += one if character == faulty and i == stroke and fault != "swapped" else [Drawn(character, i)]
    return pens


class Session:
    """A page, its recording, the stroke that each sample belongs to, and the pen-downs as they were meant."""

    def __init__(self, seed):
        self.rng = rng = np.random.default_rng([2006, seed])
        self.has_dtw = seed % 4 == 0  # it takes long
        self.faults = [FAULTS[seed % len(FAULTS)]]
        if seed % 4 == 3 and self.faults[0] not in ("none", "nothing", *OF_THE_RECORDING):
            self.faults.append(OF_THE_RECORDING[seed // 4 % 4])
        characters = cal.built_in_characters()
        self.pens = None
        while self.pens is None or not self.can_be_recorded_late():
            self.text = "".join(rng.choice([c.code for c in characters], 2 if seed % 5 == 4 else 1, replace=False))
            faulty = 0 if "recorded late" in self.faults else int(rng.integers(len(self.text)))
            own = "none" if self.faults[0] in OF_THE_RECORDING and self.faults[0] != "bounce" else self.faults[0]
            self.pens = meant(rng, own, self.text, faulty)
        if "bounce" in self.faults[1:]:
            whole = [pen for pen in self.pens if not pen.gap and not pen.bent]
            whole[int(rng.integers(len(whole)))].bounces = True
        self.page = cal.lay_out([characters[code] for code in self.text])[0]
        self.lines = [
            [Line(p.placement.origin + p.placement.em * line.points) for line in lines_of(p.character.code)]
            for p in self.page.characters
        ]
        self.draw()

    def can_be_recorded_late(self):
        if "recorded late" not in self.faults or not self.pens:
            return True
        first = self.pens[0]
        if first.backwards or first.gap or first.begin > 0 or first.end < 1:
            return False
        if sum((pen.character, pen.stroke) == (0, first.stroke) for pen in self.pens) > 1:
            return False
        self.cut = self.rng.uniform(0.1, 0.4)
        text = self.text[0]
        return is_distinct(text, [first.stroke]) and part_is_known(text, first.stroke, self.cut, 1.0)

    def pen_down(self, pen):
        """Its points [m] and where on the stroke they are, a tick each: a smooth motion, a little shifted and bent."""
        rng, line, em = self.rng, self.lines[pen.character][pen.stroke], 0.04
        way = (pen.end - pen.begin) * line.length
        speed = rng.uniform(0.06, 0.15)  # [m/s]
        if pen.gap:
            speed = min(speed, GAP * way / LOST[1])
        if pen.bounces:
            speed = min(speed, GAP * way / BOUNCE)
        ticks = max(int(way / speed * RATE), 8)
        u = np.linspace(0.0, 1.0, ticks)
        u += rng.uniform(-0.08, 0.08) * np.sin(2 * np.pi * u)  # faster here, slower there
        share = pen.begin + (pen.end - pen.begin) * (u if not pen.backwards else 1.0 - u)
        direction = rng.uniform(0.0, 2 * np.pi, 2)
        shift, bend = rng.uniform(0.0, 0.014) * em, (rng.uniform(0.0, 0.006) + pen.bent) * em
        points = line.at(share * line.length)
        points += shift * np.array([np.cos(direction[0]), np.sin(direction[0])])
        aside = np.array([np.cos(direction[1]), np.sin(direction[1])])
        if pen.bent:  # across what it is to spoil
            aside = (line.points[-1] - line.points[0]) @ [[0.0, 1.0], [-1.0, 0.0]]
            aside /= np.hypot(*aside)
        return points + bend * np.sin(np.pi * share)[:, None] * aside, share

    def draw(self):
        rng, place, rows, labels = self.rng, np.array([0.5 * self.page.width, 0.5 * self.page.height]), [], []
        shares = []

        def add(points, heights, label, share=0.0):
            rows.append(np.column_stack([points, np.broadcast_to(heights, len(points))]))
            labels.append(np.full(len(points), label))
            shares.append(np.broadcast_to(share, len(points)))

        add(np.tile(place, (60, 1)), HEIGHT, -1)
        for label, pen in enumerate(self.pens):
            points, share = self.pen_down(pen)
            if "noise" in self.faults:
                points = np.concatenate([points, np.tile(points[-1], (REST, 1))])
                points += rng.normal(0.0, NOISE, points.shape)
                share = np.append(share, np.full(REST, share[-1]))
            air = max(int(np.hypot(*(points[0] - place)) / 0.4 * RATE), 60)
            add(np.linspace(place, points[0], air), HEIGHT, -1)
            add(np.tile(points[0], (10, 1)), np.linspace(HEIGHT, 1e-3, 10), -1)
            heights = np.full(len(points), DEPTH)
            middle = int(rng.uniform(0.35, 0.65) * len(points))
            if pen.bounces:
                lift = int(rng.integers(20, 50))
                up = np.minimum(1.0, np.minimum(np.arange(lift), np.arange(lift)[::-1]) / 5)
                heights[middle - lift // 2 : middle - lift // 2 + lift] += up * (HEIGHT - DEPTH)
            if pen.gap:
                lost = int(rng.uniform(*LOST) * RATE)
                points[middle - lost // 2 : middle - lost // 2 + lost] = np.nan
            add(points, heights, label, share)
            up = np.linspace(DEPTH, HEIGHT, 10)  # on the paper for half of it
            add(np.tile(points[-1], (10, 1)), up, label, share[-1])
            place = points[-1]
        add(np.tile(place, (80, 1)), HEIGHT, -1)
        positions, labels, shares = np.concatenate(rows), np.concatenate(labels), np.concatenate(shares)
        lost = np.zeros(len(labels), bool)
        if "lost samples" in self.faults:
            for length in (1, 1, 1, *rng.integers(2, 30, 2), int(rng.integers(55, 95))):
                begin = int(rng.integers(60, len(lost) - 90))
                around = slice(begin - 60, begin + length + 60)
                pen = self.pens[labels[begin]] if labels[begin] >= 0 else None
                if (labels[around] == labels[begin]).all() and not lost[around].any() and not (pen and pen.is_broken):
                    lost[begin : begin + length] = True
        positions[lost] = np.nan
        mapping = cal.upright_page(self.page.width, self.page.height)
        device = np.array([mapping.to_device(p) for p in positions])
        renderer = cal.HapticRenderer(self.page.characters, mapping, cal.device_profile("ideal"))
        ticks = renderer.trace(device, np.arange(len(device)) / RATE)
        samples = np.zeros(len(ticks), cal.sample_dtype)
        for name in ("time", "device_point", "pen_tip", "state", "events", "status", "character", "stroke"):
            samples[name] = ticks[name]
        samples["force"] = ticks["page_force"]
        if "lost samples" in self.faults:
            last = np.flatnonzero(labels == labels.max())
            samples["status"][last[5]] = int(cal.TickStatus.device_fault)
            samples["pen_tip"][last[8]] = np.nan
        if "recorded late" in self.faults and self.pens:
            first = np.flatnonzero(labels == 0)
            begin = first[np.searchsorted(shares[first], self.cut)]
            samples, labels, shares = samples[begin:], labels[begin:], shares[begin:]
        if "unfinished" in self.faults:
            last = np.flatnonzero(labels == labels.max())
            end = last[int(rng.uniform(0.2, 0.9) * len(last))]
            samples, labels, shares = samples[:end], labels[:end], shares[:end]
        self.recording = cal.Recording(RATE, samples, page=cal.page_id(self.page))
        self.labels, self.shares = labels, shares

    def __str__(self):
        return f"{self.text}: {' and '.join(self.faults)}"


@functools.cache
def session(seed):
    return Session(seed)


# Counting


def is_usable(samples):
    return (samples["status"] == 0) & np.isfinite(samples["pen_tip"]).all(axis=1) & np.isfinite(samples["time"])


def split(samples):
    """Index arrays of the pen-downs: usable samples on the paper, with the gaps that do not end one."""
    up = samples["state"] == int(cal.InteractionState.separation)
    on_paper = np.flatnonzero(is_usable(samples) & ~up)
    lifts = np.diff(np.cumsum(is_usable(samples) & up)[on_paper]) > 0
    breaks = np.flatnonzero(np.diff(samples["time"][on_paper]) > np.where(lifts, BOUNCE, UNSEEN) + 1e-9) + 1
    return [part for part in np.split(on_paper, breaks) if len(part)]


def steady(points, spacing):
    """Those at least so far from the last one kept, and the last: a pen that rests does not draw on."""
    kept = [0]
    for i, point in enumerate(points):
        if math.dist(point, points[kept[-1]]) >= spacing:
            kept.append(i)
    return points[sorted({*kept, len(points) - 1})]


def along_the_way(errors, points):
    """Integral of the squared errors over the length of a path, by the trapezium rule, and this length."""
    steps, squares = np.hypot(*np.diff(points, axis=0).T), errors**2
    return np.array([((squares[1:] + squares[:-1]) / 2 * steps).sum(), steps.sum()])


def longest_ascent(numbers):
    lengths = []
    for i, number in enumerate(numbers):
        lengths.append(1 + max((lengths[j] for j in range(i) if numbers[j] < number), default=0))
    return max(lengths, default=0)


def root(sums):
    """Root mean square; NaN of nothing."""
    square, length = sums
    return math.sqrt(square / length) if length > 0 else math.nan


def count(drawn, character):
    """The row of a character."""
    samples, lines = drawn.recording.samples, drawn.lines[character]
    em = drawn.page.characters[character].placement.em
    tips, times = samples["pen_tip"][:, :2], samples["time"]
    downs = []
    for part in split(samples):
        labels = set(drawn.labels[part])
        assert len(labels) == 1 and -1 not in labels, "a pen-down is one of those that were drawn"
        pen = drawn.pens[labels.pop()]
        if pen.character == character:
            downs.append((part, pen))
    inks = [Line(steady(tips[part], 0.005 * em)) for part, _ in downs]
    row = {"stroke_count": len(lines), "pen_downs": [(times[part[0]], times[part[-1]]) for part, _ in downs]}
    row["drawn"] = [-1 if pen.extra else pen.stroke for _, pen in downs]
    row["directions"] = ["backwards" if pen.backwards else "forwards" for _, pen in downs if not pen.extra]
    last = downs[-1][1] if downs else None
    if len(downs) == len(lines) and last.end - last.begin < 1 / 3:  # nothing is to come: only a part was written
        row["directions"][-1] = "neither"

    finished = np.flatnonzero(samples["events"] & int(cal.TickEvent.stroke_finished))
    before = np.maximum(finished - 1, 0)
    completed = {(samples["character"][i], samples["stroke"][i]) for i in before}
    strokes, of_pens, of_all, largest, covered_length, left_out = [], np.zeros(2), np.zeros(2), [], 0.0, []
    wrote = [ink for ink, (_, pen) in zip(inks, downs) if not pen.extra]
    for i, line in enumerate(lines):
        mine = [k for k, (_, pen) in enumerate(downs) if pen.stroke == i and not pen.extra]
        stroke = {"completed": (character, i) in completed, "pen_down": mine[0] if mine else -1}
        errors = [line.distances(inks[k].points) for k in mine]
        sums = sum((along_the_way(error, inks[k].points) for error, k in zip(errors, mine)), np.zeros(2))
        of_pens += sums
        stroke["rms_error"] = root(sums)
        stroke["max_error"] = max((error.max() for error in errors), default=math.nan)
        if drawn.has_dtw:
            pens = np.concatenate([inks[k].points for k in mine]) if mine else []
            stroke["dtw_distance"] = dtw(pens, line.points) if mine else math.nan

        grid = (np.arange(1000) + 0.5) / 1000 * line.length
        drawn_of_it, in_order = np.zeros(1000, bool), np.zeros(1000, bool)
        for k in mine:
            along = drawn.shares[downs[k][0]] * line.length
            covered = (grid >= along.min()) & (grid <= along.max())
            drawn_of_it |= covered
            in_order |= covered & (not downs[k][1].backwards)
        stroke["coverage"] = in_order.mean()
        covered_length += in_order.mean() * line.length

        # Of a stroke that was written backwards nothing is covered, but nothing was left out either.
        left = line.at(grid[~drawn_of_it])
        near = [inks[k] for k in mine] or wrote
        distances = np.min([ink.distances(left) for ink in near], axis=0) if len(left) and near else np.zeros(0)
        left_out.append((distances, line.length / len(grid), sums))
        strokes.append(stroke)
        largest += [stroke["max_error"]] if mine else []
    row["strokes"] = strokes
    row["rms_error"] = root(of_pens)
    for stroke, (distances, step, sums) in zip(strokes, left_out):
        # What was left out is not nearer than what was written.
        least = stroke["rms_error"] if stroke["pen_down"] >= 0 else row["rms_error"]
        sums = sums + [(np.maximum(distances, least) ** 2).sum() * step, len(distances) * step]
        stroke["overall_error"] = root(sums)
        of_all += sums
    row["max_error"] = max(largest, default=math.nan)
    row["overall_error"] = root(of_all)
    row["coverage"] = covered_length / sum(line.length for line in lines)
    written = [stroke for stroke in strokes if stroke["pen_down"] >= 0]
    if drawn.has_dtw:
        row["dtw_distance"] = np.mean([stroke["dtw_distance"] for stroke in written]) if written else math.nan
    row["strokes_written"] = len(written)
    row["strokes_completed"] = sum(stroke["completed"] for stroke in strokes)

    firsts = list(dict.fromkeys(stroke for stroke in row["drawn"] if stroke >= 0))
    out_of_turn = len(firsts) - longest_ascent(firsts)
    swapped = sum(one != other for one, other in zip(firsts, sorted(firsts))) == 2
    row["order_mistakes"] = 1 if swapped else out_of_turn
    row["direction_mistakes"] = sum(pen.backwards and not pen.extra for _, pen in downs)
    row["extra"] = sum(pen.extra for _, pen in downs)
    row["missing"] = len(lines) - len(written)
    row["broken"] = len([stroke for stroke in row["drawn"] if stroke >= 0]) - len(written)

    row["contour"] = sum(math.exp(-stroke["overall_error"] / (0.05 * em)) for stroke in written) / len(lines)
    row["external_sequence"] = (len(written) - out_of_turn) / (len(lines) + row["extra"])
    row["internal_sequence"] = (len(written) - row["direction_mistakes"]) / len(lines)
    row["fidelity"] = (row["contour"] * row["external_sequence"] * row["internal_sequence"]) ** (1 / 3)

    ended = samples["events"] & int(cal.TickEvent.character_finished) != 0
    ended = np.flatnonzero(ended & (np.concatenate([samples["character"][:1], samples["character"][:-1]]) == character))
    writing = samples["state"] == int(cal.InteractionState.writing)
    left = np.flatnonzero(writing[:-1] & ~writing[1:]) + 1  # where the pen finished a stroke or left it
    row["time"] = times[left[left <= ended[0]][-1]] - row["pen_downs"][0][0] if len(ended) else math.nan
    here = samples["character"] == character
    row["lost_samples"] = int((~is_usable(samples) & here).sum())
    row["peak_force"] = np.linalg.norm(samples["force"][here], axis=1).max(initial=0.0)
    steps = np.linalg.norm(np.diff(samples["force"], axis=0), axis=1)
    row["max_force_step"] = steps[here[1:] & here[:-1]].max(initial=0.0)
    return row


def told(score):
    """The same row as score_page() tells it."""
    row = {name: getattr(score, name) for name in count(session(0), 0) if hasattr(score, name)}
    row["order_mistakes"], row["direction_mistakes"] = score.order_mistakes(), score.direction_mistakes()
    row["pen_downs"] = [(down.motion.begin, down.motion.begin + down.motion.duration) for down in score.pen_downs]
    row["drawn"] = [down.stroke for down in score.match.drawn]
    row["directions"] = [down.direction.name for down in score.match.drawn if down.stroke >= 0]
    for kind in ("extra", "missing", "broken"):
        row[kind] = score.match.count(kind)
    names = count(session(0), 0)["strokes"][0]
    row["strokes"] = [{name: getattr(stroke, name) for name in names} for stroke in score.strokes]
    return row


def differences(got, expected, path=""):
    """Every column in which they differ, by more than its tolerance."""
    for name, value in expected.items():
        other, here = got[name], path + name
        if name == "strokes":
            for i, (one, two) in enumerate(zip(other, value, strict=True)):
                yield from differences(one, two, f"stroke {i + 1}, ")
        elif name == "pen_downs":
            if np.shape(other) != np.shape(value) or not np.allclose(other, value, rtol=0, atol=1.5 / RATE):
                yield here, other, value
        elif not isinstance(value, float):
            if other != value:
                yield here, other, value
        else:
            relative, absolute = {
                "coverage": (0.0, 0.04),
                "overall_error": (0.03, 2e-5),
                "contour": (0.02, 1e-6),
                "fidelity": (0.01, 1e-6),
                "rms_error": (1e-3, 1e-6),
                "dtw_distance": (2e-2, 6e-6),
                "max_error": (1e-3, 1e-6),
                "time": (0.0, 1.5 / RATE),
            }.get(name, (1e-9, 1e-12))
            if math.isnan(value) and math.isnan(other):
                continue
            if not abs(other - value) <= relative * abs(value) + absolute:
                yield here, other, value


@functools.cache
def disagreements(seed):
    """Of each character of a session, the columns in which its score is not what was counted."""
    drawn = session(seed)
    scores = cal.score_page(drawn.page, drawn.recording)
    assert len(scores) == len(drawn.text)
    return [
        (f"{drawn}, character {character + 1}, {name}", got, counted)
        for character, score in enumerate(scores)
        for name, got, counted in differences(told(score), count(drawn, character))
    ]


@pytest.mark.parametrize("seed", range(SESSIONS))
def test_the_score_of_a_session_is_what_an_independent_count_finds(seed):
    assert not disagreements(seed)


def test_a_mean_is_over_the_characters_that_have_an_error():
    pages = [cal.score_page(session(seed).page, session(seed).recording) for seed in range(SESSIONS)]
    rows = [count(session(seed), i) for seed in range(SESSIONS) for i in range(len(session(seed).text))]
    mean = cal.mean_score([score for page in pages for score in page])
    assert mean.characters == len(rows) and mean.characters_written == sum(row["strokes_written"] > 0 for row in rows)
    assert mean.stroke_count == sum(row["stroke_count"] for row in rows)
    assert mean.strokes_written == sum(row["strokes_written"] for row in rows)
    assert mean.rms_error == pytest.approx(np.nanmean([row["rms_error"] for row in rows]), rel=1e-3)
    assert mean.coverage == pytest.approx(np.mean([row["coverage"] for row in rows]), abs=0.01)


def test_every_fault_is_drawn_often():
    drawn = collections.Counter(fault for seed in range(SESSIONS) for fault in session(seed).faults)
    assert set(drawn) == set(FAULTS) and min(drawn.values()) >= SESSIONS // len(FAULTS)
