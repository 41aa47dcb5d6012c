// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a unit mesh: T and its metric are read, M is remeshed under the covering bound, and where
// the tolerance forbids the size that the metric asks for, the metric gives way.
#ifndef SURETY_INTERNAL_UNIT_MESH_MAKER_H
#define SURETY_INTERNAL_UNIT_MESH_MAKER_H

#include <surety/features.h>
#include <surety/geometric_support.h>
#include <surety/internal/deviation/covering_bound.h>
#include <surety/internal/geometric_mesh/exchange.h>
#include <surety/internal/journal.h>
#include <surety/internal/unit_mesh/editor.h>
#include <surety/internal/unit_mesh/ground.h>
#include <surety/internal/unit_mesh/remesher.h>
#include <surety/metric_fit.h>
#include <surety/metric_field.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace surety::internal::unit_mesh {

struct Controls {
  double tolerance;
  double gradation; ///< of the metric after it has given way
  unsigned most_passes;
  double collapse_below; ///< metric length
  bool allow_self_intersections;
  bool places_freely;
  double least_size;                   ///< the metric gives way down to this
  const Background_metric* background; ///< to be respected as well; may be null
};

template <class Mesh>
class Maker
{
public:
  template <class Points>
  Maker(
      const Mesh& mesh, const Points& points, const Features& features, const Metric_field& field,
      const Geometric_support& support, const Controls& controls,
      std::function<bool(double, std::size_t)> goes_on)
    : controls_(controls),
      scale_(normalising_scale(mesh, points)),
      elements_(mesh, points),
      reference_(make_reference(
          elements_, points_in_order(elements_, points, scale_),
          read_connectivity(mesh, elements_))),
      is_feature_(features_in_order(elements_, features)),
      is_corner_(corners_in_order(features)),
      working_(make_working_mesh(
          elements_, features, read_connectivity(mesh, elements_),
          points_in_order(elements_, points, scale_), journal_)),
      bound_(reference_, working_, scale_ * controls.tolerance),
      ground_(
          mesh, elements_, reference_, is_feature_, is_corner_, field, support, scale_,
          controls.background),
      editor_(
          ground_, working_, bound_, is_feature_, !controls.allow_self_intersections,
          controls.places_freely),
      remesher_(editor_, controls.collapse_below, std::move(goes_on))
  {
    keep_whole(features);
  }

  void run()
  {
    remesher_.run_coarse();
    bool is_marked = false;
    for (passes_ = 0; passes_ < controls_.most_passes && !remesher_.is_cancelled(); ++passes_) {
      constexpr std::size_t few = 20;
      remesher_.set_fraction(.2 + .6 * passes_ / controls_.most_passes);
      const std::size_t changes = remesher_.run_pass();
      // The first pass leaves much that only looks blocked.
      is_marked = passes_ > 0 && give_way();
      if (passes_ > 0 && !is_marked && changes < few) break;
    }
    remesher_.set_fraction(.8);
    if (!remesher_.is_cancelled()) remesher_.settle();
    give_way();
    if (!remesher_.is_cancelled()) remesher_.polish();
  }

  const Operations& operations() const { return editor_.operations(); }
  bool is_cancelled() const { return remesher_.is_cancelled(); }
  unsigned passes() const { return passes_; }

  Metric_fit fitness() const
  {
    Metric_fit result;
    double sum = 0;
    std::size_t edges = 0, unit = 0, faces = 0;
    for (Index e = 0; e < working_.number_of_real_edges(); ++e) {
      if (!editor_.is_real(e)) continue;
      const double length = editor_.length(e);
      const double miss = length < 1 ? 1 - length : 1 - 1 / length;
      sum += miss * miss;
      ++edges;
      unit += length >= shortest_unit && length <= longest_unit ? 1 : 0;
      ++result.length_histogram[bin_of(length, Metric_fit::length_limits)];
    }
    if (edges == 0) return result;
    result.unit_edges = 100 * double(unit) / double(edges);
    result.efficiency_index = 1 - sum / double(edges);
    sum = 0;
    for_each_face([&](Index f) {
      const double quality = editor_.quality(f);
      sum += quality;
      result.Q_max = std::max(result.Q_max, quality);
      ++result.quality_histogram[bin_of(quality, Metric_fit::quality_limits)];
      ++faces;
    });
    result.Q_avg = sum / double(faces);
    return result;
  }
  /// With respect to the metric as it was given; to be asked last.
  Metric_fit fitness_of_given()
  {
    editor_.take_sizes_as_given();
    return fitness();
  }

