#include "predictor/faces/face_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "predictor/faces/open_ends.h"

namespace tern {
namespace {

constexpr std::array<double, 2> kOutwards{-1.0, 1.0};
// A reach is never known better than this, m: the boxes of real things are not quite axis-aligned.
constexpr double kLeastSigma = 0.005;
constexpr int kMostMeasurements = 100;
// Errors of an end that are no mismatch, in standard deviations.
constexpr double kMismatchSigmas = 3.0;
// A place is known to the edge of a box no better than this, m.
constexpr double kEndError = 0.1;

struct AxisSight {
  std::array<double, 2> bounds, sigmas;
  std::array<BoundSight, 2> sights;
};

AxisSight sight_of(const Sighting& sighting, int axis) {
  return {{sighting.lower[axis], sighting.upper[axis]},
          {std::max(sighting.lower_sigma[axis], kLeastSigma), std::max(sighting.upper_sigma[axis], kLeastSigma)},
          {sighting.bounds[idx(2 * axis)], sighting.bounds[idx(2 * axis + 1)]}};
}

double tolerance(double variance) { return kSizeTolerance + 3.0 * std::sqrt(variance); }

}  // namespace

Sighting without_false_ends(Sighting sighting) {
  const bool is_partial = std::ranges::any_of(
      sighting.bounds, [](BoundSight sight) { return !is_end(sight) && sight != BoundSight::Unseen; });
  if (!is_partial || sighting.points >= kSliverPoints) return sighting;
  for (BoundSight& sight : sighting.bounds) sight = is_end(sight) ? BoundSight::Occluded : sight;
  return sighting;
}

FaceBox::FaceBox(const Sighting& sighting, Vec3& anchor) {
  anchor = 0.5 * (sighting.lower + sighting.upper);
  learn(anchor, sighting);
}

bool FaceBox::has_position(int axis) const {
  return axes_[idx(axis)][kLowerFace].measured > 0 || axes_[idx(axis)][kUpperFace].measured > 0;
}

double FaceBox::mismatch(const Vec3& anchor, const Sighting& sighting, double unknown) const {
  double worst = 0.0;
  bool is_compared = false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [bounds, sigmas, sights] = sight_of(sighting, axis);
    for (std::size_t side = 0; side < 2; ++side) {
      const FaceReach& face = axes_[idx(axis)][side];
      if (face.measured == 0) continue;
      const double beyond = kOutwards[side] * (bounds[side] - anchor[axis]) - face.reach;
      is_compared = is_compared || is_end(sights[side]);
      const double error = kMismatchSigmas * std::hypot(sigmas[side], face.sigma);
      worst = std::max(worst, is_end(sights[side]) ? std::abs(beyond) - error : beyond);
    }
  }
  return is_compared ? worst : std::max(worst, unknown);
}

AnchorMeasurement FaceBox::measure(const Vec3& anchor, const Sighting& sighting) const {
  AnchorMeasurement measured;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [bounds, sigmas, sights] = sight_of(sighting, axis);
    std::array<double, 2> z{}, r{};
    std::array<bool, 2> has{};
    for (std::size_t side = 0; side < 2; ++side) {
      const FaceReach& face = axes_[idx(axis)][side];
      has[side] = is_end(sights[side]) && face.measured > 0;
      z[side] = bounds[side] - kOutwards[side] * face.reach;
      r[side] = sigmas[side] * sigmas[side] + face.sigma * face.sigma;
    }
    if (has[0] && has[1] && std::abs(z[0] - z[1]) > tolerance(r[0] + r[1])) {
      const bool is_upper_nearer = std::abs(z[1] - anchor[axis]) < std::abs(z[0] - anchor[axis]);
      has[is_upper_nearer ? 0 : 1] = false;
    }
    const double weight = (has[0] ? 1.0 / r[0] : 0.0) + (has[1] ? 1.0 / r[1] : 0.0);
    measured.has[idx(axis)] = weight > 0.0;
    if (weight == 0.0) continue;
    measured.position[axis] = ((has[0] ? z[0] / r[0] : 0.0) + (has[1] ? z[1] / r[1] : 0.0)) / weight;
    measured.variance[axis] = 1.0 / weight;
  }
  return measured;
}

