"""One look for all figures: sizes, colours (Okabe and Ito, told apart without red and green), and how layers are drawn."""
import math
import sys

try:
    import matplotlib
except ModuleNotFoundError as missing:
    sys.exit(f"{sys.argv[0]}: {missing}; install Debian's python3-matplotlib (scripts/setup does)")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.patches import PathPatch  # noqa: E402
from matplotlib.path import Path  # noqa: E402

COLUMN, PAGE = 3.35, 6.9  # inches: one column, both
SHELL, EDGE, WALL, HANG, FILL = "#d9d9d9", "#333333", "#0072b2", "#d55e00", "#f7c9a8"
RED, ORANGE = "#9b0000", "#f4a259"
GREEN, SKY, YELLOW, PURPLE = "#009e73", "#56b4e9", "#f0e442", "#cc79a7"
CYCLE = [WALL, HANG, GREEN, PURPLE, "#e69f00", SKY, "#000000"]

matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 7.5, "axes.titlesize": 8, "axes.labelsize": 7.5, "legend.fontsize": 7, "xtick.labelsize": 7,
    "ytick.labelsize": 7, "axes.linewidth": 0.6, "lines.linewidth": 1.0, "svg.fonttype": "none", "pdf.fonttype": 42, "svg.hashsalt": "ribvault",
    "axes.prop_cycle": matplotlib.cycler(color=CYCLE), "figure.dpi": 200, "savefig.dpi": 300, "savefig.bbox": "tight", "savefig.pad_inches": 0.03})


