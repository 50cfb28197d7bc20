"""Tables and chart of what the ends of a mesh reflect (docs/validation.md), of what benchmark_reflections printed.

    python3 tests/benchmarks/draw_reflections.py plane.csv space.csv [--picture docs/pictures/reflections.png]
"""

import argparse
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

PANELS = ["0 degrees", "45 degrees", "monopole in the plane", "monopole in space"]
COLOURS = {"1e-02": "#d95f02", "1e-03": "#1b6ca8", "1e-04": "#2a9d5c", "1e-05": "#8e6bbf"}


def read(paths):
    """{waves: {(end, cells, R0): (percents by frequency, vertices)}}"""
    results = {}
    for path in paths:
        with open(path) as file:
            for row in csv.DictReader(file, delimiter=";"):
                end = (row["end"], int(row["cells"]), row["R0"])
                percents, _ = results.setdefault(row["waves"], {}).setdefault(end, ({}, int(row["vertices"])))
                percents[float(row["frequency"])] = float(row["percent"])
    return results


def print_table(waves, ends):
    frequencies = sorted(next(iter(ends.values()))[0])
    print(f"\n| {waves} | " + " | ".join(f"{f:g} Hz" for f in frequencies) + " | vertices |")
    print("| --- |" + " ---: |" * (len(frequencies) + 1))
    for (end, cells, strength), (percents, vertices) in ends.items():
        name = f"{end}, {cells} cells, R0 = {strength}" if cells else end
        print(f"| {name} | " + " | ".join(f"{percents[f]:.2f}" for f in frequencies) + f" | {vertices} |")


def draw(axes, waves, ends):
    plain = next(vertices for (end, cells, _), (_, vertices) in ends.items() if cells == 0)
    curves = {}
    for (end, cells, strength), (percents, vertices) in ends.items():
        largest = max(percents.values())
        if cells == 0:
            axes.axhline(largest, color="black", linestyle=":", label=end)
        else:
            name = end if end == "sponge" else f"{end}, R0 = {strength}"
            curves.setdefault((name, strength), []).append((cells, largest, vertices / plain))
    for (name, strength), points in curves.items():
        if name != "sponge" and strength not in COLOURS:
            continue
        colour = "grey" if name == "sponge" else COLOURS[strength]
        axes.plot([p[0] for p in points], [p[1] for p in points], "s-" if name == "sponge" else "o-", color=colour, label=name)
    axes.axhline(0.3, color="black", linewidth=0.6)
    axes.set_yscale("log")
    axes.set_xlim(3, 25)
    if waves.startswith("monopole"):
        cost = {cells: ratio for points in curves.values() for cells, _, ratio in points}
        axes.set_xticks(sorted(cost), [f"{cells}\n×{cost[cells]:.3g}" for cells in sorted(cost)], fontsize=6.5)
    axes.set_title(waves + ("" if waves[0] != "m" else ", 0.1 m before the end"), fontsize=10)
    axes.grid(True, which="both", alpha=0.2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", nargs="+")
    parser.add_argument("--picture")
    options = parser.parse_args()
    results = read(options.results)
    for waves, ends in results.items():
        print_table(waves, ends)
    if not options.picture:
        return
    figure, panels = pyplot.subplots(1, 4, figsize=(15, 4.6), sharey=True)
    for axes, waves in zip(panels, PANELS):
        draw(axes, waves, results[waves])
        axes.set_xlabel("cells of the layer" + ("\nand vertices over those without it" if waves[0] == "m" else ""))
    panels[0].set_ylabel("largest reflection, 300 to 5000 Hz [%]")
    panels[2].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(options.picture, dpi=90)


if __name__ == "__main__":
    main()
