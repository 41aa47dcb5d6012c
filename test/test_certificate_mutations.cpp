// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates of real simplifications, damaged on purpose: damage that changes the meaning is
// caught, and whatever is accepted is still true by the verifier of distances. Seeds are in the
// names of the tests.
#include <surety/geometric_mesh.h>

#include "overlay.h"
#include "polyhedra.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

namespace {

using namespace surety::test;
using surety::Certificate;
using surety::Certificate_check;
using surety::Correspondence;

struct Simplified {
  Mesh input, output;
  Certificate certificate;

  Certificate_check check() const { return surety::check_certificate(input, output, certificate); }
  Certificate_check check(const Correspondence& record) const
  {
    return surety::check_certificate(
        input, output, Certificate(certificate.tolerance(), certificate.bound(), record));
  }
};

Simplified simplify(
    const Mesh& input, double tolerance, double feature_angle = 180,
    surety::Placement placement = surety::Placement::on_surface)
{
  Mesh output = input;
  Certificate certificate = surety::make_geometric_mesh(
      output, tolerance, surety::parameters::feature_angle(feature_angle).placement(placement));
  return {input, std::move(output), std::move(certificate)};
}

/// A shape and a tolerance at which much is left out, of many kinds in turn.
Simplified example(unsigned seed)
{
  switch (seed % 6) {
  case 0:
    return simplify(jittered_sphere(3, seed), 0.03);
  case 1:
    return simplify(rotated(cube(6), seed), 0.01, 40);
  case 2:
    return simplify(jittered(torus(24, 12), 0.01, seed), 0.05);
  case 3:
    return simplify(jittered(saddle(14), 0.01, seed), 0.05);
  case 4:
    return simplify(jittered(annulus(24, 4), 0.005, seed), 0.03);
  default:
    return simplify(rotated(plate_with_holes(2), seed), 0.1, 40);
  }
}

class Simplification : public testing::TestWithParam<unsigned>
{
protected:
  const unsigned seed = GetParam();
};

TEST_P(Simplification, certificate_holds_with_the_bound_that_it_records)
{
  const Simplified result = example(seed);
  EXPECT_LT(result.output.number_of_faces(), result.input.number_of_faces());
  const Certificate_check answer = result.check();
  ASSERT_TRUE(answer.holds) << answer.reason;
  EXPECT_NEAR(answer.bound, result.certificate.bound(), 1e-9 * result.certificate.tolerance());
  EXPECT_LE(sampled_distance(result.input, result.output, seed), answer.bound);
}

TEST_P(Simplification, normal_deviations_cover_the_faces_at_a_vertex_inside_a_face)
{
  // Whatever the cells are: one at such a vertex is in that face.
  const Simplified result = example(seed);
  const Certificate_check answer = result.check();
  ASSERT_TRUE(answer.holds) << answer.reason;
  const auto normal = [](const Mesh& mesh, Face f) {
    const auto h = mesh.halfedge(f);
    return CGAL::normal(
        mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
        mesh.point(mesh.target(mesh.next(h))));
  };
  const auto& images = result.certificate.correspondence()->images;
  int compared = 0;
  for (const Face t : result.input.faces()) {
    for (const Vertex v : CGAL::vertices_around_face(result.input.halfedge(t), result.input)) {
      if (images[v].kind != Kind::face) continue;
      const Face f(images[v].a);
      const double angle
          = CGAL::approximate_angle(normal(result.input, t), normal(result.output, f));
      EXPECT_LE(angle, answer.normal_deviations[f] + 1e-5); // approximate near 0 and 180
      ++compared;
    }
  }
  // The plate's vertices are all on edges, and stay there.
  EXPECT_TRUE(compared > 0 || seed % 6 == 5);
}

TEST_P(Simplification, certificate_survives_a_file)
{
  const Simplified result = example(seed);
  std::stringstream file;
  write_certificate(file, result.certificate);
  const Certificate copy = surety::read_certificate(file);
  const auto answer = surety::check_certificate(result.input, result.output, copy);
  EXPECT_TRUE(answer.holds) << answer.reason;
  EXPECT_EQ(answer.bound, result.check().bound);
}

TEST_P(Simplification, certificate_of_another_mesh_is_refused)
{
  const Simplified result = example(seed);
  const auto refuses = [&](const Mesh& input, const Mesh& output) {
    return !surety::check_certificate(input, output, result.certificate).holds;
  };
  EXPECT_TRUE(refuses(result.input, result.input));
  EXPECT_TRUE(refuses(result.output, result.output));
  EXPECT_TRUE(refuses(renumbered(result.input, seed), result.output));
  EXPECT_TRUE(refuses(result.input, renumbered(result.output, seed)));
  EXPECT_TRUE(refuses(result.input, reversed(result.output)));
  EXPECT_TRUE(refuses(joined({result.input, icosphere(0)}), result.output));
  EXPECT_TRUE(refuses(result.input, joined({result.output, icosphere(0)})));
  const double far = 2.1 * result.certificate.tolerance();
  EXPECT_TRUE(refuses(translated(result.input, Vector(far, 0, 0)), result.output));
}

TEST_P(Simplification, a_vertex_moved_in_either_mesh_is_noticed)
{
  const Simplified sound = example(seed);
  Random random(seed);
  for (int i = 0; i < 20; ++i) {
    for (const bool in_output : {false, true}) {
      Simplified moved = sound;
      Mesh& mesh = in_output ? moved.output : moved.input;
      const Vertex v(std::uint32_t(random.below(mesh.number_of_vertices())));
      mesh.point(v) = mesh.point(v) + Vector(0, 0, 1e3);
      const Certificate_check answer = moved.check();
      EXPECT_FALSE(answer.holds);
      EXPECT_EQ(answer.reason.substr(0, 3), "I2:") << answer.reason;
    }
  }
}

TEST_P(Simplification, a_hole_in_either_mesh_is_noticed)
{
  const Simplified sound = example(seed);
  Random random(seed);
  for (int i = 0; i < 10; ++i) {
    for (const bool in_output : {false, true}) {
      Simplified torn = sound;
      Soup soup = to_soup(in_output ? sound.output : sound.input);
      soup.triangles.erase(
          soup.triangles.begin() + std::ptrdiff_t(random.below(soup.triangles.size())));
      (in_output ? torn.output : torn.input) = to_mesh(soup);
      EXPECT_FALSE(torn.check().holds);
    }
  }
}

// ---- the record damaged ----

/// Elements of the output as images, at random.
Correspondence::Image random_image(const Mesh& output, Random& random)
{
  switch (random.below(3)) {
  case 0:
    return at_vertex(std::uint32_t(random.below(output.number_of_vertices())));
  case 1:
    return at_face(std::uint32_t(random.below(output.number_of_faces())));
  default:
    break;
  }
  const Mesh::Edge_index e(std::uint32_t(random.below(output.number_of_edges())));
  return on_edge(output.vertex(e, 0), output.vertex(e, 1));
}

bool same(const Correspondence::Image& i, const Correspondence::Image& j)
{
  return i.kind == j.kind && i.a == j.a && i.b == j.b;
}

/// One random change of the record; returns false where there was nothing to change.
bool mutate(Correspondence& r, const Mesh& output, Random& random)
{
  const auto edge_with_crossings = [&] { return random.below(r.edges.size()); };
  const auto erase = [&](std::size_t edge, std::uint32_t k) {
    r.crossings.erase(r.crossings.begin() + k);
    for (std::size_t i = edge + 1; i < r.offsets.size(); ++i) --r.offsets[i];
  };
  switch (random.below(7)) {
  case 0: { // another image
    auto& image = r.images[random.below(r.images.size())];
    const auto other = random_image(output, random);
    return !same(std::exchange(image, other), other);
  }
  case 1: { // the images of two vertices swapped
    auto &i = r.images[random.below(r.images.size())], &j = r.images[random.below(r.images.size())];
    std::swap(i, j);
    return !same(i, j);
  }
  default:
    break;
  }
  if (r.edges.empty()) return false;
  const std::size_t edge = edge_with_crossings();
  const std::uint32_t first = r.offsets[edge], last = r.offsets[edge + 1];
  if (first == last) return false;
  const auto k = first + std::uint32_t(random.below(last - first));
  auto& crossing = r.crossings[k];
  switch (random.below(6)) {
  case 0:
    erase(edge, k);
    return true;
  case 1: { // on another edge
    const auto other = random_image(output, random);
    if (other.kind != Kind::edge || (other.a == crossing.a && other.b == crossing.b)) return false;
    crossing.a = other.a;
    crossing.b = other.b;
    return true;
  }
  case 2: // elsewhere along the edge
    crossing.lambda = random.unit();
    return true;
  case 3: { // out of order
    if (k + 1 == last) return false;
    auto& next = r.crossings[k + 1];
    std::swap(crossing.a, next.a);
    std::swap(crossing.b, next.b);
    return crossing.a != next.a || crossing.b != next.b;
  }
  case 4: { // a crossing twice
    r.crossings.insert(r.crossings.begin() + k, Correspondence::Crossing(crossing));
    for (std::size_t i = edge + 1; i < r.offsets.size(); ++i) ++r.offsets[i];
    return true;
  }
  default: { // all crossings of an edge forgotten
    for (std::uint32_t i = last; i > first; --i) erase(edge, i - 1);
    return true;
  }
  }
}

TEST_P(Simplification, what_is_accepted_after_damage_is_true)
{
  const Simplified sound = example(seed);
  double least_bound = sound.certificate.tolerance();
  Random random(seed);
  std::map<std::string, int> answers;
  for (int i = 0; i < 1000; ++i) {
    Correspondence record = *sound.certificate.correspondence();
    for (std::size_t k = 1 + random.below(2); k > 0; --k) {
      if (!mutate(record, sound.output, random)) ++k;
    }
    const Certificate_check answer = sound.check(record);
    ++answers[answer.holds ? "holds" : answer.reason.substr(0, answer.reason.find(':'))];
    least_bound = std::min(least_bound, answer.bound); // infinite if it does not hold
  }
  // Only images that moved a little and parameters that changed a little may pass.
  EXPECT_TRUE(surety::certify_distance(sound.input, sound.output, least_bound * 1.001).holds());
  for (const auto& [answer, times] : answers) RecordProperty(answer, times);
  EXPECT_LT(answers["holds"], 250);
  EXPECT_GT(answers["I1"], 0);
  EXPECT_GT(answers["I2"], 0);
}

TEST_P(Simplification, every_crossing_counts)
{
  const Simplified sound = example(seed);
  const Correspondence& r = *sound.certificate.correspondence();
  for (std::size_t edge = 0; edge < r.edges.size(); ++edge) {
    for (std::uint32_t k = r.offsets[edge]; k < r.offsets[edge + 1]; ++k) {
      if (r.offsets.back() > 400 && (k + seed) % (r.offsets.back() / 400) != 0) continue;
      Correspondence less = r;
      less.crossings.erase(less.crossings.begin() + k);
      for (std::size_t i = edge + 1; i < less.offsets.size(); ++i) --less.offsets[i];
      EXPECT_FALSE(sound.check(less).holds) << "crossing " << k;
    }
  }
}

TEST_P(Simplification, every_ridge_counts)
{
  const Simplified sound = example(seed);
  Correspondence record = *sound.certificate.correspondence();
  for (std::size_t i = 0; i < record.ridges.size(); ++i) {
    Correspondence less = record;
    less.ridges.erase(less.ridges.begin() + std::ptrdiff_t(i));
    // An edge that is an edge of the output by itself may well be left out.
    const auto [s, t] = record.ridges[i];
    const bool whole
        = record.images[s].kind == Kind::vertex && record.images[t].kind == Kind::vertex;
    const Certificate_check answer = sound.check(less);
    EXPECT_EQ(answer.reason.substr(0, 3), whole ? "" : "I5:");
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Simplification, testing::Range(0u, 12u));

/// Simplifications whose vertices are free, so that most of them have inner items.
class Free_simplification : public testing::TestWithParam<unsigned>
{
protected:
  const unsigned seed = GetParam();

  Simplified example() const
  {
    const auto free = surety::Placement::free;
    switch (seed % 3) {
    case 0:
      return simplify(jittered_sphere(3, seed), 0.05, 180, free);
    case 1:
      return simplify(jittered(torus(24, 12), 0.01, seed), 0.05, 180, free);
    default:
      return simplify(jittered(saddle(14), 0.01, seed), 0.05, 180, free);
    }
  }
};

TEST_P(Free_simplification, certificate_holds_and_every_inner_item_counts)
{
  const Simplified sound = example();
  const Certificate_check answer = sound.check();
  ASSERT_TRUE(answer.holds) << answer.reason;
  EXPECT_LE(sampled_distance(sound.input, sound.output, seed), answer.bound);
  const Correspondence& r = *sound.certificate.correspondence();
  EXPECT_GT(r.inner.size(), 5u);
  for (std::size_t i = 0; i < r.inner.size(); ++i) {
    Correspondence less = r;
    less.inner.erase(less.inner.begin() + std::ptrdiff_t(i));
    EXPECT_FALSE(sound.check(less).holds) << "inner item " << i;
  }
}

TEST_P(Free_simplification, what_is_accepted_after_damage_to_an_inner_item_is_true)
{
  const Simplified sound = example();
  double least_bound = sound.certificate.tolerance();
  Random random(seed);
  int accepted = 0;
  for (int i = 0; i < 500; ++i) {
    Correspondence record = *sound.certificate.correspondence();
    auto& inner = record.inner[random.below(record.inner.size())];
    switch (random.below(4)) {
    case 0:
      inner.vertex = std::uint32_t(random.below(sound.output.number_of_vertices()));
      break;
    case 1:
      inner.face += random.unit() < 0.5 ? 1 : std::uint32_t(-1);
      break;
    case 2:
      std::swap(inner.lambda, inner.mu);
      break;
    default:
      inner.lambda = random.unit();
      inner.mu = random.unit();
    }
    const Certificate_check answer = sound.check(record);
    accepted += answer.holds;
    least_bound = std::min(least_bound, answer.bound); // infinite if it does not hold
  }
  // Only a place that changed a little may pass, in the half of them where it changed alone.
  EXPECT_LT(accepted, 250);
  EXPECT_TRUE(surety::certify_distance(sound.input, sound.output, least_bound * 1.001).holds());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Free_simplification, testing::Range(0u, 9u));

class Random_shape : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_shape, certificates_hold_at_all_tolerances)
{
  const unsigned seed = GetParam();
  const Mesh shape = random_shape(seed);
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const Simplified result = simplify(shape, tolerance, seed % 2 == 0 ? 180 : 40);
    const Certificate_check answer = result.check();
    EXPECT_TRUE(answer.holds) << answer.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_shape, testing::Range(0u, 30u));

} // namespace
