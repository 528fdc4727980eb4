"""The reference host: a landing-dynamics program with water under it.

    python reference_host.py [SCENE]

A frame with a cabin on an oleo, a flexible belly of nine nodes, velocity Verlet, and steps that are rejected where the water's force came
out too different: the program of the Rust example `reference_host`, line by line, and its numbers to the last digit. SCENE: its
`reference_section.toml`.
"""

import pathlib
import sys

import numpy as np
import splashdown

BELLY, H = 9, 0.1  # nodes of the belly, their distance [m]
STIFFNESS, NODE = 6.0e3, 4.0  # of the belly: bending stiffness [N m], mass of a node [kg/m]
FRAME, CABIN = 250.0, 500.0  # kg/m
SPRING, DAMPER = 5.0e5, 4.0e4  # of the oleo [N/m^2, N s^2/m^3]
GRAVITY, DT, STEPS, TOLERANCE = 9.81, 5.0e-5, 400, 0.002
SCENE = pathlib.Path(__file__).parents[3] / "scenarios/examples/reference_section.toml"

Values = list[float]


def oleo(x: Values, v: Values) -> float:
    closing, speed = x[0] - x[1], v[0] - v[1]
    return SPRING * closing + DAMPER * speed * abs(speed)


def accelerations(x: Values, v: Values, water: Values) -> Values:
    """Of frame, cabin and belly, under the water's forces on the belly [N/m]."""
    w = x[2:]
    moment = [0.0] * BELLY
    for i in range(1, BELLY - 1):
        moment[i] = STIFFNESS * (w[i - 1] - 2.0 * w[i] + w[i + 1]) / (H * H)
    force = [0.0] * BELLY
    for i in range(BELLY):
        left = moment[i - 1] if i > 0 else 0.0
        right = moment[i + 1] if i < BELLY - 1 else 0.0
        force[i] = water[i] - (left - 2.0 * moment[i] + right) / H
    strut = oleo(x, v)
    a = [0.0] * (2 + BELLY)
    a[0] = (force[0] + force[BELLY - 1] - strut) / FRAME - GRAVITY
    a[1] = strut / CABIN - GRAVITY
    for i in range(1, BELLY - 1):
        a[2 + i] = force[i] / NODE - GRAVITY - a[0]
    return a


def verlet(x: Values, v: Values, water: Values) -> tuple[Values, Values]:
    """The state after a step under forces of the water that are predicted."""
    before = accelerations(x, v, water)
    there = [x[k] + DT * v[k] + 0.5 * DT * DT * before[k] for k in range(2 + BELLY)]
    after = accelerations(there, v, water)
    return there, [v[k] + 0.5 * DT * (before[k] + after[k]) for k in range(2 + BELLY)]


def main() -> None:
    water = splashdown.Host(sys.argv[1] if len(sys.argv) > 1 else str(SCENE), interface="nodes")
    nodes = water.nodes
    position, velocity = nodes["position"], nodes["velocity"]
    start = position.copy()
    forces = np.zeros_like(position, shape=(len(position), 3))
    x, v = [0.0] * (2 + BELLY), [0.0] * (2 + BELLY)
    v[0] = v[1] = float(velocity[0, 1])
    predicted, rejected = [0.0] * BELLY, 0
    for step in range(1, STEPS + 1):
        water.save()
        redone = False
        while True:
            there, speed = verlet(x, v, predicted)
            for k in range(len(position)):
                w, rate = (there[2 + k], speed[2 + k]) if k < BELLY else (0.0, 0.0)
                position[k, 1] = start[k, 1] + there[0] + w
                velocity[k, 1] = speed[0] + rate
            water.contribute(DT, position, velocity, out=forces)
            found = [float(force) for force in forces[:BELLY, 1]]
            change = max(DT * abs(found[i] - predicted[i]) / NODE for i in range(BELLY))
            if change > TOLERANCE and not redone:
                water.restore()
                predicted, redone, rejected = found, True, rejected + 1
                continue
            # the nodes stay where they were predicted; their velocities take the impulse of the water
            given, without = accelerations(there, speed, found), accelerations(there, speed, predicted)
            v = [speed[k] + DT * (given[k] - without[k]) for k in range(2 + BELLY)]
            x, predicted = there, found
            break
        if step % 20 == 0:
            total = 0.0
            for force in forces[:, 1]:
                total += float(force)
            numbers = [water.time, x[0], x[1], x[6], v[6], total, oleo(x, v)]
            print(" ".join(f"{number:.16e}" for number in numbers))
    print(f"{STEPS} steps, {rejected} rejected")
    water.finish()


if __name__ == "__main__":
    main()
