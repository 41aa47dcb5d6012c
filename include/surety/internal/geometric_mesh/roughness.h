// SPDX-License-Identifier: GPL-3.0-or-later
//
// Roughness (section 2.2 of the paper): a face is acceptable when its normal makes an angle of at
// most theta with the normal of T at each of its vertices. A disc that is rough already may stay as
// rough as it is.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H

#include <surety/internal/deviation/reference.h>
#include <surety/internal/operators/disc.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surety::internal {

class Roughness_control
{
public:
  Roughness_control(const Reference& reference, double cosine)
    : reference_(reference),
      cosine_(cosine),
      normal_(reference.number_of_vertices()),
      cone_(reference.number_of_vertices(), none)
  {
    std::vector<Vector> sum(reference.number_of_vertices(), Vector::Zero());
    for (Index f = 0; f < reference.number_of_faces(); ++f) add_face(f, sum);
    for (Index v = 0; v < reference.number_of_vertices(); ++v)
      normal_[v] = unit(sum[v]).cast<float>();
    for (Index v = 0; v < reference.number_of_vertices(); ++v) keep_cone_if_sharp(v);
  }

  bool admits(const Disc& disc, const Working_mesh& mesh) const
  {
    double worst = 1;
    disc.for_each_new_face([&](Index i) {
      if (mesh.is_ghost_face(disc.face[i])) return;
      const Index r = disc.ring[i], next = disc.ring[disc.after(i)];
      worst = std::min(
          worst,
          alignment(
              {disc.apex_point, mesh.point(r), mesh.point(next)},
              {disc.anchor, mesh.anchor(r), mesh.anchor(next)}));
    });
    if (worst >= cosine_) return true;
    for (const Index f : disc.old_face) {
      if (mesh.is_ghost_face(f)) continue;
      const auto v = mesh.vertices_of(f);
      const double before = alignment(
          {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])},
          {mesh.anchor(v[0]), mesh.anchor(v[1]), mesh.anchor(v[2])});
      if (before <= worst) return true;
    }
    return false;
  }

private:
  static constexpr float sharp_cosine = 0.9F;

  void add_face(Index f, std::vector<Vector>& sum) const
  {
    const auto v = reference_.vertices_of_face(f);
    const Vector n = reference_.normal_of_face(f);
    for (int i = 0; i < 3; ++i) {
      const Vector a = unit(reference_.point(v[(i + 1) % 3]) - reference_.point(v[i]));
      const Vector b = unit(reference_.point(v[(i + 2) % 3]) - reference_.point(v[i]));
      sum[v[i]] += std::atan2(a.cross(b).norm(), a.dot(b)) * n;
    }
  }

  /// The least <nu(P_j), n(K)> over the corners of K, where nu(P_j) is the normal at a vertex of T
  /// near P_j. Where T is sharp there no single normal stands for it: the best of its faces'
  /// normals is asked.
  double alignment(const std::array<Vector, 3>& corner, const std::array<Index, 3>& anchor) const
  {
    const Vector n = unit((corner[1] - corner[0]).cross(corner[2] - corner[0]));
    double least = 1;
    for (const Index v : anchor) {
      double cosine = n.dot(normal_[v].template cast<double>());
      if (cosine < cosine_ && cone_[v] != none) cosine = std::max(cosine, best_of_cone(v, n));
      least = std::min(least, cosine);
    }
    return least;
  }

  /// Stores the normals of the faces at v where one of them is far from the mean.
  void keep_cone_if_sharp(Index v)
  {
    const std::size_t first = cone_normals_.size();
    bool is_sharp = false;
    for (const Index e : reference_.edges_at(v))
      for (const Index f : reference_.faces_of_edge(e)) {
        // Every face lies on two of the edges, or on one at a border.
        if (f == none) continue;
        const Eigen::Vector3f n = reference_.normal_of_face(f).cast<float>();
        is_sharp = is_sharp || n.dot(normal_[v]) < sharp_cosine;
        if (std::find(
                cone_normals_.begin() + static_cast<std::ptrdiff_t>(first), cone_normals_.end(), n)
            == cone_normals_.end())
          cone_normals_.push_back(n);
      }
    if (is_sharp) {
      cone_[v] = static_cast<Index>(first);
      cone_normals_.emplace_back(Eigen::Vector3f::Zero()); // ends the cone
    } else {
      cone_normals_.resize(first);
    }
  }

  double best_of_cone(Index v, const Vector& n) const
  {
    double best = -1;
    for (Index i = cone_[v]; !cone_normals_[i].isZero(0); ++i)
      best = std::max(best, n.dot(cone_normals_[i].cast<double>()));
    return best;
  }

  const Reference& reference_;
  double cosine_;
  std::vector<Eigen::Vector3f> normal_;
  std::vector<Index> cone_; ///< of a sharp vertex: where its normals begin
  std::vector<Eigen::Vector3f> cone_normals_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H
