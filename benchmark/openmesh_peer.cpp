// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenMesh's decimater: quadric order, and its Hausdorff module for the tolerance.
#include "peers.h"

#include "stopwatch.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <vector>

namespace surety::benchmark {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Open_mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Decimater = OpenMesh::Decimater::DecimaterT<Open_mesh>;

Open_mesh to_open_mesh(const Mesh& mesh)
{
  Open_mesh result;
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    result.add_vertex({p.x(), p.y(), p.z()});
  }
  std::vector<Open_mesh::VertexHandle> corners;
  for (const auto f : mesh.faces()) {
    corners.clear();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners.emplace_back(static_cast<int>(v.idx()));
    result.add_face(corners);
  }
  return result;
}

Mesh from_open_mesh(const Open_mesh& mesh)
{
  Mesh result;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.add_vertex(Point(p[0], p[1], p[2]));
  }
  std::vector<Mesh::Vertex_index> corners;
  for (const auto f : mesh.faces()) {
    corners.clear();
    for (auto v = mesh.cfv_ccwiter(f); v.is_valid(); ++v)
      corners.emplace_back(static_cast<Mesh::size_type>(v->idx()));
    result.add_face(corners);
  }
  return result;
}

double decimate(Mesh& mesh, const Goal& goal)
{
  Open_mesh open_mesh = to_open_mesh(mesh);
  const Stopwatch stopwatch;
  Decimater decimater(open_mesh);
  OpenMesh::Decimater::ModHausdorffT<Open_mesh>::Handle hausdorff;
  OpenMesh::Decimater::ModQuadricT<Open_mesh>::Handle quadric;
  decimater.add(hausdorff);
  decimater.add(quadric);
  decimater.module(hausdorff).set_tolerance(goal.tolerance);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, 0);
  const double seconds = stopwatch.seconds();
  open_mesh.garbage_collection();
  mesh = from_open_mesh(open_mesh);
  return seconds;
}

} // namespace

Peer openmesh_hausdorff() { return {"openmesh_hausdorff", true, false, decimate}; }

} // namespace surety::benchmark
