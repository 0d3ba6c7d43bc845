#include "mavlink/vision_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tern::mavlink {
namespace {

/// Estimates may be older than the newest vision by the link's delay.
constexpr Duration kRemembered{1'000'000};

Duration magnitude(Duration d) { return d < Duration{} ? d * -1 : d; }

}  // namespace

void VisionCheck::sent(const UavState& vision) {
  if (!vision_.empty() && vision.at <= vision_.back().at) return;
  vision_.push_back(vision);
  while (vision.at - vision_.front().at > kRemembered) vision_.pop_front();
}

void VisionCheck::estimated(const UavState& estimate, int resets) {
  if (vision_.empty() || estimate.at <= newest_) return;
  auto pair = std::upper_bound(vision_.begin(), vision_.end(), estimate.at,
                               [](UTime at, const UavState& vision) { return at < vision.at; });
  if (pair != vision_.begin()) --pair;
  const Duration later = estimate.at - pair->at;
  if (magnitude(later) > kPairing) return;
  newest_ = estimate.at;
  const Vec3 apart = estimate.motion.p - pair->motion.p - later.seconds() * pair->motion.v;
  level_m_ = apart.head<2>().norm();
  up_m_ = apart.z();
  if (level_m_ <= bound_m_ && std::abs(up_m_) <= bound_m_) {
    since_.reset();
    resets_within_ = resets;
    was_reset_ = false;
    return;
  }
  if (!since_) since_ = newest_;
  was_reset_ = was_reset_ || resets != resets_within_;
}

std::string VisionCheck::fault() const {
  if (!since_ || (apart_for() < kApartFor && !was_reset_)) return {};
  return fmt::format(
      "the autopilot's estimate is {:.1f} m beside and {:.1f} m {} the external vision that it is sent, for {:.1f} s "
      "(mavlink.vision_apart_m is {:g})",
      level_m_, std::abs(up_m_), up_m_ >= 0.0 ? "above" : "below", apart_for().seconds(), bound_m_);
}

std::optional<UTime> VisionCheck::newest_vision() const {
  return vision_.empty() ? std::nullopt : std::optional(vision_.back().at);
}

}  // namespace tern::mavlink
