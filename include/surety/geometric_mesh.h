// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric mesh: as few faces as the tolerance allows, with the proof (section 2 of P. J.
// Frey, About Surface Remeshing, 2000).
#ifndef SURETY_GEOMETRIC_MESH_H
#define SURETY_GEOMETRIC_MESH_H

#include <surety/certificate.h>
#include <surety/internal/geometric_mesh/workspace.h>
#include <surety/parameters.h>

#include <algorithm>

namespace surety {

namespace internal {

/// Writes b(K) to the user's map, or to the property map "f:deviation".
template <class Mesh, class NamedParameters>
void write_deviation(
    const std::vector<double>& bounds, const Compaction& compaction, const NamedParameters& np,
    Mesh& mesh)
{
  std::vector<double> bound_at(mesh.number_of_faces());
  for (Index f = 0; f < bounds.size(); ++f)
    if (compaction.face[f] != none) bound_at[compaction.face[f]] = bounds[f];
  const auto write = [&](auto map) {
    std::size_t position = 0;
    for (const auto f : mesh.faces()) put(map, f, bound_at[position++]);
  };
  if constexpr (is_absent<NamedParameters, deviation_map_t>)
    write(mesh.template add_property_map<typename Mesh::Face_index, double>("f:deviation").first);
  else
    write(CGAL::parameters::get_parameter(np, deviation_map));
}

} // namespace internal

/// \brief turns a mesh, in place, into one with far fewer faces within a proven distance.
///
/// Vertices are removed by collapses in the order of their quadric error, edges are flipped and
/// vertices relocated where that makes room for more, as long as the two-sided Hausdorff distance
/// to the input stays within the tolerance: every operation is checked before it is made, so the
/// result cannot fail to comply. The vertices of the result lie on the input, or, with free
/// placement, anywhere within the tolerance.
///
/// Genus, components and border loops are kept. Borders stay within the tolerance of the input's
/// borders, and so do ridges and constrained edges, as curves. No face that intersects another one
/// is made. The result depends on the mesh and the parameters only.
///
/// On return the mesh is compacted: descriptors are renumbered, property maps stay valid and keep
/// the values of what survives. When an exception is thrown the mesh is unchanged.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag` (the default) or `CGAL::Parallel_tag`, which needs
///   TBB. From some 130,000 faces on the mesh is simplified in patches first, and these on as many
///   threads as there are; the result is the same for any number of threads.
/// \param mesh a `CGAL::Surface_mesh` with coordinates convertible to `double`; may have borders,
///   several components and any genus.
/// \param tolerance largest two-sided Hausdorff distance to the input, in mesh units.
/// \return the certificate, with the map that proves it (for the direct bound) and the counts of
///   operations and refusals.
/// \throws Invalid_input when the mesh is empty, not triangulated, not manifold, has non-finite
///   coordinates, degenerate or duplicate faces or isolated vertices, or when a parameter is out of
///   range; names the element and the remedy.
///
/// Complexity: O(n log n) in the number of faces, with about 270 bytes a face beside the mesh.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{feature_angle}
///     \cgalParamDescription{edges where the surface turns by more are ridges, kept as curves. With
///       none, creases are bounded by the tolerance like everything else}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{180, no ridges}
///   \cgalParamNEnd
///   \cgalParamNBegin{corner_angle}
///     \cgalParamDescription{where a ridge or border turns by more, its vertex stays}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{60}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{edges that are ridges whatever their angle}
///     \cgalParamType{a readable property map from edges to `bool`}
///     \cgalParamDefault{no edge}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map}
///     \cgalParamDescription{vertices that stay}
///     \cgalParamType{a readable property map from vertices to `bool`}
///     \cgalParamDefault{no vertex}
///   \cgalParamNEnd
///   \cgalParamNBegin{face_is_constrained_map}
///     \cgalParamDescription{faces that stay}
///     \cgalParamType{a readable property map from faces to `bool`}
///     \cgalParamDefault{no face}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_tolerance_map}
///     \cgalParamDescription{a tolerance at each vertex of the input, where it is less than
///       `tolerance`; linear over the faces}
///     \cgalParamType{a readable property map from vertices to `double`, positive, in mesh units}
///     \cgalParamDefault{`tolerance` everywhere}
///   \cgalParamNEnd
///   \cgalParamNBegin{face_tolerance_map}
///     \cgalParamDescription{a tolerance at each face of the input, where it is less than
///       `tolerance`; a vertex takes the least of its faces, so that it is kept all over each face}
///     \cgalParamType{a readable property map from faces to `double`, positive, in mesh units}
///     \cgalParamDefault{`tolerance` everywhere}
///   \cgalParamNEnd
///   \cgalParamNBegin{deviation_bound}
///     \cgalParamDescription{`Deviation_bound::direct`, by a map from the input to the mesh, or
///       `Deviation_bound::accumulated`, the paper's, which adds up from operation to operation, or
///       `Deviation_bound::covering`, cell by cell, which bounds surfaces but no curves and is
///       slower}
///     \cgalParamDefault{`Deviation_bound::direct`}
///   \cgalParamNEnd
///   \cgalParamNBegin{shape_ratio}
///     \cgalParamDescription{omega: Q(new) <= max(omega max Q(old), shape_floor)}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{1}
///   \cgalParamNEnd
///   \cgalParamNBegin{shape_floor}
///     \cgalParamDescription{the quality Q up to which every face is admitted}
///     \cgalParamType{`double`, at least 1; infinity: no control}
///     \cgalParamDefault{10}
///   \cgalParamNEnd
///   \cgalParamNBegin{roughness_angle}
///     \cgalParamDescription{largest angle between a face and the input's normals at its vertices,
///       unless the faces that it replaces are as rough}
///     \cgalParamType{`double`, in degrees, in (0, 180]; 180: no control}
///     \cgalParamDefault{45}
///   \cgalParamNEnd
///   \cgalParamNBegin{allow_self_intersections}
///     \cgalParamDescription{do not test for new self-intersections}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{placement}
///     \cgalParamDescription{`Placement::on_surface`, vertices of the result lie on the input, or
///       `Placement::free`, anywhere within the tolerance, which takes fewer faces}
///     \cgalParamDefault{`Placement::on_surface`}
///   \cgalParamNEnd
///   \cgalParamNBegin{effort}
///     \cgalParamDescription{`Effort::fast`, collapses and flips, with vertices of the input only
///       unless placement is free; `Effort::standard`, a pass of transactions too, which exceed the
///       tolerance for a while and come back; `Effort::best`, six of them}
///     \cgalParamDefault{`Effort::standard`}
///   \cgalParamNEnd
///   \cgalParamNBegin{smoothing_sweeps}
///     \cgalParamDescription{sweeps at the end in which vertices are relocated and edges flipped
///     for
///       the shape of the faces, within the tolerance}
///     \cgalParamType{`unsigned int`}
///     \cgalParamDefault{0}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_faces}
///     \cgalParamDescription{a number of faces at which to stop. The tolerance then grows in steps
///       up to the one that is given, so that the certified bound is small for that number}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{0, as few as the tolerance allows}
///   \cgalParamNEnd
///   \cgalParamNBegin{normal_tolerance}
///     \cgalParamDescription{largest angle between a face and the faces of the input that the map
///       of the direct bound makes correspond to it}
///     \cgalParamType{`double`, in degrees, in (0, 180]; 180: no bound}
///     \cgalParamDefault{180}
///   \cgalParamNEnd
///   \cgalParamNBegin{ridge_tolerance}
///     \cgalParamDescription{largest distance, either way, between the ridges and borders of the
///       result and those of the input, as curves}
///     \cgalParamType{`double`, in mesh units, positive}
///     \cgalParamDefault{`tolerance`}
///   \cgalParamNEnd
///   \cgalParamNBegin{stages}
///     \cgalParamDescription{number of stages in which the tolerance grows in equal steps}
///     \cgalParamType{`unsigned int`, at least 1}
///     \cgalParamDefault{1}
///   \cgalParamNEnd
///   \cgalParamNBegin{single_precision}
///     \cgalParamDescription{vertices that move go to points with single-precision coordinates}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`; `true` where the mesh's points have `float` coordinates}
///   \cgalParamNEnd
///   \cgalParamNBegin{flip_rounds}
///     \cgalParamDescription{largest number of rounds of flips, each followed by collapses}
///     \cgalParamType{`unsigned int`}
///     \cgalParamDefault{3}
///   \cgalParamNEnd
///   \cgalParamNBegin{deviation_map}
///     \cgalParamDescription{receives b(K), a bound of the two-sided distance at each face}
///     \cgalParamType{a writable property map from faces to `double`}
///     \cgalParamDefault{the property map "f:deviation", which is added to the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{visitor}
///     \cgalParamDescription{`bool on_progress(const Progress&)`; returning `false` stops with the
///       valid, certified mesh reached so far}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class ConcurrencyTag = CGAL::Sequential_tag, class Mesh,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
Certificate make_geometric_mesh(
    Mesh& mesh, double tolerance, const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "make_geometric_mesh";
  internal::require_positive(tolerance, function, "tolerance");
  const auto controls = internal::simplification_controls(np, function);
  const auto plan = internal::simplification_plan(np, function);
  internal::Workspace<Mesh> work(mesh, tolerance, np, function);
  const auto [operations, is_complete]
      = work.template simplify<ConcurrencyTag>(controls, plan, internal::progress_reporter(np));

  const std::vector<double> bounds = work.face_bounds();
  const internal::Compaction compaction = work.write_back(mesh, np);
  internal::write_deviation(bounds, compaction, np, mesh);
  const double bound = bounds.empty() ? 0 : *std::max_element(bounds.begin(), bounds.end());
  return Certificate(tolerance, bound, work.record(compaction), operations, !is_complete);
}

} // namespace surety

#endif // SURETY_GEOMETRIC_MESH_H
