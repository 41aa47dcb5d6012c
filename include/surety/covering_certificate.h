// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proofs of the distance of two meshes, whatever made them: to make, to keep in a file, and to
// check without trust in who made them.
#ifndef SURETY_COVERING_CERTIFICATE_H
#define SURETY_COVERING_CERTIFICATE_H

#include <surety/covering.h>
#include <surety/errors.h>
#include <surety/internal/certificate/covering_checker.h>
#include <surety/internal/certificate/covering_maker.h>
#include <surety/internal/certificate/covering_text.h>
#include <surety/internal/certificate/triangle_table.h>
#include <surety/internal/validation.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace surety {

/// The answer of `check_covering()`.
struct Covering_check {
  /// The proof is complete: the distance is at most `bound`, which is at most the tolerance.
  bool holds = false;
  /// Empty if the proof is complete; otherwise what is wrong, and with which face.
  std::string reason;
  /// The proven distance, rounded up; infinite if nothing is proven.
  double bound = std::numeric_limits<double>::infinity();
  /// For each face of the output, in iteration order, a proven bound of the distance of its points
  /// to the input; empty if nothing is proven.
  std::vector<double> face_bounds;
};

/// \brief makes a record that proves that two meshes lie within a tolerance of each other.
///
/// The meshes may be of any origin, open or self-intersecting, and need not have anything in common
/// but their place. Made from the meshes as they have been read from their
/// files, the record is about these files, and what rounding a format does is in it.
///
/// Takes O(n log n + k) for n faces and k pairs of faces within the tolerance of each other, times
/// the parts that faces have to be divided into.
///
/// \param input,output two triangle meshes
/// \param tolerance a length, positive
/// \return nothing when the meshes are farther than the tolerance from each other, or so near to it
///         that no record was found; `certify_distance()` names the place where they are farther.
/// \throws Invalid_input when a mesh has no faces or one that is not a triangle, or the tolerance
///         is not positive.
template <class Input_mesh, class Output_mesh>
std::optional<Covering> make_covering(
    const Input_mesh& input, const Output_mesh& output, double tolerance)
{
  const char* const function = "make_covering";
  internal::require_positive(tolerance, function, "tolerance");
  for (const bool is_empty : {num_faces(input) == 0, num_faces(output) == 0})
    if (is_empty) throw Invalid_input(function, "mesh", "it has no faces");
  if (!CGAL::is_triangle_mesh(input) || !CGAL::is_triangle_mesh(output))
    throw Invalid_input(
        function, "mesh", "a face is not a triangle",
        "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces");
  namespace coverings = internal::coverings;
  const auto points = get(CGAL::vertex_point, input);
  const auto other_points = get(CGAL::vertex_point, output);
  const double scale = coverings::scale_of(input, points);
  const auto first = coverings::triangles_of(input, points, scale);
  const auto second = coverings::triangles_of(output, other_points, scale);
  // Below the tolerance by more than all rounding, of the maker and of the checker.
  constexpr double rounding = 1e-9;
  const double limit = scale * tolerance * (1 - 2 * rounding);
  Covering result;
  result.tolerance = tolerance;
  const auto forth = coverings::Maker(first, second, limit).make(result.of_input);
  if (!forth) return std::nullopt;
  const auto back = coverings::Maker(second, first, limit).make(result.of_output);
  if (!back) return std::nullopt;
  const double found = (std::max)(*forth, *back) / scale;
  result.bound = (std::min)(tolerance, found + rounding * (found + tolerance));
  return result;
}

/// \brief verifies a covering against the two meshes, from its record alone.
///
/// If the answer holds, then every point of either mesh lies within `bound` of the other, rounding
/// included. The check shares no code with what made the record or the meshes. It says nothing
/// about a map between the meshes, their topology, or how far curves of features lie apart.
///
/// Faces are divided until each part is near to one of the named faces: the time is linear in the
/// lengths of the lists and the number of parts, at most four million a face; a record that needs
/// more does not hold.
///
/// A record that is wrong in whatever way is an answer, not an error.
///
/// \param input,output the meshes; their faces are numbered in iteration order, so both must be as
///        they were written.
/// \pre The coordinates of the points are of type `double` or `float`.
/// \throws Invalid_input when a face is not a triangle.
template <class Input_mesh, class Output_mesh>
Covering_check check_covering(
    const Input_mesh& input, const Output_mesh& output, const Covering& covering)
{
  namespace checker = internal::checker;
  Covering_check answer;
  auto first = checker::read_triangles(input, get(CGAL::vertex_point, input), "input");
  auto second = checker::read_triangles(output, get(CGAL::vertex_point, output), "output");
  if (!first.defect().empty() || !second.defect().empty()) {
    answer.reason = !first.defect().empty() ? "the input: " + first.defect()
                                            : "the output: " + second.defect();
    return answer;
  }
  if (!(covering.bound >= 0) || !(covering.bound <= covering.tolerance)) {
    answer.reason = "the bound is not within the tolerance";
    return answer;
  }
  const double scale
      = (std::min)(checker::scale_of_products(first), checker::scale_of_products(second));
  first.scale(scale);
  second.scale(scale);
  const double bound = scale * covering.bound;
  checker::Covering_checker forth(first, second, covering.of_input, bound);
  checker::Covering_checker back(second, first, covering.of_output, bound);
  answer.reason = forth.defect();
  if (!answer.reason.empty()) {
    answer.reason = "the input: " + answer.reason;
    return answer;
  }
  answer.reason = back.defect();
  if (!answer.reason.empty()) {
    answer.reason = "the output: " + answer.reason;
    return answer;
  }
  answer.bound = 0;
  answer.face_bounds = back.face_bounds();
  for (double& b : answer.face_bounds) {
    b /= scale;
    answer.bound = (std::max)(answer.bound, b);
  }
  for (const double b : forth.face_bounds()) answer.bound = (std::max)(answer.bound, b / scale);
  answer.holds = true;
  return answer;
}

/// \brief writes a covering as text, exactly.
///
/// The format is described in the manual. Whether the stream took everything is to be asked of the
/// stream.
///
/// \throws Invalid_input when the record cannot be read back, because a length is negative or not
///         finite, or lists do not fit together.
inline void write_covering(std::ostream& out, const Covering& covering)
{
  internal::checker::write_covering_text(out, covering);
}

/// \brief reads a covering that `write_covering()` wrote.
///
/// The file need not be trusted: it is checked line by line, and `check_covering()` takes any
/// record.
///
/// \throws Invalid_input naming the line, when the text is not a covering of a known version.
inline Covering read_covering(std::istream& in)
{
  return internal::checker::read_covering_text(in);
}

} // namespace surety

#endif // SURETY_COVERING_CERTIFICATE_H
