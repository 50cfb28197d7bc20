#!/usr/bin/python3
"""What a step would take on many ranks, on paper: the tables of docs/scaling.md.

    tests/benchmarks/scaling_model.py

What was measured stands below with its command in docs/scaling.md; what is assumed is named so. Seconds of a step on P ranks are

    serial + shared / P + exchanges * neighbours(P) * latency + bytes(P) / bandwidth
           + (reductions + gathers) * log2(P) * latency + gathers * P * overhead

where an exchange is one message to each neighbour; `gathers` bring a vector to the first rank, or back, or to every rank, one
message a rank.
"""

import dataclasses
import math

LATENCY = 1.5e-6  # [s] assumed, of a message or of one stage of a reduction
OVERHEAD = 0.3e-6  # [s] assumed, of each message that the first rank takes in one after the other
BANDWIDTH = 10e9  # [B/s] assumed, of one rank
RANKS = (1, 16, 64, 256, 1024, 4096)


@dataclasses.dataclass
class Part:
    """What one part of a step needs, at some number of ranks."""

    name: str
    serial: float = 0  # [s] on the first rank, others wait
    shared: float = 0  # [s] of all ranks together
    exchanges: float = 0
    exchange_bytes: float = 0  # a rank, of one exchange, on `measured_ranks`
    measured_ranks: int = 8
    reductions: float = 0
    gathers: float = 0


def neighbours(ranks, dimension):
    """Of a rank inside: 6 in the plane, 14 in space (assumed); fewer among few ranks."""
    return min(ranks - 1, 6 if dimension == 2 else 14)


def terms(part, ranks, dimension):
    """Seconds by cause."""
    if ranks == 1:
        return {"alone": part.serial + part.shared}
    stages = math.log2(ranks)
    surface = (part.measured_ranks / ranks) ** ((dimension - 1) / dimension)
    return {"serial": part.serial, "shared": part.shared / ranks,
            "messages": part.exchanges * neighbours(ranks, dimension) * LATENCY,
            "bytes": part.exchanges * part.exchange_bytes * surface / BANDWIDTH,
            "reductions": (part.reductions + part.gathers) * stages * LATENCY,
            "gathers": part.gathers * ranks * OVERHEAD}


# The plane vowel, quick.toml: 1,900 cells of the flow, 3,158 of the sound, four implicit sub-steps of sound.
PLANE = [
    Part("flow, solution", serial=13e-3, reductions=13, gathers=8),
    Part("flow, assembly and mesh motion", shared=2.1e-3, exchanges=24, exchange_bytes=900, reductions=14),
    Part("sound, Cholesky of the whole on every rank", serial=1.6e-3, shared=0.4e-3, exchanges=64, exchange_bytes=40,
         reductions=90, gathers=20),
]

# A larynx and tract in space: 4e6 cells of the flow (1.8e7 unknowns), 9e6 of the sound (1.6e6 vertices). The flow's
# solver is one that is not built yet: flexible GMRES with 100 iterations a step, each 8 s on one rank and 60 exchanges.
SPACE = [
    Part("flow, iterative solution (not built)", shared=100 * 8.0, exchanges=100 * 60, exchange_bytes=20e3,
         measured_ranks=4096, reductions=100 * 4),
    Part("flow, assembly", shared=2.5 * 4e6 * 20e-6, exchanges=24, exchange_bytes=20e3, measured_ranks=4096,
         reductions=14),
    Part("sound, implicit, multigrid", shared=4 * 1.6e6 * 0.64e-6, exchanges=4 * 390, exchange_bytes=3e3,
         measured_ranks=4096, reductions=4 * 50),
    Part("sound, explicit (300 sub-steps)", shared=300 * 9e6 * 4.1e-9, exchanges=300 * 2, exchange_bytes=3e3,
         measured_ranks=4096, reductions=10),
]


def print_table(parts, dimension, unit, factor):
    print("| part [" + unit + "] | largest term at 4,096 | " + " | ".join(f"{ranks:,}" for ranks in RANKS) + " |")
    print("| --- | --- " + "| ---: " * len(RANKS) + "|")
    for part in parts:
        last = terms(part, RANKS[-1], dimension)
        worst = max(last, key=last.get)
        seconds = [sum(terms(part, ranks, dimension).values()) * factor for ranks in RANKS]
        print(f"| {part.name} | {worst} | " + " | ".join(f"{value:.3g}" for value in seconds) + " |")
    print()


def main():
    print("The plane vowel as it is\n")
    print_table(PLANE, 2, "ms", 1e3)
    print("Ten million cells in space\n")
    print_table(SPACE, 3, "s", 1)


if __name__ == "__main__":
    main()
