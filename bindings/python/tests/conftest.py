"""What the tests share: a short drop, and its run with files."""

import pathlib
from typing import Any

import pytest
import splashdown

DROP: dict[str, Any] = {"resolution.spacing": 0.02, "time.end": 0.004, "time.frame_every": 0.0005}


@pytest.fixture(scope="session")
def drop() -> dict[str, Any]:
    return dict(DROP)


@pytest.fixture(scope="session")
def ended(tmp_path_factory: pytest.TempPathFactory) -> splashdown.Run:
    folder: pathlib.Path = tmp_path_factory.mktemp("runs") / "drop"
    return splashdown.run("wedge", set=DROP, out=folder)
