// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large meshes are simplified in patches first: on one thread or on many, with the same result. A
// patch is a run of faces of T, which lie along a space-filling curve, with all it takes to
// simplify it by itself. Vertices on its cut stay, and nothing is collapsed into them, so that
// every disc that changes lies in one patch, and so do the stars that the link condition looks at.
// The maps of the patches are the identity on the cuts; together they are a map of the whole. What
// lies along the cuts is simplified afterwards.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_PATCH_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_PATCH_H

#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/simplifier.h>

#include <algorithm>
#include <vector>

namespace surety::internal {

/// What the whole of a simplification hands to its patches.
struct Whole {
  const Reference& reference;
  const Working_mesh::Connectivity& connectivity;
  const std::vector<bool>& is_feature; ///< edges
  const std::vector<bool>& is_fixed;   ///< vertices
  const std::vector<Index>& input_position;
  const Tolerance& tolerance;
  double normal_cosine;
};

class Patch
{
public:
  /// Cuts out the faces first .. last - 1.
  Patch(const Whole& whole, Index first, Index last) : first_face_(first), faces_(last - first)
  {
    collect_elements(whole);
    read_connectivity(whole);
  }

  /// Simplifies the patch and keeps what comes of it; returns whether it came to its end.
  bool simplify(
      const Whole& whole, const Simplification_controls& controls, Simplification_plan plan,
      const std::function<bool(const Progress&)>& visitor);

  const Operations& operations() const { return operations_; }

  /// Writes the faces of the patch into those of the whole.
  void merge_into(Working_mesh::Connectivity& whole) const;
  /// Moves the vertices that the patch has moved.
  void merge_into(Working_mesh& whole) const
  {
    for (const Moved& moved : moved_) whole.move(moved.vertex, moved.point, moved.anchor);
  }
  /// Writes the map of the patch into one that is the identity there.
  void merge_into(Map& whole) const;
  /// Hands over what the vertices inside stand for.
  void merge_into(Greedy& whole) const
  {
    for (const auto& [v, quadric] : quadrics_) whole.set_quadric(v, quadric);
  }

private:
  void collect_elements(const Whole& whole);
  void read_connectivity(const Whole& whole);
  void keep(const Whole& whole, const Working_mesh& mesh, const Map& map, const Greedy& greedy);

