"""Runs: what they gave, in memory or in their folder."""

from __future__ import annotations

import builtins
import functools
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any, Mapping

from splashdown._core import InputError, Log, StepError, run_scene, toml_to_json

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from splashdown._types import BodyShape, LoggedParticles


class Run:
    """A run that has ended: its summary, series, frames and scene.

    A run in memory has summary, series and scene; frames need the log of a folder. Series read from a folder have ten digits, as
    series.csv; those of run() have all.
    """

    folder: pathlib.Path | None
    """Folder of the run's files; None for a run in memory."""

    def __init__(
        self,
        folder: pathlib.Path | None,
        summary: dict[str, Any] | None = None,
        scene_text: str | None = None,
        series: dict[str, NDArray[np.float64]] | None = None,
    ) -> None:
        self.folder = folder
        self._given = (summary, scene_text, series)

    def _read(self, name: str) -> str:
        if self.folder is None:
            raise InputError(f"{name}: the run has no folder: expected run(..., out=FOLDER)")
        try:
            return (self.folder / name).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{self.folder}: expected the folder of a run, with {name}: {error}") from None

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json."""
        if self._given[0] is not None:
            return self._given[0]
        text = self._read("summary.json")
        try:
            summary = json.loads(text)
        except ValueError as error:
            raise InputError(f"{self.folder}/summary.json: expected JSON: {error}") from None
        if not isinstance(summary, dict):
            raise InputError(f"{self.folder}/summary.json: expected an object, with scene, status and results")
        return summary

    @functools.cached_property
    def series(self) -> dict[str, NDArray[np.float64]]:
        """The curves by column, as "wedge.fy_N_per_m": read-only arrays with a value for each time of "time_s"."""
        if self._given[2] is not None:
            return self._given[2]
        import numpy as np

        text = self._read("series.csv")
        head, *rows = text[: text.rfind("\n") + 1].splitlines() or [""]  # a line without its end was cut
        columns = head.split(",")
        try:
            table = np.array([row.split(",") for row in rows], dtype=np.float64).reshape(-1, len(columns))
        except ValueError as error:
            raise InputError(f"{self.folder}/series.csv: expected rows of {len(columns)} numbers: {error}") from None
        table = np.ascontiguousarray(table.T)
        table.setflags(write=False)
        return dict(zip(columns, table))

    @functools.cached_property
    def scene_text(self) -> str:
        """The resolved scene, as TOML."""
        return self._given[1] if self._given[1] is not None else self._read("scene.resolved.toml")

    @functools.cached_property
    def scene(self) -> dict[str, Any]:
        """The resolved scene, as a dict."""
        scene = json.loads(toml_to_json(self.scene_text))
        assert isinstance(scene, dict)
        return scene

    @property
    def status(self) -> str:
        """How the run ended: "completed", "completed_with_doubts", "beyond_allowable", "ruptured", "failed" or "interrupted"."""
        return str(self.summary.get("status"))

    @property
    def results(self) -> dict[str, Any]:
        """The results by name: value, time_s, band, verdict."""
        return dict(self.summary.get("results", {}))

    @property
    def audit(self) -> dict[str, Any]:
        """Conservation of momentum, energy and volume; particles beyond walls."""
        return dict(self.summary.get("audit", {}))

    @property
    def panels(self) -> dict[str, Any]:
        """Results of the panels by name."""
        return dict(self.summary.get("panels", {}))

    @functools.cached_property
    def _log(self) -> Log:
        if self.folder is None:
            raise InputError("frames: the run has no folder: expected run(..., out=FOLDER)")
        return Log(self.folder)

    @functools.cached_property
    def frames(self) -> NDArray[np.float64]:
        """Times of the frames in the log [s]."""
        return self._log.times()

    def _frame(
        self, frame: int | None, time: float | None
    ) -> tuple[LoggedParticles, LoggedParticles, dict[str, BodyShape]]:
        count = len(self.frames)
        if count == 0:
            raise InputError(f"{self.folder}: the log has no frames")
        if (frame is None) == (time is None):
            raise InputError("expected the number of a frame, or time=")
        if time is not None:
            frame = int(abs(self.frames - time).argmin())
        assert frame is not None
        if not -count <= frame < count:
            raise InputError(f"frame {frame}: expected {-count} to {count - 1}")
        return self._log.frame(frame % count)

    def particles(self, frame: int | None = None, *, time: float | None = None) -> LoggedParticles:
        """The water's particles in a frame, by its number (-1 is the last) or by the time nearest to `time` [s].

        A dict of read-only arrays: position (n, 2) [m], velocity (n, 2) [m/s], pressure [Pa], density [kg/m³], spacing [m], id, and
        image: true of images in the plane of symmetry. The log keeps single precision.
        """
        return self._frame(frame, time)[0]

    def walls(self, frame: int | None = None, *, time: float | None = None) -> LoggedParticles:
        """The walls' particles in a frame, as particles()."""
        return self._frame(frame, time)[1]

    def bodies(self, frame: int | None = None, *, time: float | None = None) -> dict[str, BodyShape]:
        """The bodies in a frame by name: position [m], angle [rad], outline (closed lines of points in space [m])."""
        return self._frame(frame, time)[2]

    def __repr__(self) -> str:
        where = "in memory" if self.folder is None else f"in {self.folder}"
        return f"<Run of {self.summary.get('scene')}: {self.status}, {where}>"


def run(
    scene: str | os.PathLike[str],
    set: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    *,
    force: bool = False,
) -> Run:
    """Runs a scene to its end, as the command `splashdown run` does.

    With `out` the folder gets the run's files; `force` replaces a run that it holds. `threads` is the number of threads (all cores
    without); results do not depend on it. Ctrl-C ends the run after a step, and KeyboardInterrupt is raised; a folder then has a
    checkpoint for `splashdown resume`.

    Raises InputError for a wrong scene or an occupied folder, and StepError for a run that broke down; its attribute `run` is then
    the Run up to there.
    """
    summary, scene_text, columns = run_scene(
        scene, None if set is None else dict(set), out=out, threads=threads, force=force
    )
    run = ended(out, summary, scene_text, columns)
    if run.status == "failed":
        error = StepError(run.summary.get("message", "the run failed"))
        error.run = run
        raise error
    return run


def ended(
    folder: str | os.PathLike[str] | None, summary: str, scene: str, series: list[tuple[str, NDArray[np.float64]]]
) -> Run:
    """The run of a summary in JSON, a scene in TOML, and the columns of its series."""
    return Run(None if folder is None else pathlib.Path(folder), json.loads(summary), scene, dict(series))


def open(folder: str | os.PathLike[str]) -> Run:
    """The run in a folder, also of one that was killed: what is whole of its log and series.

    Raises InputError where the folder holds no run.
    """
    path = pathlib.Path(folder)
    files = ["summary.json", "series.csv", "log.mcap", "scene.resolved.toml"]
    if builtins.all(not (path / name).is_file() for name in files):
        raise InputError(f"{path}: expected the folder of a run, with summary.json, series.csv or log.mcap")
    return Run(path)
