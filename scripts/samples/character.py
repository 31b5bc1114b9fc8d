"""One sample character before it is written: what the Blender side needs to know."""
from dataclasses import dataclass, field
from typing import Callable

from .mesh import Mesh
from .rig import Skeleton


@dataclass
class Character:
    name: str
    mesh: Mesh                 # final, weighted
    skeleton: Skeleton
    clips: list
    paint: Callable            # paints a paint.Texels in place
    chart_scale: dict = field(default_factory=dict)  # texels a metre relative to the rest, by chart name
    roughness: float = 0.85
