"""What a step of the implicit integrator of sound does to an oscillation: the bandwidth that it adds, the error of its
frequency, and what is left of an oscillation far too fast for it. The table of docs/theory.md, "Time of sound".

    /usr/bin/python3 tests/benchmarks/damping_of_a_step.py
"""

import numpy as np

STEP = 1.25e-5  # [s]
FREQUENCIES = (500, 2500, 3700, 5000, 1e5)  # [Hz]
FAR_TOO_FAST = 1e7  # [Hz]


def generalised_alpha(rate, radius):
    """(y, dy/dt) after a step from those before, for dy/dt = rate y: Jansen, Whiting & Hulbert 2000."""
    rate_weight, flow_weight = 0.5 * (3 - radius) / (1 + radius), 1 / (1 + radius)
    part = 0.5 + rate_weight - flow_weight
    change = np.array([rate, rate * flow_weight * STEP - 1]) / (rate_weight - rate * flow_weight * STEP * part)
    return np.array([[1 + STEP * part * change[0], STEP + STEP * part * change[1]], [change[0], 1 + change[1]]])


def theta_scheme(rate, theta):
    return np.array([[(1 + (1 - theta) * rate * STEP) / (1 - theta * rate * STEP)]])


def factor(matrix, angle):
    """The eigenvalue that follows the oscillation; of one that the step does not resolve the largest."""
    values = np.linalg.eigvals(matrix)
    return values[np.argmin(abs(np.angle(values) - angle))] if angle < 1 else max(values, key=abs)


def main():
    schemes = [(f"r = {radius}", generalised_alpha, radius) for radius in (1, 0.8, 0.5)]
    for name, matrix, number in [*schemes, ("theta = 0.505", theta_scheme, 0.505)]:
        texts = []
        for frequency in FREQUENCIES:
            omega = 2 * np.pi * frequency
            value = factor(matrix(1j * omega, number), omega * STEP)
            bandwidth = max(0.0, -np.log(abs(value)) / (np.pi * STEP))
            error = 100 * (np.angle(value) / (omega * STEP) - 1)
            texts.append(f"{frequency:g} Hz: {bandwidth:.2f} Hz, {error:.2f} %")
        left = abs(factor(matrix(2j * np.pi * FAR_TOO_FAST, number), 10))
        print(f"{name}: {'; '.join(texts)}; {FAR_TOO_FAST:g} Hz: {left:.2f} left a step")


if __name__ == "__main__":
    main()
