"""PrusaSlicer's and CuraEngine's lightning infill on the same models in the same run, and ours."""
from lab.runs import Run
from lab.tables import Table

PROGRAMS = {"prusa": "PrusaSlicer", "cura": "CuraEngine", "own": "ribvault"}


def build(lab):
    table = Table("peers", "Lightning infill of slicers, one perimeter, one cover",
                  [("model", ""), ("program", ""), ("extruded mm³ (E)", ".0f"), ("infill or supports mm³", ".0f"), ("sampled: unsupported mm", ".0f"), ("sampled: external mm", ".0f"),
                   ("exactly: unsupported mm", ".0f"), ("our verifier", ""), ("travels", "d"), ("seconds", ".2f"), ("CPU s", ".2f"), ("what", "")],
                  note="Sampled: centre lines every 0.05 mm against the layer below. Exactly: `ribvault verify` on the same file, external overhangs included, which no infill "
                       "can hold; ribvault's own hang there and nowhere else (`verify --inside`: supported).")
    for name in ("cube", "bunny", "moai", "kitten", "bunny00"):
        model = lab.registry[name]
        if not model.file:
            table.add(model.title, "all", *[None] * 9, "the paper's file is missing (--models)")
            continue
        for kind, title in PROGRAMS.items():
            run = Run(kind, model)
            checked, exact = lab.value(run, "verify.missing"), None
            if checked is None and (verdict := lab.value(run, "verify.report.verdict")):
                hanging = len(verdict["layers_unsupported"])
                checked = "supported" if verdict["supported"] else f"{hanging} of {verdict['layers']} layers hang"
                exact = sum(lab.value(run, "verify.report.totals.unsupported_mm")) / 2
            table.add(model.title, title, *(lab.value(run, p) for p in ("material_mm3", "infill_mm3", "sampled_internal_mm", "sampled_external_mm")),
                      exact, checked, *(lab.value(run, p) for p in ("travels", "seconds", "cpu_seconds")), lab.why(run) or model.origin)
    return [table]
