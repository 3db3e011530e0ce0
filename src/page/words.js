// Figures and sentences: all that the pictures show, in words.

const fixed = (v, n) => v === null || v === undefined ? "no material" : v.toFixed(n);
const range = (lo, hi) => { const a = fixed(lo, 2), b = fixed(hi, 2); return b === "0.00" && hi > 0 ? "< 0.01" : a === b ? a : a + " to " + b; };
const many = (n, one, more = one + "s") => `${n} ${n === 1 ? one : more}`;
/** A height of a layer, mm, with as many places as it has (five at most, two at least). */
const height = z => z.toFixed(5).replace(/0{1,3}$/, "");
const allLayers = run => run.count === 1 ? "the only layer" : `all ${run.count} layers`;
const time = s => s >= 3600 ? `${Math.floor(s / 3600)} h ${Math.round(s % 3600 / 60)} min` : s >= 60 ? `${fixed(s / 60, 1)} min` : `${fixed(s, 1)} s`;

/** Figures of layer k: [key, label, value, digits]. Keys of both kinds of runs stand in one row where they are the same. */
function layerFigures(run, k) {
  if (run.kind === "gcode") {
    const [lo, hi] = run.area(k);
    return [["extruded_mm3", "extruded, mm³", run.volume(k), 3], ["length_mm", "tracks, mm", run.length(k), 3],
      ["hangs_mm", `of these ${lacking(run)}, mm`, run.sum(k, e => e.hangs), 3], ["area_mm2", "that hangs, mm²", (lo + hi) / 2, 3]];
  }
  const n = run.numbers(k), m = run.marks(k), inside = run.outside ? "internal supports" : "supports";
  const external = (...figure) => run.outside ? [figure] : [];
  return [["extruded_mm3", "extruded, mm³", n.extruded_mm3, 3], ["volume_mm3", "material, mm³", n.shell_volume_mm3 + n.support_volume_mm3 + externalOf(n).volume, 3], ["shell_volume_mm3", "shell and covers, mm³", n.shell_volume_mm3, 3],
    ["support_volume_mm3", `${inside}, mm³`, n.support_volume_mm3, 3], ...external("external_support_volume_mm3", "external supports, mm³", externalOf(n).volume, 3),
    ["support_length_mm", `${run.outside ? "all supports" : "supports"}, centre lines, mm`, n.support_length_mm, 3],
    ["support_printed_length_mm", `${inside} as printed, without gaps, mm`, n.support_printed_length_mm, 3],
    ...external("external_support_printed_length_mm", "external supports as printed, mm", externalOf(n).length, 3), ["trees", "trees", n.trees, 0],
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
      ["hangs_mm", `of these ${lacking(run)}, mm`, hangs, 2], ["area_mm2", "that hangs, mm²", (area[0] + area[1]) / 2, 2]];
  }
  const t = run.header.totals, inside = run.outside ? "internal supports" : "supports";
  const external = (...figure) => run.outside ? [figure] : [];
  return [["layers", "layers", t.layers, 0], ["extruded_mm3", "extruded, mm³", t.extruded_mm3, 1], ["material_mm3", "material, mm³", t.material_mm3, 1], ["shell_volume_mm3", "shell and covers, mm³", t.shell_volume_mm3, 1],
    ["support_volume_mm3", `${inside}, mm³`, t.support_volume_mm3, 1], ...external("external_support_volume_mm3", "external supports, mm³", externalOf(t).volume, 1),
    ["support_printed_length_mm", `${inside} as printed, mm`, t.support_printed_length_mm, 0], ...external("external_support_printed_length_mm", "external supports as printed, mm", externalOf(t).length, 0),
    ["filament_mm", "filament, m", t.filament_mm / 1000, 2], ["print_seconds", "print time, min", t.print_seconds / 60, 0]];
}

/** What of a layer or of the whole run external supports are; files from before there were any do not name them. */
const externalOf = n => ({ volume: n.external_support_volume_mm3 || 0, length: n.external_support_printed_length_mm || 0 });

/** Of G-code: what hangs, by the rule that it was judged by. */
const lacking = run => run.apart ? "not held up by these rules" : "without material within ρ below";

/** Where external supports stand off the object, what is proved of what lies outside; the words of pipeline/summary.cpp. */
function outsideProved(run) {
  const words = [];
  if (run.reach > run.rho) words.push(`across the removal gap: outside, all is within ρ of a support or within ${+run.reach.toFixed(5)} mm (g + r) of the object`);
  if (run.emptyLayers > 0) words.push(`through the layers left empty: outside, the object lies on a support, on itself or on the bed at most ${many(run.emptyLayers, "layer")} farther down`);
  if (run.bedOnly) words.push("on the bed alone: external supports stand on each other, nowhere on the object");
  return words.join("; ");
}

