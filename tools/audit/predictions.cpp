// Whether reality stayed within the α that the predictor promised: per track, and per time ahead.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tools/audit/audit.h"
#include "tools/audit/cubic.h"
#include "tools/audit/flown.h"

namespace tern::audit {
namespace {

/// A true box may stand out by this, m: rounding.
constexpr double kTolerance = 1e-6;
/// A track whose id is no true obstacle's is that obstacle's whose centre is nearest, if within this, m.
constexpr double kSameThing = 2.0;
constexpr double kAhead[] = {0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.5};
/// Estimates are judged from so long after the flight's begin: the simulator sets everything in motion at once there,
/// which no estimate from before foresees.
constexpr Duration kStart{1'000'000};
/// Deviations of the achieved share that are left to chance.
constexpr double kDeviations = 3.0;
/// The errors of a track have nothing to do with each other after this, s: a filter's memory.
constexpr double kForgotten = 1.0;

/// The samples of a history within [from, to].
std::pair<std::size_t, std::size_t> within(const ObstacleHistory& history, UTime from, UTime to) {
  const auto& s = history.samples;
  const auto first = std::lower_bound(s.begin(), s.end(), from, [](const auto& a, UTime t) { return a.at < t; });
  const auto last = std::upper_bound(first, s.end(), to, [](UTime t, const auto& a) { return t < a.at; });
  return {static_cast<std::size_t>(first - s.begin()), static_cast<std::size_t>(last - s.begin())};
}

class CoverageCheck {
 public:
  CoverageCheck(const FlightRecord& record, Audit& audit, Check& check)
      : record_(record), audit_(audit), check_(check), window_(judged(record)) {
    for (std::size_t k = 0; k + 1 < std::size(kAhead); ++k) audit_.coverage.push_back({kAhead[k], kAhead[k + 1], 0, 0});
  }

  void set(const TrackSet& set) {
    if (set.made_at < window_.sure_from() || set.made_at > window_.sure_to() || record_.truth.empty()) return;
    audit_.promised_confidence = std::min(audit_.promised_confidence, set.confidence);
    for (const Track& track : set.tracks) take(set, track);
  }

  void judge() {
    for (auto& [id, t] : tracks_) audit_.tracks.push_back(t);
    if (!ghosts_.empty()) {
      check_.unchecked["tracks that no true obstacle is near to"] = static_cast<std::int64_t>(ghosts_.size());
    }
    judge_estimates();
  }

  [[nodiscard]] std::string summary() const {
    std::int64_t samples = 0, kept = 0;
    for (const Coverage& c : audit_.coverage) samples += c.samples, kept += c.kept;
    if (samples == 0) return "";
    return fmt::format(
        "{:.4f} of {} samples within their promise; {} of {} whole promises of {} tracks kept (confidence {})",
        static_cast<double>(kept) / static_cast<double>(samples), samples, promises_kept_, promises_, tracks_.size(),
        audit_.promised_confidence);
  }

 private:
  [[nodiscard]] const ObstacleHistory* truth_of(const Track& track, UTime at, std::int64_t& id) {
    const auto same = record_.truth.find(track.id);
    if (same != record_.truth.end()) {
      id = track.id;
      return &same->second;
    }
    const Vec3 p = motion_at(curves_of(track.motion), at).p;
    double nearest = kSameThing;
    const ObstacleHistory* found = nullptr;
    for (const auto& [other, history] : record_.truth) {
      const auto [first, last] = within(history, at - kTruthHole, at + kTruthHole);
      if (first == last) continue;
      const double distance = (history.samples[first].p - p).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = &history;
      id = other;
    }
    return found;
  }

  void take(const TrackSet& set, const Track& track) {
    const UTime from = std::max({track.motion.start, set.made_at, window_.sure_from()});
    const bool still = track.kind == TrackKind::Static;
    const UTime until =
        still ? set.made_at + Duration::from_seconds(kAhead[std::size(kAhead) - 1]) : track.motion.end();
    std::int64_t obstacle = kNobody;
    const ObstacleHistory* truth = truth_of(track, from, obstacle);
    if (truth == nullptr) {
      ghosts_.insert(track.id);
      return;
    }
    const auto [first, last] = within(*truth, from, std::min(until, window_.sure_to()));
    if (first == last) return;
    TrackCoverage& own = tracks_.try_emplace(track.id, TrackCoverage{track.id, obstacle, 0, 0, -1e9}).first->second;
    double worst = -1e9;
    UTime worst_at;
    follow(set, track, *truth, first, last, worst, worst_at);
    own.worst_m = std::max(own.worst_m, worst);
    const bool kept = worst <= kTolerance;
    const bool whole = truth->samples[last - 1].at + kTruthHole >= until;
    const bool promised = set.confidence >= 1.0 || track.kind == TrackKind::Declared;
    if (!promised && set.made_at >= window_.sure_from() + kStart) {
      ++estimates_;
      sets_.insert(set.made_at.us);
    }
    if (!kept && promised) broken(track, obstacle, worst, worst_at);
    if (promised) ++check_.checked;
    if (!whole && (kept || !promised)) return;  // what comes after the log could still break it
    ++own.sets;
    own.kept += kept ? 1 : 0;
    ++promises_;
    promises_kept_ += kept ? 1 : 0;
    if (promised || set.made_at < window_.sure_from() + kStart) return;
    whole_.add(kept);
    horizon_s_ = std::max(horizon_s_, (until - set.made_at).seconds());
  }

