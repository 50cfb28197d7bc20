"""Pictures of what a run wrote as columns: monitors, microphones, spectra, cost."""

import re

import numpy

import style

NUMERICS = {"step", "time_s", "dt_s", "newton_iterations"}
FIRST = ["gap", "area", "flow", "drag", "lift"]
UNITS = {"m": ("m", 1), "m2_s": ("m²/s", 1), "m3_s": ("m³/s", 1), "N": ("N", 1), "Pa": ("Pa", 1), "Hz": ("Hz", 1),
         "m2": ("m²", 1), "m2_s2": ("m²/s²", 1), "m3_s2": ("m³/s²", 1),
         "m_s": ("m/s", 1), "s": ("s", 1), "dB": ("dB", 1), "J": ("J", 1), "K": ("K", 1)}
SMALLER = {"m": [(1e-3, "mm"), (1e-6, "µm")], "m²/s": [(1e-4, "cm²/s")], "m³/s": [(1e-6, "cm³/s")],
           "m²": [(1e-6, "mm²")], "N": [(1e-3, "mN")], "s": [(1e-3, "ms")], "Pa": [(1e-3, "mPa"), (1e-6, "µPa")]}


def split_unit(name):
    """`gap_peak_m` -> ("gap peak", "m", ""); `SPL_dB.mouth` -> ("SPL", "dB", "mouth"); no unit: ""."""
    base, _, place = name.partition(".")
    for suffix in sorted(UNITS, key=len, reverse=True):
        match = re.fullmatch(rf"(.+?)_{suffix}((?:_(?:mean|amplitude|peak|min|max))?)", base)
        if match:
            return (match.group(1) + match.group(2)).replace("_", " "), UNITS[suffix][0], place
    return base.replace("_", " "), "", place


def readable(values, unit):
    """Values in a unit in which they are neither tiny nor huge: (values, unit)."""
    finite = numpy.abs(values[numpy.isfinite(values)])
    largest = finite.max() if finite.size else 0
    chosen = (1, unit)
    for factor, smaller in SMALLER.get(unit, []):
        if 0 < largest < 0.5 * chosen[0]:
            chosen = (factor, smaller)
    return values / chosen[0], chosen[1]


def monitors(history, folder):
    """Glottal gap and flow first, then every other monitor, over time; at most eight."""
    names = [name for name in history.columns if name not in NUMERICS]
    names.sort(key=lambda name: next((i for i, first in enumerate(FIRST) if name.startswith(first)), len(FIRST)))
    names = [name for name in names if numpy.isfinite(history.columns[name]).any()][:8]
    if not names or "time_s" not in history.columns:
        return None
    time, time_unit = readable(history.columns["time_s"], "s")
    picture, axes = style.figure(len(names), 1, height=1.5 if len(names) > 1 else 2.4, sharex=True)
    for axis, name, colour in zip(axes[:, 0], names, style.COLOURS):
        label, unit, place = split_unit(name)
        values, unit = readable(history.columns[name], unit)
        axis.plot(time, values, color=colour)
        axis.set_ylabel(f"[{unit}]" if unit else "[1]")
        axis.set_title(label + (f" ({place})" if place else ""), loc="left")
        axis.grid(True)
    axes[-1, 0].set_xlabel(f"time [{time_unit}]")
    picture.align_ylabels()
    return style.save(picture, folder, "monitors")


def microphones(table, folder):
    """Sound pressure at each microphone."""
    signals = table.starting("pressure_Pa")
    if not signals or "time_s" not in table.columns:
        return None
    time, unit = readable(table.columns["time_s"], "s")
    picture, axes = style.figure(len(signals), 1, height=1.8, sharex=True)
    for axis, (name, values), colour in zip(axes[:, 0], signals.items(), style.COLOURS * 9):
        values, pressure_unit = readable(values, "Pa")
        axis.plot(time, values, color=colour, linewidth=0.8)
        axis.set_ylabel(f"pressure [{pressure_unit}]")
        axis.set_title(f"microphone {name}" if name else "microphone", loc="left")
        axis.grid(True)
    axes[-1, 0].set_xlabel(f"time [{unit}]")
    return style.save(picture, folder, "microphones")


