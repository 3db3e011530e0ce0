#!/usr/bin/env python3
"""Writes the built-in solids as binary STL. Usage: experiments/make_solids.py FOLDER"""
import math
import pathlib
import random
import shutil
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(c for corner in triangle for c in corner), 0))


def prism(outline, depth):
    """A convex-free outline (x, z), counter-clockwise, fanned by hand as `(outline, faces)`, extruded along y."""
    points, faces = outline
    front = [(x, 0.0, z) for x, z in points]
    back = [(x, depth, z) for x, z in points]
    triangles = []
    for a, b, c in faces:
        triangles += [(front[a], front[b], front[c]), (back[a], back[c], back[b])]
    for i in range(len(points)):
        j = (i + 1) % len(points)
        triangles += [(front[i], back[j], front[j]), (front[i], back[i], back[j])]
    return triangles


def arch(width=30.0, height=22.0, radius=10.0, depth=14.0, steps=32):
    """A block with half a cylinder cut out of its foot."""
    w = width / 2
    inner = [(radius * math.cos(math.pi * k / steps), radius * math.sin(math.pi * k / steps)) for k in range(steps + 1)]
    points = [(-w, 0.0), *reversed(inner), (w, 0.0), (w, height), (-w, height)]  # inner from (-r, 0) over the top to (r, 0)
    n = len(points)
    foot_left, foot_right, right, top_right, top_left = 1, steps + 1, n - 3, n - 2, n - 1
    middle = 1 + steps // 2
    faces = [(0, foot_left, top_left), (foot_right, right, top_right), (top_left, middle, top_right)]
    faces += [(k, k + 1, top_left) for k in range(foot_left, middle)]
    faces += [(k, k + 1, top_right) for k in range(middle, foot_right)]
    return prism((points, faces), depth)


def lathe(profile, steps=64):
    """Profile of (radius, z) from bottom to top, closed by discs, turned about z."""
    def ring(r, z):
        return [(r * math.cos(2 * math.pi * k / steps), r * math.sin(2 * math.pi * k / steps), z) for k in range(steps)]
    rings = [ring(r, z) for r, z in profile]
    bottom, top = (0.0, 0.0, profile[0][1]), (0.0, 0.0, profile[-1][1])
    triangles = []
    for k in range(steps):
        j = (k + 1) % steps
        triangles += [(bottom, rings[0][j], rings[0][k]), (top, rings[-1][k], rings[-1][j])]
        for low, high in zip(rings, rings[1:]):
            triangles += [(low[k], low[j], high[j]), (low[k], high[j], high[k])]
    return triangles


def box(low, high):
    corners = [tuple((low, high)[k >> axis & 1][axis] for axis in range(3)) for k in range(8)]
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [(corners[a], corners[b], corners[c]) for q in quads for a, b, c in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]


def bridge(length=40.0, width=10.0, height=20.0, deck=3.0, pier=4.0):
    """A deck on two piers; the boxes overlap."""
    return (box((0, 0, 0), (pier, width, height)) + box((length - pier, 0, 0), (length, width, height)) +
            box((0, 0, height - deck), (length, width, height)))


def nail(length=40.0, shaft=2.0, head=6.0, thickness=3.0):
    """Upright on the end of its shaft, its head an overhang all around."""
    return lathe([(shaft, 0.0), (shaft, length - thickness), (head, length - thickness), (head, length)])


def sphere(radius=10.0, steps=48):
    angles = [math.pi * (k + 0.5) / steps for k in range(steps)]
    return lathe([(radius * math.sin(a), -radius * math.cos(a)) for a in angles], 2 * steps)


def low_roof(width=30.0, depth=20.0, low=10.0, high=14.0):
    """Figure 25, left: a flat overhang of low slope (8 degrees) over the whole inside."""
    return prism(([(0.0, 0.0), (width, 0.0), (width, high), (0.0, low)], [(0, 1, 2), (0, 2, 3)]), depth)


def far_tip(width=40.0, height=16.0, pit=10.0, tip=3.0):
    """Figure 25, right, inside an object: a pit in the roof whose tip is far from every wall and near the floor."""
    w, p = width / 2, pit / 2
    def square(s, z):
        return [(-s, -s, z), (s, -s, z), (s, s, z), (-s, s, z)]
    floor, roof, rim, point = square(w, 0.0), square(w, height), square(p, height), (0.0, 0.0, tip)
    triangles = [(floor[0], floor[2], floor[1]), (floor[0], floor[3], floor[2])]
    for k in range(4):
        j = (k + 1) % 4
        triangles += [(floor[k], floor[j], roof[j]), (floor[k], roof[j], roof[k]), (roof[k], roof[j], rim[j]),
                      (roof[k], rim[j], rim[k]), (rim[k], rim[j], point)]
    return triangles


def hanging_tip(depth=4.0):
    """Figure 25, right, outside: an arm on a post with a tip that hangs far from the post and near the bed; nothing else overhangs."""
    outline = [(0.0, 0.0), (4.0, 0.0), (4.0, 8.0), (24.0, 30.0), (24.0, 6.0), (26.0, 3.0), (28.0, 6.0), (28.0, 36.0), (0.0, 36.0)]
    return prism((outline, [(0, 1, 2), (0, 2, 8), (2, 3, 8), (3, 7, 8), (3, 6, 7), (3, 4, 6), (4, 5, 6)]), depth)


