// SPDX-License-Identifier: GPL-3.0-or-later
//
// Named parameters: every one can start, continue and end a chain, and CGAL's functions read the
// chain as their own.
#include <surety/parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <type_traits>

namespace {

namespace p = surety::parameters;
namespace tag = surety::internal;

using CGAL::parameters::choose_parameter;
using CGAL::parameters::get_parameter;
using CGAL::parameters::get_parameter_reference;
using surety::Curvature_method;
using surety::Deviation_bound;
using surety::Effort;
using surety::Length_rule;
using surety::Metric_kind;
using surety::Placement;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Counting_visitor {
  std::size_t calls = 0;
  bool on_progress(const surety::Progress& progress) { return ++calls < progress.faces; }
};

template <class Np, class Tag>
constexpr bool is_absent(const Np&, Tag)
{
  return CGAL::parameters::is_default_parameter<Np, Tag>::value;
}

auto full_chain()
{
  return p::feature_angle(40)
      .corner_angle(50)
      .deviation_bound(Deviation_bound::accumulated)
      .shape_ratio(2)
      .shape_floor(20)
      .roughness_angle(60)
      .allow_self_intersections(true)
      .flip_rounds(7)
      .placement(Placement::free)
      .effort(Effort::best)
      .target_faces(1000)
      .single_precision(true)
      .relative_slack(0.25)
      .maximum_subdivisions(12345)
      .deviation_map(3.5f)
      .metric_kind(Metric_kind::isotropic)
      .metric_tolerance(0.5)
      .relative_gap(0.125)
      .turning_angle(15)
      .gap_constant(0.25)
      .minimum_size(0.01)
      .maximum_size(2.5)
      .maximum_aspect_ratio(7)
      .size_field(4.5f)
      .length_rule(Length_rule::simpson)
      .gradation(1.75)
      .proximity(false)
      .smoothing_rounds(6u)
      .curvature_method(Curvature_method::five_coefficients)
      .noise_floor(0.375);
}

template <class Np>
void expect_full_chain(const Np& np)
{
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::feature_angle), 180.0), 40);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::corner_angle), 60.0), 50);
  EXPECT_EQ(
      choose_parameter(get_parameter(np, tag::deviation_bound), Deviation_bound::direct),
      Deviation_bound::accumulated);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::shape_ratio), 1.0), 2);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::shape_floor), 10.0), 20);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::roughness_angle), 45.0), 60);
  EXPECT_TRUE(choose_parameter(get_parameter(np, tag::allow_self_intersections), false));
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::flip_rounds), 3u), 7u);
  EXPECT_EQ(
      choose_parameter(get_parameter(np, tag::placement), Placement::on_surface), Placement::free);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::effort), Effort::fast), Effort::best);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::target_faces), std::size_t(0)), 1000u);
  EXPECT_TRUE(choose_parameter(get_parameter(np, tag::single_precision), false));
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::relative_slack), 0.01), 0.25);
  EXPECT_EQ(choose_parameter(get_parameter(np, tag::maximum_subdivisions), std::size_t(1)), 12345u);
  EXPECT_EQ(get_parameter(np, tag::deviation_map), 3.5f);
  EXPECT_EQ(get_parameter(np, tag::metric_kind), Metric_kind::isotropic);
  EXPECT_EQ(get_parameter(np, tag::metric_tolerance), 0.5);
  EXPECT_EQ(get_parameter(np, tag::relative_gap), 0.125);
  EXPECT_EQ(get_parameter(np, tag::turning_angle), 15);
  EXPECT_EQ(get_parameter(np, tag::gap_constant), 0.25);
  EXPECT_EQ(get_parameter(np, tag::minimum_size), 0.01);
  EXPECT_EQ(get_parameter(np, tag::maximum_size), 2.5);
  EXPECT_EQ(get_parameter(np, tag::maximum_aspect_ratio), 7);
  EXPECT_EQ(get_parameter(np, tag::size_field), 4.5f);
  EXPECT_EQ(get_parameter(np, tag::length_rule), Length_rule::simpson);
  EXPECT_EQ(get_parameter(np, tag::gradation), 1.75);
  EXPECT_FALSE(get_parameter(np, tag::proximity));
  EXPECT_EQ(get_parameter(np, tag::smoothing_rounds), 6u);
  EXPECT_EQ(get_parameter(np, tag::curvature_method), Curvature_method::five_coefficients);
  EXPECT_EQ(get_parameter(np, tag::noise_floor), 0.375);
}

