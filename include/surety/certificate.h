// SPDX-License-Identifier: GPL-3.0-or-later
//
// The proof that comes with every result: what it promises, how anyone checks it, and how it is
// kept in a file beside the mesh.
#ifndef SURETY_CERTIFICATE_H
#define SURETY_CERTIFICATE_H

#include <surety/correspondence.h>
#include <surety/distance.h>
#include <surety/errors.h>
#include <surety/internal/certificate/checker.h>
#include <surety/internal/certificate/text_format.h>
#include <surety/internal/certificate/text_reader.h>
#include <surety/operations.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surety {

/// \brief What a simplification promises of its result: the two-sided Hausdorff distance between
/// the input and the output is at most `bound()`.
///
/// With the direct bound it carries the map from the input to the output that proves it; then
/// `check_certificate()` verifies the promise without trust in the program that made it. With the
/// accumulated bound it does not; then `certify_distance()` is the check.
class Certificate
{
public:
  /// For the functions that make certificates.
  Certificate(
      double tolerance, double bound, std::optional<Correspondence> correspondence,
      Operations operations = {}, bool cancelled = false)
    : tolerance_(tolerance),
      bound_(bound),
      correspondence_(std::move(correspondence)),
      operations_(operations),
      is_cancelled_(cancelled)
  {}

  /// The distance that was asked for, a length.
  double tolerance() const { return tolerance_; }
  /// The distance that is promised, a length.
  double bound() const { return bound_; }
  /// Whether the promise is as good as what was asked for.
  bool holds() const { return bound_ <= tolerance_; }

  /// The map that proves the bound, unless the bound was accumulated.
  const std::optional<Correspondence>& correspondence() const { return correspondence_; }
  /// What was done on the way, and what was refused.
  const Operations& operations() const { return operations_; }
  /// Whether a visitor ended the work early; the promise holds all the same.
  bool is_cancelled() const { return is_cancelled_; }

private:
  double tolerance_;
  double bound_;
  std::optional<Correspondence> correspondence_;
  Operations operations_;
  bool is_cancelled_;
};

/// The answer of `check_certificate()`.
struct Certificate_check {
  /// The proof is complete: the distance is at most `bound`, which is at most the tolerance.
  bool holds = false;
  /// Empty if the proof is complete. Otherwise what is wrong: the invariant (`structure`, `I1`,
  /// `I2`, `I3`, `degree`, `border` or `I5`) and the element.
  std::string reason;
  /// The proven distance, rebuilt from the record and rounded up; infinite if nothing is proven.
  double bound = std::numeric_limits<double>::infinity();
  /// A proven bound of the distance, both ways, between the recorded ridges and borders of the two
  /// as curves; 0 where there are none, infinite if nothing is proven.
  double curve_bound = std::numeric_limits<double>::infinity();
  /// For each face of the output, in iteration order, a proven bound of the distance of its points
  /// to the input; empty if nothing is proven.
  std::vector<double> face_bounds;
  /// For each face of the output, in iteration order, a proven bound of the angle, in degrees,
  /// between its normal and the normal of any face of the input of which a part is mapped there;
  /// empty if nothing is proven. Where the record leaves a choice of how to divide a face of the
  /// input, it is a bound for the division that was found, and others may give less. A face of the
  /// input of which a part shrinks to an edge or a vertex of the output is compared with the best
  /// of the faces there. 180 where a face has no area.
  std::vector<double> normal_deviations;
  /// The largest of them; infinite if nothing is proven.
  double largest_normal_deviation = std::numeric_limits<double>::infinity();
};

