// SPDX-License-Identifier: GPL-3.0-or-later
//
// Operations that keep the count and bring M closer to T: flips, and relocations to where the fan
// optimizer proposes. They make room for collapses.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_IMPROVER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_IMPROVER_H

#include <surety/internal/geometric_mesh/editor.h>
#include <surety/internal/geometric_mesh/fan_optimizer.h>

namespace surety::internal {

class Improver
{
public:
  Improver(Editor& editor, Deviation_policy& deviation, bool flips, bool moves_ridges)
    : editor_(editor),
      mesh_(editor.mesh()),
      deviation_(deviation),
      flips_(flips),
      moves_ridges_(moves_ridges)
  {}

  /// The disc of the last operation that was made.
  const Disc& disc() const { return disc_; }

  /// Flips an edge if that brings M closer to T, or makes the worse of the two faces better without
  /// taking M away from T.
  bool flip(Index e)
  {
    if (!flips_ || !mesh_.is_live_edge(e) || mesh_.is_border(e) || mesh_.is_feature(e))
      return false;
    make_flip_disc(mesh_, mesh_.halfedge(e), disc_);
    return flip_improves() && editor_.try_to(disc_);
  }

  /// Moves a vertex if that lowers the objective by at least a share of it.
  bool relocate(Index v, Fan_optimizer& optimizer, double least_gain)
  {
    if (!mesh_.is_live_vertex(v) || mesh_.is_fixed(v)) return false;
    if (mesh_.is_on_feature(v) && !moves_ridges_) return false;
    make_relocation_disc(mesh_, v, disc_);
    optimizer.look_at(disc_);
    if (!optimizer.has_samples()) return false;
    const double before = optimizer.evaluate(disc_.apex_point, Objective::sum);
    const double after = optimizer.optimize(disc_, disc_.apex_point, Objective::sum);
    return after < (1 - least_gain) * before && editor_.try_to(disc_);
  }

private:
  bool flip_improves() const
  {
    constexpr double closer = 0.92, about_as_close = 1.1, rounder = 0.99;
    const auto squared = deviation_.forecast(disc_);
    if (squared.after < closer * squared.before) return true;
    if (squared.after > about_as_close * squared.before) return false;
    const Vector &c = mesh_.point(disc_.ring[0]), &a = mesh_.point(disc_.ring[1]),
                 &d = mesh_.point(disc_.ring[2]), &b = mesh_.point(disc_.ring[3]);
    const double before = std::max(shape_quality(a, b, c), shape_quality(b, a, d));
    const double after = std::max(shape_quality(c, a, d), shape_quality(c, d, b));
    return after < rounder * before;
  }

  Editor& editor_;
  const Working_mesh& mesh_;
  Deviation_policy& deviation_;
  bool flips_, moves_ridges_;
  Disc disc_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_IMPROVER_H
