"""pfgeom: polygon meshes as the smallest set of functions within a tolerance.

>>> import pfgeom
>>> model = pfgeom.compress(vertices, faces, tolerance=1e-3)   # or any mesh object
>>> model.save("shape.pfg")
>>> vertices, faces = pfgeom.load("shape.pfg").to_mesh()
>>> model.contains([0.0, 0.0, 0.0])

Long calls take ``threads``, ``progress`` and ``cancel``, and release the interpreter's lock. Nothing is printed;
the logger is ``logging.getLogger("pfgeom")``.
"""

import logging

from ._core import __version__
from .depths import DepthBuffers, DepthFigures, DepthView
from .deviation import Deviation, OneSided, VertexDeviations, compare
from .distances import ClosestPoints, closest_points
from .encoder import compress
from .errors import Cancelled, FormatError, LimitError, PfgeomError
from .meshes import Mesh, read_mesh, write_mesh
from .model import FunctionCount, Model, SurfacePoints, from_bytes, load
from .pictures import Picture, RayHits
from .quadrics import nine_points
from .report_page import report
from .tasks import CancelToken, Progress

__all__ = [
    "CancelToken",
    "Cancelled",
    "ClosestPoints",
    "DepthBuffers",
    "DepthFigures",
    "DepthView",
    "Deviation",
    "FormatError",
    "FunctionCount",
    "LimitError",
    "Mesh",
    "Model",
    "OneSided",
    "PfgeomError",
    "Picture",
    "Progress",
    "RayHits",
    "SurfacePoints",
    "VertexDeviations",
    "__version__",
    "closest_points",
    "compare",
    "compress",
    "from_bytes",
    "load",
    "nine_points",
    "read_mesh",
    "report",
    "write_mesh",
]

logging.getLogger(__name__).addHandler(logging.NullHandler())
