#!/usr/bin/env python3
"""How often formants of voiced sound with a known source are right, where they are known.
Usage: formants_of_voices.py SIGNAL_PROBE [SEED]. Takes some minutes; no test.

Voices of 91 ms through a cascade of Klatt's resonators: half of them the plane tract of /i/, half one of ten vowels
after Peterson & Barney. Their periods vary by 1 %, their cycles by 3 %. Bursts, of any size and sign, where folds meet
and part, ring in the same tract, but enter it elsewhere, and no source tells of them. Moving tracts follow the opening
of the folds: F1 by 10 %, the others by 1 %, bandwidths up to four times as wide."""

import pathlib
import sys
import tempfile

import numpy
import scipy.io.wavfile
import scipy.signal

import probe

RATE = 44100
VOICES = 60  # of each family
LEAD_IN = 0.03  # [s] that is left out
PLANE = [(365, 15), (2540, 50), (3700, 100), (4150, 100)]  # (frequency, bandwidth) [Hz]
VOWELS = [(270, 2290, 3010), (390, 1990, 2550), (530, 1840, 2480), (660, 1720, 2410), (730, 1090, 2440),
          (570, 840, 2410), (440, 1020, 2240), (300, 870, 2240), (640, 1190, 2390), (490, 1350, 1690)]
FAMILIES = {
    "110 Hz": dict(pitch=110), "190 Hz": dict(pitch=190), "300 Hz": dict(pitch=300),
    "190 Hz, noise -40 dB": dict(pitch=190, noise=1e-2), "190 Hz, bandwidths x 2.5": dict(pitch=190, wide=2.5),
    "110 Hz, bursts -20 dB": dict(pitch=110, bursts=0.1), "190 Hz, bursts -20 dB": dict(pitch=190, bursts=0.1),
    "300 Hz, bursts -20 dB": dict(pitch=300, bursts=0.1), "190 Hz, bursts -10 dB": dict(pitch=190, bursts=0.3),
    "190 Hz, bursts -20 dB, 49 ms": dict(pitch=190, bursts=0.1, duration=0.049),
    "190 Hz, bursts -20 dB, noise -30 dB": dict(pitch=190, bursts=0.1, noise=0.03),
    "190 Hz, bursts -20 dB, bandwidths x 2.5": dict(pitch=190, bursts=0.1, wide=2.5),
    "190 Hz, bursts -20 dB, moving": dict(pitch=190, bursts=0.1, moves=True),
    "190 Hz, bursts -14 dB, moving, turbulence": dict(pitch=190, bursts=0.2, moves=True, turbulence=0.05)}


def rms(values):
    return numpy.sqrt(numpy.mean(values**2))


def resonate(sound, frequency, bandwidth):
    """Klatt's resonator; frequency and bandwidth are numbers or one for each sample."""
    c = -numpy.exp(-2 * numpy.pi * bandwidth / RATE)
    b = 2 * numpy.exp(-numpy.pi * bandwidth / RATE) * numpy.cos(2 * numpy.pi * frequency / RATE)
    if numpy.ndim(b) == 0:
        return scipy.signal.lfilter([1 - b - c], [1, -b, -c], sound)
    result, before, before_that = numpy.empty_like(sound), 0.0, 0.0
    for n, value in enumerate(sound):
        before, before_that = (1 - b[n] - c[n]) * value + b[n] * before + c[n] * before_that, before
        result[n] = before
    return result


def cycles(random, pitch, duration):
    """(begin [s], period [s], size) of each."""
    begin, result = (random.random() - 2) / pitch, []
    while begin < duration:
        period = (1 + 0.01 * random.standard_normal()) / pitch
        result.append((begin, period, 1 + 0.03 * random.standard_normal()))
        begin += period
    return result


def flow_of(cycles_, length, open_quotient, speed_quotient):
    """Rosenberg's pulses."""
    times, flow = numpy.arange(length) / RATE, numpy.zeros(length)
    for begin, period, size in cycles_:
        closing = open_quotient * period / (1 + speed_quotient)
        opening, t = closing * speed_quotient, times - begin
        up, down = (t >= 0) & (t < opening), (t >= opening) & (t < opening + closing)
        flow[up] = 0.5 * size * (1 - numpy.cos(numpy.pi * t[up] / opening))
        flow[down] = size * numpy.cos(0.5 * numpy.pi * (t[down] - opening) / closing)
    return flow


