#!/usr/bin/python3
"""Weighs error against cost: runs the points of study files and writes study.csv, study.png, study.html of each.

The script `vocalis` calls it with the program's command line. Exit codes: 0 done, 2 the user's mistake, 130 stopped."""

import argparse
import pathlib
import signal
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "report")]

import chart  # noqa: E402
import value_chart  # noqa: E402
from base_values import base_values  # noqa: E402
from evaluation import evaluate  # noqa: E402
from mistakes import UserError  # noqa: E402
from points import make_points  # noqa: E402
from program import Program  # noqa: E402
from read_study import read_study  # noqa: E402
from references import missing_results  # noqa: E402
from run_points import Folder, Stopped, read_outcomes, run_points  # noqa: E402
from study_page import verdict, write_page  # noqa: E402
from write_csv import write_csv  # noqa: E402
from write_table import text_around, write_table  # noqa: E402


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        raise UserError("the command cannot be understood", message, self.format_usage().strip())


def parse(arguments):
    parser = Arguments(prog="vocalis study", description="Error against cost over the settings of a case.")
    parser.add_argument("files", nargs="+", metavar="FILE.toml", help="study files; docs/study.md tells what they hold")
    parser.add_argument("--out", type=pathlib.Path, default="runs/studies", help="folder of the studies' own folders")
    parser.add_argument("--table", type=pathlib.Path, metavar="FILE.md", help="write all studies as Markdown tables")
    parser.add_argument("--jobs", type=int, default=1, help="points at the same time; they disturb each other's times")
    again = parser.add_mutually_exclusive_group()
    again.add_argument("--again", action="store_const", dest="again", const=("failed",), default=(),
                       help="run failed points again")
    again.add_argument("--anew", action="store_const", dest="again", const=("failed", "finished"),
                       help="run all points again")
    parser.add_argument("--draw", action="store_true", help="run nothing: show what there is")
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error(f"--jobs must be at least 1, found {options.jobs}")
    return options


def say(words):
    print(words, flush=True)


def carry_out(study, options, program):
    """Runs and writes one study; returns its evaluation."""
    points = make_points(study, base_values(study, program))
    folder = Folder(options.out / study.name)
    say(f"{study.name}: {len(points)} points of {study.case.name}, into {folder.path}")

    warned = []

    def tell(i, point, outcome):
        state = outcome.reason if outcome.status == "failed" else f"{outcome.core_seconds:.4g} core-seconds"
        say(f"  {i + 1:>3}/{len(points)}  {point.label}: {outcome.status}, {state}")
        mistake = missing_results(study, [outcome])
        if mistake and not warned:  # perhaps other points give it: the study goes on
            say(f"vocalis: {mistake}")
            warned.append(mistake)

    with folder:
        try:
            if options.draw:
                outcomes = read_outcomes(study, points, folder, program.version())
            else:
                outcomes = run_points(study, points, folder, program, options.jobs, options.again, tell)
        except Stopped:
            outcomes = read_outcomes(study, points, folder, program.version())
            write(study, points, outcomes, folder)
            raise
        evaluation = write(study, points, outcomes, folder, program.build())
    mistake = missing_results(study, outcomes)
    if mistake:
        raise mistake
    return evaluation


def write(study, points, outcomes, folder, build=None):
    evaluation = evaluate(study, points, outcomes)
    write_csv(evaluation, folder.path / "study.csv")
    pictures = value_chart.draw(evaluation, folder.path), chart.draw(evaluation, folder.path)
    path = write_page(evaluation, *pictures, folder.path / "study.html")
    older = sum(outcome.status != "waiting" and outcome.build != build for outcome in outcomes)
    if build and older:
        say(f"  {older} points are from an earlier build of this version; --anew computes all again")
    failed = sum(outcome.status == "failed" for outcome in outcomes)
    if failed:
        say(f"  {failed} points failed; --again tries them once more")
    say(f"  {verdict(evaluation)}\n  study: {path}")
    return evaluation


def run(arguments):
    options = parse(arguments)
    studies = [read_study(path) for path in options.files]
    names = [study.name for study in studies]
    for name in names:
        if names.count(name) > 1:
            raise UserError("studies of one call must have different names", f"{name} twice", "change name in [study]")
    if options.table:
        text_around(options.table)  # its mistakes now, not after the runs
    program = Program(options.program)
    evaluations = [carry_out(study, options, program) for study in studies]
    if options.table:
        write_table(evaluations, options.table)
        say(f"table: {options.table}")


def stop(*_):
    raise KeyboardInterrupt


def main(arguments):
    for number in (signal.SIGINT, signal.SIGTERM):  # SIGINT, too: shells have it ignored in the background
        signal.signal(number, stop)
    try:
        run(arguments)
    except UserError as mistake:
        print(f"vocalis: {mistake}", file=sys.stderr)
        return 2
    except (KeyboardInterrupt, Stopped):
        print("vocalis: stopped; the same command, without --again and --anew, goes on from here", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
