// SPDX-License-Identifier: GPL-3.0-or-later
#include "fields.h"

#include "commands.h"
#include "controls.h"
#include "library_description.h"
#include "library_fields.h"
#include "length.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace surety::tool {
namespace {

const Names<Metric_kind>& names_of_kinds()
{
  static const Names<Metric_kind> names
      = {{"isotropic", Metric_kind::isotropic}, {"anisotropic", Metric_kind::anisotropic}};
  return names;
}

/// The least and the greatest of some values.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Json to_json(const Range& range) { return {range.low, range.high}; }

std::string shown(const Range& range) { return to_text(range.low) + " to " + to_text(range.high); }

struct Curvature_summary {
  Range min, max, mean, gaussian;
  std::array<std::size_t, 4> types{}; ///< by `Point_type`
  std::array<std::size_t, 6> fits{};  ///< by `Curvature_fit`
};

constexpr std::array<const char*, 4> names_of_types
    = {"planar", "parabolic", "elliptic", "hyperbolic"};
constexpr std::array<const char*, 6> names_of_fits
    = {"quartic", "cubic", "quadratic", "underdetermined", "three_coefficients", "none"};

Curvature_summary summarize(const Curvature_field& curvature)
{
  Curvature_summary summary;
  for (const Side_curvature& side : curvature.side) {
    summary.min.add(side.min_curvature);
    summary.max.add(side.max_curvature);
    summary.mean.add(side.mean_curvature());
    summary.gaussian.add(side.gaussian_curvature());
    ++summary.types[static_cast<std::size_t>(side.type)];
    ++summary.fits[static_cast<std::size_t>(side.fit)];
  }
  return summary;
}

template <std::size_t N>
Json counts(const std::array<const char*, N>& names, const std::array<std::size_t, N>& numbers)
{
  Json result = Json::object();
  for (std::size_t i = 0; i < N; ++i) result[names[i]] = numbers[i];
  return result;
}

/// Least and largest size in the tangent plane of a side. The size along the normal is the larger
/// one, so that the middle size is the larger one, too.
std::pair<double, double> tangential_sizes(const Metric_field& metric, Metric_field::Side s)
{
  if (metric.kind() == Metric_kind::isotropic) return {metric.size(s), metric.size(s)};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      metric.tensor(s), Eigen::EigenvaluesOnly);
  const Eigen::Vector3d lambda = solver.eigenvalues();
  return {1 / std::sqrt(lambda[2]), 1 / std::sqrt(lambda[1])};
}

/// The area of the mesh in the metric over that of an equilateral triangle of side 1, sqrt(3)/4.
/// The area element is interpolated linearly over each face.
double predicted_faces(const Mesh& mesh, const Metric_field& metric)
{
  double doubled_area = 0;
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    const auto edge = [&](Mesh::Halfedge_index along) {
      const auto d = mesh.point(mesh.target(along)) - mesh.point(mesh.source(along));
      return Eigen::Vector3d(d.x(), d.y(), d.z());
    };
    const Eigen::Vector3d a = edge(h), b = edge(mesh.next(h));
    double sum = 0;
    for (const auto corner : mesh.halfedges_around_face(h)) {
      const Eigen::Matrix3d m = metric.tensor_at_corner(corner);
      const double aa = a.dot(m * a), ab = a.dot(m * b), bb = b.dot(m * b);
      sum += std::sqrt(std::max(0., aa * bb - ab * ab));
    }
    doubled_area += sum / 3;
  }
  return doubled_area / 2 / (std::sqrt(3.) / 4);
}

/// The user's lengths in mesh units; what is not given is as in the library.
Metric_controls controls_for(const Field_request& request, double diagonal)
{
  const auto length = [&](const std::string& text, const char* option) {
    return Length::parse(text, option).in_units(diagonal);
  };
  Metric_controls controls{
      length(request.tolerance, "--tolerance"), 0, diagonal / 10, request.kind};
  if (!request.maximum_size.empty())
    controls.maximum_size = length(request.maximum_size, "--max-size");
  controls.minimum_size = std::min(controls.tolerance, controls.maximum_size);
  if (!request.minimum_size.empty())
    controls.minimum_size = length(request.minimum_size, "--min-size");
  if (request.maximum_size.empty())
    controls.maximum_size = std::max(controls.maximum_size, controls.minimum_size);
  if (controls.minimum_size > controls.maximum_size) {
    throw Failure(
        usage,
        "--min-size: " + to_text(controls.minimum_size) + " is more than --max-size, "
            + to_text(controls.maximum_size));
  }
  return controls;
}

Graded_metric make_metric(
    const Mesh& mesh, const Curvature_field& curvature, const Metric_controls& controls,
    double gradation)
{
  Graded_metric metric{
      make_geometric_metric(mesh, curvature, metric_parameters(controls)), controls.tolerance,
      controls.minimum_size, controls.maximum_size, gradation};
  metric.changed_sides = limit_gradation(mesh, metric.field, parameters::gradation(gradation));
  metric.predicted_faces = predicted_faces(mesh, metric.field);
  return metric;
}

} // namespace