  /// The farthest that the true box stands out of its promise, over the samples [first, last).
  void follow(const TrackSet& set, const Track& track, const ObstacleHistory& truth, std::size_t first,
              std::size_t last, double& worst, UTime& worst_at) {
    std::size_t piece = 0;
    UTime piece_from = track.motion.start;
    for (std::size_t k = first; k < last; ++k) {
      const ObstacleHistory::Sample& s = truth.samples[k];
      while (piece + 1 < track.motion.pieces.size() && s.at > piece_from + track.motion.pieces[piece].duration) {
        piece_from = piece_from + track.motion.pieces[piece].duration;
        ++piece;
      }
      const PowerCubic& c = track.motion.pieces[piece].coefficients;
      const double t = track.kind == TrackKind::Static ? 0.0 : (s.at - piece_from).seconds();
      const Vec3 p = ((c.col(0) * t + c.col(1)) * t + c.col(2)) * t + c.col(3);
      const Vec3 promise = track.half_extents + track.alpha[piece];
      const double out = ((s.p - p).cwiseAbs() + s.half_extents - promise).maxCoeff();
      const bool estimated = set.confidence < 1.0 && track.kind != TrackKind::Declared;
      count(set, (s.at - set.made_at).seconds(), out <= kTolerance, estimated);
      if (out > worst) worst = out, worst_at = s.at;
    }
  }

  void count(const TrackSet& set, double ahead_s, bool kept, bool estimated) {
    for (std::size_t k = 0; k < audit_.coverage.size(); ++k) {
      Coverage& c = audit_.coverage[k];
      if (ahead_s < c.from_s || ahead_s >= c.to_s) continue;
      ++c.samples;
      c.kept += kept ? 1 : 0;
      if (!estimated || set.made_at < window_.sure_from() + kStart) continue;
      instants_[k].add(kept);
    }
  }

  /// A declared promise admits no exception. Each track is named once.
  void broken(const Track& track, std::int64_t obstacle, double worst, UTime at) {
    if (!named_.insert(track.id).second) {
      ++check_.broken;
      return;
    }
    check_.fail(
        {at, fmt::format("obstacle {} stood out of its declared motion by {:.4g} m", obstacle, worst), 0, obstacle});
  }

  struct Share {
    std::int64_t all = 0, kept = 0;
    void add(bool ok) { ++all, kept += ok ? 1 : 0; }
    [[nodiscard]] double value() const { return static_cast<double>(kept) / static_cast<double>(all); }
  };

  /// Estimates may fail as often as the confidence says, as whole promises and so also at each time ahead.
  void judge_estimates() {
    judge(whole_, "whole estimated promises held", horizon_s_);
    for (std::size_t k = 0; k < audit_.coverage.size(); ++k) {
      const Coverage& c = audit_.coverage[k];
      judge(instants_[k], fmt::format("estimates held {} to {} s ahead", c.from_s, c.to_s), c.to_s);
    }
  }

  /// Promises of one track overlap while they last and rest on the same detections for a while, so that about one per
  /// horizon is independent of the others, and at most one per kForgotten.
  void judge(const Share& share, const std::string& what, double horizon_s) {
    if (share.all == 0) return;
    ++check_.checked;
    const double c = audit_.promised_confidence;
    const double span_s = static_cast<double>(*sets_.rbegin() - *sets_.begin()) * 1e-6;
    const double at_once = static_cast<double>(estimates_) / static_cast<double>(sets_.size());
    const double independent = std::max(
        1.0, std::min(static_cast<double>(share.all), at_once * (1.0 + span_s / std::max(horizon_s, kForgotten))));
    const double least = c - kDeviations * std::sqrt(c * (1.0 - c) / independent);
    if (share.value() >= least) return;
    check_.fail({window_.sure_from(),
                 fmt::format("{:.4f} of the {}; {:.4f} promised, {:.4f} is what chance allows ({:.0f} deviations, "
                             "{:.0f} independent ones)",
                             share.value(), what, c, least, kDeviations, independent)});
  }

  const FlightRecord& record_;
  Audit& audit_;
  Check& check_;
  Window window_;
  std::map<std::int64_t, TrackCoverage> tracks_;
  std::set<std::int64_t> ghosts_, named_, sets_;
  std::int64_t promises_ = 0, promises_kept_ = 0, estimates_ = 0;
  Share whole_;
  std::array<Share, std::size(kAhead)> instants_;
  double horizon_s_ = 0.1;
};

}  // namespace

Check check_predictions(const FlightRecord& record, Audit& audit) {
  Check check{.name = "predictions", .claim = "what was real stayed within the alpha that was promised of it"};
  CoverageCheck coverage(record, audit, check);
  for (const auto& [name, set] : record.predictions) coverage.set(set);
  coverage.judge();
  check.summary = coverage.summary();
  std::int64_t samples = 0, kept = 0;
  for (const Coverage& c : audit.coverage) samples += c.samples, kept += c.kept;
  if (samples > 0)
    check.measures.insert(check.measures.begin(),
                          {"samples_kept_share", static_cast<double>(kept) / static_cast<double>(samples)});
  if (record.incomplete_predictions > 0)
    check.unchecked["prediction sets of which a batch is missing"] = record.incomplete_predictions;
  return check;
}

}  // namespace tern::audit
