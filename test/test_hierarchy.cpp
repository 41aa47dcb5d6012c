// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of detail: each is proven against the input, by the certificate checker and by the
// verifier that knows the two meshes only; what is extracted between two levels is what its
// tolerance says; and the record survives a file, and whatever is done to the file.
#include <surety/hierarchy.h>

#include "simplification.h"

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <sstream>

namespace {

using namespace surety::test;
using surety::certify_distance;
using surety::Effort;
using surety::Hierarchy;
using surety::Hierarchy_record;
using surety::Invalid_input;
using surety::make_hierarchy;
using surety::Placement;
namespace with = surety::parameters;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Faces of every size, so that each tolerance leaves another number of them.
Mesh bumpy_sphere()
{
  return mapped(icosphere(4), [](const Point& p) {
    const double r
        = 1 + 0.08 * std::sin(5 * p.x() + 2 * p.y()) + 0.03 * std::sin(11 * p.y() - 7 * p.z());
    return CGAL::ORIGIN + r * (p - CGAL::ORIGIN);
  });
}

Mesh wavy_sheet()
{
  return jittered(
      height_field(24, [](double x, double y) { return 0.1 * std::sin(4 * x) * std::cos(3 * y); }),
      0.008, 3);
}

const std::vector<double> four_tolerances = {0.002, 0.008, 0.03, 0.1};

void expect_level(const Mesh& input, const surety::Hierarchy_level<Mesh>& level)
{
  const Simplification s{input, level.mesh, level.certificate};
  EXPECT_FALSE(s.output.has_garbage());
  EXPECT_TRUE(is_sound(s.output));
  EXPECT_EQ(topological_type(s.output), topological_type(input));
  expect_no_new_intersections(s);
  expect_proof(s);
  expect_verified_distance(s);
  const auto bounds = deviations(level.mesh);
  ASSERT_EQ(bounds.size(), level.mesh.number_of_faces());
  EXPECT_LE(*std::max_element(bounds.begin(), bounds.end()), level.certificate.bound());
}

void expect_sound_hierarchy(
    const Mesh& input, const Hierarchy<Mesh>& hierarchy, const std::vector<double>& tolerances)
{
  ASSERT_EQ(hierarchy.levels().size(), tolerances.size());
  EXPECT_FALSE(hierarchy.is_cancelled());
  std::size_t faces = input.number_of_faces();
  double bound = 0;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    const auto& level = hierarchy.levels()[i];
    EXPECT_EQ(level.certificate.tolerance(), tolerances[i]);
    EXPECT_LE(level.mesh.number_of_faces(), faces);
    EXPECT_GE(level.certificate.bound(), bound);
    faces = level.mesh.number_of_faces();
    bound = level.certificate.bound();
    expect_level(input, level);
  }
}

void expect_levels_are_extracted(const Hierarchy<Mesh>& hierarchy)
{
  const auto& record = hierarchy.record();
  for (std::size_t i = 0; i < record.levels.size(); ++i) {
    const auto found = hierarchy.extract(record.levels[i].operations);
    EXPECT_EQ(found.operations, record.levels[i].operations);
    EXPECT_TRUE(is_identical(found.mesh, hierarchy.levels()[i].mesh)) << "level " << i;
    EXPECT_LE(found.tolerance, record.levels[i].tolerance);
  }
}

/// Between levels too, what is extracted is a mesh within the tolerance that it comes with.
void expect_extractions_are_sound(const Hierarchy<Mesh>& hierarchy, std::size_t samples)
{
  const Mesh& input = hierarchy.input();
  const std::size_t operations = hierarchy.record().operations.size();
  for (std::size_t i = 0; i <= samples; ++i) {
    const std::size_t wanted = operations * i / samples;
    const auto found = hierarchy.extract(wanted);
    EXPECT_LE(found.operations, wanted);
    EXPECT_TRUE(is_sound(found.mesh));
    EXPECT_EQ(topological_type(found.mesh), topological_type(input));
    if (found.operations == 0) {
      EXPECT_EQ(found.tolerance, 0);
      EXPECT_TRUE(is_identical(found.mesh, input));
      continue;
    }
    EXPECT_TRUE(certify_distance(input, found.mesh, found.tolerance).holds())
        << found.operations << " operations";
  }
}

