// SPDX-License-Identifier: GPL-3.0-or-later
#include "support.h"

#include "failure.h"
#include "library_description.h"
#include "library_fields.h"
#include "length.h"

#include <sstream>

namespace surety::tool {

void add_support_options(CLI::App& command, Support_request& request)
{
  const auto support = command.add_flag(
      "--support", request.is_wanted, "a smooth surface through the vertices, within a tolerance");
  command
      .add_option(
          "--subdivisions", request.subdivisions,
          "of each edge, where the support is written as triangles")
      ->needs(support)
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
}

Support make_support(const Mesh& mesh, const Support_request& request, Stopwatch& watch)
{
  const double size = diagonal(mesh);
  const double tolerance = Length::parse(request.tolerance, "--tolerance").in_units(size);
  const double noise_floor = request.noise_floor.empty()
      ? internal::defaults::noise_floor
      : Length::parse(request.noise_floor, "--noise-floor").in_units(size);
  Features features = request.feature_angle
      ? find_features(mesh, feature_parameters(*request.feature_angle, request.corner_angle))
      : find_features_by_need(mesh, tolerance, need_parameters(request.corner_angle));
  watch.lap("support_features");
  const Curvature_field curvature
      = estimate_curvatures<Concurrency>(mesh, features, curvature_parameters(noise_floor));
  watch.lap("support_normals");
  Geometric_support surface
      = make_geometric_support(mesh, tolerance, features, curvature, No_parameters());
  watch.lap("support");
  return {std::move(features), std::move(surface)};
}

Json describe(const Support& support)
{
  const Support_report& report = support.surface.report();
  // What was flattened or promoted is not told: that happens to supports of geometric meshes only.
  return {
      {"tolerance", report.tolerance},
      {"deviation", report.deviation},
      {"ridge_edges", support.features.ridges},
      {"corners", support.features.corners},
      {"smooth_share", report.tangent_share},
      {"sampled_smooth_share", report.sampled_tangent_share},
      {"saturated_share", report.saturated_share},
      {"sampled_saturated_share", report.sampled_saturated_share},
      {"refused_share", report.refused_share},
      {"refused_faces", report.refused_faces},
      {"misaligned_sides", report.misaligned_sides}};
}

std::string to_text(const Support& support)
{
  const Support_report& report = support.surface.report();
  const auto per_cent = [](double share) { return to_text(100 * share) + " %"; };
  std::ostringstream text;
  text << "  support: within " << to_text(report.deviation) << " of the mesh, for a tolerance of "
       << to_text(report.tolerance) << ", with " << to_text(support.features.ridges)
       << " ridge edges\n    smooth on about " << per_cent(report.sampled_tangent_share)
       << " of the area, at least " << per_cent(report.tangent_share) << "; saturated on about "
       << per_cent(report.sampled_saturated_share) << ", at most "
       << per_cent(report.saturated_share) << "; refused on " << per_cent(report.refused_share)
       << '\n';
  return text.str();
}

void require_support_format(const std::string& file, const std::string& extension)
{
  if (extension == "vtp" || extension == "ply") return;
  throw Failure(
      usage, file + ": the format '" + extension + "' is none of supports; take vtp or ply");
}

} // namespace surety::tool
