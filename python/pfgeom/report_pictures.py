"""Pictures for the report: a mesh and a model seen from the same place, and the deviation as colours."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .meshes import Mesh
from .model import Model
from .pictures import Picture, slope_of_view
from .tasks import CancelToken

WIDTH, HEIGHT = 720, 540
_SAMPLES = 2  # squared, a pixel
_FIELD_OF_VIEW = 28.0

#: Below, at and above the surface, at the ends of the scale; linear in between. Told apart by colour-blind people too.
INSIDE, BETWEEN, OUTSIDE = (33, 102, 172), (238, 236, 230), (178, 24, 43)


class View(NamedTuple):
    """One side that a shape is looked at from."""

    name: str
    direction: tuple[float, float, float]


VIEWS = (View("from the front", (-1.0, -1.4, -0.8)), View("from the back", (1.0, 1.4, 0.8)))


class Drawing(NamedTuple):
    """A picture, and where in space its pixels are."""

    picture: Picture
    points: NDArray[np.float64]  # (height, width, 3); not finite where there is nothing


def draw(shape: Mesh | Model, fitted: Mesh, view: View, threads: int, cancel: CancelToken | None) -> Drawing:
    """A drawing of the shape by a camera that sees the mesh `fitted` as large as possible."""
    core = shape._core if isinstance(shape, Model) else shape
    slope = slope_of_view(_FIELD_OF_VIEW)
    drawn = _core.render(
        core, fitted, WIDTH, HEIGHT, _SAMPLES, view.direction, (0.0, 0.0, 1.0), slope, 0.04, threads, None, cancel
    )
    picture = Picture(*drawn[:5])
    eye, forward, right, up = drawn[5][0]
    x = (2 * np.arange(WIDTH) + 1) / WIDTH - 1
    y = 1 - (2 * np.arange(HEIGHT) + 1) / HEIGHT
    sideways = x[None, :, None] * right + y[:, None, None] * up
    depth = np.where(picture.objects >= 0, picture.depth, np.nan)
    return Drawing(picture, eye + depth[..., None] * (forward + sideways))


def heat_map(
    drawing: Drawing, other: Mesh, scale: float, threads: int, cancel: CancelToken | None
) -> NDArray[np.uint8]:
    """The drawing's colours by how far each of its points is from `other`: at `scale` they are full."""
    points = drawing.points.reshape(-1, 3)
    closest, _, distances = _core.closest_points(points, *other, threads, None, cancel)
    outwards = drawing.picture.normals.reshape(-1, 3)
    side = np.sign(np.einsum("ij,ij->i", closest - points, outwards))
    share = np.nan_to_num(side * distances / scale).clip(-1, 1).reshape(HEIGHT, WIDTH, 1)
    light = drawing.picture.colours[..., :3].mean(axis=-1, keepdims=True) / 255
    picture = drawing.picture.colours.copy()
    picture[..., :3] = np.round(np.clip(colours_of(share[..., 0]) * (0.35 + 0.75 * light), 0, 255))
    return picture


def colours_of(share: NDArray[np.float64]) -> NDArray[np.float64]:
    """(..., 3) red, green and blue of shares from -1 (inside) to 1 (outside)."""
    middle = np.array(BETWEEN, dtype=np.float64)
    end = np.where(share[..., None] < 0, np.array(INSIDE), np.array(OUTSIDE))
    return middle + np.abs(share[..., None]) * (end - middle)