def spectra(table, results, folder, highest=6000.0):
    """Spectral density at the microphones and the tract's transfer function, formants marked."""
    kinds = [("psd_dB", "spectral density", "dB re 20 µPa/√Hz"), ("transfer_dB", "transfer function", "dB")]
    rows = [(table.starting(prefix), prefix, title, unit) for prefix, title, unit in kinds]
    rows = [row for row in rows if row[0]]
    if not rows or "frequency_Hz" not in table.columns:
        return None
    frequency = table.columns["frequency_Hz"]
    shown = (frequency > 0) & (frequency <= highest)
    picture, axes = style.figure(len(rows), 1, height=2.8, sharex=True)
    for axis, (columns, prefix, title, unit) in zip(axes[:, 0], rows):
        top = -numpy.inf
        for name, values in columns.items():
            axis.plot(frequency[shown] / 1000, values[shown], linewidth=0.9, label=name or title)
            finite = values[shown][numpy.isfinite(values[shown])]
            top = max(top, finite.max() if finite.size else 0)
        bottom = max(top - 90, axis.get_ylim()[0])
        axis.set_ylim(bottom, top + 0.2 * (top - bottom))
        mark_formants(axis, results, highest)
        axis.set_ylabel(f"level [{table.notes.get(prefix, unit)}]")
        axis.set_title(title, loc="left")
        axis.grid(True)
        if len(columns) > 1:
            axis.legend(loc="lower left", frameon=False, ncol=min(4, len(columns)))
    axes[-1, 0].set_xlabel("frequency [kHz]")
    axes[-1, 0].set_xlim(0, min(highest, frequency.max()) / 1000)
    return style.save(picture, folder, "spectra")


def mark_formants(axis, results, highest):
    """Dashed lines at f0 and F1, F2, … of the first microphone that has them; labels in the free band on top."""
    marked = set()
    for name, value in results.items():
        match = re.match(r"(f0|F\d+)_Hz(?:\.|$)", name)
        if not match or match.group(1) in marked or not isinstance(value, (int, float)) or not 0 < value <= highest:
            continue
        marked.add(match.group(1))
        axis.axvline(value / 1000, color="#555555", linewidth=0.7, linestyle="--")
        line = 14 if match.group(1) == "f0" else 2  # f0 is close to F1: its label goes below
        axis.annotate(match.group(1), (value / 1000, 1), xycoords=("data", "axes fraction"), xytext=(3, -line),
                      textcoords="offset points", va="top", fontsize=8, color="#333333")


def cost(summary, folder):
    """Seconds per phase of the step."""
    phases = {name: value for name, value in (summary.get("phases") or {}).items() if isinstance(value, (int, float))}
    if not phases:
        return None
    rest = (summary.get("wall_seconds") or 0) - sum(phases.values())
    if rest > 0:
        phases["everything else"] = rest
    total = sum(phases.values()) or 1.0
    names = sorted(phases, key=phases.get)
    picture, axes = style.figure(1, 1, height=0.7 + 0.26 * len(names))
    axis = axes[0, 0]
    axis.barh(names, [phases[name] for name in names], color=style.COLOURS[0], height=0.7)
    for row, name in enumerate(names):
        share = 100 * phases[name] / total
        part = f"{share:.0f} %" if share >= 1 else "below 1 %"
        axis.annotate(f"{phases[name]:.3g} s  ({part})", (phases[name], row), xytext=(4, 0),
                      textcoords="offset points", va="center")
    axis.set_xlim(0, 1.25 * max(phases.values()) or 1)
    axis.set_xlabel("wall time [s]")
    return style.save(picture, folder, "cost")
