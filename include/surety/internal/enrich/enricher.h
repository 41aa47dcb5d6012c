// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices on a support, as many as a gap and a size ask for, taken back towards the mesh where
// faces would fold or meet others.
#ifndef SURETY_INTERNAL_ENRICH_ENRICHER_H
#define SURETY_INTERNAL_ENRICH_ENRICHER_H

#include <surety/geometric_support.h>
#include <surety/internal/enrich/refinement.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/number_utils.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace surety::internal::enrichment {

struct Enrichment_controls {
  double tolerance, largest_size; ///< the latter may be infinite
  unsigned most_rounds;
  bool allow_self_intersections;
};

constexpr double cosine_of_cone = 0.70710678118654757; ///< of 45 degrees

template <class Mesh, class Points>
class Enricher
{
  using Point = typename Mesh::Point;
  using Pairs = std::set<std::pair<Index, Index>>;

public:
  Enricher(
      const Mesh& mesh, const Points& points, const Features& features,
      const Geometric_support& support, const Enrichment_controls& controls)
    : mesh_(mesh),
      points_(points),
      features_(features),
      support_(support),
      controls_(controls),
      refinement_(whole_faces(), 0),
      share_(num_vertices(mesh), 1)
  {
    for (const auto v : vertices(mesh)) number_of_[v] = Index(number_of_.size());
    refinement_ = Refinement(whole_faces(), Index(number_of_.size()));
    place_originals();
  }

  void run()
  {
    while (rounds_ < controls_.most_rounds && refine()) ++rounds_;
    is_fine_ = rounds_ < controls_.most_rounds || !has_long_edge();
    for (place(); damp(); place()) {}
  }

  bool is_fine() const { return is_fine_; }
  unsigned rounds() const { return rounds_; }
  std::size_t folded_faces() const { return folded_; }
  std::size_t intersections() const { return intersections_; }
  std::size_t damped_faces() const
  {
    std::size_t count = 0;
    for (const auto f : faces(mesh_)) {
      const auto v = support_.corners(Index(f));
      count += share_[v[0]] < 1 || share_[v[1]] < 1 || share_[v[2]] < 1;
    }
    return count;
  }