  static Index place_in(const std::vector<Index>& sorted, Index value)
  {
    return static_cast<Index>(
        std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
  }
  Index local_halfedge(Index h) const { return 2 * place_in(edges_, h / 2) + h % 2; }
  Index whole_halfedge(Index h) const { return 2 * edges_[h / 2] + h % 2; }
  Element in_whole(Element element) const
  {
    switch (element.kind()) {
    case Element::Kind::vertex:
      return {element.kind(), vertices_[element.id()]};
    case Element::Kind::edge:
      return {element.kind(), edges_[element.id()]};
    case Element::Kind::face:
      break;
    }
    return {element.kind(), first_face_ + element.id()};
  }

  Index first_face_, faces_;
  std::vector<Index> vertices_, edges_; ///< of the whole, in order
  Working_mesh::Connectivity connectivity_;
  std::vector<bool> is_cut_; ///< vertices on the cut

  struct Moved {
    Index vertex;
    Vector point;
    Index anchor;
  };
  struct Crossing {
    Index t_edge, m_edge;
    float lambda;
  };
  Operations operations_;
  std::vector<Moved> moved_;
  std::vector<Element> images_;
  std::vector<Crossing> crossings_; ///< by T edge, in order along it
  std::vector<std::pair<Index, Quadric>> quadrics_;
};

inline void Patch::collect_elements(const Whole& whole)
{
  vertices_.reserve(3 * std::size_t(faces_));
  edges_.reserve(3 * std::size_t(faces_));
  for (Index f = first_face_; f < first_face_ + faces_; ++f) {
    for (const Index v : whole.reference.vertices_of_face(f)) vertices_.push_back(v);
    for (const Index e : whole.reference.edges_of_face(f)) edges_.push_back(e);
  }
  for (auto* list : {&vertices_, &edges_}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
    list->shrink_to_fit();
  }
}

inline void Patch::read_connectivity(const Whole& whole)
{
  const auto is_inside = [&](Index f) { return f != none && f - first_face_ < faces_; };
  connectivity_.vertices = static_cast<Index>(vertices_.size());
  connectivity_.faces = faces_;
  is_cut_.assign(vertices_.size(), false);
  for (const Index e : edges_)
    for (Index h = 2 * e; h < 2 * e + 2; ++h) {
      const Index f = whole.connectivity.face[h];
      const Index target = place_in(vertices_, whole.connectivity.target[h]);
      connectivity_.target.push_back(target);
      connectivity_.face.push_back(is_inside(f) ? f - first_face_ : none);
      connectivity_.next.push_back(
          is_inside(f) ? local_halfedge(whole.connectivity.next[h]) : none);
      if (f == none || is_inside(f)) continue;
      is_cut_[target] = true;
      is_cut_[place_in(vertices_, whole.connectivity.target[h ^ 1])] = true;
    }
}

inline bool Patch::simplify(
    const Whole& whole, const Simplification_controls& controls, Simplification_plan plan,
    const std::function<bool(const Progress&)>& visitor)
{
  std::vector<Vector> points;
  std::vector<Index> input_position;
  std::vector<bool> is_feature, is_fixed;
  for (Index v = 0; v < vertices_.size(); ++v) {
    points.push_back(whole.reference.point(vertices_[v]));
    input_position.push_back(whole.input_position[vertices_[v]]);
    is_fixed.push_back(is_cut_[v] || whole.is_fixed[vertices_[v]]);
  }
  for (Index e = 0; e < edges_.size(); ++e) {
    const bool is_border
        = connectivity_.face[2 * e] == none || connectivity_.face[2 * e + 1] == none;
    is_feature.push_back(is_border || whole.is_feature[edges_[e]]);
  }
  const Reference reference(
      points, connectivity_.next, connectivity_.target, connectivity_.face, faces_, input_position);
  Journal journal;
  Working_mesh mesh(
      std::move(connectivity_), std::move(points), std::move(is_feature), std::move(is_fixed),
      journal);
  mesh.seal(is_cut_);
  Direct_bound bound(
      reference, mesh, whole.tolerance.restricted_to(vertices_), journal, whole.normal_cosine);
  plan.overshoots.clear();
  plan.smoothing_sweeps = 0;
  Simplifier simplifier(
      reference, mesh, bound, &bound, controls, plan, Guarding::never, journal,
      whole.reference.point(0), visitor);
  const Outcome outcome = simplifier.run();
  operations_ = simplifier.operations();
  keep(whole, mesh, bound.map(), simplifier.greedy());
  return outcome == Outcome::complete;
}

inline void Patch::keep(
    const Whole& whole, const Working_mesh& mesh, const Map& map, const Greedy& greedy)
{
  for (Index v = 0; v < vertices_.size(); ++v) {
    images_.push_back(in_whole(map.image(v)));
    if (!mesh.is_live_vertex(v) || is_cut_[v]) continue;
    quadrics_.emplace_back(vertices_[v], greedy.quadric(v));
    if (mesh.point(v) != whole.reference.point(vertices_[v]))
      moved_.push_back({vertices_[v], mesh.point(v), vertices_[mesh.anchor(v)]});
  }
  for (Index e = 0; e < edges_.size(); ++e)
    for (Index n = map.first_node_of_t(e); n != none; n = map.node(n).next_on_t)
      crossings_.push_back({edges_[e], edges_[map.node(n).m_edge], map.node(n).lambda});

  connectivity_ = {};
  for (Index h = 0; h < 2 * edges_.size(); ++h) {
    const Index f = mesh.face(h);
    const bool is_inside = f != none && !mesh.is_ghost_face(f);
    connectivity_.face.push_back(is_inside ? first_face_ + f : none);
    connectivity_.next.push_back(is_inside ? whole_halfedge(mesh.next(h)) : none);
    connectivity_.target.push_back(
        f != none ? vertices_[mesh.target(h)] : whole.connectivity.target[whole_halfedge(h)]);
  }
}

inline void Patch::merge_into(Working_mesh::Connectivity& whole) const
{
  for (Index h = 0; h < connectivity_.face.size(); ++h) {
    const Index there = whole_halfedge(h);
    const bool was_inside = whole.face[there] != none && whole.face[there] - first_face_ < faces_;
    // Beyond the cut lies another patch; beyond a border of T only the target may have changed.
    if (was_inside) {
      whole.face[there] = connectivity_.face[h];
      whole.next[there] = connectivity_.next[h];
    }
    if (was_inside || whole.face[there] == none) whole.target[there] = connectivity_.target[h];
  }
}

inline void Patch::merge_into(Map& whole) const
{
  for (Index i = 0; i < vertices_.size(); ++i) {
    const Index v = vertices_[i];
    if (images_[i].is(Element::Kind::vertex, v)) continue;
    whole.clear_pin(v);
    whole.assign(v, images_[i]);
  }
  Index edge = none, last = none;
  for (const Crossing& crossing : crossings_) {
    if (crossing.t_edge != edge) last = none;
    edge = crossing.t_edge;
    last = whole.append_node(edge, last, crossing.m_edge, crossing.lambda);
  }
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_PATCH_H
