"""A run: model x settings x seed -> one stored result. Every kind of run is one function from a run to a dict."""
import dataclasses
import functools
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from lab.registry import HERE, ROOT, Model
from lab.store import digest, file_digest


@dataclasses.dataclass(frozen=True)
class Run:
    kind: str                # generate, carve, hollow, infill, floating, prusa, cura, own, supports_*
    model: Model
    settings: tuple = ()     # options of the program, ("--top-layers", "0", ...)
    seed: int = 1

    @property
    def name(self):
        return " ".join([self.kind, self.model.name, *self.settings, *([f"seed {self.seed}"] if self.seed != 1 else [])])


class NotHere(Exception):
    """Something is missing on this machine: no result, and nothing to keep."""


class Failed(Exception):
    """The run came to no end that says something of the model: no result, to be made again."""


# Of ribvault: an output that cannot be written, no memory or no thread left, interrupted (README.md).
NO_RESULT = {6: "exit code 6, an output could not be written", 7: "exit code 7, no memory or no thread was left", 130: "exit code 130, interrupted"}


def why_refused(code, text):
    """What a program says that took neither the model nor the options; Failed when it was ended or the system let it down."""
    if code < 0:
        raise Failed(f"ended by {signal.Signals(-code).name if -code in set(signal.Signals) else f'signal {-code}'}")
    if code in NO_RESULT:
        raise Failed(f"{NO_RESULT[code]}{': ' if text.strip() else ''}{text.strip()[-300:]}")
    return text.strip() or f"exit code {code}"


def measured(command, folder):
    """Exit code, error text, wall seconds, CPU seconds, peak MB of a program."""
    with open(folder / "stdout", "wb") as out, open(folder / "stderr", "w+b") as errors:
        start = time.monotonic()
        child = subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=out, stderr=errors)
        try:
            _, status, usage = os.wait4(child.pid, 0)
        except BaseException:  # Ctrl-C, SIGTERM: the program ends first, then its folder goes
            child.terminate()
            try:
                child.wait(5)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()
            raise
        wall = time.monotonic() - start
        errors.seek(0)
        text = errors.read().decode(errors="replace")
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, text, {"seconds": wall, "cpu_seconds": usage.ru_utime + usage.ru_stime,
                                    "peak_memory_mb": usage.ru_maxrss * 1024 / 1e6}


def program(name):
    return pathlib.Path(os.environ.get("RIBVAULT_BIN", ROOT / "build/bin")) / name


# The paper leaves its gaps at junctions whatever hangs because of them; so does every run here that does not say otherwise.
PAPERS_GAPS = ("--gaps", "paper")


def generate(run, folder):
    report = folder / "report.json"
    gaps = () if "--gaps" in run.settings or "thrifty" in run.settings else PAPERS_GAPS
    code, text, cost = measured([program("ribvault"), "generate", run.model.file, *run.model.placement, *run.settings, *gaps, "--seed",
                                 run.seed, "-o", folder / "out.gcode", "--report", report, "--quiet"], folder)
    if code not in (0, 1):
        return {"refused": why_refused(code, text)}
    full = json.loads(report.read_text())
    overhangs = full["verdict"].pop("external_overhangs")
    return {"mesh": full["input"]["mesh"], "settings": full["settings"], "totals": full["totals"],
            "verdict": {**full["verdict"], "external_layers": len(overhangs)}, "stage_seconds": full["machine"]["stage_seconds"],
            "threads": full["machine"]["threads"], **cost, "peak_memory_mb": full["machine"]["peak_memory_mb"]}


def baseline(run, folder):
    code, text, cost = measured([program("ribvault_baselines"), run.kind, run.model.file, *run.model.placement, *run.settings], folder)
    if code != 0:
        return {"refused": why_refused(code, text)}
    return {**json.loads((folder / "stdout").read_text()), **cost}


def floating(run, folder):
    code, text, cost = measured([program("ribvault_floating"), run.model.file, *run.model.placement, *run.settings], folder)
    if code != 0:
        return {"refused": why_refused(code, text)}
    return {**json.loads((folder / "stdout").read_text()), **cost}


def peer(run, folder):
    from lab import peers
    return peers.run(run, folder)


def external(run, folder):
    from lab import external
    return external.run(run, folder)


KINDS = {"generate": (generate, ["ribvault"]), "carve": (baseline, ["ribvault_baselines"]), "hollow": (baseline, ["ribvault_baselines"]),
         "infill": (baseline, ["ribvault_baselines"]), "floating": (floating, ["ribvault_floating"]),
         "prusa": (peer, ["ribvault_baselines", "prusa-slicer"]), "cura": (peer, ["ribvault_baselines", "CuraEngine"]),
         "own": (peer, ["ribvault_baselines", "ribvault"]), "supports_own": (external, ["ribvault_baselines", "ribvault"]),
         "supports_grid": (external, ["ribvault_baselines", "prusa-slicer"]), "supports_snug": (external, ["ribvault_baselines", "prusa-slicer"]),
         "supports_tree": (external, ["ribvault_baselines", "CuraEngine"])}


@functools.cache
def version(kind):
    """Hash of the programs' bytes, or None when one is missing; for peers also of the code that measures them."""
    files = []
    for name in KINDS[kind][1]:
        path = program(name) if name.startswith("ribvault") else shutil.which(name)
        if not path or not pathlib.Path(path).exists():
            return None
        files.append(path)
    if kind in ("prusa", "cura", "own"):
        files += [program("ribvault"), HERE / "lab/peers.py", HERE / "lab/sampling.py"]
    if kind.startswith("supports_"):
        files += [program("ribvault"), HERE / "lab/external.py", HERE / "lab/peers.py", HERE / "lab/sampling.py"]
    return digest([file_digest(f) for f in files])


@functools.cache
def input_digest(file):
    return file_digest(file)


FORMAT = 3  # raise it when a kind of run measures something else or more


def spec(run):
    """All that decides a result."""
    return {"format": FORMAT, "kind": run.kind, "model": run.model.name, "input": input_digest(run.model.file), "placement": list(run.model.placement),
            "settings": list(run.settings), "seed": run.seed, "version": version(run.kind)}


def execute(run, store, make=True):
    """The stored result, or a new one (`make`). A program that is not there gives a result that says so and is not stored."""
    if version(run.kind) is None:
        return {"refused": f"not on this machine: {', '.join(KINDS[run.kind][1])}"}
    wanted = spec(run)
    result = store.load(wanted)
    if result is None and not make:
        return {"refused": "not made yet"}
    if result is None:
        with tempfile.TemporaryDirectory(prefix="ribvault-run-") as scratch:
            try:
                result = KINDS[run.kind][0](run, pathlib.Path(scratch))
            except NotHere as missing:
                return {"refused": f"not on this machine: {missing}"}
        store.save(wanted, result)
    return result
