// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of a certificate: the fast cutter of polygons agrees with an exhaustive search on
// random closed walks over small complexes, and the count of coverings with a test point.
#include <surety/internal/certificate/degree.h>

#include "polyhedra.h"

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace surety::internal::checker;
using surety::test::Random;

Triangle_table table(const surety::test::Mesh& mesh)
{
  return read_triangles(mesh, get(CGAL::vertex_point, mesh), "mesh");
}

/// One item on every element of a complex, and one more on every vertex, to be an inner item.
struct All_items {
  Triangle_table mesh;
  Items items{mesh};
  Index elements = 0;

  explicit All_items(const surety::test::Mesh& surface) : mesh(table(surface))
  {
    using Kind = surety::Correspondence::Kind;
    for (Index v = 0; v < mesh.number_of_vertices(); ++v) items.add({Kind::vertex, v, 0});
    for (const auto& e : mesh.edges()) items.add({Kind::edge, e.a, e.b});
    for (Index f = 0; f < mesh.number_of_faces(); ++f) items.add({Kind::face, f, 0});
    elements = items.size();
    for (Index v = 0; v < mesh.number_of_vertices(); ++v) items.add({Kind::vertex, v, 0});
  }

  Index inner(Index v) const { return elements + v; }

  bool are_adjacent(Index i, Index j) const { return items.common_face(i, j, j) != none; }

  /// Vertices and edges are favoured: on faces all is easy.
  Index random_item(Random& random) const
  {
    const Index faceless = elements - mesh.number_of_faces();
    return Index(random.below(random.unit() < 0.15 ? elements : faceless));
  }

  std::vector<Index> random_walk(std::size_t length, Random& random) const
  {
    while (true) {
      std::vector<Index> walk = {random_item(random)};
      while (walk.size() < length) {
        const Index next = random_item(random);
        if (are_adjacent(walk.back(), next)) walk.push_back(next);
      }
      if (are_adjacent(walk.back(), walk.front())) return walk;
    }
  }
};

/// Whether any triangulation exists at all, by intervals over the whole polygon.
bool can_be_cut(const Items& items, const std::vector<Index>& polygon)
{
  const std::size_t n = polygon.size();
  std::vector<std::vector<bool>> can(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i + 1 < n; ++i) can[i][i + 1] = true;
  for (std::size_t length = 2; length < n; ++length) {
    for (std::size_t i = 0; i + length < n; ++i) {
      for (std::size_t k = i + 1; k < i + length; ++k) {
        if (can[i][k] && can[k][i + length]
            && items.common_face(polygon[i], polygon[k], polygon[i + length]) != none) {
          can[i][i + length] = true;
        }
      }
    }
  }
  return can[0][n - 1];
}

/// The cells have their items in their faces, and the polygon as their boundary, and their number
/// is that of a triangulation of the polygon, with a corner inside or without.
void expect_triangulation(
    const Items& items, const std::vector<Index>& polygon, const std::vector<Cell>& cells,
    Index inner = none)
{
  const auto has_inner = [&](const Cell& cell) {
    return std::count(cell.items.begin(), cell.items.end(), inner) > 0;
  };
  const bool uses_inner = std::any_of(cells.begin(), cells.end(), has_inner);
  ASSERT_EQ(cells.size() + (uses_inner ? 0 : 2), polygon.size());
  std::map<std::pair<Index, Index>, int> boundary;
  const auto add
      = [&](Index i, Index j, int sign) { boundary[std::minmax(i, j)] += i < j ? sign : -sign; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add(polygon[i], polygon[(i + 1) % polygon.size()], -1);
  }
  for (const Cell& cell : cells) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(items.is_in_face(cell.items[k], cell.face));
      add(cell.items[k], cell.items[(k + 1) % 3], 1);
    }
  }
  for (const auto& [ends, count] : boundary) {
    EXPECT_TRUE(count == 0 || ends.first == ends.second);
  }
}

/// Whether there is a triangulation with a corner c inside. Its neighbours go once around the
/// polygon; a step from one to the next needs a face with c, and a triangulation of what it cuts
/// off. Steps are sought on the polygon taken twice, from every corner around to itself.
bool can_be_cut_around(const Items& items, const std::vector<Index>& polygon, Index c)
{
  const std::size_t n = polygon.size();
  const auto is_step = [&](std::size_t i, std::size_t j) {
    if (items.common_face(c, polygon[i % n], polygon[j % n]) == none) return false;
    if (j == i + 1) return true;
    std::vector<Index> cut_off;
    for (std::size_t k = i; k <= j; ++k) cut_off.push_back(polygon[k % n]);
    return can_be_cut(items, cut_off);
  };
  std::vector<std::vector<bool>> step(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t length = 1; length < n; ++length) step[i][length] = is_step(i, i + length);
  for (std::size_t first = 0; first < n; ++first) {
    std::vector<bool> reached(n + 1, false);
    reached[0] = true;
    for (std::size_t to = 1; to <= n; ++to) {
      for (std::size_t from = 0; from < to && !reached[to]; ++from) {
        reached[to] = reached[from] && to - from < n && step[(first + from) % n][to - from];
      }
    }
    if (reached[n]) return true;
  }
  return false;
}

