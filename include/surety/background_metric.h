// SPDX-License-Identifier: GPL-3.0-or-later
//
// A metric between the vertices where it is known: inside the faces of the mesh that carries it,
// and at points of other meshes of the same surface.
#ifndef SURETY_BACKGROUND_METRIC_H
#define SURETY_BACKGROUND_METRIC_H

#include <surety/internal/metric/face_locator.h>
#include <surety/internal/metric/tensor.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>

#include <CGAL/Named_function_parameters.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace surety {

/// A point of a mesh: a face, and weights of its corners that sum up to 1. The first corner is the
/// source of `halfedge(face, mesh)`, the others follow round the face.
struct Surface_location {
  std::uint32_t face = 0;                             ///< of the mesh
  Eigen::Vector3d weights = Eigen::Vector3d(1, 0, 0); ///< of its corners
};

/// \brief A metric on a mesh that stays as it is while another mesh of the surface changes.
///
/// Inside a face sizes are linear: tensors are interpolated through their inverse square roots, the
/// rule that `Length_rule::linear_size` follows along an edge. Corners of a face contribute the
/// metric of the side that the face belongs to, so that nothing leaks across features.
///
/// The mesh and its points are read at construction and copied.
class Background_metric
{
public:
  using Vector = Eigen::Vector3d; ///< a point or direction
  using Tensor = Eigen::Matrix3d; ///< symmetric, positive definite

  /// \brief Reads a metric off the mesh that it belongs to.
  /// \param mesh a triangle mesh
  /// \param metric of `mesh`
  /// \param np reads `vertex_point_map`
  /// \throws Invalid_input when the metric does not belong to the mesh.
  ///
  /// O(n log n).
  template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
  Background_metric(
      const Mesh& mesh, const Metric_field& metric,
      const NamedParameters& np = CGAL::parameters::default_values())
    : kind_(metric.kind())
  {
    if (metric.sides().of_corner.size() != num_halfedges(mesh)) {
      throw Invalid_input("Background_metric", "metric", "it does not belong to the mesh");
    }
    const auto points = internal::vertex_points(mesh, np);
    std::vector<internal::metric::Located_face> located;
    corners_.resize(num_faces(mesh));
    for (const auto f : faces(mesh)) {
      const auto first = prev(halfedge(f, mesh), mesh);
      internal::metric::Located_face face;
      auto h = first;
      for (int i = 0; i < 3; ++i, h = next(h, mesh)) {
        face.corner[i] = internal::to_vector(get(points, target(h, mesh)));
        corners_[f][i] = metric.side_of_corner(h);
      }
      face.id = static_cast<std::uint32_t>(f);
      located.push_back(face);
    }
    locator_.emplace(std::move(located));
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      if (kind_ == Metric_kind::isotropic) {
        sizes_.push_back(metric.size(s));
      } else {
        size_tensors_.push_back(internal::metric::size_tensor(metric.tensor(s)));
      }
    }
  }

  /// That of the metric.
  Metric_kind kind() const { return kind_; }

  /// The size at a point; of a tensor, the least one of all directions.
  double size(const Surface_location& at) const
  {
    if (kind_ == Metric_kind::anisotropic) return internal::metric::least_size(tensor(at));
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += at.weights[i] * sizes_[corners_[at.face][i]];
    return sum;
  }

  /// The tensor at a point.
  Tensor tensor(const Surface_location& at) const
  {
    if (kind_ == Metric_kind::isotropic) return internal::metric::isotropic_tensor(size(at));
    Tensor sum = Tensor::Zero();
    for (int i = 0; i < 3; ++i) sum += at.weights[i] * size_tensors_[corners_[at.face][i]];
    return internal::metric::metric_of_sizes(sum);
  }

  /// \brief The point of the mesh nearest to a given one, of those whose faces look the same way.
  ///
  /// A face looks the same way when its normal makes less than a right angle with `normal`: where
  /// two sheets are close to each other, they are not mixed up. Where no face does, the nearest one
  /// of all is taken; a normal that is zero means that any face will do.
  Surface_location locate(const Vector& point, const Vector& normal = Vector::Zero()) const
  {
    const internal::metric::Located_point found = locator_->nearest(point, normal);
    return {found.face, found.weights};
  }

private:
  Metric_kind kind_;
  std::vector<std::array<std::uint32_t, 3>> corners_; ///< sides, by face
  std::vector<double> sizes_;                         ///< of an isotropic metric, by side
  std::vector<Tensor> size_tensors_;                  ///< of an anisotropic one: M^(-1/2)
  std::optional<internal::metric::Face_locator> locator_;
};

} // namespace surety

#endif // SURETY_BACKGROUND_METRIC_H
