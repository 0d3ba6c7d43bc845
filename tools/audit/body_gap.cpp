#include "tools/audit/body_gap.h"

#include <Eigen/LU>
#include <algorithm>
#include <vector>

namespace tern::audit {
namespace {

constexpr double kResolution = 1e-6;  // m
constexpr int kMaxSteps = 200;
/// An atom of a smaller weight is dropped.
constexpr double kNoWeight = 1e-14;

bool is_sphere(const Body& body) { return body.vertices.cols() == 1; }

double sphere_gap(const Vec3& centre, double radius, const Vec3& h) {
  const Vec3 beyond = centre.cwiseAbs() - h;
  const double outside = beyond.cwiseMax(0.0).norm();
  return (outside > 0.0 ? outside : beyond.maxCoeff()) - radius;
}

struct Atom {
  Vec3 at;
  double weight;
};

/// Returns the extreme point of (p + vertices) − box(h) against direction x.
Vec3 extreme_against(const Points& vertices, const Vec3& p, const Vec3& h, const Vec3& x) {
  Eigen::Index least = 0;
  (x.transpose() * vertices).minCoeff(&least);
  const Vec3 corner(x.x() > 0.0 ? h.x() : -h.x(), x.y() > 0.0 ? h.y() : -h.y(), x.z() > 0.0 ? h.z() : -h.z());
  return p + vertices.col(least) - corner;
}

/// Returns the weights, summing to 1, of the point of least norm in the atoms' affine hull. They solve
///     [0 1ᵀ; 1 AᵀA] [μ; w] = [1; 0].
Eigen::VectorXd affine_weights(const std::vector<Atom>& atoms) {
  const auto n = static_cast<Eigen::Index>(atoms.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Ones(n + 1, n + 1);
  system(0, 0) = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      system(i + 1, j + 1) = atoms[idx(i)].at.dot(atoms[idx(j)].at);
    }
  }
  return system.fullPivLu().solve(Eigen::VectorXd::Unit(n + 1, 0)).tail(n);
}

/// Moves the weights to the point of least norm in the atoms' convex hull, and drops unneeded atoms.
void correct(std::vector<Atom>& atoms) {
  while (atoms.size() > 1) {
    const Eigen::VectorXd wanted = affine_weights(atoms);
    double share = 1.0;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      const double w = wanted[static_cast<Eigen::Index>(i)];
      if (w < 0.0) share = std::min(share, atoms[i].weight / (atoms[i].weight - w));
    }
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      atoms[i].weight += share * (wanted[static_cast<Eigen::Index>(i)] - atoms[i].weight);
    }
    const std::size_t before = atoms.size();
    std::erase_if(atoms, [](const Atom& a) { return a.weight <= kNoWeight; });
    if (share == 1.0 || atoms.size() == before) return;
  }
}

Vec3 point_of(const std::vector<Atom>& atoms) {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (const Atom& a : atoms) sum += a.weight * a.at, weight += a.weight;
  return sum / weight;
}

}  // namespace

Box swept_box(const Body& body, const Box& positions) {
  const Vec3 radius = Vec3::Constant(body.radius);
  return {positions.min() - (radius - body.vertices.rowwise().minCoeff()),
          positions.max() + (body.vertices.rowwise().maxCoeff() + radius)};
}

Gap body_gap(const Body& body, const Vec3& p, const Vec3& h) {
  if (is_sphere(body)) {
    const double gap = sphere_gap(p + body.vertices.col(0), body.radius, h);
    return {gap, gap};
  }
  std::vector<Atom> atoms{{p + body.vertices.col(0), 1.0}};
  Vec3 x = atoms.front().at;
  double low = -1.0;
  for (int k = 0; k < kMaxSteps; ++k) {
    const double length = x.norm();
    if (length < kResolution) return {-kResolution - body.radius, -kResolution - body.radius};
    const Vec3 extreme = extreme_against(body.vertices, p, h, x);
    low = std::max(low, x.dot(extreme) / length);
    if (length - low < kResolution) break;
    atoms.push_back({extreme, 0.0});
    correct(atoms);
    x = point_of(atoms);
  }
  return {std::min(low, x.norm()) - body.radius, x.norm() - body.radius};
}

}  // namespace tern::audit
