"""The run page in a browser: what it shows is what the report says. PROGRAM from RIBVAULT; screenshots go to the folder SCREENSHOTS."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import browser
from runs import CUBE, PROGRAM, generate, make_page

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "experiments"))
from make_solids import box, write_stl  # noqa: E402

CORPUS = ROOT / "tests/corpus/gcode"
SCREENSHOTS = pathlib.Path(os.environ.get("SCREENSHOTS", "screenshots"))
FOUND = browser.find()

# Of every visible element with text of its own: the text, and the contrast of its colour with what it stands on (WCAG 2.2).
CONTRASTS = """(() => {
  const parts = c => { const m = c.match(/[\\d.]+/g).map(Number); return { rgb: m.slice(0, 3), alpha: m.length > 3 ? m[3] : 1 }; };
  const light = rgb => { const [r, g, b] = rgb.map(v => { v /= 255; return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const out = [];
  for (const e of document.querySelectorAll("body *")) {
    if (["SCRIPT", "STYLE", "OPTION", "NOSCRIPT"].includes(e.tagName) || !e.checkVisibility() || e.disabled) continue;
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim())) continue;
    let under = e, back;
    do { back = parts(getComputedStyle(under).backgroundColor); under = under.parentElement; } while (back.alpha < 1 && under);
    const [a, b] = [light(parts(getComputedStyle(e).color).rgb), light(back.rgb)].sort((p, q) => q - p);
    out.push([e.textContent.trim().slice(0, 40), (a + 0.05) / (b + 0.05)]);
  }
  return out;
})()"""

# Colours in the picture of a canvas that are not its corner's: how many points of a grid have one.
DRAWN = """(canvas => { page.models.forEach(m => m.render());
  const c = document.createElement("canvas"); c.width = c.height = 100; const g = c.getContext("2d"); g.drawImage(canvas, 0, 0, 100, 100);
  const d = g.getImageData(0, 0, 100, 100).data; let n = 0;
  for (let k = 4; k < d.length; k += 4) n += d[k] !== d[0] || d[k + 1] !== d[1] || d[k + 2] !== d[2];
  return n; })"""


def contrast(a, b):
    """Of two colours #rrggbb or #rgb, by WCAG 2.2."""
    def light(colour):
        digits = colour[1:] if len(colour) == 7 else "".join(2 * c for c in colour[1:])
        parts = [int(digits[k:k + 2], 16) / 255 for k in (0, 2, 4)]
        return sum(w * (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4) for w, v in zip((0.2126, 0.7152, 0.0722), parts))
    low, high = sorted((light(a), light(b)))
    return (high + 0.05) / (low + 0.05)


class Pages(unittest.TestCase):
    """One folder with runs of the cube, and one browser, for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        generate(cls.folder, CUBE, "--layers", "a.layers", "--html", "a.html", "--report", "a.json", "-o", "a.gcode")
        generate(cls.folder, CUBE, "--no-straighten", "--layers", "b.layers", "--report", "b.json")
        cls.report = json.loads((cls.folder / "a.json").read_text())
        cls.shapes = [json.loads(line) for line in (cls.folder / "a.layers").read_text().splitlines()[1:]]
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        cls.browser = browser.Browser(FOUND)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.scratch.cleanup()

    def setUp(self):
        self.browser.resize(1280, 900)
        self.browser.dark(False)

    def open(self, name, fragment=""):
        self.browser.open(self.folder / name, fragment)
        # Software rendering warns of its own slowness.
        errors = [text for text in self.browser.console if "GL Driver Message" not in text]
        self.assertEqual(errors, [])
        self.assertEqual(len(self.browser.requests), 1, self.browser.requests)

    def at_end(self):
        self.assertEqual([text for text in self.browser.console if "GL Driver Message" not in text], [])

    def colour(self, name):
        return self.browser.run(f"colours()('{name}')")

    def text(self, selector):
        return self.browser.run(f"document.querySelector({json.dumps(selector)}).textContent")

    def figures(self, table, run=0):
        return self.browser.run(f"Object.fromEntries([...document.querySelectorAll('#{table} [data-run=\"{run}\"]')].map(e => [e.dataset.figure, e.textContent]))")

    def slide(self, layer):
        """Moves the slider as a hand does."""
        self.browser.run(f"(() => {{ const s = document.getElementById('slider'); s.value = {layer}; s.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()")

    def shown(self):
        return self.browser.run("[+document.getElementById('slider').value, +document.getElementById('number').value]")

    def check_layer(self, k, report, shapes, run=0):
        layer, figures = report["layers"][k], self.figures("layer-figures", run)
        for name, digits in {"support_length_mm": 3, "support_printed_length_mm": 3, "support_volume_mm3": 3, "shell_volume_mm3": 3, "extruded_mm3": 3, "trees": 0, "gaps": 0,
                             "closed_gaps": 0, "patches": 0, "filament_mm": 3, "print_seconds": 1}.items():
            self.assertAlmostEqual(float(figures[name]), layer[name], delta=0.5000001 * 10 ** -digits, msg=f"{name} of layer {k}")
        valence = [0] * len(shapes[k]["vertices"])
        for edge in shapes[k]["edges"]:
            for vertex in edge:
                valence[vertex] += 1
        root = set(shapes[k]["roots"])
        self.assertEqual(int(figures["roots"]), sum(v in root and n > 0 for v, n in enumerate(valence)))
        self.assertEqual(int(figures["junctions"]), sum(n >= 3 for n in valence))
        self.assertEqual(int(figures["tips"]), sum(v not in root and n == 1 for v, n in enumerate(valence)))

    def test_the_numbers_are_the_reports(self):
        self.open("a.html")
        for k in (0, 1, 50, 90, 97, 98, 99):
            self.slide(k)
            self.check_layer(k, self.report, self.shapes)
            self.assertEqual(self.shown(), [k, k])
            layer = self.report["layers"][k]
            verdict = "on the bed" if k == 0 else "proved" if layer["verdict"]["supported"] and layer["print"]["supported"] else "not proved"
            self.assertTrue(self.text("#caption").startswith(f"Layer {k}, z "), self.text("#caption"))
            self.assertTrue(self.text("#caption").endswith(": " + verdict), self.text("#caption"))
            self.assertIn(f"{layer['trees']} support tree" if layer["trees"] else "No supports", self.text("#said"))
        totals, shown = self.report["totals"], self.figures("run-figures")
        for name, digits in {"layers": 0, "material_mm3": 1, "shell_volume_mm3": 1, "support_volume_mm3": 1, "support_printed_length_mm": 0}.items():
            self.assertAlmostEqual(float(shown[name]), totals[name], delta=0.5000001 * 10 ** -digits, msg=name)
        self.assertIn("Proved: every point of all 100 layers", self.text("header"))
        self.at_end()

    def test_an_unproved_layer_is_named(self):
        lines = (self.folder / "a.layers").read_text().splitlines()
        layer = json.loads(lines[61])
        layer["verdict"]["supported"] = False
        layer["verdict"]["internal"] = {"area_mm2": [0.25, 0.5], "witness_mm": [125, 125], "witness_certified": True, "witness_distance_mm": 0.3}
        header = json.loads(lines[0])
        header["verdict"]["proved"], header["verdict"]["layers_refuted"] = False, [60]
        (self.folder / "bad.layers").write_text("\n".join([json.dumps(header), *lines[1:61], json.dumps(layer), *lines[62:]]) + "\n")
        self.assertEqual(make_page(self.folder, "bad.layers", "-o", "bad.html").returncode, 0)
        self.open("bad.html", "#layer=10")
        self.assertIn("Not proved on 1 of 100 layers", self.text("header"))
        self.browser.key("n")
        self.assertEqual(self.shown(), [60, 60])
        self.assertIn("not proved", self.text("#caption"))
        self.assertIn("0.25 to 0.50 mm²", self.text("#places"))
        self.browser.run("document.querySelector('#places button').click()")
        self.browser.screenshot(SCREENSHOTS / "unproved.png")
        self.at_end()

    def test_what_begins_in_the_air_over_narrow_places_is_said(self):
        lines = (self.folder / "a.layers").read_text().splitlines()
        header = json.loads(lines[0])
        header["verdict"]["print"]["layers_over_narrow_places"] = [60]
        (self.folder / "narrow.layers").write_text("\n".join([json.dumps(header), *lines[1:]]) + "\n")
        self.assertEqual(make_page(self.folder, "narrow.layers", "-o", "narrow.html").returncode, 0)
        self.open("narrow.html", "#layer=60")
        self.assertIn("as geometry and as printed, but not over places too narrow to print.", self.text("header"))
        self.assertIn("proved, but begins in the air", self.text("#caption"))
        self.open("narrow.html", "#layer=61")
        self.assertTrue(self.text("#caption").endswith(": proved"), self.text("#caption"))
        self.at_end()

    def test_pictures_are_drawn(self):
        self.open("a.html", "#layer=97")
        self.browser.settle()
        for name, least in {"model": 500, "drawing": 500}.items():
            self.assertGreater(self.browser.run(f"{DRAWN}(document.querySelector('canvas.{name}'))"), least, name)
        for canvas in ("#charts figure:nth-child(1) canvas", "#charts figure:nth-child(2) canvas"):
            self.assertGreater(self.browser.run(f"{DRAWN}(document.querySelector('{canvas}'))"), 100, canvas)
        whole = self.browser.run(f"(() => {{ const m = page.models[0]; m.cut = 'whole'; m.show(); return {DRAWN}(m.canvas); }})()")
        hidden = self.browser.run(f"(() => {{ const m = page.models[0]; m.cut = 'hidden'; m.show(); return {DRAWN}(m.canvas); }})()")
        self.assertGreater(whole, hidden)
        self.at_end()

    def test_keys_links_and_play(self):
        self.open("a.html", "#layer=57")
        self.assertEqual(self.shown(), [57, 57])
        for key, layer in {"ArrowRight": 58, "ArrowUp": 59, "ArrowLeft": 58, "ArrowDown": 57, "PageUp": 67, "PageDown": 57, "Home": 0, "End": 99}.items():
            self.browser.key(key)
            self.assertEqual(self.shown(), [layer, layer], key)
        self.browser.run("new Promise(done => setTimeout(done, 250))")
        self.assertEqual(self.browser.run("location.hash"), "#layer=99")
        self.browser.run("location.hash = '#layer=12'; new Promise(done => setTimeout(done, 50))")
        self.assertEqual(self.shown(), [12, 12])
        self.browser.run("document.querySelector('#links a').click(); new Promise(done => setTimeout(done, 50))")
        most = max(self.report["layers"], key=lambda layer: layer["support_length_mm"])["layer"]
        self.assertEqual(self.shown(), [most, most])
        self.slide(25)
        self.browser.run("document.activeElement.blur()")
        self.browser.key(" ", " ")
        self.browser.run("new Promise(done => { const wait = () => document.getElementById('slider').value === '0' ? done() : setTimeout(wait, 50); wait(); })")
        self.assertEqual(self.text("#play span"), "Play down")
        self.check_layer(0, self.report, self.shapes)
        self.assertEqual(self.browser.run("document.querySelectorAll('select')[1].value"), "peel")
        self.at_end()

    def test_light_dark_and_phone(self):
        for name in ("a.html", "two.html"):
            if name == "two.html":
                self.assertEqual(make_page(self.folder, "a.layers", "a.gcode", "-o", "two.html").returncode, 0)
            self.open(name, "#layer=96")
            for width, height, mobile in ((1280, 900, False), (390, 844, True)):
                self.browser.resize(width, height, mobile)
                self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
                for dark in (False, True):
                    self.browser.dark(dark)
                    self.browser.screenshot(SCREENSHOTS / f"{name[:-5]}_{width}_{'dark' if dark else 'light'}.png")
                    contrasts = self.browser.run(CONTRASTS)
                    self.assertGreater(len(contrasts), 40)
                    self.assertEqual([c for c in contrasts if c[1] < 4.5], [])
                    paper = self.colour("paper")
                    for mark in ("edge", "line", "root", "junction", "tip", "dot", "hang", "bridge", "patch", "second", "focus"):
                        self.assertGreaterEqual(contrast(self.colour(mark), paper), 3, mark)
            self.at_end()

    def test_pictures_are_said_in_words(self):
        self.open("a.html", "#layer=97")
        labels = self.browser.run("[...document.querySelectorAll('canvas')].map(c => [c.getAttribute('role'), c.getAttribute('aria-label')])")
        self.assertEqual(len(labels), 4)
        for role, label in labels:
            self.assertEqual(role, "img")
            self.assertGreater(len(label), 60)
        drawing = self.browser.run("document.querySelector('canvas.drawing').getAttribute('aria-label')")
        self.assertIn("layer 97", drawing)
        self.assertIn(self.text("#said"), drawing)
        self.assertEqual(self.browser.run("document.getElementById('said').getAttribute('aria-live')"), "polite")
        self.assertIn("Layer 97", self.browser.run("document.getElementById('slider').getAttribute('aria-valuetext')"))
        nameless = self.browser.run("[...document.querySelectorAll('button, select, input')].filter(e => !(e.textContent.trim() || e.getAttribute('aria-label') || e.labels?.length)).length")
        self.assertEqual(nameless, 0)

    def test_two_runs_on_one_slider(self):
        self.assertEqual(make_page(self.folder, "a.layers", "b.layers", "-o", "ab.html").returncode, 0)
        other = json.loads((self.folder / "b.json").read_text())
        shapes = [json.loads(line) for line in (self.folder / "b.layers").read_text().splitlines()[1:]]
        self.open("ab.html")
        for k in (97, 60):
            self.slide(k)
            self.check_layer(k, self.report, self.shapes, 0)
            self.check_layer(k, other, shapes, 1)
        self.browser.screenshot(SCREENSHOTS / "straightened_or_not.png")
        a, b = (r["totals"]["support_printed_length_mm"] for r in (self.report, other))
        row = self.browser.run("document.querySelector('#run-figures [data-figure=support_printed_length_mm]').parentElement.lastChild.textContent")
        self.assertEqual(row, f"{100 * (b / a - 1):+.1f} %")
        self.at_end()

    def test_layers_of_two_heights_are_matched_by_z(self):
        generate(self.folder, CUBE, "--layer-height", "0.3", "--layers", "thick.layers", "--report", "thick.json")
        self.assertEqual(make_page(self.folder, "thick.layers", "a.layers", "-o", "heights.html").returncode, 0)
        thick = json.loads((self.folder / "thick.json").read_text())["layers"]
        self.open("heights.html")
        for k in (0, 7, 50, 99):
            self.slide(k)
            z = 0.2 * k + 0.1
            match = next(layer for layer in thick if abs(layer["z_mm"] - z) <= 0.15)
            self.assertAlmostEqual(float(self.figures("layer-figures", 0)["shell_volume_mm3"]), match["shell_volume_mm3"], delta=0.001)
            self.assertAlmostEqual(float(self.figures("layer-figures", 1)["shell_volume_mm3"]), self.report["layers"][k]["shell_volume_mm3"], delta=0.001)
        self.at_end()

    def test_a_run_without_supports(self):
        generate(self.folder, CUBE, "--top-layers", "0", "--bottom-layers", "0", "--html", "open.html", "--report", "open.json")
        self.open("open.html", "#layer=50")
        self.assertEqual(self.figures("layer-figures")["trees"], "0")
        self.assertIn("No supports on this layer", self.text("#said"))
        self.browser.settle()
        self.at_end()

    def test_walls_of_several_tracks_are_drawn_wide(self):
        generate(self.folder, CUBE, "--wall-lines", "2", "--wall-lines-longer", "3", "--layers", "wide.layers", "--html", "wide.html")
        header, *layers = map(json.loads, (self.folder / "wide.layers").read_text().splitlines())
        # The same file without what is new in it, as programs before --wall-lines wrote it.
        old = [{name: value for name, value in layer.items() if name not in ("wide", "wide_trees")} for layer in layers]
        del header["settings"]["wall_lines"]
        (self.folder / "old.layers").write_text("".join(json.dumps(line) + "\n" for line in (header, *old)))
        self.assertEqual(make_page(self.folder, "old.layers", "-o", "old.html").returncode, 0)

        def longest(layer):
            """Length and ends of the longest piece of wide wall."""
            at, wide = layer["vertices"], set(layer.get("wide", []))
            return max([(math.dist(at[v], at[w]), at[v], at[w]) for v, w in layer["edges"] if v in wide] or [(0, None, None)])

        k = max((k for k, layer in enumerate(layers) if not layer["unsupported"]), key=lambda k: longest(layers[k])[0])
        length, a, b = longest(layers[k])
        self.assertGreater(length, 2)
        middle, aside = [(p + q) / 2 for p, q in zip(a, b)], [(a[1] - b[1]) / length, (b[0] - a[0]) / length]
        pixels = f"""(() => {{ const v = page.drawings[0], [x, y] = {middle}, [dx, dy] = {aside};
          v.go(x, y); v.marked = null; v.paint();
          const [ox, oy] = v.origin(), s = v.scale, r = v.canvas.width / v.canvas.clientWidth, g = v.canvas.getContext("2d");
          const picture = g.getImageData(0, 0, v.canvas.width, v.canvas.height), at = (px, py) => 4 * (Math.round(r * py) * picture.width + Math.round(r * px));
          const pixel = (px, py) => [...picture.data.slice(at(px, py), at(px, py) + 3)];
          return [0.12, 0.3, 0.5].map(d => pixel(ox + s * (x + d * dx), oy - s * (y + d * dy))); }})()"""
        for name, wide in (("wide.html", set(layers[k]["wide"])), ("old.html", set())):
            self.open(name, f"#layer={k}")
            self.assertEqual(self.browser.run(f"[...page.runs[0].shapes({k}).wide].flatMap((w, v) => w ? [v] : [])"), sorted(wide), name)
            near, beside, off = self.browser.run(pixels)
            self.assertEqual(beside, near if wide else off, name)
            self.assertNotEqual(near, off, name)
            self.assertEqual(0.8 in self.browser.run(f"partsOf(page.runs[0], {k}).walls.map(w => w.width)"), bool(wide), name)
            self.assertEqual("of them 0.8 mm wide" in self.text("#said"), bool(wide), name)
            self.browser.screenshot(SCREENSHOTS / (name[:-5] + "_walls.png"))
            self.at_end()

    def test_what_overhangs_outside_is_drawn(self):
        """A plate of 20 x 20 mm on a block of 12 x 12 mm: a rim of 4 mm hangs, but for what is within rho of the block."""
        corners = [(x, y, z) for lo, hi, bottom, top in ((4, 16, 0, 5), (0, 20, 5, 10)) for z in (bottom, top) for x, y in ((lo, lo), (hi, lo), (hi, hi), (lo, hi))]
        faces = [[8 * k + v for v in f] for k in (0, 1) for f in ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))]
        (self.folder / "mushroom.off").write_text("OFF\n16 12 0\n" + "".join("%d %d %d\n" % c for c in corners) + "".join("4 %d %d %d %d\n" % tuple(f) for f in faces))
        pixels = """(places => { const v = page.drawings[0], [x0, y0, x1, y1] = page.runs[0].box;
          const [ox, oy] = v.origin(), s = v.scale, r = v.canvas.width / v.canvas.clientWidth, g = v.canvas.getContext("2d");
          const picture = g.getImageData(0, 0, v.canvas.width, v.canvas.height);
          return places.map(([x, y]) => [Math.round(r * (ox + s * ((x0 + x1) / 2 + x))), Math.round(r * (oy - s * ((y0 + y1) / 2 + y)))])
            .map(([px, py]) => [...picture.data.slice(4 * (py * picture.width + px), 4 * (py * picture.width + px) + 3)]); })"""
        for name, options, drawn in (("hollow.html", (), True), ("solid.html", ("--support", "external"), False)):
            generate(self.folder, "mushroom.off", *options, "--html", name)
            self.open(name, "#layer=25")
            rim, near, inside = self.browser.run(pixels + "([[8, 3], [6.1, 3], [0, 3]])")
            colour = self.browser.run("colours()('overhang')")
            self.assertEqual("#%02x%02x%02x" % tuple(rim) == colour, drawn, name)
            self.assertNotEqual("#%02x%02x%02x" % tuple(near), colour, name)
            self.assertNotEqual("#%02x%02x%02x" % tuple(inside), colour, name)
            self.assertEqual("overhangs outside" in self.text(".legend"), drawn, name)
            self.browser.screenshot(SCREENSHOTS / (name[:-5] + "_overhang.png"))
            self.at_end()
            self.open(name, "#layer=26")
            self.assertNotEqual("#%02x%02x%02x" % tuple(self.browser.run(pixels + "([[8, 3]])")[0]), colour, name)

    def check_external(self, name, header, layers):
        """Figures and charts of external supports: the report's, and parts that add up."""
        totals, shown = header["totals"], {k: float(v) for k, v in self.figures("run-figures").items()}
        self.assertAlmostEqual(shown["external_support_volume_mm3"], totals["external_support_volume_mm3"], delta=0.06, msg=name)
        self.assertAlmostEqual(shown["external_support_printed_length_mm"], totals["external_support_printed_length_mm"], delta=0.6, msg=name)
        parts = ("shell_volume_mm3", "support_volume_mm3", "external_support_volume_mm3")
        self.assertAlmostEqual(shown["material_mm3"], sum(shown[p] for p in parts), delta=0.21, msg=name)
        layer, of_layer = layers[self.shown()[0]], {k: float(v) for k, v in self.figures("layer-figures").items()}
        self.assertGreater(layer["external_support_volume_mm3"], 0, name)
        for figure in ("external_support_volume_mm3", "external_support_printed_length_mm"):
            self.assertAlmostEqual(of_layer[figure], layer[figure], delta=0.00051, msg=name)
        self.assertAlmostEqual(of_layer["volume_mm3"], sum(of_layer[p] for p in parts), delta=0.0021, msg=name)
        lengths, volumes = self.browser.run("chartsOf(page.runs[0]).map(c => Array.from({ length: page.runs[0].count }, (_, k) => sumOf(c, k)).reduce((a, b) => a + b, 0))")
        self.assertAlmostEqual(lengths, totals["support_printed_length_mm"] + totals["external_support_printed_length_mm"], delta=0.01, msg=name)
        self.assertAlmostEqual(volumes, totals["material_mm3"], delta=0.01, msg=name)

    def test_external_supports_with_gaps(self):
        """What is proved then is not that every point has material within rho below: the page says what is, and counts those supports."""
        write_stl(self.folder / "table.stl", box((0, 0, 0), (3, 3, 6)) + box((-5, -5, 6), (8, 8, 7)))
        every, across = "every point of all 35 layers has material within ρ below", "within ρ of a support or within 0.5 mm (g + r) of the object"
        through = "the object lies on a support, on itself or on the bed at most 2 layers farther down"
        for name, options, said, unsaid in (
                ("none", (), (every,), (across, through, "on the bed alone")),
                ("gap", ("--support-gap", "0.3"), (across,), (every, through)),
                ("gaps", ("--support-gap", "0.3", "--support-gap-layers", "2", "--pillars"), (across, through), (every,)),
                ("bed", ("--bed-only",), (every, "on the bed alone: external supports stand on each other, nowhere on the object"), (across,))):
            generate(self.folder, "table.stl", "--support", "both", *options, "--layers", f"{name}.layers", "--html", f"{name}.html", "-o", f"{name}.gcode")
            header, *layers = map(json.loads, (self.folder / f"{name}.layers").read_text().splitlines())
            self.open(f"{name}.html", "#layer=20")
            for words in said:
                self.assertIn(words, self.text("header"), name)
            for words in unsaid:
                self.assertNotIn(words, self.text("header"), name)
            proof = self.text("#said")
            self.assertEqual("within 0.5 mm of the object" in proof, "--support-gap" in options, proof)
            self.assertEqual("on layers 17 to 19" in proof, "--support-gap-layers" in options, proof)
            self.assertEqual("external supports over external supports alone" in proof, "--bed-only" in options, proof)
            self.check_external(name, header, layers)
            self.at_end()
        self.browser.screenshot(SCREENSHOTS / "external.png")

    def test_rules_of_the_judge_are_said(self):
        """`verify` with gaps, --inside, bridges or small areas: what holds is not that all has material within rho below."""
        generate(self.folder, CUBE, "--support", "both", "-o", "both.gcode")
        within = "have material within ρ below"
        for file, options, said, unsaid in (
                ("both.gcode", (), ("Supported on all 100 layers.", within), ("by the rules",)),
                ("both.gcode", ("--support-gap", "0.3"), ("by the rules that follow", "removal gap", "held up by these rules"), (within,)),
                ("both.gcode", ("--support-gap-layers", "1"), ("by the rules that follow", "left empty", "held up by these rules"), (within,)),
                ("both.gcode", ("--bed-only",), ("by the rules that follow", "on the bed alone", "held up by these rules"), (within,)),
                ("both.gcode", ("--inside",), ("by the rules that follow", "inside the outline", "held up by these rules"), (within,)),
                (CORPUS / "verify/bridge.gcode", ("--allow-bridges", "6"), ("Supported on all 2 layers, but for 5.2 mm of bridges.", "All of it but the bridges is held up. 5.20 mm are bridges."), ("All of it is held up.",)),
                (CORPUS / "verify/cantilever.gcode", ("--min-area", "1000"), ("but for regions that --min-area lets pass.", "hangs, as --min-area lets it"), ("Supported on all 2 layers.",))):
            done = subprocess.run([PROGRAM, "verify", file, *options, "--html", "rules.html", "--quiet"], cwd=self.folder)
            self.assertEqual(done.returncode, 0, options)
            self.open("rules.html", "#layer=1")
            text = " ".join(map(self.text, ("header", "#caption", "#said")))
            for words in said:
                self.assertIn(words, text, options)
            for words in unsaid:
                self.assertNotIn(words, text, options)
            if "held up by these rules" in said:
                self.assertIn("not held up by these rules", self.text(".legend"))
            self.at_end()

    def test_more_places_than_are_listed(self):
        """600 short tracks over one wall: the worst 200 are named, and of how many they are."""
        lines = ["M83", ";LAYER_HEIGHT:0.2", ";WIDTH:0.4", ";TYPE:Perimeter", ";Z:0.2", "G1 Z0.2 F600", "G1 X0 Y0 F3000", "G1 X100 Y0 E4", ";Z:0.4", "G1 Z0.4 F600"]
        for k in range(600):
            x, y = k % 60 * 1.5, 3 + k // 60
            lines += [f"G1 X{x} Y{y} F3000", f"G1 X{x + 0.5} Y{y} E0.02"]
        (self.folder / "many.gcode").write_text("\n".join(lines) + "\n")
        self.assertEqual(make_page(self.folder, "many.gcode", "-o", "many.html").returncode, 0)
        self.open("many.html", "#layer=1")
        self.assertIn("The worst 200 of 600 places that hang", self.text("#places h2"))
        self.assertEqual(self.browser.run("document.querySelectorAll('#places li').length"), 200)
        self.at_end()

    def test_heights_are_said_as_they_are(self):
        write_stl(self.folder / "plate.stl", box((0, 0, 0), (5, 5, 0.125)))
        for height, said in (("0.125", "Layer 0, z 0.00 to 0.125 mm: on the bed"), ("0.1", "Layer 0, z 0.00 to 0.10 mm: on the bed")):
            generate(self.folder, "plate.stl", "--layer-height", height, "--html", "plate.html", "-o", "plate.gcode")
            self.open("plate.html")
            self.assertEqual(self.text("#caption"), said)
            self.assertIn("every point of the only layer has", self.text("header"))
        self.assertEqual(make_page(self.folder, "plate.gcode", "-o", "plate.html").returncode, 0)
        self.open("plate.html")
        self.assertIn("Supported on the only layer.", self.text("header"))
        self.at_end()

    def test_every_layer_counts_for_the_frame(self):
        """450 layers, one of them 60 mm wide in place of 20."""
        header, *layers = map(json.loads, (self.folder / "a.layers").read_text().splitlines())
        header["totals"]["layers"] = 450
        with open(self.folder / "collar.layers", "w") as out:
            out.write(json.dumps(header) + "\n")
            for k in range(450):
                layer = {**layers[50], "layer": k}
                if k == 301:
                    layer["slice"] = [[[125 + 3 * (v - 125) for v in p] for p in c] for c in layer["slice"]]
                out.write(json.dumps(layer) + "\n")
        self.assertEqual(make_page(self.folder, "collar.layers", "-o", "collar.html").returncode, 0)
        self.open("collar.html")
        self.assertEqual([round(v, 2) for v in self.browser.run("page.runs[0].box")], [95, 95, 155, 155])
        self.at_end()

    def test_a_file_that_is_no_run_page_is_refused_at_once(self):
        (self.folder / "other.html").write_text("<!doctype html><title>other</title><p>Nothing of ours.")
        (self.folder / "broken.html").write_text(re.sub(r'(id="layers0">.{40}).*?</script>', r"\1</script>", (self.folder / "a.html").read_text(), count=1, flags=re.S))
        for name, words in (("other.html", "no run page"), ("none.html", "ERR_FILE_NOT_FOUND"), ("broken.html", "could not be shown")):
            done = subprocess.run([sys.executable, ROOT / "scripts/page-picture", name, "out.png"], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertIn(name, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertFalse((self.folder / "out.png").exists())

    def test_without_webgl_the_drawing_is_there(self):
        with browser.Browser(FOUND, flags=["--disable-3d-apis"]) as plain:
            plain.open(self.folder / "a.html", "#layer=97")
            self.assertIn("no WebGL", plain.run("document.querySelector('.busy').textContent"))
            self.assertIn("layer 97", plain.run("document.querySelector('canvas.drawing').getAttribute('aria-label')"))
            plain.key("Home")
            self.assertEqual(plain.run("document.getElementById('slider').value"), "0")

    def test_a_large_print_opens_and_follows_the_slider(self):
        """The cube's layers fifteen times over and fifteen times as large: 1500 layers, 300 mm. scripts/page-speed times such."""
        header, *layers = map(json.loads, (self.folder / "a.layers").read_text().splitlines())
        header["totals"]["layers"] = 15 * len(layers)
        large = lambda value: [large(v) for v in value] if isinstance(value, list) else round(15 * value, 3)
        for layer in layers:
            for name in ("slice", "cavity", "vertices", "unsupported", "patch_tracks"):
                layer[name] = large(layer[name])
        with open(self.folder / "large.layers", "w") as out:
            out.write(json.dumps(header) + "\n")
            for k in range(15 * len(layers)):
                out.write(json.dumps({**layers[k % len(layers)], "layer": k}) + "\n")
        self.assertEqual(make_page(self.folder, "large.layers", "-o", "large.html").returncode, 0)
        self.open("large.html")
        self.browser.settle()
        for k in range(1499, 0, -50):
            self.slide(k)
            self.browser.run("new Promise(requestAnimationFrame)")
            self.assertEqual(self.shown(), [k, k])
        self.at_end()

    def test_gcode_of_any_slicer(self):
        done = subprocess.run([PROGRAM, "verify", CORPUS / "verify/cantilever.gcode", "--html", "v.html", "--report", "v.json", "--quiet"], cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        report = json.loads((self.folder / "v.json").read_text())
        self.open("v.html")
        layers = report["layers"]
        worst = max(layers, key=lambda layer: layer["unsupported_mm"][1])
        self.assertEqual(self.shown()[0], worst["layer"])
        self.assertAlmostEqual(float(self.figures("layer-figures")["hangs_mm"]), worst["unsupported_mm"][1], delta=0.001)
        self.assertIn("hangs", self.text("#caption"))
        self.assertIn("Hangs on 1 of", self.text("header"))
        self.browser.screenshot(SCREENSHOTS / "gcode.png")
        self.assertEqual(make_page(self.folder, CORPUS / "prusa_slicer.gcode", CORPUS / "cura.gcode", "-o", "slicers.html").returncode, 0)
        self.open("slicers.html")
        self.browser.screenshot(SCREENSHOTS / "slicers.png")
        rules = ["--support-radius", "10"]
        self.assertEqual(make_page(self.folder, CORPUS / "verify/cantilever.gcode", "-o", "rules.html", *rules).returncode, 0)
        self.open("rules.html")
        self.assertIn("Supported on all 2 layers", self.text("header"))
        self.at_end()


if __name__ == "__main__":
    if FOUND is None:
        print("skipped: no Chromium on this machine; scripts/setup installs it (package chromium), or name one with CHROMIUM=")
        sys.exit(77)
    unittest.main(verbosity=2)
