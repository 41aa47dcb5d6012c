// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_writing.h"

#include "colors.h"
#include "failure.h"
#include "ply.h"
#include "vtp.h"

#include <surety/internal/curvature/value.h>
#include <surety/medit_sol.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <sstream>
#include <vector>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;
using Vector = Eigen::Vector3d;

/// One array a name, filled vertex by vertex, all in the same order.
class Table
{
public:
  void add(const char* name, double value, bool is_integral = false)
  {
    put(name, {value}, is_integral);
  }
  void add(const char* name, const Vector& v) { put(name, {v.x(), v.y(), v.z()}, false); }
  void add(const char* name, const Eigen::Matrix3d& m)
  {
    put(name, {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)},
        false);
  }
  void end_row() { column_ = 0; }
  const std::vector<Vtp_array>& arrays() const { return arrays_; }

private:
  void put(const char* name, std::initializer_list<double> values, bool is_integral)
  {
    if (column_ == arrays_.size())
      arrays_.push_back({name, static_cast<int>(values.size()), {}, is_integral});
    auto& column = arrays_[column_++].values;
    column.insert(column.end(), values);
  }

  std::vector<Vtp_array> arrays_;
  std::size_t column_ = 0;
};

/// By side: the first face of it.
std::vector<std::size_t> faces_of_sides(const Mesh& mesh, const Sides& sides)
{
  std::vector<std::size_t> result(sides.size(), mesh.number_of_faces());
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_border(h)) continue;
    std::size_t& face = result[sides.of_corner[h]];
    face = std::min<std::size_t>(face, mesh.face(h));
  }
  return result;
}

const Side_curvature& shown_side(const Curvature_field& curvature, Vertex v)
{
  // The reader has refused isolated vertices: each has a side.
  return *internal::curvature::greatest_side(curvature, v);
}

void add_curvature(
    Table& table, const Curvature_field& curvature, const std::vector<std::size_t>& faces, Vertex v)
{
  const Side_curvature& side = shown_side(curvature, v);
  const Sides& sides = curvature.sides;
  table.add("mean_curvature", side.mean_curvature());
  table.add("gaussian_curvature", side.gaussian_curvature());
  table.add("min_curvature", side.min_curvature);
  table.add("max_curvature", side.max_curvature);
  table.add("min_direction", side.min_direction);
  table.add("max_direction", side.max_direction);
  table.add("normal", side.normal);
  table.add("point_type", double(side.type), true);
  table.add("sides", sides.first[v + 1] - sides.first[v], true);
  table.add("face_shown", double(faces[std::size_t(&side - curvature.side.data())]), true);
}

/// Sizes along the axes of the tensor; along the normal of a surface the larger one counts.
void add_metric(Table& table, const Metric_field& metric, Vertex v)
{
  const Eigen::Matrix3d m = metric.tensor_at_vertex(v);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  const Vector sizes = solver.eigenvalues().cwiseSqrt().cwiseInverse();
  const bool is_isotropic = metric.kind() == Metric_kind::isotropic;
  table.add("smallest_size", is_isotropic ? metric.size_at_vertex(v) : sizes[2]);
  if (is_isotropic) return;
  table.add("largest_size", sizes[0]);
  table.add("smallest_size_direction", Vector(solver.eigenvectors().col(2)));
  table.add("metric", m);
}

std::vector<Vtp_array> vertex_data(
    const Mesh& mesh, const Fields& fields, const Field_request& request)
{
  Table table;
  const auto faces = faces_of_sides(mesh, fields.curvature.sides);
  for (const Vertex v : mesh.vertices()) {
    if (request.curvature) add_curvature(table, fields.curvature, faces, v);
    if (request.metric) add_metric(table, fields.metric->field, v);
    table.end_row();
  }
  return table.arrays();
}

std::vector<double> colored_values(
    const Mesh& mesh, const Fields& fields, const Field_request& request)
{
  std::vector<double> values;
  for (const Vertex v : mesh.vertices()) {
    values.push_back(
        request.curvature ? shown_side(fields.curvature, v).mean_curvature()
                          : fields.metric->field.size_at_vertex(v));
  }
  return values;
}

CGAL::IO::Color color_of(double value, const Color_range& range, const Field_request& request)
{
  // Where all values are equal, they are in the middle.
  if (!(range.low < range.high)) return diverging(0);
  if (request.curvature) return diverging(value / range.high);
  const double position = std::log(value / range.low) / std::log(range.high / range.low);
  return diverging(2 * position - 1);
}

void write_ply(
    std::ostream& stream, const Mesh& mesh, const Fields& fields, const Field_request& request)
{
  const auto values = colored_values(mesh, fields, request);
  const Color_range range = color_range(mesh, fields, request);
  std::vector<CGAL::IO::Color> colors;
  for (const double value : values) colors.push_back(color_of(value, range, request));
  write_colored_ply(stream, mesh, colors, vertex_data(mesh, fields, request));
}

} // namespace

Color_range color_range(const Mesh& mesh, const Fields& fields, const Field_request& request)
{
  std::vector<double> values = colored_values(mesh, fields, request);
  if (!request.curvature) {
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return {"smallest_size", *least, *largest};
  }
  for (double& value : values) value = std::abs(value);
  const auto limit = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 98 / 100);
  std::nth_element(values.begin(), limit, values.end());
  return {"mean_curvature", -*limit, *limit};
}

void require_field_format(
    const std::string& file, const std::string& extension, const Field_request& request)
{
  if (request.is_empty()) {
    throw Failure(
        usage, "--output needs --curvature, --metric or --support: what shall be written?");
  }
  if (extension == "sol" && !request.metric) {
    throw Failure(usage, file + ": a sol file holds a metric; give --metric");
  }
  constexpr std::array<const char*, 3> known = {"vtp", "ply", "sol"};
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    throw Failure(
        usage, file + ": the format '" + extension + "' is none of fields; take vtp, ply or sol");
  }
}

void write_fields(
    std::ostream& stream, const std::string& extension, const Mesh& mesh, const Fields& fields,
    const Field_request& request)
{
  stream.precision(17);
  if (extension == "vtp") {
    write_vtp(
        stream, mesh, vertex_data(mesh, fields, request), {},
        request.curvature ? "mean_curvature" : "smallest_size");
  }
  if (extension == "ply") write_ply(stream, mesh, fields, request);
  if (extension == "sol") {
    std::ostringstream text; // so that a full disk is found where it is for all formats
    write_medit_sol(text, to_medit_sol(mesh, fields.metric->field));
    stream << text.str();
  }
}

} // namespace surety::tool
