// SPDX-License-Identifier: GPL-3.0-or-later
//
// Medit's .sol in text form. A count in the file reserves only a little memory.
#ifndef SURETY_INTERNAL_METRIC_MEDIT_READER_H
#define SURETY_INTERNAL_METRIC_MEDIT_READER_H

#include <surety/internal/metric/medit_words.h>
#include <surety/internal/metric/tensor.h>
#include <surety/internal/validation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace surety::internal::metric {

/// Where the six numbers of a symmetric tensor belong: xx, xy, yy, xz, yz, zz.
constexpr std::array<std::array<int, 2>, 6> medit_order
    = {{{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}}};

class Medit_reader : Medit_words
{
  enum Type { scalar = 1, vector = 2, tensor = 3 };

public:
  using Medit_words::Medit_words;

  /// Values of a field, of any sign.
  void read_scalars(std::vector<double>& values)
  {
    only_scalars_ = true;
    std::vector<Tensor> none;
    read(values, none);
  }

  void read(std::vector<double>& sizes, std::vector<Tensor>& tensors)
  {
    bool has_dimension = false, has_field = false;
    std::string keyword;
    while (next(keyword) && keyword != "End") {
      if (keyword == "MeshVersionFormatted") {
        count();
      } else if (keyword == "Dimension") {
        const std::size_t dimension = count();
        if (dimension != 3) fail("the dimension is " + std::to_string(dimension) + ", not 3");
        has_dimension = true;
      } else if (keyword.rfind("SolAt", 0) == 0) {
        if (!has_dimension) fail("the dimension must come before \"" + keyword + "\"");
        if (keyword != "SolAtVertices") {
          skip_field();
        } else if (has_field) {
          fail("there is more than one SolAtVertices");
        } else {
          read_field(sizes, tensors);
          has_field = true;
        }
      } else {
        fail("the keyword \"" + shown(keyword) + "\" is not known");
      }
    }
    if (!has_field) fail("there is no SolAtVertices");
  }

private:
  static std::size_t length(std::size_t type)
  {
    return type == scalar ? 1 : type == vector ? 3 : type == tensor ? 6 : 0;
  }

  void skip_field()
  {
    const std::size_t elements = count(), fields = count();
    std::vector<std::size_t> lengths;
    for (std::size_t i = 0; i < fields; ++i) {
      lengths.push_back(length(count()));
      if (lengths.back() == 0) fail("the type of a field is not 1, 2 or 3");
    }
    for (std::size_t i = 0; i < elements; ++i) {
      for (const std::size_t n : lengths) {
        for (std::size_t k = 0; k < n; ++k) real();
      }
    }
  }

  void read_field(std::vector<double>& sizes, std::vector<Tensor>& tensors)
  {
    const std::size_t elements = count();
    if (elements == 0) fail("there are no vertices");
    const std::size_t fields = count();
    if (fields != 1) fail("there are " + std::to_string(fields) + " fields, not 1");
    const std::size_t type = count();
    if (type != scalar && type != tensor) {
      fail("the type of the field is " + std::to_string(type) + ", not 1 (scalar) or 3 (tensor)");
    }
    if (only_scalars_ && type != scalar)
      fail("the type of the field is " + std::to_string(type) + ", not 1 (scalar)");
    const std::size_t reserved = (std::min)(elements, std::size_t(1) << 16);
    type == scalar ? sizes.reserve(reserved) : tensors.reserve(reserved);
    for (std::size_t i = 0; i < elements; ++i) {
      if (type == scalar) {
        sizes.push_back(real());
        if (!only_scalars_ && !(sizes.back() > 0)) fail("the size " + shown() + " is not positive");
      } else {
        tensors.push_back(read_tensor());
      }
    }
  }

  Tensor read_tensor()
  {
    Tensor m;
    for (const auto& [i, j] : medit_order) m(i, j) = m(j, i) = real();
    const Eigen::SelfAdjointEigenSolver<Tensor> solver(m, Eigen::EigenvaluesOnly);
    if (!(solver.eigenvalues()[0] > 0)) fail("the tensor is not positive definite");
    return m;
  }

  bool only_scalars_ = false;
};

inline void write_medit_sol(
    std::ostream& out, const std::vector<double>& sizes, const std::vector<Tensor>& tensors)
{
  out << "MeshVersionFormatted 2\n\nDimension 3\n\nSolAtVertices\n"
      << std::to_string(sizes.size() + tensors.size()) << "\n1 " << (tensors.empty() ? 1 : 3)
      << "\n\n";
  for (const double size : sizes) out << shortest_text(size) << '\n';
  for (const Tensor& m : tensors) {
    for (const auto& [i, j] : medit_order) {
      out << shortest_text(m(i, j)) << (i == 2 && j == 2 ? '\n' : ' ');
    }
  }
  out << "\nEnd\n";
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_MEDIT_READER_H