  /// \brief The new mesh, original vertices first, in their order.
  ///
  /// A point x of a face corresponds to the point with the same coordinates in its piece. The
  /// distance is convex over a piece, so that it is largest at a corner: it bounds the two-sided
  /// distance of the face and its pieces.
  Mesh result() const
  {
    Mesh made = assembled();
    auto deviation
        = made.template add_property_map<typename Mesh::Face_index, double>("f:deviation", 0.)
              .first;
    auto is_feature
        = made.template add_property_map<typename Mesh::Edge_index, bool>("e:is_feature", false)
              .first;
    std::size_t k = 0;
    for (const auto f : made.faces()) {
      const Piece& piece = refinement_.pieces()[k++];
      for (const Index v : piece.corner) deviation[f] = (std::max)(deviation[f], moved(v));
      for (int i = 0; i < 3; ++i) {
        if (!is_on_feature(piece, i)) continue;
        const auto h = made.halfedge(
            typename Mesh::Vertex_index(piece.corner[i]),
            typename Mesh::Vertex_index(piece.corner[(i + 1) % 3]));
        is_feature[made.edge(h)] = true;
      }
    }
    return made;
  }

private:
  Vector point(typename Mesh::Vertex_index v) const
  {
    const auto& p = get(points_, v);
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  std::vector<Piece> whole_faces() const
  {
    std::vector<Piece> pieces;
    for (const auto f : faces(mesh_)) {
      Piece piece{Index(f), {}, {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()}};
      for (int i = 0; i < 3; ++i) {
        const auto found = number_of_.find(
            typename Mesh::Vertex_index(support_.corners(Index(f))[std::size_t(i)]));
        if (found != number_of_.end()) piece.corner[i] = found->second;
      }
      pieces.push_back(piece);
    }
    return pieces;
  }

  void place_originals()
  {
    location_.resize(number_of_.size());
    for (const Piece& piece : refinement_.pieces()) {
      for (int i = 0; i < 3; ++i) location_[piece.corner[i]] = {piece.face, piece.barycentric[i]};
    }
    for (const auto v : vertices(mesh_)) flat_.push_back(point(v));
    originals_ = flat_.size();
    on_support_ = position_ = flat_;
    for (const Vector& p : flat_) magnitude_ = (std::max)(magnitude_, p.cwiseAbs().maxCoeff());
  }

  Vector flat_point(const Support_location& at) const
  {
    const auto v = support_.corners(at.face);
    Vector sum = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      sum += at.barycentric[i] * point(typename Mesh::Vertex_index(v[std::size_t(i)]));
    return sum;
  }

  /// How far a straight edge or its length is from what is asked for; found once an edge.
  bool is_long(const Piece& piece, int i)
  {
    const int j = (i + 1) % 3;
    const auto [found, is_new]
        = is_long_.emplace(edge_name(piece.corner[i], piece.corner[j]), false);
    if (!is_new) return found->second;
    const Vector a = on_support_[piece.corner[i]], b = on_support_[piece.corner[j]];
    const double length = (b - a).norm();
    bool answer = length > controls_.largest_size;
    const Vector along = length > 0 ? Vector((b - a) / length) : Vector::Zero();
    for (int k = 1; k < 4 && !answer; ++k) {
      const Vector at
          = piece.barycentric[i] + (piece.barycentric[j] - piece.barycentric[i]) * k / 4;
      const Vector to = support_.position({piece.face, at}) - a;
      answer = to.cross(along).norm() > controls_.tolerance;
    }
    return found->second = answer;
  }

  /// Whether the middle of a piece lies too far from its plane.
  bool is_flat(const Piece& piece) const
  {
    const Vector a = on_support_[piece.corner[0]];
    const Vector normal
        = (on_support_[piece.corner[1]] - a).cross(on_support_[piece.corner[2]] - a);
    const Vector middle = (piece.barycentric[0] + piece.barycentric[1] + piece.barycentric[2]) / 3;
    const double volume = std::abs(normal.dot(support_.position({piece.face, middle}) - a));
    return volume <= controls_.tolerance * normal.norm();
  }

  bool is_to_cut(const Piece& piece, int i) { return is_long(piece, i) || !is_flat(piece); }

  bool has_long_edge()
  {
    for (const Piece& piece : refinement_.pieces()) {
      for (int i = 0; i < 3; ++i) {
        if (is_to_cut(piece, i)) return true;
      }
    }
    return false;
  }

  bool refine()
  {
    return refinement_.refine(
        [this](const Piece& piece, int i) { return is_to_cut(piece, i); },
        [this](Index a, Index b) { return (on_support_[b] - on_support_[a]).norm(); },
        [this](Index, const Support_location& at) {
          location_.push_back(at);
          flat_.push_back(flat_point(at));
          on_support_.push_back(support_.position(at));
        });
  }

  /// Each vertex goes the part of its way to the support that the corners of its face admit.
  void place()
  {
    position_ = flat_;
    for (std::size_t v = originals_; v < flat_.size(); ++v) {
      const auto corner = support_.corners(location_[v].face);
      double share = 0;
      for (int i = 0; i < 3; ++i)
        share += location_[v].barycentric[i] * share_[corner[std::size_t(i)]];
      position_[v] = share == 1 ? on_support_[v] : flat_[v] + share * (on_support_[v] - flat_[v]);
    }
  }

  /// Takes those faces back that fold or meet others; returns whether there are any that can be.
  bool damp()
  {
    std::set<Index> bad;
    folded_ = intersections_ = 0;
    for (const Piece& piece : refinement_.pieces()) {
      if (is_upright(piece)) continue;
      bad.insert(piece.face);
      ++folded_;
    }
    if (!controls_.allow_self_intersections) add_intersecting(bad);
    bool has_changed = false;
    for (const Index f : bad) {
      for (const Index v : support_.corners(f)) {
        if (share_[v] == 0) continue;
        share_[v] = share_[v] > 0.1 ? share_[v] / 2 : 0;
        has_changed = true;
      }
    }
    return has_changed;
  }

  /// Within the cone about the support's normal, or about that of the flat face.
  bool is_upright(const Piece& piece) const
  {
    const Vector a = position_[piece.corner[0]];
    const Vector normal = (position_[piece.corner[1]] - a).cross(position_[piece.corner[2]] - a);
    const double least = cosine_of_cone * normal.norm();
    if (!(least > 0)) return false;
    const Vector middle = (piece.barycentric[0] + piece.barycentric[1] + piece.barycentric[2]) / 3;
    if (normal.dot(support_.normal({piece.face, middle})) >= least) return true;
    const auto v = support_.corners(piece.face);
    const Vector p = point(typename Mesh::Vertex_index(v[0]));
    const Vector flat = (point(typename Mesh::Vertex_index(v[1])) - p)
                            .cross(point(typename Mesh::Vertex_index(v[2])) - p);
    return normal.dot(flat) >= least * flat.norm();
  }

  /// Pairs of faces of the input whose pieces meet, though the faces did not.
  void add_intersecting(std::set<Index>& bad)
  {
    namespace PMP = CGAL::Polygon_mesh_processing;
    using Face = typename Mesh::Face_index;
    const Mesh made = assembled();
    std::vector<std::pair<Face, Face>> found;
    PMP::self_intersections(made, std::back_inserter(found));
    if (found.empty()) return;
    if (!knows_old_) {
      std::vector<std::pair<Face, Face>> old;
      PMP::self_intersections(
          mesh_, std::back_inserter(old), CGAL::parameters::vertex_point_map(points_));
      for (const auto& [f, g] : old) old_.insert(std::minmax(Index(f), Index(g)));
      knows_old_ = true;
    }
    for (const auto& [f, g] : found) {
      // A copy: minmax returns references to what is gone at the end of the line.
      const std::pair<Index, Index> pair = std::minmax(face_of(Index(f)), face_of(Index(g)));
      if (old_.count(pair) != 0) continue;
      bad.insert({pair.first, pair.second});
      ++intersections_;
    }
  }

  Index face_of(Index piece) const { return refinement_.pieces()[piece].face; }

  Mesh assembled() const
  {
    Mesh made;
    for (const Vector& p : position_) made.add_vertex(Point(p.x(), p.y(), p.z()));
    // The originals as they were, to the last bit of their own type.
    std::size_t k = 0;
    for (const auto v : vertices(mesh_)) {
      made.point(typename Mesh::Vertex_index(Index(k++))) = get(points_, v);
    }
    using Vertex = typename Mesh::Vertex_index;
    for (const Piece& piece : refinement_.pieces())
      made.add_face(Vertex(piece.corner[0]), Vertex(piece.corner[1]), Vertex(piece.corner[2]));
    return made;
  }

  /// An upper bound: flat points are three products and two sums, 5.2 units in the last place of
  /// the largest coordinate; the difference and its norm are off by a few units of themselves.
  double moved(Index v) const
  {
    if (v < originals_) return 0;
    return (position_[v] - flat_[v]).norm() * (1 + 0x1p-49) + 0x1p-49 * magnitude_;
  }

  /// An edge lies on an edge of the face where a coordinate vanishes at both ends.
  bool is_on_feature(const Piece& piece, int i) const
  {
    const Vector &a = piece.barycentric[i], &b = piece.barycentric[(i + 1) % 3];
    for (int k = 0; k < 3; ++k) {
      if (a[k] != 0 || b[k] != 0) continue;
      const auto v = support_.corners(piece.face);
      const auto h = mesh_.halfedge(
          typename Mesh::Vertex_index(v[std::size_t(k + 1) % 3]),
          typename Mesh::Vertex_index(v[std::size_t(k + 2) % 3]));
      return features_.edge[mesh_.edge(h)];
    }
    return false;
  }

  const Mesh& mesh_;
  const Points points_;
  const Features& features_;
  const Geometric_support& support_;
  const Enrichment_controls controls_;
  std::map<typename Mesh::Vertex_index, Index> number_of_; ///< in the new mesh
  Refinement refinement_;
  std::vector<double> share_; ///< of the way to the support, by vertex of the input
  std::vector<Support_location> location_;
  std::vector<Vector> flat_, on_support_, position_;
  std::size_t originals_ = 0;
  double magnitude_ = 0;
  std::unordered_map<std::uint64_t, bool> is_long_;
  Pairs old_;
  bool knows_old_ = false, is_fine_ = false;
  unsigned rounds_ = 0;
  std::size_t folded_ = 0, intersections_ = 0;
};

} // namespace surety::internal::enrichment

#endif // SURETY_INTERNAL_ENRICH_ENRICHER_H
