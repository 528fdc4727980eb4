"""A falling wedge whose motion this program integrates.

    python drop.py [straight]

A mass of 100 kg/m falls in y; the force is that of the step before. At step 40 a step with another velocity is tried, rejected and
redone. Each line: time [s], height [m], velocity [m/s], force [N/m], to the last digit those of the Rust example `host_drop`. With the
argument `straight` no step is tried: the lines are the same.
"""

import sys

import numpy as np
import splashdown

MASS, GRAVITY, DT, STEPS = 100.0, 9.81, 1e-4, 100


def main() -> None:
    tries = sys.argv[1:2] != ["straight"]
    water = splashdown.Host("wedge", set={"resolution.spacing": 0.01, "time.end": 0.02})
    print(water.sizes, file=sys.stderr)
    nodes = water.nodes
    position, velocity = nodes["position"], nodes["velocity"]
    forces = np.zeros((1, 3))
    for step in range(STEPS):
        if tries and step == 40:
            water.save()
            water.contribute(DT, position, velocity * [1.0, 0.0])
            water.restore()
        before = velocity[0, 1]
        velocity[0, 1] = before + DT * (forces[0, 1] / MASS - GRAVITY)
        position[0, 1] += DT * (0.5 * (before + velocity[0, 1]))
        water.contribute(DT, position, velocity, out=forces)
        print(f"{water.time:.16e} {position[0, 1]:.16e} {velocity[0, 1]:.16e} {forces[0, 1]:.16e}")
    water.finish()


if __name__ == "__main__":
    main()
