// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a support says of itself: how far it is from the surface, and where it is not smooth.
#ifndef SURETY_INTERNAL_SUPPORT_REPORT_H
#define SURETY_INTERNAL_SUPPORT_REPORT_H

#include <surety/internal/deviation/rounding.h>
#include <surety/internal/support/surface.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surety {

/// What became of the patch of a face.
struct Patch_state {
  bool may_saturate = false; ///< a displacement may exceed the start of saturation, by the bound
  bool is_refused = false;   ///< the patch would have folded; the face is flat
  bool is_flattened = false; ///< displacements were scaled down to stay within the tolerance
  bool is_tangent = false;   ///< tangent to its normals along its edges; two such neighbours are G1
};

/// \brief What is proven and measured of a geometric support. Lengths are in mesh units, shares
/// are fractions of the area of the faces.
struct Support_report {
  double tolerance = 0; ///< as asked for
  double deviation = 0; ///< proven: bounds the two-sided Hausdorff distance to the original
  std::size_t faces = 0;
  std::size_t refused_faces = 0;
  std::size_t flattened_faces = 0;
  std::size_t promoted_edges = 0;     ///< edges that became ridges, on a geometric mesh
  std::size_t misaligned_sides = 0;   ///< sides whose normal no patch could take over
  double saturated_share = 0;         ///< of faces that may saturate: an upper bound
  double sampled_saturated_share = 0; ///< of sample points that do: an estimate
  double refused_share = 0;           ///< of faces refused by the fold guard
  double flattened_share = 0;         ///< of faces scaled down
  double tangent_share = 0;           ///< of tangent faces that cannot saturate: a lower bound
  double sampled_tangent_share = 0;   ///< of tangent faces where samples do not: an estimate
  std::vector<std::uint32_t> faces_to_refine; ///< those that a finer geometric mesh would serve
};

namespace internal {

/// The share of a face on which displacements saturate, at the points of a lattice.
inline double sampled_saturation(const Support_surface& surface, Index f)
{
  if (!surface.may_saturate(f)) return 0;
  constexpr int n = 9;
  int number = 0, saturated = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j, ++number) {
      const double v = (i + 1. / 3) / n, w = (j + 1. / 3) / n;
      const Vector d = Patch_weights(Vector(1 - v - w, v, w)).point(surface.net(f));
      if (surface.saturation().acts_on(d)) ++saturated;
    }
  }
  return double(saturated) / number;
}

/// Adds up the areas; `states` is by face.
inline void measure(
    const Support_surface& surface, const std::vector<Patch_state>& states, Support_report& report)
{
  const Flat_mesh& mesh = surface.mesh();
  double total = 0;
  for (Index f = 0; f < mesh.faces(); ++f) {
    if (!mesh.is_face(f)) continue;
    const Patch_state& state = states[f];
    const double area = mesh.chord(f, 0).cross(mesh.chord(f, 2)).norm() / 2;
    total += area;
    ++report.faces;
    report.refused_faces += state.is_refused;
    report.flattened_faces += state.is_flattened;
    report.saturated_share += state.may_saturate * area;
    const double saturated = sampled_saturation(surface, f);
    report.sampled_saturated_share += saturated * area;
    report.refused_share += state.is_refused * area;
    report.flattened_share += state.is_flattened * area;
    report.tangent_share += (state.is_tangent && !state.may_saturate) * area;
    report.sampled_tangent_share += state.is_tangent * (1 - saturated) * area;
  }
  for (double* share :
       {&report.saturated_share, &report.sampled_saturated_share, &report.refused_share,
        &report.flattened_share, &report.tangent_share, &report.sampled_tangent_share}) {
    *share = total > 0 ? (std::min)(1., *share / total) : 0;
  }
}

/// Of computed points of the support, on which coordinates of this size leave rounding errors.
inline Rounding rounding_of(const Flat_mesh& mesh)
{
  double largest = 0;
  for (const Vector& p : mesh.point) largest = (std::max)(largest, p.cwiseAbs().maxCoeff());
  return Rounding(largest);
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_SUPPORT_REPORT_H
