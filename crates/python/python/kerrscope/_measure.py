"""Numbers read off pictures."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from ._image import Image

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Pictured = Union[Image, str, os.PathLike[str], ArrayLike]


def picture(of: Pictured, pixel_uas: float | None, pixel_m: float | None) -> _core.Picture:
    """A picture of an image, a path, or an array of height × width or height × width × 3, of which the mean is taken."""
    if isinstance(of, (Image, str, os.PathLike)):
        if pixel_uas is not None or pixel_m is not None:
            raise ValueError("files and images say how large their pixels are: leave pixel_uas and pixel_m away")
        return _core.Picture.of_film(of._inner) if isinstance(of, Image) else _core.Picture.open(os.fspath(of))
    values = np.asarray(of, float)
    if values.ndim == 3 and values.shape[2] == 3:
        values = values.mean(axis=2)
    if values.ndim != 2:
        raise ValueError(f"an array of the shape {values.shape} is no picture: give height × width, or height × width × 3")
    return _core.Picture.of_array(np.ascontiguousarray(values), pixel_uas, pixel_m)


def measure(image: Pictured, *, pixel_uas: float | None = None, pixel_m: float | None = None) -> dict[str, Any]:
    """Shadow, ring and disk of a picture of anybody's, to parts of a pixel, as `kerrscope measure --format json`.

    Parameters
    ----------
    image
        An `Image`; a path (FITS, EXR, PNG, JPEG, TIFF, WebP, HDR); or an array in linear light, the top row first, of height × width or
        height × width × 3.
    pixel_uas, pixel_m
        The side of a pixel of an array, in µas and in M at the distance of the hole, if they are known.

    Returns
    -------
    dict
        `size` [width, height]; `pixel` {`microarcseconds`, `gravitational_radii`}, None where not known; `trusted_brightness`; `shadow`,
        `ring` and `disk`, each {"found": {…}} or {"not_found": reason}. Lengths are in pixels, places right and up of the picture's
        middle, and what is measured is {`value`, `error`}, the error one standard deviation. The ring's definitions are those of
        EHT Collaboration 2019, ApJL 875, L4.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If it is no picture, the same all over, or has pixels that are no numbers.
    """
    features: dict[str, Any] = json.loads(_core.measure(picture(image, pixel_uas, pixel_m)))
    return features
