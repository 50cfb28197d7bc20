"""A picture of sound over time and frequency."""

import numpy

import curves
import style

WINDOW = 5e-3  # [s] effective length of the window: wide-band, formants as bands and glottal pulses as stripes
RANGE = 60.0  # [dB] shown below the greatest level
MOST = 3  # microphones
FRAMES = 400


def short_time_spectra(values, rate, window=WINDOW, frames=FRAMES):
    """Levels [dB re 20 µPa, of a tone] by frequency and frame, for equally spaced samples [Pa].

    A Gaussian-like window of twice the effective length (the conventions of Praat), scaled so that a steady tone shows
    its level. Returns (times of the frames' middles [s], frequencies [Hz], levels); None if the record is too short.
    """
    length = int(2 * window * rate)
    if length < 16 or values.size < length:
        return None
    x = numpy.linspace(-1, 1, length)
    weight = numpy.exp(-12 * x * x) - numpy.exp(-12.0)
    starts = numpy.unique(numpy.linspace(0, values.size - length, frames).astype(int))
    padded = 1 << int(numpy.ceil(numpy.log2(4 * length)))
    spectra = [numpy.fft.rfft(weight * values[start:start + length], padded) for start in starts]
    amplitude = 2 * numpy.abs(numpy.array(spectra)).T / weight.sum()
    level = 20 * numpy.log10(numpy.maximum(amplitude / numpy.sqrt(2) / 20e-6, 1e-15))
    return (starts + 0.5 * (length - 1)) / rate, numpy.fft.rfftfreq(padded, 1 / rate), level


def uniform(time, values):
    """The same series with equal steps, as many: (values, rate [Hz])."""
    even = numpy.linspace(time[0], time[-1], time.size)
    return numpy.interp(even, time, values), (time.size - 1) / (time[-1] - time[0])


def spectrogram(table, folder, highest=6000.0):
    """Level over time and frequency at the first microphones."""
    signals = dict(list(table.starting("pressure_Pa").items())[:MOST])
    time = table.columns.get("time_s")
    if not signals or time is None or time.size < 2:
        return None
    pictured = {name: short_time_spectra(*uniform(time, values)) for name, values in signals.items()}
    pictured = {name: parts for name, parts in pictured.items() if parts is not None}
    if not pictured:
        return None
    picture, axes = style.figure(len(pictured), 1, height=2.4, sharex=True)
    for axis, (name, (middles, frequency, level)) in zip(axes[:, 0], pictured.items()):
        shown = frequency <= highest
        middles, unit = curves.readable(time[0] + middles, "s")
        top = level[shown].max()
        image = axis.pcolormesh(middles, frequency[shown] / 1000, level[shown], vmin=top - RANGE, vmax=top,
                                cmap="magma", shading="nearest", rasterized=True)
        axis.set_ylabel("frequency [kHz]")
        axis.set_title(f"microphone {name}" if name else "microphone", loc="left")
        picture.colorbar(image, ax=axis, label="level [dB re 20 µPa]")
        axis.set_xlabel(f"time [{unit}]" if axis is axes[-1, 0] else "")
    return style.save(picture, folder, "spectrogram")
