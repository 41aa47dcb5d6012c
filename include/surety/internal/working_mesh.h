// SPDX-License-Identifier: GPL-3.0-or-later
//
// M, the current mesh: a flat triangle half-edge structure that keeps the indices of the user's
// mesh, so that the result can be written back without a search.
//
// Every border loop is closed by one ghost vertex g and one ghost face (b, a, g) a border edge
// a -> b. M is then a closed surface, and neither the ring of a vertex nor the link condition has a
// border case. Ghosts have no geometry and are never moved, measured or written.
#ifndef SURETY_INTERNAL_WORKING_MESH_H
#define SURETY_INTERNAL_WORKING_MESH_H

#include <surety/internal/journal.h>
#include <surety/internal/linear.h>

#include <array>
#include <numeric>
#include <vector>

namespace surety::internal {

class Working_mesh
{
public:
  /// Half-edges 2e and 2e + 1 are edge e. A border half-edge comes with face `none`, and its next
  /// one does not matter; an edge without any face is gone, and so is a vertex without edges.
  struct Connectivity {
    std::vector<Index> next, target, face;
    Index vertices = 0, faces = 0;
  };

  /// Writes what can be undone to the journal.
  Working_mesh(
      Connectivity connectivity, std::vector<Vector> points, std::vector<bool> feature_edge,
      std::vector<bool> fixed_vertex, Journal& journal)
    : journal_(&journal),
      next_(std::move(connectivity.next)),
      target_(std::move(connectivity.target)),
      face_(std::move(connectivity.face)),
      points_(std::move(points)),
      feature_(std::move(feature_edge)),
      fixed_(std::move(fixed_vertex)),
      real_vertices_(connectivity.vertices),
      real_faces_(connectivity.faces),
      real_edges_(static_cast<Index>(next_.size() / 2))
  {
    close_borders();
    index_halfedges();
    anchor_.resize(real_vertices_);
    std::iota(anchor_.begin(), anchor_.end(), Index(0));
    on_feature_.assign(fixed_.size(), false);
    for (Index h = 0; h < target_.size(); ++h)
      if (feature_[h / 2]) on_feature_[target_[h]] = true;
  }

  /// Where a vertex that is not a ghost lies, and a vertex of T that is near.
  const Vector& point(Index v) const { return points_[v]; }
  Index anchor(Index v) const { return anchor_[v]; }

  Index next(Index h) const { return next_[h]; }
  Index prev(Index h) const { return next_[next_[h]]; }
  Index target(Index h) const { return target_[h]; }
  Index source(Index h) const { return target_[h ^ 1]; }
  Index face(Index h) const { return face_[h]; }
  static Index opposite(Index h) { return h ^ 1; }
  static Index edge(Index h) { return h >> 1; }
  static Index halfedge(Index e) { return e << 1; }

  /// A half-edge that ends at v, or that lies in f; `none` once the element is gone.
  Index halfedge_to(Index v) const { return vertex_halfedge_[v]; }
  Index halfedge_in(Index f) const { return face_halfedge_[f]; }

  Index number_of_real_vertices() const { return real_vertices_; }
  Index number_of_real_edges() const { return real_edges_; }
  Index number_of_real_faces() const { return real_faces_; }
  Index number_of_edges() const { return static_cast<Index>(next_.size() / 2); }
  Index number_of_live_faces() const { return live_faces_; }

  bool is_ghost_vertex(Index v) const { return v >= real_vertices_; }
  bool is_ghost_face(Index f) const { return f >= real_faces_; }
  bool is_live_vertex(Index v) const { return vertex_halfedge_[v] != none; }
  bool is_live_face(Index f) const { return face_halfedge_[f] != none; }
  bool is_live_edge(Index e) const { return face_[2 * e] != none; }
  bool is_feature(Index e) const { return feature_[e]; }
  bool is_fixed(Index v) const { return fixed_[v]; }
  /// Whether the star of the vertex goes on beyond M, which is only a part of a mesh then. Nothing
  /// is collapsed into such a vertex, since the link condition could not be seen to hold.
  bool is_sealed(Index v) const { return !sealed_.empty() && sealed_[v]; }
  void seal(std::vector<bool> sealed) { sealed_ = std::move(sealed); }
  /// Whether the vertex is on a ridge or border, on which it then stays as long as it lives.
  bool is_on_feature(Index v) const { return on_feature_[v]; }
  bool is_border(Index e) const
  {
    return is_ghost_face(face_[2 * e]) || is_ghost_face(face_[2 * e + 1]);
  }

