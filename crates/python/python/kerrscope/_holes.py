"""Numbers of a hole."""

from __future__ import annotations

from typing import Any

from . import _core


def orbits(spin: float) -> dict[str, float]:
    """Radii at which circular orbits in the equatorial plane change their nature, in M, as `kerrscope orbits --format json`.

    `horizon` r₊; `isco` and `photon_prograde` for orbits about +z, `isco_retrograde` and `photon_retrograde` for those about −z (a
    negative spin exchanges their parts); `impact_prograde`, `impact_retrograde` the photons' impact parameters; `efficiency` 1 − E of
    the last stable orbit about +z. Bardeen, Press & Teukolsky 1972, ApJ 178, 347, eqs 2.18 and 2.21.

    Raises
    ------
    ValueError
        If the spin is not within −1 to 1.

    Examples
    --------
    >>> round(kerrscope.orbits(0.9)["isco"], 6)
    2.320883
    """
    return _core.orbits(spin)


def shadow(spin: float, inclination: float, points: int = 360) -> dict[str, Any]:
    """The critical curve on a distant observer's sky, as `kerrscope shadow --format json`.

    On Bardeen's screen, in M: α to the right, β along the projected spin axis; `inclination` in degrees from 0 to 180.
    `alpha_min`, `alpha_max`, `beta_max`, the enclosed `area` in M² (to 1e-10 of each), and `curve`, an array of points × 2 (α, β) from
    the smallest α over β > 0. Bardeen 1973; Teo 2003, Gen. Relativ. Gravit. 35, 1909.

    Raises
    ------
    ValueError
        If spin or inclination are out of range.
    """
    return _core.shadow(spin, inclination, points)
