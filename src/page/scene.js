// The model in 3D: the shell with one half cut away, the walls inside, the layer that is shown.

class ModelView {
  /** `extent`: size of the largest run on the page, mm: {x, y, z}; `progress(share)` is told while the model is built. */
  constructor(canvas, run, extent, progress) {
    Object.assign(this, { canvas, run, cut: extent.y > extent.x ? "left" : "front", peel: false, layer: run.count - 1, ready: false, slow: false, moving: false, meshes: {} });
    const [x0, y0, x1, y1] = run.box;
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.height = run.top(run.count - 1);
    this.size = Math.hypot(extent.x, extent.y, extent.z);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.localClippingEnabled = true;
    this.camera = new THREE.PerspectiveCamera(30, 1, this.size / 100, this.size * 20);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw(true));
    this.scene = new THREE.Scene();
    this.light = new THREE.DirectionalLight(0xffffff, 2.0);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x586070, 1.3), this.light);
    this.cutPlane = new THREE.Plane();
    this.topPlane = new THREE.Plane(new THREE.Vector3(0, 0, -1), this.height);
    const material = () => new THREE.MeshLambertMaterial({ side: THREE.DoubleSide });
    this.materials = { shell: material(), walls: material(), skin: material(), layer: material(), section: new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }) };
    this.look();
    this.show();
    this.listen();
    this.built = this.build(progress);
  }

  /** Builds the coarse model at once, then the fine one a few layers at a time, so that the page answers meanwhile. */
  async build(progress) {
    const { run } = this;
    let since = performance.now();
    for (const level of [coarse, fine]) {
      const { groups, every, tolerance } = planOf(run, level, this.size);
      const parts = { shell: new Triangles(), walls: new Triangles(), skin: new Triangles() }, sections = [];
      for (let g = 0; g < groups.length; ++g) {
        const tracks = g % every === every - 1 || g + 1 === groups.length;
        sections.push(addGroup(run, groups[g], tracks ? run.bottom(groups[g - g % every][0]) : null, tolerance, parts));
        if (performance.now() - since < 30) continue;
        progress(level === fine ? g / groups.length : 0);
        await new Promise(resolve => setTimeout(resolve));
        since = performance.now();
      }
      for (const part of Object.keys(parts)) if (parts[part].indices > 0) this.put(part, parts[part], level);
      if (level === coarse) this.coarseTolerance = tolerance;
      this.sections = sections;
      this.show();
    }
    this.ready = true;
    progress(1);
    this.render();
    await this.finished();
  }
  /** Replaces a mesh; `level`: of the model, which of them is drawn depends on the machine. */
  put(name, triangles, level = null) {
    const key = level === coarse ? "coarse " + name : name;
    if (this.meshes[key]) { this.scene.remove(this.meshes[key]); this.meshes[key].geometry.dispose(); }
    const mesh = this.meshes[key] = new THREE.Mesh(triangles.geometry(), this.materials[name]);
    mesh.position.set(-this.middle[0], -this.middle[1], 0);
    mesh.userData = { name, level };
    this.scene.add(mesh);
  }
  get triangles() { return Object.values(this.meshes).reduce((n, m) => n + (m.userData.level === coarse ? 0 : m.geometry.index.count / 3), 0); }

  /** Colours, and what is cut away. */
  show() {
    const colour = colours();
    this.scene.background = new THREE.Color(colour("paper"));
    this.scene.fog = new THREE.Fog(colour("paper"));  // what is farther away is paler
    for (const [name, token] of Object.entries({ shell: "model-shell", skin: "model-shell", walls: "model-walls", layer: "model-layer", section: "model-cut" }))
      this.materials[name].color.set(colour(token));
    const normal = { front: [0, 1], left: [1, 0], back: [0, -1], right: [-1, 0] }[this.cut];
    if (normal) this.cutPlane.set(new THREE.Vector3(...normal, 0), 0);
    this.topPlane.constant = this.peel && this.layer >= 0 ? this.run.top(this.layer) : this.height + 1;
    const half = normal ? [this.cutPlane] : [];
    for (const name of ["shell", "skin"]) this.materials[name].clippingPlanes = [...half, this.topPlane];
    this.materials.walls.clippingPlanes = this.materials.section.clippingPlanes = [this.topPlane];
    if (this.sections) this.section(normal);
    this.draw();
  }
  /** Where the cut meets the shell's material: between every second crossing of its contours. */
  section(normal) {
    const drawn = this.cut + this.sections.length;
    if (!normal || this.drawnSection === drawn) return;
    this.drawnSection = drawn;
    const along = normal[0] === 0 ? 0 : 1, across = 1 - along, at = this.middle[across], out = new Triangles();
    for (const { z0, z1, shell } of this.sections) {
      const hits = [];
      for (const c of shell)
        for (let k = 0, n = c.length; k < n; k += 2) {
          const a = c[k + across] - at, b = c[(k + 2) % n + across] - at;
          if (a > 0 !== b > 0) hits.push(c[k + along] + (c[(k + 2) % n + along] - c[k + along]) * a / (a - b));
        }
      hits.sort((p, q) => p - q);
      for (let k = 0; k + 1 < hits.length; k += 2) {
        out.room(4, 6);
        const corner = (s, z) => along === 0 ? out.corner(s, at, z, 0, 1, 0) : out.corner(at, s, z, 1, 0, 0);
        out.quad(corner(hits[k], z0), corner(hits[k + 1], z0), corner(hits[k + 1], z1), corner(hits[k], z1));
      }
    }
    this.put("section", out);
  }

  /** Shows layer k (-1: none at this height) in its own colour: as it is, or simplified while a slow machine moves. */
  go(k) {
    this.layer = k;
    this.topPlane.constant = this.peel && k >= 0 ? this.run.top(k) : this.height + 1;
    this.draw(true);
  }
  layerMesh(moving) {
    const drawn = `${this.layer} ${moving}`;
    if (this.drawnLayer === drawn) return;
    this.drawnLayer = drawn;
    const out = new Triangles(), k = this.layer;
    if (k >= 0) {
      const p = partsOf(this.run, k), z0 = this.run.bottom(k), z1 = this.run.top(k) + this.size / 3000, t = this.coarseTolerance;
      const shell = moving ? p.shell.map(c => drawnContour(c, t.shell)).filter(Boolean) : p.shell;
      for (const c of shell) out.wall(c, z0, z1);
      if (shell.length) out.face(shell, z1);
      for (const part of ["walls", "skin"])
        for (const l of p[part]) { const points = moving ? drawnLine(l.points, t[part]) : l.points; if (points) out.track(points, l.width, z0, z1); }
    }
    this.put("layer", out);
  }

  look() {
    const d = 1.85 * this.size, turn = { left: [-0.85, -0.38], back: [0.38, 0.85], right: [0.85, 0.38] }[this.cut] || [0.38, -0.85];
    this.controls.target.set(0, 0, this.height / 2);
    this.camera.position.set(d * turn[0], d * turn[1], this.height / 2 + d * 0.36);
    this.controls.update();
  }
  turn(right, up) {
    const at = this.camera.position, to = this.controls.target, x = at.x - to.x, y = at.y - to.y, c = Math.cos(right), s = Math.sin(right);
    at.x = to.x + c * x - s * y; at.y = to.y + s * x + c * y; at.z += up * this.size;
    this.controls.update();
  }
  zoom(by) { this.camera.position.sub(this.controls.target).multiplyScalar(1 / by).add(this.controls.target); this.controls.update(); }
  /** Looks from where another view looks. */
  follow(other) {
    this.camera.position.copy(other.camera.position); this.camera.quaternion.copy(other.camera.quaternion);
    this.controls.target.copy(other.controls.target);
    this.draw(true);
  }

  /** `moving`: more will follow soon. A machine that takes long for a picture draws the coarse model with fewer pixels until there is rest. */
  draw(moving = false) {
    if (moving) {
      this.moving = true;
      clearTimeout(this.rest);
      this.rest = setTimeout(() => { this.moving = false; this.draw(); }, 200);
    }
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => { this.queued = false; this.render(); });
  }
  render() {
    const { canvas, camera, renderer } = this, w = canvas.clientWidth, h = canvas.clientHeight;
    if (w === 0 || h === 0) return;
    const rough = Boolean(this.moving && this.slow), ratio = rough ? 0.5 : Math.min(2, window.devicePixelRatio || 1);
    if (this.drawnSize !== `${w} ${h} ${ratio}`) {
      this.drawnSize = `${w} ${h} ${ratio}`;
      renderer.setPixelRatio(ratio);
      renderer.setSize(w, h, false);
      camera.aspect = w / h;
      camera.fov = camera.aspect < 1 ? 30 / camera.aspect ** 0.8 : 30;
      camera.updateProjectionMatrix();
    }
    this.layerMesh(rough);
    this.choose(rough || !this.meshes.shell && !this.meshes.skin ? coarse : fine);
    this.light.position.set(-1.1 * this.size, 0, 0.5 * this.size).applyQuaternion(camera.quaternion).add(camera.position);  // over the left shoulder
    const away = camera.position.distanceTo(this.controls.target);
    this.scene.fog.near = away - 0.45 * this.size; this.scene.fog.far = away + 1.1 * this.size;
    renderer.render(this.scene, camera);
    if (!rough) this.measure();
  }
  choose(level) {
    for (const mesh of Object.values(this.meshes)) {
      const { name, level: own } = mesh.userData;
      mesh.visible = (own === null || own === level) && (name !== "section" || this.cut !== "whole" && this.cut !== "hidden") && (name === "walls" || name === "layer" || this.cut !== "hidden");
    }
  }
  /** Whether the fine model takes more than 40 ms to draw here. */
  async measure() {
    if (!this.ready) return;
    const start = performance.now();
    await this.finished();
    this.slow = performance.now() - start > 40;
  }
  /** When everything sent to the graphics processor is drawn. */
  async finished() {
    const gl = this.renderer.getContext(), fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (fence && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) await new Promise(resolve => setTimeout(resolve, 4));
    gl.deleteSync(fence);
  }
  listen() {
    this.canvas.addEventListener("keydown", e => {
      const keys = { "+": () => this.zoom(1.2), "=": () => this.zoom(1.2), "-": () => this.zoom(1 / 1.2), "0": () => this.look() };
      if (e.shiftKey) Object.assign(keys, { ArrowLeft: () => this.turn(-0.15, 0), ArrowRight: () => this.turn(0.15, 0), ArrowUp: () => this.turn(0, 0.12), ArrowDown: () => this.turn(0, -0.12) });
      if (keys[e.key] && !e.ctrlKey && !e.metaKey && !e.altKey) { e.preventDefault(); e.stopPropagation(); keys[e.key](); }
    });
  }
}
