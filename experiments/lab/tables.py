"""Tables as Markdown, CSV and LaTeX from the same cells."""
import csv
import io
import statistics


class Table:
    """`columns`: pairs (heading, format of numbers). Cells are numbers, text or None (nothing to say)."""

    def __init__(self, name, title, columns, note=""):
        self.name, self.title, self.columns, self.note, self.rows = name, title, columns, note, []

    def add(self, *cells):
        self.rows.append(list(cells) + [None] * (len(self.columns) - len(cells)))

    def text(self, cell, form):
        if cell is None:
            return ""
        if isinstance(cell, bool):
            return "yes" if cell else "NO"
        if not isinstance(cell, (int, float)) or not form:
            return str(cell)
        text = format(cell, form)
        return text.removeprefix("-") if text.startswith("-") and not text.strip("-0.") else text  # no minus before a rounded zero

    def cells(self):
        return [[self.text(c, form) for c, (_, form) in zip(row, self.columns)] for row in self.rows]

    def markdown(self):
        lines = [[heading for heading, _ in self.columns], ["---"] * len(self.columns), *self.cells()]
        return "".join("| " + " | ".join(c.replace("|", "\\|") for c in line) + " |\n" for line in lines)

    def csv(self):
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow([heading for heading, _ in self.columns])
        writer.writerows(["" if c is None else c for c in row] for row in self.rows)
        return out.getvalue()

    def latex(self):
        def safe(text):
            for a, b in (("\\", "\\textbackslash "), ("&", "\\&"), ("%", "\\%"), ("_", "\\_"), ("#", "\\#")):
                text = text.replace(a, b)
            return text.replace("±", "$\\pm$").replace("ρ", "$\\rho$").replace("²", "$^2$").replace("³", "$^3$")
        lines = [[h for h, _ in self.columns], *self.cells()]
        body = [" & ".join(map(safe, line)) + " \\\\" for line in lines]
        return "\n".join(["\\begin{tabular}{l" + "r" * (len(self.columns) - 1) + "}", "\\hline", body[0], "\\hline", *body[1:],
                          "\\hline", "\\end{tabular}", ""])


def _filled(markdown):
    """Of a table in Markdown: the cells with something in them, by (first cell of the row, how many such rows came before, heading, column); the rows."""
    rows = [[c.strip() for c in line.strip()[1:-1].split(" | ")] for line in markdown.splitlines() if line.startswith("|")]
    found, seen = set(), {}
    for row in rows[2:]:
        nth = seen[row[0]] = seen.get(row[0], -1) + 1
        found.update((row[0], nth, heading, k) for k, (heading, cell) in enumerate(zip(rows[0], row)) if cell)
    return found, {(label, n) for label, count in seen.items() for n in range(count + 1)}


def emptied(before, after):
    """How many cells of a table in Markdown have something before, and nothing after, in rows that both have."""
    (had, _), (has, rows) = _filled(before), _filled(after)
    return sum(cell[:2] in rows for cell in had - has)


def mean(values):
    return statistics.mean(values) if values else None


def spread(values, form=".0f"):
    """Mean ± standard deviation; the mean alone for one value."""
    if not values:
        return None
    middle = format(statistics.mean(values), form)
    return f"{middle} ± {format(statistics.stdev(values), form)}" if len(values) > 1 else middle


def percent_off(ours, paper):
    return None if ours is None or not paper else 100 * (ours / paper - 1)


def growth_exponent(sizes, values):
    """Slope of log(value) over log(size), least squares."""
    import math
    pairs = [(math.log(s), math.log(v)) for s, v in zip(sizes, values) if v and v > 0]
    if len(pairs) < 2:
        return None
    return statistics.linear_regression([x for x, _ in pairs], [y for _, y in pairs]).slope
