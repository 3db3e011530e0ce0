// The bytes of a run: records of two texts each (numbers as JSON, geometry), numbers as report/packed.hpp writes them.

/** Bytes of a deflate stream (zlib format) in base64. */
async function inflated(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

class Unpacker {
  constructor(bytes) { this.bytes = bytes; this.at = 0; this.x = 0; this.y = 0; }
  get done() { return this.at >= this.bytes.length; }
  natural() {
    let n = 0, scale = 1, b;
    do { b = this.bytes[this.at++]; n += (b & 127) * scale; scale *= 128; } while (b & 128);
    return n;
  }
  whole() { const n = this.natural(); return n % 2 ? -(n + 1) / 2 : n / 2; }
  slice() { const n = this.natural(), from = this.at; this.at += n; return this.bytes.subarray(from, this.at); }
  /** `n` points as x, y, x, y in mm; a point that equals the one before stays. */
  points(n) {
    const out = new Float32Array(2 * n);
    for (let k = 0; k < 2 * n; k += 2) {
      out[k] = (this.x += this.whole()) / 100;
      out[k + 1] = (this.y += this.whole()) / 100;
    }
    return out;
  }
  /** Widens a box, in hundredths of mm, by `n` points. */
  pointsWithin(n, box) {
    for (; n > 0; --n) {
      const x = this.x += this.whole(), y = this.y += this.whole();
      if (x < box[0]) box[0] = x;
      if (x > box[2]) box[2] = x;
      if (y < box[1]) box[1] = y;
      if (y > box[3]) box[3] = y;
    }
  }
  regionWithin(box) { for (let n = this.natural(); n > 0; --n) this.pointsWithin(this.natural(), box); }
  region() { return Array.from({ length: this.natural() }, () => this.points(this.natural())); }
  /** Whole numbers, each relative to the one before. */
  rising(n) { let v = 0; return Uint32Array.from({ length: n }, () => v += this.whole()); }
}

/** [{numbers, geometry}] of a run. */
function records(bytes) {
  const all = [], in_ = new Unpacker(bytes), utf8 = new TextDecoder();
  while (!in_.done) all.push({ numbers: JSON.parse(utf8.decode(in_.slice())), geometry: in_.slice() });
  return all;
}

/** Geometry of a layer of a layers file. Regions are lists of contours; `edges` holds pairs of vertices; `wide`, per
 *  vertex: its tree is printed with several tracks side by side. */
function shapesFrom(geometry) {
  const in_ = new Unpacker(geometry);
  const slice = in_.region(), cavity = in_.region(), vertices = in_.points(in_.natural()), roots = in_.rising(in_.natural());
  const count = in_.natural(), edges = new Uint32Array(2 * count);
  for (let k = 0, a = 0; k < count; ++k) { a += in_.whole(); edges[2 * k] = a; edges[2 * k + 1] = a + in_.whole(); }
  const unsupported = in_.region(), patches = in_.points(2 * in_.natural()), wide = new Uint8Array(vertices.length / 2);
  if (!in_.done) for (const v of in_.rising(in_.natural())) wide[v] = 1;
  return { slice, cavity, vertices, roots, edges, unsupported, patches, wide };
}

/** Geometry of a printed layer: [{feature, width in mm, points}]. */
function linesFrom(geometry) {
  const in_ = new Unpacker(geometry);
  return Array.from({ length: in_.natural() }, () => ({ feature: in_.natural(), width: in_.natural() / 1000, points: in_.points(in_.natural()) }));
}
