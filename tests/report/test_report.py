#!/usr/bin/python3
"""The report reads any run folder, complete or not, and writes one valid page."""

import html.parser
import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "report")]

import numpy  # noqa: E402

import curves  # noqa: E402
import fields  # noqa: E402
import make_report  # noqa: E402
import phonation  # noqa: E402
import spectrogram  # noqa: E402
import synthetic_run  # noqa: E402
import voices  # noqa: E402
from read_run import Run  # noqa: E402


class Checker(html.parser.HTMLParser):
    """Every tag is closed in order; collects pictures, headings, text."""

    EMPTY = {"meta", "img", "br"}

    def __init__(self, text):
        super().__init__()
        self.open, self.images, self.text = [], [], ""
        self.feed(text)
        assert not self.open, f"unclosed: {self.open}"

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.images.append(dict(attributes))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, f"misplaced </{tag}>"

    def handle_data(self, data):
        self.text += data


class ReportTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def report(self):
        page = Checker(make_report.make_report(self.folder).read_text(encoding="utf-8"))
        for image in page.images:
            self.assertTrue(image["src"].startswith("data:image/png;base64,"))
            self.assertTrue(image["alt"])
        return page

    def pictures(self):
        return {path.stem for path in (self.folder / "pictures").glob("*.png")}

    def test_a_complete_run_shows_every_picture(self):
        synthetic_run.voice(self.folder)
        page = self.report()
        self.assertEqual(self.pictures(), {"mesh", "speed", "pressure", "monitors", "sound", "microphones", "spectra",
                                           "spectrogram", "cost"})
        self.assertEqual(len(page.images), 9)
        self.assertNotIn("Not shown", page.text)
        self.assertIn("<audio", (self.folder / "report.html").read_text(encoding="utf-8"))
        for text in ("synthetic voice", "within", "outside", "312 MiB", "one-dimensional tract"):
            self.assertIn(text, page.text)

    def test_folds_that_phonate_have_kymogram_waves_and_portraits(self):
        synthetic_run.phonation(self.folder)
        page = self.report()
        self.assertLessEqual({"kymogram", "glottal_waves", "phase_portrait"}, self.pictures())
        self.assertNotIn("Not shown", page.text)
        run = Run(self.folder)
        self.assertEqual(phonation.glottis(run), "folds")
        self.assertEqual(phonation.flow_of(run, "folds")[0], "flow_m2_s")
        del run.history.columns["flow_m2_s"]
        self.assertEqual(phonation.flow_of(run, "folds"), (None, None))
        run.summary["results"]["folds_f0_Hz"] = 100.0
        time = run.history.columns["time_s"][phonation.last_cycles(run, "folds")]
        self.assertAlmostEqual(time[-1] - time[0], 0.05, delta=1e-4)

    def test_several_solvers_are_laid_over_each_other_with_their_differences(self):
        synthetic_run.voices(self.folder)
        page = self.report()
        self.assertIn("voices", self.pictures())
        self.assertNotIn("Not shown", page.text)
        run = Run(self.folder)
        (head, rows), = voices.rows(run.third_octaves, run.results(), voices.names(run)).values()
        self.assertEqual(head, ["band", "rate [dB re 20 µPa]", "pcwe [dB above it]", "none [dB above it]"])
        self.assertEqual(rows[0], ["all", "80.0", "+3.0", "–"])
        self.assertEqual(rows[2], ["500 Hz", "65.0", "+3.0", "–"])
        self.assertEqual(len(rows), 4)

    def test_one_solver_is_laid_over_nothing(self):
        synthetic_run.voices(self.folder)
        run = Run(self.folder)
        self.assertEqual(voices.by_microphone(run.spectra, "psd_dB", ["rate"]), {})
        self.assertIsNone(voices.overlay(run.spectra, run.third_octaves, ["rate"], self.folder / "pictures"))

    def test_acoustics_alone_in_space_shows_a_cut_and_says_what_is_missing(self):
        synthetic_run.tract(self.folder)
        page = self.report()
        self.assertEqual(self.pictures(), {"mesh", "sound"})
        self.assertIn("This run failed: <no reason> & more", page.text)
        for name in ("history.csv", "microphones.csv", "spectra.csv"):
            self.assertIn(name, page.text)

    def test_an_empty_folder_gives_a_page(self):
        page = self.report()
        self.assertEqual(page.images, [])
        self.assertIn("summary.json is not in the run folder", page.text)

    def test_broken_files_are_named_and_cost_only_their_own_section(self):
        synthetic_run.voice(self.folder)
        for name in ("summary.json", "fields.h5", "spectra.csv", "resolved.toml"):
            (self.folder / name).write_text("neither this nor that {", encoding="utf-8")
        page = self.report()
        self.assertEqual(self.pictures(), {"monitors", "microphones", "spectrogram"})
        self.assertIn("fields.h5 could not be read", page.text)

    def test_a_table_keeps_notes_and_leaves_out_a_row_cut_short(self):
        text = "# density_kg_m3: 1.14\ntime_s,gap_m\n0,1e-3\n1,2e-3\n2"
        (self.folder / "history.csv").write_text(text, encoding="utf-8")
        table = Run(self.folder).history
        self.assertEqual(table.notes, {"density_kg_m3": "1.14"})
        numpy.testing.assert_array_equal(table.columns["gap_m"], [1e-3, 2e-3])

    def test_a_steady_tone_has_its_level_at_its_frequency_in_every_frame_of_the_spectrogram(self):
        tone = 0.5 * numpy.cos(2 * numpy.pi * 1200 * numpy.arange(4410) / 44100)
        times, frequency, level = spectrogram.short_time_spectra(tone, 44100)
        self.assertLess(times[-1], 0.1)
        numpy.testing.assert_allclose(frequency[level.argmax(axis=0)], 1200, atol=frequency[1])
        numpy.testing.assert_allclose(level.max(axis=0), 20 * numpy.log10(0.5 / 2**0.5 / 20e-6), atol=0.1)
        self.assertIsNone(spectrogram.short_time_spectra(tone[:100], 44100))

    def test_names_carry_their_units(self):
        self.assertEqual(curves.split_unit("gap_peak_m"), ("gap peak", "m", ""))
        self.assertEqual(curves.split_unit("SPL_dB.mouth"), ("SPL", "dB", "mouth"))
        self.assertEqual(curves.split_unit("flow_mean_m3_s"), ("flow mean", "m³/s", ""))
        self.assertEqual(curves.split_unit("tip_x_m_mean"), ("tip x mean", "m", ""))
        self.assertEqual(curves.split_unit("min_cell_quality"), ("min cell quality", "", ""))

    def test_the_cut_of_a_box_has_the_area_of_its_middle_and_interpolates_exactly(self):
        synthetic_run.tract(self.folder)
        run = Run(self.folder)
        plane = fields.Plane(run.fields)
        a, b, c = (plane.points[plane.triangles[:, i]] for i in range(3))
        area = 0.5 * numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()
        self.assertAlmostEqual(area, 0.1 * 0.04, places=12)
        linear = plane.on_points(run.fields.coordinates @ [2.0, -3.0, 0.0])
        numpy.testing.assert_allclose(linear, plane.points @ [2.0, -3.0], atol=1e-12)

    def test_half_models_are_told_by_their_symmetry_line(self):
        synthetic_run.voice(self.folder)
        run = Run(self.folder)
        self.assertTrue(run.is_half_model(run.fields.coordinates))
        run.resolved["flow"]["boundary"][0]["kind"] = "wall"
        self.assertFalse(run.is_half_model(run.fields.coordinates))


if __name__ == "__main__":
    unittest.main()
