"""Pictures that were drawn."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._extras import need
from ._scene import Scene

if TYPE_CHECKING:
    import xarray
    from numpy.typing import DTypeLike, NDArray

_OF_ORDER = re.compile(r"n(\d+)\.(.+)\Z")


class Image:
    """A picture in linear light, its data layers, and how it was made. `Scene.render` and `kerrscope.open` give one.

    numpy takes it as an array of height × width × 3 numbers (float32): linear red, green and blue of the primaries of Rec. 709, of
    which 1 is the white of a display before exposure; the top row first. The array is shared and cannot be written to: `numpy.array(image)`
    gives one of one's own.
    """

    __slots__ = ("_inner", "_light", "_layers", "_units", "_titles", "_radiance")

    _inner: _core.Film
    _light: NDArray[np.float32] | None
    _layers: dict[str, NDArray[np.float32]] | None
    _units: dict[str, str]
    _titles: dict[str, str]
    # Nothing before it was asked for; then one or none.
    _radiance: list[tuple[str, str, str, NDArray[np.float64]]] | None

    def __init__(self) -> None:
        raise TypeError("images come from Scene.render and kerrscope.open")

    @classmethod
    def _of(cls, core: _core.Film) -> Image:
        image = cls.__new__(cls)
        image._inner = core
        image._light = None
        image._layers = None
        image._units = {}
        image._titles = {}
        image._radiance = None
        return image

    @property
    def light(self) -> NDArray[np.float32]:
        """Linear light, height × width × 3."""
        if self._light is None:
            self._light = _fixed(self._inner.light())
        return self._light

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        light = self.light
        if dtype is not None and np.dtype(dtype) != light.dtype:
            if copy is False:
                raise ValueError(f"light is of float32 numbers: as {np.dtype(dtype)} it would be a copy")
            return light.astype(dtype)
        return light.copy() if copy else light

    @property
    def shape(self) -> tuple[int, int, int]:
        """Height and width in pixels, and 3."""
        height, width = self._inner.size
        return height, width, 3

    def __len__(self) -> int:
        return self.shape[0]

    @property
    def layers(self) -> dict[str, NDArray[np.float32]]:
        """The data layers that the scene asks for, as by `scene.replace(**{"render.layers": ["g", "fate"]})`, by their names.

        `r`, `phi`, `t`, `g` and `intensity` are orders × height × width; `fate`, `crossings`, `windings`, `steps`, `error`, `sky_theta`,
        `sky_phi` and `depth` are height × width. They are of the ray through each
        pixel's centre, in Boyer-Lindquist coordinates; NaN where a ray has none. `units` has their units.
        """
        if self._layers is None:
            orders: dict[str, list[Any]] = {}
            layers: dict[str, NDArray[np.float32]] = {}
            for name, title, unit, values in self._inner.layers():
                found = _OF_ORDER.match(name)
                word = found[2] if found else {"Z": "depth"}.get(name, name)
                self._units[word] = unit
                self._titles[word] = title.split(", image order")[0]
                if found:
                    orders.setdefault(word, []).append(values)
                else:
                    layers[word] = _fixed(values)
            layers.update((word, _fixed(np.stack(values))) for word, values in orders.items())
            self._layers = layers
        return self._layers

    @property
    def units(self) -> dict[str, str]:
        """Units of `layers` and of `radiance`; empty for pure numbers."""
        units = {name: self._units[name] for name in self.layers}
        found = self._intensity()
        return units if found is None else {"radiance": found[2], **units}

    def _intensity(self) -> tuple[str, str, str, NDArray[np.float64]] | None:
        if self._radiance is None:
            found = self._inner.intensity()
            self._radiance = [] if found is None else [(*found[:3], _fixed(found[3]))]
        return self._radiance[0] if self._radiance else None

    @property
    def radiance(self) -> NDArray[np.float64] | None:
        """The physical intensity, height × width, of a disk that shines by physics; None for what is drawn.

        In Jy a pixel where the scene's `[units]` have mass, distance and frequency; W m⁻² Hz⁻¹ sr⁻¹ where they have only a frequency;
        otherwise that of all frequencies in units of Ṁ/M² per sr (`units["radiance"]`).
        """
        found = self._intensity()
        return None if found is None else found[3]

    @property
    def scene(self) -> Scene:
        """The scene that it shows."""
        return Scene._of(self._inner.scene)

    @property
    def provenance(self) -> dict[str, Any]:
        """How it was made: `version`, `seed`, `instruction_level`, and `record`, the text that files carry, itself a scene."""
        about = self._inner.about()
        names = ("version", "seed", "instruction_level")
        return {**{name: about[name] for name in names}, "record": self._inner.record}

    @property
    def about(self) -> dict[str, Any]:
        """What is known of it, by the names of `kerrscope render --format json`.

        Rays traced and given up, error estimates (radians of direction, or relative radius), how well it was interpolated; the side of a
        pixel in M and µas, `total_flux_jy`, and `centroid` and `size` (full widths at half maximum, right and up) in `length_unit`.
        None is what is not known.
        """
        return self._inner.about()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .png (as a screen shows it), .exr, .fits or .h5 (linear light, intensity and layers), whole or not at all.

        Raises
        ------
        OSError
            If it cannot be written.
        ValueError
            If the name ends otherwise.
        """
        self._inner.save(os.fspath(path))

    def show(self) -> None:
        """Shows it: in the notebook, or in whatever this machine shows PNG files with."""
        try:
            from IPython import get_ipython  # type: ignore[import-not-found,unused-ignore]
            from IPython.display import display  # type: ignore[import-not-found,unused-ignore]

            if getattr(get_ipython(), "kernel", None) is not None:
                display(self)  # type: ignore[no-untyped-call,unused-ignore]
                return
        except ImportError:
            pass
        import pathlib
        import tempfile
        import webbrowser

        with tempfile.NamedTemporaryFile(prefix="kerrscope-", suffix=".png", delete=False) as file:
            file.write(self._repr_png_())
        webbrowser.open(pathlib.Path(file.name).as_uri())

    def _repr_png_(self) -> bytes:
        return self._inner.png()

    def to_xarray(self) -> xarray.Dataset:
        """All of it as a labelled dataset.

        Variables: `light` (y, x, channel), `radiance` (y, x) if there is one, and the layers, (y, x) or (order, y, x), each with
        `units` and `long_name`. Coordinates `x` to the right and `y` up of the picture's middle, in M at the distance of the hole, and
        `x_uas`, `y_uas` in µas where the scene has a mass and a distance; pixels where the picture has no such size. Attributes:
        what `about` and `provenance` say. `to_netcdf` writes it.

        Raises
        ------
        ImportError
            Without xarray: `pip install xarray`.
        """
        xr = need("xarray", "to_xarray")
        about = self._inner.about()
        height, width, _ = self.shape
        pixel, unit = (about["pixel_m"], "M") if about["pixel_m"] else (1.0, "pixel")
        right, up = np.arange(width) + 0.5 - width / 2, height / 2 - np.arange(height) - 0.5
        length = {"units": unit, "long_name": "to the right of the middle"}
        coordinates: dict[str, Any] = {
            "x": ("x", right * pixel, length),
            "y": ("y", up * pixel, {**length, "long_name": "up from the middle"}),
            "channel": ("channel", ["red", "green", "blue"]),
        }
        if about["pixel_uas"]:
            angle = {"units": "uas", "long_name": "to the right (West) of the middle"}
            coordinates["x_uas"] = ("x", right * about["pixel_uas"], angle)
            coordinates["y_uas"] = ("y", up * about["pixel_uas"], {**angle, "long_name": "up (North) from the middle"})
        words = {"units": "1", "long_name": "linear light, Rec. 709 primaries, white D65 = 1"}
        variables: dict[str, Any] = {"light": (("y", "x", "channel"), self.light, words)}
        found = self._intensity()
        if found is not None:
            unit = {"JY/PIXEL": "Jy/pixel", "": "1"}.get(found[2], found[2])
            variables["radiance"] = (("y", "x"), found[3], {"units": unit, "long_name": found[1]})
        for name, values in self.layers.items():
            dimensions = ("order", "y", "x") if values.ndim == 3 else ("y", "x")
            words = {"units": self._units[name] or "1", "long_name": self._titles[name]}
            variables[name] = (dimensions, values, words)
            if values.ndim == 3:
                coordinates["order"] = ("order", np.arange(len(values)), {"long_name": "image order"})
        attributes = {name: value for name, value in about.items() if value is not None}
        attributes["record"] = self._inner.record
        dataset: xarray.Dataset = xr.Dataset(variables, coordinates, attributes)
        return dataset

    def __repr__(self) -> str:
        height, width, _ = self.shape
        more = "".join(f", {name}" for name in self.layers)
        radiance = "" if self.radiance is None else f", radiance [{self.units['radiance'] or '1'}]"
        return f"<kerrscope.Image {width}x{height}{radiance}{more}>"


def open(path: str | os.PathLike[str]) -> Image:
    """The picture in a FITS or HDF5 file that kerrscope wrote, all of its layers, and its scene.

    Light and layers are what was written; a radiance in Jy is so to rounding. `measure` and `fit` read pictures of anybody's.

    Raises
    ------
    OSError
        If it cannot be read.
    ValueError
        If it is of another format, or another program's.
    """
    return Image._of(_core.Film.open(os.fspath(path)))


def _fixed(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
