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

/** Branch-free chains of a support forest as x, y pairs; dots are chains of one point. */
function chainsOf(shapes) {
  const { degree, next } = forestOf(shapes), v = shapes.vertices, chains = [];
  for (let a = 0; a < degree.length; ++a) {
    if (degree[a] === 2) continue;
    if (degree[a] === 0) chains.push(Float32Array.of(v[2 * a], v[2 * a + 1]));
    for (const b of next[a]) {
      const chain = [a, b];
      for (let last = b; degree[last] === 2; last = chain[chain.length - 1]) chain.push(next[last][0] === chain[chain.length - 2] ? next[last][1] : next[last][0]);
      if (chain[chain.length - 1] > a) chains.push(Float32Array.from(chain.flatMap(i => [v[2 * i], v[2 * i + 1]])));
    }
  }
  return chains;
}

/** A growing list of triangles. */
class Triangles {
  constructor() { this.reserve(1 << 12, 1 << 13); this.corners = 0; this.indices = 0; }
  reserve(corners, indices) {
    const grown = (Kind, old, size) => { const fresh = new Kind(size); if (old) fresh.set(old.subarray(0, size)); return fresh; };
    this.position = grown(Float32Array, this.position, 3 * corners);
    this.normal = grown(Int8Array, this.normal, 4 * corners);
    this.index = grown(Uint32Array, this.index, indices);
  }
  room(corners, indices) {
    const c = 3 * (this.corners + corners) > this.position.length, i = this.indices + indices > this.index.length;
    if (c || i) this.reserve(c ? 2 * (this.corners + corners) : this.position.length / 3, i ? 2 * (this.indices + indices) : this.index.length);
  }
  corner(x, y, z, nx, ny, nz) {
    const k = this.corners++;
    this.position[3 * k] = x; this.position[3 * k + 1] = y; this.position[3 * k + 2] = z;
    this.normal[4 * k] = 127 * nx; this.normal[4 * k + 1] = 127 * ny; this.normal[4 * k + 2] = 127 * nz;
    return k;
  }
  triangle(a, b, c) { this.index[this.indices++] = a; this.index[this.indices++] = b; this.index[this.indices++] = c; }
  quad(a, b, c, d) { this.triangle(a, b, c); this.triangle(a, c, d); }

