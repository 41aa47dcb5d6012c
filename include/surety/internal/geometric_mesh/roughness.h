// SPDX-License-Identifier: GPL-3.0-or-later
//
// Roughness (section 2.2 of the paper): a face is acceptable when its normal makes an angle of at
// most theta with the normal of T at each of its vertices. A disc that is rough already may stay as
// rough as it is.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H

#include <surety/internal/deviation/reference.h>
#include <surety/internal/operators/disc.h>

#include <vector>

namespace surety::internal {

class Roughness_control
{
public:
  Roughness_control(const Reference& reference, double cosine)
    : reference_(reference), cosine_(cosine), normal_(reference.number_of_vertices()),
      is_sharp_(reference.number_of_vertices(), false)
  {
    std::vector<Vector> sum(reference.number_of_vertices(), Vector::Zero());
    for (Index f = 0; f < reference.number_of_faces(); ++f) add_face(f, sum);
    for (Index v = 0; v < reference.number_of_vertices(); ++v)
      normal_[v] = unit(sum[v]).cast<float>();
    for (Index f = 0; f < reference.number_of_faces(); ++f) {
      const Vector n = reference.normal_of_face(f);
      for (const Index v : reference.vertices_of_face(f))
        if (n.dot(normal_[v].cast<double>()) < sharp_cosine) is_sharp_[v] = true;
    }
  }

  template <class Points>
  bool admits(const Disc& disc, const Working_mesh& mesh, const Points& points) const
  {
    double worst = 1;
    for (Index i = disc.first; i <= disc.last; ++i)
      worst = std::min(worst, alignment({disc.apex(), disc.ring[i], disc.ring[i + 1]}, points));
    if (worst >= cosine_) return true;
    for (const Index f : disc.old_face)
      if (!mesh.is_ghost_face(f) && alignment(mesh.vertices_of(f), points) <= worst) return true;
    return false;
  }

private:
  static constexpr double sharp_cosine = 0.9;

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

  /// The least <nu(P_j), n(K)> over the corners of K. Where T is sharp at P_j no single normal
  /// stands for it: the best of its faces' normals is asked there.
  template <class Points>
  double alignment(const std::array<Index, 3>& corner, const Points& points) const
  {
    const Vector& a = points(corner[0]);
    const Vector n = unit((points(corner[1]) - a).cross(points(corner[2]) - a));
    double least = 1;
    for (const Index v : corner) {
      double cosine = n.dot(normal_[v].template cast<double>());
      if (cosine < cosine_ && is_sharp_[v]) cosine = std::max(cosine, best_of_cone(v, n));
      least = std::min(least, cosine);
    }
    return least;
  }

  double best_of_cone(Index v, const Vector& n) const
  {
    double best = -1;
    for (const Index e : reference_.edges_at(v))
      for (const Index f : reference_.faces_of_edge(e))
        if (f != none) best = std::max(best, n.dot(reference_.normal_of_face(f)));
    return best;
  }

  const Reference& reference_;
  double cosine_;
  std::vector<Eigen::Vector3f> normal_;
  std::vector<bool> is_sharp_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_ROUGHNESS_H
