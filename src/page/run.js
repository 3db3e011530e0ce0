// Runs: what the page knows of each, the same questions for both kinds. A layer's number k counts from 0 at the bed.

/** The last `most` results of make(k). */
function remember(most, make) {
  const kept = new Map();
  return k => {
    if (!kept.has(k)) {
      if (kept.size >= most) kept.delete(kept.keys().next().value);
      kept.set(k, make(k));
    }
    return kept.get(k);
  };
}

function areaOf(region) {
  let twice = 0;
  for (const c of region)
    for (let k = 0, n = c.length; k < n; k += 2) twice += c[k] * c[(k + 3) % n] - c[(k + 2) % n] * c[k + 1];
  return twice / 2;
}

/** Neighbours and degrees of a support forest. */
function forestOf(shapes) {
  const n = shapes.vertices.length / 2, degree = new Uint16Array(n), next = Array.from({ length: n }, () => []), root = new Uint8Array(n);
  for (const v of shapes.roots) root[v] = 1;
  for (let k = 0; k < shapes.edges.length; k += 2) {
    const a = shapes.edges[k], b = shapes.edges[k + 1];
    ++degree[a]; ++degree[b]; next[a].push(b); next[b].push(a);
  }
  return { degree, next, root };
}

/** Counts as in report/layer_svg.hpp: a root that is a junction is both. */
function marksOf(shapes) {
  const { degree, root } = forestOf(shapes), marks = { roots: [], junctions: [], tips: [], dots: [] };
  degree.forEach((d, v) => {
    if (d === 0) marks.dots.push(v);
    else if (root[v]) marks.roots.push(v);
    else if (d === 1) marks.tips.push(v);
    if (d >= 3) marks.junctions.push(v);
  });
  return marks;
}

/** A run of `ribvault generate`. */
class VaultRun {
  constructor(facts, all) {
    const header = facts.run, s = header.settings;
    this.kind = "layers";
    this.header = header;
    this.all = all;
    this.count = all.length;
    this.name = header.input.path.split(/[\\/]/).pop();
    this.nozzle = s.nozzle_mm;
    this.wall = s.support_width_mm || s.nozzle_mm;  // layers files from before either option do not name it
    this.wideWall = this.wall * (s.wall_lines || 1);
    this.rho = s.support_radius_mm;
    this.good = header.verdict.proved && header.verdict.print.proved;
    // External supports, and how they stand off the object, as Settings::reach_of_object; older layers files do not name them.
    this.outside = (s.support || "internal") !== "internal";
    this.emptyLayers = this.outside && s.support_gap_layers || 0;
    this.bedOnly = this.outside && s.bed_only === true;
    const gap = this.outside && s.support_gap_mm || 0;
    this.reach = gap > 0 || this.emptyLayers > 0 || this.bedOnly ? Math.max(this.rho, gap + this.wall / 2) : this.rho;
    /** What is proved outside is not that all has material within ρ in the layer below. */
    this.apart = this.reach > this.rho || this.emptyLayers > 0;
    this.shapes = remember(40, k => shapesFrom(all[k].geometry));
    this.marks = remember(40, k => marksOf(this.shapes(k)));
    this.tops = all.map((_, k) => s.first_layer_height_mm + k * s.layer_height_mm);
    this.box = boxOf(all.map(r => r.geometry));
  }
  numbers(k) { return this.all[k].numbers; }
  /** How wide the wall through vertex v is printed, mm; as wall_width in vault/wall_stability.hpp. */
  wallWidth(shapes, v) { return shapes.wide[v] ? this.wideWall : this.wall; }
  top(k) { return this.tops[k]; }
  bottom(k) { return k === 0 ? 0 : this.tops[k - 1]; }
  /** Something hangs: inside (then the layer is not proved) or outside. */
  hangs(k) { const n = this.numbers(k); return !n.verdict.supported || !n.print.supported || n.verdict.external !== null; }
  refuted(k) { const n = this.numbers(k); return !n.verdict.supported || !n.print.supported; }
  /** Something of it hangs outside the layer below, where no external supports stand. */
  overhangs(k) { return this.numbers(k).verdict.external !== null && !this.outside; }
  newArea(k) { return areaOf(this.shapes(k).unsupported); }
  places(k) {
    const { verdict, print } = this.numbers(k), list = [];
    const region = (u, what) => u && list.push({ x: u.witness_mm[0], y: u.witness_mm[1], words: `${range(u.area_mm2[0], u.area_mm2[1])} mm² ${what}` });
    region(verdict.internal, "inside have no support");
    region(verdict.external, this.outside ? "outside have no support" : "hang outside the layer below");
    if (print.place_mm) list.push({ x: print.place_mm[0], y: print.place_mm[1], words: `as printed, ${fixed(print.unsupported_mm[1], 3)} mm have no support` });
    return list;
  }
}

