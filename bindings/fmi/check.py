"""What `bindings/fmi/check` asks of body.fmu, nodes.fmu and turning_nodes.fmu of the wedge in a folder, as an importer.

`reference.txt` holds what the example `host_drop` prints: time, y, v, f_y of each step.
"""
import contextlib
import io
import json
import locale
import math
import pathlib
import sys
import threading
import time

import numpy
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmpy.util import fmu_info
from fmpy.validation import validate_fmu

DT, STEPS, MASS, GRAVITY = 1e-4, 100, 100.0, 9.81
DISCARD, ERROR = 2, 3


class Unit:
    """An extracted unit, of which instances are made."""

    def __init__(self, file):
        self.file = str(file)
        self.folder = extract(self.file)
        self.description = read_model_description(self.folder)
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.start = {v.name: v.start for v in self.description.modelVariables}

    def instance(self, initialised=True, start_time=0.0, stop_time=None, **parameters):
        made = Instance(self)
        for name, value in parameters.items():
            made.set(name, value)
        if initialised:
            made.fmu.enterInitializationMode(startTime=start_time, stopTime=stop_time)
            made.fmu.exitInitializationMode()
        return made


class Instance:
    """An instance with variables by name; `messages` holds its messages."""

    def __init__(self, unit, token=None):
        self.unit, self.messages = unit, []
        self.fmu = FMU3Slave(
            guid=token or unit.description.guid, modelIdentifier="splashdown", unzipDirectory=unit.folder, instanceName="a"
        )
        self.fmu.instantiate(logMessage=self.log)

    def log(self, _environment, status, category, message):
        self.messages.append((status, message.decode()))

    def set(self, name, value):
        reference = [self.unit.references[name]]
        if isinstance(value, bool):
            self.fmu.setBoolean(reference, [value])
        elif isinstance(value, str):
            self.fmu.setString(reference, [value])
        else:
            self.fmu.setFloat64(reference, numpy.atleast_1d(value).ravel().tolist())

    def get(self, name, count=1):
        values = self.fmu.getFloat64([self.unit.references[name]], nValues=count)
        return values[0] if count == 1 else numpy.array(values)

    def step(self, at, dt=DT):
        return self.fmu.doStep(currentCommunicationPoint=at, communicationStepSize=dt)[3]

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()


class Drop:
    """The common drop: a mass of 100 kg/m that falls in y, explicitly with the force of the step before."""

    def __init__(self, instance):
        self.instance, self.k, self.force = instance, 0, 0.0
        self.y, self.v = instance.get("y"), instance.get("vy")
        self.lines = []

    def advance(self, steps, into=None):
        instance = into or self.instance
        for _ in range(steps):
            before = self.v
            self.v = self.v + DT * (self.force / MASS - GRAVITY)
            self.y = self.y + DT * (0.5 * (before + self.v))
            instance.set("y", self.y)
            instance.set("vy", self.v)
            instance.step(self.k * DT)
            self.k, self.force = self.k + 1, instance.get("fy")
            self.lines.append((self.y, self.v, self.force))
        return self


def refused(instance, call, status, words):
    """The call must end with this status and a message that holds the words."""
    before = len(instance.messages)
    try:
        call()
    except FMICallException as error:
        logged = " ".join(text for _, text in instance.messages[before:])
        assert error.status == status and logged and words in logged, (error.status, logged)
        return
    raise AssertionError(f"expected a refusal: {words}")


def check_valid(units):
    for unit in units:
        problems = validate_fmu(unit.file)
        assert not problems, problems
        assert "Co-Simulation" in fmu_info(unit.file)


def check_drop(unit, reference):
    """The bits of the Rust example; a step is tried with a wrong velocity at step 40 and taken back."""
    began = time.process_time()
    instance = unit.instance()
    drop = Drop(instance).advance(40)
    state = instance.fmu.getFMUState()
    kept = instance.get("fy"), instance.get("work")
    instance.set("vy", 0.0)
    instance.step(40 * DT)
    assert instance.get("fy") != kept[0]
    instance.fmu.setFMUState(state)
    assert (instance.get("fy"), instance.get("work")) == kept, "outputs come back with the state"
    drop.advance(60)
    assert len(reference) == STEPS
    for line, row in zip(drop.lines, reference):
        assert list(line) == row[1:], f"{line}, the Rust example has {row[1:]} at {row[0]} s"
    instance.fmu.freeFMUState(state)
    instance.close()
    print(f"drop: the bits of the Rust example, {time.process_time() - began:.1f} s")
    return drop.lines


