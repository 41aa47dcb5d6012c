// SPDX-License-Identifier: GPL-3.0-or-later
//
// Strict parsing of lengths: a tolerance that is misread ruins a result without a trace.
#include "length.h"

#include "failure.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace surety::tool {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& problem)
{
  throw Failure(
      usage,
      option + ": " + problem
          + "; give a positive length in mesh units, as 0.5, or a per cent of the bounding-box "
            "diagonal, as 0.1%");
}

} // namespace

Length Length::parse(const std::string& text, const std::string& option)
{
  const bool is_per_cent = !text.empty() && text.back() == '%';
  const std::string number = text.substr(0, text.size() - (is_per_cent ? 1 : 0));
  // strtod also takes hexadecimal, "inf" and "nan"; these characters admit decimals only.
  const bool is_decimal
      = !number.empty() && number.find_first_not_of("0123456789.eE+-") == std::string::npos;
  char* end = nullptr;
  const double value = is_decimal ? std::strtod(number.c_str(), &end) : 0;
  if (!is_decimal || *end != '\0') refuse(option, "'" + text + "' is not a length");
  if (!std::isfinite(value)) refuse(option, "'" + text + "' is too large");
  if (!(value > 0)) refuse(option, "'" + text + "' is not positive");
  if (is_per_cent && value > 100) refuse(option, "'" + text + "' is more than the whole diagonal");
  return {value, is_per_cent, option};
}

double Length::in_units(double diagonal) const
{
  const double length = is_per_cent_ ? value_ / 100 * diagonal : value_;
  std::ostringstream text;
  text << length << " is ";
  if (!(length > 0)) refuse(option_, text.str() + "too small for this mesh");
  if (length <= diagonal) return length;
  text << "longer than the diagonal of the mesh, " << diagonal;
  refuse(option_, text.str());
}

double diagonal(const Mesh& mesh)
{
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace surety::tool
