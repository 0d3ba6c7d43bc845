// Whether reality stayed within the α that the predictor promised, and within the α at which plans say that they fly.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tools/audit/audit.h"
#include "tools/audit/covering.h"
#include "tools/audit/pairing.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

/// A static track is predicted without end; it is judged for this long.
constexpr Duration kForEver{4'500'000};

/// One judged prediction.
struct JudgedPrediction {
  UTime from, until;
  bool certain = false, complete = false;
  double worst = -1e9;  ///< how far the true box stood out of it, m
  UTime worst_at;
  std::array<std::array<bool, kLevels>, kHorizons> covered;
  std::array<double, kHorizons> half_m;
  std::array<bool, kHorizons> judged;
};

bool is_certain(const TrackSet& set, const Track& track) {
  return track.kind != TrackKind::Estimated || set.confidence >= 1.0;
}

UTime end_of(const TrackSet& set, const Track& track) {
  return track.kind == TrackKind::Static ? set.made_at + kForEver : track.motion.end();
}

Vec3 centre_at(const Track& track, UTime at) {
  return track.motion.pieces.size() == 1 && track.kind == TrackKind::Static
             ? Vec3(track.motion.pieces.front().coefficients.col(3))
             : motion_at(curves_of(track.motion), at).p;
}

std::size_t bin_of(double age_s) { return idx(std::lower_bound(kAges.begin(), kAges.end(), age_s) - kAges.begin()); }

class PredictionsCheck {
 public:
  PredictionsCheck(const FlightRecord& record, Audit& audit, Check& check)
      : record_(record), audit_(audit), check_(check), window_(judged_window(record)), pairing_(record) {}

  void take(const TrackSet& set) {
    if (set.made_at > window_.sure_to() || record_.truth.empty()) return;
    const std::vector<double> ages_s = ages(set);
    const auto& pairs = pairing_.pair(set);
    if (set.made_at < window_.sure_from()) return;
    audit_.promised_confidence = std::min(audit_.promised_confidence, set.confidence);
    for (std::size_t k = 0; k < set.tracks.size(); ++k) {
      const Track& track = set.tracks[k];
      const auto pair = pairs.find(track.id);
      if (pair == pairs.end()) {
        unpaired_.insert(track.id);
      } else {
        take(set, track, pair->second, ages_s[k]);
      }
    }
    pairs_.emplace(set.header.name, pairs);
  }

  void take(const Plan& plan, const HorizonRequest& request) {
    const auto set = record_.predictions.find(plan.inputs.predictions);
    const auto pairs = pairs_.find(plan.inputs.predictions);
    if (set == record_.predictions.end() || pairs == pairs_.end()) return;
    std::set<std::int64_t> with_plane;
    for (const CertificatePlane& plane : plan.certificate) with_plane.insert(plane.track);
    for (const Track& track : set->second.tracks) {
      const auto pair = pairs->second.find(track.id);
      if (pair == pairs->second.end() || !with_plane.contains(track.id)) continue;
      if (!is_certain(set->second, track)) claim(plan, request, set->second, track, pair->second.obstacle);
    }
  }

  void judge() {
    for (auto& [id, t] : tracks_) audit_.tracks.push_back(t);
    for (auto& [id, coverage] : by_obstacle_) {
      audit_.coverage += coverage;
      groups_.push_back(coverage);
    }
    audit_.coverage.confidence = audit_.promised_confidence;
    for (Coverage& group : groups_) group.confidence = audit_.promised_confidence;
    audit_.shares = coverage_shares(groups_);
    if (!unpaired_.empty()) {
      check_.unchecked["tracks without a true obstacle, or with one that another track is nearer to"] =
          static_cast<std::int64_t>(unpaired_.size());
    }
    judge_shares();
  }

  [[nodiscard]] std::string summary() const {
    if (predictions_ == 0) return "";
    return fmt::format("{} of {} predictions of {} tracks covered to their end (confidence {})", covered_, predictions_,
                       tracks_.size(), audit_.promised_confidence);
  }
  [[nodiscard]] std::int64_t count() const { return predictions_; }
  [[nodiscard]] std::int64_t covered() const { return covered_; }

 private:
  /// Returns how long each track has been in the sets, the time before the flight included, s.
  std::vector<double> ages(const TrackSet& set) {
    std::vector<double> ages_s;
    for (const Track& track : set.tracks) {
      const std::pair key{set.header.name.sender_epoch_us, track.id};
      auto [known, is_new] = seen_.try_emplace(key, Seen{set.made_at, set.made_at});
      if (set.made_at - known->second.last > kForgottenAfter) known->second.first = set.made_at;
      known->second.last = set.made_at;
      ages_s.push_back((set.made_at - known->second.first).seconds());
    }
    return ages_s;
  }

