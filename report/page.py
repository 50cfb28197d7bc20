"""The report as one HTML page that needs no other file."""

import base64
import html
import math

import curves

STYLE = """
body { font: 15px/1.5 "Helvetica Neue", Arial, sans-serif; color: #222;
  max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; margin-bottom: 0; }
h2 { font-size: 1.2em; margin: 2em 0 .5em; border-bottom: 1px solid #ccc; }
p.lead { margin-top: .2em; color: #555; }
table { border-collapse: collapse; margin: .5em 0; }
th, td { text-align: left; padding: .25em 1.2em .25em 0; border-bottom: 1px solid #e5e5e5; vertical-align: top; }
th { font-weight: 600; color: #555; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.good { color: #2c6e3f; } td.bad { color: #a5341f; font-weight: 600; }
p.missing { color: #8a5a00; background: #fff6e0; padding: .3em .7em; }
p.failed { color: #fff; background: #a5341f; padding: .4em .8em; }
img { max-width: 100%; height: auto; display: block; }
figure { margin: .5em 0 1.2em; } figcaption { color: #555; font-size: .92em; }
@media print { body { font-size: 10.5pt; max-width: none; margin: 0; } figure, table, tr { break-inside: avoid; }
  h2 { break-after: avoid; } audio { display: none; } }
"""
NAMES = {"f0": "fundamental frequency f0", "SPL": "sound pressure level"}
LARGEST_SOUND = 4_000_000  # [byte] a longer sound is linked, not embedded


def escape(value):
    return html.escape(str(value), quote=True)


def shown(value):
    """Four significant digits; text as it is."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return escape(value)
    if not math.isfinite(value):
        return "none"
    if float(value).is_integer() and abs(value) < 1e7:
        return str(int(value))
    return f"{value:.4g}"


def table(rows, head=(), numbers=()):
    """rows of (text or (text, class)); `numbers` are the columns set flush right."""
    def cell(tag, column, value):
        value, kind = value if isinstance(value, tuple) else (value, "")
        kind = f"{kind} number".strip() if column in numbers else kind
        return f"<{tag}{f' class={chr(34)}{kind}{chr(34)}' if kind else ''}>{value}</{tag}>"

    lines = ["<table>"]
    if head:
        lines.append("<tr>" + "".join(cell("th", i, text) for i, text in enumerate(head)) + "</tr>")
    lines += ["<tr>" + "".join(cell("td", i, value) for i, value in enumerate(row)) + "</tr>" for row in rows]
    return "\n".join(lines + ["</table>"])


def result_name(name):
    quantity, unit, place = curves.split_unit(name)
    quantity = NAMES.get(quantity, quantity)
    return escape(quantity) + (f" ({escape(place)})" if place else ""), escape(unit)


def key_figures(summary):
    """Every result, beside what was expected of it; error and tolerance are in the result's own unit."""
    results = summary.get("results") or {}
    expected = summary.get("expected") or {}
    rows = []
    for name in list(results) + [name for name in expected if name not in results]:
        label, unit = result_name(name)
        value = results.get(name)
        row = [label, shown(value) if value is not None else ("not obtained", "bad"), unit]
        wanted = expected.get(name)
        if isinstance(wanted, dict):
            target, tolerance = wanted.get("value"), wanted.get("tolerance")
            known = isinstance(value, (int, float)) and isinstance(target, (int, float))
            judged = known and isinstance(tolerance, (int, float))
            kind = ("good" if abs(value - target) <= tolerance else "bad") if judged else ""
            row += [shown(target if target is not None else ""), shown(value - target) if known else "",
                    shown(tolerance) if tolerance is not None else "",
                    ({"good": "within", "bad": "outside", "": ""}[kind], kind), escape(wanted.get("source", ""))]
        elif expected:
            row += [""] * 5
        rows.append(row)
    head = ["quantity", "found", "unit"] + (["expected", "error", "tolerance", "", "source"] if expected else [])
    return table(rows, head, {1, 3, 4, 5})


def run_facts(run):
    summary = run.summary
    rows = [(key, shown(summary[key])) for key in ("case", "version", "status", "reason", "dimension", "ranks", "steps")
            if summary.get(key) not in (None, "")]
    for key, unit in (("simulated_seconds", "s"), ("wall_seconds", "s")):
        if isinstance(summary.get(key), (int, float)):
            rows.append((key.partition("_")[0] + " time", f"{shown(summary[key])} {unit}"))
    for key in ("cells", "unknowns"):
        counts = summary.get(key)
        for name, count in counts.items() if isinstance(counts, dict) else [("", counts)]:
            if isinstance(count, (int, float)):
                rows.append((f"{key} {escape(name)}".strip(), f"{int(count):,}".replace(",", "&#8239;")))
    if isinstance(summary.get("peak_memory_bytes"), (int, float)):
        rows.append(("peak memory", f"{summary['peak_memory_bytes'] / 2**20:.0f} MiB"))
    return table(rows)


def picture(path, caption):
    data = base64.b64encode(path.read_bytes()).decode()
    return (f'<figure><img src="data:image/png;base64,{data}" alt="{escape(caption)}">'
            f"<figcaption>{escape(caption)}</figcaption></figure>")


def sound(path):
    source = escape(path.name)
    if path.stat().st_size <= LARGEST_SOUND:
        source = "data:audio/wav;base64," + base64.b64encode(path.read_bytes()).decode()
    return f'<p>{escape(path.name)}<br><audio controls src="{source}"></audio></p>'


def missing(lines):
    return "\n".join(f'<p class="missing">{escape(what)} {escape(why)}.</p>' for what, why in lines)


def page(title, description, body):
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n<h1>{escape(title)}</h1>\n"
            f'<p class="lead">{escape(description)}</p>\n{body}\n</body>\n</html>\n')
