#include "tools/audit/body_gap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tern::audit {
namespace {

constexpr double kResolution = 1e-6;  // m
constexpr int kMostSteps = 200;

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

/// The extreme point of (p + vertices) − box(h) against direction x.
Vec3 extreme_against(const Points& vertices, const Vec3& p, const Vec3& h, const Vec3& x) {
  Eigen::Index least = 0;
  (x.transpose() * vertices).minCoeff(&least);
  const Vec3 corner(x.x() > 0.0 ? h.x() : -h.x(), x.y() > 0.0 ? h.y() : -h.y(), x.z() > 0.0 ? h.z() : -h.z());
  return p + vertices.col(least) - corner;
}

/// Moves weight from the atom that lies farthest along x to `target`, as far as that shortens x.
void pairwise_step(std::vector<Atom>& atoms, Vec3& x, const Vec3& target) {
  const auto away = std::max_element(atoms.begin(), atoms.end(),
                                     [&](const Atom& a, const Atom& b) { return x.dot(a.at) < x.dot(b.at); });
  const Vec3 direction = target - away->at;
  const double length2 = direction.squaredNorm();
  if (length2 <= 0.0) return;
  const double step = std::min(away->weight, -x.dot(direction) / length2);
  x += step * direction;
  away->weight -= step;
  const auto known = std::find_if(atoms.begin(), atoms.end(), [&](const Atom& a) { return a.at == target; });
  if (known != atoms.end()) {
    known->weight += step;
  } else {
    atoms.push_back({target, step});
  }
  std::erase_if(atoms, [](const Atom& a) { return a.weight <= 0.0; });
}

}  // namespace

double body_support(const Body& body, const Vec3& n) {
  return (n.transpose() * body.vertices).maxCoeff() + body.radius;
}

Gap body_gap(const Body& body, const Vec3& p, const Vec3& h) {
  if (is_sphere(body)) {
    const double gap = sphere_gap(p + body.vertices.col(0), body.radius, h);
    return {gap, gap};
  }
  Vec3 x = p + body.vertices.col(0);
  std::vector<Atom> atoms{{x, 1.0}};
  double low = -1.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const double length = x.norm();
    if (length < kResolution) return {-kResolution - body.radius, -kResolution - body.radius};
    const Vec3 extreme = extreme_against(body.vertices, p, h, x);
    low = std::max(low, x.dot(extreme) / length);
    if (length - low < kResolution) break;
    pairwise_step(atoms, x, extreme);
  }
  return {std::min(low, x.norm()) - body.radius, x.norm() - body.radius};
}

}  // namespace tern::audit
