#!/usr/bin/python3
"""A flow that cannot be computed ends with exit code 3, status "failed" and a reason; the last good checkpoint stays, and
the run goes on from it once the case allows it."""

import sys

from program import HERE, main, read_series, read_summary

CHECKPOINT_STEPS = 5  # of larynx.toml


def expect_failure(program, ranks, result, folder, what):
    program.expect_code(3, result, what)
    if not program.expect((folder / "summary.json").is_file(), f"{what}: there is no summary.json"):
        return 0
    summary = read_summary(folder)
    program.expect(summary["status"] == "failed", f"{what}: the status is {summary['status']}")
    program.expect("did not converge" in summary["reason"], f"{what}: the reason is {summary['reason']!r}")
    program.expect(summary["reason"] in result[1], f"{what}: the reason is not told:\n{result[1]}")
    program.expect(summary["rejected_steps"] > 0, f"{what}: no step was tried again")
    program.expect(summary["ranks"] == ranks, f"{what}: {summary['ranks']} ranks")
    program.expect((folder / "checkpoint.h5").is_file(), f"{what}: there is no checkpoint")
    program.expect(not list(folder.glob("*.tmp*")), f"{what}: unfinished files {list(folder.iterdir())}")
    return summary["steps"]


def test(program, folder):
    case = HERE / "larynx.toml"
    for ranks in (1, 2):
        # At once: no step is accepted, so there is nothing to evaluate.
        run, what = folder / f"first{ranks}", f"failure of the first step on {ranks} ranks"
        result = program.start(ranks, "run", case, "--out", run, "--set", "flow.boundary.lungs.pressure=1e12",
                               "--set", "flow.boundary.lungs.ramp=0")
        program.expect(expect_failure(program, ranks, result, run, what) == 0, f"{what}: some step was accepted")

        # Later, when the pressure has risen too far: the checkpoint before is kept, and the same happens from there.
        run, what = folder / f"later{ranks}", f"failure of a later step on {ranks} ranks"
        result = program.start(ranks, "run", case, "--out", run, "--set", "flow.boundary.lungs.pressure=1e5")
        steps = expect_failure(program, ranks, result, run, what)
        program.expect(steps > CHECKPOINT_STEPS, f"{what}: only {steps} steps were accepted")
        program.expect(len(read_series(run / "history.csv")[1][0]) == steps, f"{what}: history.csv")
        again = expect_failure(program, ranks, program.start(ranks, "resume", run), run, f"{what}, resumed")
        program.expect(again == steps, f"{what}, resumed: it failed after {again} steps, not {steps}")
        good = steps % CHECKPOINT_STEPS
        if good > 0:
            program.expect_code(0, program.start(ranks, "resume", run, "--steps", good), f"{what}, up to there")
            summary = read_summary(run)
            program.expect((summary["status"], summary["steps"]) == ("stopped", steps), f"{what}, up to there: {summary}")


if __name__ == "__main__":
    sys.exit(main(test))
