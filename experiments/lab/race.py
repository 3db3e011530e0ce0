"""Programs run in turn on the same files: wall time, CPU time and peak memory of whole processes, medians and ratios."""
import dataclasses
import os
import pathlib
import platform
import re
import statistics
import subprocess
import tempfile
import time

from lab import peers, runs

MEASURES = ("seconds", "cpu_seconds", "peak_memory_mb")
TITLES = {"own": "ribvault", "prusa": "PrusaSlicer", "cura": "CuraEngine"}


@dataclasses.dataclass(frozen=True)
class Entry:
    """One program with its options on one file."""
    name: str
    kind: str            # own, prusa, cura
    file: pathlib.Path
    options: tuple = ()

    def command(self, output):
        return [*peers.command(self.kind, self.file, output), *self.options]


def placed(model, folder):
    """The model as binary STL where the programs will print it: the same bytes for all of them."""
    path = pathlib.Path(folder) / f"{model.name}.stl"
    done = subprocess.run([runs.program("ribvault_baselines"), "place", model.file, *map(str, model.placement), "-o", path],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{model.title}: {done.stderr.strip()}")
    return path


def measure(entry):
    """Costs of one run; `proved` where the program says it (ribvault: exit code 0)."""
    os.environ["CURA_ENGINE_SEARCH_PATH"] = f"{peers.CURA}/definitions:{peers.CURA}/extruders"
    with tempfile.TemporaryDirectory(prefix="ribvault-benchmark-") as scratch:
        folder = pathlib.Path(scratch)
        output = folder / "out.gcode"
        # wait4 says the memory of the process that started the program when that is more; `time` is small.
        timed = ["/usr/bin/time", "-q", "-f", "%M", "-o", folder / "peak"] if os.access("/usr/bin/time", os.X_OK) else []
        code, text, cost = runs.measured([*timed, *entry.command(output)], folder)
        if code not in ((0, 1) if entry.kind == "own" else (0,)) or not output.exists():
            raise SystemExit(f"{TITLES[entry.kind]} on {entry.file}: exit code {code}: {text.strip()[-300:]}")
        if timed:
            cost["peak_memory_mb"] = int((folder / "peak").read_text()) * 1024 / 1e6
    return {**cost, "proved": code == 0} if entry.kind == "own" else cost


def race(entries, rounds, progress=lambda entry: None):
    """Every entry once a round, in turn, so that what else the machine does meets all alike. Entry -> list of costs."""
    results = {entry: [] for entry in entries}
    for _ in range(rounds):
        for entry in entries:
            progress(entry)
            results[entry].append(measure(entry))
    return results


def summary(costs):
    """Medians, the least and the greatest of each measure, and every round."""
    result = {m: {"median": statistics.median(c[m] for c in costs), "least": min(c[m] for c in costs), "greatest": max(c[m] for c in costs)} for m in MEASURES}
    if "proved" in costs[0]:
        result["proved"] = all(c["proved"] for c in costs)
    return {**result, "rounds": costs}


def ratios(own, other):
    """Ours over the other's, of medians."""
    return {m: own[m]["median"] / other[m]["median"] for m in MEASURES}


def versions(kinds):
    """The first line with a version that each program says of itself."""
    asked = {"own": [runs.program("ribvault"), "--version"], "prusa": ["prusa-slicer", "--help"], "cura": ["CuraEngine"]}
    found = {}
    for kind in kinds:
        done = subprocess.run([str(c) for c in asked[kind]], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        lines = [line.strip() for line in done.stdout.splitlines() if re.search(r"\d\.\d+\.\d", line) and not line.startswith("[")]
        found[TITLES[kind]] = lines[0] if lines else ""
    return found


def machine():
    """What the numbers were taken on, and how busy it was before."""
    names = [line.partition(":")[2].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    commit = subprocess.run(["git", "-C", str(runs.ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True)
    return {"processor": names[0] if names else platform.processor(), "processors": os.cpu_count(), "system": platform.platform(),
            "load_before": os.getloadavg()[0], "commit": commit.stdout.strip(), "time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
