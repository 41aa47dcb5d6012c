// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page is the template of report_page/ with the report and the meshes in it as data. Text that
// comes from outside, as the names of files do, cannot end the element that holds the data.
#include "html_report.h"

#include "faces.h"
#include "failure.h"
#include "report_page.h"
#include "shown_mesh.h"
#include "soup_reading.h"

#include <surety/metric_fit.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

namespace surety::tool {
namespace {

/// A mesh with more faces is shown by fewer, so that pages stay below 3 MB whatever both meshes
/// have. The result is what people look at: it may have more.
constexpr std::size_t most_faces_of_input = 60000, most_faces_of_output = 80000,
                      faces_of_large_mesh = 30000;

/// Faces that are worse all have the last colour.
constexpr double worst_shown_quality = 4;

/// JSON inside of HTML: only `<` could end the element; all that is not ASCII is escaped too, so
/// that no encoding matters.
std::string to_script_data(const Json& json)
{
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

Json quality_histogram(const std::vector<double>& qualities)
{
  const auto& limits = Metric_fit::quality_limits;
  std::vector<std::size_t> counts(limits.size() + 1);
  for (const double q : qualities)
    ++counts[std::size_t(std::lower_bound(limits.begin(), limits.end(), q) - limits.begin())];
  return histogram(limits.data(), limits.size(), counts.data());
}

/// Fields whose colours mean the same in both views.
class Field_maker
{
public:
  explicit Field_maker(const Compared_meshes& meshes)
    : input_sizes_(face_sizes(meshes.input)),
      output_sizes_(face_sizes(meshes.output)),
      deviation_(meshes.deviation)
  {
    for (const auto* sizes : {&input_sizes_, &output_sizes_})
      for (const double size : *sizes) {
        least_ = std::min(least_, size);
        largest_ = std::max(largest_, size);
      }
  }

  std::vector<Shown_field> of_input(std::vector<double> qualities) const
  {
    return {shape(std::move(qualities)), size(input_sizes_)};
  }

  std::vector<Shown_field> of_output(const Mesh& mesh, std::vector<double> qualities) const
  {
    std::vector<double> bounds;
    for (const auto face : mesh.faces()) bounds.push_back(get(deviation_.bound, face));
    return {
        {"deviation", "proven deviation", 0, deviation_.tolerance, std::move(bounds)},
        shape(std::move(qualities)),
        size(output_sizes_)};
  }

private:
  static Shown_field shape(std::vector<double> qualities)
  {
    return {"quality", "quality Q", 1, worst_shown_quality, std::move(qualities)};
  }
  Shown_field size(const std::vector<double>& sizes) const
  {
    // Where all have one size, any other limit will do.
    const double high = largest_ > least_ ? largest_ : 2 * least_;
    return {"size", "edge length", least_, high, sizes};
  }

  std::vector<double> input_sizes_, output_sizes_;
  const Deviation& deviation_;
  double least_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

std::string number_of_faces(const Mesh& mesh)
{
  return to_text(std::size_t(mesh.number_of_faces()));
}

/// \param most faces to be shown as they are, with what `fields_of` makes of their qualities
template <class Fields_of>
Json describe_view(
    const Mesh& mesh, const char* title, std::size_t most, const Fields_of& fields_of)
{
  const std::vector<double> qualities = face_qualities(mesh);
  std::optional<Display_mesh> simplified;
  if (mesh.number_of_faces() > most) simplified = simplified_for_display(mesh, faces_of_large_mesh);
  Json view = simplified ? describe_shape(simplified->mesh, {})
                         : describe_shape(mesh, fields_of(qualities));
  view["title"] = title;
  view["note"] = number_of_faces(mesh) + " faces";
  if (simplified)
    view["note"] = number_of_faces(mesh) + " faces, shown by " + number_of_faces(simplified->mesh)
        + " that lie within " + to_text(simplified->bound) + " of them, without values";
  view["qualities"] = quality_histogram(qualities);
  return view;
}

Json describe_input(const Mesh& mesh, const Field_maker& fields)
{
  return describe_view(
      mesh, "before", most_faces_of_input,
      [&](const std::vector<double>& qualities) { return fields.of_input(qualities); });
}

Json describe_output(const Mesh& mesh, const Field_maker& fields)
{
  return describe_view(
      mesh, "after", most_faces_of_output,
      [&](const std::vector<double>& qualities) { return fields.of_output(mesh, qualities); });
}

/// Puts texts where the template has `@name@`, each once and in the order of the template.
void fill(
    std::ostream& stream, std::string_view page,
    const std::array<std::pair<std::string_view, std::string_view>, 6>& texts)
{
  for (const auto& [mark, text] : texts) {
    const std::size_t position = page.find(mark);
    CGAL_assertion(position != std::string_view::npos);
    stream << page.substr(0, position) << text;
    page.remove_prefix(position + mark.size());
  }
  stream << page;
}

} // namespace

bool is_html(const std::string& file)
{
  const std::string extension = extension_of(file);
  return extension == "html" || extension == "htm";
}

void require_possible_report(const std::string& file)
{
  if (!is_html(file) || report_page()) return;
  throw Failure(
      usage,
      file
          + ": this program was built without three.js, which pages need; install Debian's package "
            "libjs-three and build again, or give a name that ends in .json");
}

void require_json_report(const std::string& file)
{
  if (is_html(file))
    throw Failure(
        usage, file + ": this command reports as JSON only; give a name that ends in .json");
}

void write_report(
    std::ostream& stream, const std::string& file, const Json& report,
    const Compared_meshes& meshes)
{
  if (!is_html(file)) {
    stream << to_text(report);
    return;
  }
  const Report_page& page = *report_page();
  const Field_maker fields(meshes);
  const Json views = {describe_input(meshes.input, fields), describe_output(meshes.output, fields)};
  const std::string report_data = to_script_data(report), view_data = to_script_data(views);
  fill(
      stream, page.page,
      {{{"@style@", page.style},
        {"@report@", report_data},
        {"@views@", view_data},
        {"@viewer@", page.viewer},
        {"@controls@", page.controls},
        {"@script@", page.script}}});
}

} // namespace surety::tool
