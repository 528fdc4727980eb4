"""Pressure of the water in a frame of a run, as a picture (needs matplotlib).

    python pressure_map.py FOLDER [TIME [PICTURE]]

FOLDER is that of a run; without it `wedge` is run, coarsely, into runs/pressure_map. TIME [s] selects the frame (default: the last one).
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import splashdown


def main() -> None:
    given = sys.argv[1:]
    if given:
        run = splashdown.open(given[0])
    else:
        run = splashdown.run("wedge", set={"resolution.spacing": 0.008}, out="runs/pressure_map", force=True)
    time = float(given[1]) if len(given) > 1 else float(run.frames[-1])
    picture = pathlib.Path(given[2] if len(given) > 2 else "pressure.png")

    water, bodies = run.particles(time=time), run.bodies(time=time)
    x, y = water["position"].T
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    dots = axes.scatter(x, y, c=1e-3 * water["pressure"], s=(250 * water["spacing"]) ** 2, linewidths=0, cmap="viridis")
    for body in bodies.values():
        for line in body["outline"]:
            axes.fill(*line.T, facecolor="0.85", edgecolor="0.2")
    nearest = run.frames[abs(run.frames - time).argmin()]
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title=f"{run.summary['scene']}, t = {1e3 * nearest:.2f} ms")
    figure.colorbar(dots, label="p [kPa]")
    figure.savefig(picture, dpi=120)
    print(f"{len(x)} particles at t = {nearest:.6f} s: {picture}")


if __name__ == "__main__":
    main()
