// SPDX-License-Identifier: GPL-3.0-or-later
//
// Subdivision, noise and rotations.
#include "refinement.h"

#include <CGAL/subdivision_method_3.h>

#include <Eigen/Geometry>

#include <random>

namespace surety::benchmark {
namespace {

/// The rule of a subdivision that leaves the surface as it is.
class Midpoints
{
public:
  explicit Midpoints(const Mesh& mesh) : mesh_(&mesh) {}

  void edge_node(Mesh::Halfedge_index h, Point& node) const
  {
    node = CGAL::midpoint(mesh_->point(mesh_->source(h)), mesh_->point(mesh_->target(h)));
  }
  void vertex_node(Mesh::Vertex_index v, Point& node) const { node = mesh_->point(v); }
  void border_node(Mesh::Halfedge_index h, Point& edge_node, Point& vertex_node) const
  {
    this->edge_node(h, edge_node);
    vertex_node = mesh_->point(mesh_->target(h));
  }

private:
  const Mesh* mesh_;
};

/// Without what a subdivision leaves behind, in memory and in the order of the elements.
Mesh compact(Mesh mesh)
{
  mesh.collect_garbage();
  return mesh;
}

} // namespace

Mesh split_in_four(const Mesh& mesh)
{
  Mesh result = mesh;
  CGAL::Subdivision_method_3::PTQ(result, Midpoints(result));
  return compact(std::move(result));
}

Mesh smoothed_in_four(const Mesh& mesh)
{
  Mesh result = mesh;
  CGAL::Subdivision_method_3::Loop_subdivision(result);
  return compact(std::move(result));
}

void add_noise(Mesh& mesh, double length, unsigned seed)
{
  std::mt19937 generator(seed);
  const auto random = [&] { return length * (2 * generator() / 4294967295.0 - 1); };
  for (const auto v : mesh.vertices()) {
    const Kernel::Vector_3 shift(random(), random(), random());
    mesh.point(v) = mesh.point(v) + shift;
  }
}

Mesh rotated(const Mesh& mesh, unsigned seed)
{
  std::mt19937 generator(seed);
  const auto random = [&] { return 2 * generator() / 4294967295.0 - 1; };
  Eigen::Quaterniond q(random(), random(), random(), random());
  const Eigen::Matrix3d rotation = q.normalized().toRotationMatrix();
  Mesh result = mesh;
  for (const auto v : result.vertices()) {
    const Point& p = mesh.point(v);
    const Eigen::Vector3d x = rotation * Eigen::Vector3d(p.x(), p.y(), p.z());
    result.point(v) = Point(x.x(), x.y(), x.z());
  }
  return result;
}

} // namespace surety::benchmark