std::string written(const Hierarchy_record& record)
{
  std::ostringstream out;
  write_hierarchy_record(out, record);
  return out.str();
}

Hierarchy_record read(const std::string& text)
{
  std::istringstream in(text);
  return surety::read_hierarchy_record(in);
}

// ---- levels ----

TEST(Hierarchy, has_a_proof_for_each_level)
{
  for (const Mesh& input : {bumpy_sphere(), torus(60, 24), wavy_sheet(), annulus(60, 12)}) {
    const auto hierarchy = make_hierarchy(input, four_tolerances);
    expect_sound_hierarchy(input, hierarchy, four_tolerances);
    expect_levels_are_extracted(hierarchy);
  }
}

TEST(Hierarchy, has_fewer_and_fewer_faces_on_a_curved_surface)
{
  const auto hierarchy = make_hierarchy(bumpy_sphere(), four_tolerances);
  for (std::size_t i = 1; i < four_tolerances.size(); ++i)
    EXPECT_LT(
        1.5 * double(hierarchy.levels()[i].mesh.number_of_faces()),
        double(hierarchy.levels()[i - 1].mesh.number_of_faces()));
}

TEST(Hierarchy, does_not_add_up_errors)
{
  // Against the level before, ten levels would leave the tolerance ten times.
  std::vector<double> tolerances;
  for (int i = 1; i <= 10; ++i) tolerances.push_back(0.05 + 1e-4 * i);
  const Mesh input = bumpy_sphere();
  expect_sound_hierarchy(input, make_hierarchy(input, tolerances), tolerances);
}

TEST(Hierarchy, of_one_level_is_the_geometric_mesh)
{
  const Mesh input = bumpy_sphere();
  const auto hierarchy = make_hierarchy(input, {0.03});
  const Simplification alone = simplified(input, 0.03, with::effort(Effort::fast));
  EXPECT_TRUE(is_identical(hierarchy.levels()[0].mesh, alone.output));
  EXPECT_EQ(hierarchy.levels()[0].certificate.bound(), alone.certificate.bound());
  EXPECT_EQ(hierarchy.operations().collapses, alone.certificate.operations().collapses);
}

TEST(Hierarchy, is_the_same_every_time_and_leaves_the_input_alone)
{
  const Mesh input = wavy_sheet();
  const auto before = fingerprint(input);
  const auto first = make_hierarchy(input, four_tolerances),
             second = make_hierarchy(input, four_tolerances);
  EXPECT_EQ(fingerprint(input), before);
  EXPECT_TRUE(is_identical(first.input(), input));
  for (std::size_t i = 0; i < four_tolerances.size(); ++i)
    EXPECT_TRUE(is_identical(first.levels()[i].mesh, second.levels()[i].mesh));
  EXPECT_EQ(written(first.record()), written(second.record()));
}

TEST(Hierarchy, keeps_borders_and_ridges_in_each_level)
{
  const Mesh input = height_field(24, [](double x, double y) {
    return 0.5 * std::abs(x - 0.5) + 0.01 * std::sin(9 * x + 5 * y);
  });
  const auto hierarchy = make_hierarchy(input, four_tolerances, with::feature_angle(30));
  expect_sound_hierarchy(input, hierarchy, four_tolerances);
  for (const auto& level : hierarchy.levels()) {
    const double tolerance = level.certificate.tolerance() + 1e-9;
    EXPECT_LE(curve_distance(border_curves(input), border_curves(level.mesh)), tolerance);
    const Curves ridge = sharp_curves(input, 30);
    ASSERT_FALSE(ridge.empty());
    for (const auto& [a, b] : ridge)
      EXPECT_LE(distance_to_curves(a, sharp_curves(level.mesh, 20)), tolerance);
    EXPECT_FALSE(level.certificate.correspondence()->ridges.empty());
  }
}

