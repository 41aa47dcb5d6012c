// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface that points are located on, and the correction that gives a field its integral back.
#ifndef SURETY_INTERNAL_TRANSFER_CARRIED_H
#define SURETY_INTERNAL_TRANSFER_CARRIED_H

#include <surety/internal/linear.h>
#include <surety/internal/metric/face_locator.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace surety::internal::transfer {

using metric::Located_point;

/// Points, normals and masses of the vertices of a mesh, by index, and its faces in a tree.
class Surface
{
public:
  template <class Mesh>
  explicit Surface(const Mesh& mesh)
    : point(num_vertices(mesh), Vector::Zero()),
      normal(num_vertices(mesh), Vector::Zero()),
      mass(num_vertices(mesh), 0)
  {
    const auto points = get(CGAL::vertex_point, mesh);
    for (const auto v : vertices(mesh)) {
      vertex.push_back(static_cast<Index>(v));
      point[v] = to_vector(get(points, v));
    }
    std::vector<metric::Located_face> located;
    for (const auto f : faces(mesh)) {
      std::array<Index, 3> corner;
      auto h = halfedge(f, mesh);
      for (int i = 0; i < 3; ++i, h = next(h, mesh))
        corner[i] = static_cast<Index>(target(h, mesh));
      const auto& [a, b, c] = corner;
      const Vector n = (point[b] - point[a]).cross(point[c] - point[a]);
      for (const Index v : corner) {
        normal[v] += n;
        mass[v] += n.norm() / 6;
      }
      located.push_back({{point[a], point[b], point[c]}, Vector::Zero(), Index(corners_.size())});
      corners_.push_back(corner);
    }
    for (Vector& n : normal) n = unit(n);
    locator_.emplace(std::move(located));
  }

  Located_point locate(const Vector& p, const Vector& direction) const
  {
    return locator_->nearest(p, direction);
  }
  const std::array<Index, 3>& corners(const Located_point& at) const { return corners_[at.face]; }

  /// Of a field that is linear in each face; exact, since masses are thirds of the faces' areas.
  double integral(const std::vector<double>& values) const
  {
    double sum = 0;
    for (const Index v : vertex) sum += mass[v] * values[v];
    return sum;
  }
  double area() const { return integral(std::vector<double>(mass.size(), 1)); }

  std::vector<Index> vertex; ///< those that there are
  std::vector<Vector> point, normal;
  std::vector<double> mass;

private:
  std::vector<std::array<Index, 3>> corners_;
  std::optional<metric::Face_locator> locator_;
};

/// The values that the field has round a vertex of the new mesh.
struct Range {
  double low, high;

  void admit(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// \brief Values at the vertices of the new mesh, and ranges for them.
///
/// A value is the linear interpolation of those at the corners of the nearest face that looks the
/// same way, and lies between them.
inline std::vector<double> interpolated(
    const Surface& from, const std::vector<double>& values, const Surface& to,
    std::vector<Range>& ranges)
{
  std::vector<double> result(to.point.size(), 0);
  ranges.assign(result.size(), {0, 0});
  for (const Index v : to.vertex) {
    const Located_point at = from.locate(to.point[v], to.normal[v]);
    const auto& [a, b, c] = from.corners(at);
    Range& range = ranges[v];
    range = {values[a], values[a]};
    range.admit(values[b]);
    range.admit(values[c]);
    const double sum
        = at.weights[0] * values[a] + at.weights[1] * values[b] + at.weights[2] * values[c];
    result[v] = std::clamp(sum, range.low, range.high);
  }
  return result;
}

/// What lies between the vertices of the new mesh counts for the corners of the face where it lies.
inline void admit_values_between(
    const Surface& from, const std::vector<double>& values, const Surface& to,
    std::vector<Range>& ranges)
{
  for (const Index v : from.vertex)
    for (const Index corner : to.corners(to.locate(from.point[v], from.normal[v])))
      ranges[corner].admit(values[v]);
}

/// Moves all values towards one end of their ranges by the same share, such that the integral is
/// what is wanted; by all there is, where that is not enough.
inline void correct(
    const Surface& surface, double wanted, const std::vector<Range>& ranges,
    std::vector<double>& values)
{
  const double missing = wanted - surface.integral(values);
  const auto end = [&](Index v) { return missing > 0 ? ranges[v].high : ranges[v].low; };
  double room = 0;
  for (const Index v : surface.vertex) room += surface.mass[v] * (end(v) - values[v]);
  if (missing == 0 || room == 0) return;
  const double share = std::min(1., missing / room);
  for (const Index v : surface.vertex)
    values[v] = std::clamp(values[v] + share * (end(v) - values[v]), ranges[v].low, ranges[v].high);
}

} // namespace surety::internal::transfer

#endif // SURETY_INTERNAL_TRANSFER_CARRIED_H
