"""Observed order and limit of a result as a size goes to zero."""

from dataclasses import dataclass

LARGEST_ORDER = 12.0
ROUNDING = 1e-7  # relative: what solvers leave


@dataclass
class Convergence:
    order: float | None = None
    limit: float | None = None  # Richardson: the value at size 0
    words: str = ""  # why there is no order


def convergence(sizes, values):
    """Of the three finest levels. f(h) = f0 + C h^p through them: (f1 - f2)/(f2 - f3) = (h1^p - h2^p)/(h2^p - h3^p);
    f0 = f3 + (f3 - f2) h3^p / (h2^p - h3^p) (Roache 1994, for any ratio of sizes). Two levels never give an order."""
    if len(sizes) < 3:
        return Convergence(words="fewer than three levels")
    levels = sorted(zip(sizes, values), reverse=True)[-3:]
    (h1, f1), (h2, f2), (h3, f3) = ((size / levels[-1][0], value) for size, value in levels)
    if max(abs(f1 - f2), abs(f2 - f3)) <= ROUNDING * abs(f3):
        return Convergence(limit=f3, words="no change")
    if (f1 - f2) * (f2 - f3) <= 0:
        return Convergence(words="not monotone")
    ratio = (f1 - f2) / (f2 - f3)

    def predicted(order):
        return (h1**order - h2**order) / (h2**order - h3**order)

    low, high = 1e-3, LARGEST_ORDER
    if not predicted(low) < ratio < predicted(high):
        return Convergence(words="no convergence" if ratio <= predicted(low) else f"order above {high:g}")
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if predicted(middle) < ratio else (low, middle)
    return Convergence(low, f3 + (f3 - f2) * h3**low / (h2**low - h3**low))
