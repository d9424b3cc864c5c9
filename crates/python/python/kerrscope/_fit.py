"""Holes read off pictures."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from . import _core
from ._extras import need
from ._measure import picture

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._measure import Pictured


class Fit:
    """What a picture says of a hole and its disk: the posterior of a model's parameters. `fit` gives one."""

    __slots__ = ("_inner", "report", "_chain", "_images")

    report: dict[str, Any]
    """All of `kerrscope fit --format json`."""

    _inner: _core.Fit
    _chain: dict[str, NDArray[np.float64]] | None
    _images: list[NDArray[np.float64]] | None

    def __init__(self) -> None:
        raise TypeError("fits come from kerrscope.fit")

    @classmethod
    def _of(cls, core: _core.Fit) -> Fit:
        fit = cls.__new__(cls)
        fit._inner = core
        fit.report = json.loads(core.report)
        fit._chain = None
        fit._images = None
        return fit

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """For each parameter, by its name: `unit`, `mode`, `mean`, `sd`, `q025`, `q16`, `q50`, `q84`, `q975`, `free`, and of what is free
        `r_hat` and `effective`, the number of draws that chains are worth (Vehtari et al. 2021, Bayesian Analysis 16, 667)."""
        return {estimate["name"]: estimate for estimate in self.report["parameters"]}

    def __getitem__(self, name: str) -> dict[str, Any]:
        """What is known of one parameter."""
        return self.parameters[name]

    @property
    def chain(self) -> dict[str, NDArray[np.float64]]:
        """Draws of each free parameter, chains × draws."""
        if self._chain is None:
            draws = self._inner.draws()
            self._chain = {name: draws[:, :, k] for k, (name, _) in enumerate(self._inner.free)}
        return self._chain

    @property
    def log_density(self) -> NDArray[np.float64]:
        """Logarithm of the posterior's density of each draw, chains × draws."""
        return self._inner.logs()

    def _image(self, number: int) -> NDArray[np.float64]:
        if self._images is None:
            self._images = self._inner.images()
        return self._images[number]

    @property
    def data(self) -> NDArray[np.float64]:
        """What was fitted, height × width: the picture, or of a silhouette the share of each pixel that is lit."""
        return self._image(0)

    @property
    def best(self) -> NDArray[np.float64]:
        """The picture where the posterior is highest, height × width."""
        return self._image(1)

    @property
    def errors(self) -> NDArray[np.float64]:
        """Standard deviation of each pixel's error, height × width."""
        return self._image(2)

    @property
    def residual(self) -> NDArray[np.float64]:
        """(data − best)/errors, height × width."""
        return self._image(3)

    @property
    def converged(self) -> bool:
        """Whether chains became one and are worth enough draws."""
        converged: bool = self.report["converged"]
        return converged

    @property
    def good(self) -> bool:
        """Whether the model describes the picture."""
        good: bool = self.report["good"]
        return good

    @property
    def warnings(self) -> list[str]:
        """What is to be minded, in plain words."""
        warnings: list[str] = self.report["warnings"]
        return warnings

    def table(self) -> list[dict[str, Any]]:
        """The free parameters and what follows from them, a dict for each, as `pandas.DataFrame` takes them."""
        return [estimate for estimate in self.report["parameters"] if estimate["free"]]

    def corner_svg(self) -> str:
        """The corner plot as SVG. `kerrscope.plot.corner` draws one with matplotlib."""
        return self._inner.corner()

    def save_chains(self, path: str | os.PathLike[str]) -> None:
        """Writes the chains as HDF5, laid out as ArviZ lays out inference data; `OSError` if it cannot."""
        self._inner.write_chains(os.fspath(path))

    def to_inferencedata(self) -> Any:
        """The chains as ArviZ takes them: groups `posterior` and `sample_stats` (`lp`).

        An `InferenceData`, or with ArviZ 1 a `DataTree`. `ImportError` without ArviZ: `pip install arviz`.
        """
        arviz = need("arviz", "to_inferencedata")
        groups = {"posterior": self.chain, "sample_stats": {"lp": self.log_density}}
        if hasattr(arviz, "InferenceData"):
            found = arviz.from_dict(**groups)
        else:
            found = arviz.from_dict(groups)
        for name, unit in self._inner.free:
            found["posterior"][name].attrs["units"] = unit or "1"
        return found

    def __repr__(self) -> str:
        lines = [f"<kerrscope.Fit {self.report['model']}{'' if self.converged else ', not converged'}"]
        lines += [f"  {e['name']} = {e['mean']:.6g} ± {e['sd']:.2g} {e['unit']}".rstrip() for e in self.table()]
        lines += [f"  warning: {warning}" for warning in self.warnings]
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        columns = ("mode", "mean", "sd", "q025", "q50", "q975", "r_hat", "effective")

        def cell(number: float | None) -> str:
            return f"<td>{'' if number is None else format(number, '.6g')}</td>"

        head = "".join(f"<th>{name}</th>" for name in ("parameter", *columns, "unit"))
        rows = "".join(
            f"<tr><td>{html.escape(e['name'])}</td>{''.join(cell(e[c]) for c in columns)}<td>{html.escape(e['unit'])}</td></tr>"
            for e in self.table()
        )
        warnings = "".join(f"<p>warning: {html.escape(text)}</p>" for text in self.warnings)
        return f"<table><tr>{head}</tr>{rows}</table>{warnings}"