TEST(Parameters, each_of_a_chain_is_read_back) { expect_full_chain(full_chain()); }

TEST(Parameters, each_can_start_a_chain)
{
  EXPECT_EQ(get_parameter(p::feature_angle(40), tag::feature_angle), 40);
  EXPECT_EQ(get_parameter(p::corner_angle(50), tag::corner_angle), 50);
  EXPECT_EQ(
      get_parameter(p::deviation_bound(Deviation_bound::accumulated), tag::deviation_bound),
      Deviation_bound::accumulated);
  EXPECT_EQ(get_parameter(p::shape_ratio(2), tag::shape_ratio), 2);
  EXPECT_EQ(get_parameter(p::shape_floor(20), tag::shape_floor), 20);
  EXPECT_EQ(get_parameter(p::roughness_angle(60), tag::roughness_angle), 60);
  EXPECT_TRUE(get_parameter(p::allow_self_intersections(true), tag::allow_self_intersections));
  EXPECT_EQ(get_parameter(p::flip_rounds(7), tag::flip_rounds), 7u);
  EXPECT_EQ(get_parameter(p::placement(Placement::free), tag::placement), Placement::free);
  EXPECT_EQ(get_parameter(p::effort(Effort::best), tag::effort), Effort::best);
  EXPECT_EQ(get_parameter(p::target_faces(1000), tag::target_faces), 1000u);
  EXPECT_TRUE(get_parameter(p::single_precision(true), tag::single_precision));
  EXPECT_EQ(get_parameter(p::relative_slack(0.25), tag::relative_slack), 0.25);
  EXPECT_EQ(get_parameter(p::maximum_subdivisions(9), tag::maximum_subdivisions), 9u);
  EXPECT_EQ(get_parameter(p::deviation_map(3.5f), tag::deviation_map), 3.5f);
  EXPECT_EQ(
      get_parameter(p::metric_kind(Metric_kind::isotropic), tag::metric_kind),
      Metric_kind::isotropic);
  EXPECT_EQ(get_parameter(p::metric_tolerance(0.5), tag::metric_tolerance), 0.5);
  EXPECT_EQ(
      get_parameter(p::curvature_method(Curvature_method::adaptive), tag::curvature_method),
      Curvature_method::adaptive);
  EXPECT_EQ(get_parameter(p::noise_floor(0.375), tag::noise_floor), 0.375);
  EXPECT_EQ(get_parameter(p::relative_gap(0.125), tag::relative_gap), 0.125);
  EXPECT_EQ(get_parameter(p::turning_angle(15), tag::turning_angle), 15);
  EXPECT_EQ(get_parameter(p::gap_constant(0.25), tag::gap_constant), 0.25);
  EXPECT_EQ(get_parameter(p::minimum_size(0.01), tag::minimum_size), 0.01);
  EXPECT_EQ(get_parameter(p::maximum_size(2.5), tag::maximum_size), 2.5);
  EXPECT_EQ(get_parameter(p::maximum_aspect_ratio(7), tag::maximum_aspect_ratio), 7);
  EXPECT_EQ(get_parameter(p::size_field(4.5f), tag::size_field), 4.5f);
  EXPECT_EQ(
      get_parameter(p::length_rule(Length_rule::simpson), tag::length_rule), Length_rule::simpson);
  EXPECT_EQ(get_parameter(p::gradation(1.75), tag::gradation), 1.75);
  EXPECT_FALSE(get_parameter(p::proximity(false), tag::proximity));
  EXPECT_EQ(get_parameter(p::smoothing_rounds(6u), tag::smoothing_rounds), 6u);
  EXPECT_EQ(get_parameter(p::target_vertices(900), tag::target_vertices), 900);
  EXPECT_EQ(get_parameter(p::target_error(0.5), tag::target_error), 0.5);
  EXPECT_EQ(get_parameter(p::norm_exponent(3), tag::norm_exponent), 3);
  EXPECT_TRUE(get_parameter(p::conserves(true), tag::conserves));
}