def bursts_of(random, cycles_, length, open_quotient, tract):
    """Sound of folds that meet and part, in a tract with the same poles and other zeros."""
    kicks = numpy.zeros(length)
    for begin, period, _ in cycles_:
        for time in (begin + open_quotient * period, begin + period):
            first, width = int(time * RATE) + random.integers(-8, 9), random.integers(4, 20)
            if 0 <= first < length - width:
                kicks[first:first + width] += (random.normal() * numpy.hanning(width + 2)[1:-1] +
                                               0.5 * random.random() * random.standard_normal(width))
    return sum(random.uniform(0.2, 1) * random.choice([-1, 1]) * 500 / f * resonate(kicks, f, b) for f, b in tract)


def voice(random, pitch, noise=1e-3, bursts=0, moves=False, wide=1, duration=0.091, turbulence=0):
    """Tract, flow and sound."""
    own = VOWELS[random.integers(10)] + (3500, 4500)
    tract = PLANE if random.random() < 0.5 else list(zip(own, (60, 80, 120, 175, 250)))
    tract = [(f, wide * b) for f, b in tract]
    length = int((duration + LEAD_IN) * RATE)
    periods = cycles(random, pitch * random.uniform(0.93, 1.07), duration + LEAD_IN)
    quotients = random.uniform(0.45, 0.75), random.uniform(1.5, 2.8)
    flow = flow_of(periods, length, *quotients) + 1e-4 * random.standard_normal(length)
    sound = numpy.diff(flow, prepend=0) * RATE
    for k, (f, b) in enumerate(tract):
        shift, loss = (0.1, 3) if k == 0 else (0.01, 1)
        sound = (resonate(sound, f * (1 + shift * (flow - 0.5)), b * (1 + loss * flow)) if moves else
                 resonate(sound, f, b))
    size = rms(sound)
    if bursts:
        ringing = bursts_of(random, periods, length, quotients[0], tract)
        sound += bursts * size * ringing / rms(ringing)
    sound += noise * size * random.standard_normal(length)
    if turbulence:
        jet = random.standard_normal(length) * numpy.clip(flow, 0, None)
        for f, b in tract:
            jet = resonate(jet, f, b)
        sound += turbulence * size * jet / rms(jet)
    begin = int(LEAD_IN * RATE)
    return tract, flow[begin:], sound[begin:]


def judge(tract, found, moves):
    """Whether the first three are F1 to F3, whether one below them is invented, how many of the three are missed, and
    for each of the others whether it lies within its spread. A formant is one of the tract within 5 %, of the interval
    that it moves through if it does; a second one there is invented."""
    true = numpy.array([f for f, _ in tract if f < 4500])
    tolerance = 0.05 * true
    if moves:
        tolerance += 0.005 * true
        tolerance[0] += 0.045 * true[0]
    distance = numpy.abs(found[:, :1] - true) if len(found) else numpy.empty((0, len(true)))
    nearest = distance.argmin(axis=1)
    is_real = distance[numpy.arange(len(found)), nearest] <= tolerance[nearest]
    right = len(found) >= 3 and all(distance[k, k] <= tolerance[k] for k in range(3))
    low = nearest[found[:, 0] < 1.05 * true[2]] if len(found) else nearest
    invented = not is_real[:len(low)].all() or len(set(low)) < len(low)
    heard = [k for k in range(3) if (distance[:, k] <= tolerance[k]).any()]
    within = [distance[:, k].min() <= found[distance[:, k].argmin(), 2] for k in heard]
    return right, invented, 3 - len(heard), within


def main():
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    print(f"{'':44} right  invented  F1-F3 missed  within spread  [%]")
    with tempfile.TemporaryDirectory() as folder:
        paths = [str(pathlib.Path(folder) / name) for name in ("flow.wav", "sound.wav")]
        totals = []
        for number, (family, settings) in enumerate(FAMILIES.items()):
            judged = []
            for index in range(VOICES):
                tract, *series = voice(numpy.random.default_rng([seed, number, index]), **settings)
                for path, values in zip(paths, series):
                    scipy.io.wavfile.write(path, RATE, (values / numpy.abs(values).max()).astype(numpy.float32))
                judged.append(judge(tract, probe.call("response", *paths), settings.get("moves", False)))
            totals += judged
            tell(family, judged)
        tell("all", totals)


def tell(family, judged):
    right, invented, missed, within = zip(*judged)
    within = [value for values in within for value in values]
    print(f"{family:44} {100 * numpy.mean(right):5.1f} {100 * numpy.mean(invented):9.1f} "
          f"{100 * numpy.mean(missed) / 3:13.1f} {100 * numpy.mean(within):14.0f}", flush=True)


if __name__ == "__main__":
    main()
