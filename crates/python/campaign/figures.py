"""What the package costs, beside the program: rays, and a survey on a Dask cluster of processes, one of which is killed.

    figures.py PROGRAM FOLDER

Prints a report; `cargo xtask campaign python` keeps it. Ends with 1 if a figure is not as it should be.
"""

import json
import os
import signal
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

import distributed
import numpy as np

import kerrscope
from kerrscope import survey

PROGRAM, FOLDER = sys.argv[1], Path(sys.argv[2])

# How often everything is repeated, one after the other in turns; medians count.
TIMES = 5

# 200 pictures of 128².
SURVEY = """
set = { "render.width" = 128, "render.height" = 128, "render.samples" = 64, "render.adaptive" = false, "disk.model" = "page-thorne" }
[[axis]]
key = "spacetime.spin"
from = 0.0
to = 0.99
steps = 20
[[axis]]
key = "observer.inclination"
from = 10
to = 80
steps = 10
"""

passed = True


def check(good):
    """Takes note of a figure."""
    global passed
    passed = passed and bool(good)
    return "yes" if good else "NO"


def rays():
    """A million rays, as those of the benchmark: a = 0.99, r = 30, θ = 80°, tangents within ±0.62."""
    across = np.linspace(-0.62, 0.62, 1000) * 30.0
    alpha, beta = (array.ravel() for array in np.meshgrid(across, across))
    here, there = [], []
    for _ in range(TIMES):
        start = time.process_time()
        found = kerrscope.trace(
            spin=0.99, inclination=80, distance=30, alpha=alpha, beta=beta, orders=3,
            quantities=("r", "phi", "direction"), threads=1,
        )  # fmt: skip
        here.append((time.process_time() - start) / alpha.size)
        said = subprocess.run(
            [PROGRAM, "bench", "--engine", "closed-form", "--format", "json"], capture_output=True, check=True
        )
        there.append(1.0 / json.loads(said.stdout)[0]["rays_per_cpu_s"])
    ratio = statistics.median(here) / statistics.median(there)
    crossings = int(np.isfinite(found["crossings"]["r"]).sum())
    spread = " to ".join(f"{h / t:.2f}" for h, t in sorted(zip(here, there, strict=True), key=lambda p: p[0] / p[1])[:: TIMES - 1])
    print("## Rays\n")
    print(f"`kerrscope.trace`, {alpha.size} rays ({crossings} crossings), orders=3, quantities r, phi and direction, one thread, beside ")
    print(f"`kerrscope bench --engine closed-form`, in turns, medians of {TIMES} of CPU time: {statistics.median(here) * 1e9:.0f} ns and ")
    print(f"{statistics.median(there) * 1e9:.0f} ns a ray, {ratio:.2f} times (pairs {spread}). At most 1.3: {check(ratio <= 1.3)}.\n")


def cluster():
    """200 pictures here and by two worker processes, in turns; then once more, a worker killed in the middle."""
    plan = survey.plan(SURVEY)
    file = FOLDER / "plan.json"
    plan.write(file)
    local, dask = [], []
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as workers,
        distributed.Client(workers) as client,
    ):
        # The package is loaded before anything is timed.
        client.run(lambda: kerrscope.__version__)
        for k in range(TIMES):
            start = time.perf_counter()
            subprocess.run([PROGRAM, "survey", "run", file, "--folder", FOLDER / f"local-{k}", "--quiet"], check=True)
            local.append(time.perf_counter() - start)
            start = time.perf_counter()
            report = survey.run(plan, client, FOLDER / f"dask-{k}")
            dask.append(time.perf_counter() - start)
            assert (report.made, report.failed) == (len(plan), {})
        pids = list(client.run(os.getpid).values())
        folder = FOLDER / "killed"

        def kill():
            while sum(1 for _ in folder.glob("*.h5")) < len(plan) // 2:
                time.sleep(0.005)
            os.kill(pids[0], signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        report = survey.run(plan, client, folder)
        killer.join()

    def results(folder):
        return {path.name: path.read_bytes() for path in folder.glob("*.h5")}

    same = results(FOLDER / "local-0") == results(folder) == results(FOLDER / "dask-0")
    status = survey.status(plan, folder)
    here, there = statistics.median(local), statistics.median(dask)
    overhead = 2.0 * (there - here) / len(plan)
    print("## A survey on Dask\n")
    print(f"{len(plan)} pictures of 128² and 64 samples; `kerrscope survey run` with two threads, and `kerrscope.survey.run` on a ")
    print(f"`LocalCluster` of two processes, in turns, medians of {TIMES} (and all).\n")
    print(f"- here {here:.2f} s ({', '.join(f'{t:.2f}' for t in local)}), Dask {there:.2f} s ({', '.join(f'{t:.2f}' for t in dask)})")
    print(f"- throughput of Dask {here / there:.2f} of that here; at least 0.9: {check(here / there >= 0.9)}")
    print(f"- {overhead * 1e3:.1f} ms more of a worker for each picture; less than 20: {check(overhead < 0.02)}")
    print(f"- one of the workers killed when half was there: failed {report.failed}, all {status['done']} there, ", end="")
    print(f"bytes as here: {check(same and status['done'] == len(plan) and report.failed == {})}")
    print(f"- made more than once: {status['repeated']}; nothing but what the dead worker held: {check(status['repeated'] <= 1)}")


if __name__ == "__main__":
    rays()
    cluster()
    sys.exit(0 if passed else 1)
