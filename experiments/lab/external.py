"""External supports of slicers and ribvault's own on the same placed file at the same limit, each with and without supports, judged by
`ribvault verify`, as they are and by the rules of the gaps that they leave. Kinds: supports_own, supports_grid and supports_snug (PrusaSlicer), supports_tree (CuraEngine)."""
import os
import re

from lab import peers, runs

SUPPORT_TYPES = ("Support material", "Support material interface", "SUPPORT", "SUPPORT-INTERFACE")
# Distances that the slicers leave by default (measured in plane from 0.4 mm tracks), as rules of `ribvault verify`.
GAPS = {"supports_grid": ("--support-gap", "0.25", "--support-gap-layers", "1"), "supports_snug": ("--support-gap", "0.25", "--support-gap-layers", "1"),
        "supports_tree": ("--support-gap", "0.7", "--support-gap-layers", "1")}
STYLES = {"supports_grid": "grid", "supports_snug": "snug"}


def command(kind, model, output, supported, settings):
    if kind == "supports_own":
        return [runs.program("ribvault"), "generate", model, "-o", output, "--quiet", "--support", "both" if supported else "internal", *(settings if supported else ())]
    if kind in STYLES:
        # 45 degrees: rho = h, the limit that equation (2) sets here
        more = ["--support-material", "--support-material-auto", "--support-material-threshold", "45", "--support-material-style", STYLES[kind]]
        return [*peers.command("prusa", model, output), "--center", "125,125", *(more if supported else ())]
    more = ["-s", "support_enable=true", "-s", "support_structure=tree", "-s", "support_type=everywhere", "-s", "support_angle=45"]
    plain = peers.command("cura", model, output)
    at = plain.index("-o")
    return [*plain[:at], *(more if supported else ()), *plain[at:]]


def print_seconds(gcode):
    """As the program that wrote the file estimates it, or None."""
    text = gcode.read_text(errors="replace")
    if found := re.search(r"^; estimated printing time \(normal mode\) = (.*)$", text, re.M):
        return sum(int(n) * {"d": 86400, "h": 3600, "m": 60, "s": 1}[unit] for n, unit in re.findall(r"(\d+)([dhms])", found[1]))
    if found := re.search(r"^;TIME:(\d+)", text, re.M):
        return int(found[1])
    return None


def run(run, folder):
    try:
        from lab import sampling
    except ImportError as missing:
        raise runs.NotHere(f"{missing.name} (python3-numpy, python3-scipy)") from None
    placed = folder / "placed.stl"
    code, text, _ = runs.measured([runs.program("ribvault_baselines"), "place", run.model.file, *run.model.placement, "-o", placed], folder)
    if code != 0:
        return {"refused": runs.why_refused(code, text)}
    os.environ["CURA_ENGINE_SEARCH_PATH"] = f"{peers.CURA}/definitions:{peers.CURA}/extruders"
    result = {}
    for supported in (False, True):
        gcode = folder / f"{supported}.gcode"
        code, text, cost = runs.measured(command(run.kind, placed, gcode, supported, run.settings), folder)
        if code not in (0, 1) or not gcode.exists():
            return {"refused": f"exit code {code}: {runs.why_refused(code, text)[-300:]}"}
        _, volume, _ = sampling.read_gcode(gcode)
        name = "supported" if supported else "plain"
        result[name] = {"support_mm3": sum(volume.get(t, 0) for t in SUPPORT_TYPES), "print_seconds": print_seconds(gcode), **cost}
    result["verify"] = peers.verify(gcode, placed, folder)
    result["verify_gaps"] = peers.verify(gcode, placed, folder, GAPS.get(run.kind, run.settings))
    return result
