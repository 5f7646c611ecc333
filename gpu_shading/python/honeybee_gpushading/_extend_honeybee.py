"""Adds properties.gpu_shading to Honeybee's classes, and its objects to what a model can be written as."""

from __future__ import annotations

import importlib
from typing import Any

from honeybee_gpushading.properties import KEY, ModelGPUShadingProperties, ShadeGPUShadingProperties
from honeybee_gpushading.writer import model_to_gpu_shading


def extend() -> None:
    """Honeybee keeps an extension's properties in an attribute with a leading underscore, which duplicate sets."""
    properties = importlib.import_module("honeybee.properties")
    for owner, kind in (("ModelProperties", ModelGPUShadingProperties), ("ShadeProperties", ShadeGPUShadingProperties),
                        ("ShadeMeshProperties", ShadeGPUShadingProperties)):
        extended = getattr(properties, owner)
        setattr(extended, "_" + KEY, None)
        setattr(extended, KEY, property(_made_on_demand(kind)))
    importlib.import_module("honeybee.writer.model").gpu_shading = model_to_gpu_shading  # type: ignore[attr-defined]


def _made_on_demand(kind: type[Any]) -> Any:
    def get(owner: Any) -> Any:
        if getattr(owner, "_" + KEY) is None:
            setattr(owner, "_" + KEY, kind(owner.host))
        return getattr(owner, "_" + KEY)

    return get
