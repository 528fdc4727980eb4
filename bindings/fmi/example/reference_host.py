"""The reference host as a co-simulation master: a landing-dynamics program with water under it as a unit of FMI 3.0.

    python reference_host.py UNIT.fmu

A frame with a cabin on an oleo, a flexible belly of nine nodes, velocity Verlet, and steps that are rejected where the water's force came
out too different: the program of the Rust example `reference_host`, and its numbers to the last digit, but for the time, which is the
master's and begins at 0. UNIT.fmu: of `scenarios/examples/reference_section.toml` with the interface nodes. Needs fmpy of PyPI.
"""
import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

BELLY, H = 9, 0.1  # nodes of the belly, their distance [m]
STIFFNESS, NODE = 6.0e3, 4.0  # of the belly: bending stiffness [N m], mass of a node [kg/m]
FRAME, CABIN = 250.0, 500.0  # kg/m
SPRING, DAMPER = 5.0e5, 4.0e4  # of the oleo [N/m^2, N s^2/m^3]
GRAVITY, DT, STEPS, TOLERANCE = 9.81, 5.0e-5, 400, 0.002


def oleo(x, v):
    closing, speed = x[0] - x[1], v[0] - v[1]
    return SPRING * closing + DAMPER * speed * abs(speed)


def accelerations(x, v, water):
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


def verlet(x, v, water):
    """The state after a step under forces of the water that are predicted."""
    before = accelerations(x, v, water)
    there = [x[k] + DT * v[k] + 0.5 * DT * DT * before[k] for k in range(2 + BELLY)]
    after = accelerations(there, v, water)
    return there, [v[k] + 0.5 * DT * (before[k] + after[k]) for k in range(2 + BELLY)]


def run(water, variables):
    """Steps the host with the unit's instance `water`; arrays of nodes are flat: x and y of each in turn."""
    references = {name: [variable.valueReference] for name, variable in variables.items()}
    start, velocity = ([float(word) for word in variables[name].start.split()] for name in ("position", "velocity"))
    position = start.copy()
    x, v = [0.0] * (2 + BELLY), [0.0] * (2 + BELLY)
    v[0] = v[1] = velocity[1]
    time, predicted, rejected = 0.0, [0.0] * BELLY, 0
    for step in range(1, STEPS + 1):
        saved, redone = water.getFMUState(), False
        while True:
            there, speed = verlet(x, v, predicted)
            for k in range(len(start) // 2):
                w, rate = (there[2 + k], speed[2 + k]) if k < BELLY else (0.0, 0.0)
                position[2 * k + 1] = start[2 * k + 1] + there[0] + w
                velocity[2 * k + 1] = speed[0] + rate
            water.setFloat64(references["position"], position)
            water.setFloat64(references["velocity"], velocity)
            reached = water.doStep(currentCommunicationPoint=time, communicationStepSize=DT)[3]
            forces = water.getFloat64(references["force"], nValues=len(start))[1::2]
            found = forces[:BELLY]
            change = max(DT * abs(found[i] - predicted[i]) / NODE for i in range(BELLY))
            if change > TOLERANCE and not redone:
                water.setFMUState(saved)
                predicted, redone, rejected = found, True, rejected + 1
                continue
            # the nodes stay where they were predicted; their velocities take the impulse of the water
            given, without = accelerations(there, speed, found), accelerations(there, speed, predicted)
            v = [speed[k] + DT * (given[k] - without[k]) for k in range(2 + BELLY)]
            time, x, predicted = reached, there, found
            break
        water.freeFMUState(saved)
        if step % 20 == 0:
            total = 0.0
            for force in forces:
                total += force
            print(" ".join(f"{number:.16e}" for number in (time, x[0], x[1], x[6], v[6], total, oleo(x, v))))
    print(f"{STEPS} steps, {rejected} rejected")


def ignore_message(_environment, _status, _category, message):
    print(message.decode(), file=sys.stderr)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: reference_host.py UNIT.fmu")
    folder = extract(sys.argv[1])
    try:
        described = read_model_description(folder)
        water = FMU3Slave(guid=described.guid, modelIdentifier="splashdown", unzipDirectory=folder, instanceName="water")
        water.instantiate(logMessage=ignore_message)
        water.enterInitializationMode()
        water.exitInitializationMode()
        run(water, {variable.name: variable for variable in described.modelVariables})
        water.terminate()
        water.freeInstance()
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
