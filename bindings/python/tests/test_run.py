"""Runs: in memory, with files, read back, refused, interrupted."""

import json
import pathlib
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time
from typing import Any

import numpy as np
import pytest
import splashdown


def test_a_run_has_summary_series_and_scene(drop: dict[str, Any]) -> None:
    run = splashdown.run("wedge", set=drop, threads=1)
    assert run.status.startswith("completed") and run.summary["scene"] == "wedge"
    times, force = run.series["time_s"], run.series["wedge.fy_N_per_m"]
    assert times.dtype == np.float64 and times.shape == force.shape and len(times) > 10
    assert force.max() > 0 and not force.flags.writeable
    assert run.scene["resolution"]["spacing"] == 0.02
    assert abs(run.audit["momentum"]) < 1e-10 and run.panels == {}
    with pytest.raises(splashdown.InputError, match="out=FOLDER"):
        run.frames


def test_panels_have_results() -> None:
    run = splashdown.run("elastic_gate", set={"time.end": 0.002})
    assert list(run.panels) == ["gate"] and "gate" in run.scene["body"]["panels"][0]["name"]


def test_a_run_that_breaks_down_keeps_what_it_computed() -> None:
    # Verlet's leapfrog without its Euler step (LE3) is unstable
    leapfrog = {"fluid.integrator": "verlet", "fluid.verlet_correction_every": 0}
    with pytest.raises(splashdown.StepError, match="particle [0-9]+ at") as raised:
        splashdown.run("wedge_constant", set={"resolution.spacing": 0.1} | leapfrog)
    assert raised.value.run.status == "failed" and len(raised.value.run.series["time_s"]) > 5
    assert str(raised.value) == raised.value.run.summary["message"]


def test_other_threads_go_on_during_a_run() -> None:
    ended, counted = threading.Event(), [0]

    def count() -> None:
        while not ended.wait(0.001):
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    splashdown.run("wedge", set={"resolution.spacing": 0.01, "time.end": 0.01})
    ended.set()
    thread.join()
    assert counted[0] > 20


def test_threads_do_not_change_a_bit(drop: dict[str, Any]) -> None:
    one, two = (splashdown.run("wedge", set=drop, threads=n).series for n in (1, 2))
    assert all(np.array_equal(one[name], two[name]) for name in one)


def test_a_folder_reads_back(ended: splashdown.Run) -> None:
    assert ended.folder is not None
    read = splashdown.open(ended.folder)
    assert read.summary == json.loads((ended.folder / "summary.json").read_text())
    assert read.scene == ended.scene and list(read.series) == list(ended.series)
    for name, values in read.series.items():
        np.testing.assert_allclose(values, ended.series[name], rtol=1e-9, atol=0)


def test_frames_have_particles_walls_and_bodies(ended: splashdown.Run) -> None:
    assert ended.folder is not None
    read = splashdown.open(ended.folder)
    assert len(read.frames) >= 5 and read.frames[0] == pytest.approx(read.scene["time"]["start"])
    last, fluid = read.particles(-1), read.summary["particles"]["fluid"]
    assert last["position"].shape == (2 * fluid, 2) and last["image"].sum() == fluid
    assert len({array.shape[0] for array in (last["pressure"], last["velocity"], last["id"])}) == 1
    assert np.array_equal(read.particles(time=1.0)["position"], last["position"])
    assert read.walls(0)["position"].shape[1] == 2
    body = read.bodies(-1)["wedge"]
    assert body["position"][1] == pytest.approx(read.series["wedge.y_m"][-1], abs=1e-6)
    assert body["outline"][0].shape[1] == 2


@pytest.mark.parametrize("frame", [99, -99])
def test_a_frame_that_is_not_there_is_refused(ended: splashdown.Run, frame: int) -> None:
    with pytest.raises(splashdown.InputError, match="expected -"):
        ended.particles(frame)
    with pytest.raises(splashdown.InputError, match="number of a frame"):
        ended.particles(0, time=0.0)


def test_a_mistake_has_its_key_and_line(tmp_path: pathlib.Path) -> None:
    with pytest.raises(splashdown.InputError, match="spacing") as raised:
        splashdown.run("wedge", set={"resolution.spacing": -1})
    assert raised.value.key == "resolution.spacing" and raised.value.line is None
    assert isinstance(raised.value, ValueError)
    text = "\n".join(["depth = 1", "[resolution]", "spacing = 0.01"])
    scene = tmp_path / "own.toml"
    scene.write_text(text)
    with pytest.raises(splashdown.InputError) as raised:
        splashdown.run(scene)
    assert raised.value.line == 1 and raised.value.file is not None and raised.value.file.endswith("own.toml")
    with pytest.raises(splashdown.InputError, match="did you mean `wedge`"):
        splashdown.run("wegde")


