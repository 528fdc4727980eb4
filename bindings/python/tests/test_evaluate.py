"""Evaluations: the numbers of a run, run once, from any thread; what is refused."""

import concurrent.futures
import os
import pathlib
import pickle
import subprocess
import sys
import textwrap
from typing import Any, Iterator

import numpy as np
import pytest
import splashdown
from splashdown import _evaluate

DROP: dict[str, Any] = {"model": "mlm", "time.end": 0.02}
HOLDS_ITSELF: list[Any] = []
HOLDS_ITSELF.append(HOLDS_ITSELF)
FORCE = "peak_force_N_per_m"


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    splashdown.cache_clear()
    yield
    splashdown.cache_clear()


def runs() -> int:
    return splashdown.cache_info().runs


def own_scene(folder: pathlib.Path) -> pathlib.Path:
    """A section with a file of its outline, and a table that it is compared with."""
    (folder / "section.csv").write_text("x,y\n0,0\n0.2,0.1\n0.3,0.2\n0.3,0.4\n-0.3,0.4\n-0.3,0.2\n-0.2,0.1\n")
    (folder / "measured.csv").write_text("t,v\n0,-4\n0.004,-3.9\n")
    text = """
        name = "own"
        model = "mlm"
        symmetry = "x"
        [time]
        end = 0.004
        [body]
        name = "hull"
        shape = "polygon"
        outline = "section.csv"
        mass = 90.0
        free = ["y"]
        velocity = [0.0, -4.0]
        [[compare]]
        reference = "measured.csv"
        quantity = "hull.vy_m_per_s"
        x = "t"
        y = "v"
        tolerance = 0.5
    """
    (folder / "own.toml").write_text(textwrap.dedent(text))
    return folder / "own.toml"


@pytest.mark.parametrize("given", [DROP, {"resolution.spacing": 0.02, "time.end": 0.004}])
def test_results_are_those_of_a_run(given: dict[str, Any]) -> None:
    results, run = splashdown.evaluate("wedge", given), splashdown.run("wedge", set=given)
    with_value = {name for name, one in run.results.items() if isinstance(one, dict) and "value" in one}
    assert set(results) == with_value and len(results) >= 2
    for name, result in results.items():
        expected = run.results[name]
        assert (result.value, result.band, result.verdict, result.time_s) == tuple(
            expected[part] for part in ("value", "band", "verdict", "time_s")
        )
    assert results.status == run.status and results.model == run.summary["model"] and not results.cached
    assert list(results.series) == list(run.series)
    assert all(np.array_equal(results.series[name], run.series[name]) for name in run.series)
    assert not results.series["time_s"].flags.writeable
    with pytest.raises(KeyError, match=f"peak_forse.*{FORCE}"):
        results["peak_forse"]
    assert results.get("peak_forse") is None and FORCE in repr(results)


def test_panels_have_their_results() -> None:
    given = {"model": "boundary_element", "time.end": 0.002, "body.panels[0].elements": 8}
    results = splashdown.evaluate("flexible_wedge", given)
    stress = results.panels["plate"]["peak_stress_Pa"]
    assert stress == results["plate.peak_stress_Pa"] and stress.value > 0.0


def test_equal_evaluations_are_run_once() -> None:
    first = splashdown.evaluate("wedge", DROP)
    # the same values, otherwise written
    same: list[dict[str, Any]] = [
        DROP,
        dict(reversed(DROP.items())),
        DROP | {"time.end": "20 ms"},
        DROP | {"time.end": np.float64(0.02), "body.mass": np.int64(241)},
        DROP | {"body.velocity": np.array([0.0, -6.15])},
    ]
    for given in same:
        again = splashdown.evaluate("wedge", given)
        assert again.cached and again[FORCE] == first[FORCE]
    assert splashdown.cache_info()[:3] == (len(same), 1, 1)
    other = splashdown.evaluate("wedge", DROP | {"body.mass": 242})
    assert not other.cached and other[FORCE] != first[FORCE] and runs() == 2
    assert not splashdown.evaluate("wedge", DROP, cache=False).cached and runs() == 3


