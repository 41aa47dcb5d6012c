// SPDX-License-Identifier: GPL-3.0-or-later
//
// One call of make_geometric_mesh with all that belongs to it, and the claims that hold for every
// such call. Each claim is checked against something that shares no code with the simplification:
// the certificate checker, the distance verifier, sampled distances, CGAL.
#ifndef SURETY_TEST_SIMPLIFICATION_H
#define SURETY_TEST_SIMPLIFICATION_H

#include <surety/distance.h>
#include <surety/geometric_mesh.h>

#include "invariants.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace surety::test {

/// Where the vertices of a result lie: what the bound, the placement and the effort promise.
enum class Vertices { of_input, on_input, anywhere };

template <class NamedParameters>
Vertices promised_vertices(const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  namespace defaults = surety::internal::defaults;
  const auto bound = choose_parameter(
      get_parameter(np, surety::internal::deviation_bound), defaults::deviation_bound);
  const auto placement
      = choose_parameter(get_parameter(np, surety::internal::placement), defaults::placement);
  const auto effort
      = choose_parameter(get_parameter(np, surety::internal::effort), defaults::effort);
  // The accumulated bound has no operation that moves vertices.
  if (bound == Deviation_bound::accumulated) return Vertices::of_input;
  if (placement == Placement::free) return Vertices::anywhere;
  const auto sweeps = choose_parameter(
      get_parameter(np, surety::internal::smoothing_sweeps), defaults::smoothing_sweeps);
  if (effort == Effort::fast && sweeps == 0) return Vertices::of_input;
  // Few points of a face have single-precision coordinates.
  return choose_parameter(get_parameter(np, surety::internal::single_precision), false)
      ? Vertices::anywhere
      : Vertices::on_input;
}

/// The parameters that choose the operations; the rest are controls of quality.
struct Method {
  const char* name;
  Placement placement;
  Effort effort;
  Deviation_bound bound = Deviation_bound::direct;
};

inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

inline auto parameters_of(const Method& method)
{
  return surety::parameters::deviation_bound(method.bound)
      .placement(method.placement)
      .effort(method.effort);
}

inline const Method on_surface_fast{"on_surface_fast", Placement::on_surface, Effort::fast},
    on_surface{"on_surface", Placement::on_surface, Effort::standard},
    on_surface_best{"on_surface_best", Placement::on_surface, Effort::best},
    free_fast{"free_fast", Placement::free, Effort::fast},
    free_standard{"free", Placement::free, Effort::standard},
    free_best{"free_best", Placement::free, Effort::best},
    accumulated{
        "accumulated", Placement::on_surface, Effort::standard, Deviation_bound::accumulated};

struct Simplification {
  Mesh input, output;
  Certificate certificate;
  Vertices vertices = Vertices::on_input;
};

template <class NamedParameters = CGAL::parameters::Default_named_parameters>
Simplification simplified(
    const Mesh& input, double tolerance,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  Mesh output = input;
  Certificate certificate = make_geometric_mesh(output, tolerance, np);
  return {input, std::move(output), std::move(certificate), promised_vertices(np)};
}