bool FaceBox::is_located_by(const Sighting& sighting) const {
  for (std::size_t b = 0; b < sighting.bounds.size(); ++b) {
    if (is_end(sighting.bounds[b]) && axes_[b / 2][b % 2].measured > 0) return true;
  }
  return false;
}

void FaceBox::learn_axis(Axis& axis, double anchor, const std::array<double, 2>& bounds,
                         const std::array<double, 2>& sigmas, const std::array<BoundSight, 2>& sights) const {
  const bool both_ends = is_end(sights[0]) && is_end(sights[1]);
  const double size = bounds[1] - bounds[0];
  if (both_ends && axis[0].measured > 0 && axis[1].measured > 0) {
    const double variance = sigmas[0] * sigmas[0] + sigmas[1] * sigmas[1];
    const double known = axis[0].sigma * axis[0].sigma + axis[1].sigma * axis[1].sigma;
    const double longer = size - axis[0].reach - axis[1].reach;
    const int times = std::min(axis[0].measured, axis[1].measured);
    const bool disagrees = std::abs(longer) > tolerance(variance + known);
    const bool is_taken_at_once = disagrees && longer > 0.0 && times < kSureSize;
    const double by_errors = known > variance ? known / (known + variance) : 0.0;
    const double follow = std::max({kSizeFollows, 1.0 / (times + 1.0), by_errors});
    // The less certain face gives way. A size that disagrees belongs to the face that lies farther from its prediction.
    std::array<double, 2> share{0.5, 0.5};
    if (by_errors > 0.0) share = {axis[0].sigma * axis[0].sigma / known, axis[1].sigma * axis[1].sigma / known};
    if (disagrees) {
      const double of_lower = std::abs(anchor - bounds[0] - axis[0].reach);
      const double of_upper = std::abs(bounds[1] - anchor - axis[1].reach);
      share = of_lower > of_upper ? std::array{1.0, 0.0} : std::array{0.0, 1.0};
    }
    for (std::size_t side = 0; side < 2; ++side) {
      FaceReach& face = axis[side];
      face.reach += share[side] * longer * (is_taken_at_once ? 1.0 : follow);
      face.measured = std::min(face.measured + 1, kMostMeasurements);
      face.sigma = std::max(kLeastSigma, std::min(face.sigma, sigmas[side] / std::sqrt(face.measured)));
    }
    return;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    FaceReach& face = axis[side];
    const FaceReach& other = axis[1 - side];
    if (face.measured > 0) continue;
    const double seen = kOutwards[side] * (bounds[side] - anchor);
    if (!is_end(sights[side])) {
      face.reach = std::max(face.reach, seen);
      if (face.limit < face.reach) face.limit = std::numeric_limits<double>::infinity();  // it was wrong
      continue;
    }
    // The first face of an axis defines where the anchor is; the second one lies at a measured distance from it.
    const bool is_second = both_ends && other.measured > 0;
    face.reach = is_second ? size - other.reach : seen;
    face.sigma = is_second ? std::hypot(sigmas[0], sigmas[1]) : kLeastSigma;
    face.measured = 1;
  }
}

void FaceBox::learn(const Vec3& anchor, const Sighting& sighting, const std::array<bool, 3>& axes) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!axes[idx(axis)]) continue;
    const auto [bounds, sigmas, sights] = sight_of(sighting, axis);
    learn_axis(axes_[idx(axis)], anchor[axis], bounds, sigmas, sights);
    const bool is_flat = sights[0] == BoundSight::Unseen || sights[1] == BoundSight::Unseen;
    has_depth_[idx(axis)] = has_depth_[idx(axis)] || !is_flat;
  }
}

void FaceBox::relearn(int axis, const Vec3& anchor, const Sighting& sighting) {
  const auto [bounds, sigmas, sights] = sight_of(sighting, axis);
  axes_[idx(axis)] = {};
  learn_axis(axes_[idx(axis)], anchor[axis], bounds, sigmas, sights);
}

