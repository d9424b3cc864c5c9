"""Pictures as functions of parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _core

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

# What a picture is like where nothing else is said, beside what the models themselves say.
_DEFAULTS = {
    "position_angle": 0.0,
    "center_x": 0.0,
    "center_y": 0.0,
    "distance": math.inf,
    "flux": 1.0,
    "tone": 0.0,
    "asymmetry": 0.0,
}


class Parameter(NamedTuple):
    """A parameter of a model."""

    name: str
    unit: str
    """Empty for a number."""
    meaning: str
    bounds: tuple[float, float]
    default: float | None
    """What `predict` takes if it is not given; None if it has to be."""


class ImageModel:
    """A picture, and its derivatives, as a function of parameters: the forward model of `fit`. `kerrscope.model` makes one.

    Means over pixels are exact to 1e-3 of the brightest, edges included; derivatives are those of the same function.
    """

    __slots__ = ("_inner", "name", "size", "parameters")

    _inner: _core.Model
    name: str
    """The model's name."""
    size: tuple[int, int]
    """Height and width in pixels."""
    parameters: dict[str, Parameter]
    """Its parameters by their names."""

    def __init__(
        self,
        name: str,
        size: int | tuple[int, int],
        *,
        projection: str = "angular",
        orders: int | None = None,
        spacetime: str | None = None,
    ) -> None:
        height, width = (size, size) if isinstance(size, int) else size
        self._inner = _core.Model(name, width, height, projection, orders, spacetime)
        self.name = name
        self.size = (height, width)
        parameters = (
            Parameter(word, unit, meaning, (low, high), _DEFAULTS.get(word, usual))
            for word, unit, meaning, (low, high), usual in self._inner.parameters()
        )
        self.parameters = {parameter.name: parameter for parameter in parameters}

    def predict(self, derivatives: bool = False, threads: int | None = None, **values: float) -> Any:
        """The picture of values of the parameters.

        Parameters
        ----------
        derivatives
            Whether to give those too.
        threads
            How many; one for each processor if not given.
        **values
            Numbers by the parameters' names; `parameters` has their units, bounds and defaults.

        Returns
        -------
        array, or (array, dict)
            The picture, height × width, the top row first; with `derivatives` a dict too, which has for each parameter the derivative of every
            pixel, height × width, per its unit (degrees, M, pixels, …).

        Raises
        ------
        TypeError
            If a parameter that has no default is not given, or one is given that there is not.
        ValueError
            If a value is out of bounds, or there is no picture.
        """
        unknown = [name for name in values if name not in self.parameters]
        if unknown:
            raise TypeError(f"{self.name} has no parameter {', '.join(unknown)}: there are {', '.join(self.parameters)}")
        everything = {name: values.get(name, p.default) for name, p in self.parameters.items()}
        missing = [name for name, value in everything.items() if value is None]
        if missing:
            raise TypeError(f"{self.name} needs {', '.join(missing)} too")
        numbers = [float(value) for value in everything.values() if value is not None]
        image: NDArray[np.float64]
        image, slopes = self._inner.predict(numbers, derivatives, threads)
        return image if slopes is None else (image, dict(zip(self.parameters, slopes)))

    def __repr__(self) -> str:
        height, width = self.size
        return f"<kerrscope.ImageModel {self.name} {width}x{height}: {', '.join(self.parameters)}>"


def model(
    name: str = "page-thorne",
    size: int | tuple[int, int] = 128,
    *,
    projection: str = "angular",
    orders: int | None = None,
    spacetime: str | None = None,
) -> ImageModel:
    """A forward model of pictures.

    Parameters
    ----------
    name
        "page-thorne" (an opaque disk with the flux of Page & Thorne 1974, ApJ 191, 499, in the light of all frequencies), "power-law",
        "thin-power-law", "ring" (a blurred ring on the sky), or "silhouette" (the share of each pixel that is lit).
    size
        Pixels along an edge, or (height, width).
    projection
        How directions become places: "angular" (equal angles, as pictures of the sky) or "pinhole" (tangents, as a camera).
    orders
        Image orders that a silhouette shows; all if not given.
    spacetime
        A metric as text that the disk is in, by its name or the path of its file, instead of Kerr's; its numbers are parameters too.

    Examples
    --------
    >>> disk = kerrscope.model("page-thorne", size=64)
    >>> image, derivatives = disk.predict(spin=0.9, inclination=60, scale=0.6, derivatives=True)
    >>> derivatives["spin"].shape
    (64, 64)
    """
    return ImageModel(name, size, projection=projection, orders=orders, spacetime=spacetime)
