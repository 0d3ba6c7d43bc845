#include "estimator/filter/track_table.h"

#include <algorithm>

namespace tern {

int TrackTable::add(const FeatureFrame& frame, const Msckf& filter) {
  const std::int64_t number = filter.clones().back().number;
  const Eigen::Quaterniond q_BC(frame.q_BC[0], frame.q_BC[1], frame.q_BC[2], frame.q_BC[3]);
  rigs_[number] = {q_BC.normalized().toRotationMatrix(), frame.p_BC, frame.baseline_m, frame.sigma};
  const std::set<std::int64_t> slips = slipped(frame, filter);
  const bool most_slip = slips.size() > 1 && 2 * slips.size() > newest_.size();
  std::set<std::int64_t> refused;
  newest_.clear();
  for (const StereoFeature& feature : frame.features) {
    const bool slips_now = slips.contains(feature.id);
    if (refused_.contains(feature.id) || (slips_now && !most_slip)) {
      refused.insert(feature.id);
      continue;
    }
    if (slips_now) tracks_.erase(feature.id);
    newest_.insert_or_assign(feature.id, View{number, feature});
    tracks_[feature.id].push_back({number, feature});
  }
  refused_ = std::move(refused);
  return static_cast<int>(slips.size());
}

std::set<std::int64_t> TrackTable::slipped(const FeatureFrame& frame, const Msckf& filter) const {
  std::set<std::int64_t> slips;
  const auto& clones = filter.clones();
  if (clones.size() < 2) return slips;
  const std::size_t before = clones.size() - 2;
  for (const StereoFeature& feature : frame.features) {
    const auto last = newest_.find(feature.id);
    if (last == newest_.end() || last->second.number != clones[before].number) continue;
    const std::vector<View> pair = {last->second, {clones.back().number, feature}};
    if (!filter.agree(posed(feature.id, pair, clones, before).views)) slips.insert(feature.id);
  }
  return slips;
}

UsableFeature TrackTable::posed(std::int64_t id, const std::vector<View>& views, const std::vector<Clone>& clones,
                                std::size_t first) const {
  UsableFeature feature{id, {}};
  std::size_t at = first;
  for (const View& view : views) {
    while (clones[at].number < view.number) ++at;
    const Rig& rig = rigs_.at(view.number);
    feature.views.push_back({clones[at].R * rig.R_BC, clones[at].p + clones[at].R * rig.p_BC, rig.baseline, rig.sigma,
                             view.z, static_cast<int>(at)});
  }
  return feature;
}

std::vector<UsableFeature> TrackTable::take(const std::vector<Clone>& clones, std::size_t first, int most_clones,
                                            int limit) {
  const std::int64_t newest = clones.back().number;
  struct Ready {
    std::int64_t id;
    bool ended;
    std::size_t views;
  };
  std::vector<Ready> ready;
  for (const auto& [id, views] : tracks_) {
    const bool ended = views.back().number < newest;
    if (ended ? views.size() >= kLeastViews : views.size() >= idx(most_clones)) {
      ready.push_back({id, ended, views.size()});
    }
  }
  std::stable_sort(ready.begin(), ready.end(),
                   [](const Ready& a, const Ready& b) { return a.ended != b.ended ? a.ended : a.views > b.views; });
  if (ready.size() > idx(limit)) ready.resize(idx(limit));
  std::vector<UsableFeature> taken;
  for (const Ready& feature : ready) {
    taken.push_back(posed(feature.id, tracks_.at(feature.id), clones, first));
    tracks_.erase(feature.id);
  }
  std::erase_if(tracks_, [newest](const auto& track) { return track.second.back().number < newest; });
  return taken;
}

void TrackTable::forget(std::int64_t number) {
  for (auto& [id, views] : tracks_) {
    std::erase_if(views, [number](const View& view) { return view.number <= number; });
  }
  std::erase_if(tracks_, [](const auto& track) { return track.second.empty(); });
  std::erase_if(rigs_, [number](const auto& rig) { return rig.first <= number; });
}

}  // namespace tern
