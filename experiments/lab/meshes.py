"""Meshes of any size for the scaling experiment: finer copies of an OFF file, balls, columns, pins and reliefs. Written as binary STL."""
import array
import math
import struct


def read_off(path):
    """(vertices, triangles) of an OFF file whose faces are triangles."""
    words = iter(path.read_text().split())
    if next(words) != "OFF":
        raise ValueError(f"{path}: no OFF file")
    vertices, faces, _ = (int(next(words)) for _ in range(3))
    points = [tuple(float(next(words)) for _ in range(3)) for _ in range(vertices)]
    triangles = []
    for _ in range(faces):
        if next(words) != "3":
            raise ValueError(f"{path}: a face that is no triangle")
        triangles.append(tuple(int(next(words)) for _ in range(3)))
    return points, triangles


def quartered(points, triangles):
    """Every triangle cut into four at the middles of its edges. The surface stays what it is."""
    points, middles, result = list(points), {}, []

    def middle(a, b):
        key = (a, b) if a < b else (b, a)
        if key not in middles:
            middles[key] = len(points)
            points.append(tuple((p + q) / 2 for p, q in zip(points[a], points[b])))
        return middles[key]

    for a, b, c in triangles:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        result += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, result


def refined(points, triangles, count):
    """At least `count` triangles, at most one more: quartered as often as that allows, then some cut into three at their centroid."""
    while 4 * len(triangles) <= count:
        points, triangles = quartered(points, triangles)
    points, result, k = list(points), list(triangles), 0
    while len(result) < count:
        a, b, c = result[k]
        m = len(points)
        points.append(tuple(sum(x) / 3 for x in zip(points[a], points[b], points[c])))
        result[k] = (a, b, m)
        result += [(b, c, m), (c, a, m)]
        k += 1
    return points, result


def ball(count):
    """A ball of radius 10 of about `count` triangles between parallels and meridians."""
    rings = max(3, round(math.sqrt(count) / 2))
    around = 2 * rings
    points = [(0.0, 0.0, -10.0)]
    for i in range(1, rings):
        t = math.pi * i / rings
        points += [(10 * math.sin(t) * math.cos(math.pi * k / rings), 10 * math.sin(t) * math.sin(math.pi * k / rings), -10 * math.cos(t)) for k in range(around)]
    points.append((0.0, 0.0, 10.0))
    top, triangles = len(points) - 1, []
    for k in range(around):
        j = (k + 1) % around
        triangles += [(0, 1 + j, 1 + k), (top, top - around + k, top - around + j)]
        for low in range(1, top - around, around):
            triangles += [(low + k, low + j, low + around + j), (low + k, low + around + j, low + around + k)]
    return points, triangles


def column(height, side=20.0):
    """An upright square column."""
    points = [(x, y, z) for z in (0.0, height) for x, y in ((0.0, 0.0), (side, 0.0), (side, side), (0.0, side))]
    return points, [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), *(t for k in range(4) for j in ((k + 1) % 4,) for t in ((k, j, j + 4), (k, j + 4, k + 4)))]


def pins(count, apart=5.0, width=4.0, height=8.0):
    """So many pyramids side by side, in rows as long as there are rows."""
    row, points, triangles = math.ceil(math.sqrt(count)), [], []
    for k in range(count):
        x, y, n = apart * (k % row), apart * (k // row), len(points)
        points += [(x, y, 0.0), (x + width, y, 0.0), (x + width, y + width, 0.0), (x, y + width, 0.0), (x + width / 2, y + width / 2, height)]
        triangles += [(n, n + 2, n + 1), (n, n + 3, n + 2), *((n + a, n + (a + 1) % 4, n + 4) for a in range(4))]
    return points, triangles


def relief(side, wave=8.0, low=6.0, deep=4.0, step=1.0):
    """A square plate whose top is hills and hollows, `wave` mm from hill to hill."""
    n = round(side / step)

    def top(i, j):
        return low + deep / 2 * (1 + math.sin(2 * math.pi * i * step / wave) * math.sin(2 * math.pi * j * step / wave))

    points = [(i * step, j * step, z) for j in range(n + 1) for i in range(n + 1) for z in (0.0, top(i, j))]

    def at(i, j, upper):
        return 2 * (j * (n + 1) + i) + upper

    triangles = []
    for j in range(n):
        for i in range(n):
            for upper, a, c in ((1, (i + 1, j), (i, j + 1)), (0, (i, j + 1), (i + 1, j))):
                triangles += [(at(i, j, upper), at(*a, upper), at(i + 1, j + 1, upper)), (at(i, j, upper), at(i + 1, j + 1, upper), at(*c, upper))]
    for k in range(n):
        for a, b in (((k, 0), (k + 1, 0)), ((n, k), (n, k + 1)), ((k + 1, n), (k, n)), ((0, k + 1), (0, k))):
            triangles += [(at(*a, 0), at(*b, 0), at(*b, 1)), (at(*a, 0), at(*b, 1), at(*a, 1))]
    return points, triangles


def write_stl(path, mesh):
    points, triangles = mesh
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        out = array.array("B")
        record = struct.Struct("<12fH")
        for a, b, c in triangles:
            out.frombytes(record.pack(0, 0, 0, *points[a], *points[b], *points[c], 0))
        out.tofile(file)
