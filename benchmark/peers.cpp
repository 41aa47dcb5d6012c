// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's edge collapse with its various policies, and the list of all peers.
#include "peers.h"

#include "stopwatch.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_distance_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Polyhedral_envelope_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace surety::benchmark {

#ifdef SURETY_HAS_OPENMESH
Peer openmesh_hausdorff(); // openmesh_peer.cpp
#endif
#ifdef SURETY_HAS_MESHOPTIMIZER
Peer meshoptimizer_target_error(); // meshoptimizer_peer.cpp
#endif

namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

using Normal_filter = SMS::Bounded_normal_change_filter<>;
using Envelope_filter = SMS::Polyhedral_envelope_filter<Kernel, Normal_filter>;
using Turk_cost = SMS::LindstromTurk_cost<Mesh>;
using Turk_placement = SMS::LindstromTurk_placement<Mesh>;
using Heckbert = SMS::GarlandHeckbert_plane_policies<Mesh, Kernel>;

/// Stops at a number of faces; CGAL's own predicates count edges.
struct Face_count {
  std::size_t faces;

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const
  {
    return profile.surface_mesh().number_of_faces() <= faces;
  }
};

/// Goes on as long as some edge can be collapsed.
constexpr Face_count never{0};

double finish(Mesh& mesh, const Stopwatch& stopwatch)
{
  const double seconds = stopwatch.seconds();
  mesh.collect_garbage();
  return seconds;
}

double collapse_turk(Mesh& mesh, const Goal& goal)
{
  const Stopwatch stopwatch;
  SMS::edge_collapse(
      mesh, Face_count{goal.faces},
      CGAL::parameters::get_cost(Turk_cost()).get_placement(Turk_placement()));
  return finish(mesh, stopwatch);
}

double collapse_heckbert(Mesh& mesh, const Goal& goal)
{
  const Stopwatch stopwatch;
  Heckbert policies(mesh);
  SMS::edge_collapse(
      mesh, Face_count{goal.faces},
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  return finish(mesh, stopwatch);
}

double collapse_turk_in_envelope(Mesh& mesh, const Goal& goal)
{
  const Stopwatch stopwatch;
  SMS::edge_collapse(
      mesh, never,
      CGAL::parameters::get_cost(Turk_cost())
          .get_placement(Turk_placement())
          .filter(Envelope_filter(goal.tolerance)));
  return finish(mesh, stopwatch);
}

double collapse_heckbert_in_envelope(Mesh& mesh, const Goal& goal)
{
  const Stopwatch stopwatch;
  Heckbert policies(mesh);
  SMS::edge_collapse(
      mesh, never,
      CGAL::parameters::get_cost(policies.get_cost())
          .get_placement(policies.get_placement())
          .filter(Envelope_filter(goal.tolerance)));
  return finish(mesh, stopwatch);
}

double collapse_with_bounded_distance(Mesh& mesh, const Goal& goal)
{
  const Stopwatch stopwatch;
  const SMS::Bounded_distance_placement<Turk_placement, Kernel> placement(goal.tolerance);
  SMS::edge_collapse(
      mesh, never,
      CGAL::parameters::get_cost(Turk_cost()).get_placement(placement).filter(Normal_filter()));
  return finish(mesh, stopwatch);
}

} // namespace

Peer cgal_lindstrom_turk() { return {"cgal_lindstrom_turk", false, false, collapse_turk}; }

Peer cgal_garland_heckbert() { return {"cgal_garland_heckbert", false, false, collapse_heckbert}; }

std::vector<Peer> all_peers()
{
  std::vector<Peer> peers
      = {cgal_lindstrom_turk(),
         cgal_garland_heckbert(),
         {"cgal_lindstrom_turk_envelope", true, true, collapse_turk_in_envelope},
         {"cgal_garland_heckbert_envelope", true, true, collapse_heckbert_in_envelope},
         {"cgal_bounded_distance_placement", true, false, collapse_with_bounded_distance}};
#ifdef SURETY_HAS_OPENMESH
  peers.push_back(openmesh_hausdorff());
#endif
#ifdef SURETY_HAS_MESHOPTIMIZER
  peers.push_back(meshoptimizer_target_error());
#endif
  return peers;
}

} // namespace surety::benchmark
