"""Surveys here, in parts and on a real Dask cluster of processes, one of which is killed."""

import os
import pickle
import signal
import threading
import time

import h5py
import numpy as np
import pytest

import kerrscope
from kerrscope import survey

SURVEY = """
set = { "render.width" = 32, "render.height" = 24, "render.samples" = 1, "disk.model" = "page-thorne" }
[[axis]]
key = "spacetime.spin"
from = 0.0
to = 0.9
steps = 10
[[axis]]
key = "disk.outer"
values = [12, 20]
"""


def results(folder):
    return {path.name: path.read_bytes() for path in folder.glob("*.h5")}


@pytest.fixture(scope="module")
def plan():
    return survey.plan(SURVEY)


@pytest.fixture(scope="module")
def local(plan, tmp_path_factory):
    folder = tmp_path_factory.mktemp("local")
    told = []
    report = survey.run(plan, folder=folder, progress=lambda *counts: told.append(counts))
    assert (report.made, report.failed) == (20, {})
    assert told[-1] == (20, 20)
    return folder


def test_plans(plan, tmp_path):
    assert len(plan) == 20
    assert plan.keys == ["spacetime.spin", "disk.outer"]
    assert plan[3].values == {"spacetime.spin": pytest.approx(0.1, rel=1e-15), "disk.outer": 20}
    assert pickle.loads(pickle.dumps(plan)) == plan
    plan.write(tmp_path / "plan.json")
    assert survey.plan(tmp_path / "plan.json") == plan
    with pytest.raises(ValueError, match="sample"):
        survey.plan('[[axis]]\nkey = "spacetime.spin"\nfrom = 0\nto = 1')
    with pytest.raises(FileNotFoundError):
        survey.plan("none.toml")


def test_results_are_the_scenes(plan, local):
    image = kerrscope.open(local / f"{plan[7].name}.h5")
    assert np.array_equal(np.asarray(image), np.asarray(plan.scene(7).render()))


def test_shards_merge_to_the_same(plan, local, tmp_path):
    for k in (1, 2, 3):
        survey.run(plan, folder=tmp_path / str(k), shard=f"{k}/3")
    assert survey.merge(plan, local, tmp_path / "whole.h5") == 20
    survey.merge(plan, [tmp_path / "1", tmp_path / "2", tmp_path / "3"], tmp_path / "parts.h5")
    assert (tmp_path / "whole.h5").read_bytes() == (tmp_path / "parts.h5").read_bytes()
    library = survey.open_library(tmp_path / "whole.h5")
    assert library.sizes == {"task": 20, "y": 24, "x": 32}
    assert np.array_equal(library["spacetime.spin"], [t.values["spacetime.spin"] for t in plan])
    with h5py.File(local / f"{plan[7].name}.h5") as result:
        assert np.array_equal(library["intensity"][7], result["intensity"][()])
    with pytest.raises(ValueError, match="missing"):
        survey.merge(plan, tmp_path / "1", tmp_path / "some.h5")
    with pytest.raises(ValueError, match="4/3"):
        survey.run(plan, folder=tmp_path / "4", shard="4/3")


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_loses_a_worker(tmp_path):
    distributed = pytest.importorskip("distributed")
    # Long enough that a worker is at work when it is killed.
    slow = survey.plan(SURVEY.replace('"render.samples" = 1', '"render.samples" = 64'))
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = client.run(os.getpid)
        folder = tmp_path / "cluster"

        def kill():
            while len(results(folder)) < 6:
                time.sleep(0.01)
            os.kill(next(iter(workers.values())), signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        report = survey.run(slow, client, folder)
        killer.join()
    assert report.failed == {}
    survey.run(slow, folder=tmp_path / "here")
    assert results(folder) == results(tmp_path / "here")
    status = survey.status(slow, folder)
    assert (status["done"], status["others"]) == (20, 0)
    assert status["repeated"] == 0


def test_scenes_that_cannot_be_are_told_before_anything_is_made():
    with pytest.raises(ValueError, match="static limit"):
        survey.plan('[[axis]]\nkey = "observer.distance"\nvalues = [1.5, 30]\n')
