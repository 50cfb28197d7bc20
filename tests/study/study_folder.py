"""The folder of a made-up study and how it is started: with a program that stands in for Vocalis, in this process."""

import contextlib
import csv
import io
import os
import pathlib
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

import make_study  # noqa: E402

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


class StudyCase(unittest.TestCase):
    """A folder with study.toml and case.toml, gone afterwards."""

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