TEST(Hierarchy, extracts_sound_meshes_between_levels)
{
  for (const Mesh& input : {bumpy_sphere(), wavy_sheet()})
    expect_extractions_are_sound(make_hierarchy(input, four_tolerances), 12);
}

TEST(Hierarchy, extracts_by_number_of_faces)
{
  const Mesh input = bumpy_sphere();
  const auto hierarchy = make_hierarchy(input, four_tolerances);
  const std::size_t coarsest = hierarchy.levels().back().mesh.number_of_faces();
  for (std::size_t faces : {std::size_t(2000), std::size_t(701), coarsest}) {
    const auto found = hierarchy.extract_faces(faces);
    EXPECT_LE(found.mesh.number_of_faces(), faces);
    EXPECT_GE(found.mesh.number_of_faces() + 2, faces);
    EXPECT_TRUE(certify_distance(input, found.mesh, found.tolerance).holds());
  }
  EXPECT_EQ(hierarchy.extract_faces(1).mesh.number_of_faces(), coarsest);
  EXPECT_TRUE(is_identical(hierarchy.extract_faces(1000000).mesh, input));
}

TEST(Hierarchy, works_with_transactions_and_free_placement)
{
  const Mesh input = bumpy_sphere();
  const std::vector<double> tolerances = {0.002, 0.01};
  for (const Placement placement : {Placement::on_surface, Placement::free}) {
    const auto np = with::effort(Effort::standard).placement(placement);
    const auto hierarchy = make_hierarchy(input, tolerances, np);
    expect_sound_hierarchy(input, hierarchy, tolerances);
    expect_levels_are_extracted(hierarchy);
    expect_extractions_are_sound(hierarchy, 12);
    // Somewhere a transaction was made, inside which nothing is extracted.
    const auto& operations = hierarchy.record().operations;
    const auto inside = std::find_if(
        operations.begin(), operations.end(), [](auto& o) { return !o.is_boundary; });
    ASSERT_NE(inside, operations.end());
    const auto position = std::size_t(inside - operations.begin()) + 1;
    EXPECT_LT(hierarchy.extract(position).operations, position);
    EXPECT_FALSE(hierarchy.record().points.empty());
    EXPECT_LT(
        hierarchy.levels().back().mesh.number_of_faces(),
        make_hierarchy(input, tolerances).levels().back().mesh.number_of_faces());
  }
}

TEST(Hierarchy, works_with_the_accumulated_bound)
{
  const Mesh input = bumpy_sphere();
  const auto hierarchy = make_hierarchy(
      input, four_tolerances, with::deviation_bound(surety::Deviation_bound::accumulated));
  expect_sound_hierarchy(input, hierarchy, four_tolerances);
  expect_levels_are_extracted(hierarchy);
  EXPECT_FALSE(hierarchy.levels()[0].certificate.correspondence());
}

TEST(Hierarchy, has_points_of_single_precision_where_they_move)
{
  const auto hierarchy = make_hierarchy(
      bumpy_sphere(), four_tolerances,
      with::effort(Effort::standard).placement(Placement::free).single_precision(true));
  ASSERT_FALSE(hierarchy.record().points.empty());
  for (const auto& point : hierarchy.record().points)
    for (const double x : point) EXPECT_EQ(x, double(float(x)));
}

TEST(Hierarchy, stages_are_steps_between_levels)
{
  const Mesh input = bumpy_sphere();
  const auto plain = make_hierarchy(input, four_tolerances),
             staged = make_hierarchy(input, four_tolerances, with::stages(4));
  expect_sound_hierarchy(input, staged, four_tolerances);
  EXPECT_FALSE(is_identical(plain.levels()[0].mesh, staged.levels()[0].mesh));
}

