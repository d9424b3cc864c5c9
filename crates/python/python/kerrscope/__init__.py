"""Black holes drawn by following light through the spacetime around them, measured and fitted.

Conventions: lengths and times in M (G = c = 1), spins a in units of M from -1 to 1, angles of scenes and arguments in degrees, of
rays in radians; Boyer-Lindquist coordinates; pictures are arrays of rows, the top row first; linear light. East is left, North up.

>>> import kerrscope
>>> image = kerrscope.Scene().replace(spin=0.9, **{"render.width": 64, "render.height": 36}).render()
>>> image.shape
(36, 64, 3)

Make and draw: `Scene`, `Image`, `open`, `plot`. Follow light: `trace`, `orbits`, `shadow`. Read off pictures: `measure`, `fit`,
`Fit`. Differentiate pictures: `model`, `ImageModel`. Make many, here or on a cluster: `survey`.

All long work runs on several threads without the interpreter's lock, and stops at Ctrl-C. numpy is all that is needed; what needs
more says which extra to install.
"""

from . import _core, survey
from ._fit import Fit, fit
from ._holes import orbits, shadow
from ._image import Image, open
from ._measure import measure
from ._model import ImageModel, model
from ._rays import trace
from ._scene import Scene

__version__: str = _core.version()

__all__ = [
    "Fit",
    "Image",
    "ImageModel",
    "Scene",
    "fit",
    "measure",
    "model",
    "open",
    "orbits",
    "plot",
    "shadow",
    "survey",
    "trace",
]


def __getattr__(name: str) -> object:
    # Imported when it is first asked for.
    if name == "plot":
        import importlib

        return importlib.import_module("kerrscope.plot")
    raise AttributeError(f"module 'kerrscope' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
