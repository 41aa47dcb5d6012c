// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate checker: rebuilds the map phi cell by cell from its record and proves that the
// Hausdorff distance of T and M is at most the bound that it returns. It shares no code with the
// bound that guards a simplification, builds no search tree, and runs in linear time.
//
// Theorem. If all steps of check() succeed, H(T, M) <= bound, and each point of face K of M lies
// within face_bounds[K] of T.
// Proof. Let P_t be the polygon of items around a triangle t of T, as an abstract convex polygon,
// cut into the cells found, with one corner in the interior if they use the inner item of t, and S
// the union of all P_t, glued along the edges of T; two neighbours agree about the items on their
// common edge. Let G: S -> T and F: S -> M be linear on each cell, with G(i) = x_i, the exact place
// of item i, and F(i) = y_i, a point of its closed element with |x_i - y_i| <= d_i.
//   F goes into M: the corners of a cell lie in one closed face, which is convex.
//   |F - G| <= max d_i: on a cell, F - G is linear, and the norm convex.
//   G is onto: on P_t it maps the boundary around the boundary of t once, without turning back, as
//   lambda does not decrease along an edge; so it has degree 1 there, and it does not leave t, as
//   the place of an inner item is in t. Cells may well be degenerate: several items at one place,
//   all items of a cell on one edge of t, even t itself without area.
//   F is onto: degree.h; and a point of the open face K of M is covered by a cell of K.
// A point of T is G(s), and F(s) a point of M within the bound; a point of M is F(s), and G(s) a
// point of T within the bound. The same argument on the border edges and the ridge edges: curves.h.
// No item needs to be at distance 0: the vertices of M need not be points of T.
#ifndef SURETY_INTERNAL_CERTIFICATE_CHECKER_H
#define SURETY_INTERNAL_CERTIFICATE_CHECKER_H

#include <surety/internal/certificate/curves.h>
#include <surety/internal/certificate/degree.h>
#include <surety/internal/certificate/measure.h>
#include <surety/internal/certificate/normals.h>

#include <cstdio>
#include <limits>

namespace surety::internal::checker {

class Checker
{
public:
  Checker(const Triangle_table& input, const Triangle_table& output, const Correspondence& record)
    : input_(input), output_(output), record_(record), items_(output)
  {}

  /// Whether the record proves that the distance is at most `bound()`, this is at most `tolerance`,
  /// and so is the bound that was recorded, which may not be better than `bound()`. If not,
  /// `reason()` says why. The border rule comes before the degree, which is not defined without it.
  bool check(double tolerance, double recorded_bound)
  {
    return check_structure() && resolve_images() && resolve_crossings() && resolve_inner()
        && check_edges() && measure(tolerance) && measure_inner(tolerance)
        && check_recorded(recorded_bound, tolerance) && cut_triangles()
        && accept("border", Border_check(input_, items_).defect())
        && accept("degree", degree_defect(items_, cells_)) && check_ridges();
  }

  const std::string& reason() const { return reason_; }
  double bound() const { return bound_; }

  /// For each face of M, the largest distance of an item of its cells.
  std::vector<double> face_bounds() const
  {
    std::vector<double> bounds(output_.number_of_faces(), 0);
    for (const Cell& cell : cells_) {
      double& bound = bounds[cell.face];
      for (const Index i : cell.items) bound = (std::max)(bound, distances_[i]);
    }
    return bounds;
  }

  /// How far apart the ridges and borders of the two are, as curves: a stretch of a curve of T goes
  /// linearly to one of M, so that its ends are farthest, and the images cover the curves of M.
  double curve_bound() const
  {
    double bound = 0;
    const auto raise = [&](Index v) { bound = (std::max)(bound, distances_[v]); };
    for (const Edge& edge : input_.edges())
      if (edge.is_border()) raise(edge.a), raise(edge.b);
    for (const Vertex_pair& ridge : record_.ridges) raise(ridge[0]), raise(ridge[1]);
    return bound;
  }

  /// For each face of M, a bound in degrees of its angle to the faces of T of its cells.
  std::vector<double> normal_deviations() const
  {
    Normal_deviations deviations(input_, items_);
    for (Index t = 0; t < input_.number_of_faces(); ++t)
      deviations.add(t, cells_.data() + first_cell_[t], cells_.data() + first_cell_[t + 1]);
    return deviations.angles();
  }

private:
  bool accept(const char* invariant, const std::string& defect)
  {
    if (!defect.empty()) reason_ = std::string(invariant) + ": " + defect;
    return defect.empty();
  }
  bool refuse(const char* invariant, const std::string& defect)
  {
    return accept(invariant, defect);
  }

  bool check_structure()
  {
    for (const auto* mesh : {&input_, &output_}) {
      const std::string name = mesh == &input_ ? "input: " : "output: ";
      if (!mesh->defect().empty()) return refuse("structure", name + mesh->defect());
      if (mesh->number_of_faces() == 0) return refuse("structure", name + "the mesh has no face");
    }
    const std::string defect = simplicial_defect(output_);
    if (!defect.empty()) return refuse("structure", "output: " + defect);
    if (record_.images.size() != input_.number_of_vertices()) {
      return refuse(
          "structure",
          "there are " + std::to_string(record_.images.size()) + " images for "
              + std::to_string(input_.number_of_vertices()) + " input vertices");
    }
    return accept("structure", record_defect(record_));
  }

