# SPDX-License-Identifier: BSD-3-Clause
"""What tests have meshio write into other formats: the plate and the block that gmsh made, without the cells of their
boundaries, as `for name, mesh, cells in bodies(folder)`."""
import meshio


def bodies(folder):
    for name, top in ("plate", ("quad", "triangle")), ("block", ("hexahedron", "wedge")):
        mesh = meshio.read(f"{folder}/{name}.msh")
        yield name, mesh, [(block.type, block.data) for block in mesh.cells if block.type in top]
