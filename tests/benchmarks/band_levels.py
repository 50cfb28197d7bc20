#!/usr/bin/python3
"""Levels of a run's sounds in bands of frequency, a Markdown table: a row for each microphone (VOICE.NAME if there are
several voices).
Usage: band_levels.py RUN [--from SECONDS]."""

import argparse
import csv
import pathlib

import numpy
from scipy.signal import welch

BANDS = [100, 500, 1500, 3000, 5000, 8000]  # [Hz]
REFERENCE = 20e-6  # [Pa]


def read_sounds(path):
    """Times [s], and of each microphone the acoustic pressure p_a [Pa]; with a flow `pressure_Pa` has p_ic, too."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    columns = {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}
    kind = "p_a_Pa." if any(name.startswith("p_a_Pa.") for name in columns) else "pressure_Pa."
    return columns["time_s"], {name.removeprefix(kind): values for name, values in columns.items()
                               if name.startswith(kind)}


def levels(times, pressure, begin):
    """dB of each band: Welch's density, Hann windows of 20 ms, half overlap, summed over the band."""
    rate = (len(times) - 1) / (times[-1] - times[0])
    even = numpy.arange(begin, times[-1], 1 / rate)
    length = min(len(even), round(0.02 * rate))
    frequency, density = welch(numpy.interp(even, times, pressure), rate, "hann", length, detrend="constant")
    powers = [density[(frequency >= low) & (frequency < high)].sum() * (frequency[1] - frequency[0])
              for low, high in zip(BANDS, BANDS[1:])]
    return [10 * numpy.log10(power / REFERENCE**2) for power in powers]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--from", dest="begin", type=float, default=0.0, help="what was before does not count [s]")
    options = parser.parse_args()
    heads = [f"{low / 1000:g} to {high / 1000:g} kHz" for low, high in zip(BANDS, BANDS[1:])]
    print(f"| microphone | {' | '.join(heads)} |\n| --- |{' ---: |' * len(heads)}")
    for path in sorted(options.run.glob("microphones*.csv")):
        times, sounds = read_sounds(path)
        for microphone, pressure in sounds.items():
            row = " | ".join(f"{level:.1f} dB" for level in levels(times, pressure, options.begin))
            print(f"| {microphone} | {row} |")


if __name__ == "__main__":
    main()
