#!/usr/bin/python3
"""Formants, pitch and level of sound files as Praat finds them, against ours.  Usage: against_praat.py SIGNAL_PROBE
[FILE.wav]...: without files, of ten synthetic vowels at three pitches."""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy

import probe

VOWELS = ("i", "I", "E", "ae", "A", "O", "U", "u", "V", "er")
PITCHES = (100, 150, 220)  # [Hz]
TOLERANCE = {"formant": 0.02, "pitch": 0.005, "level": 0.05}  # relative, relative, [dB]

# The defaults of "To Formant (burg)" for men: 5 formants below 5000 Hz, window of 25 ms, pre-emphasis from 50 Hz.
SCRIPT = """
form Sound file
  sentence File
  sentence Table
endform
sound = Read from file: file$
level = Get intensity (dB)
selectObject: sound
pitch = To Pitch: 0, 60, 500
frequency = Get quantile: 0, 0, 0.5, "Hertz"
writeInfoLine: level, " ", frequency
selectObject: sound
formant = To Formant (burg): 0, 5, 5000, 0.025, 50
table = Down to Table: "no", "no", 6, "no", 3, "yes", 6, "yes"
Save as comma-separated file: table$
"""


WIDEST = 1000  # [Hz] a broader root shapes the tilt of the spectrum; whether a frame has one is a matter of rounding


def resonances(row):
    """The formants of one frame, (frequency, bandwidth), without broad roots."""
    found = [(row[f"F{k}(Hz)"], row[f"B{k}(Hz)"]) for k in range(1, 6)]
    found = [(float(f), float(b)) for f, b in found if "undefined" not in f + b]
    return [(f, b) for f, b in found if b <= WIDEST]


def of_praat(sound, folder):
    """Level [dB], pitch [Hz], [(frequency, bandwidth)]: medians over those frames that have so many formants, if half
    of them do."""
    script, table = folder / "look.praat", folder / "formants.csv"
    script.write_text(SCRIPT)
    done = subprocess.run(["praat", "--run", str(script), str(sound), str(table)], check=True, stdout=subprocess.PIPE,
                          text=True)
    level, pitch = (float(word) if "undefined" not in word else 0.0 for word in done.stdout.split())
    with open(table, newline="") as file:
        frames = [resonances(row) for row in csv.DictReader(file)]
    formants = []
    for k in range(5):
        having = [frame[k] for frame in frames if len(frame) > k]
        if 2 * len(having) < len(frames):
            break
        formants.append(tuple(numpy.median(having, axis=0)))
    return level, pitch, formants


def compare(name, sound, folder, largest):
    level, pitch, formants = of_praat(sound, folder)
    ours = probe.call("formants", sound)
    words = []
    for k, (frequency, bandwidth) in enumerate(formants[:4]):
        error = abs(ours[k, 0] / frequency - 1) if k < len(ours) else 1.0
        largest["formant"] = max(largest["formant"], error)
        words.append(f"F{k + 1} {ours[k, 0]:.1f} ({frequency:.1f}) B{k + 1} {ours[k, 1]:.0f} ({bandwidth:.0f})")
    here = probe.call("pitch", sound)[0, 0]
    if pitch:
        largest["pitch"] = max(largest["pitch"], abs(here / pitch - 1))
    loud = probe.call("level", sound)[0, 0]
    largest["level"] = max(largest["level"], abs(loud - level))
    print(f"{name:>12}: f0 {here:.2f} ({pitch:.2f})  {'  '.join(words)}  SPL {loud:.2f} ({level:.2f})")


def run(look):
    """Calls look(folder, largest), which compares sounds; the folder is gone afterwards. Returns the exit code."""
    if not shutil.which("praat"):
        probe.skip("the Debian package praat is not installed")
    largest = dict.fromkeys(TOLERANCE, 0.0)
    print("ours (Praat's), Hz and dB")
    with tempfile.TemporaryDirectory() as folder:
        look(pathlib.Path(folder), largest)
    for quantity, tolerance in TOLERANCE.items():
        print(f"largest difference of {quantity}: {largest[quantity]:.2g}, tolerance {tolerance}")
    return any(largest[quantity] > tolerance for quantity, tolerance in TOLERANCE.items())


def look(folder, largest):
    for sound in sys.argv[2:]:
        compare(pathlib.Path(sound).name, pathlib.Path(sound).resolve(), folder, largest)
    for number, vowel in enumerate(VOWELS if len(sys.argv) == 2 else ()):
        for pitch in PITCHES:
            sound = folder / "vowel.wav"
            probe.call("vowel", number, pitch, sound)
            compare(f"{vowel} {pitch} Hz", sound, folder, largest)


if __name__ == "__main__":
    sys.exit(run(look))
