#!/usr/bin/env python3
"""Travels, retractions, time and material beside PrusaSlicer 2.5 and CuraEngine 4.13, from the G-code of all three.

Usage: experiments/travel_compared.py [--models FOLDER] [--program build/bin/ribvault] [--options "--shell-first ..."] [--line-distances 2.6,0.8]

All at h = 0.2 mm, d = 0.4 mm, one perimeter, one cover, lightning at 15 % (PrusaSlicer) and at each of --line-distances (CuraEngine; 2.6 mm is
15 %), at equal speeds (40 mm/s shell, 60 mm/s infill or supports, 20 mm/s first layer, 150 mm/s travel), no layer slower so that it sets, 3 mm retraction at 40 mm/s, no skirt.
A travel is a run of moves without extrusion between two tracks (its moves are counted beside it: detours have several), its length that in x and y; retractions are moves of the
filament backwards. Time: the same estimate for all three files, trapezoids with PrusaSlicer's default limits, here once more in
Python so that it does not depend on the program; it ignores heating. On air: mm of track of which `ribvault verify --inside` finds nothing
within rho below (for the models' external overhangs no infill is to blame); "-" where outer perimeters are left open, so that inside is nowhere. Slicers that are missing are left out, as are the
paper's models without --models. From CGAL's data (Debian: libcgal-demo) five meshes, 50 mm high. Prints a Markdown table.
"""
import argparse
import json
import math
import pathlib
import shlex
import shutil
import struct
import subprocess
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CGAL_DATA = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
CURA = pathlib.Path("/usr/share/cura/resources/definitions")
MODELS = [("cube 20 mm", ROOT / "experiments/models/cube20.stl", []), ("low poly bunny", "low_poly_bunny.stl", ["--scale", "0.5"]),
          ("moai", "low_poly_moai.stl", ["--scale", "1/2.4"]), ("kitten", "kitten.off", ["--scale", "0.54271", "--up", "y"])]
CGAL = ["bunny00.off", "camel.off", "bear.off", "elephant.off", "fandisk.off"]


