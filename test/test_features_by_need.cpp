// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases that a tolerance needs: those of parts at any fineness, none of noise; every parameter.
#include "meshes.h"

#include <surety/features_by_need.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace {

using namespace surety::test;
using surety::find_features;
using surety::find_features_by_need;

namespace p = surety::parameters;

using Edge = Mesh::Edge_index;

TEST(Features_by_need, of_a_cube_are_its_edges_at_any_fineness)
{
  for (const int n : {1, 2, 5, 20}) {
    const auto features = find_features_by_need(rotated(cube(n), 1), 0.005);
    EXPECT_EQ(features.ridges, std::size_t(12 * n));
    EXPECT_EQ(features.corners, 8u);
  }
}

TEST(Features_by_need, of_a_cube_are_none_where_the_tolerance_is_larger_than_what_they_stand_out)
{
  EXPECT_EQ(find_features_by_need(cube(4), 0.3).ridges, 0u);
}

TEST(Features_by_need, of_a_cylinder_are_its_rims)
{
  const std::size_t around = 48;
  const Mesh mesh = rotated(cylinder(around, 12), 2);
  EXPECT_EQ(find_features_by_need(mesh, 0.01).ridges, 2 * around);
}

TEST(Features_by_need, survive_noise_below_the_tolerance)
{
  const Mesh mesh = jittered(cube(20), 0.002, 3);
  const auto features = find_features_by_need(mesh, 0.01);
  EXPECT_EQ(features.ridges, 240u);
}

TEST(Features_by_need, of_a_sphere_are_none_with_noise_or_without)
{
  EXPECT_EQ(find_features_by_need(icosphere(4), 0.002).ridges, 0u);
  const Mesh noisy = jittered(icosphere(4), 0.02, 1);
  EXPECT_GT(find_features(noisy, p::feature_angle(40)).ridges, 200u);
  EXPECT_EQ(find_features_by_need(noisy, 0.002).ridges, 0u);
}

TEST(Features_by_need, include_borders_and_what_is_constrained)
{
  Mesh mesh = grid(6);
  EXPECT_EQ(find_features_by_need(mesh, 0.01).borders, 24u);
  EXPECT_EQ(find_features_by_need(mesh, 0.01).corners, 4u);
  EXPECT_EQ(find_features_by_need(mesh, 0.01, p::corner_angle(91)).corners, 0u);
  auto constrained = mesh.add_property_map<Edge, bool>("e:mine", false).first;
  for (const Edge e : mesh.edges()) {
    if (!mesh.is_border(e)) {
      constrained[e] = true;
      break;
    }
  }
  EXPECT_EQ(
      find_features_by_need(mesh, 0.01, p::corner_angle(60).edge_is_constrained_map(constrained))
          .constrained,
      1u);
  auto fixed = mesh.add_property_map<Vertex, bool>("v:mine", false).first;
  fixed[Vertex(24)] = true;
  EXPECT_EQ(
      find_features_by_need(mesh, 0.01, p::corner_angle(60).vertex_is_constrained_map(fixed))
          .corners,
      5u);
}

TEST(Features_by_need, scale_with_the_mesh)
{
  const Mesh mesh = jittered(cube(10), 0.01, 2);
  const auto features = find_features_by_need(mesh, 0.004);
  for (const double s : {0x1p10, 0x1p-10})
    EXPECT_EQ(find_features_by_need(scaled(mesh, s), 0.004 * s).edge, features.edge);
}

TEST(Features_by_need, refuse_a_tolerance_that_is_none)
{
  for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(find_features_by_need(cube(1), bad), surety::Invalid_input);
}

// ---- real models ----

std::size_t ridges_of(const char* name, double relative)
{
  const char* const folder = std::getenv("SURETY_DATA_DIR");
  Mesh mesh;
  if (folder == nullptr
      || !CGAL::IO::read_polygon_mesh(std::string(folder) + "/" + name + ".off", mesh)) {
    return std::size_t(-1);
  }
  const auto box = [&] {
    CGAL::Bbox_3 all;
    for (const Vertex v : mesh.vertices()) all += mesh.point(v).bbox();
    return all;
  }();
  const double diagonal
      = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  return find_features_by_need(mesh, relative * diagonal).ridges;
}

TEST(Features_by_need, of_parts_are_found)
{
  if (ridges_of("fandisk", 0.001) == std::size_t(-1)) GTEST_SKIP() << "no models";
  EXPECT_GE(ridges_of("fandisk", 0.001), 650u);
  EXPECT_EQ(ridges_of("anchor", 0.001), 527u) << "as many as turn by more than 40 degrees";
  EXPECT_GE(ridges_of("anchor_dense", 0.001), 600u);
  EXPECT_GE(ridges_of("couplingdown", 0.001), 700u);
  EXPECT_GE(ridges_of("rotor_small", 0.001), 500u);
}

TEST(Features_by_need, of_scans_are_few)
{
  if (ridges_of("elephant", 0.001) == std::size_t(-1)) GTEST_SKIP() << "no models";
  for (const double relative : {0.01, 0.001, 0.0001}) {
    EXPECT_LE(ridges_of("elephant", relative), 50u);
    EXPECT_LE(ridges_of("bunny00", relative), 50u);
    EXPECT_LE(ridges_of("armadillo", relative), 50u);
  }
}

} // namespace
