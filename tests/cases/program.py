"""Starts Vocalis for the tests of whole cases, and reads the run folders that it leaves.

Every test of this folder is called as: NAME.py PROGRAM [--mpiexec mpiexec]
"""

import argparse
import csv
import json
import os
import pathlib
import signal
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TIMEOUT = 600  # [s] of one start


class Program:
    """The program under test, and what was found wrong with it so far."""

    def __init__(self, path, mpiexec):
        self.path = pathlib.Path(path).resolve()
        self.mpiexec = mpiexec
        self.failures = 0
        # mpiexec needs no grace to kill what is left after an exit code that is not 0: it would sleep a second or two.
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_odls_base_sigkill_timeout="0",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
                                OMPI_MCA_btl_vader_single_copy_mechanism="none", OMPI_MCA_mpi_yield_when_idle="1",
                                OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")

    def command(self, ranks, arguments):
        return [self.mpiexec, "--quiet", "-n", str(ranks), str(self.path), *map(str, arguments)]

    def start(self, ranks, *arguments, folder=None, timeout=TIMEOUT):
        """Runs to the end, in this folder: exit code and all words."""
        done = subprocess.run(self.command(ranks, arguments), cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout, check=False,
                              env=self.environment)
        return done.returncode, done.stdout.decode(errors="replace")

    def start_in_background(self, ranks, *arguments):
        return subprocess.Popen(self.command(ranks, arguments), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, env=self.environment)

    def kill(self, process):
        """Kills the ranks of a start in the background at once, as a crash does, and waits for mpiexec to notice."""
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="ascii")
        for child in map(int, children.split()):
            os.kill(child, signal.SIGKILL)
        process.wait(timeout=TIMEOUT)

    def expect(self, condition, what):
        """Counts and tells a failure; returns the condition."""
        if not condition:
            self.failures += 1
            print(f"FAILED  {what}", flush=True)
        return condition

    def expect_code(self, wanted, result, what):
        code, words = result
        return self.expect(code == wanted, f"{what}: exit code {code}, not {wanted}\n{words.strip()}\n")


def read_series(path):
    """Column names and columns of a CSV file of a run folder."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = [[float(row[i]) for row in rows[1:]] for i in range(len(rows[0]))]
    return rows[0], columns


def read_summary(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def main(test):
    """Calls test(program, folder) with a folder that is gone afterwards; returns the exit code."""
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--mpiexec", default="mpiexec")
    options = parser.parse_args()
    program = Program(options.program, options.mpiexec)
    with tempfile.TemporaryDirectory(prefix="vocalis case ") as folder:
        test(program, pathlib.Path(folder))
    print(f"{program.failures} failures")
    return 1 if program.failures else 0
