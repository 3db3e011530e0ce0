// The drawing of one layer on a canvas, with zoom and move. Views that share a `frame` move together.

const colours = () => { const style = getComputedStyle(document.documentElement); return n => style.getPropertyValue("--" + n).trim(); };

/** Sets a canvas to its size on the screen; the ratio of its pixels to CSS pixels. */
function size(canvas) {
  const ratio = window.devicePixelRatio || 1, w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  return ratio;
}

function contours(region, path = new Path2D()) {
  for (const c of region) {
    for (let k = 0; k < c.length; k += 2) k === 0 ? path.moveTo(c[0], c[1]) : path.lineTo(c[k], c[k + 1]);
    path.closePath();
  }
  return path;
}

/** A layer of a layers file as paths, made once. */
function vaultPaths(run, k) {
  const s = run.shapes(k), tracks = new Path2D(), patches = new Path2D(), walls = new Map(), v = s.vertices, dot = 1e-4;
  const wall = a => {
    const width = run.wallWidth(s, a);
    if (!walls.has(width)) walls.set(width, new Path2D());
    return walls.get(width);
  };
  for (let e = 0; e < s.edges.length; e += 2) {
    const a = 2 * s.edges[e], b = 2 * s.edges[e + 1];
    const path = wall(s.edges[e]);
    path.moveTo(v[a], v[a + 1]); path.lineTo(v[b], v[b + 1]);
  }
  for (const d of run.marks(k).dots) {
    const path = wall(d);
    path.moveTo(v[2 * d], v[2 * d + 1]); path.lineTo(v[2 * d] + dot, v[2 * d + 1]);
  }
  for (const path of walls.values()) tracks.addPath(path);
  for (let p = 0; p < s.patches.length; p += 4) { patches.moveTo(s.patches[p], s.patches[p + 1]); patches.lineTo(s.patches[p + 2] + dot, s.patches[p + 3]); }
  const cavity = contours(s.cavity), shell = contours(s.cavity, contours(s.slice));
  return { slice: contours(s.slice), shell, cavity, walls, tracks, patches, unsupported: contours(s.unsupported) };
}

/** Lines by width, those that are judged apart. */
function linePaths(run, entry, apart) {
  const paths = new Map();
  for (const { feature, width, points } of run.lines(entry)) {
    const judged = !apart || run.features[feature].judged, key = (judged ? "1 " : "0 ") + width;
    if (!paths.has(key)) paths.set(key, { judged, width, path: new Path2D() });
    const path = paths.get(key).path;
    path.moveTo(points[0], points[1]);
    if (points.length === 2) path.lineTo(points[0] + 1e-4, points[1]);
    for (let k = 2; k < points.length; k += 2) path.lineTo(points[k], points[k + 1]);
  }
  return [...paths.values()];
}

class LayerView {
  /** `extent`: mm that fit without zoom, {x, y}; `frame`: {zoom, x, y}: how much nearer than all of it, and which place, mm from the box's middle, is in the middle. */
  constructor(canvas, run, extent, frame, changed) {
    Object.assign(this, { canvas, run, extent, frame, changed, layer: 0, marked: null });
    this.paths = remember(40, k => run.kind === "layers" ? vaultPaths(run, k) : null);
    this.own = remember(80, e => linePaths(run, e, true));
    this.all = remember(80, e => linePaths(run, e, false));
    this.listen();
  }
  get scale() {
    const w = this.canvas.clientWidth - 32, h = this.canvas.clientHeight - 68;  // room for the title and the scale bar
    return Math.min(w / this.extent.x, h / this.extent.y) * this.frame.zoom;
  }
  /** Pixels of the place that lies at x = 0, y = 0 on the bed. */
  origin() {
    const [x0, y0, x1, y1] = this.run.box, s = this.scale;
    return [this.canvas.clientWidth / 2 - s * ((x0 + x1) / 2 + this.frame.x), this.canvas.clientHeight / 2 + s * ((y0 + y1) / 2 + this.frame.y)];
  }
  fit() { Object.assign(this.frame, { zoom: 1, x: 0, y: 0 }); this.marked = null; this.changed(); }
  move(dx, dy) { this.frame.x -= dx / this.scale; this.frame.y += dy / this.scale; this.changed(); }
  zoom(by, px = this.canvas.clientWidth / 2, py = this.canvas.clientHeight / 2) {
    const [ox, oy] = this.origin(), s = this.scale, x = (px - ox) / s, y = (oy - py) / s;
    this.frame.zoom = Math.min(400, Math.max(0.3, this.frame.zoom * by));
    const [nx, ny] = this.origin(), t = this.scale;
    this.frame.x += x - (px - nx) / t; this.frame.y += y - (ny - py) / t;
    this.changed();
  }
  /** Brings a place of the bed to the middle and marks it. */
  go(x, y) {
    const [x0, y0, x1, y1] = this.run.box;
    this.frame.zoom *= Math.max(1, 40 / this.scale);
    this.frame.x = x - (x0 + x1) / 2; this.frame.y = y - (y0 + y1) / 2;
    this.marked = [x, y];
    this.changed();
  }