  std::array<Index, 3> vertices_of(Index f) const
  {
    const Index h = face_halfedge_[f];
    return {target_[h], target_[next_[h]], target_[next_[next_[h]]]};
  }
  bool has_vertex(Index f, Index v) const
  {
    const auto corners = vertices_of(f);
    return corners[0] == v || corners[1] == v || corners[2] == v;
  }

  /// Calls visit(h) for each half-edge that leaves v, counter-clockwise.
  template <class Visit>
  void for_each_outgoing(Index v, Visit visit) const
  {
    const Index first = opposite(vertex_halfedge_[v]);
    Index h = first;
    do {
      visit(h);
      h = opposite(prev(h));
    } while (h != first);
  }

  /// Contracts the source P of h into its target Q. Faces and spokes of P that survive keep their
  /// indices; the two faces on h die, and of the edges that merge there those at P.
  void collapse(Index h);

  void move(Index v, const Vector& point, Index anchor)
  {
    set(anchor_[v], anchor);
    for (int i = 0; i < 3; ++i) journal_->set(points_[v][i], point[i]);
  }

  /// Turns h = a -> b, between c on its left and d on its right, into d -> c.
  void flip(Index h);

  /// What a split takes: a vertex m, the edges (m, b), (m, c), (m, d) and a face on the left and on
  /// the right of it, where h = a -> b lies between c on its left and d on its right. Edge h
  /// becomes (a, m).
  struct Split_elements {
    Index vertex;
    std::array<Index, 3> edge;
    std::array<Index, 2> face;
  };
  /// Elements that are not in use, with more room made where there are none left: then all ghosts
  /// get new indices, and what refers to them is void. Not within a transaction.
  Split_elements elements_for_split(Index h);
  /// Puts a vertex on an edge. Not within a transaction.
  void split(Index h, const Split_elements& with, const Vector& point, Index anchor);

private:
  Index next_on_border(Index h) const;
  void close_borders();
  void open_borders();
  void index_halfedges();
  void find_unused();
  void make_room();
  Index new_ghost_edge();
  void put_in_face(Index face, Index a, Index b, Index c);
  void set(Index& place, Index value) { journal_->set(place, value); }
  void remove_face(Index f)
  {
    set(face_halfedge_[f], none);
    if (is_ghost_face(f)) return;
    set(live_faces_, live_faces_ - 1);
    if (splits_) unused_faces_.push_back(f);
  }
  void remove_edge(Index e)
  {
    set(face_[2 * e], none);
    set(face_[2 * e + 1], none);
    if (splits_ && e < real_edges_) unused_edges_.push_back(e);
  }

  /// Puts half-edge h in the place that `old` has in its face.
  void replace_in_face(Index old, Index h)
  {
    set(next_[prev(old)], h);
    set(next_[h], next_[old]);
    set(face_[h], face_[old]);
    set(face_halfedge_[face_[old]], h);
  }

