"""Filament of the supports with and without straightening (Table 4), and with and without the branch heuristic (equation (4))."""
import math

from lab.laboratory import ONE_COVER
from lab.tables import Table, mean, spread

FILAMENT_MM2 = math.pi * 0.875 ** 2


def build(lab):
    tables = [Table("table4", "Filament of the supports, mm of 1.75 mm filament, one cover",
                    [("model", ""), ("with: paper", ".0f"), ("with: ours", ""), ("without: paper", ".0f"), ("without: ours", ""),
                     ("with/without: paper", ".2f"), ("with/without: ours", ".2f"), ("difference %", "+.0f"), ("proved", ""), ("what", "")]),
              Table("table4_branches", "All four combinations, and half the branch bonus (2r): mm of filament of the supports, one cover",
                    [("model", ""), ("both", ".0f"), ("no straightening", ".0f"), ("no branch bonus", ".0f"), ("neither", ".0f"), ("half the bonus", ".0f"), ("half the bonus, no straightening", ".0f"), ("ratio at half the bonus", ".2f"),
                     ("branch bonus saves %", ".0f"), ("what", "")])]
    for row, model, real in lab.paper_models("table4_straightening"):
        paper = [float(row["with_straightening_filament_mm"]), float(row["without_straightening_filament_mm"])]
        if model is None:
            tables[0].add(row["model"], paper[0], None, paper[1], None, paper[0] / paper[1], None, None, None, "the paper's file is missing (--models)")
            continue
        options = [(), ("--no-straighten",), ("--no-branch-bonus",), ("--no-straighten", "--no-branch-bonus"),
                   ("--branch-bonus", "0.4"), ("--branch-bonus", "0.4", "--no-straighten")]
        runs = [lab.over_seeds(model, *ONE_COVER, *o) for o in options]
        length = [[v / FILAMENT_MM2 for v in lab.values(r, "totals.support_volume_mm3")] for r in runs]
        means = [mean(v) for v in length]
        ratio = means[0] / means[1] if means[0] and means[1] else None
        proved = lab.proved([r for group in runs for r in group])
        published = paper[0] / paper[1]
        tables[0].add(model.title, paper[0] if real else None, spread(length[0]), paper[1] if real else None, spread(length[1]),
                      published if real else None, ratio, 100 * (ratio / published - 1) if real and ratio else None, proved,
                      lab.why(runs[0][0]) or model.origin)
        tables[1].add(model.title, *means, means[4] / means[5] if means[4] and means[5] else None,
                      100 * (1 - means[0] / means[2]) if means[0] and means[2] else None, model.origin)
    return tables
