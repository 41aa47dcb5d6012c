// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything that the library promises. Programs that compile often include what they use instead.
#ifndef SURETY_SURETY_H
#define SURETY_SURETY_H

#include <surety/background_metric.h>
#include <surety/certificate.h>
#include <surety/correspondence.h>
#include <surety/covering_certificate.h>
#include <surety/curvature.h>
#include <surety/distance.h>
#include <surety/enrich.h>
#include <surety/errors.h>
#include <surety/features.h>
#include <surety/features_by_need.h>
#include <surety/geometric_mesh.h>
#include <surety/geometric_support.h>
#include <surety/gradation.h>
#include <surety/hierarchy.h>
#include <surety/medit_sol.h>
#include <surety/metric.h>
#include <surety/metric_fit.h>
#include <surety/operations.h>
#include <surety/parameters.h>
#include <surety/proximity.h>
#include <surety/remesh.h>
#include <surety/solution_metric.h>
#include <surety/statistics.h>
#include <surety/support_on_geometric_mesh.h>
#include <surety/support_tessellation.h>
#include <surety/transfer.h>
#include <surety/unit_mesh.h>
#include <surety/version.h>

#endif // SURETY_SURETY_H
