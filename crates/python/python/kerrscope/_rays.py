"""Rays around a hole."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_FATES = np.array(["escaped", "captured", "hit", "step-limit"])
# Numbers of a ray by what asks for them, and those of each of its crossings.
_OF_RAYS = {
    "fate": ("fate",),
    "steps": ("steps",),
    "error_estimate": ("error_estimate",),
    "lambda": ("lambda",),
    "eta": ("eta",),
    "direction": ("theta", "sky_phi"),
}
_OF_CROSSINGS = ("r", "phi", "t", "g")
_ALL = ("fate", "steps", "error_estimate", "lambda", "eta", "direction", "r", "phi", "t", "g")


def trace(
    *,
    spin: ArrayLike,
    inclination: ArrayLike,
    alpha: ArrayLike,
    beta: ArrayLike,
    distance: ArrayLike = 1000.0,
    engine: str = "closed-form",
    orders: int = 3,
    quantities: Iterable[str] = _ALL,
    threads: int | None = None,
) -> dict[str, Any]:
    """Follows light from an observer back to where it came from, as `kerrscope trace --format json`, many rays at a time.

    The observer is static at Boyer-Lindquist r = `distance`, θ = `inclination`, φ = 0. A ray has impact parameters on Bardeen's screen,
    which fix λ = −α sin i and η = (α² − a²) cos² i + β² exactly (Bardeen 1973).

    Parameters
    ----------
    spin
        a, from −1 to 1.
    inclination
        Degrees from the spin axis, 0 to 180.
    alpha, beta
        Impact parameters in M, to the right and along the projected spin axis; β > 0 looks above the hole.
    distance
        In M; `numpy.inf` for an observer at infinity.
    engine
        "closed-form" (elliptic and Weierstrass functions, on vector instructions) or "integrator" (DOP853 at 1e-12).
    orders
        Crossings of the equatorial plane to give, counted from the camera.
    quantities
        What to compute, of "fate", "steps", "error_estimate", "lambda", "eta", "direction" (`theta` and `phi`), and of crossings "r",
        "phi", "t", "g". Less is faster: t costs more than all others.
    threads
        How many; one for each processor if not given.

    `spin`, `inclination`, `distance`, `alpha` and `beta` are numbers or arrays, broadcast to one shape; all rays of one hole and observer
    are followed together, so that few different ones are fastest.

    Returns
    -------
    dict
        Arrays of the rays' shape: `fate` ("escaped", "captured", "hit", "step-limit"), `steps`, `error_estimate` (radians of
        direction; relative radius where captured), `lambda` (M), `eta` (M²), `theta` and `phi` (radians, where the light came from; NaN
        if it did not escape). And `crossings`, a dict of arrays of that shape × orders, NaN where there is none: `r` (M), `phi`
        (radians, unwrapped, increasing with the true motion), `t` (M, coordinate time to the camera; from infinity regularised by
        r + 2 ln(r/2)), `g` (ν_camera/ν_emitter of matter on a circular orbit about +z; NaN within the last stable one).

    Raises
    ------
    ValueError
        If something is out of range or no number, or a photon does not get to the observer: the first such ray is named.

    Examples
    --------
    >>> found = kerrscope.trace(spin=0.9, inclination=60, alpha=[-11.35, 0], beta=[2, 0])
    >>> found["fate"].tolist()
    ['escaped', 'captured']
    """
    wanted = [quantities] if isinstance(quantities, str) else list(quantities)
    unknown = [name for name in wanted if name not in _ALL]
    if unknown:
        raise ValueError(f"no quantity is called {unknown[0]!r}: there are {', '.join(_ALL)}")
    if orders < 0:
        raise ValueError(f"orders is {orders}: give 0 or more")
    names = ("spin", "inclination", "distance", "alpha", "beta")
    given = [np.asarray(values, float) for values in (spin, inclination, distance, alpha, beta)]
    try:
        shape = np.broadcast_shapes(*(values.shape for values in given))
    except ValueError:
        shapes = ", ".join(f"{name} {values.shape}" for name, values in zip(names, given))
        raise ValueError(f"these shapes do not go together: {shapes}") from None
    hole, impact = given[:3], [np.ascontiguousarray(np.broadcast_to(values, shape)).ravel() for values in given[3:]]
    of_rays = [name for asked, several in _OF_RAYS.items() if asked in wanted for name in several]
    of_crossings = [name for name in _OF_CROSSINGS if name in wanted]

    def follow(hole: Iterable[float], impact: list[NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
        a, i, r = hole
        count = len(impact[0])
        # numpy's memory is in large pages, which cost a tenth of small ones.
        found = {name: np.empty(count) for name in of_rays}
        found.update((name, np.empty((count, orders))) for name in of_crossings)
        _core.trace(a, i, r, impact[0], impact[1], engine, orders, list(found), list(found.values()), threads)
        return found

    if all(values.size == 1 for values in hole):
        found = follow((values.item() for values in hole), impact)
    else:
        holes = np.stack([np.broadcast_to(values, shape).ravel() for values in hole], axis=1)
        found = _by_hole(holes, impact, follow)
    result: dict[str, Any] = {name: found[name].reshape(shape) for name in of_rays}
    if "fate" in result:
        result["fate"] = _FATES[result["fate"].astype(np.intp)]
    if "steps" in result:
        result["steps"] = result["steps"].astype(np.int64)
    if "sky_phi" in result:
        result["phi"] = result.pop("sky_phi")
    result["crossings"] = {name: found[name].reshape(*shape, orders) for name in of_crossings}
    return result


def _by_hole(
    holes: NDArray[np.float64],
    impact: list[NDArray[np.float64]],
    follow: Callable[[Iterable[float], list[NDArray[np.float64]]], dict[str, NDArray[np.float64]]],
) -> dict[str, NDArray[np.float64]]:
    """Rays of several holes or observers: those of each together."""
    kinds, which = np.unique(holes, axis=0, return_inverse=True)
    which = which.ravel()
    order = np.argsort(which, kind="stable")
    ends = np.searchsorted(which[order], np.arange(len(kinds) + 1))
    if not len(kinds):
        return follow((0.0, 0.0, np.inf), impact)
    whole: dict[str, NDArray[np.float64]] = {}
    for hole, start, end in zip(kinds, ends, ends[1:]):
        rays = order[start:end]
        for name, values in follow((float(value) for value in hole), [values[rays] for values in impact]).items():
            if name not in whole:
                whole[name] = np.empty((len(holes), *values.shape[1:]))
            whole[name][rays] = values
    return whole
