#!/usr/bin/python3
"""The disc of cases/contact/ball.toml bounces off a wall in next to no fluid as the disc of
tests/benchmarks/disc_restitution.py does in none: fast, slow, and with a lower Poisson ratio.

    ball_restitution.py PROGRAM [--mpiexec mpiexec]     a minute
"""

import shutil
import sys

from program import HERE, main

sys.path.insert(0, str(HERE.parents[0] / "benchmarks"))
import disc_restitution  # noqa: E402

CASE = HERE.parents[1] / "cases" / "contact" / "ball.toml"
TOLERANCE = 0.03  # of restitution, of parts of the energy
RINGS = 24
VACUUM = {"flow.density": 0.001, "flow.viscosity": 2e-6, "output.fields_interval": 0, "time.dt": 6.25e-5}
BOUNCES = {
    "fast": {"time.end": 0.075},
    "slow": {"flow.gravity": [0.0, -2.4525], "time.end": 0.15, "statistics.begin": 0.092,
             "mesh.parameters.h_contact": 0.00057},
    "compressible": {"time.end": 0.075},
}
POISSON_RATIOS = {"fast": 0.4, "slow": 0.4, "compressible": 0.2}


def test(program, folder):
    shutil.copy(CASE.with_suffix(".geo"), folder)
    restitution = {}
    for name, settings in BOUNCES.items():
        run, case = folder / name, folder / f"{name}.toml"
        case.write_text(CASE.read_text().replace("poisson_ratio = 0.4", f"poisson_ratio = {POISSON_RATIOS[name]}"))
        words = [word for key, value in (VACUUM | settings).items() for word in ("--set", f"{key}={value}")]
        program.expect_code(0, program.start(1, "run", case, "--out", run, *words), name)
        found, exact = disc_restitution.beside_reference(run, RINGS)
        print(f"{name}: {found}\n    in a vacuum: {exact}", flush=True)
        for part in ("restitution", "vibration"):
            difference = found[part] - exact[part]
            program.expect(abs(difference) < TOLERANCE, f"{name}: {part} is {difference:+.4f} off that in a vacuum")
        program.expect(found["dissipated"] < 0.01, f"{name}: the fluid and the contact take {found['dissipated']:.4f}")
        restitution[name] = found["restitution"]
    program.expect(restitution["slow"] > restitution["fast"], f"the slower is not the more elastic: {restitution}")


if __name__ == "__main__":
    sys.exit(main(test))
