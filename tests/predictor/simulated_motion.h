// Motions and sensors for the predictor's tests.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/random.h"
#include "core/world/observation.h"
#include "core/world/track.h"

namespace tern::testing {

/// Position (W, m) by time since zero, s.
using Path = std::function<Vec3(double)>;

inline UTime at_seconds(double t) { return UTime{} + Duration::from_seconds(t); }

/// A path of white-noise acceleration of spectral density sigma² per axis, exact at multiples of `step`, linear
/// between.
inline Path random_path(Rng& rng, const Vec3& start, const Vec3& velocity, double sigma, double duration,
                        double step = 1.0 / 120) {
  std::vector<Vec3> points{start};
  Vec3 p = start, v = velocity;
  for (double t = 0.0; t < duration; t += step) {
    for (int axis = 0; axis < 3; ++axis) {
      // (dx, dv) of covariance q [step³/3 step²/2; step²/2 step] by its Cholesky factor.
      const double a = rng.normal(), b = rng.normal();
      const double dv = sigma * std::sqrt(step) * a;
      p[axis] += v[axis] * step + 0.5 * step * dv + sigma * std::sqrt(step * step * step / 12.0) * b;
      v[axis] += dv;
    }
    points.push_back(p);
  }
  return [points, step](double t) -> Vec3 {
    const double s = std::max(0.0, std::min(t / step, static_cast<double>(points.size() - 1) - 1e-9));
    const auto i = static_cast<std::size_t>(s);
    const double u = s - static_cast<double>(i);
    return (1.0 - u) * points[i] + u * points[i + 1];
  };
}

/// BENCHMARKS' trefoil.
inline Path trefoil(const Vec3& c, const Vec3& k, double s, double phase) {
  return [=](double t) -> Vec3 {
    const double w = t / s;
    return c + Vec3(k.x() * (std::sin(w + phase) + 2.0 * std::sin(2.0 * w + phase)),
                    k.y() * (std::cos(w + phase) - 2.0 * std::cos(2.0 * w + phase)),
                    -k.z() * std::sin(3.0 * w + phase));
  };
}

inline Detection detection_of(const Vec3& p, double sigma, Rng& rng, std::int64_t id = kNoTrackId) {
  Detection detection;
  for (int axis = 0; axis < 3; ++axis) detection.position[axis] = p[axis] + sigma * rng.normal();
  detection.half_extents = Vec3::Constant(0.4);
  detection.variance = Vec3::Constant(sigma * sigma);
  detection.track_id = id;
  return detection;
}

inline ObservationSet observations_at(double t, std::vector<Detection> detections) {
  ObservationSet set;
  set.at = at_seconds(t);
  set.detections = std::move(detections);
  return set;
}

/// True if the interval covers up to `horizon` seconds after its start, checked every 10 ms.
inline bool covers(const Track& track, const Path& truth, double horizon) {
  for (double t = 0.0; t <= horizon; t += 0.01) {
    const UTime now = track.motion.start + Duration::from_seconds(t);
    const PiecewiseCubic::Located piece = track.motion.locate(now);
    const Vec3 error = truth((now - UTime{}).seconds()) - track.motion.sample(now).p;
    if ((error.cwiseAbs().array() > track.alpha[piece.index].array()).any()) return false;
  }
  return true;
}

/// Ends of the Wilson 95 % interval of a rate.
struct Wilson {
  double low = 0.0, high = 1.0;
};
inline Wilson wilson(int hits, int trials) {
  const double z = 1.959964, n = trials, p = hits / n;
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {centre - half, centre + half};
}

}  // namespace tern::testing
