"""PrusaSlicer's and CuraEngine's lightning infill, and ribvault's own G-code, measured in the same way."""
import functools
import json
import os
import subprocess

from lab import runs

CURA = "/usr/share/cura/resources"
WIDTHS = ["external-perimeter", "perimeter", "first-layer", "infill", "solid-infill", "top-infill"]
FILL = {"prusa": ("Internal infill", "Bridge infill"), "cura": ("FILL",), "own": ("SUPPORT", "Support", "FILL", "Internal infill")}


def command(kind, model, output, settings=()):
    """`settings`: "name=value", for CuraEngine only."""
    if kind == "prusa":
        widths = [x for w in WIDTHS for x in (f"--{w}-extrusion-width", "0.4")] + ["--extrusion-width", "0.4"]
        return ["prusa-slicer", "--export-gcode", model, "-o", output, "--layer-height", "0.2", "--first-layer-height", "0.2",
                "--nozzle-diameter", "0.4", "--perimeters", "1", "--top-solid-layers", "1", "--bottom-solid-layers", "1",
                "--fill-pattern", "lightning", "--fill-density", "15%", "--skirts", "0", "--filament-diameter", "1.75", *widths]
    if kind == "cura":
        common = {"infill_pattern": "lightning", "infill_line_distance": "2.6", "wall_line_count": 1, "top_layers": 1, "bottom_layers": 1, "initial_bottom_layers": 1,
                  "layer_height": 0.2, "layer_height_0": 0.2, "line_width": 0.4, "machine_nozzle_size": 0.4, "adhesion_type": "none",
                  "skirt_line_count": 0, "machine_width": 250, "machine_depth": 250, "machine_height": 250,
                  "machine_center_is_zero": "false", "center_object": "false"}
        return ["CuraEngine", "slice", "-j", f"{CURA}/definitions/fdmprinter.def.json",
                *(x for k, v in common.items() for x in ("-s", f"{k}={v}")), *(x for s in settings for x in ("-s", s)), "-o", output, "-e0", "-s", "material_diameter=1.75", "-l", model]
    return [runs.program("ribvault"), "generate", model, "-o", output, "--quiet"]


@functools.cache
def can_verify():
    """Whether this ribvault proves or refutes G-code of other programs."""
    done = subprocess.run([runs.program("ribvault"), "verify", "--help"], capture_output=True, text=True)
    return done.returncode == 0 and "--report" in done.stdout


def verify(gcode, model, folder, rules=()):
    """What `ribvault verify` says, or why it does not."""
    if not can_verify():
        return {"missing": "this ribvault has no verify command"}
    report = folder / "verify.json"
    code, text, cost = runs.measured([runs.program("ribvault"), "verify", gcode, *rules, "--report", report], folder)
    if not report.exists():
        return {"missing": runs.why_refused(code, text)}
    return {"exit_code": code, **cost, "report": {k: v for k, v in json.loads(report.read_text()).items() if k != "layers"}}


def run(run, folder):
    try:
        from lab import sampling
    except ImportError as missing:
        raise runs.NotHere(f"{missing.name} (python3-numpy, python3-scipy)") from None
    placed, gcode = folder / "placed.stl", folder / "out.gcode"
    code, text, _ = runs.measured([runs.program("ribvault_baselines"), "place", run.model.file, *run.model.placement, "-o", placed], folder)
    if code != 0:
        return {"refused": runs.why_refused(code, text)}
    os.environ["CURA_ENGINE_SEARCH_PATH"] = f"{CURA}/definitions:{CURA}/extruders"
    code, text, cost = runs.measured(command(run.kind, placed, gcode, run.settings), folder)
    if code not in (0, 1) or not gcode.exists():
        return {"refused": f"exit code {code}: {runs.why_refused(code, text)[-300:]}"}
    layers, volume, travels = sampling.read_gcode(gcode)
    internal, external = sampling.unsupported(layers, sampling.read_stl(placed))
    return {"material_mm3": sum(volume.values()), "infill_mm3": sum(v for k, v in volume.items() if k in FILL[run.kind]),
            "by_type_mm3": volume, "travels": travels, "layers": len(layers), "sampled_internal_mm": internal, "sampled_external_mm": external,
            "verify": verify(gcode, placed, folder), **cost}
