"""Sweeps, and the command."""

import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
import splashdown


def test_a_sweep_is_a_table_of_arrays(tmp_path: pathlib.Path) -> None:
    drop = {"model": "wagner", "time.end": 0.01}
    axes: dict[str, Any] = {"body.deadrise_deg": np.array([20, 30]), "body.mass": {"from": 150, "to": 350, "count": 2}}
    sweep = splashdown.sweep("wedge", axes=axes, set=drop, out=tmp_path / "sweep", jobs=2)
    assert len(sweep) == 4 and set(sweep.table["body.deadrise_deg"]) == {20.0, 30.0}
    assert sweep.table["status"].dtype.kind == "U"
    assert sweep.run(0).summary["model"] == "wagner"
    again = splashdown.Sweep(tmp_path / "sweep")
    assert list(again.table) == list(sweep.table)


def test_a_wrong_sweep_is_refused(tmp_path: pathlib.Path) -> None:
    with pytest.raises(splashdown.InputError, match="spacin"):
        splashdown.sweep("wedge", axes={"resolution.spacin": [1, 2]}, out=tmp_path / "a")
    with pytest.raises(splashdown.InputError, match="expected a number"):
        splashdown.sweep("wedge", axes={"resolution.spacing": [None]}, out=tmp_path / "b")
    with pytest.raises(splashdown.InputError, match="folder of a sweep"):
        splashdown.Sweep(tmp_path)


def test_the_command_is_that_of_the_program() -> None:
    def command(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-m", "splashdown", *words], capture_output=True, text=True)

    assert command("--version").stdout.split()[1] == splashdown.__version__
    assert "wedge" in command("list").stdout
    refused = command("check", "wedge", "--set", "resolution.spacing=-1")
    assert refused.returncode == 2 and "spacing" in refused.stderr
