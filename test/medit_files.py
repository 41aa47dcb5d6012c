# SPDX-License-Identifier: GPL-3.0-or-later
#
# Medit's meshes, read and written without the program's code: a dictionary from keywords to lists
# of entries, with indices from 1, and the reference last where an entry has one.
import struct

# Code in binary files, number of indices, whether a reference follows.
LISTS = {"Edges": (5, 2, True), "Triangles": (6, 3, True), "Quadrilaterals": (7, 4, True),
         "Tetrahedra": (8, 4, True), "Corners": (13, 1, False), "Ridges": (14, 1, False),
         "RequiredVertices": (15, 1, False), "RequiredEdges": (16, 1, False),
         "RequiredTriangles": (17, 1, False)}
VERTICES, END = 4, 54


def text_of(mesh, version=2):
    lines = [f"MeshVersionFormatted {version}", "Dimension 3", "Vertices"]
    lines += [str(len(mesh["Vertices"]))]
    lines += ["{!r} {!r} {!r} {}".format(*vertex) for vertex in mesh["Vertices"]]
    for keyword in LISTS:
        if mesh.get(keyword):
            lines += [keyword, str(len(mesh[keyword]))]
            lines += [" ".join(map(str, entry)) for entry in mesh[keyword]]
    return "\n".join(lines + ["End", ""])


def from_text(text):
    words = iter(text.split())
    mesh = {"Vertices": []}
    for word in words:
        if word in ("MeshVersionFormatted", "Dimension"):
            next(words)
        elif word == "Vertices":
            mesh[word] = [(float(next(words)), float(next(words)), float(next(words)),
                           int(next(words))) for _ in range(int(next(words)))]
        elif word == "End":
            return mesh
        else:
            _, columns, has_reference = LISTS[word]
            mesh[word] = [tuple(int(next(words)) for _ in range(columns + has_reference))
                          for _ in range(int(next(words)))]
    raise ValueError("no End")


def bytes_of(mesh, version=2, order="<"):
    real, integer, position = {1: "fii", 2: "dii", 3: "diq", 4: "dqq"}[version]
    data = struct.pack(order + "ii", 1, version)

    def add(code, content):
        nonlocal data
        head = struct.calcsize("<i" + position)
        data += struct.pack(order + "i" + position, code, len(data) + head + len(content)) + content

    add(3, struct.pack(order + "i", 3))
    vertices = b"".join(struct.pack(order + 3 * real + integer, *v) for v in mesh["Vertices"])
    add(VERTICES, struct.pack(order + integer, len(mesh["Vertices"])) + vertices)
    for keyword, (code, columns, has_reference) in LISTS.items():
        if mesh.get(keyword):
            form = order + integer * (columns + has_reference)
            content = b"".join(struct.pack(form, *entry) for entry in mesh[keyword])
            add(code, struct.pack(order + integer, len(mesh[keyword])) + content)
    return data + struct.pack(order + "i" + position, END, 0)


def from_bytes(data):
    """Versions 2 and 3, in the order of this machine."""
    mark, version = struct.unpack_from("<ii", data)
    assert mark == 1 and version in (2, 3)
    position = "<ii" if version == 2 else "<iq"
    names = {code: keyword for keyword, (code, _, _) in LISTS.items()}
    mesh, at = {}, 8
    while True:
        code, end = struct.unpack_from(position, data, at)
        at += struct.calcsize(position)
        if code == END:
            return mesh
        number, = struct.unpack_from("<i", data, at)
        if code == VERTICES:
            mesh["Vertices"] = [struct.unpack_from("<dddi", data, at + 4 + 28 * i)
                                for i in range(number)]
        elif code in names:
            _, columns, has_reference = LISTS[names[code]]
            width = columns + has_reference
            mesh[names[code]] = [struct.unpack_from(f"<{width}i", data, at + 4 + 4 * width * i)
                                 for i in range(number)]
        at = end
