# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tables say of meshes and surety's report does not: measured by a program that shares
# nothing with it. A mesh is a pair of arrays, the corners of its faces and its points.
import numpy

SHARP = 30  # degrees: no triangle in a corner that is as sharp can be round
CREASE = 25  # degrees by which a surface turns at an edge that bounds such a corner


def qualities(corners, points):
    """Q of each face: sqrt(3)/6 times longest edge over radius of the inscribed circle."""
    p = points[corners]
    edges = numpy.linalg.norm(numpy.roll(p, -1, axis=1) - p, axis=2)
    area = numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    return 3**0.5 / 12 * edges.max(1) * edges.sum(1) / numpy.maximum(area, 1e-300)


def interpolation_error(corners, points, field, rows=8):
    """The root mean square of a field minus its linear interpolation. Each face is cut into rows^2
    equal ones, at whose centroids both are evaluated."""
    p, u = points[corners], field(points)[corners]
    area = numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    total = numpy.zeros(len(corners))
    for i in range(rows):
        for j in range(2 * (rows - i) - 1):  # upright and turned ones in turn
            third = 1 / 3 if j % 2 == 0 else 2 / 3
            a, b = (i + third) / rows, (j // 2 + third) / rows
            weight = numpy.array([1 - a - b, a, b])
            total += (field(numpy.einsum("fkx,k->fx", p, weight)) - u @ weight) ** 2
    return float(((total / rows**2 * area).sum() / area.sum()) ** 0.5)


def corner_angles(corners, points):
    """The angles of each face, in degrees."""
    p = points[corners]
    along = numpy.roll(p, -1, axis=1) - p
    along /= numpy.linalg.norm(along, axis=2)[:, :, None]
    cosine = -(along * numpy.roll(along, 1, axis=1)).sum(2)
    return numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))


class Neighbours:
    """The faces at the edges of a mesh."""

    def __init__(self, corners, points):
        p = points[corners]
        self.normal = numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        self.normal /= numpy.linalg.norm(self.normal, axis=1)[:, None]
        self.face_of = {(face[i], face[(i + 1) % 3]): f
                        for f, face in enumerate(corners.tolist()) for i in range(3)}

    def is_crease(self, a, b):
        """Whether the surface ends at an edge, or turns there by more than CREASE."""
        f, g = self.face_of.get((a, b)), self.face_of.get((b, a))
        return f is None or g is None or (
            self.normal[f] @ self.normal[g] < numpy.cos(numpy.radians(CREASE)))


def sharp_faces(corners, points):
    """Faces at a vertex where the surface between two creases or borders is sharper than SHARP."""
    angles, neighbours = corner_angles(corners, points), Neighbours(corners, points)
    faces = corners.tolist()
    found = numpy.zeros(len(faces), bool)
    for f, face in enumerate(faces):
        for i, v in enumerate(face):
            if not neighbours.is_crease(v, face[(i + 1) % 3]):
                continue
            # From this crease on, face by face, to the next one.
            sector, opening = [f], angles[f, i]
            last = face[(i + 2) % 3]
            while opening < SHARP and not neighbours.is_crease(v, last):
                g = neighbours.face_of[v, last]
                j = faces[g].index(v)
                sector.append(g)
                opening += angles[g, j]
                last = faces[g][(j + 2) % 3]
            if opening < SHARP:
                found[sector] = True
    return found