  /** The wall over a closed contour, seen from its right. Corners sharper than about 40 degrees stay sharp. */
  wall(c, z0, z1) {
    const n = c.length / 2, from = new Int32Array(n), to = new Int32Array(n);  // corners with which side k begins, and the one before it ends
    this.room(4 * n, 6 * n);
    const side = k => {
      const a = 2 * k, b = 2 * ((k + 1) % n), l = Math.hypot(c[b] - c[a], c[b + 1] - c[a + 1]) || 1;
      return [(c[b + 1] - c[a + 1]) / l, (c[a] - c[b]) / l];
    };
    const pair = (k, x, y) => { const at = this.corner(c[2 * k], c[2 * k + 1], z0, x, y, 0); this.corner(c[2 * k], c[2 * k + 1], z1, x, y, 0); return at; };
    for (let k = 0, before = side(n - 1); k < n; ++k) {
      const after = side(k), x = before[0] + after[0], y = before[1] + after[1], l = Math.hypot(x, y);
      if (l > 1.88) from[k] = to[k] = pair(k, x / l, y / l);
      else { to[k] = pair(k, ...before); from[k] = pair(k, ...after); }
      before = after;
    }
    for (let k = 0; k < n; ++k) { const p = from[k], q = to[(k + 1) % n]; this.quad(p, q, q + 1, p + 1); }
  }
  /** A level face: contours of slice and cavity, outer ones counter-clockwise. Left out where simplified contours cross. */
  face(region, z) {
    const area = (a, b, c) => Math.abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
    for (const { outer, holes } of nested(region)) {
      const vectors = c => Array.from({ length: c.length / 2 }, (_, k) => new THREE.Vector2(c[2 * k], c[2 * k + 1]));
      const o = vectors(outer), h = holes.map(vectors), faces = THREE.ShapeUtils.triangulateShape(o, h), all = [o, ...h].flat();
      const covered = faces.reduce((s, [a, b, c]) => s + area(all[a], all[b], all[c]), 0), wanted = areaOf([outer, ...holes]);
      if (Math.abs(covered - wanted) > 0.05 * wanted) continue;
      this.room(all.length, 3 * faces.length);
      const first = this.corners;
      for (const p of all) this.corner(p.x, p.y, z, 0, 0, 1);
      for (const [a, b, c] of faces) this.triangle(first + a, first + b, first + c);
    }
  }
  /** A track: both sides and its top. */
  track(points, width, z0, z1) {
    if (points.length === 2) {
      const [x, y] = points, w = 0.35 * width;
      const square = Float32Array.of(x - w, y - w, x + w, y - w, x + w, y + w, x - w, y + w);
      this.wall(square, z0, z1);
      return this.face([square], z1);
    }
    const n = points.length / 2;
    this.room(6 * n, 18 * n);
    let first = -1;
    for (let k = 0; k < n; ++k) {
      const a = 2 * Math.max(0, k - 1), b = 2 * k, c = 2 * Math.min(n - 1, k + 1), x = points[b], y = points[b + 1];
      const unit = (dx, dy) => { const l = Math.hypot(dx, dy) || 1; return [dx / l, dy / l]; };
      const u = unit(x - points[a], y - points[a + 1]), v = unit(points[c] - x, points[c + 1] - y), [tx, ty] = unit(u[0] + v[0], u[1] + v[1]);
      const cos = Math.max(0.5, k === 0 || k === n - 1 ? 1 : tx * v[0] + ty * v[1]), w = width / 2 / cos, nx = ty, ny = -tx;
      const at = this.corner(x + w * nx, y + w * ny, z0, nx, ny, 0);
      this.corner(x + w * nx, y + w * ny, z1, nx, ny, 0);
      this.corner(x - w * nx, y - w * ny, z0, -nx, -ny, 0);
      this.corner(x - w * nx, y - w * ny, z1, -nx, -ny, 0);
      this.corner(x + w * nx, y + w * ny, z1, 0, 0, 1);
      this.corner(x - w * nx, y - w * ny, z1, 0, 0, 1);
      if (first >= 0) {
        const p = first, q = at;
        this.quad(p, q, q + 1, p + 1); this.quad(q + 2, p + 2, p + 3, q + 3); this.quad(p + 4, q + 4, q + 5, p + 5);
      }
      first = at;
    }
  }
  geometry() {
    const g = new THREE.BufferGeometry();
    g.setAttribute("position", new THREE.BufferAttribute(this.position.slice(0, 3 * this.corners), 3));
    g.setAttribute("normal", new THREE.BufferAttribute(this.normal.slice(0, 4 * this.corners), 4, true));
    g.setIndex(new THREE.BufferAttribute(this.index.slice(0, this.indices), 1));
    return g;
  }
}

const reversed = c => { const r = new Float32Array(c.length); for (let k = 0; k < c.length; k += 2) { r[k] = c[c.length - 2 - k]; r[k + 1] = c[c.length - 1 - k]; } return r; };

function inside(x, y, c) {
  let odd = false;
  for (let k = 0, n = c.length; k < n; k += 2) {
    const ax = c[k], ay = c[k + 1], bx = c[(k + 2) % n], by = c[(k + 3) % n];
    if (ay > y !== by > y && x < ax + (y - ay) * (bx - ax) / (by - ay)) odd = !odd;
  }
  return odd;
}

/** Outer contours with the holes directly inside them. */
function nested(region) {
  const sized = region.filter(c => c.length >= 6).map(c => ({ outer: c, area: areaOf([c]), holes: [] }));
  const outers = sized.filter(s => s.area > 0).sort((a, b) => a.area - b.area);
  for (const hole of sized.filter(s => s.area < 0)) outers.find(o => o.area > -hole.area && inside(hole.outer[0], hole.outer[1], o.outer))?.holes.push(hole.outer);
  return outers;
}

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
    return { shell: [...s.slice, ...s.cavity.map(reversed)], walls: chainsOf(s).map(points => ({ points, width: run.nozzle })), skin: [] };
  }
  const inner = new Set(["infill", "support", "bridge"]), walls = [], skin = [];
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
