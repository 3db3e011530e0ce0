// Triangles of a model from its layers: every contour and track extruded by its layer's height. Large models are drawn from
// fewer layers and simpler lines, so that any model opens and turns quickly.

/** How much of a model is drawn: all that a screen shows; and what a machine without a graphics processor turns quickly. */
const fine = { layers: 1600, trackLayers: 400, shell: 220000, tracks: 90000 }, coarse = { layers: 60, trackLayers: 60, shell: 2500, tracks: 2500 };

/** x, y pairs without those that lie within `tolerance` of the line through their neighbours (Douglas and Peucker). */
function simplified(points, tolerance, closed) {
  const n = points.length / 2;
  if (n < (closed ? 5 : 3)) return points;
  const keep = new Uint8Array(n), far = closed ? farthest(points, 0) : n - 1;
  keep[0] = keep[far] = 1;
  const stack = closed ? [[0, far], [far, n]] : [[0, far]];
  const limit = tolerance * tolerance;
  while (stack.length) {
    const [a, b] = stack.pop();
    const ax = points[2 * a], ay = points[2 * a + 1], e = 2 * (b % n), dx = points[e] - ax, dy = points[e + 1] - ay, l = dx * dx + dy * dy;
    let worst = limit, at = -1;
    for (let k = a + 1; k < b; ++k) {
      const px = points[2 * k] - ax, py = points[2 * k + 1] - ay, t = l > 0 ? Math.max(0, Math.min(1, (px * dx + py * dy) / l)) : 0;
      const d = (px - t * dx) ** 2 + (py - t * dy) ** 2;
      if (d > worst) { worst = d; at = k; }
    }
    if (at < 0) continue;
    keep[at] = 1;
    stack.push([a, at], [at, b]);
  }
  const out = [];
  for (let k = 0; k < n; ++k) if (keep[k]) out.push(points[2 * k], points[2 * k + 1]);
  return Float32Array.from(out);
}
function farthest(points, from) {
  let best = from, most = -1;
  for (let k = 0; k < points.length / 2; ++k) {
    const d = Math.hypot(points[2 * k] - points[2 * from], points[2 * k + 1] - points[2 * from + 1]);
    if (d > most) { most = d; best = k; }
  }
  return best;
}

/** Branch-free chains of a support forest as lines of x, y pairs with their widths; dots are lines of one point. */
function chainsOf(run, shapes) {
  const { degree, next } = forestOf(shapes), v = shapes.vertices, chains = [];
  const points = chain => Float32Array.from(chain.flatMap(i => [v[2 * i], v[2 * i + 1]]));
  const add = chain => chains.push({ points: points(chain), width: run.wallWidth(shapes, chain[0]) });
  for (let a = 0; a < degree.length; ++a) {
    if (degree[a] === 2) continue;
    if (degree[a] === 0) add([a]);
    for (const b of next[a]) {
      const chain = [a, b];
      for (let last = b; degree[last] === 2; last = chain[chain.length - 1]) chain.push(next[last][0] === chain[chain.length - 2] ? next[last][1] : next[last][0]);
      if (chain[chain.length - 1] > a) add(chain);
    }
  }
  return chains;
}

const reversed = c => { const r = new Float32Array(c.length); for (let k = 0; k < c.length; k += 2) { r[k] = c[c.length - 2 - k]; r[k + 1] = c[c.length - 1 - k]; } return r; };

/** Layers of which a model is drawn, at most `most`: [[first, last]]. */
function groupsOf(count, most) {
  const step = Math.max(1, Math.ceil(count / most)), groups = [];
  for (let k = 0; k < count; k += step) groups.push([k, Math.min(count, k + step) - 1]);
  return groups;
}

/** Contours and lines of layer k for the model: shell contours (slice, then cavity turned around) and tracks. */
function partsOf(run, k) {
  if (run.kind === "layers") {
    const s = shapesFrom(run.all[k].geometry);
    return { shell: [...s.slice, ...s.cavity.map(reversed)], walls: chainsOf(run, s), skin: [] };
  }
  const inner = new Set(["infill", "support"]), walls = [], skin = [];
  for (const e of run.entries[k]) for (const l of linesFrom(run.all[e].geometry)) (inner.has(run.features[l.feature].kind) ? walls : skin).push(l);
  return { shell: [], walls, skin };
}

/** A contour or a line, simplified; null: too small to be seen. */
function drawnContour(c, tolerance) {
  const s = simplified(c, tolerance, true);
  return s.length < 6 ? null : s;
}
function drawnLine(points, tolerance) {
  const s = simplified(points, tolerance, false), n = s.length;
  return n === 4 && Math.hypot(s[2] - s[0], s[3] - s[1]) < 2 * tolerance ? null : s;
}

/** What to draw of a run at a level: groups of layers, how many of them share their tracks, and how far lines may be from the true
 *  ones, mm. Found from some of the layers. The shell's contours stay within 3/4 of a track, so that they do not cross; where that
 *  leaves too many corners, more layers are drawn as one. */
function planOf(run, level, size) {
  const groups = groupsOf(run.count, level.layers), step = Math.max(1, Math.floor(groups.length / 12));
  const sample = groups.filter((_, k) => k % step === 0).map(([, last]) => partsOf(run, last)), share = groups.length / sample.length;
  const count = lines => sample.reduce((n, p) => n + lines(p).reduce((m, points) => m + (points ? points.length / 2 : 0), 0), 0) * share;
  const fit = (most, greatest, lines) => {
    let t = size / 5000;
    while (t < greatest && count(p => lines(p, t)) > most) t *= 1.4;
    return Math.min(t, greatest);
  };
  const shell = (p, t) => p.shell.map(c => drawnContour(c, t)), every = Math.ceil(groups.length / level.trackLayers), tracks = part => (p, t) => p[part].map(l => drawnLine(l.points, t));
  const tolerance = { shell: fit(level.shell, level === fine ? 0.75 * (run.nozzle || 1) : size / 40, shell), walls: fit(level.tracks * every, size / 40, tracks("walls")), skin: fit(level.tracks * every, size / 40, tracks("skin")) };
  const layers = Math.max(1, Math.floor(groups.length / Math.max(1, count(p => shell(p, tolerance.shell)) / level.shell / 1.1)));
  return level === fine && layers < groups.length ? { ...planOf(run, { ...level, layers }, size), tolerance } : { groups, every, tolerance };
}

/** Adds layers `first` to `last`, drawn as the last of them, to the triangles of the parts; the shell's simplified contours.
 *  Tracks stand from `tracksFrom` on; null: they come with a layer above. */
function addGroup(run, [first, last], tracksFrom, tolerance, parts) {
  const z0 = run.bottom(first), z1 = run.top(last), p = partsOf(run, last);
  const contours = layer => layer.shell.map(c => drawnContour(c, tolerance.shell)).filter(Boolean), shell = contours(p);
  if (first === 0 && last > 0) parts.shell.face(contours(partsOf(run, 0)), run.top(0));  // the floor
  for (const c of shell) parts.shell.wall(c, z0, z1);
  if (shell.length) parts.shell.face(shell, z1);
  for (const part of tracksFrom === null ? [] : ["walls", "skin"])
    for (const l of p[part]) { const points = drawnLine(l.points, tolerance[part]); if (points) parts[part].track(points, l.width, tracksFrom, z1); }
  return { z0, z1, shell };
}