void add_field_options(CLI::App& command, Field_request& request)
{
  command.add_flag(
      "--curvature", request.curvature, "principal curvatures and directions, and point types");
  const auto metric
      = command.add_flag("--metric", request.metric, "sizes with which a mesh follows the surface");
  command.add_option(
      "--noise-floor", request.noise_floor,
      "noise that the points have at least: a length, or per cent of the diagonal");
  const auto add = [&](const char* name, auto& value, const char* text) {
    return command.add_option(name, value, text)->needs(metric);
  };
  add("--metric-kind", request.kind, "whether sizes depend on direction")
      ->transform(CLI::CheckedTransformer(names_of_kinds()).description("isotropic|anisotropic"))
      ->default_str(name_of(request.kind, names_of_kinds()));
  add("--gradation", request.gradation,
      "factor by which sizes may grow along an edge of unit length; inf: any")
      ->check(between(1, std::numeric_limits<double>::infinity()))
      ->capture_default_str();
  add("--min-size", request.minimum_size, "least size: a length or per cent; else the tolerance");
  add("--max-size", request.maximum_size, "largest size: a length or per cent; else 10%");
}

void check(const Field_request& request)
{
  if (request.metric && request.tolerance.empty()) {
    throw Failure(usage, "--metric needs --tolerance: how far may a face be from the surface?");
  }
  const std::array<std::pair<const char*, const std::string*>, 4> lengths
      = {{{"--noise-floor", &request.noise_floor},
          {"--tolerance", &request.tolerance},
          {"--min-size", &request.minimum_size},
          {"--max-size", &request.maximum_size}}};
  for (const auto& [option, text] : lengths) {
    if (!text->empty()) Length::parse(*text, option);
  }
}

Fields make_fields(
    const Mesh& mesh, const Features& features, const Field_request& request, Stopwatch& watch)
{
  const double size = diagonal(mesh);
  const double noise_floor = request.noise_floor.empty()
      ? internal::defaults::noise_floor
      : Length::parse(request.noise_floor, "--noise-floor").in_units(size);
  std::optional<Metric_controls> controls;
  if (request.metric) controls = controls_for(request, size);

  Fields fields;
  fields.curvature
      = estimate_curvatures<Concurrency>(mesh, features, curvature_parameters(noise_floor));
  watch.lap("curvature");
  if (controls) {
    fields.metric = make_metric(mesh, fields.curvature, *controls, request.gradation);
    watch.lap("metric");
  }
  return fields;
}

Json describe(const Curvature_field& curvature)
{
  const Curvature_summary summary = summarize(curvature);
  return {
      {"sides", curvature.side.size()},
      {"min_curvature", to_json(summary.min)},
      {"max_curvature", to_json(summary.max)},
      {"mean_curvature", to_json(summary.mean)},
      {"gaussian_curvature", to_json(summary.gaussian)},
      {"point_types", counts(names_of_types, summary.types)},
      {"fits", counts(names_of_fits, summary.fits)},
      {"fallbacks", curvature.fallbacks}};
}

Json describe(const Graded_metric& metric)
{
  Range sizes;
  double aspect_ratio = 1;
  for (Metric_field::Side s = 0; s < metric.field.number_of_sides(); ++s) {
    const auto [least, largest] = tangential_sizes(metric.field, s);
    sizes.add(least);
    sizes.add(largest);
    aspect_ratio = std::max(aspect_ratio, largest / least);
  }
  return {
      {"kind", name_of(metric.field.kind(), names_of_kinds())},
      {"tolerance", metric.tolerance},
      {"minimum_size", metric.minimum_size},
      {"maximum_size", metric.maximum_size},
      // JSON has no infinity.
      {"gradation", std::isfinite(metric.gradation) ? Json(metric.gradation) : Json("inf")},
      {"sizes", to_json(sizes)},
      {"largest_aspect_ratio", aspect_ratio},
      {"sides_changed_by_gradation", metric.changed_sides},
      {"predicted_faces", metric.predicted_faces}};
}

std::string to_text(const Curvature_field& curvature)
{
  const Curvature_summary summary = summarize(curvature);
  std::ostringstream text;
  text << "  curvature: " << to_text(summary.min.low) << " to " << to_text(summary.max.high)
       << ", mean " << shown(summary.mean) << ", Gaussian " << shown(summary.gaussian) << "\n  ";
  for (std::size_t i = 0; i < summary.types.size(); ++i) {
    text << (i == 0 ? "points: " : ", ") << to_text(summary.types[i]) << ' ' << names_of_types[i];
  }
  text << "; " << to_text(curvature.fallbacks) << " from a poorer fit\n";
  return text.str();
}

std::string to_text(const Graded_metric& metric)
{
  const Json json = describe(metric);
  std::ostringstream text;
  text << "  metric: " << json["kind"].get<std::string>() << ", sizes "
       << to_text(json["sizes"][0].get<double>()) << " to "
       << to_text(json["sizes"][1].get<double>()) << ", about "
       << to_text(static_cast<std::size_t>(metric.predicted_faces + 0.5))
       << " triangles within a tolerance of " << to_text(metric.tolerance) << '\n';
  return text.str();
}

} // namespace surety::tool
