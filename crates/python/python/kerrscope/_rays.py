"""Rays around a hole."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_FATES = np.array(["escaped", "captured", "hit", "step-limit"])
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
    given = [np.asarray(values, float) for values in (spin, inclination, distance, alpha, beta)]
    try:
        shape = np.broadcast_shapes(*(values.shape for values in given))
    except ValueError:
        names = ("spin", "inclination", "distance", "alpha", "beta")
        shapes = ", ".join(f"{name} {values.shape}" for name, values in zip(names, given))
        raise ValueError(f"these shapes do not go together: {shapes}") from None
    hole, impact = given[:3], [np.ascontiguousarray(np.broadcast_to(values, shape)).ravel() for values in given[3:]]

    def follow(hole: Iterable[Any], impact: list[np.ndarray]) -> dict[str, Any]:
        a, i, r = (float(value) for value in hole)
        return _core.trace(a, i, r, *impact, engine, orders, wanted, threads)

    if all(values.size == 1 for values in hole):
        found = follow((values.item() for values in hole), impact)
    else:
        found = _by_hole(np.stack([np.broadcast_to(values, shape).ravel() for values in hole], axis=1), impact, follow)
    crossings = found.pop("crossings")
    if "fate" in found:
        found["fate"] = _FATES[found["fate"].astype(np.intp)]
    if "steps" in found:
        found["steps"] = found["steps"].astype(np.int64)
    result: dict[str, Any] = {name: values.reshape(shape) for name, values in found.items()}
    result["crossings"] = {name: values.reshape(*shape, orders) for name, values in crossings.items()}
    return result


def _by_hole(holes: np.ndarray, impact: list[np.ndarray], follow: Any) -> dict[str, Any]:
    """Rays of several holes or observers: those of each together."""
    kinds, which = np.unique(holes, axis=0, return_inverse=True)
    which = which.ravel()
    order = np.argsort(which, kind="stable")
    ends = np.searchsorted(which[order], np.arange(len(kinds) + 1))
    whole: dict[str, Any] = {"crossings": {}}

    def put(into: dict[str, Any], name: str, rays: np.ndarray, values: np.ndarray) -> None:
        if name not in into:
            into[name] = np.empty((len(holes), *values.shape[1:]))
        into[name][rays] = values

    if not len(kinds):
        return follow((0.0, 0.0, np.inf), impact)
    for hole, start, end in zip(kinds, ends, ends[1:]):
        rays = order[start:end]
        found = follow(hole, [values[rays] for values in impact])
        for name, values in found.pop("crossings").items():
            put(whole["crossings"], name, rays, values)
        for name, values in found.items():
            put(whole, name, rays, values)
    return whole
