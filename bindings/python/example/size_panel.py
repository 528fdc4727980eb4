"""How thick must a bottom plate be? SciPy finds it; the command `splashdown size` must find the same.

    python size_panel.py [PICTURE]

A wedge falls onto water; its bottom plates bend, by boundary elements. Allowed is a plate whose reserve factor less its band is at least 1.
"""

import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import splashdown
from scipy.optimize import brentq  # type: ignore[import-untyped]

SCENE = "flexible_wedge"
THICKNESS = "body.panels[0].thickness"
GIVEN = {"model": "boundary_element", "time.end": 0.01, "body.panels[0].allowable_stress": 120e6, "body.panels[0].elements": 8}
FROM, TO = 0.0025, 0.004  # m


def reserve(thickness: float) -> tuple[float, float]:
    """Reserve factor of the plate, and half the width of its band."""
    factor = splashdown.evaluate(SCENE, GIVEN | {THICKNESS: thickness})["plate.reserve_factor"]
    assert factor.band is not None, f"the reserve factor has no band: {factor.verdict}"
    return factor.value, factor.band


def missing(thickness: float) -> float:
    value, band = reserve(thickness)
    return value - band - 1.0


def by_the_command() -> float:
    sets = [word for key, value in GIVEN.items() for word in ("--set", f"{key}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        command = ["size", SCENE, *sets, "--for", "panels.plate.thickness", "--from", str(FROM), "--to", str(TO), "--out", folder]
        subprocess.run([sys.executable, "-m", "splashdown", *command, "--quiet"], stdout=subprocess.DEVNULL, check=True)
        return float(json.loads(pathlib.Path(folder, "size.json").read_text())["value"])


def main() -> None:
    picture = sys.argv[1] if len(sys.argv) > 1 else "size_panel.png"
    tried = np.linspace(FROM, TO, 7)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        values, bands = np.array(list(pool.map(reserve, tried))).T
    found = float(brentq(missing, FROM, TO, xtol=2e-6))
    commanded = by_the_command()

    print("thickness [mm]  reserve factor  band")
    for thickness, value, band in zip(tried, values, bands):
        print(f"{1e3 * thickness:14.2f}  {value:14.3f}  {band:.3f}")
    print(f"SciPy: {1e3 * found:.3f} mm, splashdown size: {1e3 * commanded:.3f} mm; {splashdown.cache_info().runs} runs")

    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    axes.fill_between(1e3 * tried, values - bands, values + bands, alpha=0.25, label="band")
    axes.plot(1e3 * tried, values, "o-", label="reserve factor")
    axes.axhline(1.0, color="0.3", linewidth=0.8)
    axes.axvline(1e3 * found, color="tab:red", linestyle="--", label=f"allowed from {1e3 * found:.2f} mm")
    axes.set(xlabel="thickness [mm]", ylabel="reserve factor [-]", title="Bottom plate of a 20° wedge, 4 m/s, 120 MPa allowed")
    axes.legend()
    figure.savefig(picture, dpi=120)

    assert missing(0.99 * found) < 0.0 <= missing(1.01 * found), "it is not the smallest thickness"
    # the command narrows the range to 0.2 %, and gives a value that is allowed
    assert abs(commanded / found - 1.0) < 0.003, f"{commanded} and {found} m"


if __name__ == "__main__":
    main()
