"""Pictures with matplotlib: `pip install matplotlib`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._extras import need
from ._fit import Fit
from ._image import Image

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["corner", "critical_curve", "image"]

_LABELS = {"uas": "µas", "M": "M", "pixel": "pixels"}


def _pyplot() -> Any:
    return need("matplotlib.pyplot", "plotting")


def _pixel(about: dict[str, Any], unit: str | None) -> tuple[float, str]:
    """The side of a pixel, and its unit."""
    sizes = {"uas": about["pixel_uas"], "M": about["pixel_m"], "pixel": 1.0}
    if unit is None:
        unit = next(name for name, size in sizes.items() if size)
    if unit not in sizes:
        raise ValueError(f"unit {unit!r}: give uas, M or pixel")
    size = sizes[unit]
    if not size:
        mend = "give the scene units.mass and units.distance" if unit == "uas" else "use pixel"
        raise ValueError(f"a pixel of this image has no size in {unit}: {mend}")
    return size, unit


def image(
    of: Image,
    *,
    ax: Axes | None = None,
    unit: str | None = None,
    scale_bar: bool = True,
    layer: str | None = None,
    order: int = 0,
    **more: Any,
) -> Axes:
    """Draws an image with axes in µas, M or pixels from its middle.

    Parameters
    ----------
    of
        The image.
    ax
        Where to; a new figure's if not given.
    unit
        "uas", "M" or "pixel"; the first of these that is known if not given.
    scale_bar
        Whether to draw a bar of a round length.
    layer, order
        A data layer by its name, and its image order, or "radiance"; without it, the light as a screen shows it.
    **more
        For `imshow`, as `cmap`.

    Raises
    ------
    ValueError
        If the image has no such layer, or its pixels no size in that unit.
    """
    if ax is None:
        ax = _pyplot().subplots()[1]
    size, unit = _pixel(of.about, unit)
    height, width, _ = of.shape
    extent = (-0.5 * width * size, 0.5 * width * size, -0.5 * height * size, 0.5 * height * size)
    if layer is None:
        values: Any = _shown(of)
    elif layer == "radiance" and of.radiance is not None:
        values = of.radiance
    elif layer in of.layers:
        values = of.layers[layer]
        values = values[order] if values.ndim == 3 else values
    else:
        known = ", ".join([*(["radiance"] if of.radiance is not None else []), *of.layers]) or "none: set render.layers"
        raise ValueError(f"the image has no layer {layer!r}: there are {known}")
    drawn = ax.imshow(values, extent=extent, **more)
    if layer is not None:
        word = of.units[layer]
        ax.figure.colorbar(drawn, ax=ax, label=f"{layer} [{word}]" if word else layer)
    ax.set_xlabel(f"right [{_LABELS[unit]}]")
    ax.set_ylabel(f"up [{_LABELS[unit]}]")
    if scale_bar:
        _bar(ax, extent, unit)
    return ax


def _shown(of: Image) -> NDArray[np.float64]:
    """Light through the scene's exposure and tone curve: the pixels of its PNG."""
    import io

    shown: NDArray[np.float64] = _pyplot().imread(io.BytesIO(of._repr_png_()))
    return shown


def _bar(ax: Axes, extent: tuple[float, float, float, float], unit: str) -> None:
    left, right, bottom, top = extent
    most = 0.25 * (right - left)
    power = 10.0 ** np.floor(np.log10(most))
    length = power * max(step for step in (1, 2, 5) if step * power <= most)
    x, y = left + 0.05 * (right - left), bottom + 0.07 * (top - bottom)
    ax.plot([x, x + length], [y, y], color="white", linewidth=2, solid_capstyle="butt")
    label = f"{length:g} {_LABELS[unit]}"
    ax.text(x + 0.5 * length, y + 0.02 * (top - bottom), label, color="white", ha="center", va="bottom")


