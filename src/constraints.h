// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges and vertices that the input says are features, as maps that the library reads.
#ifndef SURETY_TOOL_CONSTRAINTS_H
#define SURETY_TOOL_CONSTRAINTS_H

#include "mesh.h"

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace surety::tool {

/// A set of elements of a mesh; without a list, none.
template <class Key>
class Chosen
{
public:
  using key_type = Key;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;

  Chosen() = default;
  explicit Chosen(std::vector<bool> list)
    : list_(std::make_shared<const std::vector<bool>>(std::move(list)))
  {}

  bool operator[](Key key) const { return list_ && (*list_)[std::size_t(key)]; }
  friend bool get(const Chosen& chosen, Key key) { return chosen[key]; }

private:
  std::shared_ptr<const std::vector<bool>> list_;
};

struct Constraints {
  Chosen<Mesh::Edge_index> edges;       ///< that are features, whatever their angle
  Chosen<Mesh::Vertex_index> vertices;  ///< that stay where they are
  Chosen<Mesh::Edge_index> whole_edges; ///< of `edges`, that stay as they are
};

} // namespace surety::tool

#endif // SURETY_TOOL_CONSTRAINTS_H
