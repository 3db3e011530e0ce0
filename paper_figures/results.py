"""Result files of ribvault_steps: read, checked, made anew when something changed."""
import csv
import hashlib
import io
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
VERSION = 1
DRAWN = ("units_per_mm", "settings")
MEMBERS = {"layers": (*DRAWN, "layers"), "tree": (*DRAWN, "tree", "straightening", "chain", "paths", "gaps", "cavity"), "run": ("totals",),
           "stages": (*DRAWN, "layer", "slice_above", "cavity_above", "cavity", "above", "copied", "overhang", "unsupported", "growth", "grown")}
MAKERS = {kind: f"ribvault_steps {kind}" for kind in ("layers", "stages", "tree")} | {"run": "ribvault generate --report"}


class Unusable(Exception):
    """A result file that cannot be drawn; the message names the file and what is wrong."""


def program(name):
    return pathlib.Path(os.environ.get("RIBVAULT_BIN", ROOT / "build/bin")) / name


class Part(dict):
    """An object of a result file, which says what it lacks."""

    def __init__(self, members, file, kind):
        super().__init__(members)
        self.file, self.kind = file, kind

    def __missing__(self, name):
        raise Unusable(f"{self.file}: the member \"{name}\" is missing; make it again with {MAKERS[self.kind]}")


class Result(Part):
    """A result file; lengths and coordinates in lattice units, `mm` converts."""

    def mm(self, units):
        return units / self["units_per_mm"]

    def points(self, flat):
        """[x0, y0, x1, y1, ...] as pairs in mm."""
        return [(self.mm(x), self.mm(y)) for x, y in zip(flat[::2], flat[1::2])]

    def region(self, contours):
        return [self.points(c) for c in contours]

    def forest(self, forest):
        return Forest(self, forest)

    def below_top(self, count):
        """The layer that many layers below the highest one."""
        if count >= len(self["layers"]):
            raise Unusable(f"{self['model']} has {len(self['layers'])} layers; this figure draws the one {count} below the highest")
        return self["layers"][-1 - count]

    def setting(self, name):
        return self.mm(self["settings"][name])


class Forest:
    """Vertices in mm with what they are, edges as pairs of numbers."""

    def __init__(self, result, forest):
        self.at = [(result.mm(x), result.mm(y)) for x, y, _ in forest["vertices"]]
        self.root = [bool(r) for _, _, r in forest["vertices"]]
        self.edges = [(a, b) for a, b, _ in forest["edges"]]
        self.first = [bool(f) for _, _, f in forest["edges"]]
        self.around = [[] for _ in self.at]
        for a, b in self.edges:
            self.around[a].append(b)
            self.around[b].append(a)

    def segments(self):
        return [(self.at[a], self.at[b]) for a, b in self.edges]

    def valence(self, v):
        return len(self.around[v])

    def sections(self):
        """Chains between vertices that are no plain points of a wall."""
        plain = [self.valence(v) == 2 and not self.root[v] for v in range(len(self.at))]
        chains = []
        for v in range(len(self.at)):
            if plain[v]:
                continue
            for n in self.around[v]:
                chain = [v, n]
                while plain[chain[-1]]:
                    chain.append(next(w for w in self.around[chain[-1]] if w != chain[-2]))
                if chain[0] < chain[-1] or (chain[0] == chain[-1] and chain[1] <= chain[-2]):
                    chains.append(chain)
        return chains


def read(path, kind):
    """The result file, which must be of this kind (a key of MEMBERS)."""
    path = pathlib.Path(path)
    try:
        data = json.loads(path.read_text(), object_hook=lambda members: Part(members, path, kind))
    except OSError as error:
        raise Unusable(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise Unusable(f"{path}: no JSON ({error}); make it again with {MAKERS[kind]}") from None
    wanted = f"ribvault-{kind}/{VERSION}"
    found = data.get("schema") if isinstance(data, dict) else None
    if found != wanted:
        raise Unusable(f"{path}: its \"schema\" is {json.dumps(found)}, this figure draws \"{wanted}\"; make it again with {MAKERS[kind]}")
    for name in MEMBERS[kind]:
        data[name]
    return Result(data, path, kind)


def digest(*parts):
    h = hashlib.sha256()
    for part in parts:
        h.update(part if isinstance(part, bytes) else str(part).encode())
        h.update(b"\0")
    return h.hexdigest()[:16]


def made(kind, model, options, folder):
    """The file of `ribvault_steps KIND MODEL OPTIONS`, run only when program, model or options changed."""
    steps = program("ribvault_steps")
    if not steps.exists():
        raise Unusable(f"{steps} is not there; scripts/paper-figures builds it")
    stamp = digest(steps.read_bytes(), pathlib.Path(model).read_bytes(), kind, *options)
    path = folder / f"{kind}-{pathlib.Path(model).stem}-{stamp}.json"
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([steps, kind, model, "-o", path, *options], capture_output=True, text=True)
        if done.returncode != 0:
            raise Unusable(done.stderr.strip() or f"ribvault_steps {kind}: exit code {done.returncode}")
    return path


def markdown_rows(text, columns):
    """The rows, heading first, of the table in a Markdown page whose heading has these columns."""
    chosen, rows = False, []
    for line in text.splitlines():
        cells = [c.strip() for c in line.strip().strip("|").split("|")] if line.startswith("|") else []
        chosen = bool(cells) and (chosen or set(columns) <= set(cells))
        if chosen and not set(cells[0]) <= set("-: "):
            rows.append(cells)
    return rows or [[]]


def read_table(path, columns):
    """Rows of a table that experiments/run.py wrote, as CSV or into a Markdown page; `columns` must be there."""
    path = pathlib.Path(path)
    try:
        text = path.read_text()
    except OSError as error:
        raise Unusable(f"{path}: {error.strerror}; scripts/experiments makes it") from None
    heading, *rows = csv.reader(io.StringIO(text)) if path.suffix == ".csv" else markdown_rows(text, columns)
    rows = [dict(zip(heading, row)) for row in rows]
    for name in columns:
        if not rows or name not in rows[0]:
            raise Unusable(f"{path}: the column \"{name}\" is missing; scripts/experiments makes the table again")
    return rows


def load(path, kind):
    """A result file for a script: a key of MEMBERS ("run" is a report), "picture" (a PNG), or "table:COLUMN,..."."""
    if kind.startswith("table:"):
        return read_table(path, kind.removeprefix("table:").split(","))
    if kind == "picture":
        if not pathlib.Path(path).exists():
            raise Unusable(f"{path}: there is no such picture; scripts/paper-figures makes it")
        return pathlib.Path(path)
    return read(path, kind)
