"""--strategy thrifty against the paper's: supports after the gaps that the print can bear, and each ingredient's share."""
import dataclasses
import math

from lab.laboratory import NO_COVER, ONE_COVER
from lab.runs import Run
from lab.tables import Table

PAPERS = ["cube", "bunny", "moai", "kitten"]
# Named before the strategy was tried on them: the meshes that the models' list names, and three more, all 50 mm high.
MESHES = ["bunny00", "elephant", "armadillo", "bear", "camel", "fandisk", "knot", "dino", "hand", "anchor"]
PEER_MM3 = {"cube": 217, "bunny": 1117, "moai": 773, "kitten": 601}  # CuraEngine 4.13, lightning fill, not all of it supported
INGREDIENTS = {"all": (), "no shrink": ("--no-shrink",), "no trim": ("--no-trim",), "no doubling": ("--no-doubling",), "whole bonus": ("--quarter-bonus", "nowhere"), "quarter in narrow places": ("--quarter-bonus", "narrow"), "quarter everywhere": ("--quarter-bonus", "everywhere")}
MM3_PER_MM = 0.4 * 0.2  # of track
LEANING = ["1", "0.4"]  # mm of track that a leaning tree keeps at least
WIDTHS = ["0.4", "0.36", "0.32", "0.28", "0.24", "0.2"]  # mm, of the supports' tracks


def is_proved(lab, run):
    """As geometry and as printed."""
    return lab.value(run, "verdict.proved") and lab.value(run, "verdict.print.proved")


def add_mean(table, column, ratios):
    """The last row: the geometric mean of what stands in this column."""
    if ratios:
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        table.add("geometric mean", *[None] * (column - 1), mean, *[None] * (len(table.columns) - column - 2), f"largest {max(ratios):.2f}")


def widths_table(lab):
    table = Table("thrifty_widths", "Narrower supports, thrifty, one cover, seed 1",
                  [("model", ""), ("--support-width", ""), ("supports mm³", ".0f"), ("all material mm³", ".0f"), ("minutes", ".1f"), ("travels", "d"), ("slenderness", ".0f"), ("leaning, 0.4 mm: supports mm³", ".0f"), ("leaning: slenderness", ".0f"), ("proved", ""),
                   ("CuraEngine's lightning, lines as wide: mm³", ".0f"), ("extruded over air there, mm", ".0f"), ("what", "")],
                  note="Minutes without a least time per layer. CuraEngine's: infill by E; over air by `ribvault verify`, outside the object too.")
    for name in PAPERS:
        model = lab.registry[name]
        if not model.file:
            table.add(model.title, *[None] * (len(table.columns) - 2), "the file is missing (--models)")
            continue
        for width in WIDTHS:
            rooted = (*ONE_COVER, "--strategy", "thrifty", "--min-layer-time", "0", "--support-width", width)
            run, leaning = Run("generate", model, rooted), Run("generate", model, (*rooted, "--pillars", "--leaning-length", "0.4"))
            peer = Run("cura", model, (f"infill_line_width={width}",))
            seconds, hanging = lab.value(run, "totals.print_seconds"), lab.value(peer, "verify.report.totals.unsupported_mm")
            table.add(model.title, width, *(lab.value(run, f"totals.{p}") for p in ("support_volume_mm3", "material_mm3")), None if seconds is None else seconds / 60,
                      *(lab.value(run, f"totals.{p}") for p in ("travels", "slenderness")), *(lab.value(leaning, f"totals.{p}") for p in ("support_volume_mm3", "slenderness")), is_proved(lab, run) and is_proved(lab, leaning),
                      lab.value(peer, "infill_mm3"), None if hanging is None else sum(hanging) / 2, lab.why(run) or model.origin)
    return table


