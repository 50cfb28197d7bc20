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

from mistakes import MISTAKES, Mistake

HERE = pathlib.Path(__file__).resolve().parent
TIMEOUT = 120  # [s]


class Runner:
    def __init__(self, options):
        self.program = pathlib.Path(options.program).resolve()
        self.mpiexec = options.mpiexec
        self.failures = []
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
                                OMPI_MCA_btl_vader_single_copy_mechanism="none", OMPI_MCA_mpi_yield_when_idle="1")

    def start(self, ranks, arguments, folder):
        """Exit code and all words; code None if it hung."""
        command = [self.mpiexec, "--quiet", "-n", str(ranks), str(self.program), *map(str, arguments)]
        try:
            done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=TIMEOUT, check=False,
                                  env=self.environment)
        except subprocess.TimeoutExpired as late:
            return None, (late.stdout or b"").decode(errors="replace")
        return done.returncode, done.stdout.decode(errors="replace")

    def expect(self, name, ranks, code, text, words=(), wanted_code=2):
        problems = []
        if code != wanted_code:
            problems.append("it hung" if code is None else f"exit code {code}, not {wanted_code}")
        problems += [f"the message lacks {word!r}" for word in words if word not in text]
        if wanted_code == 2 and text.count("remedy: ") != 1:
            problems.append(f"the remedy stands there {text.count('remedy: ')} times")
        if problems:
            self.failures.append(name)
            print(f"FAILED  {name} ({ranks} ranks): {'; '.join(problems)}\n{text.strip()}\n", flush=True)


def copy_scene(folder):
    for path in HERE.iterdir():
        if path.suffix in (".geo", ".msh", ".toml", ".csv", ".wav"):
            shutil.copy(path, folder)


def run_mistake(mistake: Mistake, runner, ranks, folder):
    copy_scene(folder)
    path = folder / mistake.case
    text = path.read_text()
    for old, new in mistake.change:
        assert text.count(old) >= 1, f"{mistake.name}: {mistake.case} has no {old!r}"
        text = text.replace(old, new, 1)
    path.write_text(text)
    before = sorted(folder.iterdir())
    arguments = [argument.replace("{folder}", str(folder)) for argument in mistake.arguments]
    code, words = runner.start(ranks, [mistake.command, mistake.case, *arguments], folder)
    runner.expect(mistake.name, ranks, code, words, mistake.words)
    left = sorted(set(folder.iterdir()) - set(before))
    if left:
        runner.failures.append(mistake.name)
        print(f"FAILED  {mistake.name} ({ranks} ranks): left behind {left}\n", flush=True)


def run_sound_cases(runner, ranks, folder):
    """What is sound passes, or else the mistakes above would be found for a wrong reason."""
    copy_scene(folder)
    for case in ("scene.toml", "pulse.toml", "square.toml"):
        code, text = runner.start(ranks, ["check", case], folder)
        runner.expect(f"sound case {case}", ranks, code, text, wanted_code=0)


def run_files(runner, ranks, folder):
    """Case files that cannot be read."""
    (folder / "folder.toml").mkdir()
    (folder / "binary.toml").write_bytes(bytes(range(256)))
    (folder / "empty.toml").write_text("")
    for name, words in (("nowhere.toml", ["nowhere.toml"]), ("folder.toml", ["folder.toml", "a folder"]),
                        ("binary.toml", ["binary.toml", "TOML"]), ("empty.toml", ["empty.toml", "is needed"])):
        code, text = runner.start(ranks, ["check", name], folder)
        runner.expect(f"case file {name}", ranks, code, text, words)


def run_checkpoints(runner, ranks, folder):
    """Runs that cannot go on: no run, no checkpoint, a checkpoint that is cut, or that of another case."""
    copy_scene(folder)
    for name in ("scene", "pulse"):
        code, text = runner.start(ranks, ["run", f"{name}.toml", "--out", folder / name], folder)
        runner.expect(f"run of {name}.toml", ranks, code, text, wanted_code=0)
        if code != 0:
            return
        if not (folder / name / "checkpoint.h5").is_file():
            runner.failures.append(name)
            print(f"FAILED  run of {name}.toml ({ranks} ranks): it left no checkpoint.h5\n", flush=True)
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
    for name, words in (("nowhere", ["nowhere"]), ("empty", ["empty"]), ("without", ["checkpoint"]),
                        ("cut", ["checkpoint"]), ("letter", ["checkpoint"]), ("other", ["checkpoint"])):
        code, text = runner.start(ranks, ["resume", folder / name], folder)
        runner.expect(f"resume of {name}", ranks, code, text, words)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", default="1,3")
    parser.add_argument("--only", default="", help="run only what has these words in its name")
    parser.add_argument("--at-once", type=int, default=2 * os.cpu_count(), help="starts of the program side by side")
    options = parser.parse_args()
    runner = Runner(options)
    chosen = []
    for ranks in map(int, options.ranks.split(",")):
        jobs = [("checkpoints", run_checkpoints), ("sound cases", run_sound_cases), ("files", run_files)]
        jobs += [(mistake.name, functools.partial(run_mistake, mistake)) for mistake in MISTAKES]
        chosen += [(job, ranks) for name, job in jobs if options.only in name]

    def carry_out(job, ranks):
        with tempfile.TemporaryDirectory(prefix="vocalis broken ") as folder:
            job(runner, ranks, pathlib.Path(folder))

    with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
        for done in [pool.submit(carry_out, job, ranks) for job, ranks in chosen]:
            done.result()
    print(f"{len(chosen)} groups of broken input, {len(runner.failures)} failures")
    return 1 if runner.failures else 0


if __name__ == "__main__":
    sys.exit(main())