  Journal* journal_;
  std::vector<Index> next_, target_, face_;
  std::vector<Vector> points_;
  std::vector<Index> anchor_;
  std::vector<Index> vertex_halfedge_, face_halfedge_;
  std::vector<bool> feature_, fixed_, on_feature_, sealed_;
  Index real_vertices_, real_faces_, real_edges_, live_faces_ = 0;
  /// Real elements without a use, the next one last; looked for when the first split asks.
  std::vector<Index> unused_vertices_, unused_edges_, unused_faces_;
  bool splits_ = false;
};

inline void Working_mesh::collapse(Index h)
{
  const Index p = source(h), q = target(h);
  const Index left = next(h);                  // q -> r_1
  const Index left_spoke = opposite(prev(h));  // p -> r_1
  const Index right = prev(opposite(h));       // r_{k-1} -> q
  const Index right_spoke = next(opposite(h)); // p -> r_{k-1}
  remove_face(face_[h]);
  remove_face(face_[opposite(h)]);

  Index spoke = opposite(prev(left_spoke));
  for (; spoke != right_spoke && spoke != h; spoke = opposite(prev(spoke)))
    set(target_[opposite(spoke)], q);

  replace_in_face(left_spoke, left);
  replace_in_face(opposite(right_spoke), right);
  remove_edge(edge(h));
  remove_edge(edge(left_spoke));
  remove_edge(edge(right_spoke));

  set(vertex_halfedge_[p], none);
  if (splits_) unused_vertices_.push_back(p);
  set(vertex_halfedge_[q], right);
  set(vertex_halfedge_[target_[left]], left);
  set(vertex_halfedge_[source(right)], opposite(right));
}

inline void Working_mesh::flip(Index h)
{
  const Index o = opposite(h);
  const Index bc = next(h), ca = prev(h), ad = next(o), db = prev(o);
  const Index a = target_[o], b = target_[h], c = target_[bc], d = target_[ad];
  const Index left = face_[h], right = face_[o];
  set(target_[h], c), set(target_[o], d);
  set(next_[ca], ad), set(next_[ad], h), set(next_[h], ca);
  set(next_[db], bc), set(next_[bc], o), set(next_[o], db);
  set(face_[ad], left), set(face_[bc], right);
  set(face_halfedge_[left], h), set(face_halfedge_[right], o);
  set(vertex_halfedge_[a], ca), set(vertex_halfedge_[b], db);
  set(vertex_halfedge_[c], h), set(vertex_halfedge_[d], o);
}

inline Working_mesh::Split_elements Working_mesh::elements_for_split(Index h)
{
  if (!splits_) find_unused();
  if (unused_vertices_.empty() || unused_edges_.size() < 3 || unused_faces_.size() < 2) make_room();
  Split_elements result;
  result.vertex = unused_vertices_.back();
  std::size_t edges = unused_edges_.size(), faces = unused_faces_.size();
  auto ghost_edge = static_cast<Index>(next_.size() / 2);
  auto ghost_face = static_cast<Index>(face_halfedge_.size());
  result.edge[0] = unused_edges_[--edges];
  for (int side = 0; side < 2; ++side) {
    const bool is_ghost = is_ghost_face(face_[side == 0 ? h : opposite(h)]);
    result.edge[side + 1] = is_ghost ? ghost_edge++ : unused_edges_[--edges];
    result.face[side] = is_ghost ? ghost_face++ : unused_faces_[--faces];
  }
  return result;
}

inline void Working_mesh::split(
    Index h, const Split_elements& with, const Vector& point, Index anchor)
{
  const Index o = opposite(h);
  const Index bc = next(h), ca = prev(h), ad = next(o), db = prev(o);
  const Index b = target_[h], c = target_[bc], d = target_[ad], m = with.vertex;
  const Index left = face_[h], right = face_[o];
  unused_vertices_.pop_back();
  unused_edges_.pop_back();
  for (int side = 0; side < 2; ++side) {
    if (is_ghost_face(side == 0 ? left : right)) {
      new_ghost_edge();
      face_halfedge_.push_back(none);
    } else {
      unused_edges_.pop_back();
      unused_faces_.pop_back();
      ++live_faces_;
    }
  }

  const Index mb = halfedge(with.edge[0]), mc = halfedge(with.edge[1]), md = halfedge(with.edge[2]);
  target_[mb] = b, target_[opposite(mb)] = m;
  target_[mc] = c, target_[opposite(mc)] = m;
  target_[md] = d, target_[opposite(md)] = m;
  target_[h] = m;
  put_in_face(left, h, mc, ca);
  put_in_face(with.face[0], mb, bc, opposite(mc));
  put_in_face(right, o, ad, opposite(md));
  put_in_face(with.face[1], opposite(mb), md, db);
  vertex_halfedge_[m] = h;
  vertex_halfedge_[b] = mb;
  vertex_halfedge_[c] = bc, vertex_halfedge_[d] = ad;
  points_[m] = point;
  anchor_[m] = anchor;
  fixed_[m] = false;
  on_feature_[m] = feature_[edge(h)];
  feature_[with.edge[0]] = feature_[edge(h)];
  feature_[with.edge[1]] = feature_[with.edge[2]] = false;
}

inline void Working_mesh::put_in_face(Index face, Index a, Index b, Index c)
{
  next_[a] = b, next_[b] = c, next_[c] = a;
  for (const Index h : {a, b, c}) face_[h] = face;
  face_halfedge_[face] = a;
}

inline Index Working_mesh::new_ghost_edge()
{
  const auto e = static_cast<Index>(next_.size() / 2);
  for (auto* array : {&next_, &target_, &face_}) array->resize(2 * e + 2, none);
  feature_.push_back(false);
  return e;
}

inline void Working_mesh::find_unused()
{
  splits_ = true;
  unused_vertices_.clear(), unused_edges_.clear(), unused_faces_.clear();
  for (Index v = real_vertices_; v-- > 0;)
    if (!is_live_vertex(v)) unused_vertices_.push_back(v);
  for (Index e = real_edges_; e-- > 0;)
    if (!is_live_edge(e)) unused_edges_.push_back(e);
  for (Index f = real_faces_; f-- > 0;)
    if (!is_live_face(f)) unused_faces_.push_back(f);
}

/// Doubles the room for real elements; ghosts stay behind them.
inline void Working_mesh::make_room()
{
  open_borders();
  real_vertices_ = 2 * real_vertices_ + 4;
  real_edges_ = 2 * real_edges_ + 12;
  real_faces_ = 2 * real_faces_ + 8;
  for (auto* array : {&next_, &target_, &face_}) array->resize(2 * real_edges_, none);
  feature_.resize(real_edges_, false);
  fixed_.resize(real_vertices_, false);
  on_feature_.resize(real_vertices_, false);
  points_.resize(real_vertices_, Vector::Zero());
  anchor_.resize(real_vertices_, none);
  close_borders();
  index_halfedges();
  on_feature_.resize(fixed_.size(), false);
  find_unused();
}

/// Takes the ghosts away.
inline void Working_mesh::open_borders()
{
  for (Index h = 0; h < 2 * real_edges_; ++h)
    if (face_[h] != none && is_ghost_face(face_[h])) face_[h] = none;
  for (auto* array : {&next_, &target_, &face_}) array->resize(2 * real_edges_);
  feature_.resize(real_edges_);
  fixed_.resize(real_vertices_);
  on_feature_.resize(real_vertices_);
  points_.resize(real_vertices_);
  live_faces_ = 0;
}

/// The border half-edge that follows where the faces on the other side of h end.
inline Index Working_mesh::next_on_border(Index h) const
{
  Index k = opposite(h);
  while (face_[k] != none) k = opposite(prev(k));
  return k;
}

inline void Working_mesh::close_borders()
{
  const auto real_halfedges = static_cast<Index>(next_.size());
  Index vertex = real_vertices_, face = real_faces_;
  std::vector<Index> loop;
  for (Index start = 0; start < real_halfedges; ++start) {
    if (face_[start] != none || face_[opposite(start)] == none) continue;
    loop.clear();
    for (Index h = start; loop.empty() || h != start; h = next_on_border(h)) loop.push_back(h);

    // Ghost edge i leaves the target of loop[i] and is followed round the loop.
    const auto first = static_cast<Index>(next_.size());
    const auto size = static_cast<Index>(loop.size());
    next_.resize(first + 2 * size);
    target_.resize(first + 2 * size);
    face_.resize(first + 2 * size);
    for (Index i = 0; i < size; ++i) {
      const Index in = first + 2 * i, out = first + 2 * ((i + size - 1) % size) + 1;
      target_[in] = vertex;
      target_[in + 1] = target_[loop[i]];
      next_[loop[i]] = in, next_[in] = out, next_[out] = loop[i];
      face_[loop[i]] = face_[in] = face_[out] = face++;
    }
    ++vertex;
  }
  feature_.resize(next_.size() / 2, false);
  fixed_.resize(vertex, true);
  points_.resize(vertex, Vector::Zero());
  vertex_halfedge_.assign(vertex, none);
  face_halfedge_.assign(face, none);
}

inline void Working_mesh::index_halfedges()
{
  for (Index h = 0; h < next_.size(); ++h) {
    if (face_[h] == none) continue;
    vertex_halfedge_[target_[h]] = h;
    face_halfedge_[face_[h]] = h;
  }
  for (Index f = 0; f < real_faces_; ++f) live_faces_ += is_live_face(f);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_WORKING_MESH_H
