"""PrusaSlicer's and CuraEngine's lightning infill on the same models in the same run, and ours."""
from lab.laboratory import ONE_COVER
from lab.runs import Run
from lab.tables import Table

PROGRAMS = {"prusa": "PrusaSlicer", "cura": "CuraEngine", "own": "ribvault"}


def build(lab):
    table = Table("peers", "Lightning infill of slicers, one perimeter, one cover",
                  [("model", ""), ("program", ""), ("total mm³", ".0f"), ("infill or supports mm³", ".0f"), ("sampled: unsupported mm", ".0f"), ("sampled: external mm", ".0f"),
                   ("our verifier", ""), ("travels", "d"), ("seconds", ".2f"), ("CPU s", ".2f"), ("what", "")],
                  note="Sampled: centre lines every 0.05 mm against the layer below. ribvault's G-code has the paper's gaps at junctions; the geometry is proved.")
    for name in ("cube", "bunny", "moai", "kitten", "bunny00"):
        model = lab.registry[name]
        if not model.file:
            table.add(model.title, "all", *[None] * 8, "the paper's file is missing (--models)")
            continue
        for kind, title in PROGRAMS.items():
            run = Run(kind, model)
            checked = lab.value(run, "verify.missing")
            if checked is None and (verdict := lab.value(run, "verify.report.verdict")):
                checked = "proved" if verdict.get("proved") else f"{len(verdict.get('layers_refuted', []))} layers refuted"
            proved = lab.value(Run("generate", model, ONE_COVER), "verdict.proved") if kind == "own" else None
            table.add(model.title, title, *(lab.value(run, p) for p in ("material_mm3", "infill_mm3", "sampled_internal_mm", "sampled_external_mm")),
                      "geometry proved" if proved else checked, *(lab.value(run, p) for p in ("travels", "seconds", "cpu_seconds")), lab.why(run) or model.origin)
    return [table]