def panels(count, width=PAGE, ratio=1.0, rows=1, gap=0.06):
    """`count` panels for drawings, `ratio` high over wide, and the figure."""
    columns = -(-count // rows)
    side = (width - gap * (columns - 1)) / columns
    figure, axes = pyplot.subplots(rows, columns, figsize=(width, rows * (side * ratio + 0.22)), squeeze=False)
    figure.subplots_adjust(0, 0, 1, 1 - 0.2 / (rows * (side * ratio + 0.22)), gap / side, 0.22 / (side * ratio))
    flat = [a for row in axes for a in row]
    for spare in flat[count:]:
        spare.remove()
    for axis in flat[:count]:
        axis.set_axis_off()
    return figure, flat[:count]


def fitted(points, ratio, more):
    """A box `ratio` high over wide around the points, `more` mm wider than they need."""
    x0, y0, x1, y1 = box_of(points)
    half = max(x1 - x0 + 2 * more, (y1 - y0 + 2 * more) / ratio) / 2
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    return x - half, y - ratio * half, x + half, y + ratio * half


def frame(axis, box, margin=0.0):
    """Shows this box (x0, y0, x1, y1) in true proportion."""
    x0, y0, x1, y1 = box
    axis.set_xlim(x0 - margin, x1 + margin)
    axis.set_ylim(y0 - margin, y1 + margin)
    axis.set_aspect("equal")
    axis.figure.canvas.draw()  # places the axes, so that widths in mm are right


def box_of(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return min(xs), min(ys), max(xs), max(ys)


def box_of_region(region):
    return box_of([p for contour in region for p in contour])


def path_of(region):
    points, codes = [], []
    for contour in region:
        points += [*contour, contour[0]]
        codes += [Path.MOVETO] + [Path.LINETO] * (len(contour) - 1) + [Path.CLOSEPOLY]
    return Path(points, codes) if points else None


def parts(region):
    """The region's connected parts, each its outer contour with its holes."""
    def doubled_area(c):
        return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(c, c[1:] + c[:1]))
    outer = sorted((c for c in region if doubled_area(c) > 0), key=doubled_area)
    found = [[c] for c in outer]
    for hole in (c for c in region if doubled_area(c) < 0):
        around = next((part for part in found if path_of(part[:1]).contains_point(hole[0])), None)
        if around:
            around.append(hole)
    return found


def area(axis, region, colour, alpha=1.0, edge="none", width=0.5, order=1):
    """A region; holes run against their outer contour. `region` may be several put together, as slice and cavity: what lies between."""
    path = path_of(region)
    if path:
        axis.add_patch(PathPatch(path, facecolor=colour, edgecolor=edge, linewidth=width, alpha=alpha, zorder=order))


def shell(axis, slice_, cavity, colour=SHELL, order=1):
    """B_i: the slice without its cavity."""
    area(axis, [*slice_, *[c[::-1] for c in cavity]], colour, edge=EDGE, order=order)


def points_per_mm(axis):
    box = axis.get_window_extent()
    x0, x1 = axis.get_xlim()
    return box.width / (x1 - x0) * 72 / axis.figure.dpi


def lines(axis, polylines, colour, mm=None, points=1.0, alpha=1.0, order=3, style="solid", many=False):
    """Polylines, as wide as they are printed (mm) or in points. A line of one point is a dot. `many`: thousands, as pixels in the files."""
    width = mm * points_per_mm(axis) if mm else points
    drawn = [p if len(p) > 1 else [p[0], (p[0][0] + 1e-6, p[0][1])] for p in polylines if p]
    axis.add_collection(LineCollection(drawn, colors=colour, linewidths=width, alpha=alpha, zorder=order, linestyles=style, capstyle="round", joinstyle="round", rasterized=many))


def dots(axis, points, colour, size=2.4, order=6, shape="o", edge="none"):
    if points:
        axis.plot([p[0] for p in points], [p[1] for p in points], shape, color=colour, markersize=size, zorder=order, markeredgecolor=edge, markeredgewidth=0.5)


def title(axis, text):
    axis.set_title(text, pad=3)


def scale_bar(axis, mm=None):
    """A bar of a round length, below the lower left corner."""
    x0, x1 = axis.get_xlim()
    y0, y1 = axis.get_ylim()
    if mm is None:
        mm = 10 ** math.floor(math.log10((x1 - x0) / 3))
        mm *= 5 if (x1 - x0) / mm > 16 else 2 if (x1 - x0) / mm > 7 else 1
    x, y = x0 + 0.01 * (x1 - x0), y0 - 4 / points_per_mm(axis)
    axis.plot([x, x + mm], [y, y], color="black", linewidth=1.4, solid_capstyle="butt", zorder=9, clip_on=False)
    axis.text(x + mm + 3 / points_per_mm(axis), y, f"{mm:g} mm", ha="left", va="center", fontsize=6, zorder=9)


def save(figure, stem):
    """stem.pdf, stem.svg and, for looking at, stem.png."""
    stem.parent.mkdir(parents=True, exist_ok=True)
    for ending, more in (("pdf", {"metadata": {"CreationDate": None}}), ("svg", {"metadata": {"Date": None}}), ("png", {"dpi": 150})):
        written = stem.with_suffix(f".{ending}.part")
        figure.savefig(written, format=ending, **more)
        written.rename(stem.with_suffix("." + ending))
    pyplot.close(figure)


def cropped(pictures, margin=8):
    """Pictures without their even border, all cut alike, so that they keep one scale. They must be of one size."""
    pixels = [pyplot.imread(p)[:, :, :3] for p in pictures]
    drawn = sum(abs(p - p[0, 0]).sum(axis=2) >= 0.02 for p in pixels) > 0
    rows, columns = drawn.any(axis=1).nonzero()[0], drawn.any(axis=0).nonzero()[0]
    if rows.size == 0:
        return pixels
    return [p[max(rows[0] - margin, 0):rows[-1] + margin + 1, max(columns[0] - margin, 0):columns[-1] + margin + 1] for p in pixels]


def photographs(groups, names=(), width=PAGE):
    """Panels of pictures in a row, all of one height, named. Pictures of one group are cut alike, so they keep one scale."""
    pixels = [p for group in groups for p in cropped(group)]
    shapes = [p.shape[1] / p.shape[0] for p in pixels]
    height = width / (sum(shapes) * (1 + 0.04 * (len(shapes) - 1)))
    figure, axes = pyplot.subplots(1, len(pixels), figsize=(width, height + 0.22), width_ratios=shapes, squeeze=False)
    figure.subplots_adjust(0, 0, 1, height / (height + 0.22), 0.04 * len(shapes))
    for k, (axis, picture) in enumerate(zip(axes[0], pixels)):
        axis.set_axis_off()
        axis.imshow(picture, interpolation="antialiased")
        if names:
            title(axis, names[k])
    return figure
