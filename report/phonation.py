"""Pictures of vocal folds that phonate: kymogram, phase portraits, and cycles beside each other."""

import numpy

import curves
import style

CYCLES = 5  # at the end of the run, that phase portraits and waves show
CLOSED = "#b5462f"


def glottis(run):
    """Name of the first monitor of kind glottis, or None."""
    monitors = run.resolved.get("monitor", [])
    return next((monitor.get("name") for monitor in monitors if monitor.get("kind") == "glottis"), None)


def flow_of(run, name):
    """The flow that a voice is made of, as (column, values): that of the first flux, or the one past the folds."""
    fluxes = [monitor.get("name") for monitor in run.resolved["monitor"] if monitor.get("kind") == "flux"]
    for candidate in (*fluxes, f"{name}_flow"):
        for unit in ("m2_s", "m3_s"):
            values = run.history.columns.get(f"{candidate}_{unit}")
            if values is not None:
                return f"{candidate}_{unit}", values
    return None, None


def last_cycles(run, name, cycles=CYCLES):
    """Mask of the history's rows in the last cycles; without a frequency, of its later half."""
    time = run.history.columns["time_s"]
    frequency = run.results().get(f"{name}_f0_Hz")
    length = 0.5 * (time[-1] - time[0])
    if isinstance(frequency, (int, float)) and frequency > 0:
        length = min(cycles / frequency, 2 * length)
    return time >= time[-1] - length


def kymogram(table, folder):
    """Opening along the flow (upwards) against time; sealed places are red, those without a fold grey."""
    opening = table.starting("opening_m")
    time = table.columns["time_s"]
    if len(opening) < 2 or time.size < 2:
        return None
    places = numpy.array([float(place) for place in opening])
    width = numpy.array(list(opening.values()))
    known = numpy.where(numpy.isfinite(width), width, numpy.inf)
    largest = known.min(axis=0).max()  # of what is the smallest opening at one time
    widest = 1.5 * largest if 0 < largest < numpy.inf else 1e-3
    shown = numpy.flatnonzero(known.min(axis=1) < widest)
    shown = slice(shown.min(), shown.max() + 1)
    time, time_unit = curves.readable(time, "s")
    picture, axes = style.figure(1, 1, height=3.2)
    axis = axes[0, 0]
    colours = style.pyplot.get_cmap("Blues").with_extremes(under=CLOSED, bad="#d0d0d0")
    image = axis.pcolormesh(time, 1000 * places[shown], 1000 * numpy.ma.masked_invalid(width[shown]), cmap=colours,
                            vmin=1e-6 * widest, vmax=1000 * widest, shading="nearest", rasterized=True)
    picture.colorbar(image, ax=axis, label="opening [mm]", extend="both")
    axis.set_xlabel(f"time [{time_unit}]")
    axis.set_ylabel("place along the flow [mm]")
    return style.save(picture, folder, "kymogram")


def portraits(run, folder):
    """The gap against its rate, and flow against gap, over the last cycles."""
    name = glottis(run)
    column = f"{name}_gap_m"
    if column not in run.history.columns:
        return None
    chosen = last_cycles(run, name)
    time, gap = run.history.columns["time_s"][chosen], run.history.columns[column][chosen]
    if time.size < 3:
        return None
    flow_name, flow = flow_of(run, name)
    picture, axes = style.figure(1, 2 if flow is not None else 1, height=3.2)
    axes[0, 0].plot(1000 * gap, numpy.gradient(gap, time), color=style.COLOURS[0], linewidth=0.8)
    axes[0, 0].set_ylabel("rate of the gap [m/s]")
    if flow is not None:
        values, unit = curves.readable(flow[chosen], curves.split_unit(flow_name)[1])
        axes[0, 1].plot(1000 * gap, values, color=style.COLOURS[1], linewidth=0.8)
        axes[0, 1].set_ylabel(f"{curves.split_unit(flow_name)[0]} [{unit}]")
    for axis in axes[0]:
        axis.set_xlabel("gap [mm]")
        axis.grid(True)
    return style.save(picture, folder, "phase_portrait")


def waves(run, folder):
    """Opening, flow and the flow's rate over the last cycles."""
    name = glottis(run)
    columns = run.history.columns
    opening = next((column for column in (f"{name}_area_m2", f"{name}_gap_m") if column in columns), None)
    if opening is None:
        return None
    chosen = last_cycles(run, name)
    time = columns["time_s"][chosen]
    if time.size < 3:
        return None
    rows = [(opening, columns[opening][chosen])]
    flow_name, flow = flow_of(run, name)
    if flow is not None:
        rows.append((flow_name, flow[chosen]))
        rows.append((flow_name + "2", numpy.gradient(flow[chosen], time)))
    time, time_unit = curves.readable(time, "s")
    picture, axes = style.figure(len(rows), 1, height=1.5, sharex=True)
    for axis, (column, values), colour in zip(axes[:, 0], rows, style.COLOURS):
        label, unit, _ = curves.split_unit(column)
        values, unit = curves.readable(values, unit)
        axis.plot(time, values, color=colour)
        axis.set_ylabel(f"[{unit}]")
        axis.set_title(label + (", rate" if column.endswith("_s2") else ""), loc="left")
        axis.grid(True)
    axes[-1, 0].set_xlabel(f"time [{time_unit}]")
    picture.align_ylabels()
    return style.save(picture, folder, "glottal_waves")
