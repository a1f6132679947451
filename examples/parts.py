"""Twenty machined parts as exact tessellations, and how many functions each is made of.

Plates with holes, shells, fillets of cylinders and spheres, conical chamfers, tubes, gears with flat teeth, blind
pockets. Every vertex lies on the quadrics of its faces to rounding, the meshes are watertight, and every triangle
knows its quadric: so the fewest functions are known beforehand, and can be compared with what is found.
parts_sweep.py does that.
"""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
import pfgeom
from numpy.typing import NDArray
from polygons import triangulate

Array = NDArray[np.float64]
Point = tuple[float, float]

WELD = 1e-7  # of a part's units, millimetres: points closer than that are one


class Part(NamedTuple):
    """A closed mesh, outward-oriented, and the quadric of each face."""

    mesh: pfgeom.Mesh
    quadrics: Array  # (m, 10), in pfgeom's order, unit vectors; plus means outside
    quadric: NDArray[np.int64]  # of each face, a row of quadrics

    @property
    def functions(self) -> int:
        """Distinct quadrics. Parallel planes count as two, pieces of one cylinder as one."""
        return len(self.quadrics)

    @property
    def curved(self) -> int:
        """Those that are no planes, which a pair of parallel ones or a box could stand for."""
        return int((np.abs(self.quadrics[:, :6]) > 1e-9).any(axis=1).sum())

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.mesh.vertices, axis=0)))

    def distance(self, barycentric: Sequence[float]) -> Array:
        """Of a point of each face from its quadric, to first order."""
        corners = self.mesh.vertices[self.mesh.faces]
        points = np.einsum("mij,i->mj", corners, np.array(barycentric, dtype=float))
        q = self.quadrics[self.quadric]
        slope = np.linalg.norm(gradient(q, points), axis=1)
        return np.asarray(np.abs(value(q, points)) / np.maximum(slope, 1e-9))  # none at the tip of a cone


def value(q: Array, p: Array) -> Array:
    x, y, z = p.T
    terms = np.stack([x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, np.ones_like(x)], axis=1)
    return np.asarray(np.sum(q * terms, axis=1))


def gradient(q: Array, p: Array) -> Array:
    (x, y, z), (a, b, c, d, e, f, g, h, i, _) = p.T, q.T
    along_x, along_y, along_z = 2 * a * x + d * y + e * z, 2 * b * y + d * x + f * z, 2 * c * z + e * x + f * y
    return np.stack([along_x + g, along_y + h, along_z + i], axis=1)


def plane(normal: Sequence[float], through: Sequence[float]) -> Array:
    return np.array([0, 0, 0, 0, 0, 0, *normal, -np.dot(normal, through)], dtype=float)


def revolution(at: Point, square: float, linear: float, constant: float) -> Array:
    """(x - a)² + (y - b)² - (square z² + linear z + constant)."""
    a, b = at
    return np.array([1, 1, -square, 0, 0, 0, -2 * a, -2 * b, -linear, a * a + b * b - constant], dtype=float)


class Line(NamedTuple):
    """A piece of a loop or a profile, to this point from where the one before ends. A wall that is left out is made by
    other means."""

    to: Point
    wall: bool = True


class Arc(NamedTuple):
    """… around this centre. Left: counter-clockwise."""

    to: Point
    centre: Point
    left: bool = True


Piece = Line | Arc
Loop = tuple[Point, list[Piece]]  # where it starts, and its pieces


