"""Hosts: steps, states, records, and what is refused."""

import pathlib
import threading
from typing import Any

import numpy as np
import pytest
import splashdown

DT = 1e-4


def moved(host: splashdown.Host, steps: int, dt: float = DT) -> list[np.ndarray[Any, np.dtype[np.float64]]]:
    """The forces of some steps with the velocity that the nodes have."""
    nodes, forces = host.nodes, []
    for _ in range(steps):
        nodes["position"] += dt * nodes["velocity"]
        forces.append(host.contribute(dt, nodes["position"], nodes["velocity"])[0])
    return forces


def test_the_water_answers_with_forces(drop: dict[str, Any]) -> None:
    host = splashdown.Host("wedge", set=drop)
    assert host.sizes["fluid_particles"] > 100 and host.sizes["bytes"] > 0
    start, nodes = host.time, host.nodes
    assert nodes["position"].shape == (1, 2) and nodes["rotation"].shape == (1,)
    out = np.zeros((1, 3))
    nodes["position"] += DT * nodes["velocity"]
    forces, info = host.contribute(DT, nodes["position"], nodes["velocity"], out=out)
    assert forces is out and host.time == pytest.approx(start + DT, abs=1e-12)
    assert info.fluid_steps >= 1 and 0 < info.fluid_dt < 1 and info.penetrated == 0
    np.testing.assert_allclose(info.impulse, DT * out[0, :2], rtol=1e-12)
    assert moved(host, 40, dt=2.5e-4)[-1][0, 1] > 1000.0
    assert host.forces_now.shape == (1, 3)


@pytest.mark.parametrize("interface", ["body", "nodes", "turning_nodes"])
def test_a_step_redone_gives_the_same_bits(drop: dict[str, Any], interface: Any) -> None:
    host = splashdown.Host("wedge", interface, set=drop)
    turns = interface != "nodes"
    assert host.nodes["spin"].shape == ((len(host.nodes["position"]),) if turns else (0,))
    moved(host, 10)
    host.save()
    state, there = host.to_bytes(), moved(host, 10)
    host.restore()
    assert np.array_equal(moved(host, 10), there)
    other = splashdown.Host("wedge", interface, set=drop)
    other.restore_bytes(state)
    assert np.array_equal(moved(other, 10), there)
    assert np.array_equal(other.snapshot()["position"], host.snapshot()["position"])
    with pytest.raises(splashdown.StepError, match="save"):
        other.restore()


def test_a_body_that_turns_feels_a_moment(drop: dict[str, Any]) -> None:
    host = splashdown.Host("wedge", set=drop | {"symmetry": "none"})
    nodes = host.nodes
    nodes["spin"][:] = -5.0
    for _ in range(40):
        nodes["position"] += 2.5e-4 * nodes["velocity"]
        nodes["rotation"] += 2.5e-4 * nodes["spin"]
        forces, _ = host.contribute(2.5e-4, **nodes)
    assert abs(forces[0, 2]) > 1.0
    snapshot = host.snapshot()
    assert snapshot["nodes"]["rotation"][0] == nodes["rotation"][0] and len(snapshot["surface"]) == 1


def test_records_are_those_of_a_run(drop: dict[str, Any], tmp_path: pathlib.Path) -> None:
    host = splashdown.Host("wedge", set=drop, out=tmp_path / "run")
    moved(host, 20)
    run = host.finish()
    assert run is not None and run.status.startswith("completed")
    read = splashdown.open(tmp_path / "run")
    assert read.summary == run.summary and len(read.frames) > 1
    for call in (host.finish, host.save, host.restore, host.to_bytes, lambda: host.time, lambda: host.nodes):
        with pytest.raises(splashdown.StepError, match="finish"):
            call()
    with pytest.raises(splashdown.StepError, match="finish"):
        host.contribute(DT, np.zeros((1, 2)), np.zeros((1, 2)))
    with pytest.raises(splashdown.InputError, match="already holds"):
        splashdown.Host("wedge", set=drop, out=tmp_path / "run")
    assert splashdown.Host("wedge", set=drop).finish() is None


