#!/usr/bin/python3
"""Turns a run folder into RUN/report.html and RUN/pictures/*.png.  Usage: make_report.py RUN_FOLDER"""

import pathlib
import sys

import curves
import page
import phonation
import pictures
import spectrogram
import voices
from read_run import Run


def attempt(run, name, make):
    """A picture's path; None if the run has nothing for it. What goes wrong in one picture costs that picture only."""
    try:
        return make()
    except Exception as problem:
        run.missing.append((f"picture {name}", f"could not be made: {type(problem).__name__}: {problem}"))
        return None


def sections(run, folder):
    """The page's body: (heading, html) in reading order; empty sections are left out."""
    fields, history, microphones, spectra = run.fields, run.history, run.microphones, run.spectra

    def section(name, caption, available, make):
        path = attempt(run, name, make) if available is not None else None
        return page.picture(path, caption) if path else ""

    found = [("Key figures", page.key_figures(run.summary) if run.results() or run.summary.get("expected") else "")]
    found.append(("Mesh", section("mesh", "Regions and cells at rest.", fields, lambda: pictures.mesh(run, folder))))
    found.append(("Flow", section("speed", "Speed of the air; moving solids in grey-brown.", fields,
                                  lambda: pictures.speed(run, folder)) +
                  section("pressure", "Pressure of the incompressible flow.", fields,
                          lambda: pictures.pressure(run, folder))))
    found.append(("Over time", section("monitors", "Monitors over time.", history,
                                       lambda: curves.monitors(history, folder))))
    phonates = history if phonation.glottis(run) else None
    found.append(("Phonation", section("kymogram", "Opening of the glottis along the flow against time; red: closed.",
                                       run.kymogram, lambda: phonation.kymogram(run.kymogram, folder)) +
                  section("glottal_waves", "The last cycles.", phonates, lambda: phonation.waves(run, folder)) +
                  section("phase_portrait", "Phase portraits of the last cycles.", phonates,
                          lambda: phonation.portraits(run, folder))))
    found.append(("Sound", section("sound", "Acoustic pressure at one instant.", fields,
                                   lambda: pictures.sound(run, folder)) +
                  section("microphones", "Acoustic pressure at the microphones.", microphones,
                          lambda: curves.microphones(microphones, folder)) +
                  section("spectra", "Spectra; dashed: fundamental frequency and formants.", spectra,
                          lambda: curves.spectra(spectra, run.results(), folder)) +
                  compared(run, folder) +
                  section("spectrogram", "Sound over time and frequency; window of 5 ms.", microphones,
                          lambda: spectrogram.spectrogram(microphones, folder)) +
                  "\n".join(page.sound(path) for path in run.sounds())))
    found.append(("Cost", section("cost", "Wall time by phase of the step.", run.summary.get("phases"),
                                  lambda: curves.cost(run.summary, folder))))
    found.append(("Run", page.run_facts(run) if run.summary else ""))
    if run.missing:
        found.append(("Not shown", page.missing(run.missing)))
    return [(heading, content) for heading, content in found if content]


def compared(run, folder):
    """Several solvers over each other, where a run has them: the picture, then a table for each microphone."""
    solvers = voices.names(run)
    if len(solvers) < 2 or run.spectra is None:
        return ""
    path = attempt(run, "voices", lambda: voices.overlay(run.spectra, run.third_octaves, solvers, folder))
    caption = f"Acoustic solvers over each other; differences from {solvers[0]} by thirds of an octave."
    tables = [f"<p>Microphone {page.escape(microphone)}</p>\n" + page.table(rows, head, set(range(1, len(head))))
              for microphone, (head, rows) in voices.rows(run.third_octaves, run.results(), solvers).items()]
    return "\n".join(([page.picture(path, caption)] if path else []) + tables)


def make_report(folder):
    """Writes the report and returns its path."""
    run = Run(folder)
    body = "\n".join(f"<h2>{heading}</h2>\n{content}" for heading, content in sections(run, run.folder / "pictures"))
    status = run.summary.get("status")
    if status and status != "finished":
        reason = page.escape(run.summary.get("reason") or "no reason given")
        body = f'<p class="failed">This run {page.escape(status)}: {reason}</p>\n' + body
    case = run.resolved.get("case") if isinstance(run.resolved.get("case"), dict) else {}
    title = case.get("name") or run.summary.get("case") or run.folder.resolve().name
    path = run.folder / "report.html"
    path.write_text(page.page(title, case.get("description", ""), body), encoding="utf-8")
    return path


def main(arguments):
    if len(arguments) != 1 or not pathlib.Path(arguments[0]).is_dir():
        print("usage: make_report.py RUN_FOLDER", file=sys.stderr)
        return 2
    print(make_report(arguments[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
