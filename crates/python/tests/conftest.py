"""What tests share."""

import json
import os
import subprocess

import pytest

import kerrscope

SMALL = {"render.width": 48, "render.height": 27, "render.samples": 1}

SHINING = """
spacetime.spin = 0.9
observer = { distance = 100, inclination = 60 }
screen = { kind = "angular", field_of_view = 24 }
disk = { model = "page-thorne", outer = 15, light = "blackbody", temperature = 1e10 }
sky.kind = "black"
units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }
render = { width = 40, height = 30, samples = 4, layers = ["fate", "r", "g", "sky_theta", "depth"] }
"""


@pytest.fixture(scope="session")
def program():
    """Runs the program `kerrscope` and gives the JSON that it prints."""
    path = os.environ.get("KERRSCOPE_PROGRAM")
    if not path:
        pytest.skip("KERRSCOPE_PROGRAM does not say where the program is")

    def run(*words, cwd=None):
        done = subprocess.run([path, *map(str, words)], capture_output=True, text=True, check=True, cwd=cwd)
        return json.loads(done.stdout)

    return run


@pytest.fixture(scope="session")
def small():
    """The built-in scene, small."""
    return kerrscope.Scene().replace(**SMALL)


@pytest.fixture(scope="session")
def shining():
    """A disk that shines by physics, with units and layers, drawn."""
    return kerrscope.Scene.from_toml(SHINING).render()
