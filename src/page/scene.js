// The model in 3D: the shell with one half cut away, the walls inside, the layer that is shown.

class ModelView {
  /** `changed`: the camera moved. */
  constructor(canvas, run, progress) {
    Object.assign(this, { canvas, run, cut: "front", peel: false, layer: run.count - 1, ready: false });
    const [x0, y0, x1, y1] = run.box;
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.height = run.top(run.count - 1);
    this.size = Math.hypot(x1 - x0, y1 - y0, this.height);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.localClippingEnabled = true;
    this.camera = new THREE.PerspectiveCamera(30, 1, this.size / 100, this.size * 20);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.scene = new THREE.Scene();
    this.light = new THREE.DirectionalLight(0xffffff, 2.1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8890a0, 1.5), this.light);
    this.cutPlane = new THREE.Plane();
    this.topPlane = new THREE.Plane(new THREE.Vector3(0, 0, -1), this.height);
    const material = () => new THREE.MeshLambertMaterial({ side: THREE.DoubleSide });
    this.materials = { shell: material(), walls: material(), skin: material(), layer: material(), section: new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }) };
    this.meshes = {};
    this.look();
    this.show();
    this.listen();
    this.built = this.build(progress);
  }

  /** Builds the meshes a few layers at a time, so that the page answers meanwhile. */
  async build(progress) {
    const { run } = this, groups = groupsOf(run.count), tolerance = toleranceOf(run, groups, this.size);
    const parts = { shell: new Triangles(), walls: new Triangles(), skin: new Triangles() };
    this.sections = [];  // simplified shell contours, for the cut
    let since = performance.now();
    for (let g = 0; g < groups.length; ++g) {
      const [first, last] = groups[g], z0 = run.bottom(first), z1 = run.top(last), p = partsOf(run, last);
      const shell = p.shell.map(c => simplified(c, tolerance.shell, true));
      for (const c of shell) parts.shell.wall(c, z0, z1);
      if (shell.length) parts.shell.face(shell, z1);
      this.sections.push({ z0, z1, shell });
      for (const part of ["walls", "skin"]) for (const l of p[part]) parts[part].track(simplified(l.points, tolerance[part], false), l.width, z0, z1);
      if (performance.now() - since < 30) continue;
      progress(g / groups.length);
      await new Promise(resolve => setTimeout(resolve));
      since = performance.now();
    }
    this.triangles = 0;
    for (const part of Object.keys(parts)) if (parts[part].indices > 0) this.put(part, parts[part]);
    this.ready = true;
    this.show();
    progress(1);
  }
  put(name, triangles) {
    if (this.meshes[name]) { this.scene.remove(this.meshes[name]); this.meshes[name].geometry.dispose(); }
    const mesh = this.meshes[name] = new THREE.Mesh(triangles.geometry(), this.materials[name]);
    mesh.position.set(-this.middle[0], -this.middle[1], 0);
    this.scene.add(mesh);
    this.triangles = (this.triangles || 0) + triangles.indices / 3;
  }

  /** Colours, and what is cut away. */
  show() {
    const colour = colours();
    this.scene.background = new THREE.Color(colour("paper"));
    for (const [name, token] of Object.entries({ shell: "model-shell", skin: "model-shell", walls: "model-walls", layer: "model-layer", section: "model-cut" }))
      this.materials[name].color.set(colour(token));
    const normal = { front: [0, 1], left: [1, 0], back: [0, -1], right: [-1, 0] }[this.cut];
    if (normal) this.cutPlane.set(new THREE.Vector3(...normal, 0), 0);
    this.topPlane.constant = this.peel && this.layer >= 0 ? this.run.top(this.layer) : this.height + 1;
    const half = normal ? [this.cutPlane] : [];
    for (const name of ["shell", "skin"]) this.materials[name].clippingPlanes = [...half, this.topPlane];
    this.materials.walls.clippingPlanes = this.materials.section.clippingPlanes = [this.topPlane];
    for (const name of ["shell", "skin"]) if (this.meshes[name]) this.meshes[name].visible = this.cut !== "hidden";
    if (this.ready) this.section(normal);
    this.draw();
  }
  /** Where the cut meets the shell's material: between every second crossing of its contours. */
  section(normal) {
    const drawn = this.cut + this.sections.length;
    if (this.meshes.section) this.meshes.section.visible = Boolean(normal);
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

  /** Shows layer k (-1: none at this height) as it is, in its own colour. */
  go(k) {
    this.layer = k;
    const out = new Triangles();
    if (k >= 0) {
      const p = partsOf(this.run, k), z0 = this.run.bottom(k), z1 = this.run.top(k) + this.size / 3000;
      for (const c of p.shell) out.wall(c, z0, z1);
      if (p.shell.length) out.face(p.shell, z1);
      for (const l of [...p.walls, ...p.skin]) out.track(l.points, l.width, z0, z1);
    }
    this.put("layer", out);
    this.topPlane.constant = this.peel && k >= 0 ? this.run.top(k) : this.height + 1;
    this.draw();
  }

  look() {
    const d = 2.05 * this.size, turn = { left: [-0.85, -0.38], back: [0.38, 0.85], right: [0.85, 0.38] }[this.cut] || [0.38, -0.85];
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
    this.draw();
  }

  draw() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => { this.queued = false; this.render(); });
  }
  render() {
    const { canvas, camera, renderer } = this, w = canvas.clientWidth, h = canvas.clientHeight;
    if (w === 0 || h === 0) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    if (this.drawnSize !== `${w} ${h} ${ratio}`) {
      this.drawnSize = `${w} ${h} ${ratio}`;
      renderer.setPixelRatio(ratio);
      renderer.setSize(w, h, false);
      camera.aspect = w / h;
      camera.fov = camera.aspect < 1 ? 30 / camera.aspect ** 0.8 : 30;
      camera.updateProjectionMatrix();
    }
    this.light.position.copy(camera.position).add(new THREE.Vector3(0, 0, this.size));
    renderer.render(this.scene, camera);
  }
  listen() {
    this.canvas.addEventListener("keydown", e => {
      const keys = { "+": () => this.zoom(1.2), "=": () => this.zoom(1.2), "-": () => this.zoom(1 / 1.2), "0": () => this.look() };
      if (e.shiftKey) Object.assign(keys, { ArrowLeft: () => this.turn(-0.15, 0), ArrowRight: () => this.turn(0.15, 0), ArrowUp: () => this.turn(0, 0.12), ArrowDown: () => this.turn(0, -0.12) });
      if (keys[e.key] && !e.ctrlKey && !e.metaKey && !e.altKey) { e.preventDefault(); e.stopPropagation(); keys[e.key](); }
    });
  }
}