TEST(Hierarchy, ends_at_the_wanted_number_of_faces)
{
  const Mesh input = bumpy_sphere();
  const auto hierarchy = make_hierarchy(input, four_tolerances, with::target_faces(1000));
  EXPECT_LT(hierarchy.levels().size(), four_tolerances.size());
  EXPECT_FALSE(hierarchy.is_cancelled());
  const Mesh& last = hierarchy.levels().back().mesh;
  EXPECT_LE(last.number_of_faces(), 1000u);
  EXPECT_GE(last.number_of_faces(), 998u);
  for (const auto& level : hierarchy.levels()) expect_level(input, level);
  expect_levels_are_extracted(hierarchy);
}

TEST(Hierarchy, copies_the_points_of_a_vertex_point_map)
{
  Mesh input = bumpy_sphere();
  const auto other = input.add_property_map<Vertex, Point>("v:other").first;
  for (const Vertex v : input.vertices()) {
    other[v] = input.point(v);
    input.point(v) = CGAL::ORIGIN;
  }
  const auto before = fingerprint(input);
  const auto hierarchy
      = make_hierarchy(input, four_tolerances, CGAL::parameters::vertex_point_map(other));
  EXPECT_EQ(fingerprint(input), before);
  const auto plain = make_hierarchy(bumpy_sphere(), four_tolerances);
  EXPECT_TRUE(is_identical(hierarchy.levels()[1].mesh, plain.levels()[1].mesh));
}

TEST(Hierarchy, has_the_same_faces_at_any_size)
{
  const Mesh input = wavy_sheet();
  const auto small = make_hierarchy(scaled(input, 0x1p-300), {0x1p-300 * 0.01, 0x1p-300 * 0.05});
  const auto usual = make_hierarchy(input, {0.01, 0.05});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(is_identical(scaled(small.levels()[i].mesh, 0x1p300), usual.levels()[i].mesh));
  expect_levels_are_extracted(small);
}

// ---- arguments ----

TEST(Hierarchy, refuses_tolerances_that_make_no_levels)
{
  const Mesh input = torus(20, 10);
  const std::vector<std::vector<double>> wrong
      = {{}, {0}, {-1}, {NAN}, {infinity}, {0.1, 0.1}, {0.2, 0.1}, {0.1, NAN}, {0.1, infinity}};
  for (const auto& tolerances : wrong) {
    try {
      make_hierarchy(input, tolerances);
      ADD_FAILURE() << "accepted";
    } catch (const Invalid_input& error) {
      EXPECT_EQ(error.function(), "make_hierarchy");
      EXPECT_EQ(error.argument(), "tolerances");
    }
  }
  EXPECT_THROW(make_hierarchy(Mesh(), {0.1}), Invalid_input);
  EXPECT_THROW(make_hierarchy(input, {0.1}, with::shape_ratio(0.5)), Invalid_input);
}

struct Cancel_at {
  std::size_t faces;
  bool on_progress(const surety::Progress& progress) const { return progress.faces > faces; }
};

TEST(Hierarchy, is_valid_when_cancelled)
{
  const Mesh input = bumpy_sphere();
  for (const std::size_t faces : {100000u, 2500u, 900u}) {
    const auto hierarchy
        = make_hierarchy(input, four_tolerances, CGAL::parameters::visitor(Cancel_at{faces}));
    EXPECT_TRUE(hierarchy.is_cancelled());
    ASSERT_LE(hierarchy.levels().size(), four_tolerances.size());
    for (const auto& level : hierarchy.levels()) expect_level(input, level);
    expect_levels_are_extracted(hierarchy);
    EXPECT_EQ(read(written(hierarchy.record())).levels.size(), hierarchy.levels().size());
  }
}

// ---- records ----

TEST(Hierarchy_record, returns_from_a_file)
{
  const Mesh input = bumpy_sphere();
  const auto hierarchy = make_hierarchy(
      input, four_tolerances, with::effort(Effort::standard).placement(Placement::free));
  const std::string text = written(hierarchy.record());
  const Hierarchy_record record = read(text);
  EXPECT_EQ(written(record), text);
  for (const auto& level : record.levels) {
    const auto a = hierarchy.extract(level.operations),
               b = extract_operations(input, record, level.operations);
    EXPECT_TRUE(is_identical(a.mesh, b.mesh));
    EXPECT_EQ(a.tolerance, b.tolerance);
  }
  EXPECT_TRUE(
      is_identical(hierarchy.extract_faces(500).mesh, extract_faces(input, record, 500).mesh));
}