def triangles_of(path):
    data = path.read_bytes()
    if path.suffix == ".stl":
        if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
            return [[v[3:6], v[6:9], v[9:12]] for v in (struct.unpack_from("<12f", data, 84 + 50 * i) for i in range((len(data) - 84) // 50))]
        corners = [tuple(map(float, l.split()[1:])) for l in data.decode().splitlines() if l.strip().startswith("vertex")]
        return [corners[i:i + 3] for i in range(0, len(corners), 3)]
    words = [w for l in data.decode().splitlines() for w in l.split("#")[0].split()][1:]
    n, f = int(words[0]), int(words[1])
    vertices = [tuple(map(float, words[3 + 3 * i:6 + 3 * i])) for i in range(n)]
    triangles, at = [], 3 + 3 * n
    for _ in range(f):
        k = int(words[at])
        face = [vertices[int(w)] for w in words[at + 1:at + 1 + k]]
        triangles += [[face[0], face[i], face[i + 1]] for i in range(1, k - 1)]
        at += k + 1
    return triangles


def placed_stl(source, options, target):
    """The model as ribvault places it, for the slicers: turned, scaled, its middle at the origin, on the bed."""
    triangles = triangles_of(source)
    if "--up" in options:
        triangles = [[(v[2], v[0], v[1]) for v in t] for t in triangles]
    size = lambda k: max(v[k] for t in triangles for v in t) - min(v[k] for t in triangles for v in t)
    scale = 1.0
    if "--scale" in options:
        top, _, bottom = options[options.index("--scale") + 1].partition("/")
        scale = float(top) / float(bottom or 1)
    if "--height" in options:
        scale = float(options[options.index("--height") + 1]) / size(2)
    lo = [min(v[k] for t in triangles for v in t) for k in range(3)]
    shift = [lo[0] + size(0) / 2, lo[1] + size(1) / 2, lo[2]]
    with open(target, "wb") as out:
        out.write(b" " * 80 + struct.pack("<I", len(triangles)))
        for t in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *[(v[k] - shift[k]) * scale for v in t for k in range(3)], 0))


LIMITS = {"speed": (500, 500, 12, 120), "acceleration": (9000, 9000, 500, 10000), "jerk": (10, 10, 0.2, 2.5), "any": 1500}


def seconds_of(moves):
    """From standstill to standstill; moves are (dx, dy, dz, de, mm/s)."""
    blocks = []
    for *step, speed in moves:
        head = math.sqrt(step[0] ** 2 + step[1] ** 2 + step[2] ** 2)
        length = head or abs(step[3])
        if not length or not speed:
            continue
        share = [abs(s) / length for s in step]
        cruise = min([speed] + [m / s for m, s in zip(LIMITS["speed"], share) if s])
        acceleration = min([LIMITS["any"]] + [m / s for m, s in zip(LIMITS["acceleration"], share) if s])
        axis = [cruise * s / length for s in step]
        safe = min([cruise] + [j for j, v in zip(LIMITS["jerk"], axis) if abs(v) > j])
        entry = safe
        if blocks:
            before = blocks[-1]
            slower = min(before["cruise"], cruise)
            factor = 1
            for out, into, limit in zip(before["axis"], axis, LIMITS["jerk"]):
                out, into = out * slower / before["cruise"] * factor, into * slower / cruise * factor
                jerk = abs(out - into) if out * into > 0 else max(abs(out), abs(into))
                if jerk > limit:
                    factor *= limit / jerk
            entry = slower * factor
        blocks.append({"length": length, "cruise": cruise, "a": acceleration, "axis": axis, "safe": safe, "entry": entry})
    after = blocks[-1]["safe"] if blocks else 0
    for b in reversed(blocks):
        b["entry"] = after = min(b["entry"], math.sqrt(after ** 2 + 2 * b["a"] * b["length"]))
    total = 0
    for i, b in enumerate(blocks):
        after = blocks[i + 1]["entry"] if i + 1 < len(blocks) else b["safe"]
        after = min(after, b["cruise"], math.sqrt(b["entry"] ** 2 + 2 * b["a"] * b["length"]))
        if i + 1 < len(blocks):
            blocks[i + 1]["entry"] = after
        up, down = (max(0, b["cruise"] ** 2 - v ** 2) / (2 * b["a"]) for v in (b["entry"], after))
        if up + down <= b["length"]:
            total += (2 * b["cruise"] - b["entry"] - after) / b["a"] + (b["length"] - up - down) / b["cruise"]
        else:
            peak = math.sqrt(max(b["a"] * b["length"] + (b["entry"] ** 2 + after ** 2) / 2, b["entry"] ** 2, after ** 2))
            total += (2 * peak - b["entry"] - after) / b["a"]
    return total


def measure(gcode, filament):
    at, speed, relative = [0.0] * 4, 0.0, False
    travels = travel_moves = retractions = 0
    length = pushed = 0.0
    travelling, moves = False, []
    for line in open(gcode, errors="replace"):
        words = line.split(";")[0].split()
        if not words:
            continue
        if words[0] in ("M82", "M83"):
            relative = words[0] == "M83"
        if words[0] not in ("G0", "G1", "G92"):
            continue
        to = list(at)
        for word in words[1:]:
            if word[0] in "XYZE":
                k = "XYZE".index(word[0])
                to[k] = float(word[1:]) + (at[k] if k == 3 and relative and words[0] != "G92" else 0)
            elif word[0] == "F":
                speed = float(word[1:]) / 60
        if words[0] != "G92":
            step = [b - a for a, b in zip(at, to)]
            moves.append((*step, speed))
            xy = math.hypot(step[0], step[1])
            pushed += step[3]
            retractions += step[3] < 0 and xy == 0
            if xy and step[3] <= 0:
                length += xy
                travels += not travelling
                travel_moves += 1
                travelling = True
            elif xy:
                travelling = False
        at = to
    return {"travels": travels, "moves": travel_moves, "length": length, "retractions": retractions, "minutes": seconds_of(moves) / 60,
            "mm3": pushed * math.pi / 4 * filament ** 2}


def slice_with(name, stl, out, log, line_distance):
    if name == "PrusaSlicer":
        widths = [a for kind in ("", "external-perimeter-", "first-layer-", "infill-", "perimeter-", "solid-infill-", "top-infill-")
                  for a in (f"--{kind}extrusion-width", "0.4")]
        command = ["prusa-slicer", "--export-gcode", stl, "-o", out, "--layer-height", "0.2", "--first-layer-height", "0.2", "--nozzle-diameter", "0.4",
                   "--perimeters", "1", "--top-solid-layers", "1", "--bottom-solid-layers", "1", "--fill-pattern", "lightning", "--fill-density", "15%",
                   "--skirts", "0", "--filament-diameter", "1.75", "--gcode-flavor", "marlin2", "--center", "100,100", "--retract-length", "3",
                   "--retract-speed", "40", "--travel-speed", "150", "--perimeter-speed", "40", "--external-perimeter-speed", "40", "--infill-speed", "60",
                   "--solid-infill-speed", "40", "--top-solid-infill-speed", "40", "--small-perimeter-speed", "40", "--bridge-speed", "60",
                   "--first-layer-speed", "20", "--slowdown-below-layer-time", "0", *widths]
    else:
        settings = {"infill_pattern": "lightning", "infill_line_distance": line_distance, "infill_sparse_density": 15, "wall_line_count": 1, "top_layers": 1,
                    "bottom_layers": 1, "roofing_layer_count": 0, "layer_height": 0.2, "layer_height_0": 0.2, "adhesion_type": "none",
                    "machine_width": 200, "machine_depth": 200, "mesh_rotation_matrix": "[[1,0,0],[0,1,0],[0,0,1]]", "cool_min_layer_time": 0,
                    "speed_wall_0": 40, "speed_wall_x": 40, "speed_topbottom": 40, "speed_infill": 60, "speed_travel": 150, "speed_print_layer_0": 20,
                    "speed_travel_layer_0": 150, "speed_layer_0": 20, "speed_slowdown_layers": 1, "retraction_amount": 3, "retraction_retract_speed": 40,
                    "retraction_prime_speed": 40, "material_diameter": 1.75, "speed_wall": 40, "speed_print": 40}
        settings |= {f"{kind}line_width": 0.4 for kind in ("", "wall_", "skin_", "infill_")} | {"wall_line_width_0": 0.4, "wall_line_width_x": 0.4}
        command = ["CuraEngine", "slice", "-j", CURA / "fdmprinter.def.json", *[a for k, v in settings.items() for a in ("-s", f"{k}={v}")],
                   "-e0", "-s", "material_diameter=1.75", "-l", stl, "-o", out]
    environment = {"CURA_ENGINE_SEARCH_PATH": f"{CURA}:{CURA.parent / 'extruders'}", "PATH": "/usr/bin:/bin", "HOME": str(stl.parent)}
    with open(log, "w") as output:
        return subprocess.run(list(map(str, command)), stdout=output, stderr=output, env=environment).returncode == 0 and out.exists()


def mm_on_air(program, gcode, report):
    """None where the outer perimeters are not closed, as PrusaSlicer's at the seam, so that nothing is inside."""
    report.unlink(missing_ok=True)
    command = [program, "verify", "--inside", "--nozzle", "0.4", "--filament-diameter", "1.75", gcode, "--report", report, "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True)
    if not report.exists() and "needs closed loops" not in done.stderr:
        raise SystemExit(done.stderr)
    return json.loads(report.read_text())["totals"]["unsupported_mm"][1] if report.exists() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("--program", default=ROOT / "build/bin/ribvault")
    parser.add_argument("--options", default="", help="more options for ribvault")
    parser.add_argument("--line-distances", default="2.6", help="of CuraEngine's infill, mm, with commas between")
    arguments = parser.parse_args()
    programs = [("ribvault", None)]
    if shutil.which("prusa-slicer"):
        programs.append(("PrusaSlicer", None))
    if shutil.which("CuraEngine"):
        programs += [("CuraEngine", float(mm)) for mm in arguments.line_distances.split(",")]
    print("| model | program | travels | moves of them | travel mm | retractions | minutes | mm3 | mm on air |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        models = [(n, f if isinstance(f, pathlib.Path) else arguments.models / f if arguments.models else None, o) for n, f, o in MODELS]
        if CGAL_DATA.exists():
            with tarfile.open(CGAL_DATA) as archive:
                for name in CGAL:
                    (folder / name).write_bytes(archive.extractfile(f"data/meshes/{name}").read())
                    models.append((name, folder / name, ["--height", "50"]))
        for name, source, options in models:
            if source is None or not source.exists():
                print(f"| {name} | no file |")
                continue
            stl, out = folder / "model.stl", folder / "out.gcode"
            placed_stl(source, options, stl)
            for program, line_distance in programs:
                label = program if line_distance is None else f"{program}, {line_distance:g} mm"
                out.unlink(missing_ok=True)
                if program == "ribvault":
                    done = subprocess.run([arguments.program, "generate", source, *options, "-o", out, "--quiet", "--min-layer-time", "0", *shlex.split(arguments.options)])
                    good = done.returncode in (0, 1)
                else:
                    good = slice_with(program, stl, out, folder / "log", line_distance)
                if not good:
                    print(f"| {name} | {label} | failed |")
                    continue
                m = measure(out, 1.75)
                air = mm_on_air(arguments.program, out, folder / "verdict.json")
                print(f"| {name} | {label} | {m['travels']} | {m['moves']} | {m['length']:.0f} | {m['retractions']} | {m['minutes']:.1f} | {m['mm3']:.0f} | {'-' if air is None else f'{air:.1f}'} |", flush=True)


if __name__ == "__main__":
    main()
