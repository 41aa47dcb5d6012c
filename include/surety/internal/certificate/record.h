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

/// What is wrong with an inner item by itself; empty if nothing. The sum is rounded: what this
/// means for the place of the item is said in measure.h.
inline std::string inner_defect(const Correspondence::Inner& inner)
{
  if (!(inner.lambda >= 0 && inner.mu >= 0)) return "lambda or mu is not a number or negative";
  return inner.lambda + inner.mu <= 1 ? "" : "lambda + mu exceeds 1";
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

constexpr const char* inner_order_defect = "inner items are not sorted by face, one in each";

inline std::string inner_items_defect(const Correspondence& record)
{
  for (std::size_t i = 0; i < record.inner.size(); ++i) {
    std::string problem = inner_defect(record.inner[i]);
    if (problem.empty() && i > 0 && record.inner[i - 1].face >= record.inner[i].face) {
      problem = inner_order_defect;
    }
    if (!problem.empty()) {
      return "inner item of input face " + std::to_string(record.inner[i].face) + ": " + problem;
    }
  }
  return "";
}

inline bool has_too_many_items(const Correspondence& record)
{
  std::size_t left = none;
  for (const std::size_t number :
       {record.images.size(), record.crossings.size(), record.inner.size()}) {
    if (number >= left) return true;
    left -= number;
  }
  return false;
}

/// What is wrong with the record by itself; empty if nothing.
inline std::string record_defect(const Correspondence& record)
{
  if (has_too_many_items(record)) return "there are more items than indices";
  for (std::size_t v = 0; v < record.images.size(); ++v) {
    const std::string problem = image_defect(record.images[v]);
    if (!problem.empty()) return "image of input vertex " + std::to_string(v) + ": " + problem;
  }
  std::string problem = offsets_defect(record);
  if (problem.empty()) problem = crossings_defect(record);
  if (problem.empty()) problem = inner_items_defect(record);
  if (!problem.empty()) return problem;
  for (const Vertex_pair& ridge : record.ridges) {
    problem = edge_name_defect(ridge, record.images.size());
    if (!problem.empty()) return "input ridge " + to_string(ridge) + ": " + problem;
  }
  return "";
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_RECORD_H
