// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a support is from the original, proven; and on a geometric mesh, whose vertices are all
// that it shares with the original, what to do where that is too far.
#ifndef SURETY_INTERNAL_SUPPORT_FITTING_H
#define SURETY_INTERNAL_SUPPORT_FITTING_H

#include <surety/internal/support/report.h>
#include <surety/internal/support/surface.h>

#include <algorithm>

namespace surety::internal {

/// On the mesh of the original: the largest displacement, of points as they are computed.
inline double proven_deviation(const Support_surface& surface)
{
  double largest = 0;
  for (Index f = 0; f < surface.mesh().faces(); ++f) {
    if (surface.mesh().is_face(f)) largest = (std::max)(largest, surface.reach(f));
  }
  return rounding_of(surface.mesh()).upper_bound(largest * largest);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_FITTING_H