@pytest.mark.parametrize("wrong", [{1: 2}, {"a.b": object()}, {"time.end": None}, {"body.velocity": [1, None]}])
def test_settings_that_are_none(wrong: dict[Any, Any]) -> None:
    with pytest.raises(splashdown.InputError):
        splashdown.run("wedge", set=wrong)


def test_settings_of_all_kinds() -> None:
    scene, warnings = splashdown.check(
        "wedge",
        set={
            "resolution.spacing": "20 mm",
            "time.end": np.float64(0.01),
            "body.velocity": (0, -3.5),
            "fluid.shifting": False,
            "resolution.fine_zone": [np.float64(0.5), np.int64(1)],
        },
    )
    assert "spacing = 0.02\n" in scene and "velocity = [0.0, -3.5]" in scene and "fine_zone = [0.5, 1.0]" in scene
    assert isinstance(warnings, list) and "wedge" in splashdown.scenes()


def test_a_folder_that_is_occupied_is_refused(ended: splashdown.Run, drop: dict[str, Any]) -> None:
    with pytest.raises(splashdown.InputError, match="already holds a run"):
        splashdown.run("wedge", set=drop, out=ended.folder)


@pytest.mark.parametrize("threads", [0, 100_000])
def test_threads_are_bounded(threads: int) -> None:
    with pytest.raises(splashdown.InputError, match="threads = "):
        splashdown.run("wedge", threads=threads)


def test_what_is_no_run_is_refused(tmp_path: pathlib.Path, ended: splashdown.Run) -> None:
    with pytest.raises(splashdown.InputError, match="expected the folder of a run"):
        splashdown.open(tmp_path)
    assert ended.folder is not None
    broken = tmp_path / "broken"
    shutil.copytree(ended.folder, broken)
    (broken / "log.mcap").write_bytes(b"no log at all")
    (broken / "summary.json").write_text("[1]")
    (broken / "series.csv").write_text("time_s,a\n1,2\n3,x\n")
    run = splashdown.open(broken)
    for attribute in ["frames", "summary", "series"]:
        with pytest.raises(splashdown.InputError, match="expected"):
            getattr(run, attribute)


def test_a_log_that_was_cut_has_its_whole_frames(tmp_path: pathlib.Path, ended: splashdown.Run) -> None:
    assert ended.folder is not None
    cut = tmp_path / "cut"
    shutil.copytree(ended.folder, cut)
    whole = (cut / "log.mcap").read_bytes()
    (cut / "log.mcap").write_bytes(whole[: len(whole) * 2 // 3])
    (cut / "series.csv").write_text((cut / "series.csv").read_text()[:-5])
    run = splashdown.open(cut)
    assert 0 < len(run.frames) < len(ended.frames)
    assert len(run.series["time_s"]) == len(ended.series["time_s"]) - 1
    assert run.particles(-1)["position"].shape[1] == 2


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_ends_a_run_and_keeps_its_checkpoint(tmp_path: pathlib.Path) -> None:
    program = """
        import signal
        import sys
        import splashdown
        # a program that was started in the background may have it ignored
        signal.signal(signal.SIGINT, signal.default_int_handler)
        print("started", flush=True)
        try:
            splashdown.run("wedge", set={"resolution.spacing": 0.008, "time.end": 10.0, "tank.depth": 2.0}, out=sys.argv[1])
        except KeyboardInterrupt:
            print(splashdown.open(sys.argv[1]).status)
    """
    out = tmp_path / "run"
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program), str(out)], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None and process.stdout.readline().strip() == "started"
        while not (out / "series.csv").is_file() or (out / "series.csv").stat().st_size == 0:
            assert process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=120)
    assert output.strip() == "interrupted" and (out / "checkpoint.bin").is_file()


def test_a_scene_that_does_not_fit_in_memory_is_refused() -> None:
    for make in (splashdown.run, splashdown.Simulation, splashdown.Host):
        with pytest.raises(splashdown.InputError, match="memory"):
            make("wedge", set={"resolution.spacing": 2e-6})