def test_arrays_that_cannot_be_used_change_nothing(drop: dict[str, Any]) -> None:
    host, twin = splashdown.Host("wedge", set=drop), splashdown.Host("wedge", set=drop)
    good = host.nodes["position"], host.nodes["velocity"]
    read_only = np.zeros((1, 3))
    read_only.setflags(write=False)
    strided = np.zeros((1, 6))[:, ::2]
    position: Any
    for position in [
        np.zeros((2, 2)),
        np.zeros(2),
        np.zeros((1, 2), dtype=np.float32),
        np.zeros((1, 2), dtype=">f8"),
        np.zeros((1, 4))[:, ::2],
        np.full((1, 2), np.nan),
        [[0.0, 0.0]],
        None,
    ]:
        with pytest.raises(splashdown.InputError, match="expected"):
            host.contribute(DT, position, good[1])
    out: Any
    for out in [np.zeros((1, 2)), np.zeros((0, 3)), np.zeros((1, 3), dtype=np.float32), strided, read_only, [0.0] * 3]:
        with pytest.raises(splashdown.InputError, match="out: given"):
            host.contribute(DT, *good, out=out)
    for dt in [0.0, -DT, float("nan"), float("inf"), 1e9]:
        with pytest.raises(splashdown.InputError, match="step of"):
            host.contribute(dt, *good)
    with pytest.raises(splashdown.InputError, match="both or neither"):
        host.contribute(DT, *good, rotation=np.zeros(1))
    with pytest.raises(splashdown.InputError, match="speed"):
        host.contribute(DT, good[0] - [0.0, 1.0], good[1])
    with pytest.raises(splashdown.InputError, match="expected"):
        host.contribute(DT, *good, np.zeros(2), np.zeros(2))
    assert np.array_equal(moved(host, 3), moved(twin, 3))


def test_scenes_that_cannot_be_hosted_are_refused() -> None:
    interface: Any = "bodies"
    with pytest.raises(splashdown.InputError, match="turning_nodes"):
        splashdown.Host("wedge", interface)
    with pytest.raises(splashdown.InputError, match="spacing") as raised:
        splashdown.Host("wedge", set={"resolution.spacing": -1})
    assert raised.value.key == "resolution.spacing"
    with pytest.raises(splashdown.InputError, match="expected"):
        splashdown.Host("wedge", set={"model": "wagner"})
    with pytest.raises(splashdown.InputError, match="expected"):
        splashdown.Host("dam_break")
    with pytest.raises(splashdown.InputError, match="velocity"):
        splashdown.Host("wedge", velocity=np.zeros(2))


def test_a_failed_step_waits_for_restore(drop: dict[str, Any]) -> None:
    host = splashdown.Host("wedge", set=drop | {"tank.depth": 0.3})
    position, velocity = host.nodes["position"], host.nodes["velocity"]
    host.save()
    with pytest.raises(splashdown.StepError):
        for _ in range(200):  # through the floor
            velocity[0, 1] = -20.0
            position[0, 1] -= 20.0 * 5e-4
            host.contribute(5e-4, position, velocity)
    with pytest.raises(splashdown.StepError, match="restore"):
        host.contribute(DT, position, velocity)
    with pytest.raises(splashdown.StepError):
        host.to_bytes()
    host.restore()
    assert len(moved(host, 2)) == 2
    with pytest.raises(splashdown.InputError):
        host.restore_bytes(b"no state")
    with pytest.raises(splashdown.StepError):
        moved(host, 1)


def test_two_threads_never_wait_for_each_other(drop: dict[str, Any]) -> None:
    host = splashdown.Host("wedge", set=drop)
    position, velocity = host.nodes["position"], np.zeros((1, 2))
    counts = {"done": 0, "refused": 0}

    def work() -> None:
        for _ in range(10):
            try:
                host.contribute(DT, position, velocity)
                counts["done"] += 1
            except splashdown.StepError as error:
                assert "one call at a time" in str(error)
                counts["refused"] += 1

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert not any(thread.is_alive() for thread in threads)
    assert counts["done"] + counts["refused"] == 30 and counts["done"] > 0


def test_two_hosts_run_in_two_threads(drop: dict[str, Any]) -> None:
    alone = moved(splashdown.Host("wedge", set=drop), 10)
    threaded: dict[int, Any] = {}

    def work(k: int) -> None:
        threaded[k] = moved(splashdown.Host("wedge", set=drop), 10)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert all(np.array_equal(threaded[k], alone) for k in range(2))
