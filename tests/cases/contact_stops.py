#!/usr/bin/python3
"""Plates that are pressed together: without contact, and with one that closes too late, the run ends with exit code 3
and names the cell that would be inverted; with contact it goes on through closing and opening."""

import sys

from program import HERE, main, read_summary

CASE = HERE.parent.parent / "cases" / "contact" / "plates.toml"
COARSE = ("--set", "mesh.parameters.size=1.4", "--set", "time.end=0.02", "--set", "output.fields_interval=0")


def without_contact(folder):
    """The same case without the table [contact], beside its geometry."""
    lines, inside = [], False
    for line in CASE.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            inside = line.startswith("[contact]")
        if not inside:
            lines.append(line)
    case = folder / CASE.name
    case.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "plates.geo").write_text(CASE.with_suffix(".geo").read_text(encoding="utf-8"), encoding="utf-8")
    return case


def expect_stop(program, folder, case, what, *settings):
    run = folder / what.replace(" ", "_")
    result = program.start(1, "run", case, "--out", run, *COARSE, *settings)
    program.expect_code(3, result, what)
    summary = read_summary(run)
    program.expect(summary["status"] == "failed", f"{what}: the status is {summary['status']}")
    program.expect("inverted, of the" in summary["reason"], f"{what}: the reason is {summary['reason']!r}")
    program.expect(summary["reason"] in result[1], f"{what}: the reason is not told:\n{result[1]}")


def test(program, folder):
    expect_stop(program, folder, without_contact(folder), "without contact")
    expect_stop(program, folder, CASE, "alpha too small", "--set", "contact.alpha=0.005")
    run = folder / "with_contact"
    program.expect_code(0, program.start(1, "run", CASE, "--out", run, *COARSE), "with contact")
    contact = read_summary(run)["contact"]
    program.expect(contact["closings"] > 0 and contact["closed_steps"] > 0, f"with contact: it did not close: {contact}")


if __name__ == "__main__":
    sys.exit(main(test))
