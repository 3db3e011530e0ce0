// Contours and tracks extruded to triangles.

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
