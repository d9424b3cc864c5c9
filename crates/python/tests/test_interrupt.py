"""Ctrl-C, and other threads, during long work."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

RENDER = """
import sys, time, kerrscope
scene = kerrscope.Scene().replace(**{"render.width": 4000, "render.height": 4000, "adaptive": False, "render.engine": "integrator"})
print("ready", flush=True)
try:
    WORK
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

WORKS = {
    "render": "scene.render()",
    "trace": "import numpy as np; kerrscope.trace(spin=0.9, inclination=60, alpha=np.linspace(-9, 9, 3_000_000), beta=1.0, engine='integrator')",
    "fit": "import numpy as np; kerrscope.fit(kerrscope.model(size=96).predict(spin=0.9, inclination=60, scale=0.3), rounds=1000)",
}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for a child alone")
@pytest.mark.parametrize("work", WORKS)
def test_control_c_stops_work(work):
    program = RENDER.replace("WORK", WORKS[work])
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "ready\n"
        time.sleep(1.0)
        assert child.poll() is None, "it was done before it could be interrupted"
        start = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "interrupted\n"
        # A fit ends with an evaluation of each chain; machines that do other things too are slower.
        assert time.monotonic() - start < 2.0
        assert child.wait(10) == 0
    finally:
        child.kill()


def test_other_threads_go_on(small):
    scene = small.replace(**{"render.width": 600, "render.height": 600, "adaptive": False, "render.engine": "integrator"})
    counted, done = [], threading.Event()

    def count():
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.005)

    other = threading.Thread(target=count)
    other.start()
    start = time.monotonic()
    try:
        scene.render(threads=1)
    finally:
        took = time.monotonic() - start
        done.set()
        other.join()
    assert took > 0.1 and len(counted) > 10 * took


def test_children_of_fork_draw_too(small):
    if not hasattr(os, "fork"):
        pytest.skip("no fork here")
    small.render()
    program = (
        "import os, sys, kerrscope\n"
        "scene = kerrscope.Scene().replace(**{'render.width': 40, 'render.height': 20, 'render.samples': 1})\n"
        "scene.render()._repr_png_()\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    scene.render()._repr_png_()\n"
        "    os._exit(7)\n"
        "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    assert subprocess.run([sys.executable, "-W", "ignore", "-c", program], timeout=60).returncode == 7
