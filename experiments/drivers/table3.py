"""Reduction at 0.2 and 0.1 mm layers (Table 3)."""
from lab.laboratory import NO_COVER
from lab.runs import Run
from lab.tables import Table


def build(lab):
    table = Table("table3", "Reduction of volume in %, no cover",
                  [("model", ""), ("volume mm³", ".0f"), ("0.2 mm: paper", ".2f"), ("0.2 mm: ours", ".2f"), ("0.1 mm: paper", ".2f"),
                   ("0.1 mm: ours", ".2f"), ("difference 0.2, points", "+.2f"), ("difference 0.1, points", "+.2f"), ("proved", ""), ("what", "")])
    for row, model, real in lab.paper_models("table3_layer_height"):
        paper = [float(row["reduction_0p2mm_pct"]), float(row["reduction_0p1mm_pct"])]
        if model is None:
            table.add(row["model"], float(row["total_volume_mm3"]), paper[0], None, paper[1], None, None, None, None,
                      "the paper's file is missing (--models)")
            continue
        runs = [Run("generate", model, (*NO_COVER, "--layer-height", h)) for h in ("0.2", "0.1")]
        full = lab.value(runs[0], "mesh.volume_mm3")
        ours = [100 * (1 - v / full) if v and full else None for v in (lab.value(r, "totals.material_mm3") for r in runs)]
        off = [a - b if real and a is not None else None for a, b in zip(ours, paper)]
        table.add(model.title, full, paper[0] if real else None, ours[0], paper[1] if real else None, ours[1], *off,
                  lab.proved(runs), lab.why(runs[0]) or lab.why(runs[1]) or model.origin)
    return [table]
