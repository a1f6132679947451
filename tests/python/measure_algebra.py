"""Acceptance of set operations: random pairs of files, point by point, and again after writing and reading.

python tests/python/measure_algebra.py A.pfg B.pfg ... --pairs 50 --points 1000000
"""

from __future__ import annotations

import argparse
import random
import time

import numpy as np
import pfgeom


def random_place(model: pfgeom.Model, target: pfgeom.Model, rng: random.Random) -> np.ndarray:
    """A random turn about the middle, mirrored or not, to about the target's size and place."""
    q = np.array([rng.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / np.linalg.norm(q)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    linear = turn * rng.choice([-1, 1]) * (rng.uniform(0.5, 1.2) * target.diagonal / model.diagonal)
    to = target.bounds.mean(axis=0) + np.array([rng.uniform(-0.3, 0.3) for _ in range(3)]) * target.diagonal
    return np.column_stack([linear, to - linear @ model.bounds.mean(axis=0)])


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="+")
    parser.add_argument("--pairs", type=int, default=50)
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=2018)
    args = parser.parse_args()
    rng, generator = random.Random(args.seed), np.random.default_rng(args.seed)
    models = [pfgeom.load(path) for path in args.files]
    wrong = points = kept = size = 0
    start = time.process_time()
    for i in range(args.pairs):
        a, b = rng.choice(models), rng.choice(models)
        b = b.transformed(random_place(b, a, rng))
        operation = i % 3
        model = (a | b, a & b, a - b)[operation]
        again = pfgeom.from_bytes(model.to_bytes())
        low = np.minimum(a.bounds[0], b.bounds[0])
        sample = generator.uniform(low, np.maximum(a.bounds[1], b.bounds[1]), (args.points, 3))
        va, vb = a(sample), b(sample)
        expected = (np.maximum(va, vb), np.minimum(va, vb), np.minimum(va, -vb))[operation]
        wrong += int((again(sample) != expected).sum())
        points += args.points
        kept += again.to_bytes() == model.to_bytes()
        size += model.nbytes - a.nbytes - b.nbytes
    print(f"{args.pairs} pairs, {points:,} points, {wrong} differ; {kept} files the same when read and written")
    print(
        f"bytes beside those of the operands' files: {size / args.pairs:.1f} a pair; "
        f"{time.process_time() - start:.0f} CPU s"
    )


if __name__ == "__main__":
    main()