inline double diagonal(const Mesh& mesh)
{
  CGAL::Bbox_3 box;
  for (const Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

inline double largest_coordinate(const Mesh& mesh)
{
  double largest = 0;
  for (const Vertex v : mesh.vertices())
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(mesh.point(v)[i]));
  return largest;
}

/// What rounding may add to a sampled distance.
inline double sampling_error(const Mesh& mesh) { return 1e-12 * largest_coordinate(mesh); }

/// The bounds of the faces in iteration order.
inline std::vector<double> deviations(const Mesh& mesh)
{
  const auto [map, exists] = mesh.property_map<Face, double>("f:deviation");
  std::vector<double> result;
  if (exists)
    for (const Face f : mesh.faces()) result.push_back(map[f]);
  return result;
}

/// Vertices on the input, those of borders at vertices of the input; free ones are a matter of the
/// distance.
inline void expect_vertices_in_place(const Simplification& s)
{
  if (s.vertices == Vertices::anywhere) return;
  std::set<Point> points;
  for (const Vertex v : s.input.vertices()) points.insert(s.input.point(v));
  const Closest_triangle input(s.input);
  const double rounding = 1e-14 * std::max(diagonal(s.input), largest_coordinate(s.input));
  for (const Vertex v : s.output.vertices()) {
    const Point& p = s.output.point(v);
    if (points.count(p) == 1) continue;
    EXPECT_NE(s.vertices, Vertices::of_input) << v << " at " << p << " is no vertex of the input";
    EXPECT_FALSE(s.output.is_border(v)) << v << " at " << p << " is no vertex of the input";
    EXPECT_LE(input.distance(p), rounding) << v << " at " << p << " is not on the input";
  }
}

inline void expect_sound_mesh(const Simplification& s)
{
  EXPECT_FALSE(s.output.has_garbage());
  EXPECT_TRUE(is_sound(s.output));
  EXPECT_EQ(topological_type(s.output), topological_type(s.input));
  EXPECT_LE(s.output.number_of_faces(), s.input.number_of_faces());
  expect_vertices_in_place(s);
}

inline void expect_no_new_intersections(const Simplification& s)
{
  const std::size_t after = number_of_self_intersections(s.output);
  const std::size_t before = after == 0 ? 0 : number_of_self_intersections(s.input);
  EXPECT_LE(after, before);
}

/// Each sampled point of a face lies within the bound of the face, and the bounds are what the
/// certificate says.
inline void expect_sound_deviations(const Simplification& s, int cuts)
{
  const std::vector<double> bounds = deviations(s.output);
  ASSERT_EQ(bounds.size(), s.output.number_of_faces());
  EXPECT_EQ(*std::max_element(bounds.begin(), bounds.end()), s.certificate.bound());

  const Closest_triangle closest(s.input);
  const double error = sampling_error(s.input);
  const Soup soup = to_soup(s.output);
  for (std::size_t f = 0; f < bounds.size(); ++f) {
    const Point a = soup.points[soup.triangles[f][0]];
    const Vector u = soup.points[soup.triangles[f][1]] - a,
                 v = soup.points[soup.triangles[f][2]] - a;
    EXPECT_GE(bounds[f], 0);
    double largest = 0;
    for (int i = 0; i <= 2 * cuts; ++i)
      for (int j = 0; i + j <= 2 * cuts; ++j)
        largest = std::max(largest, closest.distance(a + 0.5 * i / cuts * u + 0.5 * j / cuts * v));
    EXPECT_LE(largest, bounds[f] + error) << "face " << f << " of the output";
  }
  EXPECT_LE(sampled_distance_to(s.input, s.output, 1, cuts), s.certificate.bound() + error);
}

inline void expect_proof(const Simplification& s)
{
  EXPECT_TRUE(s.certificate.holds())
      << s.certificate.bound() << " for " << s.certificate.tolerance();
  if (!s.certificate.correspondence()) return;
  const Certificate_check check = check_certificate(s.input, s.output, s.certificate);
  EXPECT_TRUE(check.holds) << check.reason;
  EXPECT_LE(check.bound, s.certificate.tolerance());
}

/// The verifier knows the two meshes only. It may leave undecided what is as close as rounding.
inline void expect_verified_distance(const Simplification& s)
{
  const double bound = std::max(s.certificate.bound() * (1 + 1e-3), 1e-12 * diagonal(s.input));
  const auto proof = certify_distance(s.input, s.output, bound);
  EXPECT_TRUE(proof.holds()) << bound << (proof.refuted() ? ": refuted" : ": undecided");
}

inline void expect_sound(const Simplification& s, int cuts = 2)
{
  expect_sound_mesh(s);
  expect_no_new_intersections(s);
  expect_proof(s);
  expect_sound_deviations(s, cuts);
}

/// Same points in the same order, same faces starting at the same corners.
inline bool is_identical(const Mesh& a, const Mesh& b)
{
  const Soup x = to_soup(a), y = to_soup(b);
  return x.points == y.points && x.triangles == y.triangles;
}

/// The same, wherever the faces start.
inline bool have_same_faces(const Mesh& a, const Mesh& b)
{
  Soup x = to_soup(a), y = to_soup(b);
  for (Soup* soup : {&x, &y})
    for (auto& t : soup->triangles)
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return x.points == y.points && x.triangles == y.triangles;
}

/// Everything that a mesh consists of, garbage and the names of its properties included: two equal
/// fingerprints mean that nothing was touched.
inline std::vector<std::string> fingerprint(const Mesh& mesh)
{
  std::vector<std::string> lines;
  const auto names = [&](auto properties) {
    std::string line;
    for (const std::string& name : properties) line += name + ' ';
    lines.push_back(line);
  };
  names(mesh.properties<Vertex>());
  names(mesh.properties<Mesh::Halfedge_index>());
  names(mesh.properties<Mesh::Edge_index>());
  names(mesh.properties<Face>());
  for (Mesh::size_type i = 0; i < mesh.num_vertices(); ++i) {
    const Vertex v(i);
    const Point& p = mesh.point(v);
    const double coordinates[3] = {p.x(), p.y(), p.z()};
    std::string line(sizeof coordinates, '\0'); // bit by bit: NaN equals itself
    std::memcpy(line.data(), coordinates, sizeof coordinates);
    lines.push_back(
        line + std::to_string(mesh.halfedge(v)) + (mesh.is_removed(v) ? " removed" : ""));
  }
  for (Mesh::size_type i = 0; i < mesh.num_halfedges(); ++i) {
    const Mesh::Halfedge_index h(i);
    lines.push_back(
        std::to_string(mesh.next(h)) + ' ' + std::to_string(mesh.prev(h)) + ' '
        + std::to_string(mesh.target(h)) + ' ' + std::to_string(mesh.face(h))
        + (mesh.is_removed(h) ? " removed" : ""));
  }
  for (Mesh::size_type i = 0; i < mesh.num_faces(); ++i) {
    const Face f(i);
    lines.push_back(std::to_string(mesh.halfedge(f)) + (mesh.is_removed(f) ? " removed" : ""));
  }
  return lines;
}

// ---- input ----

/// The same vertices, other faces: random flips of interior edges that leave both faces with area
/// and turn the surface by less than a right angle.
inline Mesh flipped_at_random(Mesh mesh, std::size_t tries, std::uint64_t seed)
{
  Random random(seed);
  for (; tries > 0; --tries) {
    const Mesh::Halfedge_index h(Mesh::size_type(random.below(mesh.number_of_halfedges())));
    const auto o = mesh.opposite(h);
    if (mesh.is_border(h) || mesh.is_border(o)) continue;
    const Vertex a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)),
                 d = mesh.target(mesh.next(o));
    if (mesh.halfedge(c, d) != Mesh::null_halfedge()) continue;
    const auto normal = [&](Vertex i, Vertex j, Vertex k) {
      return CGAL::cross_product(mesh.point(j) - mesh.point(i), mesh.point(k) - mesh.point(i));
    };
    const Vector m = normal(c, a, d), n = normal(d, b, c), old = normal(a, b, c);
    const auto cosine = [](const Vector& x, const Vector& y) {
      return x * y / std::sqrt(x.squared_length() * y.squared_length());
    };
    if (!(cosine(m, n) > 0.1 && cosine(m, old) > 0.1 && m.squared_length() > 1e-14
          && n.squared_length() > 1e-14))
      continue;
    CGAL::Euler::flip_edge(h, mesh);
  }
  return mesh;
}