  /// M as a mesh of its own, with b(K) in "f:deviation" and the curves in "e:is_feature".
  template <class Points>
  Mesh result(const Points& points, std::vector<double>& bounds)
  {
    using Point = typename boost::property_traits<Points>::value_type;
    std::vector<Point> places;
    std::vector<std::array<std::size_t, 3>> triangles;
    std::vector<Index> name(working_.number_of_real_vertices(), none), faces;
    for (Index v = 0; v < name.size(); ++v) {
      if (!working_.is_live_vertex(v)) continue;
      name[v] = static_cast<Index>(places.size());
      const bool is_of_input
          = v < reference_.number_of_vertices() && working_.point(v) == reference_.point(v);
      const Vector p = working_.point(v) / scale_;
      places.push_back(
          is_of_input ? get(points, elements_.vertices[v]) : Point(p.x(), p.y(), p.z()));
    }
    for_each_face([&](Index f) {
      const auto v = working_.vertices_of(f);
      triangles.push_back({name[v[0]], name[v[1]], name[v[2]]});
      faces.push_back(f);
    });
    Mesh result;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(places, triangles, result);

    const std::vector<double> all = bound_.face_bounds();
    bounds.clear();
    for (const Index f : faces) bounds.push_back(all[f] / scale_);
    auto is_feature
        = result.template add_property_map<typename Mesh::Edge_index, bool>("e:is_feature", false)
              .first;
    using Vertex = typename Mesh::Vertex_index;
    for (Index e = 0; e < working_.number_of_real_edges(); ++e) {
      if (!editor_.is_real(e) || !working_.is_feature(e)) continue;
      const auto h = result.halfedge(
          Vertex(name[working_.source(2 * e)]), Vertex(name[working_.target(2 * e)]));
      is_feature[result.edge(h)] = true;
    }
    return result;
  }

private:
  template <class Limits>
  static std::size_t bin_of(double value, const Limits& limits)
  {
    return std::size_t(std::lower_bound(limits.begin(), limits.end(), value) - limits.begin());
  }

  std::vector<bool> corners_in_order(const Features& features) const
  {
    std::vector<bool> result(elements_.vertices.size());
    for (Index v = 0; v < result.size(); ++v) result[v] = features.corner[elements_.vertices[v]];
    return result;
  }

  void keep_whole(const Features& features)
  {
    if (features.whole.empty()) return;
    for (Index e = 0; e < elements_.edges.size(); ++e)
      if (features.whole[elements_.edges[e]])
        editor_.keep_whole(working_.source(2 * e), working_.target(2 * e));
  }

  template <class Visit>
  void for_each_face(Visit visit) const
  {
    for (Index f = 0; f < working_.number_of_real_faces(); ++f)
      if (working_.is_live_face(f)) visit(f);
  }

  /// Where the tolerance has kept edges too short, sizes are lowered to what is there. Tells
  /// whether they are anywhere.
  bool give_way()
  {
    constexpr double factor = .8;
    return editor_.lower_sizes(
        remesher_.blocked(), factor, scale_ * controls_.least_size, std::log(controls_.gradation));
  }

  Controls controls_;
  double scale_;
  Elements<Mesh> elements_;
  Reference reference_;
  std::vector<bool> is_feature_, is_corner_;
  Journal journal_;
  Working_mesh working_;
  Covering_bound bound_;
  Ground ground_;
  Editor editor_;
  Remesher remesher_;
  unsigned passes_ = 0;
};

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_MAKER_H
