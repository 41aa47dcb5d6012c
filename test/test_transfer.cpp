// SPDX-License-Identifier: GPL-3.0-or-later
//
// A field on the way from mesh to mesh: second order, within its range, and without loss where that
// is asked for.
#include <surety/transfer.h>

#include "meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surety::test {
namespace {

using Field = Mesh::Property_map<Vertex, double>;

template <class Function>
Field field_on(Mesh& mesh, const Function& u)
{
  const Field field = mesh.add_property_map<Vertex, double>("v:u").first;
  for (const Vertex v : mesh.vertices()) field[v] = u(mesh.point(v));
  return field;
}

Field empty_field(Mesh& mesh) { return mesh.add_property_map<Vertex, double>("v:u", 77.).first; }

double smooth(const Point& p) { return std::sin(3 * p.x()) * std::cos(2 * p.y()) + p.z(); }
double front(const Point& p) { return std::tanh((p.z() - .2) / .05); }

double largest_error(const Mesh& mesh, const Field& field)
{
  double result = 0;
  for (const Vertex v : mesh.vertices())
    result = std::max(result, std::abs(field[v] - smooth(mesh.point(v))));
  return result;
}

class Spheres : public testing::TestWithParam<bool>
{};

TEST_P(Spheres, errors_are_of_second_order)
{
  double before = 0;
  for (const int levels : {2, 3, 4, 5}) {
    Mesh from = icosphere(levels), to = rotated(jittered_sphere(levels, 5), 9);
    const Field field = field_on(from, smooth), result = empty_field(to);
    transfer_solution(from, field, to, result, parameters::conserves(GetParam()));
    const double error = largest_error(to, result);
    if (before > 0) {
      EXPECT_LT(error, before / 3) << levels;
    }
    before = error;
  }
  EXPECT_LT(before, .003);
}

TEST_P(Spheres, no_value_leaves_the_range)
{
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Mesh from = icosphere(3), to = rotated(jittered_sphere(4, seed), seed);
    const Field field = field_on(from, [&](const Point&) { return random.between(-1, 2); });
    const Field result = empty_field(to);
    transfer_solution(from, field, to, result, parameters::conserves(GetParam()));
    const auto [low, high] = std::minmax_element(field.begin(), field.end());
    for (const Vertex v : to.vertices()) {
      EXPECT_GE(result[v], *low);
      EXPECT_LE(result[v], *high);
    }
  }
}

