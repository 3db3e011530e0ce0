"""Output volume and reduction: ours, iterative carving, support-free hollowing (Table 2)."""
from lab.laboratory import NO_COVER, ONE_COVER
from lab.runs import Run
from lab.tables import Table, mean, percent_off, spread


def number(text):
    return float(text) if text else None


def build(lab):
    table = Table("table2", "Output volume, mm³: the paper's column beside ours",
                  [("model", ""), ("full", ".0f"), ("covers", ""), ("paper: ours", ".0f"), ("ours (mean ± spread over seeds)", ""), ("difference %", "+.1f"),
                   ("reduction % paper", ".2f"), ("reduction % ours", ".2f"), ("paper: carving", ".0f"), ("our carving", ".0f"),
                   ("difference %", "+.1f"), ("paper: support-free", ".0f"), ("our greedy bound", ".0f"), ("geometry proved: ours", ""),
                   ("layers refuted: carving", "d"), ("layers refuted: support-free", "d"), ("what", "")])
    for row, model, real in lab.paper_models("table2_reduction"):
        published = [number(row[k]) for k in ("ours_mm3", "iterative_carving_mm3", "support_free_hollowing_mm3")]
        if model is None:
            table.add(row["model"], number(row["full_volume_mm3"]), None, published[0], None, None, number(row["ours_pct"]), None,
                      published[1], None, None, published[2], None, None, None, None, "the paper's file is missing (--models)")
            continue
        for covers in (NO_COVER, ONE_COVER) if model.name == "cube" else (lab.covers(model),):
            runs = lab.over_seeds(model, *covers)
            volumes, full = lab.values(runs, "totals.material_mm3"), lab.value(runs[0], "mesh.volume_mm3")
            ours = mean(volumes)
            compared = real or model.name == "bunny00"  # one stand-in is enough for the slow methods

            def other(kind, path):
                return lab.value(Run(kind, model, covers), path) if compared else None

            carved = other("carve", "material_mm3")
            table.add(model.title, full, covers[1], published[0] if real else None, spread(volumes), percent_off(ours, published[0]) if real else None,
                      number(row["ours_pct"]) if real else None, 100 * (1 - ours / full) if ours and full else None,
                      published[1] if real else None, carved, percent_off(carved, published[1]) if real else None,
                      published[2] if real else None, other("hollow", "material_mm3"), lab.proved(runs),
                      other("carve", "judgement.layers_refuted"), other("hollow", "judgement.layers_refuted"),
                      lab.why(runs[0]) or model.origin)
    return [table]
