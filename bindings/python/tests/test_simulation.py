"""Simulations: the same bits as a run, states, arrays, threads."""

import threading
from typing import Any

import numpy as np
import pytest
import splashdown


def test_steps_are_those_of_a_run(drop: dict[str, Any]) -> None:
    run = splashdown.run("wedge", set=drop)
    simulation = splashdown.Simulation("wedge", set=drop)
    while simulation.time < drop["time.end"]:
        assert simulation.step() > 0
    assert simulation.steps == run.summary["steps"] and simulation.time == run.summary["time_end_s"]
    motion = simulation.bodies["wedge"]
    for name, value in [("y_m", motion["position"][1]), ("fy_N_per_m", motion["force"][1])]:
        assert value == run.series[f"wedge.{name}"][-1]


def test_arrays_stay_as_they_were(drop: dict[str, Any]) -> None:
    simulation = splashdown.Simulation("wedge", set=drop)
    first = simulation.particles
    assert first["position"] is simulation.particles["position"], "one array between two steps"
    copy = first["position"].copy()
    simulation.step()
    assert np.array_equal(first["position"], copy)
    assert not np.array_equal(simulation.particles["velocity"], first["velocity"])
    particles: dict[str, Any] = dict(simulation.particles)
    shapes = {name: array.shape for name, array in particles.items()}
    count = len(copy)
    assert shapes == {name: (count, 2)[: 1 + (name in ("position", "velocity"))] for name in shapes}
    walls: dict[str, Any] = dict(simulation.walls)
    for array in walls.values():
        assert not array.flags.writeable and array.flags.c_contiguous
        with pytest.raises(ValueError):
            array[0] = 0.0


def test_a_state_comes_back_to_the_bit(drop: dict[str, Any]) -> None:
    simulation = splashdown.Simulation("wedge", set=drop)
    with pytest.raises(splashdown.StepError, match="save"):
        simulation.restore()
    simulation.run_until(0.001)
    assert simulation.time == pytest.approx(0.001, abs=1e-15)
    simulation.save()
    state = simulation.to_bytes()
    simulation.run_until(0.002)
    there = simulation.particles["position"]
    simulation.restore()
    simulation.run_until(0.002)
    assert np.array_equal(simulation.particles["position"], there)
    other = splashdown.Simulation("wedge", set=drop)
    other.restore_bytes(state)
    other.run_until(0.002)
    assert np.array_equal(other.particles["position"], there)


def test_bytes_of_another_scene_are_refused(drop: dict[str, Any]) -> None:
    simulation = splashdown.Simulation("wedge", set=drop)
    for wrong in [b"", b"no state", splashdown.Simulation("wedge", set=drop | {"tank.depth": 0.5}).to_bytes()]:
        with pytest.raises(splashdown.InputError):
            simulation.restore_bytes(wrong)
        with pytest.raises(splashdown.StepError, match="failed"):
            simulation.step()


@pytest.mark.parametrize("dt", [0.0, -1e-5, float("nan"), float("inf"), 1.0])
def test_a_step_is_positive_and_stable(drop: dict[str, Any], dt: float) -> None:
    simulation = splashdown.Simulation("wedge", set=drop)
    with pytest.raises(splashdown.InputError, match="stable_dt"):
        simulation.step(dt)
    assert simulation.step(0.5 * simulation.stable_dt) > 0


def test_a_theory_has_no_steps() -> None:
    with pytest.raises(splashdown.InputError, match="no steps") as raised:
        splashdown.Simulation("wedge", set={"model": "wagner"})
    assert raised.value.key is None and raised.value.file is None


def test_a_step_that_fails_says_where() -> None:
    # Verlet's leapfrog without its Euler step (LE3) is unstable
    leapfrog = {"fluid.integrator": "verlet", "fluid.verlet_correction_every": 0}
    simulation = splashdown.Simulation("wedge", set={"resolution.spacing": 0.02} | leapfrog)
    for _ in range(20):
        simulation.step()
    simulation.save()
    with pytest.raises(splashdown.StepError, match="t = ") as raised:
        simulation.run_until(0.1)
    assert raised.value.run is None
    with pytest.raises(splashdown.StepError, match="restore"):
        simulation.step()
    simulation.restore()
    assert simulation.step() > 0


def test_two_threads_never_wait_for_each_other(drop: dict[str, Any]) -> None:
    simulation = splashdown.Simulation("wedge", set=drop)
    refused: list[str] = []

    def work() -> None:
        for _ in range(20):
            try:
                simulation.step()
            except splashdown.StepError as error:
                refused.append(str(error))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert not any(thread.is_alive() for thread in threads)
    assert simulation.steps + len(refused) == 80 and all("one call at a time" in text for text in refused)
