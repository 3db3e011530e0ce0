// What colours and marks of the drawings mean.

const markShapes = {
  root: '<rect x="7" y="4" width="10" height="10"/>', junction: '<circle cx="12" cy="9" r="5.5"/>', tip: '<path d="M12 3l6 11H6z"/>',
  dot: '<path d="M12 2l7 7-7 7-7-7z"/>', area: '<rect x="2" y="3" width="20" height="12" rx="3"/>', line: '<rect x="1" y="7.5" width="22" height="3"/>',
};
const legends = {
  layers: [["area", "shell", "shell"], ["area", "track", "support track"], ["line", "line", "centre line"], ["root", "root", "root"], ["junction", "junction", "junction"],
    ["tip", "tip", "tip"], ["dot", "dot", "dot"], ["area", "hang", run => `newly supported for the layer ${whichAbove(run)}`], ["area", "patch", "patch"], ["area", "overhang", "overhangs outside"]],
  gcode: [["area", "below", "material below"], ["area", "track", "track"], ["area", "other", "not judged"], ["area", "hang", lacking], ["line", "bridge", "bridge"]],
};
function legend(run) {
  const row = made("div", { class: "row legend" });
  for (const [shape, colour, words] of legends[run.kind]) {
    if (colour === "bridge" && !run.facts.bridges) continue;
    if (colour === "overhang" && run.header.verdict.external_overhangs.every(o => !run.overhangs(o.layer))) continue;
    const entry = made("span", {}, typeof words === "function" ? words(run) : words);
    entry.insertAdjacentHTML("afterbegin", `<svg aria-hidden="true" viewBox="0 0 24 18" fill="var(--${colour})">${markShapes[shape]}</svg>`);
    row.append(entry);
  }
  return row;
}