TEST(Parameters, those_of_adaptation_go_on_with_a_chain)
{
  const surety::Background_metric* const none = nullptr;
  const auto np = p::feature_angle(40)
                      .target_vertices(900)
                      .target_error(0.5)
                      .norm_exponent(3)
                      .conserves(true)
                      .background_metric(none);
  EXPECT_EQ(get_parameter(np, tag::target_vertices), 900);
  EXPECT_EQ(get_parameter(np, tag::target_error), 0.5);
  EXPECT_EQ(get_parameter(np, tag::norm_exponent), 3);
  EXPECT_TRUE(get_parameter(np, tag::conserves));
  EXPECT_EQ(get_parameter(np, tag::background_metric), none);
}

TEST(Parameters, chains_go_on_in_any_order_after_cgal_members)
{
  Mesh mesh;
  const auto points = mesh.points();
  Counting_visitor visitor;
  const auto np = p::feature_angle(40)
                      .vertex_point_map(points)
                      .roughness_angle(60)
                      .visitor(std::ref(visitor))
                      .random_seed(5)
                      .number_of_iterations(6)
                      .geom_traits(Kernel())
                      .edge_is_constrained_map(1)
                      .vertex_is_constrained_map(2)
                      .shape_ratio(2);
  EXPECT_EQ(get_parameter(np, tag::feature_angle), 40);
  EXPECT_EQ(get_parameter(np, tag::roughness_angle), 60);
  EXPECT_EQ(get_parameter(np, tag::shape_ratio), 2);
  EXPECT_EQ(get_parameter(np, CGAL::internal_np::random_seed), 5);
  EXPECT_EQ(get_parameter(np, CGAL::internal_np::number_of_iterations), 6);
  EXPECT_EQ(get_parameter(np, CGAL::internal_np::edge_is_constrained), 1);
  EXPECT_EQ(get_parameter(np, CGAL::internal_np::vertex_is_constrained), 2);
  EXPECT_FALSE(is_absent(np, CGAL::internal_np::geom_traits));
  EXPECT_FALSE(is_absent(np, CGAL::internal_np::vertex_point));
  get_parameter_reference(np, CGAL::internal_np::visitor).on_progress({"stage", 0.5, 10});
  EXPECT_EQ(visitor.calls, 1u) << "a visitor passed by std::ref must not be copied";
}

TEST(Parameters, cgal_members_that_we_do_not_read_still_chain)
{
  const auto np = full_chain().verbosity_level(4).do_project(true);
  expect_full_chain(np);
  EXPECT_EQ(get_parameter(np, CGAL::internal_np::verbosity_level), 4);
}

TEST(Parameters, are_absent_from_chains_of_cgal_and_from_the_default)
{
  const auto cgal = CGAL::parameters::random_seed(1).verbosity_level(2);
  const auto none = CGAL::parameters::default_values();
  EXPECT_EQ(choose_parameter(get_parameter(cgal, tag::feature_angle), 180.0), 180);
  EXPECT_EQ(choose_parameter(get_parameter(none, tag::feature_angle), 180.0), 180);
  EXPECT_TRUE(is_absent(none, tag::deviation_map));
  EXPECT_TRUE(is_absent(cgal, tag::deviation_map));
  EXPECT_FALSE(is_absent(full_chain(), tag::deviation_map));
}

TEST(Parameters, self_intersections_mean_the_same_in_both_spellings)
{
  const auto cgal = CGAL::parameters::allow_self_intersections(true);
  EXPECT_TRUE(choose_parameter(get_parameter(cgal, tag::allow_self_intersections), false));
}

TEST(Parameters, the_first_name_of_a_chain_does_not_shadow_a_later_one)
{
  const auto np = p::feature_angle(40).corner_angle(50).feature_angle(30);
  EXPECT_EQ(get_parameter(np, tag::feature_angle), 30);
  EXPECT_EQ(get_parameter(np, tag::corner_angle), 50);
}

TEST(Parameters, cgal_reads_our_chain)
{
  Mesh mesh;
  CGAL::make_tetrahedron(
      Kernel::Point_3(0, 0, 0), Kernel::Point_3(1, 0, 0), Kernel::Point_3(0, 1, 0),
      Kernel::Point_3(0, 0, 1), mesh);
  auto doubled = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:doubled").first;
  for (const auto v : mesh.vertices()) {
    doubled[v] = CGAL::ORIGIN + 2 * (mesh.point(v) - CGAL::ORIGIN);
  }
  const auto np = p::feature_angle(40).vertex_point_map(doubled).shape_ratio(2);
  EXPECT_NEAR(CGAL::to_double(CGAL::Polygon_mesh_processing::volume(mesh, np)), 8.0 / 6, 1e-12);
}

} // namespace
