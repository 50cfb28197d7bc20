#!/usr/bin/python3
"""Formants, pitch and level of the sound files that short runs leave, as Praat finds them, against ours.
Usage: runs_against_praat.py SIGNAL_PROBE PROGRAM [MPIEXEC]"""

import json
import os
import pathlib
import subprocess
import sys

import against_praat

HERE = pathlib.Path(__file__).resolve().parent
CASES = ("sung_tube", "sung_i")
PITCHES = (110, 220)  # [Hz]


def sing(case, pitch, folder):
    """The sound file and the results of a run, whose source has this pitch [Hz]."""
    subprocess.run([sys.argv[3] if len(sys.argv) > 3 else "mpiexec", "-n", "1", os.path.abspath(sys.argv[2]), "run",
                    HERE / f"{case}.toml", "--out", folder, "--set", f"source.fundamental_frequency={pitch}"],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, timeout=600)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return folder / "microphone_mouth.wav", summary["results"]


def look(folder, largest):
    for case in CASES:
        for pitch in PITCHES:
            sound, results = sing(case, pitch, folder / f"{case}_{pitch}")
            against_praat.compare(f"{case} {pitch} Hz", sound, folder, largest)
            if results["f0_Hz"] != pitch:
                raise SystemExit(f"{case}: f0 is {results['f0_Hz']} Hz, but the source's is {pitch} Hz")


if __name__ == "__main__":
    sys.exit(against_praat.run(look))
