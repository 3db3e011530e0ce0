// Slider, keys, links and play: everything that chooses the layer.

class Controls {
  /** `steps`: how many layers the slider has; `show(step)` shows one; `hangs(step)`: for n and p. */
  constructor(steps, show, hangs, played) {
    Object.assign(this, { steps, show, hangs, played, step: -1, timer: 0 });
    this.slider = $("slider"); this.number = $("number"); this.button = $("play");
    this.slider.max = this.number.max = steps - 1;
    this.slider.oninput = () => this.by(() => +this.slider.value);
    this.number.onchange = () => this.by(() => +this.number.value);
    $("below").onclick = () => this.by(s => s - 1);
    $("above").onclick = () => this.by(s => s + 1);
    this.button.onclick = () => this.timer ? this.stop() : this.play();
    document.addEventListener("keydown", e => this.key(e));
    window.addEventListener("hashchange", () => { const s = this.linked(); if (s !== null) this.by(() => s); });
  }
  linked() {
    const found = /^#layer=(\d+)$/.exec(location.hash);
    return found ? +found[1] : null;
  }
  /** The user chose: playing stops. */
  by(next) { this.stop(); this.go(next(this.step)); }
  go(step) {
    step = Math.max(0, Math.min(this.steps - 1, Math.round(step) || 0));
    if (step === this.step) { this.number.value = step; return; }
    this.step = step;
    this.slider.value = this.number.value = step;
    $("below").disabled = step === 0; $("above").disabled = step === this.steps - 1;
    clearTimeout(this.link);  // browsers limit how often an address may change
    this.link = setTimeout(() => history.replaceState(null, "", "#layer=" + this.step), 150);
    this.show(step);
  }
  /** From the shown layer down to the bed, from the top where it is at the bed already; at most ten seconds or ten layers a second. */
  play() {
    if (this.step === 0) this.go(this.steps - 1);
    this.pressed(true);
    const start = performance.now(), from = this.step, rate = Math.max(10, this.steps / 15);  // layers a second
    const tick = () => {
      this.go(Math.max(0, from - Math.floor((performance.now() - start) / 1000 * rate)));
      if (this.step === 0) return this.stop();
      this.timer = requestAnimationFrame(tick);
    };
    this.timer = requestAnimationFrame(tick);
  }
  stop() {
    if (!this.timer) return;
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.pressed(false);
  }
  pressed(on) {
    this.button.setAttribute("aria-pressed", on);
    this.button.lastElementChild.textContent = on ? "Stop" : "Play down";
    this.button.querySelector("path").setAttribute("d", on ? "M3 3h10v10H3z" : "M3 2l11 6-11 6z");
    this.played(on);
  }
  search(direction) {
    for (let s = this.step + direction; s >= 0 && s < this.steps; s += direction) if (this.hangs(s)) return s;
    return this.step;
  }
  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || e.shiftKey) return;
    const at = e.target.tagName, keys = { n: () => this.by(() => this.search(1)), p: () => this.by(() => this.search(-1)) };
    if (at !== "SELECT" && e.target !== this.number)
      Object.assign(keys, { ArrowLeft: () => this.by(s => s - 1), ArrowDown: () => this.by(s => s - 1), ArrowRight: () => this.by(s => s + 1), ArrowUp: () => this.by(s => s + 1),
        PageDown: () => this.by(s => s - 10), PageUp: () => this.by(s => s + 10), Home: () => this.by(() => 0), End: () => this.by(() => this.steps - 1) });
    if (!["BUTTON", "A", "SELECT"].includes(at) && at !== "INPUT" || e.target === this.slider) keys[" "] = () => this.button.click();
    if (keys[e.key]) { e.preventDefault(); keys[e.key](); }
  }
}
