// SPDX-License-Identifier: GPL-3.0-or-later
#include "support.h"

#include "colors.h"
#include "ply.h"
#include "vtp.h"

#include <surety/support_tessellation.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

namespace surety::tool {
namespace {

using Vector = Eigen::Vector3d;

/// Where the light of the isophotes comes from: no axis, so that it singles out no face of a part.
const Vector light = Vector(1, 2, 3).normalized();
constexpr double pairs_of_stripes = 24; // from the light to the opposite side

/// The arrays of the points, in the order of the tessellation.
class Point_data
{
public:
  Point_data(const Geometric_support& support, const Mesh& mesh) : support_(support), mesh_(mesh) {}

  void add(const Support_location& at, const Vector& position)
  {
    const Vector normal = support_.normal(at);
    const Side_curvature curvature = support_.curvature(at);
    const double cosine = std::clamp(normal.dot(light), -1., 1.);
    const double moved = (position - flat_point(at)).norm();
    const double half_tolerance = support_.report().tolerance / 2;
    stripes_.values.push_back(std::cos(2 * pairs_of_stripes * std::acos(cosine)));
    isophote_.values.push_back(cosine);
    normal_.values.insert(normal_.values.end(), {normal.x(), normal.y(), normal.z()});
    least_.values.push_back(curvature.min_curvature);
    largest_.values.push_back(curvature.max_curvature);
    displacement_.values.push_back(moved);
    spent_.values.push_back(moved / half_tolerance);
  }

  std::vector<Vtp_array> arrays() const
  {
    return {stripes_, isophote_, normal_, least_, largest_, displacement_, spent_};
  }
  const std::vector<double>& stripes() const { return stripes_.values; }

private:
  Vector flat_point(const Support_location& at) const
  {
    const auto corners = support_.corners(at.face);
    Vector sum = Vector::Zero();
    for (int i = 0; i < 3; ++i) {
      const Point& p = mesh_.point(Mesh::Vertex_index(corners[std::size_t(i)]));
      sum += at.barycentric[i] * Vector(p.x(), p.y(), p.z());
    }
    return sum;
  }

  const Geometric_support& support_;
  const Mesh& mesh_;
  Vtp_array stripes_{"stripes", 1, {}}, isophote_{"isophote", 1, {}}, normal_{"normal", 3, {}},
      least_{"min_curvature", 1, {}}, largest_{"max_curvature", 1, {}},
      displacement_{"displacement", 1, {}}, spent_{"spent", 1, {}};
};

/// The arrays of the triangles: the face of the input, and what became of its patch.
std::vector<Vtp_array> face_data(
    const Geometric_support& support, const Support_tessellation& pieces)
{
  Vtp_array face{"face", 1, {}, true}, saturates{"may_saturate", 1, {}, true},
      refused{"is_refused", 1, {}, true}, tangent{"is_tangent", 1, {}, true};
  for (const auto& triangle : pieces.triangle) {
    const auto f = pieces.location[triangle[0]].face;
    const Patch_state& state = support.patch_state(f);
    face.values.push_back(f);
    saturates.values.push_back(state.may_saturate);
    refused.values.push_back(state.is_refused);
    tangent.values.push_back(state.is_tangent);
  }
  return {face, saturates, refused, tangent};
}

} // namespace

void write_support(
    std::ostream& stream, const std::string& extension, const Mesh& mesh,
    const Geometric_support& support, std::size_t subdivisions)
{
  const Support_tessellation pieces = tessellate(support, subdivisions);
  Mesh drawn;
  Point_data data(support, mesh);
  for (const Support_location& at : pieces.location) {
    const Vector p = support.position(at);
    drawn.add_vertex(Point(p.x(), p.y(), p.z()));
    data.add(at, p);
  }
  for (const auto& [a, b, c] : pieces.triangle) {
    drawn.add_face(
        Mesh::Vertex_index(Mesh::size_type(a)), Mesh::Vertex_index(Mesh::size_type(b)),
        Mesh::Vertex_index(Mesh::size_type(c)));
  }
  stream.precision(17);
  if (extension == "vtp")
    write_vtp(stream, drawn, data.arrays(), face_data(support, pieces), "stripes");
  if (extension == "ply") {
    std::vector<CGAL::IO::Color> colors;
    for (const double stripe : data.stripes()) colors.push_back(diverging(stripe));
    write_colored_ply(stream, drawn, colors, data.arrays());
  }
}

} // namespace surety::tool