def leaning_table(lab, models):
    """Trees that lean: what they save, and at what cost in time and steadiness."""
    each = [("thrifty", ()), *((f"leaning, {mm} mm", ("--pillars", "--leaning-length", mm)) for mm in LEANING)]
    table = Table("leaning", "Thrifty, with trees that lean (--pillars --leaning-length), one cover, seed 1, print proved",
                  [("model", ""), *((f"supports mm³: {of}", ".0f") for of, _ in each), ("least/paper's", ".2f"), ("CuraEngine's lightning", "d"),
                   *((f"minutes: {of}", ".1f") for of, _ in each), *((f"travels: {of}", "d") for of, _ in each), *((f"slenderness: {of}", ".0f") for of, _ in each), ("proved", ""), ("what", "")],
                  note="Minutes without a least time per layer. The paper's: its strategy, as in the table above.")
    ratios = []
    for name, model in models:
        if not model.file:
            table.add(model.title, *[None] * (len(table.columns) - 2), "the file is missing (--models)")
            continue
        runs = [Run("generate", model, (*ONE_COVER, "--strategy", "thrifty", "--min-layer-time", "0", *options)) for _, options in each]
        paper = lab.value(Run("generate", model, (*ONE_COVER, "--gaps", "proved")), "totals.support_volume_mm3")
        volumes, seconds, travels, slender = ([lab.value(r, f"totals.{of}") for r in runs] for of in ("support_volume_mm3", "print_seconds", "travels", "slenderness"))
        ratio = min(volumes) / paper if paper and None not in volumes else None
        if ratio:
            ratios.append(ratio)
        table.add(model.title, *volumes, ratio, PEER_MM3.get(name), *(None if s is None else s / 60 for s in seconds), *travels, *slender,
                  all(is_proved(lab, r) for r in runs), next(filter(None, map(lab.why, runs)), model.origin))
    add_mean(table, 1 + len(each), ratios)
    return table


def build(lab):
    models = [lab.registry[n] for n in PAPERS]
    models += [dataclasses.replace(lab.registry[n], placement=("--height", "50")) for n in MESHES]
    table = Table("thrifty", "Supports in mm³, one cover, seed 1, print proved (--gaps proved)",
                  [("model", ""), ("paper's strategy", ".0f"), *((f"thrifty, {k}" if k != "all" else "thrifty", ".0f") for k in INGREDIENTS),
                   ("thrifty/paper's", ".2f"), ("lower bound", ".0f"), ("slenderness: paper's", ".0f"), ("slenderness: thrifty", ".0f"),
                   ("CuraEngine's lightning", "d"), ("CPU s: paper's", ".2f"), ("CPU s: thrifty", ".2f"), ("proved", ""), ("what", "")])
    totals = Table("thrifty_totals", "Total material in mm³ under Table 2's settings (no covers; the cube with one), print proved",
                   [("model", ""), ("Table 2: ours", ".0f"), ("Table 2: iterative carving", ".0f"), ("paper's strategy", ".0f"), ("thrifty", ".0f"), ("thrifty, leaning, 0.4 mm", ".0f"), ("proved", ""), ("what", "")])
    ratios = []
    for name, model in zip(PAPERS + MESHES, models):
        if not model.file:
            table.add(model.title, *[None] * (len(table.columns) - 2), "the file is missing (--models)")
            continue
        base = Run("generate", model, (*ONE_COVER, "--gaps", "proved"))
        runs = [Run("generate", model, (*ONE_COVER, "--strategy", "thrifty", *options)) for options in INGREDIENTS.values()]
        paper, ours = lab.value(base, "totals.support_volume_mm3"), [lab.value(r, "totals.support_volume_mm3") for r in runs]
        ratio = ours[0] / paper if ours[0] and paper else None
        if ratio:
            ratios.append(ratio)
        proved = [is_proved(lab, r) for r in (base, *runs)]
        bound = lab.value(Run("generate", model, (*ONE_COVER, "--strategy", "thrifty", "--length-bound")), "totals.support_length_bound_mm")
        slender = [lab.value(r, "totals.slenderness") for r in (base, runs[0])]
        table.add(model.title, paper, *ours, ratio, None if bound is None else bound * MM3_PER_MM, *slender, PEER_MM3.get(name),
                  lab.value(base, "cpu_seconds"), lab.value(runs[0], "cpu_seconds"), all(proved), lab.why(base) or model.origin)
    add_mean(table, 2 + len(INGREDIENTS), ratios)
    for row, model, real in lab.paper_models("table2_reduction"):
        if model is None or not real:
            continue
        cover = ONE_COVER if model.name == "cube" else NO_COVER
        runs = [Run("generate", model, (*cover, *o)) for o in (("--gaps", "proved"), ("--strategy", "thrifty"), ("--strategy", "thrifty", "--pillars", "--leaning-length", "0.4"))]
        proved = [is_proved(lab, r) for r in runs]
        totals.add(model.title, float(row["ours_mm3"]), float(row["iterative_carving_mm3"]), *(lab.value(r, "totals.material_mm3") for r in runs), all(proved), model.origin)
    return [table, totals, leaning_table(lab, list(zip(PAPERS + MESHES, models))), widths_table(lab)]
