// SPDX-License-Identifier: GPL-3.0-or-later
//
// One simplification from fine to coarse that leaves a level behind whenever its stage ends.
#ifndef SURETY_INTERNAL_HIERARCHY_MAKER_H
#define SURETY_INTERNAL_HIERARCHY_MAKER_H

#include <surety/certificate.h>
#include <surety/internal/geometric_mesh/workspace.h>
#include <surety/internal/hierarchy/replay.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surety::internal {

inline void require_tolerances(const std::vector<double>& tolerances, const char* function)
{
  if (tolerances.empty()) throw Invalid_input(function, "tolerances", "there is none");
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    require_positive(tolerances[i], function, "tolerances");
    if (i > 0 && !(tolerances[i - 1] < tolerances[i]))
      throw Invalid_input(
          function, "tolerances",
          to_text(tolerances[i]) + " follows " + to_text(tolerances[i - 1])
              + ", but they must increase",
          "sort them, and give each one once");
  }
}

/// The stages of all levels, as shares of the largest tolerance: from each tolerance to the next in
/// equal steps.
inline std::vector<double> level_shares(const std::vector<double>& tolerances, std::size_t steps)
{
  std::vector<double> shares;
  const double largest = tolerances.back();
  double previous = 0;
  for (const double tolerance : tolerances) {
    for (std::size_t k = 1; k < steps; ++k)
      shares.push_back((previous + (tolerance - previous) * double(k) / double(steps)) / largest);
    double share = tolerance / largest;
    while (share * largest > tolerance) share = std::nextafter(share, 0);
    shares.push_back(share);
    previous = tolerance;
  }
  return shares;
}

/// A copy whose own points are those that the function is told to work with.
template <class Mesh, class Points>
Mesh copy_with_points(const Mesh& mesh, const Points& points, const char* function)
{
  Mesh copy = mesh;
  for (const auto v : mesh.vertices()) {
    const Vector p = to_vector(get(points, v));
    if (p == to_vector(mesh.point(v))) continue;
    copy.point(v) = typename Mesh::Point(p.x(), p.y(), p.z());
    if (p != to_vector(copy.point(v)))
      throw Invalid_input(
          function, "vertex_point_map",
          "the mesh's own points cannot hold the point of vertex " + std::to_string(v),
          "use a mesh whose points have double coordinates");
  }
  return copy;
}

template <class Mesh, class Level>
class Hierarchy_maker
{
public:
  template <class NamedParameters>
  Hierarchy_maker(
      const Mesh& mesh, const std::vector<double>& tolerances, const NamedParameters& np,
      const char* function)
    : tolerances_(tolerances),
      work_(mesh, tolerances.back(), np, function),
      input_(copy_with_points(mesh, vertex_points(mesh, np), function)),
      plan_(simplification_plan(np, function)),
      steps_(plan_.stages.size())
  {
    if (is_absent<NamedParameters, effort_t>) plan_.overshoots.clear();
    plan_.stages = level_shares(tolerances, steps_);
    plan_.seeks_goal = false;
    // Before the last stage they cost as much as the collapses and save one face in a hundred.
    plan_.flips_in_all_stages = false;
    plan_.log = &log_;
    plan_.on_stage = [this](std::size_t stage) {
      if ((stage + 1) % steps_ == 0) add_level(false);
      return true;
    };
  }
  Hierarchy_maker(const Hierarchy_maker&) = delete;
  Hierarchy_maker& operator=(const Hierarchy_maker&) = delete;

  void run(Simplification_controls controls, const std::function<bool(const Progress&)>& visitor)
  {
    bool is_complete;
    controls.log = &log_;
    std::tie(operations_, is_complete)
        = work_.template simplify<CGAL::Sequential_tag>(controls, plan_, visitor);
    // The visitor, or the number of faces, may have ended the work inside a level.
    if (!is_complete || levels_.empty() || record_.levels.back().operations < log_.size())
      add_level(!is_complete);
    write_record();
  }

  Mesh& input() { return input_; }
  std::vector<Level>& levels() { return levels_; }
  Hierarchy_record& record() { return record_; }
  const Operations& operations() const { return operations_; }

private:
  void add_level(bool is_cancelled)
  {
    const double tolerance = tolerances_[levels_.size()];
    const std::vector<double> bounds = work_.face_bounds();
    Mesh mesh = input_;
    const Compaction compaction = write_level(work_.mesh(), work_.elements(), work_.scale(), mesh);
    write_deviation(bounds, compaction, CGAL::parameters::default_values(), mesh);
    // What is proven of a level holds for no less at the next one.
    if (!bounds.empty()) bound_ = std::max(bound_, *std::max_element(bounds.begin(), bounds.end()));
    count_operations();
    record_.levels.push_back({tolerance, bound_, static_cast<Index>(log_.size())});
    levels_.push_back(
        {std::move(mesh),
         Certificate(tolerance, bound_, work_.record(compaction), performed_, is_cancelled)});
  }

  /// What has been performed so far.
  void count_operations()
  {
    for (; counted_ < log_.size(); ++counted_) {
      if (log_[counted_].kind == Disc::Kind::flip)
        ++performed_.flips;
      else if (log_[counted_].kind == Disc::Kind::relocation)
        ++performed_.relocations;
      else
        ++performed_.collapses;
    }
  }

  static Hierarchy_record::Kind kind_of(Disc::Kind kind)
  {
    switch (kind) {
    case Disc::Kind::collapse:
      return Hierarchy_record::Kind::collapse;
    case Disc::Kind::flip:
      return Hierarchy_record::Kind::flip;
    case Disc::Kind::placement:
      return Hierarchy_record::Kind::placement;
    case Disc::Kind::relocation:
    case Disc::Kind::split: // no operation of a hierarchy
      break;
    }
    return Hierarchy_record::Kind::relocation;
  }

  /// From the engine's half-edges to the vertices of the user's mesh.
  void write_record()
  {
    const auto& position = work_.elements().input_position;
    record_.fingerprint = fingerprint_of(input_, input_.points());
    record_.vertices = static_cast<Index>(position.size());
    record_.operations.reserve(log_.size());
    for (const Step& step : log_) {
      const auto kind = kind_of(step.kind);
      const bool is_relocation = kind == Hierarchy_record::Kind::relocation;
      const Index source = position[step.source];
      record_.operations.push_back(
          {source, is_relocation ? source : position[step.target], kind, step.is_boundary});
      if (!moves_a_vertex(kind)) continue;
      const Vector p = step.point / work_.scale();
      record_.points.push_back({p.x(), p.y(), p.z()});
    }
  }

  const std::vector<double>& tolerances_;
  Workspace<Mesh> work_;
  Mesh input_;
  Simplification_plan plan_;
  std::size_t steps_; ///< stages a level

  std::vector<Step> log_;
  std::size_t counted_ = 0;
  Operations performed_, operations_;
  double bound_ = 0;
  std::vector<Level> levels_;
  Hierarchy_record record_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_HIERARCHY_MAKER_H