def check_states(unit, lines):
    """A state goes on in a second instance, that was built and one that was not, and again in the first."""
    first = unit.instance()
    drop = Drop(first).advance(45)
    state = first.fmu.getFMUState()
    stored = first.fmu.serializeFMUState(state)
    there = drop.y, drop.v, drop.force
    for into in (unit.instance(), unit.instance(initialised=False), first):
        into.fmu.setFMUState(into.fmu.deserializeFMUState(stored))
        drop.k, (drop.y, drop.v, drop.force), drop.lines = 45, there, []
        drop.advance(15, into)
        assert drop.lines == lines[45:60], "a state goes on to other bits"
    broken = bytearray(stored)
    for place in (0, 10, 100, len(broken) // 2):
        broken[place] ^= 0xFF
    for wrong in (b"", stored[:100], stored[:-1], bytes(broken)):
        refused(first, lambda wrong=wrong: first.fmu.deserializeFMUState(wrong), ERROR, "not a state of this unit")
    print(f"states: {len(stored)} bytes go on in a second instance to the same bits")


def check_two(unit, lines):
    """Two instances in turn, one of them started later, and two in threads of their own, give the bits of one alone."""
    drops = [Drop(unit.instance()), Drop(unit.instance())]
    drops[0].advance(3)
    for _ in range(50):
        for drop in drops:
            drop.advance(1)
    assert drops[0].lines == lines[:53] and drops[1].lines == lines[:50]
    drops[1].instance.fmu.reset()
    drops[1].instance.fmu.enterInitializationMode()
    drops[1].instance.fmu.exitInitializationMode()
    assert Drop(drops[1].instance).advance(40).lines == lines[:40], "reset"
    for drop in drops:
        drop.instance.close()
    drops = [Drop(unit.instance()) for _ in range(2)]
    threads = [threading.Thread(target=drop.advance, args=[60]) for drop in drops]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(drop.lines == lines[:60] for drop in drops), "threads"
    print("instances: two in turn, one reset, two in threads, to the bits of one alone")


def check_nodes(body, unit, turning):
    """The nodes of a rigid section give the force of the body."""
    count = len(unit.start["position"].split()) // 2
    start = numpy.array(unit.start["position"].split(), float).reshape(count, 2)
    instances = [body.instance(), unit.instance(), turning.instance()]
    y0, v = instances[0].get("y"), instances[0].get("vy")
    for k in range(60):
        fall = (k + 1) * DT * v
        instances[0].set("y", y0 + fall)
        for instance in instances[1:]:
            instance.set("position", start + [0.0, fall])
        for instance in instances:
            instance.step(k * DT)
    expected = instances[0].get("fy")
    assert expected > 1e3
    for instance in instances[1:]:
        found = instance.get("force", 2 * count).reshape(count, 2)[:, 1].sum()
        assert abs(found - expected) <= 1e-6 * abs(expected), (found, expected)
        instance.close()
    print(f"nodes: {count} nodes give {found:.9e} N/m, the body {expected:.9e} N/m")


def check_misuse(unit):
    """A wrong call has its status and message, and the run goes on as if it had not been."""
    one = unit.instance(initialised=False)
    reference = unit.references
    refused(one, lambda: one.step(0.0), ERROR, "not allowed in the state Instantiated")
    refused(one, lambda: one.set("fy", 1.0), ERROR, "is an output")
    refused(one, lambda: one.fmu.getFloat64([999]), ERROR, "no variable has the value reference 999")
    refused(one, lambda: one.fmu.setInt32([1], [1]), ERROR, "no variable of this type")
    refused(one, lambda: one.fmu.getBoolean([reference["y"]]), ERROR, "has the type Float64")
    refused(one, lambda: one.fmu.setFloat64([reference["y"]], [1.0, 2.0]), ERROR, "1 values too many")
    refused(one, one.fmu.enterEventMode, ERROR, "not supported")
    one.set("settings", "resolution.spacng=1; time.end=0.02")
    one.fmu.enterInitializationMode()
    refused(one, one.fmu.exitInitializationMode, ERROR, "resolution.spacng")
    one.set("settings", "")
    one.fmu.exitInitializationMode()
    refused(one, lambda: one.set("settings", ""), ERROR, "not allowed in the state Step Mode")
    drop = Drop(one).advance(40)
    state = one.fmu.getFMUState()
    refused(one, lambda: one.step(0.1), ERROR, "the communication point is")
    refused(one, lambda: one.step(40 * DT, -DT), DISCARD, "expected a number above 0")
    refused(one, lambda: one.step(40 * DT, math.nan), DISCARD, "expected a number above 0")
    for wrong in (math.nan, math.inf, 1e9):
        one.set("y", wrong)
        refused(one, lambda: one.step(40 * DT), DISCARD, "")
    lines = drop.advance(5).lines[40:]
    one.fmu.setFMUState(state)
    again = Drop(one)
    again.k, again.force = 40, drop.lines[39][2]
    assert again.advance(5).lines == lines, "refused calls change nothing"
    one.fmu.setFMUState(state)
    one.set("y", drop.lines[39][0] - 0.4)
    one.set("vy", 400.0)
    refused(one, lambda: one.step(40 * DT, 1e-3), ERROR, "density")
    refused(one, lambda: one.step(40 * DT), ERROR, "the step before failed")
    one.fmu.setFMUState(state)
    again.k, (again.y, again.v, again.force), again.lines = 40, drop.lines[39], []
    assert again.advance(5).lines == lines, "a step after one that failed"
    for call in ("fmi3Terminate", "fmi3Reset", "fmi3ExitInitializationMode"):
        assert getattr(one.fmu.dll, call)(None) == ERROR
    one.fmu.dll.fmi3FreeInstance(None)
    one.fmu.freeFMUState(state)
    one.close()
    with contextlib.suppress(Exception):
        Instance(unit, token="another")
        raise SystemExit("a wrong token was accepted")
    late = unit.instance(start_time=2.0, stop_time=2.0 + 3.5 * DT)
    late.set("y", late.get("y") + DT * late.get("vy"))
    assert late.step(2.0) == 2.0 + DT and late.get("time") == 2.0 + DT
    refused(late, lambda: late.step(2.0 + DT, 4 * DT), ERROR, "after the stop time")
    late.close()
    print("misuse: refused with messages, the run unchanged")


def check_table(unit):
    """fmpy moves the body by an input table, as at the start of each step."""
    y0, v = float(unit.start["y"]), float(unit.start["vy"])
    at = numpy.arange(61) * DT
    table = numpy.zeros(61, dtype=[(name, float) for name in ("time", "x", "y", "vx", "vy", "angle", "spin")])
    table["time"], table["y"], table["vy"] = at, y0 + v * at, v
    values = {"inputs_at_start": True, "spacing": 0.01}
    with contextlib.redirect_stdout(io.StringIO()):
        result = simulate_fmu(
            unit.file, stop_time=60 * DT, output_interval=DT, start_values=values, input=table, output=["fy", "fluid_steps"]
        )
    by_hand, forces = unit.instance(), []
    for k in range(60):
        by_hand.set("y", y0 + v * (k + 1) * DT)
        by_hand.step(k * DT)
        forces.append(by_hand.get("fy"))
    by_hand.close()
    worst = max(abs(a - b) for a, b in zip(result["fy"][1:], forces)) / max(forces)
    assert worst <= 1e-6 and max(forces) > 1e4 and min(result["fluid_steps"][1:]) > 0, f"the table differs by {worst:.2e}"
    print(f"table: fmpy's simulation within {worst:.1e} of single steps")


def check_record(unit, lines, folder):
    """A drop with rejected steps is recorded; the parameters may change the scene."""
    recorded = unit.instance(record=str(folder / "recorded"))
    drop = Drop(recorded).advance(40)
    for _ in range(5):
        state = recorded.fmu.getFMUState()
        recorded.set("vy", 0.0)
        recorded.step(drop.k * DT)
        recorded.fmu.setFMUState(state)
        recorded.fmu.freeFMUState(state)
        drop.advance(5)
    assert drop.lines == lines[:65]
    recorded.close()
    json.loads((folder / "recorded/summary.json").read_text())
    series = numpy.genfromtxt(folder / "recorded/series.csv", delimiter=",", names=True)
    assert (numpy.diff(series["time_s"]) > 0).all() and (folder / "recorded/report.html").exists()
    again = unit.instance(initialised=False, record=str(folder / "recorded"))
    again.fmu.enterInitializationMode()
    refused(again, again.fmu.exitInitializationMode, ERROR, "recorded")
    again.fmu.freeInstance()
    with contextlib.suppress(locale.Error):  # a decimal comma, where `check` could make one
        locale.setlocale(locale.LC_NUMERIC, "de_DE.UTF-8")
    coarse = unit.instance(spacing=0.02, settings="body.velocity=[0,-5]")
    print(f"parameters: spacing with the decimal sign {locale.localeconv()['decimal_point']}")
    locale.setlocale(locale.LC_NUMERIC, "C")
    assert coarse.get("fluid_dt") > 1.5 * recorded_dt(unit) and abs(coarse.get("vy") + 5.0) < 0.1
    coarse.close()
    print(f"record: {len(series)} rows of a run with rejected steps")


def recorded_dt(unit):
    """Step of the water at the start [s]."""
    instance = unit.instance()
    found = instance.get("fluid_dt")
    instance.close()
    return found


def main():
    folder = pathlib.Path(sys.argv[1])
    reference = [[float(word) for word in line.split()] for line in (folder / "reference.txt").read_text().splitlines()]
    body, nodes, turning = (Unit(folder / f"{name}.fmu") for name in ("body", "nodes", "turning_nodes"))
    check_valid((body, nodes, turning))
    lines = check_drop(body, reference)
    check_states(body, lines)
    check_two(body, lines)
    check_nodes(body, nodes, turning)
    check_misuse(body)
    check_table(body)
    check_record(body, lines, folder)
    print("fmi: passed")


if __name__ == "__main__":
    main()
