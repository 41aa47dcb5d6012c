// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizes that a mesh is asked to have: a Riemannian metric, once a side of every vertex.
#ifndef SURETY_METRIC_FIELD_H
#define SURETY_METRIC_FIELD_H

#include <surety/features.h>
#include <surety/internal/metric/frames.h>
#include <surety/internal/metric/tensor.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace surety {
namespace internal::metric {

/// Throws `Invalid_input` unless a tensor is finite, symmetric and positive definite.
inline void require_metric(
    const Tensor& m, const std::string& function, const std::string& argument)
{
  // Sums and products of tensors are symmetric but for rounding.
  const bool is_metric = m.allFinite()
      && (m - m.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * m.cwiseAbs().maxCoeff()
      && Eigen::SelfAdjointEigenSolver<Tensor>(m, Eigen::EigenvaluesOnly).eigenvalues()[0] > 0;
  if (is_metric) return;
  throw Invalid_input(function, argument, "not a finite, symmetric, positive definite tensor");
}

} // namespace internal::metric

/// \brief A metric on a mesh: what counts as unit length, once a side of every vertex.
///
/// An isotropic field holds a size (a length) a side, an anisotropic one a symmetric positive
/// definite tensor M: an edge e has the length sqrt(e^T M e). Both are reached as either: the
/// tensor of a size h is the identity over h^2, the size of a tensor is the least one of all
/// directions.
///
/// Tensors are tangential: the normal of their side is one of their eigenvectors, and the size
/// along it is the larger one of the tangent plane. At corners, where several curves meet, both
/// kinds are isotropic in a geometric metric. Vectors have unit length.
class Metric_field
{
public:
  using Vector = Eigen::Vector3d; ///< a direction
  using Tensor = Eigen::Matrix3d; ///< symmetric, positive definite
  using Side = std::uint32_t;     ///< index of a side, see `Sides`

  /// A metric without sides.
  Metric_field() = default;

  /// \brief The same size everywhere.
  /// \param kind whether it will depend on the direction
  /// \param sides of the mesh
  /// \param normals by side
  /// \param tangents by vertex: of the feature curve that passes there, zero where none does
  /// \param size a length in mesh units, positive
  Metric_field(
      Metric_kind kind, Sides sides, std::vector<Vector> normals, std::vector<Vector> tangents,
      double size)
    : kind_(kind),
      sides_(std::move(sides)),
      normals_(std::move(normals)),
      tangents_(std::move(tangents))
  {
    internal::require_positive(size, "Metric_field", "size");
    if (kind == Metric_kind::isotropic) {
      sizes_.assign(sides_.size(), size);
    } else {
      tensors_.assign(sides_.size(), internal::metric::isotropic_tensor(size));
    }
  }

  /// Whether sizes depend on the direction.
  Metric_kind kind() const { return kind_; }
  /// Those of the mesh.
  const Sides& sides() const { return sides_; }
  /// How many there are.
  std::size_t number_of_sides() const { return sides_.size(); }
  /// Of the surface, by side.
  const Vector& normal(Side s) const { return normals_[s]; }
  /// Of the feature curve that passes a vertex; zero at corners and where none does.
  template <class Vertex>
  const Vector& tangent(Vertex v) const
  {
    return tangents_[v];
  }

  /// \name By side
  /// @{
  /// The size; of a tensor, the least one of all directions.
  double size(Side s) const
  {
    return kind_ == Metric_kind::isotropic ? sizes_[s] : internal::metric::least_size(tensors_[s]);
  }
  /// The tensor; a multiple of the identity where the metric is isotropic.
  Tensor tensor(Side s) const
  {
    return kind_ == Metric_kind::isotropic ? internal::metric::isotropic_tensor(sizes_[s])
                                           : tensors_[s];
  }
  /// \throws Invalid_input unless the size is finite and positive.
  void set_size(Side s, double size)
  {
    internal::require_positive(size, "Metric_field::set_size", "size");
    if (kind_ == Metric_kind::isotropic) {
      sizes_[s] = size;
    } else {
      tensors_[s] = internal::metric::isotropic_tensor(size);
    }
  }
  /// \brief Takes the tangential part of a tensor; an isotropic field takes its least size.
  /// \throws Invalid_input unless the tensor is finite, symmetric and positive definite.
  void set_tensor(Side s, const Tensor& m)
  {
    internal::metric::require_metric(m, "Metric_field::set_tensor", "m");
    const Tensor part = internal::metric::tangential(m, normals_[s]);
    if (kind_ == Metric_kind::isotropic) {
      sizes_[s] = internal::metric::least_size(part);
    } else {
      tensors_[s] = part;
    }
  }
  /// @}

  /// \name By corner of a face: at the target of a halfedge, on the side of its face
  /// @{
  /// The side that the corner belongs to.
  template <class Halfedge>
  Side side_of_corner(Halfedge h) const
  {
    return sides_.of_corner[h];
  }
  /// The size there.
  template <class Halfedge>
  double size_at_corner(Halfedge h) const
  {
    return size(side_of_corner(h));
  }
  /// The tensor there.
  template <class Halfedge>
  Tensor tensor_at_corner(Halfedge h) const
  {
    return tensor(side_of_corner(h));
  }
  /// @}

  /// \name By vertex: what satisfies all its sides
  /// \pre The vertex is not isolated.
  /// @{
  /// The least size of its sides.
  template <class Vertex>
  double size_at_vertex(Vertex v) const
  {
    double least = size(sides_.first[v]);
    for (Side s = sides_.first[v] + 1; s < sides_.first[v + 1]; ++s) {
      least = (std::min)(least, size(s));
    }
    return least;
  }
  /// The intersection of the tensors of its sides.
  template <class Vertex>
  Tensor tensor_at_vertex(Vertex v) const
  {
    Tensor all = tensor(sides_.first[v]);
    for (Side s = sides_.first[v] + 1; s < sides_.first[v + 1]; ++s) {
      all = internal::metric::intersection(all, tensor(s));
    }
    return all;
  }
  /// @}

private:
  Metric_kind kind_ = Metric_kind::isotropic;
  Sides sides_;
  std::vector<Vector> normals_;
  std::vector<Vector> tangents_;
  std::vector<double> sizes_;   ///< of an isotropic field, by side
  std::vector<Tensor> tensors_; ///< of an anisotropic field, by side
};

namespace internal::metric {

template <class Mesh, class Points>
Metric_field uniform_metric(
    const Mesh& mesh, const Sides& sides, const Points& points, Metric_kind kind, double size)
{
  return Metric_field(
      kind, sides, side_normals(mesh, sides, points), curve_tangents(mesh, sides, points), size);
}

} // namespace internal::metric

/// \brief The same size everywhere, with tangent planes that are taken from the mesh.
///
/// \throws Invalid_input unless the size is finite and positive.
/// Reads `vertex_point_map`, and `metric_kind`.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Metric_field make_uniform_metric(
    const Mesh& mesh, const Sides& sides, double size,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto kind = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, internal::metric_kind), internal::defaults::metric_kind);
  return internal::metric::uniform_metric(
      mesh, sides, internal::vertex_points(mesh, np), kind, size);
}

} // namespace surety

#endif // SURETY_METRIC_FIELD_H
