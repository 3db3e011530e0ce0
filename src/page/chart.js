// Charts over all layers, linked to the slider.

/** Lengths and volumes of a run, per layer: {title, parts: [{name, colour, values}]}; later parts stand on earlier ones. */
function chartsOf(run) {
  const list = of => Float64Array.from({ length: run.count }, (_, k) => of(k));
  if (run.kind === "gcode")
    return [
      { title: "Length of tracks, mm", parts: [{ name: "tracks", colour: "track", values: list(k => run.length(k)) }] },
      { title: "Extruded, mm³", parts: [{ name: "tracks", colour: "shell", values: list(k => run.volume(k)) }] },
      { title: "Area that hangs, mm²", parts: [{ name: "hangs", colour: "hang", values: list(k => { const [lo, hi] = run.area(k); return (lo + hi) / 2; }) }] },
    ];
  const inside = run.outside ? "internal supports" : "supports";
  const external = of => run.outside ? [{ name: "external supports", colour: "second", values: list(k => externalOf(run.numbers(k))[of]) }] : [];
  return [
    { title: "Length of supports as printed, mm", parts: [{ name: inside, colour: "track", values: list(k => run.numbers(k).support_printed_length_mm) }, ...external("length")] },
    { title: "Volume, mm³", parts: [{ name: "shell and covers", colour: "shell", values: list(k => run.numbers(k).shell_volume_mm3) },
      { name: inside, colour: "track", values: list(k => run.numbers(k).support_volume_mm3) }, ...external("volume")] },
  ];
}
/** The chart that runs of both kinds have. */
const extrudedChart = run => run.kind === "gcode" ? chartsOf(run)[1]
  : { title: "Extruded, mm³", parts: [{ name: "tracks", colour: "shell", values: Float64Array.from({ length: run.count }, (_, k) => run.numbers(k).extruded_mm3) }] };
const sumOf = (chart, k) => k < 0 ? 0 : chart.parts.reduce((s, p) => s + p.values[k], 0);

class Chart {
  /** `charts`: the same chart of each run; `layers(step)`: the layer of each run at a step of the slider. */
  constructor(charts, names, steps, layers, go) {
    Object.assign(this, { charts, names, steps, layers, step: 0 });
    this.figure = document.createElement("figure");
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.words = document.createElement("figcaption");
    this.figure.append(this.words, this.canvas);
    const at = e => go(Math.max(0, Math.min(steps - 1, Math.round((e.offsetX - this.left) / (this.canvas.clientWidth - this.left - 8) * (steps - 1)))));
    this.left = 46;
    this.canvas.addEventListener("pointerdown", e => { this.canvas.setPointerCapture(e.pointerId); at(e); });
    this.canvas.addEventListener("pointermove", e => { if (e.buttons) at(e); });
    this.most = Math.max(0, ...charts.map(c => Array.from({ length: c.parts[0].values.length }, (_, k) => sumOf(c, k)).reduce((a, b) => Math.max(a, b), 0)));
    if (this.most === 0) this.most = 1;
    this.describe();
  }
  describe() {
    const title = this.charts[0].title;
    const said = this.charts.map((c, r) => {
      let top = 0, sum = 0;
      for (let k = 0; k < c.parts[0].values.length; ++k) { sum += sumOf(c, k); if (sumOf(c, k) > sumOf(c, top)) top = k; }
      return `${this.charts.length > 1 ? this.names[r] + ": " : ""}most on layer ${top}, ${fixed(sumOf(c, top), 1)}; ${fixed(sum, 1)} in all`;
    });
    this.canvas.setAttribute("aria-label", `${title}, per layer from the bed to the top. ${said.join(". ")}.`);
    this.words.textContent = title;
    this.value = document.createElement("b");
    this.words.append(" ", this.value);
    const key = (name, colour, dashed) => { const s = document.createElement("span"); s.className = dashed ? "key dashed" : "key"; s.style.setProperty("--c", `var(--${colour})`); s.textContent = name; this.words.append(s); };
    if (this.charts.length > 1) this.names.forEach((n, r) => key(n, r === 0 ? "line" : "second", r === 1));
    else if (this.charts[0].parts.length > 1) for (const p of this.charts[0].parts) key(p.name, p.colour);
  }
  go(step) {
    this.step = step;
    this.value.textContent = this.layers(step).map((k, r) => k < 0 ? "-" : fixed(sumOf(this.charts[r], k), 2)).join(" | ");
  }
  paint() {
    const { canvas, charts, left, most, steps } = this, ratio = size(canvas), g = canvas.getContext("2d"), colour = colours();
    const w = canvas.clientWidth, h = canvas.clientHeight, top = 14, bottom = h - 20, right = w - 8;
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    g.clearRect(0, 0, w, h);
    const x = s => left + (right - left) * (steps > 1 ? s / (steps - 1) : 0.5), y = v => bottom - (bottom - top) * v / most;
    g.font = "12px system-ui, sans-serif"; g.fillStyle = colour("soft"); g.strokeStyle = colour("rule"); g.lineWidth = 1;
    g.textAlign = "right";
    const grid = 10 ** Math.floor(Math.log10(most)), every = most / grid < 2 ? grid / 2 : most / grid < 5 ? grid : 2 * grid;
    for (let v = 0; v <= most * 1.001; v += every) { g.beginPath(); g.moveTo(left, y(v)); g.lineTo(right, y(v)); g.stroke(); g.fillText(+v.toPrecision(3), left - 6, y(v) + 4); }
    g.textAlign = "center";
    for (let s = 0; s < steps; s += niceStep(steps)) g.fillText(s, x(s), h - 5);
    charts.length > 1 ? this.paintLines(g, x, y, colour) : this.paintAreas(g, x, y, colour);
    g.strokeStyle = colour("ink"); g.lineWidth = 1.5;
    g.beginPath(); g.moveTo(x(this.step), top - 4); g.lineTo(x(this.step), bottom + 3); g.stroke();
  }
  paintAreas(g, x, y, colour) {
    const base = new Float64Array(this.steps);
    for (const part of this.charts[0].parts) {
      g.fillStyle = colour(part.colour);
      g.beginPath();
      for (let s = 0; s < this.steps; ++s) g.lineTo(x(s), y(base[s] + part.values[s]));
      for (let s = this.steps - 1; s >= 0; --s) g.lineTo(x(s), y(base[s]));
      g.fill();
      part.values.forEach((v, s) => base[s] += v);
    }
  }
  paintLines(g, x, y, colour) {
    this.charts.forEach((chart, r) => {
      g.strokeStyle = colour(r === 0 ? "line" : "second"); g.lineWidth = 1.8;
      g.setLineDash(r === 0 ? [] : [5, 3]);
      g.beginPath();
      for (let s = 0, down = false; s < this.steps; ++s) {
        const k = this.layers(s)[r];
        if (k >= 0) down ? g.lineTo(x(s), y(sumOf(chart, k))) : g.moveTo(x(s), y(sumOf(chart, k)));
        down = k >= 0;
      }
      g.stroke();
    });
    g.setLineDash([]);
  }
}
function niceStep(steps) {
  for (let unit = 1; ; unit *= 10) for (const by of [1, 2, 5]) if (steps / (unit * by) <= 9) return unit * by;
}
