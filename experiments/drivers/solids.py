"""The built-in solids and the paper's cube: small runs that need no file; the test of the documentation reruns them."""
from lab.laboratory import ONE_COVER
from lab.runs import Run
from lab.tables import Table


def build(lab):
    table = Table("solids", "Built-in solids, one cover, seed 1",
                  [("solid", ""), ("full mm³", ".0f"), ("layers", "d"), ("material mm³", ".1f"), ("supports mm³", ".1f"), ("reduction %", ".1f"),
                   ("proved", ""), ("layers with external overhang", "d"), ("carving mm³", ".0f"), ("carving: layers refuted", "d"),
                   ("support-free mm³", ".0f"), ("support-free: layers refuted", "d")])
    for entry in lab.registry.entries["solids"]:
        if entry.get("external"):  # table 6
            continue
        model = lab.registry[entry["name"]]
        run, carve, hollow = (Run(kind, model, ONE_COVER) for kind in ("generate", "carve", "hollow"))
        full, ours = lab.value(run, "mesh.volume_mm3"), lab.value(run, "totals.material_mm3")
        table.add(model.title, full, lab.value(run, "totals.layers"), ours, lab.value(run, "totals.support_volume_mm3"),
                  100 * (1 - ours / full) if ours and full else None, lab.value(run, "verdict.proved"), lab.value(run, "verdict.external_layers"),
                  lab.value(carve, "material_mm3"), lab.value(carve, "judgement.layers_refuted"),
                  lab.value(hollow, "material_mm3"), lab.value(hollow, "judgement.layers_refuted"))
    return [table]