def test_what_a_caller_changes_stays_its_own() -> None:
    first = splashdown.evaluate("wedge", DROP)
    first.summary["status"] = "changed"
    first.series.clear()
    again = splashdown.evaluate("wedge", DROP)
    assert again.cached and again.status == "completed" and len(again.series["time_s"]) > 10
    with pytest.raises(AttributeError):
        setattr(again, "cached", False)


def test_a_changed_file_is_another_evaluation(tmp_path: pathlib.Path) -> None:
    scene = own_scene(tmp_path)
    names = ["own.toml", "section.csv", "measured.csv"]
    first = splashdown.evaluate(scene)
    assert splashdown.evaluate(scene).cached and runs() == 1
    changes = {"own.toml": ("90.0", "95.0"), "section.csv": ("0.2,0.1", "0.2,0.11"), "measured.csv": ("-3.9", "-3.8")}
    for count, (name, (old, new)) in enumerate(changes.items(), 2):
        text, times = (tmp_path / name).read_text(), (tmp_path / name).stat()
        (tmp_path / name).write_text(text.replace(old, new))
        os.utime(tmp_path / name, ns=(times.st_atime_ns, times.st_mtime_ns))  # the content counts, not its time
        changed = splashdown.evaluate(scene)
        assert not changed.cached and runs() == count, name
        (tmp_path / name).write_text(text)
        assert splashdown.evaluate(scene).cached and runs() == count, name
        if name == "measured.csv":
            assert changed.summary["comparison"] != first.summary["comparison"]
        else:
            assert changed[FORCE] != first[FORCE]
    assert sorted(os.listdir(tmp_path)) == sorted(names)  # nothing was written


def test_a_folder_keeps_evaluations_for_other_processes(tmp_path: pathlib.Path) -> None:
    kept = tmp_path / "kept"
    first = splashdown.evaluate("wedge", DROP, cache=kept)
    again = splashdown.evaluate("wedge", DROP, cache=str(kept))
    assert again.cached and again.text == first.text and splashdown.cache_info()[:3] == (1, 1, 0)
    assert all(np.array_equal(again.series[name], values) for name, values in first.series.items())
    assert not again.series["time_s"].flags.writeable
    program = f"import splashdown; print(splashdown.evaluate('wedge', {DROP!r}, cache={str(kept)!r}).cached)"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout.strip() == "True"
    (file,) = kept.iterdir()
    file.write_bytes(file.read_bytes()[:500])
    repaired = splashdown.evaluate("wedge", DROP, cache=kept)
    assert not repaired.cached and repaired[FORCE] == first[FORCE]
    assert splashdown.evaluate("wedge", DROP, cache=kept).cached and len(list(kept.iterdir())) == 1


def test_the_key_is_that_of_a_sweep(tmp_path: pathlib.Path) -> None:
    sweep = splashdown.sweep("wedge", axes={"body.mass": [241]}, set=DROP, out=tmp_path / "sweep")
    splashdown.evaluate("wedge", DROP, cache=tmp_path / "kept")
    (file,) = (tmp_path / "kept").iterdir()
    assert sweep.table["folder"][0] == f"points/{file.stem}"


def test_memory_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    splashdown.evaluate("wedge", DROP)
    monkeypatch.setattr(_evaluate, "MOST_BYTES", int(2.5 * splashdown.cache_info().bytes))
    for mass in (200, 210):
        splashdown.evaluate("wedge", DROP | {"body.mass": mass})
    info = splashdown.cache_info()
    assert info.entries == 2 and info.bytes <= _evaluate.MOST_BYTES
    assert splashdown.evaluate("wedge", DROP | {"body.mass": 210}).cached
    assert not splashdown.evaluate("wedge", DROP).cached  # the one that was not asked for longest


def test_a_pool_of_threads_gives_the_bits_of_one() -> None:
    points = [DROP | {"body.mass": mass} for mass in range(200, 206)]
    points += [{"resolution.spacing": 0.02, "time.end": 0.003, "body.mass": mass} for mass in (200, 210)]
    serial = [splashdown.evaluate("wedge", point, cache=False) for point in points]
    splashdown.cache_clear()
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        pooled = list(pool.map(lambda point: splashdown.evaluate("wedge", point), 3 * points))
    # a point that another thread runs is waited for
    assert runs() == len(points) and splashdown.cache_info().hits == 2 * len(points)
    for one, other in zip(3 * serial, pooled):
        assert dict(one) == dict(other)
        assert all(np.array_equal(one.series[name], other.series[name]) for name in one.series)


