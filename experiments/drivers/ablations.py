"""Any setting swept: one table and one plot each. From the command line: --sweep OPTION=VALUE,VALUE,..."""
from lab.laboratory import ONE_COVER, Plot
from lab.runs import Run
from lab.tables import Table, mean, spread

SWEEPS = {  # option of `ribvault generate`: values
    "overlap": ["0.3", "0.4", "0.5", "0.6", "0.7"],
    "erosion-step": ["0.05", "0.1", "0.15", "0.2"],
    "branch-bonus": ["0", "0.4", "0.8", "1.6", "3.2"],
    "valence-limit": ["1", "2", "3", "4", "5", "8"],
    "layer-height": ["0.05", "0.1", "0.2", "0.3"],
    "nozzle": ["0.25", "0.4", "0.6", "0.8"],
    "seed": [str(k) for k in range(1, 11)],
}
MODELS = ["cube", "bunny", "bunny00"]


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def build(lab):
    sweeps = dict(s.split("=", 1) for s in lab.sweeps) or SWEEPS
    return [part for option, values in sweeps.items()
            for part in sweep(lab, option, values.split(",") if isinstance(values, str) else values)]


def sweep(lab, option, values):
    table = Table(f"ablation_{option}", f"--{option}, one cover",
                  [("model", ""), (option, ""), ("material mm³", ""), ("supports mm³", ""), ("CPU s", ".2f"), ("proved", ""), ("what", "")])
    series = {}
    for name in MODELS:
        model = lab.registry[name]
        if not model.file:
            table.add(model.title, *[None] * 5, "the file is missing (--models)")
            continue
        for value in values:
            # a seed swept is a seed, not three
            if option == "seed":
                runs = [Run("generate", model, ONE_COVER, int(value))]
            else:
                runs = lab.over_seeds(model, *ONE_COVER, f"--{option}", value)[:3]
            supports = lab.values(runs, "totals.support_volume_mm3")
            table.add(model.title, value, spread(lab.values(runs, "totals.material_mm3")), spread(supports), mean(lab.values(runs, "cpu_seconds")),
                      lab.proved(runs), lab.why(runs[0]) or model.origin)
            if supports:
                series.setdefault(model.title, []).append((value, mean(supports)))
    if all(is_number(value) for value in values):
        series = {label: [(float(value), y) for value, y in points] for label, points in series.items()}
    return [table, Plot(table.name, f"Supports against --{option}", option, "supports in mm³", series)]