TEST(Hierarchy_record, does_not_depend_on_how_the_input_is_connected)
{
  // The same points and faces in the same order, but edges as another program would number them.
  const Mesh input = wavy_sheet();
  Mesh other;
  for (const Vertex v : input.vertices()) other.add_vertex(input.point(v));
  const Soup soup = to_soup(input);
  for (const auto& t : soup.triangles)
    other.add_face(
        Vertex(Mesh::size_type(t[1])), Vertex(Mesh::size_type(t[2])),
        Vertex(Mesh::size_type(t[0])));
  const auto record = make_hierarchy(input, four_tolerances).record();
  const auto sorted_faces = [](const Mesh& mesh) {
    Soup s = to_soup(mesh);
    std::multiset<std::vector<Point>> faces;
    for (auto& t : s.triangles) {
      std::vector<Point> points;
      for (const auto v : t) points.push_back(s.points[v]);
      std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
      faces.insert(points);
    }
    return faces;
  };
  for (const auto& level : record.levels)
    EXPECT_EQ(
        sorted_faces(extract_operations(input, record, level.operations).mesh),
        sorted_faces(extract_operations(other, record, level.operations).mesh));
}

TEST(Hierarchy_record, is_refused_with_another_input)
{
  const Mesh input = bumpy_sphere();
  const auto record = make_hierarchy(input, {0.05}).record();
  EXPECT_THROW(extract_operations(torus(20, 10), record, 5), Invalid_input);
  EXPECT_THROW(extract_faces(jittered(input, 1e-9, 1), record, 5), Invalid_input);
  EXPECT_THROW(extract_faces(reversed(input), record, 5), Invalid_input);
}

TEST(Hierarchy_record, is_the_documented_text)
{
  Hierarchy_record record;
  record.fingerprint = 18446744073709551615u;
  record.vertices = 9;
  record.levels = {{0.5, 0.25, 2}, {1, 0.25, 5}};
  using Kind = Hierarchy_record::Kind;
  record.operations
      = {{1, 2, Kind::collapse, true},
         {3, 4, Kind::flip, true},
         {5, 6, Kind::placement, false},
         {7, 7, Kind::relocation, false},
         {8, 3, Kind::flip, true}};
  record.points = {{1, -0.5, 0}, {2, 0.75, 3}};
  const std::string text
      = "surety-hierarchy 1\ninput 18446744073709551615 9\nlevels 2\n0x1p-1 0x1p-2 2\n"
        "0x1p+0 0x1p-2 5\noperations 5\nc 1 2\nf 3 4\nP 5 6 0x1p+0 -0x1p-1 0x0p+0\n"
        "M 7 0x1p+1 0x1.8p-1 0x1.8p+1\nf 8 3\nend\n";
  EXPECT_EQ(written(record), text);
  EXPECT_EQ(written(read(text)), text);
}