def test_a_call_in_a_pool_takes_one_thread() -> None:
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        point = {"resolution.spacing": 0.02, "time.end": 0.003}
        assert pool.submit(splashdown.evaluate, "wedge", point).result().summary["threads"] == 1
        assert pool.submit(splashdown.evaluate, "wedge", point, False, 2).result().summary["threads"] == 2


def test_results_go_to_other_processes() -> None:
    results = splashdown.evaluate("wedge", DROP)
    copy = pickle.loads(pickle.dumps(results))
    assert dict(copy) == dict(results) and np.array_equal(copy.series["time_s"], results.series["time_s"])


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("body.mas", 241, "did you mean `mass`|unknown key"),
        ("body.mass", "heavy", "number"),
        ("body.mass", "241 m/s", "kg"),
        ("body.mass", -1.0, "above 0|positive|expected"),
        ("body.mass", True, "number"),
        ("body.mass", [1, 2], "number"),
        ("body.mass", float("nan"), "finite"),
        ("body.mass", np.inf, "finite"),
        ("body.mass", np.array([241.0]), "number"),
        ("body.mass", 1 + 2j, "finite number"),
        ("body.mass", None, "finite number"),
        ("body.velocity", [0.0, np.nan], "finite"),
        ("body.velocity", {0.0, -6.15}, "finite number"),
        ("body.velocity", HOLDS_ITSELF, "less deep"),
        ("body.panels[3].thickness", 0.003, "panels"),
        ("model", "magic", "boundary_element"),
        ("body.mass=3 #", 241, "expected text"),
        ("", 241, "key"),
    ],
)
def test_a_wrong_value_names_its_key(key: str, value: Any, words: str) -> None:
    with pytest.raises(splashdown.InputError, match=words) as raised:
        splashdown.evaluate("wedge", {key: value})
    assert key.split("=")[0] in str(raised.value)
    assert splashdown.cache_info()[:3] == (0, 0, 0)
    if isinstance(value, float) and not np.isfinite(value):
        assert raised.value.key == key and raised.value.expected is not None


@pytest.mark.parametrize("given", ["body.mass=3", [("body.mass", 3)], 3])
def test_settings_that_are_no_mapping(given: Any) -> None:
    with pytest.raises(splashdown.InputError, match="expected a mapping"):
        splashdown.evaluate("wedge", given)


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "2", 100_000])
def test_wrong_threads(threads: Any) -> None:
    with pytest.raises(splashdown.InputError, match="threads = "):
        splashdown.evaluate("wedge", DROP, threads=threads)


@pytest.mark.parametrize("cache", [True, 3, "", __file__])
def test_a_cache_that_is_no_folder(cache: Any) -> None:
    with pytest.raises(splashdown.InputError, match="expected a folder"):
        splashdown.evaluate("wedge", DROP, cache=cache)
    assert runs() == 0


def test_a_run_that_fails_raises_its_reason_each_time(tmp_path: pathlib.Path) -> None:
    # Verlet's leapfrog without its Euler step (LE3) is unstable
    leapfrog = {"resolution.spacing": 0.1, "fluid.integrator": "verlet", "fluid.verlet_correction_every": 0}
    for count in (1, 2):
        with pytest.raises(splashdown.StepError, match="particle [0-9]+ at"):
            splashdown.evaluate("wedge_constant", leapfrog, cache=tmp_path)
        assert runs() == count and not list(tmp_path.iterdir())


def test_nothing_is_written(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    splashdown.evaluate("wedge", DROP)
    assert not list(tmp_path.iterdir()) and capfd.readouterr() == ("", "")


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_ends_an_evaluation_and_keeps_nothing() -> None:
    program = """
        import os, signal, threading
        import splashdown
        signal.signal(signal.SIGINT, signal.default_int_handler)
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        try:
            splashdown.evaluate("wedge", {"resolution.spacing": 0.008, "time.end": 10.0, "tank.depth": 2.0})
        except KeyboardInterrupt:
            print(splashdown.cache_info()[:3])
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=120)
    assert done.stdout.strip() == "(0, 1, 0)", done.stderr
