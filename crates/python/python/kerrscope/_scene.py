"""Scenes."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from . import _core, _toml

if TYPE_CHECKING:
    from ._image import Image

# A scene left as the last line of a cell is drawn no larger than this, and with no more samples a pixel.
_PREVIEW_PIXELS = 480 * 270
_PREVIEW_SAMPLES = 4


class Scene:
    """What is drawn: a spacetime, an observer, a disk, a sky, things, and how finely.

    A scene never changes: `replace` gives another. It is valid if it exists. Scenes are equal if they show the same, can be
    pickled (their text is), and show themselves in notebooks.

    Parameters
    ----------
    text
        The scene in TOML, as the program's `kerrscope schema` describes it; what is not given has its default, and nothing is the
        built-in scene. `Scene().to_toml()` shows the keys with their defaults, and a value that is none of a key's says which there are.
    folder
        Where paths in it begin; the current folder if not given.

    Raises
    ------
    ValueError
        With everything that is wrong: where, what, and how to mend it.
    """

    __slots__ = ("_inner",)

    _inner: _core.Scene

    def __init__(self, text: str = "", folder: str | os.PathLike[str] = "") -> None:
        self._inner = _core.Scene(text, os.fspath(folder))

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._inner = core
        return scene

    @classmethod
    def from_toml(cls, text: str, folder: str | os.PathLike[str] = "") -> Scene:
        """The scene of a text in TOML; the same as `Scene(text, folder)`."""
        return cls(text, folder)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene in a scene file, or in a picture (PNG, EXR, FITS, HDF5) that was made of one.

        Raises
        ------
        OSError
            If the file cannot be read: `FileNotFoundError`, `PermissionError`, …
        ValueError
            If it holds no scene, or a wrong one.
        """
        return cls._of(_core.Scene.open(os.fspath(path)))

    def replace(self, **changes: Any) -> Scene:
        """The same scene with other values of some keys.

        Keys are named with dots, `**{"render.width": 400}`, or by their last name where only one has it: `spin=0.5`,
        `inclination=60`. Several keys are called `distance`: write `**{"observer.distance": 100}`. Values are numbers, texts,
        lists, paths, arrays, or dicts for whole tables; None takes a key away, so that its default counts.

        Raises
        ------
        TypeError
            If there is no such key, or a value of a kind that no scene holds.
        ValueError
            If a name may be several keys, which are listed; or with everything that is wrong with the new scene.

        Examples
        --------
        >>> from kerrscope import Scene
        >>> Scene().replace(spin=0.5, **{"render.width": 320})["spacetime.spin"]
        0.5
        """
        typed = [(name, None if of is None else _toml.value(of, name)) for name, of in changes.items()]
        return type(self)._of(self._inner.changed(typed))

    def to_toml(self) -> str:
        """The whole scene in TOML, every default written out."""
        return self._inner.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """The whole scene as nested dicts; infinite numbers are the text "inf"."""
        scene: dict[str, Any] = json.loads(self._inner.to_json())
        return scene

    def __getitem__(self, name: str) -> Any:
        """The value of a key, by a name as in `replace`; `KeyError` where the scene has none."""
        path = self._inner.key(name)
        found: Any = self.to_dict()
        for part in path.split("."):
            if not isinstance(found, dict) or part not in found:
                raise KeyError(f"this scene has no `{path}`")
            found = found[part]
        return found

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of its picture in pixels."""
        width, height = self._inner.size
        return width, height

    def render(
        self,
        threads: int | None = None,
        progress: Callable[[int, int], object] | None = None,
        level: str | None = None,
    ) -> Image:
        """Draws the scene.

        Parameters
        ----------
        threads
            How many; one for each processor if not given. The picture does not depend on it.
        progress
            Called with the rays that are done and all rays, every twentieth of a second, in this thread. What it raises
            stops the render.
        level
            Vector instructions: "baseline", "avx2" or "avx512"; the best that there are if not given. Levels differ by rounding.

        Returns
        -------
        Image
            The picture; numpy takes it as height × width × 3, linear light.

        Raises
        ------
        KeyboardInterrupt
            At Ctrl-C, within a tenth of a second or the time of one tile.
        OSError, ValueError
            If a picture that the scene shows cannot be read.
        """
        from ._image import Image

        return Image._of(self._inner.render(threads, progress, level))

    def preview(self) -> Image:
        """A picture as notebooks show it: of 130,000 pixels at most, 4 samples each, without data layers."""
        width, height = self.size
        shrink = min(1.0, (_PREVIEW_PIXELS / (width * height)) ** 0.5)
        sizes = {
            "render.width": max(1, int(width * shrink)),
            "render.height": max(1, int(height * shrink)),
            "render.samples": min(_PREVIEW_SAMPLES, self._inner.samples),
            "render.layers": None,
        }
        return self.replace(**sizes).render()

    def _repr_png_(self) -> bytes:
        return self.preview()._repr_png_()

    def __eq__(self, other: object) -> bool:
        return self._inner.same(other._inner) if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), *self._inner.state())

    def __repr__(self) -> str:
        scene = self.to_dict()
        spacetime, observer = scene["spacetime"], scene["observer"]
        words = [spacetime["name"]]
        if "spin" in spacetime:
            words.append(f"spin={spacetime['spin']}")
        if "distance" in observer:
            words.append(f"distance={observer['distance']}, inclination={observer['inclination']}")
        else:
            words.append(f"position={observer['position']}")
        words.append(f"disk={scene['disk']['model']}")
        width, height = self.size
        return f"<kerrscope.Scene {', '.join(words)}, {width}x{height}>"


def _again(kind: type[Scene], text: str, folder: str, name: str, changes: list[str]) -> Scene:
    """A scene as it was pickled."""
    return kind._of(_core.Scene(text, folder, name, changes))
