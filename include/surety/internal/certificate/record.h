// SPDX-License-Identifier: GPL-3.0-or-later
//
// What can be said about a Correspondence without looking at the meshes: that its arrays fit
// together and its numbers are in range. Checker, writer and reader ask the same questions.
#ifndef SURETY_INTERNAL_CERTIFICATE_RECORD_H
#define SURETY_INTERNAL_CERTIFICATE_RECORD_H

#include <surety/correspondence.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace surety::internal::checker {

using Index = std::uint32_t;
using Vertex_pair = std::array<Index, 2>;
constexpr Index none = 0xffffffffu;

inline std::string to_string(const Vertex_pair& pair)
{
  return "(" + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + ")";
}

/// What is wrong with an image by itself; empty if nothing.
inline std::string image_defect(const Correspondence::Image& image)
{
  switch (image.kind) {
  case Correspondence::Kind::vertex:
  case Correspondence::Kind::face:
    return image.b == 0 ? "" : "its second index is not 0";
  case Correspondence::Kind::edge:
    return image.a < image.b ? "" : "its edge is not (a, b), a < b";
  }
  return "its kind is unknown";
}

/// What is wrong with a crossing that follows one at `previous`; empty if nothing.
inline std::string crossing_defect(const Correspondence::Crossing& crossing, double previous)
{
  if (crossing.a >= crossing.b) return "its edge is not (a, b), a < b";
  if (!(crossing.lambda >= 0 && crossing.lambda <= 1)) return "lambda is not in [0, 1]";
  return crossing.lambda >= previous ? "" : "lambda decreases along the edge";
}

/// What is wrong with an edge of T as a name; empty if nothing.
inline std::string edge_name_defect(const Vertex_pair& edge, std::size_t vertices)
{
  if (edge[0] >= edge[1]) return "it is not (s, t), s < t";
  return edge[1] < vertices ? "" : "the record has fewer vertices";
}

inline std::string offsets_defect(const Correspondence& record)
{
  const auto& offsets = record.offsets;
  if (offsets.empty() && record.edges.empty() && record.crossings.empty()) return "";
  if (offsets.size() != record.edges.size() + 1) return "there must be one offset more than edges";
  if (offsets.front() != 0) return "the first offset is not 0";
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    if (offsets[i] < offsets[i - 1]) return "offset " + std::to_string(i) + " decreases";
  }
  if (offsets.back() != record.crossings.size()) return "offsets and crossings do not match";
  return "";
}

inline std::string crossings_defect(const Correspondence& record)
{
  for (std::size_t i = 0; i < record.edges.size(); ++i) {
    const Vertex_pair& edge = record.edges[i];
    std::string problem = edge_name_defect(edge, record.images.size());
    if (problem.empty() && i > 0 && !(record.edges[i - 1] < edge)) problem = "edges are not sorted";
    if (!problem.empty()) return "input edge " + to_string(edge) + ": " + problem;

    double previous = 0;
    for (Index k = record.offsets[i]; k < record.offsets[i + 1]; ++k) {
      problem = crossing_defect(record.crossings[k], previous);
      if (!problem.empty()) {
        return "crossing " + std::to_string(k - record.offsets[i]) + " of input edge "
            + to_string(edge) + ": " + problem;
      }
      previous = record.crossings[k].lambda;
    }
  }
  return "";
}

/// What is wrong with the record by itself; empty if nothing.
inline std::string record_defect(const Correspondence& record)
{
  if (record.images.size() >= none || record.crossings.size() >= none - record.images.size()) {
    return "there are more items than indices";
  }
  for (std::size_t v = 0; v < record.images.size(); ++v) {
    const std::string problem = image_defect(record.images[v]);
    if (!problem.empty()) return "image of input vertex " + std::to_string(v) + ": " + problem;
  }
  std::string problem = offsets_defect(record);
  if (problem.empty()) problem = crossings_defect(record);
  if (!problem.empty()) return problem;
  for (const Vertex_pair& ridge : record.ridges) {
    problem = edge_name_defect(ridge, record.images.size());
    if (!problem.empty()) return "input ridge " + to_string(ridge) + ": " + problem;
  }
  return "";
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_RECORD_H