class Builder:
    """Collects patches in frames; welds them. The chord is what faces may miss their quadrics by. Straight directions
    of curved pieces are cut into cells `aspect` times as long as those across, unless it is infinite."""

    def __init__(self, chord: float, aspect: float = np.inf) -> None:
        self.chord, self.aspect = chord, aspect
        self.turn, self.origin = np.eye(3), np.zeros(3)
        self._points: list[Array] = []
        self._faces: list[NDArray[np.int64]] = []
        self._quadrics: list[Array] = []

    def frame(self, turn: Array | None = None, origin: Sequence[float] = (0, 0, 0)) -> None:
        """Where the patches from now on stand: turned, then moved."""
        self.turn, self.origin = np.eye(3) if turn is None else turn, np.array(origin, dtype=float)

    def add(self, points: Array, faces: NDArray[np.int64], quadric: Array, outside: bool = True) -> None:
        """Faces turn to where the quadric is positive, or negative."""
        corners = points[faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        towards = np.sum(normal * gradient(np.broadcast_to(quadric, (len(faces), 10)), corners.mean(axis=1)), axis=1)
        wrong = (towards > 0) != outside
        faces = np.where(wrong[:, None], faces[:, ::-1], faces)
        self._points.append(points @ self.turn.T + self.origin)
        self._faces.append(faces)
        self._quadrics.append(self._moved(quadric))

    def grid(self, points: Array, quadric: Array, outside: bool = True) -> None:
        """(rows, columns, 3) points."""
        rows, columns = points.shape[:2]
        a = np.arange(rows * columns).reshape(rows, columns)
        p, q, r, s = a[:-1, :-1], a[1:, :-1], a[1:, 1:], a[:-1, 1:]
        faces = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((p, q, r), (p, r, s))])
        self.add(points.reshape(-1, 3), faces, quadric, outside)

    def _moved(self, quadric: Array) -> Array:
        """Into the part's frame; unit length, with a sign that does not depend on the material's side."""
        a, b, c, d, e, f, g, h, i, k = quadric
        m = np.array([[a, d / 2, e / 2], [d / 2, b, f / 2], [e / 2, f / 2, c]])
        m = self.turn @ m @ self.turn.T
        n = self.turn @ np.array([g, h, i])
        linear = n - 2 * m @ self.origin
        constant = k - n @ self.origin + self.origin @ m @ self.origin
        q = np.array([*m.diagonal(), 2 * m[0, 1], 2 * m[0, 2], 2 * m[1, 2], *linear, constant])
        q /= np.linalg.norm(q)
        first = q[np.argmax(np.abs(q) > 1e-9)]
        return q if first > 0 else -q

    def build(self) -> Part:
        first = np.cumsum([0, *map(len, self._points)])
        points = np.concatenate(self._points)
        corners = np.concatenate([f + k for f, k in zip(self._faces, first, strict=False)])
        _, kept, number = np.unique(np.round(points / WELD) + 0.0, axis=0, return_index=True, return_inverse=True)
        faces = number.reshape(-1)[corners]
        _, own, same = np.unique(np.round(self._quadrics, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
        quadric = np.repeat(same.reshape(-1), [len(f) for f in self._faces])
        proper = (faces != np.roll(faces, 1, axis=1)).all(axis=1)  # the others are points or edges of poles
        mesh = pfgeom.Mesh(points[kept], faces[proper].astype(np.int32))
        return Part(mesh, np.array(self._quadrics)[own], quadric[proper])

    # Pieces of curves

    def steps(self, radius: float, angle: float, double: bool = False) -> int:
        """Chords of an arc. Double: of a surface that bends both ways."""
        chord = min(self.chord / (2 if double else 1), radius)
        widest = 2 * np.arccos(1 - chord / radius)
        return max(1, int(np.ceil(abs(angle) / widest)))

    def around(self, radius: float, double: bool = False) -> int:
        """Chords of a circle: a multiple of four, so that the bounding box is that of the quadric."""
        return 4 * self.steps(radius, np.pi / 2, double)

    def rows(self, length: float, radius: float, columns: int, angle: float = 2 * np.pi) -> int:
        if not np.isfinite(self.aspect):
            return 1
        return max(1, int(np.ceil(length / (self.aspect * radius * angle / columns))))

    def arc(self, start: Point, arc: Arc) -> tuple[Array, float, float]:
        """Its points, both ends included, radius and angle."""
        s, e, c = np.array(start), np.array(arc.to), np.array(arc.centre)
        radius = float(np.linalg.norm(s - c))
        from_, to = np.arctan2(*(s - c)[::-1]), np.arctan2(*(e - c)[::-1])
        angle = (to - from_) % (2 * np.pi) if arc.left else -((from_ - to) % (2 * np.pi))
        t = np.linspace(0, 1, self.steps(radius, angle) + 1)
        points = c + radius * np.stack([np.cos(from_ + angle * t), np.sin(from_ + angle * t)], axis=1)
        points[0], points[-1] = s, e
        return points, radius, float(angle)

    # Parts of solids

    def outline(self, start: Point, pieces: Iterable[Piece]) -> Array:
        """The loop's points, each once."""
        points, at = [], start
        for piece in pieces:
            if near(at, piece.to):
                continue
            chain = np.array([at]) if isinstance(piece, Line) else self.arc(at, piece)[0][:-1]
            points.append(chain)
            at = piece.to
        return np.concatenate(points)

    def walls(self, start: Point, pieces: Sequence[Piece], low: float, high: float) -> Array:
        """Extrudes a closed loop along z, material to the left; returns its points."""
        at = start
        for piece in pieces:
            if near(at, piece.to):
                continue
            if isinstance(piece, Line):
                along = np.subtract(piece.to, at)
                wall = piece.wall
                chain, q, out = np.array([at, piece.to]), plane((along[1], -along[0], 0), (*at, 0)), True
            else:
                chain, radius, _ = self.arc(at, piece)
                q, out, wall = revolution(piece.centre, 0, 0, radius**2), piece.left, True
            if wall:
                both = [np.column_stack([chain, np.full(len(chain), z)]) for z in (low, high)]
                self.grid(np.stack(both), q, out)
            at = piece.to
        return self.outline(start, pieces)

    def cap(self, z: float, up: bool, outer: Array, holes: Sequence[Array] = ()) -> None:
        """A flat face between loops, in the current frame."""
        points, faces = triangulate(outer, holes)
        normal = (0.0, 0.0, 1.0 if up else -1.0)
        self.add(np.column_stack([points, np.full(len(points), z)]), faces, plane(normal, (0, 0, z)))

    def circle(self, at: Point, radius: float, n: int) -> Array:
        t = 2 * np.pi * np.arange(n) / n
        return np.array(at) + radius * np.stack([np.cos(t), np.sin(t)], axis=1)

    def lathe(self, start: Point, pieces: Sequence[Piece], n: int, at: Point = (0, 0)) -> None:
        """Turns a profile of (radius, z) around z, material to the left. Arcs have their centre on the axis."""
        t = 2 * np.pi * np.arange(n + 1) / n
        t[-1] = 0
        here = start
        for piece in pieces:
            (r0, z0), (r1, z1) = here, piece.to
            if isinstance(piece, Line) and not piece.wall:
                here = piece.to
                continue
            if isinstance(piece, Line):
                length, radius = float(np.hypot(r1 - r0, z1 - z0)), max(r0, r1)
                share = np.linspace(0, 1, self.rows(length, radius, n) + 1)[:, None]
                chain = (1 - share) * np.array(here) + share * np.array(piece.to)
                if z0 == z1:
                    q, out = plane((0, 0, r0 - r1), (0, 0, z0)), True
                else:
                    slope = (r1 - r0) / (z1 - z0)
                    base = r0 - slope * z0
                    q, out = revolution(at, slope**2, 2 * slope * base, base**2), z1 > z0
            else:
                chain, radius, _ = self.sphere_arc(here, piece)
                z = piece.centre[1]
                q, out = revolution(at, -1, 2 * z, radius**2 - z * z), piece.left
            points = np.stack([at[0] + chain[:, :1] * np.cos(t), at[1] + chain[:, :1] * np.sin(t),
                               np.broadcast_to(chain[:, 1:], (len(chain), n + 1))], axis=-1)  # fmt: skip
            self.grid(points, q, out)
            here = piece.to

    def sphere_arc(self, start: Point, arc: Arc) -> tuple[Array, float, float]:
        chord, self.chord = self.chord, self.chord / 2
        found = self.arc(start, arc)
        self.chord = chord
        return found


# Loops. Outer ones are counter-clockwise; holes and pockets are the same loop the other way round.


def rectangle(width: float, depth: float, radius: float = 0, at: Point = (0, 0)) -> Loop:
    """Around a centre, with rounded corners."""
    ways = ((1, 0), (0, 1), (-1, 0), (0, -1))
    pieces: list[Piece] = []
    for k, corner in enumerate(((1, -1), (1, 1), (-1, 1), (-1, -1))):
        tip = np.array(at) + np.array(corner) * (width / 2, depth / 2)
        into, out = np.array(ways[k]) * radius, np.array(ways[(k + 1) % 4]) * radius
        pieces.append(Line(as_point(tip - into)))
        if radius > 0:
            pieces.append(Arc(as_point(tip + out), as_point(tip - into + out)))
    return pieces[-1].to, pieces


def near(a: Point, b: Point) -> bool:
    return bool(np.hypot(a[0] - b[0], a[1] - b[1]) < WELD)


def as_point(p: Array) -> Point:
    return float(p[0]), float(p[1])


def backwards(start: Point, pieces: Sequence[Piece]) -> Loop:
    """The same loop, the other way round."""
    ends = [start, *(piece.to for piece in pieces)]
    turned: list[Piece] = []
    for piece, to in zip(reversed(pieces), reversed(ends[:-1]), strict=True):
        turned.append(Line(to, piece.wall) if isinstance(piece, Line) else Arc(to, piece.centre, not piece.left))
    return ends[-1], turned


def quarter_turn(axis: int) -> Array:
    """Cyclic exchange of axes: z becomes x (1) or y (2)."""
    return np.roll(np.eye(3), axis, axis=0)


def askew() -> Array:
    """A rotation that no axis survives."""
    w, x, y, z = np.array([0.86, 0.21, -0.34, 0.31]) / np.linalg.norm([0.86, 0.21, -0.34, 0.31])
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])  # fmt: skip