def critical_curve(
    ax: Axes,
    of: Image | None = None,
    *,
    spin: float | None = None,
    inclination: float | None = None,
    unit: str | None = None,
    scale: float | None = None,
    points: int = 720,
    **more: Any,
) -> Any:
    """Draws the critical curve, the edge of the shadow for a distant observer, over a picture.

    Spin and inclination (degrees), and the size of M in `unit`, are those of the image `of`, where they are not given; without an image give
    `spin`, `inclination`, and `scale`, the length of M on the axes (1 if not given). The scene's roll is taken into account. `more` is for
    `plot`.

    Raises
    ------
    ValueError
        If spin or inclination are not known.
    """
    roll = 0.0
    if of is not None:
        scene = of.scene.to_dict()
        spin = scene["spacetime"].get("spin") if spin is None else spin
        inclination = scene["observer"].get("inclination") if inclination is None else inclination
        roll = np.radians(scene["screen"].get("roll", 0.0))
        if scale is None:
            size, _ = _pixel(of.about, unit)
            if not of.about["pixel_m"]:
                raise ValueError("a pixel of this image has no size in M: give scale")
            scale = size / of.about["pixel_m"]
    if spin is None or inclination is None:
        raise ValueError("the critical curve needs spin and inclination")
    curve = _core.critical_points(float(spin), float(inclination), points) * (1.0 if scale is None else scale)
    # The screen's right axis lies along (α, β) = (cos roll, sin roll).
    turn = np.array([[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]])
    x, y = (np.vstack([curve, curve[:1]]) @ turn).T
    return ax.plot(x, y, **{"color": "tab:pink", "linewidth": 1, **more})[0]


def corner(fit: Fit, names: list[str] | None = None, *, bins: int = 30, **more: Any) -> Figure:
    """Draws the posterior of each free parameter, or of those in `names`, and of each two.

    Contours hold 39 % and 86 % of the draws, those of a Gaussian within one and two standard deviations. `more` is for `subplots`.
    """
    chain = fit.chain
    names = list(chain) if names is None else names
    unknown = [name for name in names if name not in chain]
    if unknown:
        raise ValueError(f"{', '.join(unknown)}: free parameters are {', '.join(chain)}")
    count = len(names)
    figure: Figure
    figure, axes = _pyplot().subplots(count, count, squeeze=False, **{"figsize": (2 * count, 2 * count), **more})
    draws = {name: _unwrapped(name, chain[name].ravel()) for name in names}
    for row, below in enumerate(names):
        for column, beside in enumerate(names):
            ax = axes[row][column]
            if column > row:
                ax.axis("off")
                continue
            if column == row:
                ax.hist(draws[beside], bins=bins, histtype="stepfilled", color="#7f9fca")
                ax.set_yticks([])
                ax.set_title(f"{fit[beside]['mean']:.4g} ± {fit[beside]['sd']:.2g}", fontsize=8)
            else:
                _pair(ax, draws[beside], draws[below], bins)
            unit = fit[beside]["unit"]
            ax.set_xlabel(f"{beside} [{unit}]" if unit else beside) if row == count - 1 else ax.set_xticklabels([])
            if column == 0 and row > 0:
                unit = fit[below]["unit"]
                ax.set_ylabel(f"{below} [{unit}]" if unit else below)
            elif column > 0:
                ax.set_yticklabels([])
    return figure


def _unwrapped(name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles around their mean direction."""
    if name != "position_angle":
        return values
    middle = np.degrees(np.angle(np.exp(1j * np.radians(values)).mean()))
    unwrapped: NDArray[np.float64] = middle + (values - middle + 180.0) % 360.0 - 180.0
    return unwrapped


def _pair(ax: Axes, x: NDArray[np.float64], y: NDArray[np.float64], bins: int) -> None:
    counts, right, up = np.histogram2d(x, y, bins=bins)
    if np.ptp(x) == 0 or np.ptp(y) == 0:
        ax.plot(x, y, ".", markersize=1)
        return
    falling = np.sort(counts.ravel())[::-1]
    share = np.cumsum(falling) / falling.sum()
    levels = sorted({float(falling[np.searchsorted(share, part)]) for part in (0.8647, 0.3935)})
    ax.contour(0.5 * (right[1:] + right[:-1]), 0.5 * (up[1:] + up[:-1]), counts.T, levels=levels, colors="#205090")
    ax.plot(x[:: max(1, len(x) // 500)], y[:: max(1, len(y) // 500)], ".", markersize=1, color="#7f9fca", zorder=0)
