// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics in files: the text form of Medit's .sol, as mesh generators exchange it.
#ifndef SURETY_MEDIT_SOL_H
#define SURETY_MEDIT_SOL_H

#include <surety/errors.h>
#include <surety/internal/metric/medit_reader.h>
#include <surety/metric_field.h>

#include <CGAL/boost/graph/helpers.h>

#include <fstream>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

namespace surety {

/// \brief One size or one tensor a vertex, in the order of the vertices of a mesh.
///
/// Exactly one of the two lists is filled.
struct Medit_solution {
  std::vector<double> sizes;            ///< lengths in mesh units
  std::vector<Eigen::Matrix3d> tensors; ///< symmetric, positive definite

  /// Whether it holds tensors.
  bool is_anisotropic() const { return !tensors.empty(); }
  /// Of the mesh that it belongs to.
  std::size_t number_of_vertices() const { return sizes.size() + tensors.size(); }
};

/// \brief Reads a metric from the text form of a Medit .sol file.
///
/// The file must have three dimensions and, at vertices, one field of scalars (sizes) or of
/// symmetric tensors (xx, xy, yy, xz, yz, zz). Fields at other elements are skipped.
///
/// \throws Invalid_input with the number of the line when the text is not such a file, when a value
/// is not finite, a size not positive, or a tensor not positive definite.
inline Medit_solution read_medit_sol(std::istream& in)
{
  Medit_solution result;
  internal::metric::Medit_reader(in, "read_medit_sol").read(result.sizes, result.tensors);
  return result;
}

/// \brief Reads a metric from a file; see the other overload.
inline Medit_solution read_medit_sol(const std::string& path)
{
  std::ifstream in(path);
  if (!in) {
    throw Invalid_input("read_medit_sol", "path", "\"" + path + "\" cannot be opened");
  }
  return read_medit_sol(in);
}

/// \brief Reads a field of scalars at vertices, of any sign, from the text form of a Medit .sol
/// file.
///
/// \throws Invalid_input with the number of the line when the text is not such a file, or a value
/// is not finite.
inline std::vector<double> read_medit_scalars(std::istream& in)
{
  std::vector<double> result;
  internal::metric::Medit_reader(in, "read_medit_scalars").read_scalars(result);
  return result;
}

/// \brief Reads a field of scalars from a file; see the other overload.
inline std::vector<double> read_medit_scalars(const std::string& path)
{
  std::ifstream in(path);
  if (!in) {
    throw Invalid_input("read_medit_scalars", "path", "\"" + path + "\" cannot be opened");
  }
  return read_medit_scalars(in);
}

/// \brief Writes a metric as the text form of a Medit .sol file, such that it is read back to the
/// last bit.
///
/// \throws Invalid_input when not exactly one of the two lists is filled, or the stream fails.
inline void write_medit_sol(std::ostream& out, const Medit_solution& solution)
{
  if (solution.sizes.empty() == solution.tensors.empty()) {
    throw Invalid_input("write_medit_sol", "solution", "not exactly one of its lists is filled");
  }
  internal::metric::write_medit_sol(out, solution.sizes, solution.tensors);
  if (!out) throw Invalid_input("write_medit_sol", "out", "the stream cannot be written");
}

/// \brief The metric of each vertex, what satisfies all its sides, in the order of the vertices.
/// \pre No vertex is isolated.
template <class Mesh>
Medit_solution to_medit_sol(const Mesh& mesh, const Metric_field& metric)
{
  Medit_solution result;
  for (const auto v : vertices(mesh)) {
    if (metric.kind() == Metric_kind::isotropic) {
      result.sizes.push_back(metric.size_at_vertex(v));
    } else {
      result.tensors.push_back(metric.tensor_at_vertex(v));
    }
  }
  return result;
}

} // namespace surety

#endif // SURETY_MEDIT_SOL_H
