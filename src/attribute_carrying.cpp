// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes.h"

#include <surety/internal/features/normals.h>
#include <surety/internal/metric/face_locator.h>
#include <surety/internal/transfer/carried.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;
using Halfedge = Mesh::Halfedge_index;
using Value = Attribute::Value;
using surety::internal::to_vector;
using surety::internal::Vector;
using surety::internal::metric::Located_face;
using surety::internal::metric::Located_point;

/// Which corner each halfedge of a face ends in.
std::vector<std::uint32_t> corners_of_halfedges(const Mesh& mesh)
{
  std::vector<std::uint32_t> result(mesh.num_halfedges());
  std::uint32_t corner = 0;
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) result[h] = corner++;
  return result;
}

Located_face located(const Mesh& mesh, Face f)
{
  const Halfedge h = mesh.halfedge(f), next = mesh.next(h);
  Located_face face;
  face.corner
      = {to_vector(mesh.point(mesh.target(h))), to_vector(mesh.point(mesh.target(next))),
         to_vector(mesh.point(mesh.source(h)))};
  face.normal = surety::internal::unit_normal(face.corner[0], face.corner[1], face.corner[2]);
  face.id = f;
  return face;
}

/// The faces of a mesh, parted where an attribute has two values along an edge.
class Patches
{
public:
  Patches(const Attribute& attribute, const Mesh& mesh)
    : attribute_(attribute),
      mesh_(mesh),
      corner_(corners_of_halfedges(mesh)),
      patch_(mesh.number_of_faces(), surety::internal::none)
  {
    for (const Face f : mesh.faces())
      if (patch_[f] == surety::internal::none) fill(f);
  }

  std::uint32_t operator[](std::uint32_t face) const { return patch_[face]; }
  bool has_seams() const { return has_seams_; }

  std::vector<Located_face> faces(std::uint32_t patch) const
  {
    std::vector<Located_face> result;
    for (const Face f : members_[patch]) result.push_back(located(mesh_, f));
    return result;
  }

private:
  void fill(Face seed)
  {
    const auto patch = static_cast<std::uint32_t>(members_.size());
    std::vector<Face>& faces = members_.emplace_back(1, seed);
    patch_[seed] = patch;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(faces[i]))) {
        const Halfedge other = mesh_.opposite(h);
        if (mesh_.is_border(other)) continue;
        const bool is_seam
            = value(h) != value(mesh_.prev(other)) || value(mesh_.prev(h)) != value(other);
        has_seams_ = has_seams_ || is_seam;
        const Face next = mesh_.face(other);
        if (is_seam || patch_[next] != surety::internal::none) continue;
        patch_[next] = patch;
        faces.push_back(next);
      }
    }
  }

  const Value& value(Halfedge h) const
  {
    return attribute_.values[attribute_.of_corner[corner_[h]]];
  }

  const Attribute& attribute_;
  const Mesh& mesh_;
  std::vector<std::uint32_t> corner_, patch_;
  std::vector<std::vector<Face>> members_;
  bool has_seams_ = false;
};

/// The faces of T around what a map takes to each vertex of M.
class Preimages
{
public:
  Preimages(const Mesh& input, const Correspondence& map) : input_(input)
  {
    for (const Vertex v : input.vertices()) {
      const Correspondence::Image& image = map.images[v];
      if (image.kind != Correspondence::Kind::vertex) continue;
      for (const Face f : input.faces_around_target(input.halfedge(v)))
        if (f != Mesh::null_face()) pairs_.emplace_back(image.a, f);
    }
    for (const Correspondence::Inner& inner : map.inner)
      pairs_.emplace_back(inner.vertex, Face(inner.face));
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  /// Of those that are admitted, the face nearest to a point, one that looks the same way if there
  /// is any; ties go to the lower index. Nothing where no vertex is taken to this one.
  template <class Admit>
  std::optional<Face> nearest(
      Vertex vertex, const Vector& p, const Vector& direction, const Admit& admit) const
  {
    std::optional<Face> best;
    std::pair<bool, double> least;
    for (auto at = std::lower_bound(pairs_.begin(), pairs_.end(), std::pair(vertex.idx(), Face(0)));
         at != pairs_.end() && at->first == vertex.idx(); ++at) {
      if (!admit(at->second)) continue;
      const Located_face face = located(input_, at->second);
      const std::pair order(
          !(face.normal.dot(direction) > 0), nearest_on_face(face, p).squared_distance);
      if (best && order >= least) continue;
      best = at->second;
      least = order;
    }
    return best;
  }

private:
  const Mesh& input_;
  std::vector<std::pair<std::uint32_t, Face>> pairs_;
};

/// Where the corners of a mesh lie on another one.
class Corner_locator
{
public:
  Corner_locator(const Mesh& from, const std::optional<Correspondence>& map)
    : from_(from), surface_(from)
  {
    if (map) preimages_.emplace(from, *map);
  }

  /// Corners lie in the patch in which the middle of their face does, where an edge of a curve that
  /// bounds it cannot lead astray.
  std::vector<Located_point> locate(const Mesh& to, const Patches& patches) const
  {
    // So near to the vertex that the faces found are those around it.
    constexpr double share = 1. / 1024;
    Trees trees;
    std::vector<Located_point> result;
    for (const Face f : to.faces()) {
      const Located_face face = located(to, f);
      const Vector middle = (face.corner[0] + face.corner[1] + face.corner[2]) / 3;
      const std::uint32_t home
          = patches.has_seams() ? patches[surface_.locate(middle, face.normal).face] : 0;
      Halfedge h = to.halfedge(f);
      for (int i = 0; i < 3; ++i, h = to.next(h)) {
        const Vector &p = face.corner[i], inside = p + share * (middle - p);
        const auto is_at_home
            = [&](Face found) { return !patches.has_seams() || patches[found] == home; };
        std::optional<Face> found;
        if (preimages_) found = preimages_->nearest(to.target(h), inside, face.normal, is_at_home);
        if (!found) found = Face(surface_.locate(inside, face.normal).face);
        if (!is_at_home(*found))
          found = Face(tree(trees, patches, home).nearest(inside, face.normal).face);
        result.push_back(nearest_on_face(located(from_, *found), p));
      }
    }
    return result;
  }

private:
  using Trees = std::map<std::uint32_t, surety::internal::metric::Face_locator>;

