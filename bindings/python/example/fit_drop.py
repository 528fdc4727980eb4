"""Which mass, speed and deadrise had a drop test? SciPy's least squares, with intervals from the Jacobian.

    python fit_drop.py [PICTURE]

The test is made: a wedge by the modified Logvinovich model, its velocity and acceleration with 3 % noise. Ten such tests are fitted, so that
one sees how many intervals hold the true values.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import splashdown
from numpy.typing import NDArray
from scipy.optimize import least_squares  # type: ignore[import-untyped]
from scipy.stats import t as student  # type: ignore[import-untyped]

Array = NDArray[np.float64]

KEYS = ["body.mass", "body.velocity.1", "body.deadrise_deg"]
TRUE = np.array([226.0, -5.9, 28.5])  # kg/m, m/s, degrees
FIRST = np.array([241.0, -6.15, 30.0])
CURVES = ["wedge.vy_m_per_s", "wedge.ay_m_per_s2"]
TIMES = np.linspace(0.001, 0.02, 60)  # s
NOISE, TESTS, LEVEL = 0.03, 10, 0.95


def curves(values: Array) -> Array:
    """The curves of a drop at the times of the test, each over its largest value in the first guess; shape (curves, times)."""
    series = splashdown.evaluate("wedge", {"model": "mlm", "time.end": 0.0201} | dict(zip(KEYS, values))).series
    return np.array([np.interp(TIMES, series["time_s"], series[name]) for name in CURVES]) / SCALES[:, None]


SCALES = np.ones(len(CURVES))
SCALES = abs(curves(FIRST)).max(axis=1)


def fit(measured: Array) -> tuple[Array, Array]:
    """Values, and the half widths of their intervals at 95 %."""
    found = least_squares(lambda x: (curves(x * FIRST) - measured).ravel(), np.ones(3), diff_step=1e-3, xtol=1e-6)
    freedom = measured.size - len(KEYS)
    covariance = np.linalg.inv(found.jac.T @ found.jac) * 2.0 * found.cost / freedom
    half = student.ppf(0.5 + 0.5 * LEVEL, freedom) * np.sqrt(np.diag(covariance))
    return found.x * FIRST, half * abs(FIRST)


def main() -> None:
    picture = sys.argv[1] if len(sys.argv) > 1 else "fit_drop.png"
    random, exact = np.random.default_rng(7), curves(TRUE)
    tests = [exact + NOISE * random.standard_normal(exact.shape) for _ in range(TESTS)]
    values, halves = (np.array(part) for part in zip(*map(fit, tests)))
    inside = abs(values - TRUE) < halves

    print("key                 true    first test          inside")
    for k, key in enumerate(KEYS):
        print(f"{key:18} {TRUE[k]:6.2f}  {values[0, k]:7.3f} ± {halves[0, k]:.3f}  {inside[:, k].sum()} of {TESTS}")
    print(f"{splashdown.cache_info().runs} runs, {splashdown.cache_info().hits} from the cache")

    figure, axes = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    labels = ["velocity / 6.15 m/s", "acceleration / its peak"]
    for name, measured, curve in zip(labels, tests[0], curves(values[0])):
        (line,) = axes[0].plot(1e3 * TIMES, curve, label=name)
        axes[0].plot(1e3 * TIMES, measured, ".", color=line.get_color(), markersize=4)
        axes[1].plot(1e3 * TIMES, 100 * (measured - curve), ".", color=line.get_color())
    axes[0].set(xlabel="t [ms]", ylabel="curve / scale [-]", title="First test and its fit")
    axes[0].legend()
    axes[1].axhline(0.0, color="0.3", linewidth=0.8)
    axes[1].set(xlabel="t [ms]", ylabel="residual [%]", title="Residuals")
    for k, key in enumerate(KEYS):
        places = np.arange(TESTS) + (TESTS + 2) * k
        axes[2].errorbar(places, 100 * (values[:, k] / TRUE[k] - 1), 100 * halves[:, k] / abs(TRUE[k]), fmt="o", markersize=3, label=key)
    axes[2].axhline(0.0, color="0.3", linewidth=0.8)
    axes[2].set(xticks=[], ylabel="fitted less true value [%]", title=f"{TESTS} tests, intervals at 95 %")
    axes[2].legend()
    figure.savefig(picture, dpi=120)

    # of 30 intervals 28.5 are expected to hold the true value; fewer than 25 have a chance of 1 in 300
    assert inside.sum() >= 25, f"{inside.sum()} of {inside.size} intervals hold the true value"
    assert (halves.mean(axis=0) < 0.05 * abs(TRUE)).all(), "the data do not determine the values"


if __name__ == "__main__":
    main()
