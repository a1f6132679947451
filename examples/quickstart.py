"""Ten lines: a mesh into functions, a file, and back."""

import numpy as np
import pfgeom

vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]

model = pfgeom.compress(vertices, faces, tolerance=1e-3)  # a share of the diagonal; or pass a mesh object
print(model)
data = model.to_bytes()  # or model.save("octahedron.pfg")
mesh = pfgeom.from_bytes(data).to_mesh()
print(len(mesh.faces), "triangles, off by", pfgeom.compare((vertices, faces), mesh).max)
print("inside:", model.contains([[0, 0, 0], [1, 1, 1]]))
