// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of detail: one simplification from fine to coarse that keeps a mesh for each tolerance,
// every one with a proof of its own against the input (figure 8 of P. J. Frey, About Surface
// Remeshing, 2000).
#ifndef SURETY_HIERARCHY_H
#define SURETY_HIERARCHY_H

#include <surety/certificate.h>
#include <surety/geometric_mesh.h>
#include <surety/hierarchy_record.h>
#include <surety/internal/hierarchy/maker.h>
#include <surety/internal/hierarchy/text_format.h>

#include <iosfwd>
#include <utility>
#include <vector>

namespace surety {

/// One level of a hierarchy. The property map "f:deviation" of the mesh bounds the two-sided
/// distance to the input at each face.
template <class Mesh>
struct Hierarchy_level {
  Mesh mesh; ///< with the map "f:deviation"
  /// Against the input, not against the level before. Its operations are those performed from the
  /// input to this level; refusals are counted for the whole hierarchy only.
  Certificate certificate;
};

/// A mesh on the way from the input to the coarsest level.
template <class Mesh>
struct Extraction {
  Mesh mesh;                  ///< a valid one
  double tolerance = 0;       ///< the two-sided distance to the input is at most this; a length
  std::size_t operations = 0; ///< that lead to it, from the input
};

/// \brief Meshes of fewer and fewer faces, with a proven distance to the input for each, and
/// everything between them.
template <class Mesh>
class Hierarchy
{
public:
  /// For the functions that make hierarchies.
  Hierarchy(
      Mesh input, std::vector<Hierarchy_level<Mesh>> levels, Hierarchy_record record,
      const Operations& operations)
    : input_(std::move(input)),
      levels_(std::move(levels)),
      record_(std::move(record)),
      operations_(operations)
  {}

  /// The levels, from fine to coarse. Neither the faces increase from one to the next nor do the
  /// bounds decrease. There are as many as tolerances, unless a visitor or `target_faces` ended the
  /// work early.
  const std::vector<Hierarchy_level<Mesh>>& levels() const { return levels_; }
  /// Whether a visitor ended the work early. The last level is then what had been reached.
  bool is_cancelled() const { return levels_.back().certificate.is_cancelled(); }
  /// What was done and refused, in all.
  const Operations& operations() const { return operations_; }
  /// A copy of the input.
  const Mesh& input() const { return input_; }
  /// The operations, to be written to a file.
  const Hierarchy_record& record() const { return record_; }

  /// \brief the mesh after a number of operations, or after a few less where that many would end
  /// inside a transaction.
  ///
  /// At the number where a level ends it is the level's mesh. Nothing is simplified again: the
  /// operations are made without being checked, in time linear in the input.
  Extraction<Mesh> extract(std::size_t operations) const;

