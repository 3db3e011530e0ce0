"""Table 6: material and time of external supports; ours beside PrusaSlicer's grid and snug supports and CuraEngine's tree supports."""
import math

from lab.runs import Run
from lab.tables import Table

GAP = ("--support-gap", "0.2")
GAPS = (*GAP, "--support-gap-layers", "1")
PROGRAMS = (("supports_own", (), "ribvault"), ("supports_own", GAP, "ribvault, gap 0.2 mm"), ("supports_own", GAPS, "ribvault, gaps 0.2 mm and a layer"),
            ("supports_own", (*GAPS, "--bed-only"), "ribvault, gaps, bed only"), ("supports_grid", (), "PrusaSlicer, grid"),
            ("supports_snug", (), "PrusaSlicer, snug"), ("supports_tree", (), "CuraEngine, tree"))
TITLES = [title for _, _, title in PROGRAMS]
OWN, GRID = 0, TITLES.index("PrusaSlicer, grid")
MESHES = ("bunny00", "hand", "elephant", "bull", "armadillo", "camel", "elk", "bear", "knot", "dino", "anchor", "fandisk")


def added(with_supports, without):
    """Minutes, or nothing."""
    return None if with_supports is None or without is None else (with_supports - without) / 60


def centimetres(mm3):
    return None if mm3 is None else mm3 / (math.pi / 4 * 1.75 ** 2) / 10


def build(lab):
    material = Table("table6", "External supports: filament and time that they add",
                     [("model", ""), *((f"{t}: cm", ".0f") for t in TITLES), ("ribvault of grid %", ".0f"), *((f"{t}: min", ".0f") for t in TITLES[:-1])],
                     note="One perimeter, one cover, 0.2 mm layers, supports under slopes flatter than 45 degrees. Minutes: with supports less without, each program's own "
                          "estimate; CuraEngine alone makes none.")
    judged = Table("table6_judged", "The same prints judged: unsupported mm² at most, of the whole print, inside and outside",
                   [("model", ""), *((t, ".1f") for t in TITLES), ("ribvault: supported", "")],
                   note="As they are: in a gap there is air.")
    by_gaps = Table("table6_gaps", "The same prints judged by the rules of the gaps that each leaves: unsupported mm² at most",
                    [("model", ""), *((t, ".1f") for t in TITLES), ("ribvault's: supported", "")],
                    note="`ribvault verify` with the options of each print; PrusaSlicer's with --support-gap 0.25, CuraEngine's with 0.7, both with --support-gap-layers 1, their defaults.")
    rows = [(f"{row['model']} (the paper: {row['ours_cm']} cm, {row['ours_min']} min)", model) for row, model, real in lab.paper_models("table6_external") if model and real]
    rows += [(lab.registry[name].title, lab.registry[name]) for name in ("nail_solid", "bridge_solid")]
    rows += [(f"{lab.registry[name].title}, 50 mm", lab.registry[name].at_height("50")) for name in MESHES if lab.registry[name].file]
    for title, model in rows:
        runs = [Run(kind, model, settings) for kind, settings, _ in PROGRAMS]
        support = [lab.value(run, "supported.support_mm3") for run in runs]
        minutes = [added(lab.value(run, "supported.print_seconds"), lab.value(run, "plain.print_seconds")) for run in runs[:-1]]
        areas = [(lab.value(run, "verify.report.totals.area_mm2") or (None, None))[1] for run in runs]
        grid = support[GRID]
        material.add(title, *(centimetres(v) for v in support), 100 * support[OWN] / grid if grid and support[OWN] is not None else None, *minutes)
        gap_areas = [(lab.value(run, "verify_gaps.report.totals.area_mm2") or (None, None))[1] for run in runs]
        own = [lab.value(run, "verify_gaps.report.verdict.supported") for run in runs[:GRID]]
        by_gaps.add(title, *gap_areas, None if None in own else all(own))
        judged.add(title, *areas, lab.value(runs[0], "verify.report.verdict.supported"))
    totals = [[row[k] for row in material.rows[-len(MESHES):] if row[k] is not None] for k in range(1, 1 + len(PROGRAMS))]
    if all(totals) and totals[GRID]:
        material.add("CGAL's meshes together", *map(sum, totals), 100 * sum(totals[OWN]) / sum(totals[GRID]))
    return [material, judged, by_gaps]
