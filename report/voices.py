"""Several acoustic solvers beside each other: their spectra over each other, and what each has above the first."""

import html

import numpy

import style

SILENCE = -200  # [dB] what is not above it is no sound


def names(run):
    """The acoustic solvers of a run, in the order of its case."""
    return run.third_octaves.notes.get("solvers", "").split(", ") if run.third_octaves else []


def by_microphone(table, prefix, solvers):
    """Columns `prefix.SOLVER.MICROPHONE` of a table: microphone -> {solver: values}, where several solvers have it."""
    found = {}
    for column, values in table.starting(prefix).items():
        for solver in solvers:
            if column.startswith(f"{solver}."):
                found.setdefault(column[len(solver) + 1:], {})[solver] = values
    return {microphone: levels for microphone, levels in found.items() if len(levels) > 1}


def differences(levels):
    """What each solver but the first has above the first one [dB]; not a number where one of both is silent."""
    solvers = list(levels)
    first = numpy.where(levels[solvers[0]] > SILENCE, levels[solvers[0]], numpy.nan)
    return {solver: numpy.where(levels[solver] > SILENCE, levels[solver], numpy.nan) - first for solver in solvers[1:]}


def overlay(spectra, bands, solvers, folder, highest=6000.0):
    """For each microphone the spectral densities over each other and, below, the differences by thirds of an octave."""
    densities, levels = (by_microphone(spectra, "psd_dB", solvers), by_microphone(bands, "level_dB", solvers))
    microphones = [name for name in densities if name in levels]
    if not microphones:
        return None
    frequency = spectra.columns["frequency_Hz"]
    shown = (frequency > 0) & (frequency <= highest)
    colours = dict(zip(solvers, style.COLOURS * 9))
    picture, axes = style.figure(2 * len(microphones), 1, height=2.2, sharex=True)
    for row, microphone in enumerate(microphones):
        above, below = axes[2 * row, 0], axes[2 * row + 1, 0]
        top = -numpy.inf
        first = next(iter(levels[microphone]))
        for solver, values in densities[microphone].items():
            above.plot(frequency[shown] / 1000, values[shown], linewidth=2.4 if solver == first else 0.9,
                       color=colours[solver], label=solver)
            top = max(top, numpy.nanmax(values[shown], initial=-numpy.inf))
        above.set_ylim(max(top - 90, above.get_ylim()[0]), top + 5)
        above.set_title(f"microphone {microphone}", loc="left")
        above.set_ylabel("level [dB re 20 µPa/√Hz]")
        above.legend(loc="upper right", frameon=False, ncol=min(4, len(solvers)))
        middles = bands.columns["band_Hz"] / 1000
        for solver, values in differences(levels[microphone]).items():
            below.plot(middles, values, marker="o", markersize=3, color=colours[solver])
        below.axhline(0, color=colours[first], linewidth=0.9)
        below.set_ylabel("difference [dB]")
        below.set_title(f"above {first}, by thirds of an octave", loc="left")
        for axis in (above, below):
            axis.grid(True)
    axes[-1, 0].set_xlabel("frequency [kHz]")
    axes[-1, 0].set_xlim(0, highest / 1000)
    return style.save(picture, folder, "voices")


def rows(bands, results, solvers):
    """For each microphone a head and rows: the first solver's level of all and of each band, the others' difference."""
    tables = {}
    for microphone, levels in by_microphone(bands, "level_dB", solvers).items():
        there = list(levels)
        found = [("all", {solver: numpy.array([results.get(f"SPL_dB.{solver}.{microphone}", SILENCE)], float)
                          for solver in there})]
        for i, band in enumerate(bands.columns["band_Hz"]):
            found.append((f"{band:.0f} Hz", {solver: levels[solver][i:i + 1] for solver in there}))
        lines = []
        for name, values in found:
            level = values[there[0]][0]
            lines.append([name, f"{level:.1f}" if level > SILENCE else "–"] +
                         [f"{round(value[0], 1) + 0.0:+.1f}" if numpy.isfinite(value[0]) else "–"
                          for value in differences(values).values()])
        head = ["band", f"{html.escape(there[0])} [dB re 20 µPa]"] + [f"{html.escape(other)} [dB above it]"
                                                                     for other in there[1:]]
        tables[microphone] = (head, lines)
    return tables