/** Layers whose print begins in the air over places too narrow to print; files from before they were named have none. */
const overNarrowPlaces = run => run.header.verdict.print.layers_over_narrow_places || [];

function runVerdict(run) {
  if (run.kind === "gcode") return run.good ? `Supported on ${allLayers(run)}${passed(run)}${run.apart ? ", by the rules that follow" : ""}.` : run.facts.verdict;
  const v = run.header.verdict, outside = v.external_overhangs.length;
  const bad = new Set([...v.layers_refuted, ...v.print.layers_refuted]).size;
  if (!run.good)
    return v.proved ? `Proved as geometry; of what is extruded something hangs on ${v.print.layers_refuted.length} of ${many(run.count, "layer")}.` : `Not proved on ${bad} of ${many(run.count, "layer")}.`;
  if (run.apart)
    return `Proved on ${allLayers(run)}, as geometry and as printed: inside, every point has material within ρ below; ${outsideProved(run)}.`;
  return `Proved: every point of ${allLayers(run)} has material within ρ below, as geometry and as printed` +
    (run.bedOnly ? `; ${outsideProved(run)}` : outside > 0 ? `, but for what overhangs outside on ${many(outside, "layer")}` : "") +
    (overNarrowPlaces(run).length > 0 ? ", but not over places too narrow to print." : ".");
}

/** What hangs in G-code that is supported all the same: what the options of `ribvault verify` let pass. */
function passed(run) {
  let bridged = 0, hangs = 0;
  for (let k = 0; k < run.count; ++k) bridged += run.bridged(k), hangs += run.area(k)[1];
  return hangs > 0 ? ", but for regions that --min-area lets pass" : bridged > 0 ? `, but for ${fixed(bridged, 1)} mm of bridges` : "";
}

function runWords(run) {
  if (run.kind === "gcode") return run.facts.words;
  const s = run.header.settings, verdict = run.header.verdict, v = verdict.external_overhangs.length, near = (verdict.layers_with_patches_in_gap || []).length;
  const how = s.propagation === "shrink" ? "thrifty" : s.straighten ? "straightened" : "not straightened";
  const thin = run.wall < run.nozzle ? ` (supports ${run.wall} mm)` : "";
  const bare = bareLayers(run).length;
  const wide = s.wall_lines > 1 ? `, ${s.wall_lines} side by side in long or tall walls` : "";
  return `Layers of ${s.layer_height_mm} mm, tracks of ${s.nozzle_mm} mm${thin}${wide}, ρ = ${s.support_radius_mm} mm; ` +
    `supports ${how}, gaps ${s.gaps}, seed ${s.seed}.` +
    (bare === 0 ? "" : ` Nothing is printed on ${many(bare, "layer")}, without room for a track.`) +
    (v === 0 ? "" : !run.outside ? ` The outside overhangs on ${many(v, "layer")}, which no internal support can hold.`
      : run.reach > run.rho ? ` On ${many(v, "layer")} there are crevices where the gap leaves no room for a support within ρ.` : ` Something outside has no support on ${many(v, "layer")}.`) +
    (near > 0 ? ` On ${many(near, "layer")} the object is too thin to be printed as thin as it is, and its tracks come nearer to a support than the gap.` : "");
}

/** Which layer external supports hold up. */
const whichAbove = run => run.emptyLayers > 0 ? "over the gap" : "above";

/** The verdict on layer k in two or three words. */
function layerVerdict(run, k) {
  if (run.kind === "gcode") return !run.refuted(k) ? k === 0 ? "on the bed" : run.bridged(k) > 0 ? "supported, but for bridges" : "supported" : run.good ? "hangs, as --min-area lets it" : "hangs";
  if (run.refuted(k)) return "not proved";
  if (overNarrowPlaces(run).includes(k)) return "proved, but begins in the air";
  if (run.numbers(k).empty) return "nothing is printed";
  return k === 0 ? "on the bed" : !run.hangs(k) ? "proved" : run.outside ? "proved, but for crevices" : "proved inside, overhangs outside";
}

function heading(run, k) { return `layer ${k}, z ${height(run.bottom(k))} to ${height(run.top(k))} mm: ${layerVerdict(run, k)}`; }

/** Layers on which nothing is printed but skirt and brim; files from before they were marked have none. */
const bareLayers = run => Array.from({ length: run.count }, (_, k) => k).filter(k => run.numbers(k).empty);

