// The page: reads its runs, puts the pictures beside each other and keeps them on one layer.

class Page {
  constructor(runs) {
    this.runs = runs;
    this.two = runs.length > 1;
    this.lead = this.two && runs[1].count > runs[0].count ? 1 : 0;
    this.names = runs.map((r, k) => this.two ? "AB"[k] : r.name);
    const most = of => Math.max(1, ...runs.map(of));
    this.extent = { x: most(r => r.box[2] - r.box[0]), y: most(r => r.box[3] - r.box[1]), z: most(r => r.top(r.count - 1)) };
    document.body.classList.toggle("two", this.two);
    document.title = runs.map(r => r.name).join(" | ") + " - ribvault";
    this.header();
    this.pictures();
    const steps = runs[this.lead].count;
    this.charts = this.makeCharts(steps);
    this.controls = new Controls(steps, s => this.show(s), s => this.layers(s).some((k, r) => k >= 0 && runs[r].hangs(k)), on => this.played(on));
    this.features();
    this.links();
    this.fill("run-figures", runs.map(runFigures));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { this.models.forEach(m => m.show()); this.paint(); });
    new ResizeObserver(() => { this.paint(); this.models.forEach(m => m.draw()); }).observe($("views"));
    this.controls.go(this.controls.linked() ?? this.first());
  }
  /** The layer of each run at a step of the slider; -1: none at this height. */
  layers(step) {
    const z = middleOf(this.runs[this.lead], step);
    return this.runs.map((r, k) => k === this.lead ? step : layerAt(r, z));
  }
  first() {
    const run = this.runs[this.lead], value = k => run.kind === "gcode" ? run.area(k)[1] * 1e6 + run.length(k) : run.numbers(k).support_length_mm;
    let best = 0;
    for (let k = 1; k < run.count; ++k) if (value(k) > value(best)) best = k;
    return best;
  }
  header() {
    this.runs.forEach((run, r) => $("runs").append(made("div", {}, made("h1", {}, this.two ? `${this.names[r]}: ${run.name}` : run.name),
      made("p", {}, made("span", { class: run.good ? "verdict" : "verdict bad" }, runVerdict(run)), " " + runWords(run)))));
  }

  pictures() {
    const frame = { zoom: 1, x: 0, y: 0 };
    this.drawings = []; this.models = [];
    const drawings = [], models = [];
    this.runs.forEach((run, r) => {
      const drawing = made("canvas", { role: "img", tabindex: 0, class: "drawing" }), view = new LayerView(drawing, run, this.extent, frame, () => this.paint());
      const zoom = made("span", { class: "row zoom" });
      for (const [sign, words, act] of [["+", "Zoom in", () => view.zoom(1.4)], ["−", "Zoom out", () => view.zoom(1 / 1.4)], ["fit", "Show all of the layer", () => view.fit()]]) {
        const b = made("button", { "aria-label": words, title: words }, sign);
        b.onclick = act;
        zoom.append(b);
      }
      drawings.push(made("div", { class: "view" }, made("p", { class: "title" }), drawing, made("div", { class: "tools zooms" }, zoom, ...(this.two ? [] : [legend(run)]))));
      this.drawings.push(view);
      models.push(this.model(run, r));
    });
    const legends = [...new Map(this.runs.map(run => [run.kind, run])).values()].map(legend);
    $("views").append(...(this.two ? [...drawings, ...legends, ...models] : [...models, ...drawings]));
  }
  model(run, r) {
    const canvas = made("canvas", { role: "img", tabindex: 0, class: "model" }), busy = made("p", { class: "busy", role: "status" }, "building the model");
    const cut = made("select", { "aria-label": "Shell" });
    for (const [value, words] of [["front", "shell: front half cut away"], ["left", "shell: left half cut away"], ["back", "shell: back half cut away"], ["right", "shell: right half cut away"], ["whole", "shell: whole"], ["hidden", "shell: hidden"]])
      cut.append(made("option", { value }, words));
    const peel = made("select", { "aria-label": "Layers of the model" });
    for (const [value, words] of [["all", "all layers"], ["peel", "up to this layer"]]) peel.append(made("option", { value }, words));
    const view = made("div", { class: "view" }, made("p", { class: "title" }, this.two ? this.names[r] : "the model; orange: the shown layer"), canvas, busy, made("div", { class: "tools" }, cut, peel));
    try {
      const model = new ModelView(canvas, run, this.extent, share => { busy.textContent = `building the model, ${Math.round(100 * share)} %`; busy.hidden = share === 1; });
      cut.value = model.cut;
      cut.onchange = () => this.models.forEach((m, k) => { m.cut = cut.value; this.cuts[k].value = cut.value; if (cut.value !== "whole" && cut.value !== "hidden") m.look(); m.show(); });
      peel.onchange = () => this.peel(peel.value === "peel");
      model.controls.addEventListener("change", () => { if (!this.following) { this.following = true; this.models.filter(m => m !== model).forEach(m => m.follow(model)); this.following = false; } });
      (this.cuts ||= []).push(cut); (this.peels ||= []).push(peel);
      this.models.push(model);
    } catch (error) {
      console.warn("no WebGL: " + error.message);
      busy.textContent = "This browser has no WebGL, so there is no model in 3D; the drawing of each layer shows the same.";
      cut.disabled = peel.disabled = true;
    }
    canvas.setAttribute("aria-label", `${this.two ? this.names[r] + ", " : ""}${run.name} in 3D, ${fixed(run.box[2] - run.box[0], 0)} by ${fixed(run.box[3] - run.box[1], 0)} by ${fixed(run.top(run.count - 1), 0)} mm: ` +
      "the shell with one half cut away and the support walls inside; the shown layer stands out.");
    return view;
  }
  peel(on) { this.models.forEach((m, k) => { m.peel = on; this.peels[k].value = on ? "peel" : "all"; m.show(); }); }
  played(on) {
    $("said").setAttribute("aria-live", on ? "off" : "polite");
    if (on) this.peel(true);
    else this.say();
  }

  makeCharts(steps) {
    const per = this.runs.map(chartsOf);
    let pairs = per[0].map(c => [c]);
    if (this.two) pairs = this.runs[0].kind === this.runs[1].kind ? per[0].map((c, k) => [c, per[1][k]]) : [this.runs.map(extrudedChart)];
    return pairs.map(charts => {
      const chart = new Chart(charts, this.names, steps, s => this.layers(s), s => this.controls.by(() => s));
      $("charts").append(chart.figure);
      return chart;
    });
  }
  features() {
    for (const [r, run] of this.runs.entries()) {
      if (run.kind !== "gcode") continue;
      const table = made("table"), head = made("tr");
      for (const c of ["type", "mm", "hangs, mm", "share", "worst, mm"]) head.append(made("th", { scope: "col" }, c));
      const body = made("tbody");
      for (const f of run.features) {
        if (f.tracks === 0) continue;
        const cells = f.judged ? [fixed(f.length, 1), fixed(f.hangs, 2), (f.length > 0 ? 100 * f.hangs / f.length : 0).toFixed(2) + " %", f.worst === undefined ? "-" : fixed(f.worst, 2)]
          : [fixed(f.length, 1), "not judged", "", ""];
        body.append(made("tr", {}, made("th", { scope: "row" }, f.name), ...cells.map(c => made("td", {}, c))));
      }
      table.append(made("thead", {}, head), body);
      $("features").append(made("h2", {}, "Feature types" + (this.two ? ", " + this.names[r] : "")), made("div", { class: "scroll" }, table));
    }
  }
  links() {
    const run = this.runs[this.lead];
    for (const [k, words] of worthALook(run)) $("links").append(made("li", {}, made("a", { href: "#layer=" + k }, `Layer ${k}: ${words}`)));
  }
  /** A table of figures, one column a run, in the order of the first. */
  fill(id, columns) {
    const keys = [...new Map(columns.flat().map(f => [f[0], f])).values()].filter(f => columns.some(c => c.some(g => g[0] === f[0])));
    const body = made("tbody");
    for (const [key, label, , digits] of keys) {
      const values = columns.map(c => c.find(f => f[0] === key)?.[2]);
      const row = made("tr", {}, made("th", { scope: "row" }, label), ...values.map((v, r) => made("td", { "data-figure": key, "data-run": r }, v === undefined ? "-" : fixed(v, digits))));
      if (this.two) row.append(made("td", {}, values.every(v => v !== undefined) && values[0] > 0 ? `${values[1] >= values[0] ? "+" : "−"}${fixed(Math.abs(100 * (values[1] / values[0] - 1)), 1)} %` : ""));
      body.append(row);
    }
    const table = $(id);
    table.replaceChildren(body);
    if (this.two) table.prepend(made("thead", {}, made("tr", {}, made("th", { scope: "col" }, ""), ...this.names.map((n, r) => made("th", { scope: "col", title: this.runs[r].name }, n)), made("th", { scope: "col" }, "B to A"))));
  }

  show(step) {
    this.step = step;
    const layers = this.layers(step), none = "nothing at this height";
    layers.forEach((k, r) => {
      const run = this.runs[r], view = this.drawings[r];
      if (view.layer !== k) view.marked = null;
      view.layer = k;
      this.models[r]?.go(k);
      view.canvas.previousSibling.textContent = this.two ? `${this.names[r]}, ${k < 0 ? none : `layer ${k}: ${layerVerdict(run, k)}`}` : heading(run, k);
    });
    this.charts.forEach(c => c.go(step));
    $("caption").textContent = layers.map((k, r) => (this.two ? this.names[r] + ": " : "") + (k < 0 ? none : heading(this.runs[r], k))).join(" · ").replace(/^l/, "L");
    $("slider").setAttribute("aria-valuetext", $("caption").textContent);
    this.paint();
    if (!this.controls.timer) this.say();
  }
  /** The words and figures; not while playing, when nobody could read them. */
  say() {
    const layers = this.layers(this.step);
    $("layer-title").textContent = `Layer ${this.step} of 0 to ${this.controls.steps - 1}`;
    $("said").replaceChildren(...layers.map((k, r) => made("p", {}, (this.two ? this.names[r] + ": " : "") + (k < 0 ? "nothing at this height." : layerWords(this.runs[r], k)))));
    layers.forEach((k, r) => this.drawings[r].canvas.setAttribute("aria-label", `Drawing of ${this.two ? this.names[r] + ", " : ""}${this.runs[r].name}, ${k < 0 ? "nothing at this height" : heading(this.runs[r], k) + ". " + layerWords(this.runs[r], k)}`));
    this.fill("layer-figures", layers.map((k, r) => k < 0 ? [] : layerFigures(this.runs[r], k)));
    this.places(layers);
  }
  places(layers) {
    const box = $("places"), most = 200;
    box.replaceChildren();
    layers.forEach((k, r) => {
      const list = k < 0 ? [] : this.runs[r].places(k);
      if (list.length === 0) return;
      const ol = made("ol");
      for (const place of list.slice(0, most)) {
        const b = made("button", {}, place.words);
        b.onclick = () => { this.drawings[r].go(place.x, place.y); this.drawings[r].canvas.scrollIntoView({ block: "nearest" }); };
        ol.append(made("li", {}, b));
      }
      const named = list.length > most ? `the worst ${most} of ${list.length} places` : many(list.length, "place");
      box.append(made("h2", {}, (this.two ? this.names[r] + ": " + named : named[0].toUpperCase() + named.slice(1)) + (list.length > 1 ? " that hang" : " that hangs")), ol);
    });
  }
  paint() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => { this.queued = false; this.drawings.forEach(d => d.paint()); this.charts.forEach(c => c.paint()); });
  }
}

async function start() {
  const runs = [];
  for (let k = 0; $("facts" + k); ++k) runs.push(await readRun(k));
  window.page = new Page(runs);
  await new Promise(resolve => requestAnimationFrame(() => setTimeout(resolve)));
  performance.mark("shown");
  await Promise.all(window.page.models.map(m => m.built));
  performance.mark("built");
}
start().catch(error => {
  $("runs").append(made("p", { class: "verdict bad" }, `This page could not be shown: ${error.message}. It needs a browser of 2023 or later.`));
  throw error;
});