  bool resolve_images()
  {
    items_.reserve(record_.images.size() + record_.crossings.size() + record_.inner.size());
    for (Index v = 0; v < input_.number_of_vertices(); ++v) {
      if (!items_.add(record_.images[v])) {
        return refuse(
            "structure",
            "the image of input vertex " + std::to_string(v) + " is not in the output");
      }
    }
    return true;
  }

  /// Both the edges of the record and those of the table are sorted: one walk finds them all.
  bool resolve_crossings()
  {
    const auto& edges = input_.edges();
    first_crossing_.assign(edges.size() + 1, items_.size());
    std::size_t e = 0;
    for (std::size_t i = 0; i < record_.edges.size(); ++i) {
      for (; e < edges.size() && edges[e].name() < record_.edges[i]; ++e) {
        first_crossing_[e + 1] = items_.size();
      }
      if (e == edges.size() || edges[e].name() != record_.edges[i]) {
        return refuse("structure", "input edge " + to_string(record_.edges[i]) + " does not exist");
      }
      for (Index k = record_.offsets[i]; k < record_.offsets[i + 1]; ++k) {
        if (!resolve_crossing(edges[e], record_.crossings[k])) return false;
      }
    }
    for (; e < edges.size(); ++e) first_crossing_[e + 1] = items_.size();
    return true;
  }

  bool resolve_crossing(const Edge& edge, const Correspondence::Crossing& crossing)
  {
    const char* invariant = "border";
    const char* problem = "";
    if (!items_.add(crossing)) {
      invariant = "structure";
      problem = "a crossing is not on an edge of the output";
    } else if (edge.is_border()) {
      problem = "an input border edge has a crossing";
    } else if (output_.edges()[items_[items_.size() - 1].id].is_border()) {
      problem = "a crossing lies on a border edge of the output";
    } else {
      return true;
    }
    return refuse(
        invariant,
        std::string(problem) + " (input edge " + to_string(edge.name()) + ", output edge "
            + to_string(Vertex_pair{crossing.a, crossing.b}) + ")");
  }

  bool resolve_inner()
  {
    first_inner_ = items_.size();
    for (const auto& inner : record_.inner) {
      const char* problem = "";
      if (inner.face >= input_.number_of_faces()) problem = "this face does not exist";
      if (!items_.add(inner)) problem = "it does not go to a vertex of the output";
      if (*problem != 0) return refuse("structure", name_of_inner(inner) + ": " + problem);
    }
    return true;
  }

  static std::string name_of_inner(const Correspondence::Inner& inner)
  {
    return "the inner item of input face " + std::to_string(inner.face);
  }

  /// I1, consecutive items share a closed face.
  bool check_edges()
  {
    for (Index e = 0; e < input_.edges().size(); ++e) {
      const Edge& edge = input_.edges()[e];
      Index before = edge.a;
      for (Index i = first_crossing_[e]; i <= first_crossing_[e + 1]; ++i) {
        const Index item = i < first_crossing_[e + 1] ? i : edge.b;
        if (items_.common_face(before, item, item) == none) {
          return refuse(
              "I1",
              "along input edge " + to_string(edge.name()) + ", items "
                  + std::to_string(i - first_crossing_[e]) + " and "
                  + std::to_string(i - first_crossing_[e] + 1) + " share no face of the output");
        }
        before = item;
      }
    }
    return true;
  }

  /// I2, every item is within the tolerance of its element.
  bool measure(double tolerance)
  {
    distances_.reserve(items_.size());
    bound_ = 0;
    for (Index v = 0; v < input_.number_of_vertices(); ++v) {
      if (!measure({input_.point(v), input_.point(v), 0}, tolerance)) {
        return refuse("I2", "input vertex " + std::to_string(v) + too_far(tolerance));
      }
    }
    for (Index e = 0; e < input_.edges().size(); ++e) {
      const Edge& edge = input_.edges()[e];
      for (Index i = first_crossing_[e]; i < first_crossing_[e + 1]; ++i) {
        const double lambda = record_.crossings[i - input_.number_of_vertices()].lambda;
        if (!measure({input_.point(edge.a), input_.point(edge.b), lambda}, tolerance)) {
          return refuse(
              "I2",
              "crossing " + std::to_string(i - first_crossing_[e]) + " of input edge "
                  + to_string(edge.name()) + too_far(tolerance));
        }
      }
    }
    return true;
  }

  bool measure(const Place& place, double tolerance)
  {
    const Item& item = items_[static_cast<Index>(distances_.size())];
    double distance = 0;
    if (item.kind == Kind::vertex) {
      distance = distance_to_vertex(place.start, output_.point(item.id));
    } else if (item.kind == Kind::edge) {
      const Edge& edge = output_.edges()[item.id];
      distance = distance_to_segment(place, output_.point(edge.a), output_.point(edge.b));
    } else {
      const auto& t = output_.corners(item.id);
      distance = distance_to_triangle(
          place, output_.point(t[0]), output_.point(t[1]), output_.point(t[2]));
    }
    return accept_distance(distance, tolerance);
  }

