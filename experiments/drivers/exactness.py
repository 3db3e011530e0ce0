"""Equation (2) on every layer of every run above, which stage of the predicates decided, and the same checks in doubles."""
import importlib

from drivers import NAMES
from lab.runs import Run
from lab.tables import Table


def build(lab):
    stages = ["interval", "rational", "algebraic"]
    table = Table("exactness", "Every layer of every run of ribvault in the experiments above",
                  [("experiment", ""), ("runs", "d"), ("refused", "d"), ("layers", "d"), ("proved", "d"), ("refuted", "d"), ("with external overhang", "d"),
                   *((f"decided by {s}", "d") for s in stages), ("what", "")])
    seen = set()
    for name in [n for n in NAMES if n not in ("exactness", "solids")] + ["solids"]:
        all_runs = [r for r in wanted(lab, name) if r.kind == "generate"]
        runs = [r for r in all_runs if r not in seen]
        seen.update(runs)
        layers, proved = (sum(lab.values(runs, p)) for p in ("totals.layers", "verdict.layers_proved"))
        table.add(name, len(runs), sum(1 for r in runs if lab.why(r)), layers, proved, layers - proved, sum(lab.values(runs, "verdict.external_layers")),
                  *(sum(lab.values(runs, f"verdict.stages.{s}")) for s in stages),
                  "" if all_runs else "G-code of several programs, judged by `ribvault verify`: its own table")
    table.add("all", *(sum(row[k] for row in table.rows) for k in range(1, len(table.columns) - 1)))

    doubles = Table("exactness_doubles", "The same checks in doubles: layers as generated, and 10 nm on either side of the threshold",
                    [("model", ""), ("layers", "d"), ("false alarms", "d"), ("missed", "d"), ("thresholds tried", "d"), ("false alarms there", "d"),
                     ("missed there", "d"), ("lost their way", "d"), ("what", "")])
    for name in ("cube", "sphere", "cone", "low_roof", "slope45", "bunny", "moai", "kitten", "bunny00"):
        model = lab.registry[name]
        if not model.file:
            doubles.add(model.title, *[None] * 7, "the file is missing (--models)")
            continue
        run = Run("floating", model)
        doubles.add(model.title, *(lab.value(run, p) for p in ("layers", "false_alarms", "missed", "thresholds", "threshold_false_alarms",
                                                               "threshold_missed", "errors")), lab.why(run) or model.origin)
    return [table, doubles]


def wanted(lab, name):
    """The runs of another driver. While planning, they are planned here too."""
    outer, build = lab.planned, importlib.import_module(f"drivers.{name}").build
    runs = lab.plan(build)
    lab.planned = outer
    if outer is not None:
        outer.update(dict.fromkeys(r for r in runs if r.kind == "generate"))
    return runs
