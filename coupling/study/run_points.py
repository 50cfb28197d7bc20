"""Computes the points of a study that are not computed yet, and goes on where an earlier call stopped."""

import concurrent.futures
import fcntl

from base_values import check_points, refused
from mistakes import UserError
from outcome import NOTE, identity_of, read_outcome, write_note


class Stopped(Exception):
    """The user's Ctrl-C; what was running is ended."""


class Folder:
    """A study's folder, held by one call at a time: used in `with`."""

    def __init__(self, path):
        self.path = path

    def __enter__(self):
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self._lock = open(self.path / "lock", "w", encoding="utf-8")
        except OSError as problem:
            raise UserError("the study's folder must be writable", f"{self.path}: {problem.strerror}",
                            "choose another with --out DIR") from None
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._lock.close()
            raise UserError("a study runs once at a time", f"another call works in {self.path}",
                            "wait for its end, or choose another folder with --out DIR") from None
        return self

    def __exit__(self, *_):
        self._lock.close()

    def of(self, point):
        return self.path / "points" / point.folder


def read_outcomes(study, points, folder, version):
    """What is known of each point, in order."""
    return [read_outcome(folder.of(point), identity_of(study, point, version)) for point in points]


def run_points(study, points, folder, program, jobs, again, tell):
    """Computes every point that waits, and those whose status is in `again`; `tell(number, point, outcome)` after each.
    Raises UserError if the program refuses a point, Stopped on Ctrl-C. Returns the outcomes."""
    version = program.version()
    outcomes = read_outcomes(study, points, folder, version)
    waiting = [i for i, outcome in enumerate(outcomes) if outcome.status == "waiting" or outcome.status in again]
    for i in waiting:  # so that after a stop the next call takes these up
        (folder.of(points[i]) / NOTE).unlink(missing_ok=True)
    pool = concurrent.futures.ThreadPoolExecutor(jobs)
    try:
        check_points(study, program, [points[i] for i in waiting])
        tasks = {pool.submit(_compute, study, points[i], folder, program, version, jobs): i for i in waiting}
        for task in concurrent.futures.as_completed(tasks):
            i = tasks[task]
            outcomes[i] = task.result()
            tell(i, points[i], outcomes[i])
    except KeyboardInterrupt:
        program.stop()
        raise Stopped from None
    except BaseException:
        program.stop()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
    return outcomes


def _compute(study, point, folder, program, version, jobs):
    run_folder = folder.of(point)
    run_folder.mkdir(parents=True, exist_ok=True)
    identity, build = identity_of(study, point, version), program.build()
    cost = program.run(study.case, point.settings, run_folder, jobs)
    if cost is not None and cost.code == 2:
        said = (run_folder / "words.txt").read_text(encoding="utf-8", errors="replace")
        raise refused(study, point.label, said.strip())
    if cost is not None:
        write_note(run_folder, identity, build, cost, jobs)
    return read_outcome(run_folder, identity)
