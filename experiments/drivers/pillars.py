"""Section 5.4 and Figure 25: what trees that stand free save where walls waste, in cavities and outside."""
from lab.laboratory import NO_COVER, ONE_COVER
from lab.runs import Run
from lab.tables import Table

# Every wall is shorter than so long a pillar: none is grown.
NO_PILLARS = ("--pillar-length", "100")
MESHES = ("bear", "fandisk", "anchor", "knot", "elephant", "dino")


def build(lab):
    table = Table("pillars", "Pillars where walls waste (Section 5.4, Figure 25), seed 1",
                  [("model", ""), ("strategy", ""), ("walls only: supports mm³", ".0f"), ("with pillars: supports mm³", ".0f"), ("saved %", ".0f"),
                   ("slenderness: walls only", ".0f"), ("slenderness: with pillars", ".0f"), ("proved", ""), ("what", "")],
                  note="`--pillars`; the thrifty strategy's lean in cavities (`--leaning-length` 1 mm). Outside, new points may get pillars without it, so there walls only are had with `--pillar-length 100`.")
    rows = [(lab.registry["low_roof"], NO_COVER), (lab.registry["low_roof"], ONE_COVER), (lab.registry["far_tip"], NO_COVER),
            (lab.registry["hanging_tip"], (*NO_COVER, "--support", "external"))]
    for name in MESHES:
        model = lab.registry[name].at_height("50")
        rows += [(model, ONE_COVER), (model, (*ONE_COVER, "--support", "external"))]
    for model, settings in rows:
        outside = "external" in settings
        title = f"{model.title}, {'outside' if outside else 'no cover' if settings == NO_COVER else 'one cover'}"
        if not model.file:
            table.add(title, *[None] * 7, "the file is missing")
            continue
        for strategy in ("paper", "thrifty"):
            common = (*settings, "--strategy", strategy, "--gaps", "proved")
            runs = [Run("generate", model, (*common, *(NO_PILLARS if outside else ()))), Run("generate", model, (*common, "--pillars"))]
            volumes = [lab.value(run, "totals.external_support_volume_mm3" if outside else "totals.support_volume_mm3") for run in runs]
            saved = 100 * (1 - volumes[1] / volumes[0]) if None not in volumes and volumes[0] > 0 else None
            slender = [None, None] if outside else [lab.value(run, "totals.slenderness") for run in runs]
            proved = [lab.value(run, f"verdict.{of}") for run in runs for of in ("proved", "print.proved")]
            table.add(title, strategy, *volumes, saved, *slender, None if None in proved else all(proved), lab.why(runs[1]) or model.origin)
    return [table]
