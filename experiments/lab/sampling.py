"""Unsupported track length by dense sampling: what a tool without exact arithmetic can say. Needs numpy and scipy.

A point of a centre line counts as unsupported when it is farther than r from the material of the layer below, that is farther than r
plus half a track from every centre line there; as external when it is also farther than r from the object's own slice.
"""
import re

import numpy
from scipy.spatial import cKDTree

STEP, BELOW_STEP, TOLERANCE = 0.05, 0.02, 0.001  # mm
WORD = re.compile(r"([XYZEF])(-?\d*\.?\d+)")
LAYER = re.compile(r"^;LAYER:\d+$|^;LAYER_CHANGE")


def read_gcode(path, filament_mm=1.75):
    """Layers as dicts type -> array of segments (n, 2, 2); mm³ by type; number of travels."""
    layers, volume, travels = [], {}, 0
    section = numpy.pi * (filament_mm / 2) ** 2
    at, pushed, relative, kind, travelling = [0.0, 0.0], 0.0, False, "?", False
    for line in open(path, errors="replace"):
        line = line.strip()
        if LAYER.match(line):
            layers.append({})
        elif line.startswith(";TYPE:"):
            kind = line[6:]
        elif line.startswith("M83"):
            relative = True
        elif line.startswith("M82"):
            relative = False
        elif line.startswith("G92"):
            pushed = float(dict(WORD.findall(line)).get("E", pushed))
        elif line.startswith(("G0 ", "G1 ")):
            words = {k: float(v) for k, v in WORD.findall(line.split(";")[0])}
            to = [words.get("X", at[0]), words.get("Y", at[1])]
            more = words["E"] - (0 if relative else pushed) if "E" in words else 0.0
            if "E" in words and not relative:
                pushed = words["E"]
            if to != at:
                if more > 0 and layers:
                    layers[-1].setdefault(kind, []).append((at, to))
                    volume[kind] = volume.get(kind, 0.0) + more * section
                    travelling = False
                else:
                    travels += not travelling
                    travelling = True
            at = to
    return [{k: numpy.array(v) for k, v in layer.items()} for layer in layers], volume, travels


def sample(segments, step):
    """Points along segments, and how much length each stands for."""
    if len(segments) == 0:
        return numpy.empty((0, 2)), numpy.empty(0)
    a, d = segments[:, 0], segments[:, 1] - segments[:, 0]
    length = numpy.hypot(d[:, 0], d[:, 1])
    count = numpy.maximum(1, numpy.ceil(length / step)).astype(int)
    which = numpy.repeat(numpy.arange(len(count)), count)
    place = (numpy.arange(len(which)) - numpy.repeat(numpy.cumsum(count) - count, count) + 0.5) / count[which]
    return a[which] + place[:, None] * d[which], (length / count)[which]


def read_stl(path):
    data = numpy.fromfile(path, dtype=numpy.dtype([("n", "<3f4"), ("v", "<(3,3)f4"), ("a", "<u2")]), offset=84)
    return data["v"].astype(float)


def cut(triangles, z):
    """Segments in which a plane meets the triangles."""
    above = triangles[:, :, 2] >= z
    crossing = triangles[above.any(1) & ~above.all(1)]
    points = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = crossing[:, i], crossing[:, j]
        differ = (p[:, 2] >= z) != (q[:, 2] >= z)
        t = numpy.where(differ, (z - p[:, 2]) / numpy.where(differ, q[:, 2] - p[:, 2], 1), numpy.nan)
        points.append(p[:, :2] + t[:, None] * (q[:, :2] - p[:, :2]))
    stacked = numpy.stack(points, 1)
    order = numpy.argsort(numpy.isnan(stacked[:, :, 0]), axis=1, kind="stable")[:, :2]
    return numpy.take_along_axis(stacked, order[:, :, None], 1)


def inside(points, segments):
    a, b = segments[:, 0], segments[:, 1]
    x, y = points[:, 0, None], points[:, 1, None]
    spans = (a[:, 1] > y) != (b[:, 1] > y)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        meets = spans & (x < a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0]))
    return meets.sum(1) % 2 == 1


def unsupported(layers, triangles, height=0.2, width=0.4):
    """(internal mm, external mm) of track that hangs, over all layers."""
    r, lo, hi = width / 2, triangles.min((0, 1)), triangles.max((0, 1))
    everything = numpy.concatenate([s for layer in layers for s in layer.values()]).reshape(-1, 2)
    shift = (everything.min(0) + everything.max(0)) / 2 - (lo[:2] + hi[:2]) / 2  # slicers move a model over the bed
    triangles = triangles + numpy.array([*shift, -lo[2]])
    internal = external = 0.0
    for i in range(1, len(layers)):
        if not layers[i] or not layers[i - 1]:
            continue
        points, length = sample(numpy.concatenate(list(layers[i].values())), STEP)
        below, _ = sample(numpy.concatenate(list(layers[i - 1].values())), BELOW_STEP)
        far = cKDTree(below).query(points, distance_upper_bound=width + TOLERANCE)[0] > width + TOLERANCE
        if not far.any():
            continue
        points, length = points[far], length[far]
        outline = cut(triangles, (i - 0.5) * height)
        edge, _ = sample(outline, BELOW_STEP)
        outside = ~inside(points, outline)
        if len(edge):
            outside &= cKDTree(edge).query(points)[0] > r + TOLERANCE
        internal += length[~outside].sum()
        external += length[outside].sum()
    return float(internal), float(external)