  static const surety::internal::metric::Face_locator& tree(
      Trees& trees, const Patches& patches, std::uint32_t patch)
  {
    const auto known = trees.find(patch);
    if (known != trees.end()) return known->second;
    return trees.emplace(patch, patches.faces(patch)).first->second;
  }

  const Mesh& from_;
  surety::internal::transfer::Surface surface_;
  std::optional<Preimages> preimages_;
};

/// A sum of values that becomes their mean.
struct Mean {
  Value sum{};
  std::size_t number = 0;

  void add(const Value& value)
  {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += value[i];
    ++number;
  }

  Value value() const
  {
    Value mean = sum;
    for (double& x : mean) x /= double(number);
    return mean;
  }
};

/// Of unit length; where directions cancel each other, the normal of the faces.
Value unit_normal(const Value& value, const Mesh& mesh, Vertex v)
{
  Vector normal = surety::internal::unit(Vector(value[0], value[1], value[2]));
  if (normal.isZero(0)) {
    for (const Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f != Mesh::null_face()) normal += located(mesh, f).normal;
    normal = surety::internal::unit(normal);
  }
  return {normal.x(), normal.y(), normal.z(), 0};
}

Value interpolated(const Attribute& attribute, const Located_point& at)
{
  Value result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Value& corner = attribute.values[attribute.of_corner[3 * at.face + i]];
    for (std::size_t c = 0; c < result.size(); ++c)
      result[c] += at.weights[Eigen::Index(i)] * corner[c];
  }
  return result;
}

Attribute carried(
    const Attribute& given, const Patches& patches, const std::vector<Located_point>& places,
    const Mesh& to, bool is_normal)
{
  const auto corner_of = corners_of_halfedges(to);
  Attribute result{given.components, {}, std::vector<std::uint32_t>(places.size())};
  std::vector<std::pair<std::uint32_t, Mean>> sides; // by patch
  for (const Vertex v : to.vertices()) {
    sides.clear();
    const std::size_t first = result.values.size();
    for (const Halfedge h : to.halfedges_around_target(to.halfedge(v))) {
      if (to.is_border(h)) continue;
      const Located_point& place = places[corner_of[h]];
      const std::uint32_t patch = patches[place.face];
      auto side = std::find_if(
          sides.begin(), sides.end(), [&](const auto& known) { return known.first == patch; });
      if (side == sides.end()) side = sides.insert(side, {patch, {}});
      side->second.add(interpolated(given, place));
      result.of_corner[corner_of[h]]
          = static_cast<std::uint32_t>(first + std::size_t(side - sides.begin()));
    }
    for (const auto& [patch, mean] : sides)
      result.values.push_back(is_normal ? unit_normal(mean.value(), to, v) : mean.value());
  }
  return result;
}

} // namespace

Attributes carry_attributes(
    const Attributes& given, const Mesh& from, const Mesh& to,
    const std::optional<Correspondence>& map)
{
  if (given.is_empty()) return {};
  const Corner_locator locator(from, map);
  const auto carry = [&](const Attribute& attribute, const Patches& patches, bool is_normal) {
    return carried(attribute, patches, locator.locate(to, patches), to, is_normal);
  };
  Attributes result;
  if (given.color) result.color = carry(*given.color, Patches(*given.color, from), false);
  if (given.normal) result.normal = carry(*given.normal, Patches(*given.normal, from), true);
  if (given.texture) {
    const Patches patches(*given.texture, from);
    if (!patches.has_seams()) result.texture = carry(*given.texture, patches, false);
  }
  return result;
}

std::vector<Value> vertex_values(const Attribute& attribute, const Mesh& mesh, bool is_normal)
{
  const auto corner_of = corners_of_halfedges(mesh);
  std::vector<Value> result;
  for (const Vertex v : mesh.vertices()) {
    // Each side counts once, however many faces it has.
    std::vector<std::uint32_t> sides;
    for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      if (!mesh.is_border(h)) sides.push_back(attribute.of_corner[corner_of[h]]);
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    Mean mean;
    for (const std::uint32_t side : sides) mean.add(attribute.values[side]);
    result.push_back(is_normal ? unit_normal(mean.value(), mesh, v) : mean.value());
  }
  return result;
}

bool holds_attributes(const std::string& extension)
{
  return extension == "ply" || extension == "obj" || extension == "vtp";
}

std::vector<std::string> names_of(const Attributes& attributes)
{
  std::vector<std::string> names;
  if (attributes.color) names.emplace_back("colors");
  if (attributes.normal) names.emplace_back("normals");
  if (attributes.texture) names.emplace_back("texture coordinates");
  return names;
}

std::string to_text(
    const Attributes& given, const Attributes& carried, const std::string& indentation)
{
  const auto all = names_of(given), kept = names_of(carried);
  std::string text;
  for (const std::string& name : all) {
    const bool is_kept = std::find(kept.begin(), kept.end(), name) != kept.end();
    text += indentation + (is_kept ? "carried over: " : "not carried over: ") + name + '\n';
  }
  return text;
}

} // namespace surety::tool