double FaceBox::least_size(int axis) const {
  double of_ends = std::numeric_limits<double>::infinity(), of_seen = of_ends;
  for (int other = 0; other < 3; ++other) {
    if (other == axis) continue;
    const Axis& faces = axes_[idx(other)];
    const double size = faces[0].reach + faces[1].reach;
    if (faces[0].measured > 0 && faces[1].measured > 0) of_ends = std::min(of_ends, size);
    if (has_depth_[idx(other)]) of_seen = std::min(of_seen, size);
  }
  const double least = std::isfinite(of_ends) ? of_ends : of_seen;
  return std::isfinite(least) ? least : 0.0;
}

Box FaceBox::completed(const Vec3& anchor, double sigmas) const {
  Vec3 lower, upper;
  for (int axis = 0; axis < 3; ++axis) {
    Axis faces = axes_[idx(axis)];
    const bool is_known[2] = {faces[0].measured > 0, faces[1].measured > 0};
    const double missing = least_size(axis) - faces[0].reach - faces[1].reach;
    const double open = (is_known[0] ? 0.0 : 1.0) + (is_known[1] ? 0.0 : 1.0);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!is_known[side]) faces[side].reach += std::max(0.0, missing) / open;
      faces[side].reach += sigmas * faces[side].sigma;
    }
    lower[axis] = anchor[axis] - faces[0].reach;
    upper[axis] = std::max(lower[axis], anchor[axis] + faces[1].reach);
  }
  return {lower, upper};
}

KnownSizes FaceBox::known_sizes() const {
  KnownSizes known;
  for (int axis = 0; axis < 3; ++axis) {
    const Axis& faces = axes_[idx(axis)];
    known.sizes[axis] = faces[0].reach + faces[1].reach;
    known.is_whole[idx(axis)] = faces[0].measured > 0 && faces[1].measured > 0;
  }
  return known;
}

std::optional<Vec3> FaceBox::measured_sizes() const {
  for (const Axis& faces : axes_) {
    if (std::min(faces[0].measured, faces[1].measured) < kMeasuredToRecord) return std::nullopt;
  }
  return known_sizes().sizes;
}

Box FaceBox::whole(const Vec3& anchor, double sigmas, const SizeRecord& record) const {
  const Box least = completed(anchor, sigmas);
  const KnownSizes known = known_sizes();
  Vec3 lower = least.min(), upper = least.max();
  for (int axis = 0; axis < 3; ++axis) {
    if (known.is_whole[idx(axis)]) continue;
    const std::optional<double> longest = record.longest(axis, known);
    const Axis& faces = axes_[idx(axis)];
    for (std::size_t side = 0; side < 2; ++side) {
      if (faces[side].measured > 0) continue;
      const double farthest =
          longest ? *longest + kSizeTolerance - faces[1 - side].reach : faces[side].reach + kUnseenRest;
      const double reach = std::max(faces[side].reach, std::min(farthest, faces[side].limit));
      if (side == kLowerFace) {
        lower[axis] = anchor[axis] - reach;
      } else {
        upper[axis] = anchor[axis] + reach;
      }
    }
  }
  return {lower, lower.cwiseMax(upper)};
}

void FaceBox::limit_hidden_ends(const SensorView& view, const Vec3& anchor, double error) {
  Box seen;
  for (int axis = 0; axis < 3; ++axis) {
    seen.min()[axis] = anchor[axis] - axes_[idx(axis)][kLowerFace].reach;
    seen.max()[axis] = anchor[axis] + axes_[idx(axis)][kUpperFace].reach;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      FaceReach& face = axes_[idx(axis)][side];
      if (face.measured > 0) continue;
      const double farthest = std::min(kFarthestEnd, face.limit - face.reach);
      const int outwards = side == kLowerFace ? -1 : 1;
      const double beyond = seen_empty_beyond(view, seen, axis, outwards, farthest, kEndError + 2.0 * error);
      if (beyond < farthest) face.limit = face.reach + beyond;
    }
  }
}

}  // namespace tern
