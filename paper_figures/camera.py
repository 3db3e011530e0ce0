#!/usr/bin/python3
"""The 3D model of a run page, photographed by headless Chromium. Usage: camera.py PAGE front|left|back|right|whole|hidden PICTURE"""
import base64
import pathlib
import subprocess
import sys

import results

sys.path.insert(0, str(results.ROOT / "tests/end-to-end"))
import browser  # noqa: E402

CANVAS = "const c = [...document.querySelectorAll('canvas')].find(c => (c.getAttribute('aria-label') || '').includes(' in 3D'))"


def page_of(model, options, folder):
    """The run page of a model, with the report beside it, made when something changed."""
    program = results.program("ribvault")
    if not program.exists():
        raise results.Unusable(f"{program} is not there; scripts/paper-figures builds it")
    stamp = results.digest(program.read_bytes(), model.read_bytes(), *options)
    page = folder / f"page-{model.stem}-{stamp}.html"
    if not page.exists() or not page.with_suffix(".json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([program, "generate", model, *options, "--html", page, "--report", page.with_suffix(".json"), "--quiet"], capture_output=True, text=True)
        if done.returncode not in (0, 1):
            raise results.Unusable(done.stderr.strip())
    return page


def photographed(page, cut, folder):
    """A PNG of the page's model; `cut`: front, left, back, right, whole, hidden. By a process of its own: matplotlib's open fonts hold the
    descriptors on which Chromium listens."""
    picture = folder / f"{page.stem}-{cut}.png"
    if not picture.exists():
        done = subprocess.run([sys.executable, __file__, page, cut, picture], capture_output=True, text=True)
        if done.returncode != 0:
            raise results.Unusable(done.stderr.strip().splitlines()[-1])
    return picture


def photograph(page, cut, picture):
    program = browser.find()
    if program is None:
        sys.exit("no Chromium on this machine; scripts/setup installs it, or name one with CHROMIUM=")
    with browser.Browser(program, 1500, 1200) as chromium:
        chromium.open(page, "#layer=0")  # the mark of the shown layer is out of the way
        chromium.run(f"(() => {{ const s = document.querySelector('[aria-label=Shell]'); s.value = '{cut}'; s.onchange(); }})()")
        chromium.settle()
        chromium.run(f"(() => {{ {CANVAS}; for (let e = c.parentElement; e; e = e.parentElement) e.style.border = 'none';"
                     " for (const e of c.parentElement.children) if (e !== c) e.style.visibility = 'hidden'; })()")
        x, y, w, h = chromium.run(f"(() => {{ {CANVAS}; c.scrollIntoView(); const r = c.getBoundingClientRect(); return [r.x + scrollX, r.y + scrollY, r.width, r.height]; }})()")
        chromium.settle()
        shot = chromium.call("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip={"x": x, "y": y, "width": w, "height": h, "scale": 2})
    temporary = picture.with_suffix(".part")
    temporary.write_bytes(base64.b64decode(shot["data"]))
    temporary.rename(picture)


if __name__ == "__main__":
    try:
        photograph(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]))
    except browser.PageError as error:
        sys.exit(f"camera: {error}")