  paint() {
    const { canvas, run, layer } = this, g = canvas.getContext("2d"), ratio = size(canvas), colour = colours();
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.fillStyle = colour("paper");
    g.fillRect(0, 0, canvas.width, canvas.height);
    const s = this.scale, [ox, oy] = this.origin();
    this.place = c => c.setTransform(ratio * s, 0, 0, -ratio * s, ratio * ox, ratio * oy);
    canvas.style.touchAction = this.frame.zoom > 1 ? "none" : "pan-y";  // a finger scrolls the page where there is nothing to move
    this.place(g);
    g.lineCap = g.lineJoin = "round";
    if (layer >= 0) run.kind === "layers" ? this.paintVault(g, colour) : this.paintPrint(g, colour);
    if (this.marked && layer >= 0) {
      g.strokeStyle = colour("ink"); g.lineWidth = 2 / s;
      g.beginPath(); g.arc(this.marked[0], this.marked[1], Math.max(0.8, 13 / s), 0, 7); g.stroke();
    }
    this.scaleBar(g, ratio, colour);
  }
  paintVault(g, colour) {
    const { run, layer, scale } = this, p = this.paths(layer), pixel = 1 / scale;
    const stroke = (path, c, width, alpha = 1) => { g.globalAlpha = alpha; g.strokeStyle = colour(c); g.lineWidth = width; g.stroke(path); g.globalAlpha = 1; };
    g.fillStyle = colour("shell"); g.fill(p.shell, "evenodd");
    stroke(p.shell, "edge", 0.8 * pixel);
    if (run.overhangs(layer)) this.paintOverhang(g, colour("overhang"));
    g.globalAlpha = 0.45; g.fillStyle = colour("hang"); g.fill(p.unsupported); g.globalAlpha = 1;
    for (const [width, path] of p.walls) {
      g.save();
      if (width > run.wall) g.clip(p.cavity, "evenodd");  // tracks side by side end there; ends so wide would reach out of the shell
      stroke(path, "track", Math.max(width, 2.2 * pixel), 0.9);
      g.restore();
    }
    stroke(p.patches, "patch", Math.max(run.wall, 2.5 * pixel), 0.8);
    stroke(p.unsupported, "hang", 1.5 * pixel);
    stroke(p.tracks, "line", Math.max(0.05, pixel));
    const marks = Object.values(run.marks(layer)).reduce((n, list) => n + list.length, 0);
    const apart = run.numbers(layer).support_length_mm / Math.max(1, marks);  // mm between marks on average
    this.paintMarks(g, colour, Math.min(16 * pixel, Math.max(run.nozzle, Math.min(6 * pixel, 0.6 * apart))));
  }
  /** What of the slice lies farther than ρ from the one below: cut out of a picture of its own. */
  paintOverhang(g, colour) {
    const { run, layer, canvas } = this, below = this.paths(layer - 1).slice, own = this.apart ||= document.createElement("canvas"), h = own.getContext("2d");
    own.width = canvas.width; own.height = canvas.height;
    this.place(h);
    h.fillStyle = colour; h.fill(this.paths(layer).slice, "evenodd");
    h.globalCompositeOperation = "destination-out";
    h.lineJoin = "round"; h.lineWidth = 2 * run.rho;
    h.fill(below, "evenodd"); h.stroke(below);
    g.save(); g.setTransform(1, 0, 0, 1, 0, 0); g.drawImage(own, 0, 0); g.restore();
    const [x, y] = run.numbers(layer).verdict.external.witness_mm;
    g.fillStyle = colour; g.beginPath(); g.arc(x, y, Math.max(0.06, 2.5 / this.scale), 0, 7); g.fill();
  }
  paintMarks(g, colour, w) {
    const { vertices: v } = this.run.shapes(this.layer), marks = this.run.marks(this.layer), at = i => [v[2 * i], v[2 * i + 1]];
    const fill = (list, c, shape) => { g.fillStyle = colour(c); g.beginPath(); for (const i of list) shape(...at(i)); g.fill(); };
    fill(marks.roots, "root", (x, y) => g.rect(x - 0.4 * w, y - 0.4 * w, 0.8 * w, 0.8 * w));
    fill(marks.junctions, "junction", (x, y) => { g.moveTo(x + 0.45 * w, y); g.arc(x, y, 0.45 * w, 0, 7); });
    fill(marks.tips, "tip", (x, y) => { g.moveTo(x, y + 0.6 * w); g.lineTo(x - 0.5 * w, y - 0.35 * w); g.lineTo(x + 0.5 * w, y - 0.35 * w); g.closePath(); });
    fill(marks.dots, "dot", (x, y) => { g.moveTo(x, y + 0.6 * w); g.lineTo(x - 0.6 * w, y); g.lineTo(x, y - 0.6 * w); g.lineTo(x + 0.6 * w, y); g.closePath(); });
  }
  paintPrint(g, colour) {
    const { run, layer, scale } = this, entries = run.entries[layer], thin = Math.max(0.12, 2 / scale);
    const stroke = (list, c) => { for (const t of list) { g.strokeStyle = c(t); g.lineWidth = t.width; g.stroke(t.path); } };
    for (const e of new Set(entries.flatMap(k => run.all[k].numbers.below))) stroke(this.all(e), () => colour("below"));
    g.globalAlpha = 0.85;
    for (const e of entries) stroke(this.own(e), t => colour(t.judged ? "track" : "other"));
    g.globalAlpha = 1;
    const lines = (list, c) => {
      g.strokeStyle = c; g.lineWidth = thin; g.beginPath();
      for (const p of list) { g.moveTo(p[2], p[3]); g.lineTo(p[4] + (p[2] === p[4] && p[3] === p[5] ? 1e-4 : 0), p[5]); }
      g.stroke();
    };
    for (const e of entries) this.paintRegions(g, e, colour);
    for (const e of entries) {
      const n = run.all[e].numbers;
      g.fillStyle = colour("hang");
      for (const r of n.regions) { g.beginPath(); g.arc(r[3], r[4], Math.max(0.06, 1.5 / scale), 0, 7); g.fill(); }
      lines(n.bridges, colour("bridge"));
      lines(n.pieces, colour("hang"));
    }
  }
  /** What violates equation (2), with its exact boundary. */
  paintRegions(g, entry, colour) {
    g.globalAlpha = 0.6; g.fillStyle = colour("hang");
    for (const r of this.run.all[entry].numbers.regions) g.fill(new Path2D(r[7]));
    g.globalAlpha = 1;
  }
  scaleBar(g, ratio, colour) {
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    const s = this.scale, y = this.canvas.clientHeight - 14;
    let bar = 10 ** Math.floor(Math.log10(90 / s));
    if (bar * s < 30) bar *= bar * s < 18 ? 5 : 2;
    const words = +bar.toPrecision(3) + " mm";
    g.font = "12px system-ui, sans-serif";
    g.fillStyle = colour("paper"); g.fillRect(6, y - 10, bar * s + g.measureText(words).width + 18, 20);
    g.fillStyle = g.strokeStyle = colour("soft"); g.lineWidth = 2;
    g.beginPath(); g.moveTo(12, y); g.lineTo(12 + bar * s, y); g.stroke();
    g.fillText(words, 18 + bar * s, y + 4);
  }