# The parts; millimetres.


def hole(b: Builder, at: Point, radius: float, low: float, high: float) -> Array:
    """Through a plate; returns the rim."""
    n = b.around(radius)
    b.lathe((radius, high), [Line((radius, low))], n, at)
    return b.circle(at, radius, n)


def plate(b: Builder, outline: Loop, height: float, holes: Sequence[tuple[Point, float]]) -> None:
    loop = b.walls(*outline, 0, height)
    rims = [hole(b, at, radius, 0, height) for at, radius in holes]
    b.cap(0, False, loop, rims)
    b.cap(height, True, loop, rims)


def plate_of_four(b: Builder) -> None:
    plate(b, rectangle(80, 50), 8, [((x, y), 5) for x in (-28, 28) for y in (-15, 15)])


def plate_of_nine(b: Builder) -> None:
    plate(b, rectangle(80, 60), 6, [((24 * i, 18 * j), 4 + 0.5 * (3 * j + i)) for i in (-1, 0, 1) for j in (-1, 0, 1)])


def rounded_plate(b: Builder) -> None:
    b.frame(askew())
    plate(b, rectangle(70, 46, 9), 7, [((x, y), 3.2) for x in (-26, 26) for y in (-14, 14)] + [((0, 0), 11)])


def slotted_plate(b: Builder) -> None:
    loop, rims = b.walls(*rectangle(90, 50, 4), 0, 10), []
    for x in (-30, -10, 10, 30):
        rims.append(b.walls(*backwards(*rectangle(9, 36, 4.5, (x, 0))), 0, 10))
    b.cap(0, False, loop, rims)
    b.cap(10, True, loop, rims)


