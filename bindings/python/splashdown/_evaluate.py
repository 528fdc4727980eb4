"""Evaluations: a scene with values of its keys, run in this process without files; equal ones are run once."""

from __future__ import annotations

import collections
import contextlib
import dataclasses
import functools
import io
import json
import os
import pathlib
import tempfile
import threading
import zipfile
from typing import TYPE_CHECKING, Any, Iterator, Literal, Mapping, NamedTuple, Protocol

from splashdown._core import InputError, Resolved

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Series = dict[str, NDArray[np.float64]]

MOST_BYTES = 128 << 20
"""Largest size of the evaluations that are kept in memory [bytes]."""


@dataclasses.dataclass(frozen=True)
class Result:
    """A number that an evaluation gave."""

    value: float
    """In the unit of its name."""
    band: float | None
    """Half width of its error band, where one is known."""
    verdict: str | None
    """"resolved" where the number with its band can be relied on, else why not."""
    time_s: float | None
    """When [s]."""
    allowed: bool | None
    """Whether it is within its limit, where it has one."""


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Results(Mapping[str, Result]):
    """What an evaluation gave: a mapping from the names of results, as "peak_force_N_per_m", those of panels as "plate.peak_stress_Pa"."""

    series: Series
    """The curves by column, as of a Run: read-only arrays."""
    cached: bool
    """True where an earlier run gave it."""
    text: str
    """The content of summary.json."""

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json, as a dict."""
        summary = json.loads(self.text)
        assert isinstance(summary, dict)
        return summary

    @property
    def status(self) -> str:
        """How the run ended: "completed", "completed_with_doubts", "beyond_allowable" or "ruptured"."""
        return str(self.summary["status"])

    @property
    def model(self) -> str:
        """The model that was run."""
        return str(self.summary["model"])

    @functools.cached_property
    def panels(self) -> dict[str, dict[str, Result]]:
        """Results of the panels by the panel's name."""
        return {name: _results(given) for name, given in self.summary.get("results", {}).get("panels", {}).items()}

    @functools.cached_property
    def _all(self) -> dict[str, Result]:
        of_panels = {f"{panel}.{name}": one for panel, given in self.panels.items() for name, one in given.items()}
        return _results(self.summary.get("results", {})) | of_panels

    def __getitem__(self, name: str) -> Result:
        try:
            return self._all[name]
        except KeyError:
            raise KeyError(f"{name}: expected one of: {', '.join(self._all)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        return f"<Results of {self.summary.get('scene')} by {self.model}: {self.status}, {', '.join(self)}>"


class CacheInfo(NamedTuple):
    """Evaluations of this process so far."""

    hits: int
    """Those that an earlier run answered."""
    runs: int
    """Runs, failed ones too."""
    entries: int
    """Evaluations in memory."""
    bytes: int
    """Their size [bytes], at most 128 MiB."""


def _results(given: Mapping[str, Any]) -> dict[str, Result]:
    """The results in a table of summary.json."""
    found = {name: one for name, one in given.items() if isinstance(one, dict) and one.get("value") is not None}
    optional = ["band", "verdict", "time_s", "allowed"]
    return {name: Result(one["value"], *map(one.get, optional)) for name, one in found.items()}


class _Store(Protocol):
    place: str

    def find(self, key: str) -> tuple[str, Series] | None: ...
    def keep(self, key: str, text: str, series: Series) -> None: ...


class _Memory:
    """Evaluations in this process; those that were not asked for longest are left out first."""

    place = ""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.kept: collections.OrderedDict[str, tuple[str, Series]] = collections.OrderedDict()
        self.bytes = 0

    def find(self, key: str) -> tuple[str, Series] | None:
        with self.lock:
            if key in self.kept:
                self.kept.move_to_end(key)
            return self.kept.get(key)

    def keep(self, key: str, text: str, series: Series) -> None:
        with self.lock:
            self.kept[key] = (text, series)
            self.bytes += self.size(text, series)
            while self.bytes > MOST_BYTES:
                self.bytes -= self.size(*self.kept.popitem(last=False)[1])

    def clear(self) -> None:
        with self.lock:
            self.kept.clear()
            self.bytes = 0

    @staticmethod
    def size(text: str, series: Series) -> int:
        return len(text) + sum(values.nbytes for values in series.values())


class _Folder:
    """Evaluations in a folder, a file each; several processes may use it."""

    def __init__(self, given: str | os.PathLike[str]) -> None:
        try:
            if given == "":
                raise ValueError("it names none")
            self.folder = pathlib.Path(given)
            self.folder.mkdir(parents=True, exist_ok=True)
        except (OSError, TypeError, ValueError) as error:
            raise InputError(f"cache = {given!r}: expected a folder, None or False: {error}") from None
        self.place = str(self.folder.resolve())

    def find(self, key: str) -> tuple[str, Series] | None:
        import numpy as np

        try:
            with np.load(self.folder / f"{key}.npz", allow_pickle=False) as file:
                text, columns, values = bytes(file["summary"]).decode(), json.loads(bytes(file["columns"])), file["values"]
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
            return None  # none, or one that was cut: it is run again
        values.setflags(write=False)
        return text, dict(zip(columns, values))

    def keep(self, key: str, text: str, series: Series) -> None:
        import numpy as np

        def plain(text: str) -> NDArray[np.uint8]:
            return np.frombuffer(text.encode(), dtype=np.uint8)

        content = io.BytesIO()
        values = np.array(list(series.values()), dtype=np.float64)
        np.savez(content, summary=plain(text), columns=plain(json.dumps(list(series))), values=values)
        with tempfile.NamedTemporaryFile(dir=self.folder, prefix=key, suffix=".part", delete=False) as part:
            part.write(content.getbuffer())
        os.replace(part.name, self.folder / f"{key}.npz")


_memory = _Memory()
_lock = threading.Lock()
_turns: dict[tuple[str, str], tuple[threading.Lock, list[None]]] = {}
_hits = _runs = 0


@contextlib.contextmanager
def _alone(place: str, key: str) -> Iterator[None]:
    """One call at a time for each evaluation: a second one waits for the first one's run."""
    with _lock:
        turn, users = _turns.setdefault((place, key), (threading.Lock(), []))
        users.append(None)
    try:
        with turn:
            yield
    finally:
        with _lock:
            users.pop()
            if not users:
                del _turns[(place, key)]


def evaluate(
    scene: str | os.PathLike[str],
    set: Mapping[str, Any] | None = None,
    cache: str | os.PathLike[str] | Literal[False] | None = None,
    threads: int | None = None,
) -> Results:
    """Runs a scene with values of its keys in this process, without files, and returns its results.

    Equal evaluations are run once. Equal are those of one resolved scene, with the content of the files that it names, and of one version
    of the program, as the points of a sweep. They are kept in memory, at most 128 MiB, or in the folder `cache`; with `cache=False` they
    are not kept.

    Threads may call it at the same time. A theory runs on one thread. Particles run on `threads`; without, on all cores where the main
    thread calls, else on one. Results do not depend on it.

    Ctrl-C ends a run of particles after a step, a theory at its end, where the main thread calls; KeyboardInterrupt is raised and nothing
    is kept. In a pool of threads the pool waits for the runs that have begun.

    Raises InputError for a wrong scene, key or value, and StepError for a run that broke down, which is not kept.
    """
    global _hits, _runs
    if threads is not None and (isinstance(threads, bool) or not isinstance(threads, int) or threads < 1):
        raise InputError(f"threads = {threads!r}: expected a whole number from 1")
    if threads is None and threading.current_thread() is not threading.main_thread():
        threads = 1
    if set is not None and not isinstance(set, Mapping):
        raise InputError(f"set = {set!r}: expected a mapping from keys to values, as {{'body.mass': 220.0}}")
    resolved = Resolved(scene, None if set is None else dict(set))

    def run() -> tuple[str, Series]:
        global _runs
        with _lock:
            _runs += 1
        text, columns = resolved.run(threads)
        return text, dict(columns)

    if cache is False:
        text, series = run()
        return Results(series, False, text)
    store: _Store = _memory if cache is None else _Folder(cache)
    key = resolved.identity
    with _alone(store.place, key):
        found = store.find(key)
        if found is None:
            text, series = run()
            store.keep(key, text, series)
            return Results(dict(series), False, text)
    with _lock:
        _hits += 1
    return Results(dict(found[1]), True, found[0])


def cache_info() -> CacheInfo:
    """Evaluations of this process so far."""
    with _lock, _memory.lock:
        return CacheInfo(_hits, _runs, len(_memory.kept), _memory.bytes)


def cache_clear() -> None:
    """Forgets the evaluations in memory, and begins to count from 0. Folders stay."""
    global _hits, _runs
    _memory.clear()
    with _lock:
        _hits = _runs = 0