  listen() {
    const { canvas } = this, fingers = new Map();
    canvas.addEventListener("wheel", e => { e.preventDefault(); this.zoom(Math.exp(-e.deltaY * 0.0015), e.offsetX, e.offsetY); }, { passive: false });
    canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, [e.offsetX, e.offsetY]); });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, e => fingers.delete(e.pointerId));
    canvas.addEventListener("pointermove", e => {
      if (!fingers.has(e.pointerId)) return;
      const from = fingers.get(e.pointerId), to = [e.offsetX, e.offsetY];
      if (fingers.size === 1) this.move(to[0] - from[0], to[1] - from[1]);
      if (fingers.size === 2) {
        const other = [...fingers].find(([id]) => id !== e.pointerId)[1], far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) || 1;
        this.zoom(far(to, other) / far(from, other), other[0], other[1]);
      }
      fingers.set(e.pointerId, to);
    });
    canvas.addEventListener("keydown", e => {
      const step = 40, keys = { "+": () => this.zoom(1.4), "=": () => this.zoom(1.4), "-": () => this.zoom(1 / 1.4), "0": () => this.fit() };
      if (e.shiftKey) Object.assign(keys, { ArrowLeft: () => this.move(step, 0), ArrowRight: () => this.move(-step, 0), ArrowUp: () => this.move(0, step), ArrowDown: () => this.move(0, -step) });
      if (keys[e.key] && !e.ctrlKey && !e.metaKey && !e.altKey) { e.preventDefault(); e.stopPropagation(); keys[e.key](); }
    });
  }
}
