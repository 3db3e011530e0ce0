// Figures and sentences: all that the pictures show, in words.

const fixed = (v, n) => v === null || v === undefined ? "no material" : v.toFixed(n);
const range = (lo, hi) => { const a = fixed(lo, 2), b = fixed(hi, 2); return b === "0.00" && hi > 0 ? "< 0.01" : a === b ? a : a + " to " + b; };
const many = (n, one, more = one + "s") => `${n} ${n === 1 ? one : more}`;
const time = s => s >= 3600 ? `${Math.floor(s / 3600)} h ${Math.round(s % 3600 / 60)} min` : s >= 60 ? `${fixed(s / 60, 1)} min` : `${fixed(s, 1)} s`;

/** Figures of layer k: [key, label, value, digits]. Keys of both kinds of runs stand in one row where they are the same. */
function layerFigures(run, k) {
  if (run.kind === "gcode") {
    const [lo, hi] = run.area(k);
    return [["extruded_mm3", "extruded, mm³", run.volume(k), 3], ["length_mm", "tracks, mm", run.length(k), 3],
      ["hangs_mm", "of these without material within ρ below, mm", run.sum(k, e => e.hangs), 3], ["area_mm2", "that hangs, mm²", (lo + hi) / 2, 3]];
  }
  const n = run.numbers(k), m = run.marks(k);
  return [["extruded_mm3", "extruded, mm³", n.extruded_mm3, 3], ["volume_mm3", "material, mm³", n.shell_volume_mm3 + n.support_volume_mm3, 3], ["shell_volume_mm3", "shell and covers, mm³", n.shell_volume_mm3, 3],
    ["support_volume_mm3", "supports, mm³", n.support_volume_mm3, 3], ["support_length_mm", "supports, centre lines, mm", n.support_length_mm, 3],
    ["support_printed_length_mm", "supports as printed, without gaps, mm", n.support_printed_length_mm, 3], ["trees", "trees", n.trees, 0],
    ["roots", "roots", m.roots.length, 0], ["junctions", "junctions", m.junctions.length, 0], ["tips", "tips", m.tips.length, 0],
    ["gaps", "gaps at junctions", n.gaps, 0], ["closed_gaps", "gaps closed for the print", n.closed_gaps, 0], ["patches", "patches", n.patches, 0],
    ["new_area_mm2", "newly supported, at most, mm²", run.newArea(k), 3], ["filament_mm", "filament, mm", n.filament_mm, 3], ["print_seconds", "print time, s", n.print_seconds, 1]];
}

function runFigures(run) {
  if (run.kind === "gcode") {
    let length = 0, volume = 0, area = [0, 0], hangs = 0;
    for (let k = 0; k < run.count; ++k) {
      length += run.length(k), volume += run.volume(k), hangs += run.sum(k, e => e.hangs);
      const a = run.area(k); area = [area[0] + a[0], area[1] + a[1]];
    }
    return [["layers", "layers", run.count, 0], ["extruded_mm3", "extruded, mm³", volume, 1], ["length_mm", "tracks, mm", length, 0],
      ["hangs_mm", "of these without material within ρ below, mm", hangs, 2], ["area_mm2", "that hangs, mm²", (area[0] + area[1]) / 2, 2]];
  }
  const t = run.header.totals;
  return [["layers", "layers", t.layers, 0], ["extruded_mm3", "extruded, mm³", t.extruded_mm3, 1], ["material_mm3", "material, mm³", t.material_mm3, 1], ["shell_volume_mm3", "shell and covers, mm³", t.shell_volume_mm3, 1],
    ["support_volume_mm3", "supports, mm³", t.support_volume_mm3, 1], ["support_printed_length_mm", "supports as printed, mm", t.support_printed_length_mm, 0],
    ["filament_mm", "filament, m", t.filament_mm / 1000, 2], ["print_seconds", "print time, min", t.print_seconds / 60, 0]];
}

function runVerdict(run) {
  if (run.kind === "gcode") return run.facts.verdict;
  const v = run.header.verdict, bad = new Set([...v.layers_refuted, ...v.print.layers_refuted]).size;
  return run.good ? `Proved: every point of all ${run.count} layers has material within ρ below, as geometry and as printed` +
      (v.external_overhangs.length > 0 ? `, but for what overhangs outside on ${many(v.external_overhangs.length, "layer")}.` : ".")
    : `Not proved on ${bad} of ${run.count} layers.`;
}

