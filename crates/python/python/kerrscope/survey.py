"""Surveys: pictures of a scene over ranges of its keys, made here or by a Dask cluster.

A survey file says which scene, which of its keys vary, and over what (`kerrscope survey --help`). Each picture is a file in a folder,
named by a hash of all that it depends on: what is there is not made again, whoever made it.

>>> import kerrscope
>>> plan = kerrscope.survey.plan('''
... set = { "render.width" = 32, "render.height" = 32, "render.samples" = 1 }
... [[axis]]
... key = "spacetime.spin"
... from = 0.0
... to = 0.9
... steps = 4
... ''')
>>> len(plan), plan[3].values
(4, {'spacetime.spin': 0.9})

An axis has `from`, `to` and `steps`, or `values = [0.0, 0.5, 0.9]`. What follows makes the pictures, here or by a cluster, puts them into
one file, and opens that::

    report = kerrscope.survey.run(plan, folder="spins")      # client=dask.distributed.Client(...) for a cluster
    kerrscope.survey.merge(plan, "spins", "spins.h5")
    library = kerrscope.survey.open_library("spins.h5")      # an xarray.Dataset

Each picture in the folder is an HDF5 file of its own that `kerrscope.open` reads.
"""

import json
import os
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from . import _core
from ._extras import need
from ._scene import Scene

__all__ = ["Plan", "Report", "Task", "merge", "open_library", "plan", "run", "status"]

# Tasks that wait at a scheduler, for each of the cluster's threads.
_AHEAD = 20


@dataclass(frozen=True)
class Task:
    """A picture of a survey: its name, the hash of all that it depends on, and the value of each key that varies."""

    name: str
    values: dict[str, Any]


@dataclass(frozen=True)
class Report:
    """What a run did: how many pictures it made, how long it took in s, and the faults of those that failed by their numbers."""

    made: int
    seconds: float
    failed: dict[int, str]


