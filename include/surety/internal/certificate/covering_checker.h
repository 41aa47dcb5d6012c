// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks a covering: that the faces of one mesh are near to the faces of the other which the record
// names for each of them.
//
// A face is divided into four again and again. A part counts as covered when all its corners are
// within the bound of one named triangle, for the distance to a convex set is convex: then all of
// the part is. The corners of the parts are a + lambda (b - a) + mu (c - a) with lambda and mu
// multiples of 2^-20: exact numbers, whose distances are bounded as measure.h says. So the parts
// fill the face exactly, and nothing depends on how the record was made.
#ifndef SURETY_INTERNAL_CERTIFICATE_COVERING_CHECKER_H
#define SURETY_INTERNAL_CERTIFICATE_COVERING_CHECKER_H

#include <surety/covering.h>
#include <surety/internal/certificate/measure.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace surety::internal::checker {

/// One direction: the faces of a mesh, covered by those of another one.
class Covering_checker
{
public:
  Covering_checker(
      const Triangle_table& mesh, const Triangle_table& other, const Covering::Faces& record,
      double bound)
    : mesh_(mesh), other_(other), record_(record), bound_(bound)
  {}

  /// What is wrong with the record or not proven by it; empty if all faces are covered.
  std::string defect()
  {
    const std::size_t faces = mesh_.number_of_faces();
    if (record_.first.size() != faces + 1 || record_.first.front() != 0
        || record_.first.back() != record_.witnesses.size()
        || !std::is_sorted(record_.first.begin(), record_.first.end()))
      return "the record does not have one list for each of the " + std::to_string(faces)
          + " faces";
    for (const Index w : record_.witnesses)
      if (w >= other_.number_of_faces())
        return "there is no face " + std::to_string(w) + " in the other mesh";
    face_bounds_.assign(faces, 0);
    for (Index f = 0; f < faces; ++f) {
      if (covers(f)) continue;
      return "face " + std::to_string(f) + " is not covered by the faces that the record names";
    }
    return "";
  }

  /// A proven bound of the distance of each face, once there is no defect.
  const std::vector<double>& face_bounds() const { return face_bounds_; }

private:
  /// In units of 2^-depth of a face.
  struct Corner {
    std::uint32_t lambda, mu;
  };
  using Part = std::array<Corner, 3>;

  static constexpr unsigned deepest = 20;
  /// A record that needs more parts for one face is refused, so that the check of any file ends.
  static constexpr std::size_t most_parts = 4'000'000;

  bool covers(Index f)
  {
    for (int i = 0; i < 3; ++i) place_.corners[i] = mesh_.point(mesh_.corners(f)[i]);
    const auto first = record_.witnesses.begin() + record_.first[f];
    active_.assign(first, record_.witnesses.begin() + record_.first[f + 1]);
    size_ = longest_side();
    parts_ = 0;
    worst_ = 0;
    const bool is_covered = covers({Corner{0, 0}, Corner{1, 0}, Corner{0, 1}}, 0, 0);
    face_bounds_[f] = worst_;
    return is_covered;
  }

  double longest_side() const
  {
    const auto& [a, b, c] = place_.corners;
    return (std::max)(
        {distance_to_vertex(a, b), distance_to_vertex(b, c), distance_to_vertex(c, a)});
  }

  /// \param from where the witnesses that may still count begin in `active_`
  bool covers(const Part& part, unsigned depth, std::size_t from)
  {
    if (++parts_ > most_parts) return false;
    const std::size_t last = active_.size();
    double best = std::numeric_limits<double>::infinity();
    std::array<bool, 3> is_near{false, false, false};
    for (std::size_t i = from; i < last && best > bound_; ++i) {
      const Index witness = active_[i];
      double farthest = 0, nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const double distance = distance_of(part[k], depth, witness);
        farthest = (std::max)(farthest, distance);
        nearest = (std::min)(nearest, distance);
        if (distance <= bound_) is_near[k] = true;
      }
      best = (std::min)(best, farthest);
      // No point of the part is nearer to the witness by more than the length of the part.
      if (nearest <= bound_ + size_ / double(std::uint32_t(1) << depth)) active_.push_back(witness);
    }
    if (best <= bound_) {
      worst_ = (std::max)(worst_, best);
      active_.resize(last);
      return true;
    }
    // A corner that is near to none of them cannot be covered.
    const bool is_hopeless = !(is_near[0] && is_near[1] && is_near[2]);
    const bool is_covered = !is_hopeless && depth < deepest && covers_quarters(part, depth, last);
    active_.resize(last);
    return is_covered;
  }

  bool covers_quarters(const Part& part, unsigned depth, std::size_t from)
  {
    const auto doubled = [&](int i) { return Corner{2 * part[i].lambda, 2 * part[i].mu}; };
    const auto middle = [&](int i, int k) {
      return Corner{part[i].lambda + part[k].lambda, part[i].mu + part[k].mu};
    };
    const Corner a = doubled(0), b = doubled(1), c = doubled(2), ab = middle(0, 1),
                 bc = middle(1, 2), ca = middle(2, 0);
    for (const Part& quarter :
         {Part{a, ab, ca}, Part{ab, b, bc}, Part{ca, bc, c}, Part{ab, bc, ca}})
      if (!covers(quarter, depth + 1, from)) return false;
    return true;
  }

  double distance_of(const Corner& corner, unsigned depth, Index witness)
  {
    const double unit = 1.0 / double(std::uint32_t(1) << depth);
    place_.lambda = unit * corner.lambda;
    place_.mu = unit * corner.mu;
    const auto& v = other_.corners(witness);
    return distance_to_triangle(place_, other_.point(v[0]), other_.point(v[1]), other_.point(v[2]));
  }

  const Triangle_table& mesh_;
  const Triangle_table& other_;
  const Covering::Faces& record_;
  double bound_;
  Inner_place place_;
  std::vector<Index> active_; ///< a stack of lists of witnesses, one for each level
  std::vector<double> face_bounds_;
  double size_ = 0, worst_ = 0; ///< the longest side of the face; its bound so far
  std::size_t parts_ = 0;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_COVERING_CHECKER_H
