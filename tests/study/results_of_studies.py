"""What a whole study gives: errors, costs, charts, tables, and what they are measured against."""

import unittest.mock

from study_folder import CASE, STUDY, StudyCase  # first: it finds the folders of the others

import read_study
import value_chart
from test_report import Checker


class ResultsTest(StudyCase):
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
