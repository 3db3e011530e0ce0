"""What proving the print costs: the paper's gaps at junctions, gaps only where nothing hangs because of them, no gaps."""
from lab.laboratory import ONE_COVER
from lab.runs import Run
from lab.tables import Table

MODELS = ["cube", "bunny", "moai", "kitten", "bunny00"]


def build(lab):
    table = Table("gaps", "Gaps at junctions (Section 4.4), one cover, seed 1",
                  [("model", ""), ("strategy", ""), ("--gaps", ""), ("supports mm³", ".0f"), ("gaps", "d"), ("patches", "d"),
                   ("extruded over air, inside the outline, mm", ".2f"), ("layers on which something hangs", "d"), ("geometry proved", ""),
                   ("print proved", ""), ("what", "")])
    for name in MODELS:
        model = lab.registry[name]
        if not model.file:
            table.add(model.title, *[None] * 9, "the file is missing (--models)")
            continue
        for strategy in ("paper", "thrifty"):
            for gaps in ("paper", "proved", "none"):
                run = Run("generate", model, (*ONE_COVER, "--strategy", strategy, "--gaps", gaps))
                hangs = lab.value(run, "verdict.print.layers_refuted")
                length = lab.value(run, "verdict.print.unsupported_mm")
                table.add(model.title, strategy, gaps, lab.value(run, "totals.support_volume_mm3"), lab.value(run, "totals.gaps"),
                          lab.value(run, "totals.patches"), length[1] if length else None, len(hangs) if hangs is not None else None,
                          lab.value(run, "verdict.proved"), lab.value(run, "verdict.print.proved"), lab.why(run) or model.origin)
    return [table]