class Plan(Sequence[Task]):
    """The pictures of a survey, in the order of the axes, the last varying fastest. Picklable; the same survey is the same plan."""

    def __init__(self, core: _core.Plan) -> None:
        self._core = core
        keys = core.keys
        values = json.loads(core.values())
        self._tasks = [Task(n, dict(zip(keys, v, strict=True))) for n, v in zip(core.names, values, strict=True)]

    @property
    def keys(self) -> list[str]:
        """The keys that vary."""
        return self._core.keys

    def scene(self, number: int) -> Scene:
        """The scene of a task."""
        text, folder = self._core.scene(range(len(self))[number])
        return Scene.from_toml(text, folder=folder)

    def missing(self, folder: str | PathLike[str], shard: str | None = None) -> list[int]:
        """Numbers of the tasks, all or those of a part "K/N", whose results are not in a folder; of tasks that are the same picture, the
        first. `ValueError` if the part is none."""
        return self._core.missing(os.fspath(folder), shard)

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the plan as JSON, for `kerrscope survey run` on machines like this one."""
        Path(path).write_text(self._core.to_json(), encoding="utf-8")

    def __len__(self) -> int:
        return len(self._tasks)

    def __getitem__(self, number: Any) -> Any:
        return self._tasks[number]

    def __iter__(self) -> Iterator[Task]:
        return iter(self._tasks)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plan) and self._core.to_json() == other._core.to_json()

    def __hash__(self) -> int:
        return hash(self._core.to_json())

    def __repr__(self) -> str:
        return f"<kerrscope.survey.Plan: {len(self)} pictures over {', '.join(self.keys) or 'nothing'}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._core.to_json(),)


def _unpickled(text: str) -> Plan:
    return Plan(_core.Plan(text))


def plan(survey: str | PathLike[str], folder: str | PathLike[str] = "") -> Plan:
    """The plan of a survey.

    Parameters
    ----------
    survey
        The path of a survey file (TOML) or of a plan (JSON); or the text of a survey file: what has several lines, or a `=`.
    folder
        Where the paths in a text begin.

    Raises
    ------
    ValueError
        Everything that is wrong with it, each fault at its place.
    FileNotFoundError, OSError
        If the file cannot be read.
    """
    if isinstance(survey, str) and ("\n" in survey or "=" in survey):
        return Plan(_core.Plan.from_toml(survey, os.fspath(folder)))
    return Plan(_core.Plan.read(os.fspath(survey)))


def run(
    plan: Plan,
    client: Any = None,
    folder: str | PathLike[str] = "survey",
    *,
    shard: str | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Report:
    """Makes the pictures of a plan that are not in a folder yet.

    Parameters
    ----------
    plan
        What to make.
    client
        A `distributed.Client`: pictures are made by its cluster, one on each thread of a worker. Without it, here.
    folder
        Where results are. If workers see the same folder they write into it, each picture as soon as it is done; else their
        results come here and are written by this process.
    shard
        A part of the plan: every N-th task from the K-th on, as "2/3".
    threads
        Threads to use here; one for each processor if None. Not for clusters.
    progress
        Is told how many pictures are done, of how many that were missing.

    Raises
    ------
    ValueError
        If the plan is for instructions that this machine does not have, or the shard is none.
    OSError
        If the folder cannot be written.

    Notes
    -----
    A picture that fails does not keep others from being made: see `Report.failed`. When a worker dies its cluster gives what it was at
    to others; what is in the folder is not made again. Ctrl-C stops; a second run goes on.
    """
    start = time.perf_counter()
    where = os.path.abspath(os.fspath(folder))
    if client is None:
        before = len(plan.missing(where, shard))
        failed = dict(plan._core.run(where, shard, threads, progress))
        return Report(before - len(failed), time.perf_counter() - start, failed)
    if threads is not None:
        raise ValueError("threads: the cluster's workers have theirs; leave it out, or the client")
    missing = plan.missing(where, shard)
    plan._core.keep_plan(where)
    mark = Path(where) / f".shared-{uuid.uuid4().hex}"
    mark.touch()
    try:
        failed = _on_cluster(plan, client, where, mark.name, missing, progress)
    finally:
        mark.unlink(missing_ok=True)
    return Report(len(missing) - len(failed), time.perf_counter() - start, failed)


def _on_cluster(
    plan: Plan,
    client: Any,
    folder: str,
    mark: str,
    missing: list[int],
    progress: Callable[[int, int], object] | None,
) -> dict[int, str]:
    distributed = need("distributed", "running a survey on a cluster")
    core, names = plan._core, plan._core.names
    waiting = iter(missing)
    run_id = uuid.uuid4().hex[:8]

    def submit(number: int) -> Any:
        text = core.only(number).to_json()
        return client.submit(_work, text, folder, mark, key=f"kerrscope-{names[number]}-{run_id}", pure=False)

    threads = max(1, sum(client.nthreads().values()))
    at_work = {}
    failed: dict[int, str] = {}
    done = 0
    results = distributed.as_completed()
    try:
        for number in waiting:
            future = submit(number)
            at_work[future.key] = number
            results.add(future)
            if len(at_work) >= _AHEAD * threads:
                break
        # All that comes in meanwhile is taken at once.
        for batch in results.batches():
            for future in batch:
                number = at_work.pop(future.key)
                if future.status == "finished":
                    contents, worker, seconds = future.result()
                    if contents is not None:
                        core.keep(folder, number, contents, worker, seconds)
                else:
                    error = future.exception()
                    if isinstance(error, ModuleNotFoundError):
                        raise ModuleNotFoundError(f"the cluster's workers need this package too: {error}") from error
                    failed[number] = str(error)
                future.release()
                done += 1
                following = next(waiting, None)
                if following is not None:
                    future = submit(following)
                    at_work[future.key] = following
                    results.add(future)
            if progress is not None:
                progress(done, len(missing))
            if not at_work:
                break
    finally:
        if at_work:
            client.cancel([distributed.Future(key, client) for key in at_work], force=True)
    return failed


def _work(text: str, folder: str, mark: str) -> tuple[bytes | None, str, float]:
    """Makes the only task of a plan, on a worker. The result, unless the worker has put it where it belongs."""
    one = _core.Plan(text)
    shared = os.path.exists(os.path.join(folder, mark))
    if shared and not one.missing(folder):
        return None, _core.worker(), 0.0
    start = time.perf_counter()
    contents = bytes(one.make(0, 1))
    seconds = time.perf_counter() - start
    if shared:
        one.keep(folder, 0, contents, _core.worker(), seconds)
        return None, _core.worker(), seconds
    return contents, _core.worker(), seconds


def status(plan: Plan, folder: str | PathLike[str] = "survey") -> dict[str, Any]:
    """How far a survey is: `tasks`, `done`, `others` (results of other surveys or versions), `seconds` of work, `repeated` (pictures made
    more than once) and `workers`, as the journal in the folder knows.

    Raises `FileNotFoundError` or `OSError` if there is no such folder.
    """
    return dict(json.loads(plan._core.status(os.fspath(folder))))


def merge(
    plan: Plan,
    folders: str | PathLike[str] | Sequence[str | PathLike[str]],
    to: str | PathLike[str],
    *,
    partial: bool = False,
) -> int:
    """Writes one HDF5 file of all pictures, with a table of their parameters, and gives their number.

    `folders` is one folder of results or several, as of shards. The file is the same whichever they are. With `partial`, what is missing is left
    out; else it is a `ValueError`, as are pictures of several sizes.
    """
    several = [folders] if isinstance(folders, str | PathLike) else list(folders)
    return plan._core.merge([os.fspath(folder) for folder in several], os.fspath(to), partial)


def open_library(path: str | PathLike[str]) -> Any:
    """A library as an `xarray.Dataset`: images with dimensions `task`, `y` and `x`, each task's parameters as coordinates along `task`,
    and what all pictures share as attributes.

    Raises `ImportError` without xarray and h5py, and `FileNotFoundError` or `OSError` if the file cannot be read.
    """
    xarray = need("xarray", "opening a library")
    h5py = need("h5py", "opening a library")
    with h5py.File(path, "r") as file:
        table = file["parameters"]
        columns = {name: ("task", _column(column)) for name, column in table.items()}
        images = {
            name: (("task", "y", "x"), image[()], {"title": image.attrs["title"], "unit": image.attrs["unit"]})
            for name, image in file.items()
            if isinstance(image, h5py.Dataset) and image.ndim == 3
        }
        shared = {name: value for name, value in file.attrs.items() if not name.startswith("_")}
        shared["scene"] = _column(file["kerrscope"])[0]
    return xarray.Dataset(images, coords=columns, attrs=shared)


def _column(dataset: Any) -> Any:
    """The numbers or texts of a dataset."""
    return dataset.asstr()[()] if dataset.dtype.kind == "O" else dataset[()]