  void take(const TrackSet& set, const Track& track, const PairedObstacle& of, double age_s) {
    const JudgedPrediction prediction = judge(set, track, record_.truth.at(of.obstacle));
    if (prediction.worst == -1e9) return;
    TrackCoverage& own = tracks_.try_emplace(track.id, TrackCoverage{track.id, of.obstacle, 0, 0, -1e9}).first->second;
    own.worst_m = std::max(own.worst_m, prediction.worst);
    const bool covered = prediction.worst <= kOutTolerance;
    if (prediction.certain) ++check_.checked;
    if (prediction.certain && !covered) report_missed(track.id, of.obstacle, prediction);
    if (prediction.complete || (prediction.certain && !covered)) {
      ++own.sets, ++predictions_;
      own.covered += covered ? 1 : 0;
      covered_ += covered ? 1 : 0;
    }
    count(track, of, age_s, prediction);
  }

  static double own_excess(const Track& track, const RequiredAlpha& n, std::size_t level) {
    return (n.alpha - alpha_at(track, n.piece, level)).maxCoeff();
  }

  /// How far the true box stands out of the track's interval, m. Obstacles that are seen in parts may have several
  /// tracks: 0 if the intervals of all tracks cover it together.
  [[nodiscard]] double outside(const TrackSet& set, const Track& track, const RequiredAlpha& n,
                               std::size_t level) const {
    const double out = own_excess(track, n, level);
    const bool in_parts = !record_.sightings.empty() && track.kind == TrackKind::Estimated;
    if (out <= kOutTolerance || !in_parts) return out;
    return intervals_contain(set, n.at, level, n.box, kOutTolerance) ? 0.0 : out;
  }

  [[nodiscard]] JudgedPrediction judge(const TrackSet& set, const Track& track, const ObstacleHistory& truth) const {
    JudgedPrediction prediction;
    prediction.from = std::max({track.motion.start, set.made_at, window_.sure_from()});
    prediction.until = end_of(set, track);
    prediction.certain = is_certain(set, track);
    for (auto& levels : prediction.covered) levels.fill(true);
    const UTime seen = follow(
        track, truth, prediction.from, std::min(prediction.until, window_.sure_to()), [&](const RequiredAlpha& n) {
          const double ahead_s = (n.at - prediction.from).seconds();
          for (std::size_t level = 0; level < kLevels; ++level) {
            const bool is_missed = !prediction.covered[kToItsEnd][level];
            if (is_missed && level > 0) continue;  // nor are longer times
            const double out = is_missed ? own_excess(track, n, 0) : outside(set, track, n, level);
            if (level == 0 && out > prediction.worst) prediction.worst = out, prediction.worst_at = n.at;
            if (out <= kOutTolerance) continue;
            for (std::size_t h = 0; h < kHorizons; ++h) {
              if (h == kToItsEnd || ahead_s <= kCoverageHorizons[h]) prediction.covered[h][level] = false;
            }
          }
        });
    prediction.complete = seen >= prediction.until;
    for (std::size_t h = 0; h < kHorizons; ++h) {
      const UTime end =
          h == kToItsEnd ? prediction.until : prediction.from + Duration::from_seconds(kCoverageHorizons[h]);
      prediction.judged[h] = end <= prediction.until && seen >= end;
      prediction.half_m[h] = track.alpha[track.motion.locate(std::min(end, prediction.until)).index].mean();
    }
    return prediction;
  }

  [[nodiscard]] static PredictionClass class_of(const Track& track, const JudgedPrediction& prediction, bool in_view,
                                                double age_s) {
    if (prediction.certain) return PredictionClass::Declared;
    if (!in_view) return PredictionClass::Unseen;
    if (is_at_rest(track, prediction)) return PredictionClass::AtRest;
    return prediction_class(age_in_predictions(age_s));
  }

  [[nodiscard]] static bool is_at_rest(const Track& track, const JudgedPrediction& prediction) {
    const UTime later = std::min(prediction.from + Duration{1'000'000}, prediction.until);
    return (centre_at(track, later) - centre_at(track, prediction.from)).norm() <= kRestingWay;
  }

  void count(const Track& track, const PairedObstacle& of, double age_s, const JudgedPrediction& prediction) {
    const PredictionClass kind = class_of(track, prediction, of.in_view, age_s);
    Coverage& coverage = by_obstacle_[of.obstacle];
    for (std::size_t h = 0; h < kHorizons; ++h) {
      if (!prediction.judged[h]) continue;
      IntervalCount one{1, {}, prediction.half_m[h]};
      for (std::size_t level = 0; level < kLevels; ++level) one.covered[level] = prediction.covered[h][level] ? 1 : 0;
      coverage.intervals[{kind, h}] += one;
      if (prediction.certain || !of.in_view) continue;
      (kind == PredictionClass::AtRest ? audit_.rest_by_age : audit_.moving_by_age)[bin_of(age_s)][h] += one;
    }
  }

