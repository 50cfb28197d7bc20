#!/usr/bin/python3
"""A study runs its points once, tells failed ones, and finds front, orders and errors.  Usage: test_study.py [PROGRAM
--mpiexec mpiexec]; with a program one small study of a real case runs, too."""

import argparse
import contextlib
import csv
import io
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "coupling/study"), str(ROOT / "report"), str(HERE.parent / "report")]

import case_values  # noqa: E402
import convergence  # noqa: E402
import evaluation  # noqa: E402
import make_study  # noqa: E402
import points  # noqa: E402
import read_study  # noqa: E402
import value_chart  # noqa: E402
from test_report import Checker  # noqa: E402

FAKE = f"/usr/bin/python3 -IS '{HERE / 'fake_program.py'}'"
CASE = "[mesh]\nsize = 0.1\n[time]\ndt = 0.1\n[fake]\n"
STUDY = """
[study]
name = "made_up"
case = "case.toml"
[[axis]]
key = "flow.elements"
values = ["P1P1", "P2P1"]
[[axis]]
key = "mesh.size"
values = [0.2, 0.1, 0.05]
order = true
[[reference]]
result = "drag_mean_N"
value = 100
uncertainty = 0.5
tolerance = 2
source = "made up"
[[reference]]
result = "lift_mean_N"
value = 0
relative_to = "drag_mean_N"
"""
PROGRAM = argparse.Namespace(program=None, mpiexec="mpiexec")


class StudyTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="vocalis study ")
        self.folder = pathlib.Path(self.temporary.name)
        self.write(STUDY)

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, study, case=CASE):
        (self.folder / "study.toml").write_text(study, encoding="utf-8")
        (self.folder / "case.toml").write_text(case, encoding="utf-8")

    @staticmethod
    def command(*options, program=FAKE):
        return ["study.toml", "--out", "out", "--program", program, *options]

    def start(self, *options, code=0, program=FAKE, picture=False):
        """Runs the study here; its words. Fails if the exit code is another."""
        words = io.StringIO()
        with contextlib.ExitStack() as stack:
            stack.enter_context(contextlib.chdir(self.folder))
            stack.enter_context(contextlib.redirect_stdout(words))
            stack.enter_context(contextlib.redirect_stderr(words))
            if not picture:
                stack.enter_context(unittest.mock.patch("chart.draw", return_value=None))
            found = make_study.main(self.command(*options, program=program))
        self.assertEqual(found, code, words.getvalue())
        return words.getvalue()

    def start_in_background(self):
        """A process of its own, which a signal may end; in any case it and its points end with the test."""
        study = str(ROOT / "coupling/study/make_study.py")
        process = subprocess.Popen(["/usr/bin/python3", "-B", study, *self.command()], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

        def end():
            for pid in [*self.children(process.pid), process.pid] if process.poll() is None else ():
                os.kill(pid, signal.SIGKILL)
            process.wait()
            process.stdout.close()

        self.addCleanup(end)
        return process

    @staticmethod
    def children(pid):
        files = pathlib.Path(f"/proc/{pid}/task").glob("*/children")
        return [int(child) for file in files for child in file.read_text(encoding="ascii").split()]

    def wait_for_starts(self, count):
        end = time.monotonic() + 120
        while len(self.starts()) < count and time.monotonic() < end:
            time.sleep(0.05)

    def starts(self):
        """Names of the points that were started, in order."""
        path = self.folder / "out/made_up/starts.txt"
        return path.read_text(encoding="utf-8").split() if path.exists() else []

    def rows(self, name="made_up"):
        with open(self.folder / "out" / name / "study.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def refuse(self, study, *words, case=CASE):
        """The study is refused with exit code 2 and a message that holds the words."""
        self.write(study, case)
        said = self.start(code=2)
        for word in ("found: ", "remedy: ", *words):
            self.assertIn(word, said)

    # What a whole study gives.

    def test_a_study_writes_errors_costs_picture_and_page(self):
        words = self.start("--table", "table.md", picture=True)
        self.assertIn("6 points of case.toml", words)
        rows = [row for row in self.rows() if row["result"] == "drag_mean_N"]
        self.assertEqual(len(rows), 6)
        for row in rows:
            factor, order = {"P1P1": (4, 1.5), "P2P1": (2, 3)}[row["flow.elements"]]
            value = 100 * (1 + factor * float(row["mesh.size"]) ** order + 0.001)
            self.assertAlmostEqual(float(row["value"]), value, places=5)
            self.assertAlmostEqual(float(row["error_percent"]), value - 100, places=5)
            self.assertGreater(float(row["core_s"]), 0.001)
            self.assertGreater(float(row["wall_s"]), 0.001)
            self.assertEqual(int(row["unknowns"]), round(9 / float(row["mesh.size"]) ** 2))
        self.assertEqual([row["point"] for row in rows if row["default"] == "yes"], ["P1P1, size 0.1"])
        lift = next(row for row in self.rows() if row["result"] == "lift_mean_N" and row["point"] == "P2P1, size 0.2")
        self.assertAlmostEqual(float(lift["error_percent"]), 1.7e-2, places=4)  # 0.01 of the drag's, of 100
        page = Checker((self.folder / "out/made_up/study.html").read_text(encoding="utf-8"))
        self.assertTrue(page.images[0]["src"].startswith("data:image/png;base64,"))
        self.assertIn("The case ships P1P1, size 0.1", page.text)
        self.assertTrue((self.folder / "out/made_up/study.png").read_bytes().startswith(b"\x89PNG"))
        table = (self.folder / "table.md").read_text(encoding="utf-8")
        self.assertRegex(table, r"\| drag mean \[N\] \| 135.\d+ \| 112.\d+ \| 104.\d+ \| 1.5 \| 100.1 \| 100 \| 0.5 %"
                                r" \| \*\*\+4.6 %\*\* \| 2 % \|")

    def test_a_chart_shows_results_against_each_axis_of_numbers(self):
        chart = '[chart]\ny = ["drag_mean_N", "drag_frequency_Hz"]\n'
        case = CASE + "fails_at = 0.2\n"
        self.write(STUDY.replace("order = true", 'order = true\nlabel = "h"\nunit = "m"') + chart, case)
        save = value_chart.style.save
        with unittest.mock.patch("value_chart.style.save", side_effect=save) as saved:
            self.start()
        panels = saved.call_args.args[0].axes
        self.assertEqual([panel.get_ylabel() for panel in panels], ["drag mean [N]", "drag frequency [Hz]"])
        self.assertEqual(panels[1].get_xlabel(), "h [mm]")
        drawn = {line.get_label(): line.get_xydata() for line in panels[0].lines}
        for elements, factor, order in (("P1P1", 4, 1.5), ("P2P1", 2, 3)):
            for (place, value), size in zip(drawn[elements], (0.05, 0.1), strict=True):  # 0.2 has failed
                self.assertAlmostEqual(place, 1000 * size)
                self.assertAlmostEqual(value, 100 * (1 + factor * size**order + 0.001), places=5)
        crosses = [line.get_xydata()[0, 0] for line in panels[0].lines if line.get_marker() == "x"]
        self.assertEqual(crosses, [200, 200])
        rings = [line.get_xydata()[0, 0] for line in panels[0].lines if line.get_fillstyle() == "none"]
        self.assertEqual(rings, [100])  # P1P1, size 0.1
        self.assertTrue((self.folder / "out/made_up/values.png").read_bytes().startswith(b"\x89PNG"))
        page = Checker((self.folder / "out/made_up/study.html").read_text(encoding="utf-8"))
        self.assertEqual(len(page.images), 1)
        self.assertIn("Results against what is varied", page.text)

    def test_a_chart_shows_the_axes_that_it_names(self):
        again = '[[axis]]\nkey = ["time.dt", "fake.seconds"]\nvalues = [[0.1, 0], [0.05, 0]]\n'
        chart = '[chart]\nx = "fake.seconds"\ny = "drag_mean_N"\n'
        self.write(STUDY + again + chart)
        axes = read_study.read_study(self.folder / "study.toml").chart.axes
        self.assertEqual([axis.keys for axis in axes], [("time.dt", "fake.seconds")])

    def test_the_table_keeps_the_text_around_its_marks_and_refuses_a_file_without_them(self):
        self.start("--table", "table.md")
        path = self.folder / "table.md"
        text = path.read_text(encoding="utf-8")
        path.write_text(f"Before.\n{text}After.\n", encoding="utf-8")
        self.start("--table", "table.md")
        self.assertEqual(path.read_text(encoding="utf-8"), f"Before.\n{text}After.\n")
        path.write_text("precious\n", encoding="utf-8")
        self.assertIn("<!-- studies: begin", self.start("--table", "table.md", code=2))
        self.assertEqual(path.read_text(encoding="utf-8"), "precious\n")

    def test_without_a_value_errors_are_against_the_finest_point_which_has_none(self):
        study = STUDY.replace('case = "case.toml"', 'case = "case.toml"\nreference_point = { "mesh.size" = 0.05, '
                                                    '"flow.elements" = "P2P1" }')
        self.write(study.split("[[reference]]")[0])
        self.start()
        rows = {row["point"]: row for row in self.rows() if row["result"] == "drag_mean_N"}
        best = 100 * (1 + 2 * 0.05**3 + 0.001)
        self.assertAlmostEqual(float(rows["P2P1, size 0.05"]["error_percent"]), 0)
        self.assertEqual(rows["P2P1, size 0.05"]["front"], "no")
        value = 100 * (1 + 2 * 0.2**3 + 0.001)
        self.assertAlmostEqual(float(rows["P2P1, size 0.2"]["error_percent"]), 100 * (value / best - 1), places=5)

    def test_what_the_case_expects_is_a_reference_unless_the_study_says_otherwise(self):
        case = CASE + """[expected.drag_mean_N]
value = 50.0
spread = 5.0
tolerance = 1
source = "the case"
[expected.lift_mean_N]
value = 0.0
[expected.drag_frequency_Hz]
value = 4.0
"""
        head = STUDY.split("[[reference]]")[0]
        scaled = '[[reference]]\nresult = "lift_mean_N"\nrelative_to = "drag_mean_N"\nnote = "small"\n'
        self.refuse(head, "relative to 0", "lift_mean_N", case=case)
        self.write(head + scaled, case)
        self.start("--table", "table.md")
        rows = {row["result"]: row for row in self.rows() if row["point"] == "P2P1, size 0.2"}
        value = 100 * (1 + 2 * 0.2**3 + 0.001)
        self.assertAlmostEqual(float(rows["drag_mean_N"]["error_percent"]), 2 * (value - 50), places=5)
        self.assertAlmostEqual(float(rows["lift_mean_N"]["error_percent"]), 0.02 * (value - 100), places=5)
        self.assertAlmostEqual(float(rows["drag_frequency_Hz"]["error_percent"]), 25)
        self.assertEqual((rows["drag_mean_N"]["reference_uncertainty"], rows["drag_mean_N"]["tolerance"]), ("5", "1"))
        table = (self.folder / "table.md").read_text(encoding="utf-8")
        for words in ("Reference of drag mean: the case.", "- lift mean: small"):
            self.assertIn(words, table)
        own = scaled.replace("lift_mean_N", "drag_mean_N", 1).replace("relative_to", "value = 100\nrelative_to")
        self.write(head.replace("[study]", "[study]\nexpected = false") + own, case)
        self.start()
        self.assertEqual({row["result"] for row in self.rows() if row["reference"]}, {"drag_mean_N"})
        self.write(head + own + scaled, case)
        self.start()
        first = self.rows()[0]
        self.assertEqual((first["result"], first["reference"], first["tolerance"]), ("drag_mean_N", "100", ""))

    # Going on, and what fails.

    def test_a_point_is_computed_once(self):
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.write(STUDY.replace("0.2, 0.1, 0.05", "0.2, 0.1, 0.05, 0.025"))
        self.start()
        self.assertEqual(self.starts()[6:], ["P1P1_size_0.025", "P2P1_size_0.025"])

    def test_a_point_is_computed_again_when_the_case_or_the_version_has_changed(self):
        self.start()
        self.write(STUDY, CASE + "seconds = 0.01\n")
        self.start()
        self.assertEqual(len(self.starts()), 12)
        self.write(STUDY, CASE + "seconds = 0.01\n[expected.drag_frequency_Hz]\nvalue = 1\n")  # changes no result
        self.start()
        self.assertEqual(len(self.starts()), 12)
        note = self.folder / "out/made_up/points/P1P1_size_0.1/measured.json"
        note.write_text(note.read_text(encoding="utf-8").replace("9.9.9", "9.9.8"), encoding="utf-8")
        self.start()
        self.assertEqual(self.starts()[12:], ["P1P1_size_0.1"])
        self.start("--anew")
        self.assertEqual(len(self.starts()), 19)

    def test_a_failed_point_is_kept_shown_and_run_again_only_when_asked(self):
        self.write(STUDY, CASE + "fails_at = 0.2\n")
        words = self.start("--table", "table.md")
        self.assertIn("P1P1, size 0.2: failed, the flow did not converge at 0.1 s", words)
        failed = [row for row in self.rows() if row["status"] == "failed"]
        self.assertEqual([row["point"] for row in failed], ["P1P1, size 0.2", "P2P1, size 0.2"])
        for row in failed:
            self.assertEqual((row["value"], row["front"]), ("", "no"))
            self.assertGreater(float(row["core_s"]), 0)
        for name in ("out/made_up/study.html", "table.md"):
            self.assertIn("the flow did not converge at 0.1 s", (self.folder / name).read_text(encoding="utf-8"))
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.start("--again")
        self.assertEqual(self.starts()[6:], ["P1P1_size_0.2", "P2P1_size_0.2"])

    def test_a_crash_is_a_failed_point_with_its_last_words(self):
        self.write(STUDY, CASE + "kills_at = 0.05\n")
        words = self.start()
        self.assertIn("failed, ended with exit code -9: the last words of a crash", words)
        self.assertEqual(sum(row["status"] == "failed" for row in self.rows()), 2)

    def test_after_ctrl_c_nothing_is_left_running_and_the_same_command_goes_on(self):
        self.write(STUDY, CASE + "waits_at = 0.05\n")
        process = self.start_in_background()
        self.wait_for_starts(3)
        children = self.children(process.pid)
        process.send_signal(signal.SIGINT)
        words = process.communicate(timeout=30)[0].decode()
        self.assertEqual(process.returncode, 130, words)
        self.assertIn("goes on from here", words)
        self.assertEqual(len(children), 1)
        self.assertFalse(pathlib.Path(f"/proc/{children[0]}").exists())
        self.assertEqual({row["status"] for row in self.rows()}, {"finished", "waiting"})
        self.write(STUDY)  # the key that waits is gone: the case has changed, and all are computed
        self.start()
        self.assertEqual({row["status"] for row in self.rows()}, {"finished"})

    def test_points_at_once_are_noted(self):
        self.start("--jobs", "3")
        self.assertEqual({row["points_at_once"] for row in self.rows()}, {"3"})

    def test_a_second_call_does_not_work_in_the_same_folder(self):
        self.write(STUDY, CASE + "waits_at = 0.2\n")
        first = self.start_in_background()
        self.wait_for_starts(1)
        self.assertIn("another call works", self.start("--draw", code=2))
        first.terminate()
        words = first.communicate(timeout=30)[0].decode()
        self.assertEqual(first.returncode, 130, words)

    def test_core_seconds_count_all_processes_and_wall_seconds_the_wait(self):
        self.write(STUDY, CASE + "seconds = 0.1\n")
        self.start(program=f"/bin/sh -c '\"$0\" \"$@\" & \"$0\" \"$@\"; wait' {FAKE}")  # two processes, 0.1 s each
        for row in self.rows():
            self.assertGreater(float(row["core_s"]), 0.2)
            self.assertLess(float(row["core_s"]), 3)
            self.assertGreater(float(row["wall_s"]), 0.1)

    # Mistakes.

    def test_mistakes_in_a_study_file_are_told(self):
        self.refuse(STUDY.replace("[[axis]]", "[[axes]]", 1), 'did you mean "axis"?')
        self.refuse(STUDY.replace("order = true", "ordr = true"), "[[axis]] 2", 'did you mean "order"?')
        self.refuse(STUDY.replace("values = [0.2, 0.1, 0.05]", "values = []"), "mesh.size without values")
        self.refuse(STUDY.replace("values = [0.2, 0.1, 0.05]", ""), "mesh.size without values")
        self.refuse(STUDY.replace('"case.toml"', '"cse.toml"'), 'did you mean "case.toml"?')
        self.refuse(STUDY.replace("value = 100", 'value = "100"'), "[[reference]] 1", "a finite number")
        self.refuse(STUDY.replace('relative_to = "drag_mean_N"', ""), "relative to 0")
        self.refuse(STUDY.replace('to = "drag_mean_N"', 'to = "drag_mean"'), 'did you mean "drag_mean_N"?')
        self.refuse(STUDY.replace("value = 100\n", ""), "drag_mean_N has no value", "reference_point")
        self.refuse(STUDY.replace('case = "case.toml"', 'case = "case.toml"\nvary = "grids"'), 'did you mean "grid"?')
        self.refuse(STUDY.replace('case = "case.toml"', 'case = "case.toml"\nranks = 0'), "ranks must be")
        self.refuse(STUDY + '[default]\nmesh.sise = 0.1\n', 'did you mean "mesh.size"?')
        self.refuse(STUDY + "[[axis]]\nkey = \"mesh.size\"\nvalues = [1]\n", "two axes")
        self.refuse(STUDY.replace("[study]", "[study"), "must be a TOML file")
        self.refuse(STUDY.split("[[axis]]")[0], "no [[axis]] and no [[point]]")
        self.refuse(STUDY.split("[[reference]]")[0], "measure errors against")
        self.refuse(STUDY + '[chart]\nx = "mesh.sise"\ny = "drag_mean_N"\n', 'did you mean "mesh.size"?')
        self.refuse(STUDY + '[chart]\nx = "flow.elements"\ny = "drag_mean_N"\n', "varies over numbers", "mesh.size")
        self.refuse(STUDY + '[chart]\nx = "mesh.size"\n', "an axis of numbers and a result")
        self.refuse(STUDY + "[chart]\ny = 1\n", "y must be a name")
        self.refuse(STUDY + '[chart]\nz = 1\ny = "drag_mean_N"\n', "not known", "choose one of: x, y")
        self.assertEqual(self.starts(), [])

    def test_what_the_program_does_not_take_is_told_before_the_first_run(self):
        self.refuse(STUDY.replace('"P2P1"', '"P3P2"'), "P3P2, size 0.2", "flow.elements must be known")
        self.assertEqual(self.starts(), [])

    def test_a_result_that_no_run_gave_is_told_with_the_nearest_name(self):
        self.refuse(STUDY.replace('result = "lift_mean_N"', 'result = "lift_maen_N"'), 'did you mean "lift_mean_N"?')
        self.assertEqual(len(self.rows()), 18)  # what was computed is not lost
        self.write(STUDY + '[chart]\ny = "drag_maen_N"\n')
        self.assertIn('a chart must be of a result', self.start(code=2))

    def test_a_wrong_command_is_told(self):
        for options in (["--job", "0"], ["--jobs", "0"], ["--ranks", "2"], ["--again", "--anew"]):
            self.assertIn("remedy: usage", self.start(*options, code=2))

    # Parts.

    def test_the_front_holds_what_no_other_point_beats(self):
        front = evaluation.pareto_front([0, 1, 2, 3, 4, 5], [1, 2, 2, 3, 4, 1], [9, 5, 6, 5, 1, 9])
        self.assertEqual(front, [0, 1, 4])
        self.assertEqual(evaluation.pareto_front([0, 1], [2, 1], [5, 5 + 1e-6]), [1])
        self.assertEqual(evaluation.pareto_front([], [], []), [])

    def test_order_and_limit_are_exact_for_any_ratio_of_sizes(self):
        for order in (0.5, 1, 2, 3.7):
            for sizes in ((4, 2, 1), (0.5, 0.3, 0.1)):
                found = convergence.convergence(sizes, [7 - 3 * size**order for size in sizes])
                self.assertAlmostEqual(found.order, order, places=6)
                self.assertAlmostEqual(found.limit, 7, places=6)
        self.assertAlmostEqual(convergence.convergence((8, 4, 2, 1), (99, 16, 4, 1)).order, 2, places=6)  # finest three

    def test_no_order_is_told_of_two_levels_or_of_values_that_do_not_converge(self):
        for values, words in (((1, 2), "fewer"), ((1, 2, 1.5), "not monotone"), ((1, 2, 2), "not monotone"),
                              ((1, 2, 4), "no convergence"), ((2, 2 - 1e-9, 2), "no change")):
            found = convergence.convergence((4, 2, 1)[-len(values):], values)
            self.assertIsNone(found.order)
            self.assertIn(words, found.words)

    def test_points_are_a_grid_or_one_axis_at_a_time_or_chosen(self):
        def labels(vary, more=""):
            self.write(STUDY.replace('case = "case.toml"', f'case = "case.toml"\nvary = "{vary}"') + more)
            study = read_study.read_study(self.folder / "study.toml")
            made = points.make_points(study, {"flow.elements": "P1P1", "mesh.size": 0.1, "time.dt": 0.1})
            return {point.label: point for point in made}

        chosen = '[[point]]\nlabel = "cheap"\nset = { flow.elements = "P1P1", mesh.size = 0.4, time.dt = 0.2 }\n'
        self.assertEqual(len(labels("grid", chosen)), 7)
        single = labels("one_at_a_time")
        self.assertEqual(set(single), {"P1P1, size 0.2", "P1P1, size 0.1", "P1P1, size 0.05", "P2P1, size 0.1"})
        self.assertEqual([label for label, point in single.items() if point.default], ["P1P1, size 0.1"])
        only = labels("points", chosen)
        self.assertEqual([point.values for point in only.values()],
                         [{"flow.elements": "P1P1", "mesh.size": 0.4, "time.dt": 0.2}])
        bare = re.sub("values = .*", "", STUDY).replace('case = "case.toml"', 'case = "case.toml"\nvary = "points"')
        self.write(bare + chosen)
        self.assertEqual(read_study.read_study(self.folder / "study.toml").axes[1].values, [(0.4,)])

    def test_keys_that_change_together_are_one_axis(self):
        self.write(STUDY.replace('key = "mesh.size"', 'key = ["mesh.size", "time.dt"]')
                   .replace("[0.2, 0.1, 0.05]", "[[0.2, 0.4], [0.1, 0.2], [0.05, 0.1]]"))
        self.start("--table", "table.md")
        self.assertEqual({row["time.dt"] for row in self.rows()}, {"0.4", "0.2", "0.1"})
        self.assertIn("| size 0.2 dt 0.4 | size 0.1 dt 0.2 | size 0.05 dt 0.1 |",
                      (self.folder / "table.md").read_text(encoding="utf-8"))

    def test_values_are_found_in_a_case_by_the_paths_of_set(self):
        tree = {"time": {"dt": 1}, "region": [{"name": "air"}, {"name": "fold", "density": 2}],
                "acoustic": [{"analogy": "none"}]}
        for key, value in (("time.dt", 1), ("region.fold.density", 2), ("region.1.density", 2), ("region.density", 2),
                           ("acoustic.analogy", "none"), ("time.end", None), ("region.air.density", None)):
            self.assertEqual(case_values.value_of(tree, key), value, key)

    # The program itself.

    def test_a_real_case_is_studied(self):
        if not PROGRAM.program:
            self.skipTest("no program given")
        self.write(f"""
[study]
name = "tube"
case = "{ROOT / 'cases/duct/tube.toml'}"
expected = false
set = {{ time.end = 2e-3, mesh.parameters.quarters = 1 }}
[[axis]]
key = "mesh.parameters.size_factor"
values = [2.0]
[[axis]]
key = "ranks"
values = [1, 2]
[[reference]]
result = "SPL_dB.inside"
value = 136
""")
        program = f"{PROGRAM.mpiexec} --quiet -n {{ranks}} '{PROGRAM.program}'"
        words = self.start(program=program)
        rows = self.rows("tube")
        self.assertEqual([row["status"] for row in rows], ["finished"] * 2, words)
        for row in rows:
            summary = json.loads((self.folder / "out/tube/points" / re.sub("[, ]+", "_", row["point"]) / "summary.json")
                                 .read_text(encoding="utf-8"))
            self.assertEqual(summary["ranks"], int(row["ranks"]))
            self.assertAlmostEqual(float(row["value"]), summary["results"]["SPL_dB.inside"], places=5)
            self.assertLess(abs(float(row["error_percent"])), 20)
            self.assertGreater(float(row["core_s"]), 0.5 * summary["wall_seconds"])  # the ranks' time is counted
        self.write((self.folder / "study.toml").read_text(encoding="utf-8").replace("size_factor", "size_facto"))
        self.assertIn("size_factor", self.start(code=2, program=program))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("program", nargs="?")
    parser.add_argument("--mpiexec", default="mpiexec")
    PROGRAM, rest = parser.parse_known_args()
    PROGRAM.program = PROGRAM.program and os.path.abspath(PROGRAM.program)
    unittest.main(argv=[sys.argv[0], *rest])
