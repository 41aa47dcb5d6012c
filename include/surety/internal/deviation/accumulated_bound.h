// SPDX-License-Identifier: GPL-3.0-or-later
//
// The accumulated bound, the paper's (section 2.1, equations 4 and 5): every operation adds the
// distance between what it takes away and what it puts there.
#ifndef SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H
#define SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H

#include <surety/internal/deviation/policy.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/deviation/rounding.h>

#include <vector>

namespace surety::internal {

class Accumulated_bound final : public Deviation_policy
{
public:
  Accumulated_bound(const Reference&, const Working_mesh& mesh, double)
    : bound_(mesh.number_of_real_faces(), 0.0)
  {}

  Verdict check(const Disc&) override { return Verdict::deviation; }
  void commit(const Disc&) override {}
  std::vector<double> face_bounds() const override { return bound_; }

private:
  std::vector<double> bound_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H