  /// The corners of a face with an inner item are taken in the order of their numbers.
  bool measure_inner(double tolerance)
  {
    for (const auto& inner : record_.inner) {
      auto corners = input_.corners(inner.face);
      std::sort(corners.begin(), corners.end());
      const Inner_place place
          = {{input_.point(corners[0]), input_.point(corners[1]), input_.point(corners[2])},
             inner.lambda,
             inner.mu};
      if (!accept_distance(distance_to_vertex(place, output_.point(inner.vertex)), tolerance))
        return refuse("I2", name_of_inner(inner) + too_far(tolerance));
    }
    return true;
  }

  bool accept_distance(double distance, double tolerance)
  {
    distances_.push_back(distance);
    bound_ = (std::max)(bound_, distance);
    return distance <= tolerance; // false for NaN
  }

  std::string too_far(double tolerance) const
  {
    return " is farther from its image than " + to_text(tolerance) + ": "
        + to_text(distances_.back());
  }

  /// The two bounds were rounded in different ways; coordinates may have been rounded there where
  /// differences are here.
  bool check_recorded(double recorded, double tolerance)
  {
    const double slack = 0x1p-46 * largest_coordinate() + 0x1p-40 * bound_;
    if (!(recorded + slack >= bound_)) {
      return refuse(
          "I2",
          "the recorded bound " + to_text(recorded) + " is below the largest distance "
              + to_text(bound_));
    }
    if (recorded <= tolerance) return true;
    return refuse("I2", "the recorded bound " + to_text(recorded) + " exceeds the tolerance");
  }

  /// I3, every triangle of T can be cut into cells.
  bool cut_triangles()
  {
    cells_.reserve(
        input_.number_of_faces() + 2 * (record_.crossings.size() + record_.inner.size()));
    first_cell_.assign(1, 0);
    first_cell_.reserve(input_.number_of_faces() + 1);
    Polygon_cutter<Items> cutter(items_);
    std::vector<Index> polygon;
    Index next_inner = 0;
    for (Index t = 0; t < input_.number_of_faces(); ++t) {
      collect_polygon(t, polygon);
      const bool has_inner
          = next_inner < record_.inner.size() && record_.inner[next_inner].face == t;
      const Index inner = has_inner ? first_inner_ + next_inner++ : none;
      const Cutting cutting = cutter.cut(polygon, inner, cells_);
      first_cell_.push_back(cells_.size());
      if (cutting == Cutting::done) continue;
      const auto& v = input_.corners(t);
      return refuse(
          "I3",
          "the images around input face " + std::to_string(t) + " (vertices " + std::to_string(v[0])
              + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2])
              + (cutting == Cutting::impossible
                     ? ") cannot be cut into cells inside faces of the output"
                     : ") are not proven to bound cells: there are too many of them"));
    }
    return true;
  }

  void collect_polygon(Index t, std::vector<Index>& polygon) const
  {
    polygon.clear();
    for (Index k = 0; k < 3; ++k) {
      const Index corner = input_.corners(t)[k], side = input_.sides(t)[k];
      polygon.push_back(corner);
      const Index first = first_crossing_[side], last = first_crossing_[side + 1];
      const bool forward = input_.edges()[side].a == corner;
      for (Index i = 0; i < last - first; ++i)
        polygon.push_back(forward ? first + i : last - 1 - i);
    }
  }

  bool check_ridges()
  {
    for (const Vertex_pair& ridge : record_.ridges) {
      const Index e = input_.find_edge(ridge[0], ridge[1]);
      const std::string name = "input ridge " + to_string(ridge);
      if (e == none) return refuse("I5", name + " is not an edge");
      if (input_.edges()[e].is_border()) return refuse("I5", name + " is a border edge");
      if (first_crossing_[e] != first_crossing_[e + 1])
        return refuse("I5", name + " has a crossing");
    }
    return accept("I5", Ridge_check(input_, items_).defect(record_.ridges));
  }

  double largest_coordinate() const
  {
    double largest = 0;
    for (const auto* mesh : {&input_, &output_}) {
      for (Index v = 0; v < mesh->number_of_vertices(); ++v) {
        largest = (std::max)(largest, checker::largest_coordinate(mesh->point(v)));
      }
    }
    return largest;
  }

  static std::string to_text(double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
  }

  const Triangle_table& input_;
  const Triangle_table& output_;
  const Correspondence& record_;
  Items items_;
  std::vector<Index> first_crossing_; ///< item of the first crossing of each edge of T
  Index first_inner_ = 0;             ///< item of the first inner item
  std::vector<double> distances_;     ///< of each item
  std::vector<Cell> cells_;
  std::vector<std::size_t> first_cell_; ///< of each face of T
  double bound_ = std::numeric_limits<double>::infinity();
  std::string reason_;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_CHECKER_H