// ---- curves ----

struct Segment {
  Point source, target;
};
using Curves = std::vector<Segment>;

template <class Predicate>
Curves curves_where(const Mesh& mesh, const Predicate& is_wanted)
{
  Curves result;
  for (const auto e : mesh.edges())
    if (is_wanted(e))
      result.push_back({mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))});
  return result;
}

inline Curves border_curves(const Mesh& mesh)
{
  return curves_where(mesh, [&](auto e) { return mesh.is_border(e); });
}

/// The angle by which the surface turns at an edge, in degrees; 0 on the border.
inline double dihedral_turn(const Mesh& mesh, Mesh::Edge_index e)
{
  if (mesh.is_border(e)) return 0;
  const auto normal = [&](Mesh::Halfedge_index h) {
    const Vector n = CGAL::normal(
        mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
        mesh.point(mesh.target(mesh.next(h))));
    return n / std::sqrt(n.squared_length());
  };
  const auto h = mesh.halfedge(e);
  const Vector m = normal(h), n = normal(mesh.opposite(h));
  const Vector c = CGAL::cross_product(m, n);
  return std::atan2(std::sqrt(c.squared_length()), m * n) * 180 / pi;
}

inline Curves sharp_curves(const Mesh& mesh, double angle)
{
  return curves_where(mesh, [&](auto e) { return dihedral_turn(mesh, e) > angle; });
}

inline double distance_to_curves(const Point& p, const Curves& curves)
{
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : curves) {
    const Vector ab = b - a;
    const double t = std::clamp((p - a) * ab / ab.squared_length(), 0.0, 1.0);
    best = std::min(best, (p - (a + t * ab)).squared_length());
  }
  return std::sqrt(best);
}

/// Two-sided, sampled.
inline double curve_distance(const Curves& a, const Curves& b)
{
  const auto one_way = [](const Curves& from, const Curves& to) {
    double largest = 0;
    for (const auto& [p, q] : from)
      for (int i = 0; i <= 6; ++i)
        largest = std::max(largest, distance_to_curves(p + i / 6.0 * (q - p), to));
    return largest;
  };
  return std::max(one_way(a, b), one_way(b, a));
}

inline bool has_vertex_at(const Mesh& mesh, const Point& p)
{
  return std::any_of(
      mesh.vertices_begin(), mesh.vertices_end(), [&](Vertex v) { return mesh.point(v) == p; });
}

} // namespace surety::test

#endif // SURETY_TEST_SIMPLIFICATION_H
