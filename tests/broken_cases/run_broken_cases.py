#!/usr/bin/python3
"""Runs Vocalis on broken input and asserts exit code 2 and a message that says what is wrong and what to do.

usage: run_broken_cases.py PROGRAM [--mpiexec mpiexec] [--ranks 1,3] [--only WORDS] [--at-once N]
"""

import argparse
import concurrent.futures
import functools
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cases"))

from mistakes import MISTAKES, Mistake  # noqa: E402
from program import Program  # noqa: E402

TIMEOUT = 120  # [s]


def start(program, ranks, arguments, folder):
    """Exit code and all words; code None if it hung."""
    try:
        return program.start(ranks, *arguments, folder=folder, timeout=TIMEOUT)
    except subprocess.TimeoutExpired as late:
        return None, (late.stdout or b"").decode(errors="replace")


def expect(program, name, ranks, result, words=(), wanted_code=2):
    """A mistake is told once, with its remedy."""
    code, text = result
    problems = []
    if code != wanted_code:
        problems.append("it hung" if code is None else f"exit code {code}, not {wanted_code}")
    problems += [f"the message lacks {word!r}" for word in words if word not in text]
    if wanted_code == 2 and text.count("remedy: ") != 1:
        problems.append(f"the remedy stands there {text.count('remedy: ')} times")
    return program.expect(not problems, f"{name} ({ranks} ranks): {'; '.join(problems)}\n{text.strip()}\n")


def copy_scene(folder):
    for path in HERE.iterdir():
        if path.suffix in (".geo", ".msh", ".toml", ".csv", ".wav"):
            shutil.copy(path, folder)


def run_mistake(mistake: Mistake, program, ranks, folder):
    copy_scene(folder)
    path = folder / mistake.case
    text = path.read_text()
    for old, new in mistake.change:
        assert text.count(old) >= 1, f"{mistake.name}: {mistake.case} has no {old!r}"
        text = text.replace(old, new, 1)
    path.write_text(text)
    before = sorted(folder.iterdir())
    arguments = [argument.replace("{folder}", str(folder)) for argument in mistake.arguments]
    result = start(program, ranks, [mistake.command, mistake.case, *arguments], folder)
    expect(program, mistake.name, ranks, result, mistake.words)
    left = sorted(set(folder.iterdir()) - set(before))
    program.expect(not left, f"{mistake.name} ({ranks} ranks): left behind {left}\n")


def run_sound_cases(program, ranks, folder):
    """What is sound passes, or else the mistakes above would be found for a wrong reason."""
    copy_scene(folder)
    for case in ("scene.toml", "pulse.toml", "square.toml"):
        expect(program, f"sound case {case}", ranks, start(program, ranks, ["check", case], folder), wanted_code=0)


def run_files(program, ranks, folder):
    """Case files that cannot be read."""
    (folder / "folder.toml").mkdir()
    (folder / "binary.toml").write_bytes(bytes(range(256)))
    (folder / "empty.toml").write_text("")
    for name, words in (("nowhere.toml", ["nowhere.toml"]), ("folder.toml", ["folder.toml", "a folder"]),
                        ("binary.toml", ["binary.toml", "TOML"]), ("empty.toml", ["empty.toml", "is needed"])):
        expect(program, f"case file {name}", ranks, start(program, ranks, ["check", name], folder), words)


def run_checkpoints(program, ranks, folder):
    """Runs that cannot go on: no run, no checkpoint, a checkpoint that is cut, or that of another case."""
    copy_scene(folder)
    for name in ("scene", "pulse"):
        what = f"run of {name}.toml"
        result = start(program, ranks, ["run", f"{name}.toml", "--out", folder / name], folder)
        if not (expect(program, what, ranks, result, wanted_code=0) and
                program.expect((folder / name / "checkpoint.h5").is_file(),
                               f"{what} ({ranks} ranks): it left no checkpoint.h5\n")):
            return
    (folder / "empty").mkdir()
    shutil.copytree(folder / "scene", folder / "without")
    (folder / "without/checkpoint.h5").unlink()
    shutil.copytree(folder / "scene", folder / "cut")
    checkpoint = (folder / "scene/checkpoint.h5").read_bytes()
    (folder / "cut/checkpoint.h5").write_bytes(checkpoint[:len(checkpoint) // 2])
    shutil.copytree(folder / "scene", folder / "letter")
    (folder / "letter/checkpoint.h5").write_text("This is a letter.")
    shutil.copytree(folder / "scene", folder / "other")
    shutil.copy(folder / "pulse/checkpoint.h5", folder / "other/checkpoint.h5")
    for name, words in (("nowhere", ["nowhere", "run folder"]), ("empty", ["empty", "resolved.toml"]), ("without", ["checkpoint"]),
                        ("cut", ["checkpoint"]), ("letter", ["checkpoint"]), ("other", ["checkpoint"])):
        expect(program, f"resume of {name}", ranks, start(program, ranks, ["resume", folder / name], folder), words)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", default="1,3")
    parser.add_argument("--only", default="", help="run only what has these words in its name")
    parser.add_argument("--at-once", type=int, default=2 * os.cpu_count(), help="starts of the program side by side")
    options = parser.parse_args()
    program = Program(options.program, options.mpiexec)
    chosen = []
    for ranks in map(int, options.ranks.split(",")):
        jobs = [("checkpoints", run_checkpoints), ("sound cases", run_sound_cases), ("files", run_files)]
        jobs += [(mistake.name, functools.partial(run_mistake, mistake)) for mistake in MISTAKES]
        chosen += [(job, ranks) for name, job in jobs if options.only in name]

    def carry_out(job, ranks):
        with tempfile.TemporaryDirectory(prefix="vocalis broken ") as folder:
            job(program, ranks, pathlib.Path(folder))

    with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
        for done in [pool.submit(carry_out, job, ranks) for job, ranks in chosen]:
            done.result()
    print(f"{len(chosen)} groups of broken input, {program.failures} failures")
    return 1 if program.failures else 0


if __name__ == "__main__":
    sys.exit(main())
