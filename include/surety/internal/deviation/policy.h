// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one question that operators ask about distance.
#ifndef SURETY_INTERNAL_DEVIATION_POLICY_H
#define SURETY_INTERNAL_DEVIATION_POLICY_H

#include <surety/internal/operators/disc.h>
#include <surety/operations.h>

namespace surety::internal {

/// A bound on the deviation of M from T. An operator calls check() with the disc that it wants to
/// retriangulate, and after Verdict::accept either commit(), *before* it changes M, or nothing.
/// Between the two the policy keeps what it worked out; check() alone changes nothing.
class Deviation_policy
{
public:
  virtual ~Deviation_policy() = default;
  virtual Verdict check(const Disc& disc) = 0;
  virtual void commit(const Disc& disc) = 0;

  /// Whether what refused an operation like this one before still does: the cheapest of tests.
  virtual bool is_blocked(const Disc& disc)
  {
    static_cast<void>(disc);
    return false;
  }

  /// For what check() or is_blocked() has just refused for its deviation: the factor by which the
  /// tolerance must grow, at least, before they can accept it.
  virtual double growth_needed() const { return 1; }

  /// Squared distances before and after an operation, as far as they can be foretold without
  /// checking it: a hint for choosing operations, and no bound.
  struct Forecast {
    double before = 0, after = 0;
  };
  virtual Forecast forecast(const Disc& disc) const
  {
    static_cast<void>(disc);
    return {};
  }

  /// The share of the tolerance that counts until the next call, at first all of it.
  virtual void set_stage(double share) = 0;

  /// b(K), an upper bound of the two-sided distance at face K; see section 2.1 of the paper.
  virtual std::vector<double> face_bounds() = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_POLICY_H
