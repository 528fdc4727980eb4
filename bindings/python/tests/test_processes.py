"""Processes: spawned ones compute, forked ones get an error at once."""

import multiprocessing
import sys
from typing import Any

import pytest
import splashdown


def force(drop: dict[str, Any]) -> float:
    return float(splashdown.run("wedge", set=drop).series["wedge.fy_N_per_m"].max())


def refusal(drop: dict[str, Any]) -> str:
    try:
        return str(force(drop))
    except splashdown.StepError as error:
        return str(error)


def test_spawned_processes_compute_the_same(drop: dict[str, Any]) -> None:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply_async(force, [drop]).get(timeout=60) == force(drop)


@pytest.mark.skipif(sys.platform != "linux", reason="fork")
@pytest.mark.filterwarnings("ignore:.*fork.*")
def test_a_forked_process_is_refused(drop: dict[str, Any]) -> None:
    force(drop)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert "spawn" in pool.apply_async(refusal, [drop]).get(timeout=60)