/// \brief verifies a certificate against the two meshes, from its record alone.
///
/// If the answer holds, then every point of either mesh lies within `bound` of the other, rounding
/// included; so do the borders of the two meshes, as curves, and the recorded ridges. The check
/// shares no code with the simplification and takes linear time. It does not say that the output is
/// free of self-intersections.
///
/// A record that is wrong in whatever way is an answer, not an error.
///
/// \param input,output the meshes; their elements are numbered in iteration order, so both must be
///        as they were written.
/// \param certificate as returned by a simplification or read from a file.
/// \pre All faces are triangles, and the coordinates of the points are of type `double` or `float`.
/// \throws Invalid_input when a face is not a triangle.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices, for each mesh its own}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Input_mesh, class Output_mesh,
    class Named_parameters_1 = CGAL::parameters::Default_named_parameters,
    class Named_parameters_2 = CGAL::parameters::Default_named_parameters>
Certificate_check check_certificate(
    const Input_mesh& input, const Output_mesh& output, const Certificate& certificate,
    const Named_parameters_1& np_input = CGAL::parameters::default_values(),
    const Named_parameters_2& np_output = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  namespace checker = internal::checker;

  Certificate_check answer;
  if (!certificate.correspondence()) {
    answer.reason = "structure: the certificate records no map; check the distance of the two "
                    "meshes with certify_distance instead";
    return answer;
  }
  auto input_table = checker::read_triangles(
      input,
      choose_parameter(
          get_parameter(np_input, CGAL::internal_np::vertex_point), get(CGAL::vertex_point, input)),
      "input");
  auto output_table = checker::read_triangles(
      output,
      choose_parameter(
          get_parameter(np_output, CGAL::internal_np::vertex_point),
          get(CGAL::vertex_point, output)),
      "output");
  const double scale = checker::scale_of_products(input_table);
  input_table.scale(scale);
  output_table.scale(scale);
  checker::Checker check(input_table, output_table, *certificate.correspondence());
  answer.holds = check.check(scale * certificate.tolerance(), scale * certificate.bound());
  answer.reason = check.reason();
  if (answer.holds) {
    answer.bound = check.bound() / scale;
    answer.curve_bound = check.curve_bound() / scale;
    answer.face_bounds = check.face_bounds();
    for (double& bound : answer.face_bounds) bound /= scale;
    answer.normal_deviations = check.normal_deviations();
    answer.largest_normal_deviation
        = *std::max_element(answer.normal_deviations.begin(), answer.normal_deviations.end());
  }
  return answer;
}

/// \brief writes a certificate as text, exactly.
///
/// The format is described in `surety/internal/certificate/text_format.h` and in the manual.
/// Whether the stream took everything is to be asked of the stream.
///
/// \throws Invalid_input when the certificate records no map, or one that cannot be read back.
inline void write_certificate(std::ostream& out, const Certificate& certificate)
{
  if (!certificate.correspondence()) {
    throw Invalid_input(
        "write_certificate", "certificate", "it records no map",
        "use the direct bound, or check the distance with certify_distance");
  }
  const Correspondence& record = *certificate.correspondence();
  std::string defect = internal::checker::record_defect(record);
  for (const double length : {certificate.tolerance(), certificate.bound()}) {
    if (!std::isfinite(length) || std::signbit(length))
      defect = "a length is negative or not finite";
  }
  if (!defect.empty()) throw Invalid_input("write_certificate", "certificate", defect);
  internal::checker::write_text(
      out,
      {certificate.tolerance(), certificate.bound(), certificate.is_cancelled(),
       certificate.operations()},
      record);
}

/// \brief reads a certificate that `write_certificate()` wrote.
///
/// Reads up to the line `end` and leaves what follows in the stream. The file need not be trusted:
/// it is checked line by line, and `check_certificate()` takes any record.
///
/// \throws Invalid_input naming the line, when the text is not a certificate of a known version.
inline Certificate read_certificate(std::istream& in)
{
  internal::checker::Header header;
  Correspondence record;
  internal::checker::Text_reader(in).read(header, record);
  return Certificate(
      header.tolerance, header.bound, std::move(record), header.operations, header.cancelled);
}

} // namespace surety

#endif // SURETY_CERTIFICATE_H
