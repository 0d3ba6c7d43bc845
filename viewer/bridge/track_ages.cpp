#include "viewer/bridge/track_ages.h"

#include <algorithm>

namespace tern {

void TrackAges::receive(const TrackSet& complete_set) {
  const UTime now = complete_set.made_at;
  if (last_ && now <= *last_) return;
  for (const Track& track : complete_set.tracks) {
    std::vector<Period>& periods = periods_[track.id];
    if (last_ && !periods.empty() && periods.back().to == *last_) {
      periods.back().to = now;
    } else {
      periods.push_back({now, now});
      ++count_;
    }
  }
  last_ = now;
  if (count_ >= kMaxPeriods) forget_past();
}

void TrackAges::forget_past() {
  count_ = 0;
  for (auto& [id, periods] : periods_) {
    std::erase_if(periods, [this](const Period& period) { return period.to != *last_; });
    count_ += periods.size();
  }
  std::erase_if(periods_, [](const auto& entry) { return entry.second.empty(); });
}

std::optional<double> TrackAges::age_s(std::int64_t id, UTime at) const {
  const auto found = periods_.find(id);
  if (found == periods_.end()) return std::nullopt;
  const auto after = std::ranges::upper_bound(found->second, at, {}, &Period::from);
  if (after == found->second.begin() || std::prev(after)->to < at) return std::nullopt;
  return (at - std::prev(after)->from).seconds();
}

}  // namespace tern
