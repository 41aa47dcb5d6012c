// SPDX-License-Identifier: GPL-3.0-or-later
//
// What T says at each of its points: the metric, the normal, and the point of the support there. M
// stands on it. What a metric in the background says is added at each point that is asked for.
#ifndef SURETY_INTERNAL_UNIT_MESH_GROUND_H
#define SURETY_INTERNAL_UNIT_MESH_GROUND_H

#include <surety/background_metric.h>
#include <surety/geometric_support.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/geometric_mesh/exchange.h>
#include <surety/internal/geometric_mesh/surface_walk.h>
#include <surety/internal/unit_mesh/local_metric.h>
#include <surety/metric_field.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal::unit_mesh {

/// A point of T: in a face by weights of its corners, or on an edge of a curve of features.
struct Standpoint {
  Index face = none;
  Vector weights = Vector(1, 0, 0);
  Index edge = none; ///< of a curve; the face is not used then
  double parameter = 0;
};

class Ground
{
public:
  /// Lengths of the mesh times `scale` are those of the reference.
  /// \param background of the same surface, in lengths of the mesh; may be null
  template <class Mesh>
  Ground(
      const Mesh& mesh, const Elements<Mesh>& elements, const Reference& reference,
      const std::vector<bool>& is_feature, const std::vector<bool>& is_corner,
      const Metric_field& field, const Geometric_support& support, double scale,
      const Background_metric* background)
    : reference_(reference),
      walk_(reference),
      is_feature_(is_feature),
      is_corner_(is_corner),
      support_(support),
      background_(background),
      scale_(scale),
      is_isotropic_(field.kind() == Metric_kind::isotropic),
      sides_(reference.number_of_faces()),
      support_corner_(reference.number_of_faces())
  {
    for (const auto f : elements.faces) face_name_.push_back(static_cast<Index>(f));
    for (const auto e : elements.edges) edge_name_.push_back(static_cast<Index>(e));
    for (const auto v : elements.vertices) vertex_name_.push_back(static_cast<Index>(v));
    for (Index f = 0; f < reference.number_of_faces(); ++f) {
      const auto corner = reference.vertices_of_face(f);
      const auto named = support.corners(face_name_[f]);
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(elements.faces[f])))
        for (int i = 0; i < 3; ++i)
          if (mesh.target(h) == elements.vertices[corner[i]])
            sides_[f][i] = static_cast<Index>(field.side_of_corner(h));
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          if (named[k] == vertex_name_[corner[i]]) support_corner_[f][i] = k;
    }
    for (std::uint32_t s = 0; s < field.number_of_sides(); ++s) normal_.push_back(field.normal(s));
    take_sizes(field);
  }

  bool is_isotropic() const { return is_isotropic_; }

  /// The standpoint at a vertex of T that no curve passes.
  Standpoint at_vertex(Index v) const
  {
    Standpoint result;
    result.face = walk_.face_at(v);
    const auto corner = reference_.vertices_of_face(result.face);
    for (int i = 0; i < 3; ++i) result.weights[i] = corner[i] == v ? 1 : 0;
    return result;
  }
  /// On the curve that ends at a vertex or passes it.
  Standpoint on_curve_at(Index v) const
  {
    Standpoint result;
    for (const Index e : reference_.edges_at(v))
      if (is_feature_[e]) result.edge = e;
    result.parameter
        = result.edge != none && reference_.vertices_of_edge(result.edge)[1] == v ? 1 : 0;
    return result;
  }

  /// The point of T nearest to p, by walking from a face. The walk does not cross curves: beyond
  /// them are other sizes and other normals.
  Standpoint nearest(const Vector& p, Index face) const
  {
    Standpoint result;
    result.face = walk_.closest(p, face, Ways{*this}).face;
    const auto corner = reference_.vertices_of_face(result.face);
    const Vector& a = reference_.point(corner[0]);
    const auto [v, w]
        = closest_weights(p, a, reference_.point(corner[1]) - a, reference_.point(corner[2]) - a);
    result.weights = Vector(1 - v - w, v, w);
    return result;
  }
  /// The point nearest to p of the curve that an edge belongs to, by walking along it; corners and
  /// branchings end the walk.
  Standpoint nearest_on_curve(const Vector& p, Index edge) const
  {
    Standpoint best = foot_on_edge(p, edge);
    for (Index from = none; best.parameter == 0 || best.parameter == 1;) {
      const Index v = reference_.vertices_of_edge(best.edge)[best.parameter == 1 ? 1 : 0];
      const Index next = next_on_curve(v, best.edge);
      if (next == none || next == from) return best;
      const Standpoint foot = foot_on_edge(p, next);
      from = best.edge;
      if ((point(foot) - p).squaredNorm() >= (point(best) - p).squaredNorm()) return best;
      best = foot;
    }
    return best;
  }

  /// The point of T.
  Vector point(const Standpoint& at) const
  {
    if (at.edge != none) {
      const auto& [s, t] = reference_.vertices_of_edge(at.edge);
      if (at.parameter == 0) return reference_.point(s);
      if (at.parameter == 1) return reference_.point(t);
      return reference_.point(s) + at.parameter * (reference_.point(t) - reference_.point(s));
    }
    const auto corner = reference_.vertices_of_face(at.face);
    return at.weights[0] * reference_.point(corner[0]) + at.weights[1] * reference_.point(corner[1])
        + at.weights[2] * reference_.point(corner[2]);
  }
  /// The point of the support that belongs to it.
  Vector support_point(const Standpoint& at) const
  {
    if (at.edge != none) {
      // The support counts along its own direction of the edge.
      const Vector straight = point(at);
      const auto& ends = reference_.vertices_of_edge(at.edge);
      const Vector first = scale_ * support_.curve_point(edge_name_[at.edge], 0).point;
      const bool is_along = (first - reference_.point(ends[0])).squaredNorm()
          <= (first - reference_.point(ends[1])).squaredNorm();
      const Vector result = scale_
          * support_.curve_point(edge_name_[at.edge], is_along ? at.parameter : 1 - at.parameter)
                .point;
      return result.allFinite() ? result : straight;
    }
    Support_location location;
    location.face = face_name_[at.face];
    for (int i = 0; i < 3; ++i)
      location.barycentric[support_corner_[at.face][i]] = std::max(0., at.weights[i]);
    location.barycentric /= location.barycentric.sum();
    return scale_ * support_.position(location);
  }

  Local_metric metric(const Standpoint& at) const
  {
    Local_metric result;
    if (at.edge != none) {
      const auto& [s, t] = reference_.vertices_of_edge(at.edge);
      const Local_metric &a = at_vertex_[s], &b = at_vertex_[t];
      result.kind = Vertex_kind::ridge;
      if (is_isotropic_)
        result.size = a.size + at.parameter * (b.size - a.size);
      else
        result.set_sizes(a.sizes + at.parameter * (b.sizes - a.sizes));
      if (background_ != nullptr) respect_background_on_curve(at, result);
      return result;
    }
    const auto& side = sides_[at.face];
    if (is_isotropic_) {
      result.size = 0;
      for (int i = 0; i < 3; ++i) result.size += at.weights[i] * size_[side[i]];
    } else {
      Tensor sum = Tensor::Zero();
      for (int i = 0; i < 3; ++i) sum += at.weights[i] * sizes_[side[i]];
      result.set_sizes(sum);
    }
    if (background_ != nullptr) respect_background(point(at), normal(at), result);
    return result;
  }
  /// That of a corner, for edges between corners.
  Local_metric metric_at_corner(Index v) const
  {
    Local_metric result = at_vertex_[v];
    result.kind = Vertex_kind::corner;
    if (background_ == nullptr) return result;
    for (const Index e : reference_.edges_at(v))
      for (const Index f : reference_.faces_of_edge(e))
        if (f != none) respect_background(reference_.point(v), normal_at(v, f), result);
    return result;
  }

  /// Of unit length; of a point that is not on a curve.
  Vector normal(const Standpoint& at) const
  {
    Vector sum = Vector::Zero();
    for (int i = 0; i < 3; ++i) sum += at.weights[i] * normal_[sides_[at.face][i]];
    return unit(sum);
  }

  /// Of a face of T.
  Vector normal_of_face(Index f) const { return reference_.normal_of_face(f); }
  /// The faces of T at an edge; none where there is no second one.
  const std::array<Index, 2>& faces_beside(Index edge) const
  {
    return reference_.faces_of_edge(edge);
  }

