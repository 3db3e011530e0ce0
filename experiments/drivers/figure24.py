"""Reduction against object size, with the growth exponents of material, time and memory (Figure 24)."""
from lab.laboratory import NO_COVER, Plot
from lab.registry import LARGE_BED
from lab.runs import Run
from lab.tables import Table, growth_exponent

HEIGHTS = [10, 20, 30, 50, 75, 100, 150, 200, 300]


def build(lab):
    owl = lab.registry["owl"]
    chosen = [owl if owl.file else lab.registry.or_stand_in(owl), lab.registry["moai"]]
    table = Table("figure24", "Object size against material, no cover",
                  [("model", ""), ("height mm", ".0f"), ("full mm³", ".0f"), ("ours mm³", ".0f"), ("reduction %", ".2f"), ("supports mm³", ".0f"),
                   ("CPU s", ".2f"), ("peak MB", ".0f"), ("proved", ""), ("what", "")],
                  note="The paper draws this curve for the owl (up to 150 mm) and prints no numbers; Table 2 has one point, 88.94 % at 59 mm.")
    growth = Table("figure24_growth", "Growth with height: exponent e of height^e, least squares over all sizes from 30 mm",
                   [("model", ""), ("full volume", ".2f"), ("material", ".2f"), ("supports", ".2f"), ("CPU time", ".2f"), ("memory", ".2f")])
    series = {}
    if not owl.file:
        table.add("Owl", *[None] * 8, "the paper's file is missing (--models)")
    for model in chosen:
        if model is None or not model.file:
            table.add(model.title if model else "stand-in", *[None] * 8, "missing")
            continue
        up = dict(zip(model.placement[::2], model.placement[1::2])).get("--up", "z")
        points = []
        for height in HEIGHTS:
            sized = type(model)(model.name, model.title, model.file, ("--height", str(height), "--up", up, *LARGE_BED), model.origin)
            run = Run("generate", sized, NO_COVER)
            full, ours = lab.value(run, "mesh.volume_mm3"), lab.value(run, "totals.material_mm3")
            numbers = [lab.value(run, p) for p in ("totals.support_volume_mm3", "cpu_seconds", "peak_memory_mb")]
            table.add(model.title, height, full, ours, 100 * (1 - ours / full) if ours and full else None, *numbers,
                      lab.value(run, "verdict.proved"), lab.why(run) or model.origin)
            if ours and full:
                points.append((height, full, ours, *numbers))
        large = [p for p in points if p[0] >= 30]
        growth.add(model.title, *(growth_exponent([p[0] for p in large], [p[k] for p in large]) for k in (1, 2, 3, 4, 5)))
        series[model.title] = [(p[0], 100 * (1 - p[2] / p[1])) for p in points]
    return [table, growth, Plot("figure24", "Reduction against object size", "height in mm", "reduction in %", series)]
