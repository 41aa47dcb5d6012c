// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh that follows the sharp front of a solution on a sphere, always within the tolerance of the
// mesh that it began with. Finite elements are in surface_fem.h.
#include "surface_fem.h"

#include <surety/background_metric.h>
#include <surety/distance.h>
#include <surety/gradation.h>
#include <surety/remesh.h>
#include <surety/solution_metric.h>
#include <surety/transfer.h>

#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <iostream>

/// u = tanh((z - place) / width) on the unit sphere; there, div grad g(z) = (1 - z^2) g'' - 2 z g'.
struct Front {
  double place, width = .05;

  double operator()(const Eigen::Vector3d& x) const
  {
    return std::tanh((x.normalized().z() - place) / width);
  }
  double laplacian(const Eigen::Vector3d& x) const
  {
    const double z = x.normalized().z(), u = (*this)(x), first = (1 - u * u) / width;
    return (1 - z * z) * (-2 * u * first / width) - 2 * z * first;
  }
};

Mesh sphere(int levels)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  CGAL::Subdivision_method_3::Loop_subdivision(
      mesh, CGAL::parameters::number_of_iterations(levels));
  for (Point& p : mesh.points()) {
    const auto v = p - CGAL::ORIGIN;
    p = CGAL::ORIGIN + v / std::sqrt(v.squared_length());
  }
  return mesh;
}

Field to_field(Mesh& mesh, const Eigen::VectorXd& u)
{
  const Field field = mesh.add_property_map<Mesh::Vertex_index, double>("v:u").first;
  for (const auto v : mesh.vertices()) field[v] = u[Eigen::Index(v)];
  return field;
}

/// Makes every mesh from the first one: errors cannot add up.
class Adaptation
{
public:
  Adaptation(const Mesh& first, double tolerance)
    : first_(first),
      tolerance_(tolerance),
      features_(surety::find_features(first)),
      curvature_(surety::estimate_curvatures(first, features_)),
      metric_(surety::make_geometric_metric(
          first, curvature_, surety::parameters::metric_tolerance(tolerance).maximum_size(.5))),
      support_(surety::make_geometric_support(first, tolerance, features_, curvature_))
  {
    surety::limit_gradation(first, metric_);
  }

  /// A mesh for solutions on the present one, proven to be near to the first.
  Mesh operator()(Mesh& present, const std::vector<Eigen::VectorXd>& solutions, double vertices)
  {
    const auto wanted = surety::parameters::target_vertices(vertices).maximum_size(.5);
    const auto features = surety::find_features(present);
    const auto sizes_for = [&](const Eigen::VectorXd& u) {
      return surety::make_solution_metric(present, features, to_field(present, u), wanted);
    };
    auto sizes = sizes_for(solutions.front());
    for (const auto& u : solutions) surety::intersect(sizes, sizes_for(u));
    surety::limit_gradation(present, sizes);
    const surety::Background_metric background(present, sizes);
    Mesh next = first_;
    const auto made = surety::make_unit_mesh(
        next, features_, metric_,
        surety::parameters::tolerance(tolerance_)
            .geometric_support(support_)
            .background_metric(background));
    holds_ = holds_ && made.certificate.holds()
        && surety::certify_distance(first_, next, tolerance_).holds();
    bound_ = made.certificate.bound();
    return next;
  }
  double bound() const { return bound_; }
  bool holds() const { return holds_; }

private:
  const Mesh& first_;
  double tolerance_;
  surety::Features features_;
  surety::Curvature_field curvature_;
  surety::Metric_field metric_;
  surety::Geometric_support support_;
  double bound_ = 0;
  bool holds_ = true;
};