private:
  /// Those that do not cross a curve.
  struct Ways {
    bool over(Index edge) const { return !ground.is_feature_[edge]; }
    bool around(Index vertex, Index from, Index to) const
    {
      return ground.side_at(vertex, from) == ground.side_at(vertex, to);
    }
    const Ground& ground;
  };

  void take_sizes(const Metric_field& field)
  {
    const auto sides = static_cast<Index>(field.number_of_sides());
    for (Index s = 0; s < sides; ++s) {
      if (is_isotropic_) {
        size_.push_back(scale_ * field.size(s));
      } else {
        sizes_.push_back(scale_ * metric::size_tensor(field.tensor(s)));
      }
    }
    // All sides of a vertex of a curve are to be pleased.
    at_vertex_.resize(vertex_name_.size());
    for (Index v = 0; v < at_vertex_.size(); ++v) {
      if (is_isotropic_)
        at_vertex_[v].size = scale_ * field.size_at_vertex(vertex_name_[v]);
      else
        at_vertex_[v].set_sizes(
            scale_ * metric::size_tensor(field.tensor_at_vertex(vertex_name_[v])));
    }
  }

  /// The side of a vertex that a face there belongs to.
  Index side_at(Index v, Index face) const
  {
    const auto corner = reference_.vertices_of_face(face);
    return sides_[face][corner[0] == v ? 0 : corner[1] == v ? 1 : 2];
  }
  const Vector& normal_at(Index v, Index face) const { return normal_[side_at(v, face)]; }

  /// Both sides of a curve are to be pleased.
  void respect_background_on_curve(const Standpoint& at, Local_metric& result) const
  {
    const auto& [s, t] = reference_.vertices_of_edge(at.edge);
    const double w = at.parameter;
    for (const Index f : reference_.faces_of_edge(at.edge))
      if (f != none)
        respect_background(
            point(at), unit((1 - w) * normal_at(s, f) + w * normal_at(t, f)), result);
  }

  void respect_background(const Vector& p, const Vector& normal, Local_metric& result) const
  {
    const Surface_location place = background_->locate(p / scale_, normal);
    if (is_isotropic_) {
      result.size = std::min(result.size, scale_ * background_->size(place));
      return;
    }
    Tensor other = background_->tensor(place) / (scale_ * scale_);
    if (!normal.isZero(0)) other = metric::tangential(other, normal);
    const Tensor both = metric::intersection(result.metric, other);
    if (both == result.metric) return;
    result.metric = both;
    result.sizes = metric::size_tensor(both);
  }

  Standpoint foot_on_edge(const Vector& p, Index edge) const
  {
    const auto& [s, t] = reference_.vertices_of_edge(edge);
    const Vector e = reference_.point(t) - reference_.point(s);
    Standpoint result;
    result.edge = edge;
    result.parameter = std::clamp((p - reference_.point(s)).dot(e) / e.squaredNorm(), 0., 1.);
    return result;
  }

  /// The other edge of the curve that passes a vertex; none where it ends or branches.
  Index next_on_curve(Index v, Index edge) const
  {
    Index next = none;
    if (is_corner_[v]) return next;
    for (const Index e : reference_.edges_at(v)) {
      if (!is_feature_[e] || e == edge) continue;
      if (next != none) return none;
      next = e;
    }
    return next;
  }

  const Reference& reference_;
  Surface_walk walk_;
  const std::vector<bool>&is_feature_, &is_corner_;
  const Geometric_support& support_;
  const Background_metric* background_;
  double scale_;
  bool is_isotropic_;
  std::vector<std::array<Index, 3>> sides_; ///< of the field, by corner of the reference's faces
  std::vector<std::array<int, 3>> support_corner_;         ///< the support's order of these corners
  std::vector<Index> face_name_, edge_name_, vertex_name_; ///< in the user's mesh
  std::vector<Vector> normal_;                             ///< by side
  std::vector<double> size_;                               ///< by side, where isotropic
  std::vector<Tensor> sizes_;                              ///< by side, where not
  std::vector<Local_metric> at_vertex_;                    ///< of all sides together
};

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_GROUND_H
