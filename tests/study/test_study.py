#!/usr/bin/python3
"""A study runs its points once, tells failed ones, and finds front, orders and errors.  Usage: test_study.py [PROGRAM
--mpiexec mpiexec]; with a program one small study of a real case runs, too."""

import argparse
import json
import os
import re
import sys
import unittest

from mistakes_in_studies import MistakesTest  # noqa: F401, as those below: unittest finds them here
from parts_of_studies import PartsTest  # noqa: F401
from results_of_studies import ResultsTest  # noqa: F401
from starts_of_points import StartsTest  # noqa: F401
from study_folder import ROOT, StudyCase

PROGRAM = argparse.Namespace(program=None, mpiexec="mpiexec")


class ProgramTest(StudyCase):
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
