#!/usr/bin/python3
"""The disc of cases/contact/ball.toml bounces off a wall in next to no fluid as the disc of
tests/benchmarks/disc_restitution.py does in none: fast, slow, with a lower Poisson ratio, and with a core that does not
vibrate (ball_core.toml), which comes back with all but a fiftieth of its speed.

    ball_restitution.py PROGRAM [--mpiexec mpiexec]     a minute
"""

import shutil
import sys

from program import HERE, main

sys.path.insert(0, str(HERE.parents[0] / "benchmarks"))
import disc_restitution  # noqa: E402

CASES = HERE.parents[1] / "cases" / "contact"
ELASTIC = 0.98  # restitution of the disc with a core, whose vibration takes 0.003 of it
TOLERANCE = 0.03  # of restitution, of parts of the energy
RINGS = 24
VACUUM = {"flow.density": 0.001, "flow.viscosity": 2e-6, "output.fields_interval": 0, "time.dt": 6.25e-5}
BOUNCES = {
    "fast": {"time.end": 0.075},
    "slow": {"flow.gravity": [0.0, -2.4525], "time.end": 0.15, "statistics.begin": 0.092,
             "mesh.parameters.h_contact": 0.00057},
    "compressible": {"time.end": 0.075},
    "core": {"time.dt": 1.5625e-5},
}
POISSON_RATIOS = {"fast": 0.4, "slow": 0.4, "compressible": 0.2, "core": 0.4}


def test(program, folder):
    shutil.copy(CASES / "ball.geo", folder)
    restitution = {}
    for name, settings in BOUNCES.items():
        run, case = folder / name, folder / f"{name}.toml"
        text = (CASES / ("ball_core.toml" if name == "core" else "ball.toml")).read_text()
        case.write_text(text.replace("poisson_ratio = 0.4", f"poisson_ratio = {POISSON_RATIOS[name]}"))
        words = [word for key, value in (VACUUM | settings).items() for word in ("--set", f"{key}={value}")]
        program.expect_code(0, program.start(1, "run", case, "--out", run, *words), name)
        found, exact = disc_restitution.beside_reference(run, RINGS)
        print(f"{name}: {found}\n    in a vacuum: {exact}", flush=True)
        for part in ("restitution", "vibration"):
            difference = found[part] - exact[part]
            program.expect(abs(difference) < TOLERANCE, f"{name}: {part} is {difference:+.4f} off that in a vacuum")
        program.expect(found["dissipated"] < 0.01, f"{name}: the fluid and the contact take {found['dissipated']:.4f}")
        restitution[name] = found["restitution"]
    program.expect(restitution["core"] > ELASTIC, f"with a core that does not vibrate: {restitution['core']:.4f}")
    program.expect(restitution["slow"] > restitution["fast"], f"the slower is not the more elastic: {restitution}")


if __name__ == "__main__":
    sys.exit(main(test))