def fit(
    image: Pictured,
    model: str = "page-thorne",
    *,
    distance: float | None = None,
    fix: Mapping[str, float] | None = None,
    prior: Mapping[str, str] | None = None,
    free: Iterable[str] = (),
    noise: float | None = None,
    projection: str = "angular",
    orders: int | None = None,
    spacetime: str | None = None,
    null: Mapping[str, float] | None = None,
    seed: int = 1,
    rounds: int = 30,
    pixel_uas: float | None = None,
    threads: int | None = None,
    progress: Callable[[str], object] | None = None,
) -> Fit:
    """Finds spin, inclination and all else of a hole and its disk at once, with errors, as `kerrscope fit`.

    Parameters
    ----------
    image
        An `Image`, a path of a picture of anybody's, or an array in linear light, height × width (× 3).
    model
        "page-thorne", "power-law", "thin-power-law", "ring" or "silhouette"; see `kerrscope.model`.
    distance
        r of the observer in M, or `math.inf`, where it is known; otherwise it is looked for.
    fix
        Parameters that are known.
    prior
        What is assumed of others: "uniform(0, 1)", "log-uniform(…)", "normal(mean, deviation)" or "isotropic(0, 90)".
    free
        Parameters that are not known, though they usually are: "blur", "background".
    noise
        Standard deviation of each pixel's noise, in the picture's unit; found from the picture if not given.
    projection
        How directions became places: "angular", or "pinhole" for pictures of a camera.
    orders
        Image orders that a silhouette shows.
    spacetime, null
        A metric as text that the disk is in, by name or path, and the values of its parameters with which it is Kerr's (0 if not given);
        `report["tests"]` says what speaks for them.
    seed, rounds
        Of the random numbers; and rounds of 50 draws of each of four chains at most.
    pixel_uas
        The side of a pixel of an array on the sky, µas.
    threads, progress
        How many threads; and what is called with a text that says what is being done.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        With all that is wrong with what is asked, or if there is nothing to fit. A poor fit is a warning.
    KeyboardInterrupt
        At Ctrl-C.
    """
    settings = [] if distance is None else [("distance", repr(float(distance)))]
    settings += [(name, "free") for name in ([free] if isinstance(free, str) else free)]
    settings += [(name, repr(float(value))) for name, value in (fix or {}).items()]
    settings += list((prior or {}).items())
    nulls = [f"{name}={float(value)!r}" for name, value in (null or {}).items()]
    seen = picture(image, pixel_uas, None)
    return Fit._of(
        _core.fit(
            seen, model, projection, orders, settings, spacetime, nulls, noise, seed, rounds, threads, progress
        )
    )
