"""What a driver sees: models, results of runs, the paper's rows. The same driver plans (which runs?) and tabulates."""
import dataclasses
import sys

from lab.registry import Registry, paper_rows
from lab.runs import Failed, Run, execute, program
from lab.store import Store

NO_COVER = ("--top-layers", "0", "--bottom-layers", "0")
ONE_COVER = ("--top-layers", "1", "--bottom-layers", "1")


@dataclasses.dataclass
class Plot:
    name: str
    title: str
    x: str
    y: str
    series: dict          # label -> [(x, y), ...]
    log: bool = False


class Laboratory:
    def __init__(self, results, models=None, seeds=5, sweeps=(), make=True):
        """`make`: runs whose results are not stored are made when a driver asks for them."""
        self.store = Store(results / "runs")
        self.registry = Registry(results / "models", models, program("ribvault_baselines"))
        self.seeds, self.sweeps = range(1, seeds + 1), list(sweeps)
        self.make, self.failed = make, {}  # failed: run -> why it has no result; not made again by the same laboratory
        self.planned = None  # a dict while a driver is only asked which runs it needs

    def plan(self, build):
        """The runs of a driver, each once, in its order."""
        self.planned = {}
        try:
            build(self)
            return list(self.planned)
        finally:
            self.planned = None

    def result(self, run):
        if self.planned is not None:
            self.planned[run] = None
            return {}
        if run not in self.failed:
            try:
                return execute(run, self.store, self.make)
            except Failed as failure:
                self.failed[run] = str(failure)
                print(f"\n{run.name}: {failure}; no result, the run is made again next time", file=sys.stderr)
        return {"refused": self.failed[run]}

    def value(self, run, path):
        """A number of the result by its path ("totals.material_mm3"), or None."""
        part = self.result(run)
        for key in path.split("."):
            part = part.get(key) if isinstance(part, dict) else None
        return part

    def values(self, runs, path):
        return [v for v in (self.value(r, path) for r in runs) if v is not None]

    def proved(self, runs):
        """Whether every one is proved; None when there are none."""
        verdicts = self.values(runs, "verdict.proved")
        return all(verdicts) if verdicts else None

    def over_seeds(self, model, *settings, kind="generate"):
        return [Run(kind, model, settings, seed) for seed in self.seeds]

    def why(self, run):
        """Why a run has no numbers, or nothing."""
        return self.result(run).get("refused")

    def paper_models(self, table, column="model"):
        """(row of the paper, model or None, is it the paper's?) and, where the file is missing, a second entry with a stand-in."""
        for row in paper_rows(table):
            model = self.registry.by_row(table.split("_")[0], row[column])
            real = model.origin.startswith("the paper's")
            yield row, model if real else None, real
            other = model if model.file and not real else self.registry.or_stand_in(model) if not real else None
            if other:
                yield row, other, False

    def covers(self, model):
        """Section 5 says "no cover"; the cube without covers is an open box, its published volume has one at top and bottom."""
        return ONE_COVER if model.name in ("cube", "cube20") else NO_COVER