/// u - width^2 div grad u = f, on uniform meshes and on adapted ones. Tells whether an adapted mesh
/// is as good as the finest uniform one with at most a fifth of its vertices.
bool show_steady_front(int levels)
{
  const Front exact{.2};
  const double k = exact.width * exact.width;
  const auto source = [&](const Element&, const Eigen::Vector3d&, const Eigen::Vector3d& x) {
    return exact(x) - k * exact.laplacian(x);
  };
  std::cout << "mesh, vertices, L2 error\n";
  double finest = 0, largest = 0;
  for (int level = 3; level <= levels + 1; ++level) {
    const Mesh mesh = sphere(level);
    largest = double(mesh.number_of_vertices());
    finest = l2_error(mesh, solve(mesh, k, source), exact);
    std::cout << "uniform, " << largest << ", " << finest << '\n';
  }
  const Mesh first = sphere(levels);
  Adaptation adapt(first, .005);
  bool is_better = false;
  for (double vertices = 200; vertices <= 800; vertices *= 2) {
    Mesh mesh = first;
    for (int loop = 0; loop < 2; ++loop) mesh = adapt(mesh, {solve(mesh, k, source)}, vertices);
    const double error = l2_error(mesh, solve(mesh, k, source), exact);
    std::cout << "adapted, " << mesh.number_of_vertices() << ", " << error << '\n';
    is_better = is_better || (error <= finest && 5 * double(mesh.number_of_vertices()) <= largest);
  }
  return is_better && adapt.holds();
}

/// u_t - width^2 div grad u = f while the front moves north, with implicit steps of time 1.
bool show_travelling_front(int levels)
{
  const Mesh first = sphere(levels);
  Adaptation adapt(first, .005);
  Mesh mesh = first;
  Front before{-.3};
  const auto values_on = [&](const Mesh& m) {
    Eigen::VectorXd u(m.number_of_vertices());
    for (const auto v : m.vertices()) {
      const Point& p = m.point(v);
      u[Eigen::Index(v)] = before({p.x(), p.y(), p.z()});
    }
    return u;
  };
  for (int loop = 0; loop < 2; ++loop) mesh = adapt(mesh, {values_on(mesh)}, 600);
  Eigen::VectorXd u = values_on(mesh);
  bool is_followed = true;
  std::cout << "step, vertices, proven distance from the first mesh, L2 error, mean lost\n";
  for (int step = 1; step <= 10; ++step) {
    const Front now{before.place + .06};
    const double k = now.width * now.width;
    const auto step_on = [&](const Mesh& m, const Eigen::VectorXd& old) {
      return solve(m, k, [&](const Element& e, const Eigen::Vector3d& w, const Eigen::Vector3d& x) {
        double value = now(x) - before(x) - k * now.laplacian(x);
        for (int i = 0; i < 3; ++i) value += w[i] * old[Eigen::Index(e.vertex[i])];
        return value;
      });
    };
    // The mesh must hold the front where it is and where it will be, as a first try tells.
    Mesh next = adapt(mesh, {u, step_on(mesh, u)}, 600);
    const Field carried = next.add_property_map<Mesh::Vertex_index, double>("v:carried").first;
    const auto report = surety::transfer_solution(
        mesh, to_field(mesh, u), next, carried, surety::parameters::conserves(true));
    Eigen::VectorXd old(next.number_of_vertices());
    for (const auto v : next.vertices()) old[Eigen::Index(v)] = carried[v];
    mesh = next;
    u = step_on(mesh, old);
    before = now;
    const double error = l2_error(mesh, u, now);
    is_followed = is_followed && error < .05;
    std::cout << step << ", " << mesh.number_of_vertices() << ", " << adapt.bound() << ", " << error
              << ", " << report.residual() << '\n';
  }
  return is_followed && adapt.holds();
}

int main(int argc, char* argv[])
{
  const std::string what = argc > 1 ? argv[1] : "";
  const int levels = argc > 2 ? std::stoi(argv[2]) : 5;
  if (what == "steady") return show_steady_front(levels) ? EXIT_SUCCESS : EXIT_FAILURE;
  if (what == "travelling") return show_travelling_front(levels) ? EXIT_SUCCESS : EXIT_FAILURE;
  std::cerr << "usage: adapt_to_front steady|travelling [subdivisions of the first mesh]\n";
  return EXIT_FAILURE;
}
