"""Which input matters? Sobol's indices of a drop by SALib; `splashdown scatter` must find the same.

    python scatter_drop.py [PICTURE]

A wedge by the modified Logvinovich model, whose speed, mass and deadrise scatter. SALib runs it at Saltelli's samples, in a pool of threads;
the command makes a polynomial of fewer samples.
"""

import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import splashdown
from numpy.typing import NDArray
from SALib.analyze import sobol as analysis  # type: ignore[import-untyped]
from SALib.sample import sobol as sample  # type: ignore[import-untyped]

RESULT = "peak_force_N_per_m"
# in the order of their names, as the command has them
INPUTS = {
    "body.deadrise_deg": ("unif", [28.0, 32.0], "uniform"),
    "body.mass": ("unif", [180.0, 300.0], "uniform"),
    "body.velocity.1": ("norm", [-6.15, 0.15], "normal"),
}
SAMPLES = 64  # of SALib: SAMPLES·(inputs + 2) runs
COMMAND_SAMPLES = 120


def force(values: NDArray[np.float64]) -> float:
    given = {"model": "mlm", "time.end": 0.022} | dict(zip(INPUTS, values))
    return splashdown.evaluate("wedge", given)[RESULT].value


def by_the_command() -> dict[str, Any]:
    lines = ['scene = "wedge"', f"samples = {COMMAND_SAMPLES}", "[set]", 'model = "mlm"', "time.end = 0.022", "[inputs]"]
    lines += [f"{key} = {{ {kind} = {numbers} }}" for key, (_, numbers, kind) in INPUTS.items()]
    with tempfile.TemporaryDirectory() as folder:
        file, out = pathlib.Path(folder, "drop.toml"), pathlib.Path(folder, "out")
        file.write_text("\n".join(lines) + "\n")
        subprocess.run([sys.executable, "-m", "splashdown", "scatter", str(file), "--out", str(out), "--quiet"], stdout=subprocess.DEVNULL, check=True)
        answer = json.loads((out / "scatter.json").read_text())
    result = answer["results"][RESULT]
    assert isinstance(result, dict)
    return result


def main() -> None:
    picture = sys.argv[1] if len(sys.argv) > 1 else "scatter_drop.png"
    problem = {
        "num_vars": len(INPUTS),
        "names": list(INPUTS),
        "bounds": [numbers for _, numbers, _ in INPUTS.values()],
        "dists": [kind for kind, _, _ in INPUTS.values()],
    }
    points = sample.sample(problem, SAMPLES, calc_second_order=False, seed=5)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        forces = np.array(list(pool.map(force, points)))
    indices = analysis.analyze(problem, forces, calc_second_order=False, seed=5)
    commanded = by_the_command()
    first, total = (np.array(commanded["indices"][kind]) for kind in ("first", "total"))

    print("input               first: SALib          scatter   total: SALib          scatter")
    for k, key in enumerate(INPUTS):
        own = [f"{indices[kind][k]:6.3f} ± {indices[f'{kind}_conf'][k]:.3f}" for kind in ("S1", "ST")]
        print(f"{key:18} {own[0]:>20}  {first[k]:9.3f} {own[1]:>21}  {total[k]:9.3f}")
    print(f"{splashdown.cache_info().runs} runs by SALib, {COMMAND_SAMPLES} by the command")

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    left.hist(1e-3 * forces, bins=30)
    left.set(xlabel="peak force [kN/m]", ylabel="runs", title=f"{len(forces)} drops")
    places = np.arange(len(INPUTS))
    right.bar(places - 0.2, indices["ST"], 0.35, yerr=indices["ST_conf"], capsize=4, label="SALib")
    right.bar(places + 0.2, total, 0.35, label="splashdown scatter")
    right.set(xticks=places, ylabel="total index [-]", title="Share of the variance, with interactions")
    right.set_xticklabels([key.removeprefix("body.") for key in INPUTS])
    right.legend()
    figure.savefig(picture, dpi=120)

    # at twice as many samples they differ by 0.01 at most
    for kind, other, most in [("S1", first, 0.06), ("ST", total, 0.03)]:
        assert (abs(indices[kind] - other) < most).all(), f"{kind}: {indices[kind]}, {other}"
    assert abs(first.sum() - 1.0) < 0.05 and first.min() > 0.01, f"each input must matter: {first}"


if __name__ == "__main__":
    main()
