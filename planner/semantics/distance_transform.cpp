#include "planner/semantics/distance_transform.h"

#include <algorithm>
#include <limits>

namespace tern {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The lower envelope of the parabolas (q − k)² + f[k], sampled at 0 … n − 1.
class Envelope {
 public:
  explicit Envelope(int longest) : f_(static_cast<std::size_t>(longest)), vertex_(f_.size()), from_(f_.size() + 1) {}

  /// Transforms the line of n values that begins at `line`, `stride` apart, in place.
  void transform(float* line, std::ptrdiff_t stride, int n) {
    int last = -1;
    for (int q = 0; q < n; ++q) {
      f_[idx(q)] = line[q * stride];
      if (f_[idx(q)] < kInfinity) last = push(q, last);
    }
    if (last < 0) return;
    for (int q = 0, k = 0; q < n; ++q) {
      while (k < last && from_[idx(k + 1)] <= q) ++k;
      const int v = vertex_[idx(k)];
      line[q * stride] = static_cast<float>(static_cast<double>(q - v) * (q - v) + f_[idx(v)]);
    }
  }

 private:
  int push(int q, int last) {
    const double height = static_cast<double>(f_[idx(q)]) + static_cast<double>(q) * q;
    double s = -std::numeric_limits<double>::infinity();
    while (last >= 0) {
      const int v = vertex_[idx(last)];
      s = (height - (static_cast<double>(f_[idx(v)]) + static_cast<double>(v) * v)) / (2.0 * (q - v));
      if (s > from_[idx(last)]) break;
      --last;
    }
    ++last;
    vertex_[idx(last)] = q;
    from_[idx(last)] = last == 0 ? -std::numeric_limits<double>::infinity() : s;
    return last;
  }

  std::vector<float> f_;
  std::vector<int> vertex_;
  std::vector<double> from_;  ///< from_[k]: the k-th parabola is lowest from here to from_[k + 1]
};

}  // namespace

std::vector<float> squared_distance_transform(const std::vector<std::uint8_t>& set, const Eigen::Vector3i& size) {
  std::vector<float> d(set.size());
  std::transform(set.begin(), set.end(), d.begin(), [](std::uint8_t s) { return s != 0 ? 0.0f : kInfinity; });
  if (d.empty()) return d;
  Envelope envelope(size.maxCoeff());
  const std::ptrdiff_t nx = size.x();
  const std::ptrdiff_t layer = nx * size.y();
  for (int z = 0; z < size.z(); ++z) {
    for (int y = 0; y < size.y(); ++y) envelope.transform(d.data() + z * layer + y * nx, 1, size.x());
    for (int x = 0; x < size.x(); ++x) envelope.transform(d.data() + z * layer + x, nx, size.y());
  }
  for (std::ptrdiff_t xy = 0; xy < layer; ++xy) envelope.transform(d.data() + xy, layer, size.z());
  return d;
}

}  // namespace tern
