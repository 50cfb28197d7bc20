#!/usr/bin/python3
"""Stands in for the program: takes its command line, and gives results of a made-up order and cost from the settings.

value = 100 (1 + c size^p + 0.1 dt^2), c and p by flow.elements. What else it does is said in the case file's [fake]."""

import json
import pathlib
import signal
import sys
import time
import tomllib

VERSION = "9.9.9"
WAYS = {"P1P1": (4.0, 1.5), "P2P1": (2.0, 3.0)}


def read(arguments):
    """The case's values by dotted key, with what --set changes, and where the run goes."""
    values, out = {}, None

    def add(table, prefix=""):
        for key, value in table.items():
            if isinstance(value, dict):
                add(value, f"{prefix}{key}.")
            else:
                values[prefix + key] = value

    add(tomllib.loads(pathlib.Path(arguments[1]).read_text(encoding="utf-8")))
    rest = arguments[2:]
    while rest:
        option, value, *rest = rest
        if option == "--out":
            out = pathlib.Path(value)
        else:
            key, _, text = value.partition("=")
            values[key] = tomllib.loads(f"value = {text}")["value"]
    return values, out


def work(seconds):
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass


def main(arguments):
    if arguments[0] == "--help":
        print(f"Vocalis {VERSION}: stands in for the program.")
        return 0
    values, out = read(arguments)
    if values.get("flow.elements", "P1P1") not in WAYS:
        print("vocalis: flow.elements must be known\n  found: another\n  remedy: choose P1P1 or P2P1", file=sys.stderr)
        return 2
    if arguments[0] == "check":
        print('[flow]\nelements = "P1P1"  # default\n# the case is sound')
        return 0
    size, dt = values["mesh.size"], values["time.dt"]
    factor, order = WAYS[values.get("flow.elements", "P1P1")]
    with open(out.parents[1] / "starts.txt", "a", encoding="utf-8") as starts:
        starts.write(f"{out.name}\n")
    if values.get("fake.waits_at") == size:
        signal.pause()
    if values.get("fake.kills_at") == size:
        print("the last words of a crash", flush=True)
        signal.raise_signal(signal.SIGKILL)
    work(values.get("fake.seconds", 0))
    failed = values.get("fake.fails_at") == size
    value = 100 * (1 + factor * size**order + 0.1 * dt**2)
    results = {"drag_mean_N": value, "lift_mean_N": 0.01 * (value - 100), "drag_frequency_Hz": None if failed else 5.0}
    summary = {"version": VERSION, "status": "failed" if failed else "finished", "results": results,
               "reason": "the flow did not converge at 0.1 s" if failed else "", "steps": round(1 / dt),
               "unknowns": {"flow": round(9 / size**2)}, "peak_memory_bytes": 1e6 / size}
    (out / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    return 3 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
