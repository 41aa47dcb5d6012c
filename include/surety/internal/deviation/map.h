// SPDX-License-Identifier: GPL-3.0-or-later
//
// phi : T -> M, the continuous map behind the direct bound, as it is stored: the image of every
// vertex of T, and along every edge of T the nodes where its image crosses edges of M.
#ifndef SURETY_INTERNAL_DEVIATION_MAP_H
#define SURETY_INTERNAL_DEVIATION_MAP_H

#include <surety/internal/journal.h>
#include <surety/internal/linear.h>

#include <deque>
#include <vector>

namespace surety::internal {

/// An element of M: a vertex, the closest point of an edge, or the closest point of a face.
class Element
{
public:
  enum class Kind : Index { vertex, edge, face };

  Element() = default;
  Element(Kind kind, Index id) : code_(id << 2 | static_cast<Index>(kind)) {}

  Kind kind() const { return static_cast<Kind>(code_ & 3); }
  Index id() const { return code_ >> 2; }
  bool is(Kind kind, Index id) const { return *this == Element(kind, id); }
  bool operator==(const Element& other) const { return code_ == other.code_; }

private:
  Index code_ = none;
};

/// A node: the point x(lambda) of a T edge, mapped to the closest point of an M edge. Nodes are
/// linked twice, along their T edge in order and in the (unordered) list of their M edge.
struct Node {
  Index t_edge, m_edge;
  Index next_on_t;
  Index next_on_m, previous_on_m;
  float lambda; ///< phi is defined by what is stored here: fewer bits are not less exact
};

class Map
{
public:
  /// The identity: every vertex of T is pinned to the vertex of M that it is. Writes what can be
  /// undone to the journal.
  Map(Index vertices, Index t_edges, Index m_edges, Index faces, Journal& journal)
    : journal_(&journal),
      image_(vertices),
      next_assigned_(vertices, none),
      pin_(vertices),
      first_on_face_(faces, none),
      first_on_edge_(m_edges, none),
      first_node_of_t_(t_edges, none),
      first_node_of_m_(m_edges, none)
  {
    for (Index v = 0; v < vertices; ++v) {
      image_[v] = Element(Element::Kind::vertex, v);
      pin_[v] = v;
    }
  }

  Element image(Index v) const { return image_[v]; }
  /// The vertex of T that goes to a vertex of M, or none.
  Index pin(Index m_vertex) const { return pin_[m_vertex]; }
  const Node& node(Index n) const { return nodes_[n]; }
  Index first_node_of_t(Index t_edge) const { return first_node_of_t_[t_edge]; }
  Index first_node_of_m(Index m_edge) const { return first_node_of_m_[m_edge]; }

  template <class Visit>
  void for_each_vertex_on_face(Index face, Visit visit) const
  {
    for (Index v = first_on_face_[face]; v != none; v = next_assigned_[v]) visit(v);
  }
  template <class Visit>
  void for_each_vertex_on_edge(Index edge, Visit visit) const
  {
    for (Index v = first_on_edge_[edge]; v != none; v = next_assigned_[v]) visit(v);
  }
  template <class Visit>
  void for_each_node_on_m(Index m_edge, Visit visit) const
  {
    for (Index n = first_node_of_m_[m_edge]; n != none; n = nodes_[n].next_on_m) visit(n);
  }

  /// Forgets which vertices are assigned to an element; each must be assigned anew.
  void clear_face(Index face) { set(first_on_face_[face], none); }
  void clear_edge(Index edge) { set(first_on_edge_[edge], none); }
  void clear_pin(Index m_vertex) { set(pin_[m_vertex], none); }
  void assign(Index v, Element element)
  {
    journal_->set(image_[v], element);
    if (element.kind() == Element::Kind::vertex) {
      set(pin_[element.id()], v);
      return;
    }
    Index& first = element.kind() == Element::Kind::face ? first_on_face_[element.id()]
                                                         : first_on_edge_[element.id()];
    set(next_assigned_[v], first);
    set(first, v);
  }

  Index add_node(Index t_edge, Index m_edge, float lambda)
  {
    Index n = free_;
    if (n == none) {
      n = static_cast<Index>(nodes_.size());
      nodes_.emplace_back();
    } else {
      set(free_, nodes_[n].next_on_t);
    }
    const Index first = first_node_of_m_[m_edge];
    journal_->set(nodes_[n], {t_edge, m_edge, none, first, none, lambda});
    if (first != none) set(nodes_[first].previous_on_m, n);
    set(first_node_of_m_[m_edge], n);
    return n;
  }
  void remove_node(Index n)
  {
    const Node node = nodes_[n];
    if (node.next_on_m != none) set(nodes_[node.next_on_m].previous_on_m, node.previous_on_m);
    if (node.previous_on_m != none)
      set(nodes_[node.previous_on_m].next_on_m, node.next_on_m);
    else
      set(first_node_of_m_[node.m_edge], node.next_on_m);
    set(nodes_[n].next_on_t, free_);
    set(free_, n);
  }
  /// Appends a node to T edge `t_edge`, whose last one so far is `last`; returns it.
  Index append_node(Index t_edge, Index last, Index m_edge, float lambda)
  {
    const Index n = add_node(t_edge, m_edge, lambda);
    if (last == none)
      set_first_node(t_edge, n);
    else
      set_next_node(last, n);
    return n;
  }
  void set_first_node(Index t_edge, Index n) { set(first_node_of_t_[t_edge], n); }
  void set_next_node(Index n, Index next) { set(nodes_[n].next_on_t, next); }

  /// After an undone transaction: nodes that it added at the end are not in use.
  std::size_t number_of_nodes() const { return nodes_.size(); }
  void forget_nodes_from(std::size_t size) { nodes_.resize(size); }

private:
  void set(Index& place, Index value) { journal_->set(place, value); }

  Journal* journal_;
  std::vector<Element> image_;
  std::vector<Index> next_assigned_, pin_;
  std::vector<Index> first_on_face_, first_on_edge_;
  std::vector<Index> first_node_of_t_, first_node_of_m_;
  std::deque<Node> nodes_; // grows without a copy of all that is there
  Index free_ = none;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_MAP_H