TEST(Hierarchy_record, bad_lines_are_refused)
{
  const std::string good = "surety-hierarchy 1\ninput 7 9\nlevels 1\n0x1p-1 0x1p-2 2\n"
                           "operations 2\nc 1 2\nm 3 0x1p+0 0x1p+0 0x1p+0\nend\n";
  EXPECT_NO_THROW(read(good));
  const std::vector<std::pair<std::string, std::string>> damages
      = {{"hierarchy 1", "hierarchy 2"},
         {"input 7", "input -7"},
         {"levels 1", "levels 0"},
         {"levels 1", "levels 4000000000"},
         {"0x1p-1 0x1p-2 2", "0x0p+0 0x1p-2 2"},
         {"0x1p-1 0x1p-2 2", "-0x1p-1 0x1p-2 2"},
         {"0x1p-1 0x1p-2 2", "inf 0x1p-2 2"},
         {"0x1p-1 0x1p-2 2", "0x1p-1 -0x1p-2 2"},
         {"0x1p-1 0x1p-2 2", "0x1p-1 0x1p-2 1"},
         {"0x1p-1 0x1p-2 2", "0x1p-1 0x1p-2 3"},
         {"operations 2", "operations 4000000000"},
         {"operations 2", "operations 1"},
         {"c 1 2", "c 1 9"},
         {"c 1 2", "c 1 1"},
         {"c 1 2", "c 1"},
         {"c 1 2", "c 1 2 3"},
         {"c 1 2", "x 1 2"},
         {"c 1 2", "cc 1 2"},
         {"m 3", "M 3"},
         {"m 3", "m 9"},
         {"m 3 0x1p+0", "m 3 nan"},
         {"m 3 0x1p+0", "m 3 0x1p+9999"},
         {"end", "END"}};
  for (const auto& [from, to] : damages) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    try {
      read(text);
      ADD_FAILURE() << to << " was accepted";
    } catch (const Invalid_input& error) {
      EXPECT_EQ(error.function(), "read_hierarchy_record");
    }
  }
  for (std::size_t length = 0; length + 1 < good.size(); ++length)
    EXPECT_THROW(read(good.substr(0, length)), Invalid_input) << length;
}

TEST(Hierarchy_record, damage_leads_to_a_refusal_or_to_a_surface)
{
  const Mesh input = scaled(wavy_sheet(), 1);
  const auto hierarchy = make_hierarchy(
      input, {0.01, 0.05}, with::effort(Effort::standard).placement(Placement::free));
  const Hierarchy_record good = hierarchy.record();
  Random random(5);
  std::size_t refused = 0, replayed = 0;
  for (int i = 0; i < 300; ++i) {
    Hierarchy_record record = good;
    auto& operation = record.operations[random.below(record.operations.size())];
    switch (random.below(4)) {
    case 0:
      operation.source = std::uint32_t(random.below(record.vertices));
      break;
    case 1:
      operation.target = std::uint32_t(random.below(record.vertices));
      break;
    case 2:
      operation.kind = Hierarchy_record::Kind(random.below(2));
      break;
    default:
      std::swap(operation, record.operations[random.below(record.operations.size())]);
    }
    try {
      const auto found = extract_operations(input, record, record.operations.size());
      EXPECT_TRUE(is_sound(found.mesh));
      EXPECT_EQ(topological_type(found.mesh), topological_type(input));
      ++replayed;
    } catch (const Invalid_input&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 20u);
  EXPECT_GT(replayed, 5u);
}

TEST(Hierarchy_record, that_cannot_be_read_back_is_not_written)
{
  Hierarchy_record record = make_hierarchy(torus(20, 10), {0.05}).record();
  record.levels.back().operations -= 1;
  std::ostringstream out;
  EXPECT_THROW(write_hierarchy_record(out, record), Invalid_input);
  EXPECT_EQ(out.str(), "");
}

// ---- real models ----

class Hierarchy_of_a_model : public testing::TestWithParam<const char*>
{};

TEST_P(Hierarchy_of_a_model, is_proven_level_by_level)
{
  const char* folder = std::getenv("SURETY_DATA_DIR");
  if (folder == nullptr || *folder == '\0') GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  Mesh input;
  ASSERT_TRUE(pmp::IO::read_polygon_mesh(std::string(folder) + '/' + GetParam(), input));
  std::vector<double> tolerances;
  for (const double share : {0.0005, 0.001, 0.003, 0.01})
    tolerances.push_back(share * diagonal(input));
  const auto hierarchy = make_hierarchy(input, tolerances);
  expect_sound_hierarchy(input, hierarchy, tolerances);
  expect_levels_are_extracted(hierarchy);
  expect_extractions_are_sound(hierarchy, 5);
}

INSTANTIATE_TEST_SUITE_P(
    Models, Hierarchy_of_a_model,
    testing::Values("fandisk.off", "mannequin-devil.off", "elephant.off"));

} // namespace
