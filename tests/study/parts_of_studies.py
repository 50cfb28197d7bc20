"""The parts of a study by themselves: the front, orders of convergence, which points there are, and values of cases."""

import re

from study_folder import STUDY, StudyCase  # first: it finds the folders of the others

import case_values
import convergence
import evaluation
import points
import read_study


class PartsTest(StudyCase):
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
