"""Values as a scene has them typed."""

import json
import math
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def value(of: Any, name: str) -> str:
    """A value in TOML, on one line."""
    if isinstance(of, (np.generic, np.ndarray)):
        of = of.tolist()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        if math.isnan(of):
            return "nan"
        if math.isinf(of):
            return "inf" if of > 0 else "-inf"
        return repr(of)
    if isinstance(of, (str, os.PathLike)):
        return _text(os.fspath(of))
    if isinstance(of, Mapping):
        pairs = (f"{_key(key)} = {value(item, f'{name}.{key}')}" for key, item in of.items())
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(of, (list, tuple)):
        return "[" + ", ".join(value(item, name) for item in of) + "]"
    raise TypeError(f"{name}: a scene holds numbers, texts, lists and tables, and no {type(of).__name__}")


def _text(text: str | bytes) -> str:
    if isinstance(text, bytes):
        text = os.fsdecode(text)
    # A string of JSON is one of TOML, but for this character.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"keys of a scene are texts, not {key!r}")
    return key if _BARE.match(key) else _text(key)
