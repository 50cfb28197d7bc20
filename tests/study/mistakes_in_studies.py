"""What a study refuses, and what it says then."""

from study_folder import STUDY, StudyCase


class MistakesTest(StudyCase):
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