class Walk : public testing::TestWithParam<unsigned>
{};

TEST_P(Walk, cutter_agrees_with_an_exhaustive_search)
{
  using namespace surety::test;
  const std::vector<Mesh> surfaces
      = {cube(), icosphere(0), torus(4, 4), grid(2), annulus(3, 1), cylinder(8, 1), cylinder(4, 1)};
  surety::test::Random random(GetParam());
  std::size_t cut = 0, refused = 0;
  for (const Mesh& surface : surfaces) {
    const All_items all(surface);
    Polygon_cutter<Items> cutter(all.items);
    for (int i = 0; i < 300; ++i) {
      const auto polygon = all.random_walk(3 + random.below(14), random);
      std::vector<surety::internal::checker::Cell> cells;
      const Cutting answer = cutter.cut(polygon, none, cells);
      ASSERT_EQ(answer == Cutting::done, can_be_cut(all.items, polygon));
      ASSERT_NE(answer, Cutting::too_large);
      if (answer == Cutting::done) expect_triangulation(all.items, polygon, cells);
      ++(answer == Cutting::done ? cut : refused);
    }
  }
  EXPECT_GT(cut, 100u);
  EXPECT_GT(refused, 100u);
}

TEST_P(Walk, cutter_with_an_inner_item_agrees_with_an_exhaustive_search)
{
  using namespace surety::test;
  const std::vector<Mesh> surfaces = {cube(), icosphere(0), grid(2), torus(4, 4), cylinder(4, 1)};
  surety::test::Random random(GetParam());
  std::size_t around = 0, only_around = 0, refused = 0;
  for (const Mesh& surface : surfaces) {
    const All_items all(surface);
    Polygon_cutter<Items> cutter(all.items);
    for (int i = 0; i < 1500; ++i) {
      const auto polygon = all.random_walk(3 + random.below(10), random);
      const Index inner = all.inner(Index(random.below(all.mesh.number_of_vertices())));
      std::vector<surety::internal::checker::Cell> cells;
      const Cutting answer = cutter.cut(polygon, inner, cells);
      const bool can_go_around = can_be_cut_around(all.items, polygon, inner);
      const bool can_go_without = can_be_cut(all.items, polygon);
      ASSERT_NE(answer, Cutting::too_large);
      ASSERT_EQ(answer == Cutting::done, can_go_around || can_go_without);
      if (answer == Cutting::done) expect_triangulation(all.items, polygon, cells, inner);
      around += can_go_around;
      only_around += can_go_around && !can_go_without;
      refused += answer != Cutting::done;
    }
  }
  EXPECT_GT(around, 20u);
  EXPECT_GT(only_around, 5u);
  EXPECT_GT(refused, 50u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Walk, testing::Range(0u, 20u));

/// The hub of a wheel, and its rim from the first vertex once around to the last one. The ear at
/// the hub is a mistake: the rim alone winds about it.
std::vector<Index> around_the_hub(Index n)
{
  std::vector<Index> polygon;
  for (Index k = 0; k <= n; ++k) polygon.push_back(k);
  return polygon;
}

/// n triangles about vertex 0.
surety::test::Mesh wheel(Index n)
{
  surety::test::Soup soup{{surety::test::Point(0, 0, 0)}, {}};
  for (Index k = 0; k < n; ++k) {
    const double angle = 2 * surety::test::pi * k / n;
    soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    soup.triangles.push_back({0, 1 + k, 1 + (k + 1) % n});
  }
  return to_mesh(soup);
}

TEST(Polygon_cutter, undoes_an_ear_at_a_vertex_that_was_a_mistake)
{
  for (const Index n : {3u, 4u, 6u, 50u, 390u}) {
    const All_items all(wheel(n));
    const auto polygon = around_the_hub(n);
    std::vector<Cell> cells;
    ASSERT_EQ(Polygon_cutter<Items>(all.items).cut(polygon, none, cells), Cutting::done);
    expect_triangulation(all.items, polygon, cells);
  }
}

/// The rim of a wheel, `times` around.
std::vector<Index> rim(Index n, Index times)
{
  std::vector<Index> polygon;
  for (Index k = 0; k < n * times; ++k) polygon.push_back(1 + k % n);
  return polygon;
}

TEST(Polygon_cutter, fans_a_rim_from_an_inner_item_at_the_hub)
{
  for (const Index n : {3u, 4u, 6u, 2'000u}) {
    const All_items all(wheel(n));
    std::vector<Cell> cells;
    Polygon_cutter<Items> cutter(all.items);
    ASSERT_EQ(cutter.cut(rim(n, 1), all.inner(0), cells), Cutting::done);
    expect_triangulation(all.items, rim(n, 1), cells, all.inner(0));
    cells.clear();
    EXPECT_NE(cutter.cut(rim(n, 1), none, cells), Cutting::done);
    EXPECT_NE(cutter.cut(rim(n, 1), all.inner(1), cells), Cutting::done);
    EXPECT_TRUE(cells.empty());
  }
}

TEST(Polygon_cutter, a_rim_twice_around_is_cut_but_covers_twice)
{
  const All_items all(wheel(5));
  std::vector<Cell> cells;
  ASSERT_EQ(Polygon_cutter<Items>(all.items).cut(rim(5, 2), all.inner(0), cells), Cutting::done);
  expect_triangulation(all.items, rim(5, 2), cells, all.inner(0));
  EXPECT_EQ(degree_defect(all.items, cells), "output face 0 is covered 2 times instead of once");
}

TEST(Polygon_cutter, one_inner_item_does_not_serve_two_vertices)
{
  // The border of a grid winds about its inner vertices, and there is an item at one of them.
  for (const std::size_t n : {2, 3}) {
    const All_items all(surety::test::grid(n));
    std::vector<Index> border;
    const auto at = [&](std::size_t i, std::size_t j) { return Index(i * (n + 1) + j); };
    for (std::size_t k = 0; k < n; ++k) border.push_back(at(k, 0));
    for (std::size_t k = 0; k < n; ++k) border.push_back(at(n, k));
    for (std::size_t k = n; k > 0; --k) border.push_back(at(k, n));
    for (std::size_t k = n; k > 0; --k) border.push_back(at(0, k));
    std::vector<Cell> cells;
    const Cutting answer = Polygon_cutter<Items>(all.items).cut(border, all.inner(at(1, 1)), cells);
    EXPECT_EQ(answer, n == 2 ? Cutting::done : Cutting::impossible);
  }
}

TEST(Polygon_cutter, gives_up_beyond_its_limits_without_a_wrong_answer)
{
  const All_items all(wheel(450));
  std::vector<Cell> cells;
  Polygon_cutter<Items> cutter(all.items);
  EXPECT_EQ(cutter.cut(around_the_hub(450), none, cells), Cutting::too_large);
  EXPECT_TRUE(cells.empty());

  const All_items small(wheel(300));
  int done = 0;
  Polygon_cutter<Items> tired(small.items);
  while (tired.cut(around_the_hub(300), none, cells) == Cutting::done && done < 100) ++done;
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 100); // the work of one check is limited
}

TEST(Polygon_cutter, takes_linear_time_on_a_long_polygon)
{
  // A million items back and forth across one edge, which a fan or an ear at a time may cut.
  const All_items all(wheel(6));
  const Index edges = all.mesh.number_of_vertices();
  const Index spoke = edges + all.mesh.find_edge(0, 1), next = edges + all.mesh.find_edge(0, 2);
  std::vector<Index> polygon = {0};
  for (int i = 0; i < 500'000; ++i) polygon.insert(polygon.end(), {spoke, next});
  std::vector<Cell> cells;
  EXPECT_EQ(Polygon_cutter<Items>(all.items).cut(polygon, none, cells), Cutting::done);
  EXPECT_EQ(cells.size(), polygon.size() - 2);
}

/// How often a test point in general position is covered, for the formula by areas.
int coverings_of_a_point(const std::vector<std::array<unsigned, 3>>& cells)
{
  const long at[7][2] = {{6, 0}, {0, 6}, {0, 0}, {3, 3}, {0, 3}, {3, 0}, {2, 2}};
  const long x = 1234567, y = 2345671, unit = 1000000; // the point (1.234567, 2.345671)
  int count = 0;
  for (const auto& c : cells) {
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) {
      const auto &p = at[c[k]], &q = at[c[(k + 1) % 3]];
      const long turn = (q[0] - p[0]) * (y - unit * p[1]) - (q[1] - p[1]) * (x - unit * p[0]);
      left += turn > 0;
      right += turn < 0;
    }
    count += left == 3 ? 1 : right == 3 ? -1 : 0;
  }
  return count;
}

TEST(Degree, sum_of_areas_counts_the_coverings_of_a_point)
{
  // Closed walks about the boundary of a face, fanned from one of their items, are relative cycles.
  const std::array<unsigned, 6> boundary = {0, 3, 1, 4, 2, 5};
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<unsigned> walk = {boundary[0]};
    const int turns = int(random.below(5)) - 2;
    int position = 0;
    for (int step = 0; step < 8 || position != 6 * turns; ++step) {
      const bool forward = step < 8 ? random.unit() < 0.5 : position < 6 * turns;
      position += forward ? 1 : -1;
      walk.push_back(boundary[std::size_t((position % 6 + 6) % 6)]);
    }
    const unsigned apex = random.unit() < 0.5 ? 6 : boundary[random.below(6)];
    std::vector<std::array<unsigned, 3>> cells;
    int area = 0;
    for (std::size_t k = 0; k + 1 < walk.size(); ++k) {
      cells.push_back({apex, walk[k], walk[k + 1]});
      area += signed_area(apex, walk[k], walk[k + 1]);
    }
    EXPECT_EQ(area, turns * area_of_face);
    EXPECT_EQ(coverings_of_a_point(cells), turns);
  }
}

} // namespace
