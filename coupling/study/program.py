"""Starts the program as the script `vocalis` does, and measures what a start cost."""

import contextlib
import hashlib
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import threading
import time
from dataclasses import dataclass

from mistakes import UserError

PATIENCE = 10  # [s] between asking a run to end and ending it


@dataclass
class Cost:
    """What one start took, all its ranks together."""

    code: int
    wall_seconds: float
    core_seconds: float  # user and system time of every process of the start


class Program:
    def __init__(self, template):
        """`template`: a command line with the place {ranks} in it, the program's file last."""
        self._template = shlex.split(template)
        self._running = {}
        self._lock = threading.Lock()
        self._stopped = False

    def version(self):
        """Version as the program tells it. Raises UserError if it does not start."""
        done = subprocess.run(self._command(1, ["--help"]), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env=self._environment(1), check=False)
        found = re.search(r"Vocalis (\S+?):", done.stdout.decode(errors="replace"))
        if not found:
            raise UserError("the program must start and tell its version", shlex.join(self._command(1, ["--help"])),
                            "build it: ./vocalis build")
        return found.group(1)

    def build(self):
        """Fingerprint of the program's file, which tells builds of one version apart."""
        path = pathlib.Path(self._template[-1])
        return hashlib.sha256(path.read_bytes()).hexdigest()[:12] if path.is_file() else ""

    def check(self, case, settings):
        """Has the program check a case with settings: (exit code, the case with all its defaults, words)."""
        command = self._command(settings.get("ranks", 1), ["check", str(case), *as_options(settings)])
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=self._environment(settings.get("ranks", 1)), check=False)
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace").strip()

    def run(self, case, settings, folder, at_once=1):
        """Runs a case into a folder, its words into folder/words.txt, and waits: Cost. None if stop() ended it."""
        ranks = settings.get("ranks", 1)
        command = self._command(ranks, ["run", str(case), "--out", str(folder), *as_options(settings)])
        with open(folder / "words.txt", "wb") as words_file:
            with self._lock:
                if self._stopped:
                    return None
                start = time.perf_counter()
                process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=words_file,
                                           stderr=subprocess.STDOUT, env=self._environment(ranks, at_once),
                                           process_group=0)  # Ctrl-C comes to us alone
                self._running[process.pid] = process
            _, status, usage = os.wait4(process.pid, 0)  # mpirun waits for its ranks: their time is in its own
        wall = time.perf_counter() - start
        with self._lock:
            del self._running[process.pid]
            process.returncode = os.waitstatus_to_exitcode(status)
            if self._stopped:
                return None
        return Cost(process.returncode, wall, usage.ru_utime + usage.ru_stime)

    def stop(self):
        """Ends what is running, in every thread; nothing starts any more."""
        with self._lock:
            self._stopped = True
        for number, patience in ((signal.SIGTERM, PATIENCE), (signal.SIGKILL, 1)):
            with self._lock:
                for pid in self._running:
                    with contextlib.suppress(ProcessLookupError):  # it has just ended
                        os.killpg(pid, number)
            end = time.monotonic() + patience
            while self._running and time.monotonic() < end:
                time.sleep(0.05)

    def _command(self, ranks, arguments):
        return [part.replace("{ranks}", str(ranks)) for part in self._template] + arguments

    @staticmethod
    def _environment(ranks, at_once=1):
        """Ranks that wait for each other on too few cores give way; a single one waits for nobody, and would starve."""
        environment = dict(os.environ, VOCALIS_TERMINAL="0")
        environment.pop("VOCALIS_NOTE", None)
        if ranks > 1 and ranks * at_once > (os.cpu_count() or 1):
            environment["OMPI_MCA_mpi_yield_when_idle"] = "1"
        return environment


def as_options(settings):
    """--set options; a TOML value is the JSON value for texts, numbers, booleans and lists of them."""
    return [part for key, value in settings.items() if key != "ranks"
            for part in ("--set", f"{key}={json.dumps(value)}")]
