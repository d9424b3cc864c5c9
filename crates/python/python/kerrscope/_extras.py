"""Packages that are there only if an extra was installed."""

import importlib
from typing import Any


def need(module: str, extra: str, what: str) -> Any:
    """The module, or an `ImportError` that says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{what} needs {module.split('.')[0]}: pip install kerrscope[{extra}]") from error