/** The G-code of any slicer, judged. A layer is all entries with one z. */
class PrintRun {
  constructor(facts, all) {
    this.kind = "gcode";
    this.facts = facts;
    this.all = all;
    this.name = facts.name;
    this.rho = facts.rho;
    this.good = facts.supported;
    /** Judged by more than ρ over the layer below: by gaps of supports, on the bed alone, inside outlines. The facts say so in words (report/print_page.cpp). */
    this.apart = facts.apart;
    this.features = facts.features;
    this.entries = [];
    all.forEach((r, k) => { (this.entries[r.numbers.layer] ||= []).push(k); });
    this.count = this.entries.length;
    this.lines = remember(120, k => linesFrom(all[k].geometry));
    this.box = facts.box;
  }
  numbers(k) { return this.entries[k].map(e => this.all[e].numbers); }
  top(k) { return this.all[this.entries[k][0]].numbers.z; }
  bottom(k) { return k > 0 ? this.top(k - 1) : Math.max(0, this.top(k) - Math.max(...this.numbers(k).map(e => e.height))); }
  hangs(k) { return this.numbers(k).some(e => e.regions.length + e.pieces.length > 0); }
  refuted(k) { return this.hangs(k); }
  /** Bounds of the area that hangs, mm². */
  area(k) { return this.numbers(k).flatMap(e => e.regions).reduce((s, r) => [s[0] + r[0], s[1] + r[1]], [0, 0]); }
  sum(k, of) { return this.numbers(k).reduce((s, e) => s + of(e), 0); }
  /** Length of its bridges, which do not count as hanging, mm. */
  bridged(k) { return this.sum(k, e => e.bridges.reduce((s, b) => s + Math.hypot(b[4] - b[2], b[5] - b[3]), 0)); }
  length(k) { return this.sum(k, e => e.lengths.reduce((s, l) => s + l[1], 0)); }
  volume(k) { return this.sum(k, e => e.lengths.reduce((s, l) => s + l[2], 0)); }
  places(k) {
    const list = [];
    for (const e of this.numbers(k)) {
      for (const r of e.regions)
        list.push({ x: r[3], y: r[4], size: r[0] + r[1], words: `${range(r[0], r[1])} mm², ${fixed(r[2], 2)} mm from material, x ${fixed(r[3], 2)} y ${fixed(r[4], 2)}, line ${r[5]}, ${r[6].map(f => this.features[f].name).join(", ")}` });
      if (e.regions.length === 0)
        for (const p of e.pieces) list.push({ x: (p[2] + p[4]) / 2, y: (p[3] + p[5]) / 2, size: p[6], words: `${fixed(p[6], 3)} mm from material, line ${p[1]}, ${this.features[p[0]].name}` });
    }
    return list.sort((a, b) => b.size - a.size);
  }
}

/** x, y of all slices and supports of packed layers (as shapesFrom reads them), mm: lowest, then greatest. */
function boxOf(geometries) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const geometry of geometries) {
    const in_ = new Unpacker(geometry);
    in_.regionWithin(box);
    in_.region();  // the cavity lies within the slice
    in_.pointsWithin(in_.natural(), box);
  }
  return box[0] <= box[2] ? box.map(v => v / 100) : [0, 0, 0, 0];
}

/** The layer of a run in whose height z lies; -1: none. */
function layerAt(run, z) {
  let low = 0, high = run.count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (run.top(middle) < z) low = middle + 1; else high = middle;
  }
  return low < run.count && run.bottom(low) <= z ? low : -1;
}

/** Layer k of the run and the place of its middle. */
const middleOf = (run, k) => (run.bottom(k) + run.top(k)) / 2;

async function readRun(k) {
  const facts = JSON.parse(document.getElementById("facts" + k).textContent);
  const all = records(await inflated(document.getElementById("layers" + k).textContent));
  return facts.kind === "layers" ? new VaultRun(facts, all) : new PrintRun(facts, all);
}