def rounded_box(b: Builder, size: Sequence[float] = (60, 40, 25), r: float = 6) -> None:
    """Flat sides, cylinders along the edges, spheres in the corners."""
    n = b.steps(r, np.pi / 2, double=True)
    angle = np.pi / 2 * np.arange(n + 1) / n
    cosine, sine = np.cos(angle), np.sin(angle)
    cosine[-1], sine[0] = 0, 0
    for axis in range(3):
        turn = quarter_turn(axis)
        b.frame(turn)
        x, y, z = (turn.T @ np.array(size)) / 2  # along the frame's own axes
        flat = np.array([[i * (x - r), j * (y - r)] for i, j in ((1, -1), (1, 1), (-1, 1), (-1, -1))])
        for side in (-1, 1):
            b.cap(side * z, side > 0, flat)
        for i in (-1, 1):
            for j in (-1, 1):
                rim = np.stack([i * (x - r + r * cosine), j * (y - r + r * sine)], axis=1)
                rows = [np.column_stack([rim, np.full(n + 1, k * (z - r))]) for k in (-1, 1)]
                b.grid(np.stack(rows), revolution((i * (x - r), j * (y - r)), 0, 0, r * r))
    b.frame()
    inner = np.array(size) / 2 - r
    for corner in np.array([(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]):
        octant = np.stack([np.outer(cosine, cosine), np.outer(cosine, sine), np.outer(sine, np.ones(n + 1))], axis=-1)
        x, y, z = centre = corner * inner
        b.grid(centre + r * corner * octant, revolution((x, y), -1, 2 * z, r * r - z * z))


def cup(b: Builder) -> None:
    """A box without a lid, walls of 2 mm, rounded along z."""
    outside, inside = b.walls(*rectangle(60, 40, 8), 0, 30), b.walls(*backwards(*rectangle(56, 36, 6)), 2, 30)
    b.cap(0, False, outside)
    b.cap(30, True, outside, [inside])
    b.cap(2, True, inside)


def tube(b: Builder) -> None:
    b.frame(askew())
    b.lathe((15, 0), [Line((20, 0)), Line((20, 70)), Line((15, 70)), Line((15, 0))], b.around(20))


def flanged_tube(b: Builder) -> None:
    n, bolts = b.around(32), [(24 * np.cos(a), 24 * np.sin(a)) for a in np.pi / 3 * np.arange(6)]
    b.lathe((16, 8), [Line((16, 45)), Line((12, 45)), Line((12, 0))], n)
    b.lathe((32, 0), [Line((32, 8))], n)
    rims = [hole(b, at, 3, 0, 8) for at in bolts]
    outer = b.circle((0, 0), 32, n)
    b.cap(0, False, outer, [b.circle((0, 0), 12, n), *rims])
    b.cap(8, True, outer, [b.circle((0, 0), 16, n), *rims])


def stepped_shaft(b: Builder) -> None:
    """Three diameters, conical chamfers at the ends and at one step."""
    below = [Line((8, 0)), Line((10, 2)), Line((10, 30)), Line((14, 30)), Line((16, 32)), Line((16, 60))]
    above = [Line((12, 60)), Line((12, 85)), Line((10.5, 88)), Line((0, 88))]
    b.lathe((0, 0), [*below, *above], b.around(16))


def dome(b: Builder) -> None:
    """Half a hollow sphere, 3 mm thick."""
    n = b.around(30, double=True)
    outside: list[Piece] = [Line((30, 0)), Arc((0, 30), (0, 0)), Line((0, 27), wall=False)]
    b.lathe((27, 0), [*outside, Arc((27, 0), (0, 0), left=False)], n)


def capsule(b: Builder) -> None:
    b.frame(askew())
    b.lathe((0, -12), [Arc((12, 0), (0, 0)), Line((12, 50)), Arc((0, 62), (0, 50))], b.around(12, double=True))


def ball_end(b: Builder) -> None:
    """A pin with a ball of a larger radius, chamfered."""
    z = float(np.sqrt(14**2 - 7**2))
    profile: list[Piece] = [Line((6, 0)), Line((7, 1)), Line((7, 40 - z)), Arc((0, 54), (0, 40))]
    b.lathe((0, 0), profile, b.around(14, double=True))


def gear(b: Builder, teeth: int = 12, bore: float = 8) -> None:
    """Flat flanks, tips and roots."""
    a = 2 * np.pi / teeth
    corners = [(r * np.cos(a * (t + s)), r * np.sin(a * (t + s))) for t in range(teeth)
               for r, s in ((24.0, -0.36), (30.0, -0.16), (30.0, 0.16), (24.0, 0.36))]  # fmt: skip
    plate(b, (corners[-1], [Line(c) for c in corners]), 12, [((0, 0), bore)])


def hub_gear(b: Builder) -> None:
    """Nine teeth and a hub on one side, whose bore is chamfered."""
    teeth, a = 9, 2 * np.pi / 9
    corners = [(r * np.cos(a * (t + s)), r * np.sin(a * (t + s))) for t in range(teeth)
               for r, s in ((24.0, -0.36), (30.0, -0.16), (30.0, 0.16), (24.0, 0.36))]  # fmt: skip
    loop, n = b.walls(corners[-1], [Line(c) for c in corners], 0, 9), b.around(14)
    b.lathe((14, 9), [Line((14, 20)), Line((8, 20)), Line((7, 19)), Line((7, 0))], n)
    b.cap(0, False, loop, [b.circle((0, 0), 7, n)])
    b.cap(9, True, loop, [b.circle((0, 0), 14, n)])


def bracket(b: Builder, along: float = 20) -> None:
    """An angle with a fillet inside, rounded outside, and two holes in each leg: in its middle, or so far along it."""
    flat: list[Piece] = [Line((60, 0), wall=False), Line((60, 8)), Line((18, 8), wall=False)]
    fillet = Arc((8, 18), (18, 18), left=False)
    upright: list[Piece] = [Line((8, 50), wall=False), Line((0, 50)), Line((0, 14), wall=False)]
    loop = b.walls((14, 0), [*flat, fillet, *upright, Arc((14, 0), (14, 14))], 0, 40)
    b.cap(0, False, loop)
    b.cap(40, True, loop)
    turns = (quarter_turn(1), quarter_turn(2))  # the upright leg's (y, z), the flat one's (z, x)
    for turn, far, spots in ((turns[0], 50, (28, 42)), (turns[1], 60, (30, 50))):
        stands = turn is turns[0]
        b.frame(turn)
        places = [(s, along) if stands else (along, s) for s in spots]
        rims = [hole(b, at, 3.5, 0, 8) for at in places]
        for level, near in ((0, 14), (8, 18)):
            corners = [(near, 0), (far, 0), (far, 40), (near, 40)]
            points = np.array([c if stands else c[::-1] for c in corners], dtype=float)
            b.cap(level, level > 0, points, rims)


def channel(b: Builder) -> None:
    """A U with fillets inside and rounded edges."""
    right: list[Piece] = [Line((22, 0)), Arc((30, 8), (22, 8)), Line((30, 35)), Line((25, 35)), Line((25, 10))]
    inside: list[Piece] = [Arc((20, 5), (20, 10), left=False), Line((-20, 5)), Arc((-25, 10), (-20, 10), left=False)]
    left: list[Piece] = [Line((-25, 35)), Line((-30, 35)), Line((-30, 8)), Arc((-22, 0), (-22, 8))]
    b.frame(quarter_turn(1))
    loop = b.walls((-22, 0), [*right, *inside, *left], 0, 70)
    b.cap(0, False, loop)
    b.cap(70, True, loop)


def countersunk(b: Builder) -> None:
    """Holes with conical chamfers above, one with a bore below."""
    places = [(x, y) for x in (-25.0, 25.0) for y in (-12.0, 12.0)]
    loop, above, below = b.walls(*rectangle(76, 44), 0, 9), [], []
    for at in places:
        n = b.around(6)
        b.lathe((6, 9), [Line((3, 6)), Line((3, 0))], n, at)
        above.append(b.circle(at, 6, n))
        below.append(b.circle(at, 3, n))
    n = b.around(9)
    b.lathe((5, 9), [Line((5, 4)), Line((9, 4)), Line((9, 0))], n)
    b.cap(9, True, loop, [*above, b.circle((0, 0), 5, n)])
    b.cap(0, False, loop, [*below, b.circle((0, 0), 9, n)])


def pockets(b: Builder) -> None:
    """Blind: round ones of three depths, one with a conical floor, one with a spherical one."""
    floors: list[tuple[Point, float, list[Piece]]] = [
        ((-30, 10), 6, [Line((6, 8)), Line((0, 8))]),
        ((-10, 10), 6, [Line((6, 12)), Line((0, 12))]),
        ((10, 10), 6, [Line((6, 5)), Line((0, 5))]),
        ((30, 10), 6, [Line((6, 10)), Line((0, 6.5))]),
        ((-20, -12), 10, [Arc((0, 10), (0, 20), left=False)]),
        ((20, -12), 8, [Line((8, 14)), Line((4, 14)), Line((4, 9)), Line((0, 9))]),
    ]
    loop, rims = b.walls(*rectangle(84, 48, 5), 0, 20), []
    for at, radius, floor in floors:
        n = b.around(radius, double=isinstance(floor[0], Arc))
        b.lathe((radius, 20), floor, n, at)
        rims.append(b.circle(at, radius, n))
    b.cap(20, True, loop, rims)
    b.cap(0, False, loop)


def milled_pocket(b: Builder) -> None:
    """Rectangular pockets with rounded corners, one in the floor of the other."""
    b.frame(askew())
    outside = b.walls(*rectangle(70, 50), 0, 22)
    wide = b.walls(*backwards(*rectangle(56, 36, 6)), 12, 22)
    deep = b.walls(*backwards(*rectangle(24, 20, 4, (10, 0))), 5, 12)
    b.cap(0, False, outside)
    b.cap(22, True, outside, [wide])
    b.cap(12, True, wide, [deep])
    b.cap(5, True, deep)


def funnel(b: Builder) -> None:
    """Cones and cylinders, 2 mm thick along the radius."""
    outside = [Line((6, 0)), Line((6, 25)), Line((26, 45)), Line((26, 52))]
    inside = [Line((24, 52)), Line((24, 45)), Line((4, 25)), Line((4, 0))]
    b.lathe((4, 0), [*outside, *inside], b.around(26))


PARTS: dict[str, Callable[[Builder], None]] = {
    f.__name__: f
    for f in (
        plate_of_four,
        plate_of_nine,
        rounded_plate,
        slotted_plate,
        rounded_box,
        cup,
        tube,
        flanged_tube,
        stepped_shaft,
        dome,
        capsule,
        ball_end,
        gear,
        hub_gear,
        bracket,
        channel,
        countersunk,
        pockets,
        milled_pocket,
        funnel,
    )
}


# Thin walls: a thickness in, the middle of the wall out, as points.


def fin(b: Builder, thick: float) -> Array:
    """Upright on a block, askew."""
    b.frame(askew())
    t = thick / 2
    right = [Line((20, 0)), Line((20, 10)), Line((t, 10)), Line((t, 30))]
    left = [Line((-t, 30)), Line((-t, 10)), Line((-20, 10)), Line((-20, 0))]
    loop = b.walls((-20, 0), [*right, *left], 0, 40)
    b.cap(0, False, loop)
    b.cap(40, True, loop)
    return spread((0, 0), (11, 29), (1, 39)) @ b.turn.T


def thin_tube(b: Builder, thick: float) -> Array:
    """Above a foot of 4 mm."""
    inner = 20 - thick
    profile = [Line((24, 0)), Line((24, 6)), Line((20, 6)), Line((20, 40)), Line((inner, 40)), Line((inner, 0))]
    b.lathe((inner, 0), profile, b.around(24))
    return turned(20 - thick / 2, spread((0, 2 * np.pi), (7, 39)))


def thin_dome(b: Builder, thick: float) -> Array:
    """Half a hollow sphere."""
    r = 20 - thick
    pole = Line((0, r), wall=False)
    pieces: list[Piece] = [Line((20, 0)), Arc((0, 20), (0, 0)), pole, Arc((r, 0), (0, 0), left=False)]
    b.lathe((r, 0), pieces, b.around(20, double=True))
    angle, height = spread((0, 2 * np.pi), (0.03, 0.98)).T
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1) * np.sqrt(1 - height[:, None] ** 2)
    return (20 - thick / 2) * np.column_stack([around, height])


