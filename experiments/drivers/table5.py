"""Computation time per model, with the time of each stage (Table 5)."""
import statistics

from lab.laboratory import NO_COVER
from lab.runs import Run
from lab.tables import Table

STAGES = ["read", "slice", "erode", "cavity", "overhang", "sweep", "proof", "paths", "write"]


def build(lab):
    table = Table("table5", "Seconds for the whole job, proof and G-code included, on one thread (as the paper) and on all; stages on one thread",
                  [("model", ""), ("paper s", ".0f"), ("ours, one thread: CPU s", ".2f"), ("all threads: wall s", ".2f"), ("times faster", ".0f"),
                   ("peak MB", ".0f"), *((s, ".2f") for s in STAGES), ("what", "")],
                  note="The paper times support generation, on its authors' machine; ours is the median of three runs on this one. CPU time, because other work on the machine does not count in it; the stages are wall time.")
    for row, model, real in lab.paper_models("table5_time"):
        paper = float(row["time_s"])
        if model is None:
            table.add(row["model"], paper, *[None] * (4 + len(STAGES)), "the paper's file is missing (--models)")
            continue
        one = [Run("generate", model, (*NO_COVER, "--threads", "1"), seed) for seed in (1, 2, 3)]
        many = [Run("generate", model, NO_COVER, seed) for seed in (1, 2, 3)]
        seconds = [statistics.median(lab.values(r, path) or [0]) or None for r, path in ((one, "cpu_seconds"), (many, "seconds"))]
        table.add(model.title, paper if real else None, *seconds, paper / seconds[0] if real and seconds[0] else None,
                  max(lab.values(one, "peak_memory_mb"), default=None), *(lab.value(one[0], f"stage_seconds.{s}") for s in STAGES),
                  lab.why(one[0]) or model.origin)
    return [table]
