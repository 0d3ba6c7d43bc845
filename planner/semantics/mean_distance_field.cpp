#include "planner/semantics/mean_distance_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/semantics/trilinear.h"

namespace tern {
namespace {

constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kPi = 3.14159265358979323846;

/// Returns the least spacing ≥ options.spacing for which the domain has at most max_nodes.
double affordable_spacing(const Vec3& extent, const MeanDistanceOptions& options) {
  double h = options.spacing;
  const auto nodes = [&] { return ((extent / h).array().ceil() + 1.0).prod(); };
  while (nodes() > static_cast<double>(options.max_nodes)) h *= 1.05;
  return h;
}

}  // namespace

MeanDistanceField::MeanDistanceField(VoxelTree tree, double resolution, const Box& domain,
                                     const MeanDistanceOptions& options)
    : tree_(std::move(tree)), domain_(domain), far_error_(options.far_error) {
  spacing_ = affordable_spacing(domain.sizes(), options);
  inverse_spacing_ = 1.0 / spacing_;
  for (int i = 0; i < 3; ++i) size_[i] = static_cast<int>(std::ceil(domain.sizes()[i] * inverse_spacing_)) + 1;
  size_ = size_.cwiseMax(2);
  value_.reserve(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y() * size_.z()));
  double largest = 0.0;
  for (int z = 0; z < size_.z(); ++z) {
    for (int y = 0; y < size_.y(); ++y) {
      for (int x = 0; x < size_.x(); ++x) {
        const double f = tree_.mean_distance(domain.min() + spacing_ * Vec3(x, y, z), options.node_error);
        largest = std::max(largest, f);
        value_.push_back(static_cast<float>(f));
      }
    }
  }
  error_ = options.node_error + 1e-6 * largest + interpolation_error(resolution);
}

double MeanDistanceField::interpolation_error(double resolution) const {
  const double h = spacing_;
  const auto worst_at = [&](double distance) {
    const double lipschitz = 0.5 * kSqrt3 * h;
    const double gap = distance - kSqrt3 * h;
    return gap > 0.0 ? std::min(lipschitz, 0.375 * h * h / gap) : lipschitz;
  };
  // The densest arrangement: at most as many voxels lie within δ of p as cubes fit into the ball of radius δ + half a
  // diagonal.
  const auto n = static_cast<double>(tree_.voxels());
  const auto within = [&](double distance) {
    const double cubes = distance / resolution + 0.5 * kSqrt3;
    return std::min(n, 4.0 / 3.0 * kPi * cubes * cubes * cubes);
  };
  double sum = 0.0;
  double counted = 0.0;
  for (double d = 0.0; counted < n; d += 0.1 * resolution) {
    const double more = within(d + 0.1 * resolution);
    sum += (more - counted) * worst_at(d);
    counted = more;
  }
  return sum / n;
}

double MeanDistanceField::operator()(const Vec3& p) const {
  if (!domain_.contains(p)) return tree_.mean_distance(p, far_error_);
  return trilinear(value_, size_, (p - domain_.min()) * inverse_spacing_);
}

}  // namespace tern