  /// Judges a claim. If the end of the flight cuts it off, it is judged up to there. It may then count as covered
  /// wrongly, but never as missed.
  void claim(const Plan& plan, const HorizonRequest& request, const TrackSet& set, const Track& track,
             std::int64_t obstacle) {
    const auto level = idx(plan.level);
    const UTime ends = std::max(plan.trajectory.end(), request.t_s) + plan.hold;
    const UTime until = std::min({ends, request.t_s + plan.sure_for, track.motion.end(), window_.sure_to()});
    if (request.t_s < track.motion.start || request.t_s > until) return;
    bool covered = true;
    const UTime seen = follow(track, record_.truth.at(obstacle), request.t_s, until, [&](const RequiredAlpha& n) {
      covered = covered && outside(set, track, n, level) <= kOutTolerance;
    });
    if (covered && seen < until) return;  ///< unknown
    by_obstacle_[obstacle].claims[level] += ClaimCount{1, covered ? 1 : 0};
  }

  /// Reports a declared motion that was left: it admits no exception. Each track is reported once.
  void report_missed(std::int64_t track, std::int64_t obstacle, const JudgedPrediction& prediction) {
    if (!named_.insert(track).second) {
      ++check_.broken;
      return;
    }
    check_.fail({prediction.worst_at,
                 fmt::format("{} left its declared motion by {:.4g} m", record_.name_of(obstacle), prediction.worst), 0,
                 obstacle});
  }

  /// Reports shares that are too low. Estimates may miss as often as their confidence allows. Per class and level, the
  /// horizon with the lowest bound is reported.
  void judge_shares() {
    std::map<std::pair<std::string, double>, const CoverageShare*> worst;
    for (const CoverageShare& share : audit_.shares) {
      if (share.what == to_string(PredictionClass::Declared)) continue;
      ++check_.checked;
      if (!share.is_refuted()) continue;
      const CoverageShare*& one = worst[{share.what, share.confidence}];
      if (one == nullptr || share.upper_bound < one->upper_bound) one = &share;
    }
    for (const auto& [key, share] : worst) {
      const std::string of = share->what == kPlans ? "claims of plans" : "predictions of class " + share->what;
      const std::string until = std::isdigit(share->horizon.front()) ? "for " + share->horizon + " s" : "to the end";
      check_.fail(
          {window_.sure_from(),
           fmt::format("{:.4f} of {} {} covered {}, of {} obstacles; {} was promised, at most {:.4f} is plausible",
                       share->share(), share->made, of, until, share->groups, share->confidence, share->upper_bound)});
    }
  }

  struct Seen {
    UTime first, last;
  };
  const FlightRecord& record_;
  Audit& audit_;
  Check& check_;
  Window window_;
  Pairing pairing_;
  std::map<std::pair<std::int64_t, std::int64_t>, Seen> seen_;
  std::map<std::int64_t, TrackCoverage> tracks_;
  std::map<std::int64_t, Coverage> by_obstacle_;
  std::map<MessageName, std::map<std::int64_t, PairedObstacle>> pairs_;
  std::vector<Coverage> groups_;
  std::set<std::int64_t> unpaired_, named_;
  std::int64_t predictions_ = 0, covered_ = 0;
};

}  // namespace

Check check_predictions(const FlightRecord& record, Audit& audit) {
  Check check{.name = "predictions",
              .claim = "every true box stayed within its prediction interval, as often as promised"};
  PredictionsCheck predictions(record, audit, check);
  for (const auto& [name, set] : record.predictions) predictions.take(set);
  std::int64_t without = 0;
  for (const Plan& plan : record.plans) {
    const HorizonRequest* request = record.request(plan.inputs.request);
    if (claims_confidence(plan)) {
      if (request != nullptr) predictions.take(plan, *request);
    } else if (plan.outcome != PlanOutcome::NoPlan) {
      ++without;
    }
  }
  if (without > 0) check.unchecked["plans without a confidence: relaxed, or certified for a part of alpha"] = without;
  predictions.judge();
  check.summary = predictions.summary();
  if (predictions.count() > 0) {
    check.measures = {
        {"promises", static_cast<double>(predictions.count())},
        {"promises_kept_share", static_cast<double>(predictions.covered()) / static_cast<double>(predictions.count())}};
  }
  if (record.incomplete_predictions > 0)
    check.unchecked["prediction sets with a missing batch"] = record.incomplete_predictions;
  return check;
}

}  // namespace tern::audit
