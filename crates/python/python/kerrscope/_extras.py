"""Packages that are there only if an extra was installed."""

import importlib
from typing import Any


def need(module: str, what: str) -> Any:
    """The module, or an `ImportError` that says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        raise ImportError(f"{what} needs {package}: pip install {package}") from error