function runWords(run) {
  if (run.kind === "gcode") return run.facts.words;
  const s = run.header.settings, v = run.header.verdict.external_overhangs.length;
  const how = s.propagation === "shrink" ? "thrifty" : s.straighten ? "straightened" : "not straightened";
  const wide = s.wall_lines > 1 ? `, ${s.wall_lines} side by side in long or tall walls` : "";
  return `Layers of ${s.layer_height_mm} mm, tracks of ${s.nozzle_mm} mm${wide}, ρ = ${s.support_radius_mm} mm; ` +
    `supports ${how}, gaps ${s.gaps}, seed ${s.seed}.` +
    (v > 0 ? ` The outside overhangs on ${many(v, "layer")}, which no internal support can hold.` : "");
}

/** The verdict on layer k in two or three words. */
function layerVerdict(run, k) {
  if (run.refuted(k)) return run.kind === "gcode" ? "hangs" : "not proved";
  return k === 0 ? "on the bed" : run.kind === "gcode" ? "supported" : run.hangs(k) ? "proved inside, overhangs outside" : "proved";
}

function heading(run, k) { return `layer ${k}, z ${fixed(run.bottom(k), 2)} to ${fixed(run.top(k), 2)} mm: ${layerVerdict(run, k)}`; }

/** What the pictures of layer k show. */
function layerWords(run, k) {
  if (run.kind === "gcode") {
    const [lo, hi] = run.area(k), length = run.length(k);
    return `${fixed(length, 1)} mm of tracks. ` + (run.hangs(k) ? `${fixed(run.sum(k, e => e.hangs), 2)} mm of their centre lines and ${range(lo, hi)} mm² of their area have no material within ${+run.rho.toFixed(4)} mm below.` : "All of it is held up.");
  }
  const n = run.numbers(k), m = run.marks(k), s = run.shapes(k);
  const places = s.unsupported.filter(c => areaOf([c]) > 0).length;
  const wide = n.wide_trees > 0 ? `, ${n.wide_trees} of them ${+run.wideWall.toFixed(3)} mm wide,` : "";
  const supports = n.trees === 0 ? "No supports on this layer." :
    `${many(n.trees, "support tree")}${wide} with ${fixed(n.support_length_mm, 1)} mm: ${many(m.roots.length, "root")}, ` +
    `${many(m.junctions.length, "junction")}, ${many(m.tips.length, "tip")}${m.dots.length ? ", " + many(m.dots.length, "dot") : ""}.`;
  const grown = places === 0 ? "Nothing new had to be held up." : `Newly supported for the layer above: ${many(places, "place")}, at most ${fixed(run.newArea(k), 2)} mm².`;
  const proof = run.refuted(k) ? "Not proved: something inside has no material within ρ below." : k === 0 ? "The layer lies on the bed." : `Proved over layer ${k - 1}, as geometry and as printed.`;
  const out = n.verdict.external;
  return `${proof} Shell of ${fixed(n.shell_volume_mm3, 2)} mm³. ${supports} ${grown}` + (out ? ` Outside, ${range(out.area_mm2[0], out.area_mm2[1])} mm² hang over the layer below.` : "");
}

/** Layers to go to: [[k, words]]. */
function worthALook(run) {
  const of = Array.from({ length: run.count }, (_, k) => k), list = [];
  const most = (value, words) => {
    const k = of.reduce((best, i) => value(i) > value(best) ? i : best, 0);
    if (value(k) > 0) list.push([k, words(value(k))]);
  };
  const refuted = of.filter(k => run.refuted(k));
  if (run.kind === "gcode") {
    const area = k => { const [lo, hi] = run.area(k); return (lo + hi) / 2; };
    for (const k of refuted.sort((a, b) => area(b) - area(a)).slice(0, 8)) list.push([k, `${range(...run.area(k))} mm² hang`]);
    most(k => run.length(k), v => `most tracks, ${fixed(v, 0)} mm`);
    return list;
  }
  for (const k of refuted.slice(0, 8)) list.push([k, "not proved"]);
  most(k => run.numbers(k).support_length_mm, v => `most supports, ${fixed(v, 1)} mm`);
  most(k => run.numbers(k).trees, v => `most trees, ${v}`);
  most(k => run.numbers(k).verdict.external ? run.numbers(k).verdict.external.area_mm2[1] : 0, v => `largest overhang outside, up to ${fixed(v, 1)} mm²`);
  return list;
}
