"""Sweeps: a scene at many points, each a process of its own."""

from __future__ import annotations

import csv
import json
import os
import pathlib
import subprocess
import sys
from typing import TYPE_CHECKING, Any, Mapping

from splashdown._core import InputError, StepError
from splashdown._run import Run

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Sweep:
    """A sweep: a table with a row for each point, and the runs of the points."""

    folder: pathlib.Path
    """Folder of the sweep's files, with sweep.html and table.csv."""

    table: dict[str, NDArray[np.float64] | NDArray[np.str_]]
    """Columns by name, as in table.csv, those of axes without their unit: floats where each value is a number or missing (NaN), else text."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """The sweep in a folder. Raises InputError where there is none."""
        import numpy as np

        self.folder = pathlib.Path(folder)
        path = self.folder / "table.csv"
        try:
            with path.open(newline="", encoding="utf-8") as file:
                head, *rows = list(csv.reader(file)) or [[]]
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{self.folder}: expected the folder of a sweep, with table.csv: {error}") from None
        self.table = {}
        for heading, texts in zip(head, zip(*rows)):
            name = heading.split(" [")[0]
            try:
                self.table[name] = np.array([text or "nan" for text in texts] if any(texts) else texts, dtype=np.float64)
            except ValueError:
                self.table[name] = np.array(texts)
            self.table[name].setflags(write=False)

    def __len__(self) -> int:
        """Number of points."""
        return len(next(iter(self.table.values()), ()))

    def run(self, point: int) -> Run:
        """The run of a point by its row in the table."""
        if not -len(self) <= point < len(self):
            raise InputError(f"point {point}: expected {-len(self)} to {len(self) - 1}")
        return Run(self.folder / str(self.table["folder"][point]))

    def __repr__(self) -> str:
        return f"<Sweep of {len(self)} points in {self.folder}>"


def sweep(
    scene: str | os.PathLike[str],
    axes: Mapping[str, Any],
    set: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    jobs: int | None = None,
) -> Sweep:
    """Runs a scene at every combination of the axes, in processes of their own, by the command `splashdown sweep`.

    An axis is a key of the scene with a list of values, or with a range as {"from": 20, "to": 40, "count": 5}. `out` is the sweep's
    folder (runs/SCENE_sweep without), `jobs` the number of processes at the same time. Points that have ended are not run again. A point
    that fails is a row with its status and message. Raises InputError for a wrong scene or axis, StepError where the sweep cannot run.
    """
    path = pathlib.Path(scene)
    is_file = path.suffix == ".toml" or len(path.parts) > 1
    folder = pathlib.Path(out) if out is not None else pathlib.Path("runs", f"{path.stem}_sweep")
    lines = [f"scene = {_literal(str(path.resolve()) if is_file else str(scene))}"]
    for table, entries in [("set", set or {}), ("grid", axes)]:
        lines += ["", f"[{table}]", *(f"{_key(key)} = {_literal(value)}" for key, value in entries.items())]
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "axes.toml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    command = [sys.executable, "-m", "splashdown", "sweep", str(file), "--out", str(folder), "--json", "--quiet"]
    command += [] if jobs is None else ["--jobs", str(jobs)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            output, errors = process.communicate()
        except KeyboardInterrupt:
            process.wait()  # the command gets the signal too, and ends its points
            raise
    error = _error(output)
    if process.returncode == 2:
        raise InputError(error or errors.strip())
    if process.returncode != 0 and not (folder / "table.csv").is_file():
        raise StepError(error or errors.strip())
    return Sweep(folder)


def _error(output: str) -> str:
    """The message in what the command printed."""
    try:
        error = json.loads(output)["error"]["message"]
    except (KeyError, TypeError, ValueError):
        return ""
    return str(error)


def _key(key: str) -> str:
    """A key of TOML: its parts joined by dots, in quotes where it has an index."""
    return _literal(key) if "[" in key else key


def _literal(value: Any) -> str:
    """A value as TOML has it."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_literal(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_literal(item) for item in value) + "]"
    if isinstance(value, (bool, int, str)):
        return json.dumps(value)
    if isinstance(value, float):
        return repr(value)
    raise InputError(f"{value!r}: expected a number, a truth value, text, or a list of them")
