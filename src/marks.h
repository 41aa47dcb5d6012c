// SPDX-License-Identifier: GPL-3.0-or-later
//
// References, ridges, corners and required elements of a mesh, as property maps, so that they stay
// with the elements that survive; and how a new mesh gets them from an old one.
#ifndef SURETY_TOOL_MARKS_H
#define SURETY_TOOL_MARKS_H

#include "constraints.h"
#include "mesh.h"
#include "soup.h"

#include <surety/features.h>

#include <optional>
#include <string>

namespace surety::tool {

struct Marks {
  template <class Value>
  using Of_vertices = Mesh::Property_map<Mesh::Vertex_index, Value>;
  template <class Value>
  using Of_edges = Mesh::Property_map<Mesh::Edge_index, Value>;
  template <class Value>
  using Of_faces = Mesh::Property_map<Mesh::Face_index, Value>;

  Of_vertices<int> vertex_reference;
  Of_vertices<bool> is_corner, is_required_vertex;
  Of_edges<int> edge_reference;
  Of_edges<bool> is_listed; ///< whether the edge is one of the file, which has few of them
  Of_edges<bool> is_ridge, is_required_edge;
  Of_faces<int> face_reference;
  Of_faces<bool> is_required_face;
};

/// Those of a mesh, with nothing marked where there were none.
Marks add_marks(Mesh& mesh);
std::optional<Marks> find_marks(const Mesh& mesh);

/// Marks a mesh as the soup that it was made of says, in the same order.
/// \throws Bad_file if an edge of the soup is none of the mesh.
void mark(Mesh& mesh, const Annotations& notes, const std::string& file);

/// What the marks ask to keep: listed and required edges, and those between faces with different
/// references; corners, required vertices, those of required edges and faces, and those where
/// curves with different references meet.
Constraints constraints_of(const Mesh& mesh);

/// Marks the ridges and corners that were found beside those that were marked.
void mark_features(Mesh& mesh, const Features& features);

/// Marks a mesh, made anew from another one, like it: vertices at the same place, edges of curves
/// like the nearest edge of a feature there, faces like the region that they replace.
/// \param features of the old mesh.
/// \throws Failure (not certified) if a required element is not there any more.
/// \pre The old mesh has marks; the new one has the map "e:is_feature" of `make_unit_mesh()`.
void carry_marks(const Mesh& from, const Features& features, Mesh& to);

/// The mesh as a soup, with what is marked.
Soup to_soup(const Mesh& mesh);

} // namespace surety::tool

#endif // SURETY_TOOL_MARKS_H
