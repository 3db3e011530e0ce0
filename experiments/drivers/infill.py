"""Against 15 % standard infill, in metres of filament (Section 5.2)."""
from drivers.table4 import FILAMENT_MM2
from lab.laboratory import NO_COVER
from lab.registry import paper_rows
from lab.runs import Run
from lab.tables import Table, percent_off


def build(lab):
    table = Table("infill", "Metres of 1.75 mm filament: 15 % standard infill against ribbed vaults, no cover",
                  [("model", ""), ("paper: infill", ".1f"), ("grid", ".1f"), ("honeycomb", ".1f"), ("difference % (grid)", "+.1f"), ("paper: ours", ".1f"), ("ours", ".1f"),
                   ("difference %", "+.1f"), ("infill/ours: paper", ".1f"), ("infill/ours", ".1f"), ("grid: layers refuted", ""), ("ours proved", ""), ("what", "")])
    claims = {r["claim"]: r["value"] for r in paper_rows("text_claims")}
    moai = next(v for k, v in claims.items() if k.startswith("Moai scaled five times"))
    octopus = next(v for k, v in claims.items() if k.startswith("Large Cute Octopus"))
    paper_moai = [float(x.split()[0]) for x in moai.split(" against ")]
    paper_octopus = [float(x.split()[0]) for x in octopus.split(" against ")]
    model = lab.registry["moai"]
    cases = [("Moai, five times", model.scaled(5) if model.file else None, paper_moai, True)]
    large = lab.registry["cute_octopus"]
    cases.append(("Large Cute Octopus", large if large.file else None, paper_octopus, False))
    cases += [(m.title, m, None, True) for m in (model, lab.registry["cube"], lab.registry["bunny00"], lab.registry["sphere"]) if m.file]
    for title, placed, paper, scaled in cases:
        if placed is None:
            table.add(title, paper[0], None, None, None, paper[1], None, None, paper[0] / paper[1], None, None, None,
                      "the paper's file is missing (--models)")
            continue
        judge = () if paper is None else ("--no-judge",)  # the proof of eight metres of infill a layer would take the hour
        metres = [v / FILAMENT_MM2 / 1000 if v else None for v in (
            lab.value(Run("infill", placed, (*NO_COVER, "--pattern", p, *judge)), "material_mm3") for p in ("grid", "honeycomb"))]
        run = Run("generate", placed, NO_COVER)
        ours = lab.value(run, "totals.material_mm3")
        ours = ours / FILAMENT_MM2 / 1000 if ours else None
        grid = Run("infill", placed, (*NO_COVER, "--pattern", "grid", *judge))
        refuted = lab.value(grid, "judgement.layers_refuted")
        table.add(title, paper and paper[0], *metres, percent_off(metres[0], paper and paper[0]), paper and paper[1], ours,
                  percent_off(ours, paper and paper[1]), paper and paper[0] / paper[1], metres[0] / ours if ours and metres[0] else None,
                  "not judged at this size" if judge else f"{refuted} of {lab.value(grid, 'judgement.layers')}", lab.value(run, "verdict.proved"),
                  lab.why(run) or placed.origin)
    return [table]