/** What is proved of layer k. */
function layerProof(run, k) {
  if (run.refuted(k))
    return run.numbers(k).verdict.supported ? "Proved as geometry; of what is extruded something hangs." : run.outside ? "Not proved: something has no support." : "Not proved: something inside has no material within ρ below.";
  if (k === 0) return "The layer lies on the bed.";
  const alone = run.bedOnly ? ", external supports over external supports alone" : "";
  if (overNarrowPlaces(run).includes(k)) return `Proved over layer ${k - 1} as geometry; some of what is printed begins in the air, over places of layer ${k - 1} too narrow to print.`;
  if (!run.apart) return `Proved over layer ${k - 1}, as geometry and as printed${alone}.`;
  const reach = run.reach > run.rho ? `within ρ of a support or within ${+run.reach.toFixed(5)} mm of the object` : "within ρ of a support or of the object";
  const lowest = k - 1 - run.emptyLayers;
  const where = run.emptyLayers === 0 ? `on layer ${k - 1}` : lowest < 0 ? "below, or over the bed by no more than the gap" : `on layers ${lowest} to ${k - 1}`;
  return `Proved, as geometry and as printed: inside over layer ${k - 1}; outside all is ${reach} ${where}${alone}.`;
}

/** What the pictures of layer k show. */
function layerWords(run, k) {
  if (run.kind === "gcode") {
    const [lo, hi] = run.area(k), length = run.length(k), bridged = run.bridged(k), rest = bridged > 0 ? ` ${fixed(bridged, 2)} mm are bridges.` : "";
    const held = run.apart ? "All of it is held up by these rules." : bridged > 0 ? "All of it but the bridges is held up." : "All of it is held up.";
    const none = run.apart ? "are not held up by these rules" : `have no material within ${+run.rho.toFixed(4)} mm below`;
    return `${fixed(length, 1)} mm of tracks. ` + (run.hangs(k) ? `${fixed(run.sum(k, e => e.hangs), 2)} mm of their centre lines and ${range(lo, hi)} mm² of their area ${none}.` : held) + rest;
  }
  const n = run.numbers(k), m = run.marks(k), s = run.shapes(k);
  const places = s.unsupported.filter(c => areaOf([c]) > 0).length;
  const wide = n.wide_trees > 0 ? `, ${n.wide_trees} of them ${+run.wideWall.toFixed(3)} mm wide,` : "";
  const supports = n.trees === 0 ? "No supports on this layer." :
    `${many(n.trees, "support tree")}${wide} with ${fixed(n.support_length_mm, 1)} mm: ${many(m.roots.length, "root")}, ` +
    `${many(m.junctions.length, "junction")}, ${many(m.tips.length, "tip")}${m.dots.length ? ", " + many(m.dots.length, "dot") : ""}.`;
  const grown = places === 0 ? "Nothing new had to be held up." : `Newly supported for the layer ${whichAbove(run)}: ${many(places, "place")}, at most ${fixed(run.newArea(k), 2)} mm².`;
  const out = n.verdict.external;
  const narrow = !n.thin_places ? "" : ` ${many(n.thin_places, "place")}, ${fixed(n.thin_area_mm2, 2)} mm² in all, ${n.thin_places === 1 ? "is" : "are"} too narrow for a track.`;
  const mended = (n.closings.length > 0 ? ` ${many(n.closings.length, "gap")} in open contours ${n.closings.length === 1 ? "was" : "were"} closed.` : "") +
    (n.slivers_removed ? " Slits and slivers narrower than 0.4 µm are gone." : "");
  return `${layerProof(run, k)} ${n.empty ? "Nothing is printed on it." : `Shell of ${fixed(n.shell_volume_mm3, 2)} mm³.`} ${supports} ${grown}${narrow}${mended}` +
    (out ? ` Outside, ${range(out.area_mm2[0], out.area_mm2[1])} mm² ${run.outside ? "have no support" : "hang over the layer below"}.` : "") +
    (n.patch_in_gap ? " Tracks of the object come nearer to a support than the gap." : "");
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
  const bare = bareLayers(run);
  if (bare.length > 0) list.push([bare[0], bare.length === 1 ? "nothing is printed" : `nothing is printed, as on ${many(bare.length - 1, "layer")} more`]);
  most(k => run.numbers(k).support_length_mm, v => `most supports, ${fixed(v, 1)} mm`);
  most(k => run.numbers(k).trees, v => `most trees, ${v}`);
  most(k => run.numbers(k).verdict.external ? run.numbers(k).verdict.external.area_mm2[1] : 0, v => `${run.outside ? "most without support" : "largest overhang"} outside, up to ${fixed(v, 1)} mm²`);
  most(k => run.numbers(k).thin_places || 0, v => `${many(v, "place")} too narrow to print`);
  most(k => run.numbers(k).closings.length, v => `${many(v, "gap")} closed`);
  return list;
}
