// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coverings: records for meshes whose distance is known, and what must be refused.
#include <surety/covering_certificate.h>
#include <surety/distance.h>

#include "meshes.h"
#include "polyhedra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

namespace {

using namespace surety::test;
using surety::certify_distance;
using surety::check_covering;
using surety::Covering;
using surety::Covering_check;
using surety::hausdorff_distance;
using surety::Invalid_input;
using surety::make_covering;
using surety::read_covering;
using surety::write_covering;

/// The record, which must exist and hold.
Covering expect_proof(const Mesh& a, const Mesh& b, double tolerance)
{
  const auto covering = make_covering(a, b, tolerance);
  EXPECT_TRUE(covering) << "no record was found";
  if (!covering) return {};
  EXPECT_EQ(covering->tolerance, tolerance);
  EXPECT_LE(covering->bound, tolerance);
  const Covering_check check = check_covering(a, b, *covering);
  EXPECT_TRUE(check.holds) << check.reason;
  EXPECT_LE(check.bound, covering->bound);
  EXPECT_EQ(check.face_bounds.size(), b.number_of_faces());
  EXPECT_TRUE(certify_distance(a, b, check.bound * (1 + 1e-6)).holds());
  return *covering;
}

TEST(Covering, of_a_mesh_by_itself_is_each_face_by_one)
{
  const Mesh mesh = torus(24, 12);
  const Covering covering = expect_proof(mesh, mesh, 1e-3);
  EXPECT_EQ(covering.of_input.witnesses.size(), mesh.number_of_faces());
  EXPECT_LT(covering.bound, 2e-12) << "only rounding";
}

TEST(Covering, proves_the_distance_of_parallel_sheets)
{
  const Mesh low = grid(7), high = translated(grid(5), Vector(0, 0, 0.25));
  const Covering covering = expect_proof(low, high, 0.2501);
  EXPECT_GE(check_covering(low, high, covering).bound, 0.25);
  EXPECT_FALSE(make_covering(low, high, 0.2499));
}

TEST(Covering, serves_faces_of_any_size)
{
  const Mesh coarse = icosphere(2), fine = icosphere(5);
  const double gap = hausdorff_distance(coarse, fine, 1e-6).upper();
  expect_proof(coarse, fine, 1.01 * gap);
  expect_proof(fine, coarse, 1.01 * gap);
  EXPECT_FALSE(make_covering(fine, coarse, 0.99 * gap));
}

TEST(Covering, looks_both_ways)
{
  // A needle that is thinner than the tolerance and longer.
  const Mesh body = cube(3);
  const Mesh needle = translated(scaled(cube(), 0.01, 0.01, 2), Vector(0.5, 0.5, 0.5));
  EXPECT_FALSE(make_covering(joined({body, needle}), body, 0.05));
  EXPECT_FALSE(make_covering(body, joined({body, needle}), 0.05));
  expect_proof(joined({body, body}), body, 0.05);
}

TEST(Covering, counts_borders)
{
  const Mesh whole = grid(8);
  const Mesh part = scaled(whole, 0.9, 1, 1);
  EXPECT_FALSE(make_covering(whole, part, 0.09));
  expect_proof(whole, part, 0.11);
}

TEST(Covering, scales_with_the_meshes)
{
  const Mesh a = torus(20, 10), b = jittered(a, 0.01, 1);
  for (const double scale : {0x1p-300, 0x1p-10, 1., 0x1p10, 0x1p300}) {
    const Mesh large_a = scaled(a, scale), large_b = scaled(b, scale);
    const auto covering = make_covering(large_a, large_b, 0.05 * scale);
    ASSERT_TRUE(covering) << scale;
    const Covering_check check = check_covering(large_a, large_b, *covering);
    EXPECT_TRUE(check.holds) << scale << ": " << check.reason;
  }
}

TEST(Covering, comes_back_from_a_file_as_it_was)
{
  const Mesh a = icosphere(1), b = icosphere(4);
  const auto covering = make_covering(a, b, 0.2);
  ASSERT_TRUE(covering);
  std::stringstream file;
  write_covering(file, *covering);
  const Covering read = read_covering(file);
  EXPECT_EQ(read.tolerance, covering->tolerance);
  EXPECT_EQ(read.bound, covering->bound);
  EXPECT_EQ(read.of_input.first, covering->of_input.first);
  EXPECT_EQ(read.of_input.witnesses, covering->of_input.witnesses);
  EXPECT_EQ(read.of_output.first, covering->of_output.first);
  EXPECT_EQ(read.of_output.witnesses, covering->of_output.witnesses);
}

TEST(Covering, of_other_meshes_does_not_hold)
{
  const Mesh a = torus(20, 10), b = jittered(a, 0.01, 1);
  const auto covering = make_covering(a, b, 0.05);
  ASSERT_TRUE(covering);
  EXPECT_FALSE(check_covering(a, translated(b, Vector(0, 0, 0.06)), *covering).holds);
  EXPECT_FALSE(check_covering(translated(a, Vector(0, 0, 0.06)), b, *covering).holds);
  EXPECT_FALSE(check_covering(a, torus(21, 10), *covering).holds);
  Mesh dented = b;
  dented.point(Vertex(7)) = Point(0, 0, 0);
  EXPECT_FALSE(check_covering(a, dented, *covering).holds);
}

TEST(Covering, with_a_wrong_record_does_not_hold)
{
  const Mesh a = torus(20, 10), b = jittered(a, 0.01, 1);
  const auto made = make_covering(a, b, 0.05);
  ASSERT_TRUE(made);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(Covering&)> mutations[]
      = {[](Covering& c) { c.of_input.witnesses[5] = 0xffffffff; },
         [](Covering& c) { c.of_output.witnesses[5] = c.of_output.witnesses[200]; },
         [](Covering& c) { c.of_input.witnesses.pop_back(); },
         [](Covering& c) { c.of_input.first.pop_back(); },
         [](Covering& c) { c.of_output.first.clear(); },
         [](Covering& c) { c.of_output.first[3] = c.of_output.first[2]; },
         [](Covering& c) { std::swap(c.of_output.first[3], c.of_output.first[5]); },
         [](Covering& c) { c.bound /= 2; },
         [](Covering& c) { c.bound = -1; },
         [=](Covering& c) { c.bound = nan; },
         [=](Covering& c) { c.tolerance = nan; },
         [](Covering& c) { c.tolerance = c.bound / 2; }};
  for (std::size_t i = 0; i < std::size(mutations); ++i) {
    Covering covering = *made;
    mutations[i](covering);
    const Covering_check check = check_covering(a, b, covering);
    EXPECT_FALSE(check.holds) << "mutation " << i;
    EXPECT_FALSE(check.reason.empty());
    EXPECT_TRUE(check.face_bounds.empty());
  }
}

TEST(Covering, in_a_damaged_file_is_refused_by_line)
{
  const Mesh a = icosphere(1);
  const auto covering = make_covering(a, a, 0.1);
  ASSERT_TRUE(covering);
  std::stringstream file;
  write_covering(file, *covering);
  const std::string text = file.str();
  const auto refusal = [](const std::string& damaged) {
    std::istringstream stream(damaged);
    try {
      read_covering(stream);
    } catch (const Invalid_input& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (std::size_t length = 0; length + 1 < text.size(); length += 37)
    EXPECT_NE(refusal(text.substr(0, length)), "") << length;
  EXPECT_NE(refusal("surety-covering 2" + text.substr(17)).find("line 1"), std::string::npos);
  EXPECT_NE(refusal("surety-certificate 1" + text.substr(17)).find("line 1"), std::string::npos);
  std::string number = text;
  number.replace(number.find("input 80") + 6, 2, "4000000000");
  EXPECT_NE(refusal(number), "");
  std::string sign = text;
  sign.replace(sign.find("0x"), 2, "-0x");
  EXPECT_NE(refusal(sign).find("line 2"), std::string::npos);
}

TEST(Covering, asks_for_triangles_and_a_tolerance)
{
  const Mesh mesh = cube();
  EXPECT_THROW(make_covering(mesh, mesh, 0), Invalid_input);
  EXPECT_THROW(make_covering(mesh, mesh, -1), Invalid_input);
  EXPECT_THROW(make_covering(mesh, Mesh(), 1), Invalid_input);
  Mesh quad;
  quad.add_face(
      quad.add_vertex(Point(0, 0, 0)), quad.add_vertex(Point(1, 0, 0)),
      quad.add_vertex(Point(1, 1, 0)), quad.add_vertex(Point(0, 1, 0)));
  EXPECT_THROW(make_covering(mesh, quad, 1), Invalid_input);
  Covering bad;
  bad.of_input.first = {0, 3};
  std::ostringstream file;
  EXPECT_THROW(write_covering(file, bad), Invalid_input);
}

} // namespace