def slope45(outer=20, wide=15, narrow=5, height=10):
    """A block with a square hole whose sides lean in by exactly 45 degrees, turned by the angle of the 3-4-5 triangle: all along the hole
    every layer reaches exactly the layer height, which is exactly rho, over the one below. All coordinates are integers."""
    def square(s, z):
        along, across = (4 * s // 5, 3 * s // 5), (-3 * s // 5, 4 * s // 5)
        return [tuple(float(a * along[k] + b * across[k]) for k in (0, 1)) + (float(z),) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    bottom, top, low, high = square(outer, 0), square(outer, height), square(wide, 0), square(narrow, height)
    triangles = []
    for k in range(4):
        j = (k + 1) % 4
        for a, b, c, d in ((bottom[k], bottom[j], top[j], top[k]), (top[k], top[j], high[j], high[k]), (high[k], high[j], low[j], low[k]),
                           (low[k], low[j], bottom[j], bottom[k])):
            triangles += [(a, b, c), (a, c, d)]
    return triangles


CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
TETRAHEDRA = [(0, 5, 1, 6), (0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6)]


def isosurface(f, lo, hi, cells):
    """{ f < 0 } by marching tetrahedra. Every value on the border counts as outside, so the surface is closed."""
    step = (hi - lo) / cells
    value = {}

    def at(i, j, k):
        if (i, j, k) not in value:
            border = min(i, j, k) == 0 or max(i, j, k) == cells
            v = f(lo + i * step, lo + j * step, lo + k * step)
            value[i, j, k] = max(v, 1e-3) if border else (v if v != 0 else 1e-9)
        return value[i, j, k]

    def crossing(a, b):
        if b < a:
            a, b = b, a  # the same numbers from both sides
        va, vb = at(*a), at(*b)
        t = min(max(va / (va - vb), 0.02), 0.98)
        return tuple(lo + step * (p + t * (q - p)) for p, q in zip(a, b))

    triangles = []
    for i in range(cells):
        for j in range(cells):
            for k in range(cells):
                corners = [(i + x, j + y, k + z) for x, y, z in CORNERS]
                signs = [at(*c) < 0 for c in corners]
                if all(signs) or not any(signs):
                    continue
                for tetrahedron in TETRAHEDRA:
                    inside = [corners[t] for t in tetrahedron if signs[t]]
                    outside = [corners[t] for t in tetrahedron if not signs[t]]
                    if len(inside) == 1 or len(outside) == 1:
                        one, others = (inside[0], outside) if len(inside) == 1 else (outside[0], inside)
                        faces = [[crossing(one, o) for o in others]]
                    elif len(inside) == 2:
                        (a, b), (c, d) = inside, outside
                        ac, ad, bc, bd = crossing(a, c), crossing(a, d), crossing(b, c), crossing(b, d)
                        faces = [[ac, ad, bd], [ac, bd, bc]]
                    else:
                        continue
                    towards = [sum(o[m] for o in outside) / len(outside) - sum(n[m] for n in inside) / len(inside) for m in range(3)]
                    for p, q, r in faces:
                        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
                        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                        triangles.append((p, q, r) if sum(a * b for a, b in zip(normal, towards)) >= 0 else (p, r, q))
    return triangles


def gyroid(size=24.0, period=12.0, cells=40):
    k = 2 * math.pi / period
    return isosurface(lambda x, y, z: math.sin(k * x) * math.cos(k * y) + math.sin(k * y) * math.cos(k * z) +
                      math.sin(k * z) * math.cos(k * x), 0.0, size, cells)


def blobs(size=30.0, count=9, cells=36, seed=1):
    """The union of random balls, chained so that it holds together."""
    rng = random.Random(seed)
    balls = [(0.0, 0.0, 0.0, 7.0)]
    while len(balls) < count:
        x, y, z, r = rng.choice(balls)
        a, b, s = rng.uniform(0, 2 * math.pi), rng.uniform(-1, 1), rng.uniform(3.5, 6)
        c = math.sqrt(1 - b * b)
        ball = (x + r * c * math.cos(a), y + r * c * math.sin(a), z + r * b, s)
        if all(abs(v) + s < size / 2 - 1 for v in ball[:3]):
            balls.append(ball)
    return isosurface(lambda x, y, z: min(math.dist((x, y, z), b[:3]) - b[3] for b in balls), -size / 2, size / 2, cells)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(HERE / "models/cube20.stl", folder / "cube20.stl")
    cone = lathe([(3.0, 0.0), (12.0, 20.0)])
    for name, triangles in {"sphere": sphere(), "arch": arch(), "cone": cone, "low_roof": low_roof(), "far_tip": far_tip(), "slope45": slope45(),
                            "gyroid": gyroid(), "blobs": blobs(), "bridge_solid": bridge(), "nail_solid": nail(), "hanging_tip": hanging_tip()}.items():
        write_stl(folder / f"{name}.stl", triangles)


if __name__ == "__main__":
    main()