  /// \brief the first mesh that has at most this number of faces, or the coarsest if none has.
  Extraction<Mesh> extract_faces(std::size_t faces) const;

private:
  Mesh input_;
  std::vector<Hierarchy_level<Mesh>> levels_;
  Hierarchy_record record_;
  Operations operations_;
};

namespace internal {

template <class Mesh>
Extraction<Mesh> extract_operations(
    const Mesh& input, const Hierarchy_record& record, std::size_t operations, const char* function)
{
  operations = std::min(operations, record.operations.size());
  while (operations > 0 && !record.operations[operations - 1].is_boundary) --operations;
  Replay<Mesh> replay(input, record, function);
  while (replay.made() < operations) replay.advance();
  return {replay.mesh(), replay.tolerance(), replay.made()};
}

template <class Mesh>
Extraction<Mesh> extract_faces(
    const Mesh& input, const Hierarchy_record& record, std::size_t faces, const char* function)
{
  Replay<Mesh> replay(input, record, function);
  while (!replay.is_at_end() && !(replay.is_at_boundary() && replay.faces() <= faces))
    replay.advance();
  return {replay.mesh(), replay.tolerance(), replay.made()};
}

/// Whether a record from anywhere may be replayed on this mesh.
template <class Mesh>
void require_record_of(const Mesh& input, const Hierarchy_record& record, const char* function)
{
  require_valid_mesh(input, function, "input", CGAL::parameters::default_values());
  const std::string defect = record_defect(record);
  if (!defect.empty()) throw Invalid_input(function, "record", defect);
  if (record.vertices != input.number_of_vertices()
      || record.fingerprint != fingerprint_of(input, input.points()))
    throw Invalid_input(
        function, "record", "it belongs to another input",
        "use the mesh that the hierarchy was made of, as it was written");
}

} // namespace internal

template <class Mesh>
Extraction<Mesh> Hierarchy<Mesh>::extract(std::size_t operations) const
{
  return internal::extract_operations(input_, record_, operations, "Hierarchy::extract");
}

template <class Mesh>
Extraction<Mesh> Hierarchy<Mesh>::extract_faces(std::size_t faces) const
{
  return internal::extract_faces(input_, record_, faces, "Hierarchy::extract_faces");
}

/// \brief makes levels of detail of a mesh, each within its own proven distance.
///
/// One simplification as by `make_geometric_mesh()`, in which the tolerance grows from each value
/// to the next, and of which a level is kept whenever no more faces can go. The bound of each level
/// is proven against the input directly: nothing adds up from level to level. All that
/// `make_geometric_mesh()` promises holds for each level: the tolerance, genus, components and
/// borders; ridges and constraints; no new self-intersections; the same result every time.
///
/// \param mesh as for `make_geometric_mesh()`; not changed.
/// \param tolerances of the levels, from fine to coarse: largest two-sided Hausdorff distances to
///   the input, in mesh units.
/// \return the levels with their certificates, and the record of the operations, from which any
///   mesh between two levels can be extracted.
/// \throws Invalid_input when there is no tolerance, one is not positive and finite, or they do not
///   increase strictly; and whenever `make_geometric_mesh()` does.
///
/// The named parameters are those of `make_geometric_mesh()`, except that
/// - `effort` is `Effort::fast` by default. With more, transactions run in the last level only;
/// - `smoothing_sweeps` are made in the last level only;
/// - `stages` is the number of steps from each tolerance to the next;
/// - `target_faces` ends the work, and leaves coarser levels out;
/// - tolerance maps and `ridge_tolerance` are for the last level, and count in a finer one by the
///   ratio of its tolerance to the last;
/// - a `vertex_point_map` is read. The points of the levels are the meshes' own;
/// - there is no `deviation_map`, since each level has its own "f:deviation".
///
/// Complexity: O(n log n) for the coarsest level, and for each other one O(n) to look for what its
/// tolerance admits and to copy the input. Beside the levels, 250 bytes a face while it runs, and
/// afterwards the input and about 12 bytes an operation.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Hierarchy<Mesh> make_hierarchy(
    const Mesh& mesh, const std::vector<double>& tolerances,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  static_assert(
      internal::is_absent<NamedParameters, internal::deviation_map_t>,
      "each level has its own property map f:deviation");
  const char* const function = "make_hierarchy";
  internal::require_tolerances(tolerances, function);
  const auto controls = internal::simplification_controls(np, function);
  internal::Hierarchy_maker<Mesh, Hierarchy_level<Mesh>> maker(mesh, tolerances, np, function);
  maker.run(controls, internal::progress_reporter(np));
  return Hierarchy<Mesh>(
      std::move(maker.input()), std::move(maker.levels()), std::move(maker.record()),
      maker.operations());
}

/// \brief makes a mesh of a hierarchy from the input and a record, without the hierarchy.
///
/// What `Hierarchy::extract()` returns, up to the order of its elements if the input's are not
/// connected in the same order. The record need not be trusted: it cannot lead to anything but a
/// manifold mesh of the input's topology. But the tolerance is what it says; who does not know
/// where it comes from checks it with `certify_distance()`.
///
/// \param input the mesh that the hierarchy was made of; its own points count.
/// \param operations as for `Hierarchy::extract()`.
/// \throws Invalid_input when the input is not valid or not the record's, or the record cannot be
///   replayed on it.
///
/// Complexity: O(n log n).
template <class Mesh>
Extraction<Mesh> extract_operations(
    const Mesh& input, const Hierarchy_record& record, std::size_t operations)
{
  const char* const function = "extract_operations";
  internal::require_record_of(input, record, function);
  return internal::extract_operations(input, record, operations, function);
}

/// \brief the same for a number of faces, as `Hierarchy::extract_faces()`.
template <class Mesh>
Extraction<Mesh> extract_faces(const Mesh& input, const Hierarchy_record& record, std::size_t faces)
{
  const char* const function = "extract_faces";
  internal::require_record_of(input, record, function);
  return internal::extract_faces(input, record, faces, function);
}

/// \brief writes a record as text, exactly.
///
/// The format is described in `surety/internal/hierarchy/text_format.h`. Whether the stream took
/// everything is to be asked of the stream.
///
/// \throws Invalid_input when it could not be read back.
inline void write_hierarchy_record(std::ostream& out, const Hierarchy_record& record)
{
  const std::string defect = internal::record_defect(record);
  if (!defect.empty()) throw Invalid_input("write_hierarchy_record", "record", defect);
  internal::write_text(out, record);
}

/// \brief reads a record that `write_hierarchy_record()` wrote, and leaves what follows in the
/// stream.
///
/// \throws Invalid_input naming the line, when the text is not a record of a known version.
inline Hierarchy_record read_hierarchy_record(std::istream& in)
{
  return internal::Hierarchy_text_reader(in).read();
}

} // namespace surety

#endif // SURETY_HIERARCHY_H
