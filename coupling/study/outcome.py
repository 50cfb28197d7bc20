"""What became of a point: its results and what they cost, kept in its run folder for the next call."""

import json
import math
from dataclasses import asdict, dataclass, field

from case_values import fingerprint

NOTE = "measured.json"  # beside the run's own files


@dataclass
class Identity:
    """What makes two computations of a point the same."""

    settings: dict
    case: str  # fingerprint of case file and geometry
    version: str


@dataclass
class Outcome:
    status: str = "waiting"  # or "finished", "failed"
    reason: str = ""
    results: dict = field(default_factory=dict)  # name -> finite value
    wall_seconds: float = math.nan  # of the whole start: meshing, steps, results
    core_seconds: float = math.nan  # user and system time of all ranks
    ranks: int = 1
    memory_bytes: float = math.nan  # largest, summed over the ranks
    steps: int = 0
    unknowns: dict = field(default_factory=dict)  # mesh -> number
    version: str = ""
    build: str = ""
    at_once: int = 1  # how many points were computed at the same time

    @property
    def finished(self):
        return self.status == "finished"


def identity_of(study, point, version):
    return Identity(point.settings, fingerprint(study.case, point.settings), version)


def write_note(folder, identity, build, cost, at_once):
    note = {"identity": asdict(identity), "build": build, "cost": asdict(cost), "at_once": at_once}
    unfinished = folder / f"{NOTE}.tmp"
    unfinished.write_text(json.dumps(note, indent=2) + "\n", encoding="utf-8")
    unfinished.replace(folder / NOTE)


def read_outcome(folder, identity):
    """The outcome that an earlier call left; status "waiting" if there is none, or if it was of something else."""
    try:
        note = json.loads((folder / NOTE).read_text(encoding="utf-8"))
        if note["identity"] != json.loads(json.dumps(asdict(identity))):
            return Outcome()
        cost = note["cost"]
        outcome = Outcome("failed", f"ended with exit code {cost['code']}: {last_words(folder)}",
                          wall_seconds=cost["wall_seconds"], core_seconds=cost["core_seconds"],
                          ranks=identity.settings.get("ranks", 1), version=identity.version, build=note["build"],
                          at_once=note["at_once"])
    except (OSError, ValueError, KeyError, TypeError):
        return Outcome()
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return outcome
    outcome.memory_bytes = summary.get("peak_memory_bytes") or math.nan
    outcome.steps = summary.get("steps") or 0
    outcome.unknowns = summary.get("unknowns") or {}
    outcome.results = {name: value for name, value in (summary.get("results") or {}).items() if value is not None}
    if cost["code"] == 0 and summary.get("status") == "finished":
        outcome.status, outcome.reason = "finished", ""
    else:
        outcome.reason = summary.get("reason") or outcome.reason
        outcome.results = {}  # of a run that did not reach its end
    return outcome


def last_words(folder):
    try:
        lines = (folder / "words.txt").read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return "no words"
    return next((line.strip() for line in reversed(lines) if line.strip()), "no words")
