"""Values of a scenario by key, such as {"planner.search.samples_xy": 5}; docs/reference/keys.md lists the keys."""
from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy

Settings = Mapping[str, Any]


def setting_texts(settings: Settings) -> list[str]:
    """Settings as --set takes them: {"planner.search.samples_xy": 5} becomes ["planner.search.samples_xy=5"]."""
    return [f"{key}={_yaml(value)}" for key, value in settings.items()]


def _yaml(value: Any) -> str:
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {_yaml(part)}" for key, part in value.items()) + "}"
    if isinstance(value, (Sequence, numpy.ndarray)) and not isinstance(value, bytes):
        return "[" + ", ".join(_yaml(part) for part in value) + "]"
    if isinstance(value, (int, float, numpy.number)):
        return repr(value.item() if isinstance(value, numpy.number) else value)
    raise TypeError(f"a setting is a number, a flag, a text, a list or a mapping, not {type(value).__name__}")