TEST_P(Spheres, constants_stay_constant_and_the_same_mesh_changes_nothing)
{
  Mesh from = icosphere(3), to = rotated(icosphere(2), 4);
  const Field field = field_on(from, [](const Point&) { return 3.25; });
  const Field result = empty_field(to);
  const auto np = parameters::conserves(GetParam());
  transfer_solution(from, field, to, result, np);
  for (const Vertex v : to.vertices()) EXPECT_EQ(result[v], 3.25);

  Mesh same = from;
  const Field there = field_on(same, smooth), back = empty_field(from);
  transfer_solution(same, there, from, back, np);
  for (const Vertex v : from.vertices()) EXPECT_NEAR(back[v], there[v], 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Conserving, Spheres, testing::Bool());

TEST(Transfer, conserves_the_mean_of_a_front)
{
  Mesh from = icosphere(5);
  const Field field = field_on(from, front);
  for (const int levels : {2, 3, 4}) {
    Mesh to = rotated(jittered_sphere(levels, 3), 8);
    const Field result = empty_field(to);
    const auto plain = transfer_solution(from, field, to, result);
    EXPECT_GT(std::abs(plain.residual()), 1e-6) << levels;
    const auto kept = transfer_solution(from, field, to, result, parameters::conserves(true));
    EXPECT_LT(std::abs(kept.residual()), 1e-13) << levels;
    // The report tells the truth: integrals of linear functions by the faces.
    double integral = 0, area = 0;
    for (const Face f : to.faces()) {
      const auto h = to.halfedge(f);
      const Vertex a = to.source(h), b = to.target(h), c = to.target(to.next(h));
      const double size = std::sqrt(CGAL::squared_area(to.point(a), to.point(b), to.point(c)));
      area += size;
      integral += size * (result[a] + result[b] + result[c]) / 3;
    }
    EXPECT_NEAR(kept.integral_after, integral, 1e-11);
    EXPECT_NEAR(kept.area_after, area, 1e-11);
    EXPECT_NEAR(integral / area, kept.mean_before(), 1e-12);
  }
}

TEST(Transfer, reports_what_its_range_does_not_let_it_keep)
{
  // A peak in the middle of a face of the new mesh, far from every vertex of it: the values round
  // the face are admitted to its corners, so that it can be kept.
  Mesh from = subdivided(icosphere(0), 4), to = icosphere(0);
  const Field field = field_on(from, [](const Point&) { return 0.; });
  const Field result = empty_field(to);
  const Point a = to.point(Vertex(0)), b = to.point(Vertex(1));
  Vertex nearest(0);
  for (const Vertex v : from.vertices())
    if (CGAL::squared_distance(from.point(v), CGAL::midpoint(a, b))
        < CGAL::squared_distance(from.point(nearest), CGAL::midpoint(a, b)))
      nearest = v;
  field[nearest] = 1;
  const auto plain = transfer_solution(from, field, to, result);
  EXPECT_LT(plain.residual(), 0);
  const auto kept = transfer_solution(from, field, to, result, parameters::conserves(true));
  EXPECT_NEAR(kept.residual(), 0, 1e-15);

  // Where the new mesh covers only a part of the old one, the range near its end is not enough.
  Mesh half = grid(4), other = translated(grid(4), Vector(.5, 0, 0));
  const Field left = field_on(half, [](const Point& p) { return p.x() < .6 ? 1. : 0.; });
  const Field right = empty_field(other);
  const auto lost = transfer_solution(half, left, other, right, parameters::conserves(true));
  EXPECT_NEAR(lost.mean_before(), .625, 1e-12);
  EXPECT_LT(lost.residual(), -.2);
  EXPECT_LE(*std::max_element(right.begin(), right.end()), 1.);
  EXPECT_GE(*std::min_element(right.begin(), right.end()), 0.);
}

TEST(Transfer, does_not_mix_thin_sheets)
{
  // Two squares, back to back, at a distance far below the size of the faces.
  const auto sheets = [](std::size_t n, double z) {
    return joined({translated(grid(n), Vector(0, 0, z)), reversed(grid(n))});
  };
  Mesh from = sheets(5, 1e-3), to = mapped(sheets(7, 1e-3), [](const Point&p) {
                                 // Nearer to the other sheet than to its own.
                                 return Point(p.x(), p.y(), p.z() > 0 ? 4e-4 : 6e-4);
                               });
  const Field field = field_on(from, [](const Point& p) { return p.z() > 0 ? 1. : -1.; });
  const Field result = empty_field(to);
  transfer_solution(from, field, to, result);
  for (const Vertex v : to.vertices()) EXPECT_EQ(result[v], to.point(v).z() < 5e-4 ? 1. : -1.);
}

TEST(Transfer, does_not_depend_on_units)
{
  for (const int exponent : {10, -10}) {
    const double unit = std::ldexp(1., exponent);
    Mesh from = icosphere(3), to = rotated(icosphere(3), 2);
    Mesh from2 = scaled(from, unit), to2 = scaled(to, unit);
    const Field a = field_on(from, smooth), result = empty_field(to);
    const Field b = field_on(from2, [](const Point&) { return 0.; }), result2 = empty_field(to2);
    for (const Vertex v : from.vertices()) b[v] = a[v];
    transfer_solution(from, a, to, result, parameters::conserves(true));
    transfer_solution(from2, b, to2, result2, parameters::conserves(true));
    for (const Vertex v : to.vertices()) EXPECT_EQ(result[v], result2[v]);
  }
}

TEST(Transfer, refuses_bad_input)
{
  Mesh from = icosphere(1), to = icosphere(2), empty;
  const Field field = field_on(from, smooth), result = empty_field(to), none = empty_field(empty);
  EXPECT_THROW(transfer_solution(from, field, empty, none), Invalid_input);
  EXPECT_THROW(transfer_solution(empty, none, to, result), Invalid_input);
  field[Vertex(3)] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(transfer_solution(from, field, to, result), Invalid_input);
}

} // namespace
} // namespace surety::test