def thin_floor(b: Builder, thick: float) -> Array:
    """Of a round box whose walls are 3 mm."""
    n = b.around(20)
    b.lathe((0, 0), [Line((20, 0)), Line((20, 15)), Line((17, 15)), Line((17, thick)), Line((0, thick))], n)
    radius, angle = spread((1, 16), (0, 2 * np.pi)).T
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(len(angle), thick / 2)], axis=1)


def thin_flange(b: Builder, thick: float) -> Array:
    """Around a pin, askew."""
    b.frame(askew())
    top = 15 + thick
    flange = [Line((20, 15)), Line((20, top)), Line((6, top))]
    b.lathe((0, 0), [Line((6, 0)), Line((6, 15)), *flange, Line((6, 30)), Line((0, 30))], b.around(20))
    radius, angle = spread((7, 19), (0, 2 * np.pi)).T
    middle = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(len(angle), 15 + thick / 2)], axis=1)
    return middle @ b.turn.T


def spread(*ranges: Point, count: int = 1500) -> Array:
    """Points without a pattern."""
    low, high = np.array(ranges, dtype=float).T
    return np.random.default_rng(1).uniform(low, high, (count, len(ranges)))


def turned(radius: float, angle_and_height: Array) -> Array:
    angle, height = angle_and_height.T
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)


WALLS: dict[str, Callable[[Builder, float], Array]] = {
    f.__name__: f for f in (fin, thin_tube, thin_dome, thin_floor, thin_flange)
}


def make_wall(name: str, thickness: float, tolerance: float) -> tuple[Part, Array]:
    """A part with a wall so many tolerances thick, and points in the middle of the wall. Tessellated so finely that the
    two sides stay clear of each other."""
    rough = Builder(np.inf)
    WALLS[name](rough, 1)
    length = tolerance * rough.build().diagonal
    builder = Builder(min(0.25, 0.2 * thickness) * length)
    middle = WALLS[name](builder, thickness * length)
    return builder.build(), middle


def make(name: str, chord: float, aspect: float = np.inf) -> Part:
    """`chord`: a share of the diagonal, which no face misses its quadric by."""
    size = build(name, 1).diagonal  # circles of four chords have the right box
    return build(name, chord * size, aspect)


def build(name: str, chord: float, aspect: float = np.inf) -> Part:
    builder = Builder(chord, aspect)
    PARTS[name](builder)
    return builder.build()
