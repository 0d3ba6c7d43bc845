#include "tools/calibrate/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/base/random.h"

namespace tern::calibrate {
namespace {

constexpr double kCheckPeriod = 0.02;  // s, between the times at which an interval is checked
constexpr double kTolerance = 1e-6;    // m
constexpr int kDraws = 1000;
constexpr std::array<std::pair<double, const char*>, 5> kAges{std::pair{0.1, "age to 0.1 s"},
                                                              {0.3, "age to 0.3 s"},
                                                              {0.5, "age to 0.5 s"},
                                                              {1.0, "age to 1 s"},
                                                              {2.0, "age to 2 s"}};
constexpr std::array<std::pair<double, const char*>, 4> kLearning{
    std::pair{1.0, "flight to 1 s"}, {3.0, "flight to 3 s"}, {10.0, "flight to 10 s"}, {1e9, "flight above 10 s"}};

// "new", "young", "learnt", else with the age: "steady-old".
std::string class_name(TrackClass of) {
  const std::string name = to_string(of.motion);
  const bool has_margins_by_age = of.age >= TrackAge::Grown && of.motion != MotionKind::Learnt;
  return has_margins_by_age ? name + "-" + to_string(of.age) : name;
}

using Key = std::tuple<std::string, double, std::int64_t>;  // cell, time ahead, track

class CoverageCounter {
 public:
  CoverageCounter(const Recording& recording, const TrackerConfig& config)
      : recording_(recording), tracker_(config), confidence_(config.prediction.confidence) {}

  Study run() {
    Study result;
    result.confidence = confidence_;
    int sets = 0;
    for (const Received& received : recording_.observations) {
      tracker_.update(received.set);
      result.scored.insert(result.scored.end(), tracker_.scorer().finished().begin(),
                           tracker_.scorer().finished().end());
      if (++sets % kPredictEvery == 0) predict_and_compare(received.at);
    }
    for (const auto& [key, intervals] : intervals_) {
      const auto& [what, ahead_s, id] = key;
      if (result.cells.empty() || result.cells.back().what != what || result.cells.back().ahead_s != ahead_s) {
        result.cells.push_back({what, ahead_s, {}});
      }
      result.cells.back().tracks.push_back(intervals);
    }
    if (tracker_.scorer().speeds().max_axis_speed() < kSlowSpeed) result.scored_slow = result.scored;
    return result;
  }

 private:
  void predict_and_compare(UTime now) {
    const std::vector<Track> tracks = tracker_.predict(now);
    for (const Track& track : tracks) {
      const auto object =
          std::ranges::find_if(tracker_.objects(), [&](const TrackedObject& o) { return o.id == track.id; });
      const TruePath* truth = nearest(track.motion.sample(track.motion.start).p, track.motion.start);
      if (truth != nullptr) compare(track, *object, *truth);
    }
  }

  [[nodiscard]] const TruePath* nearest(const Vec3& p, UTime at) const {
    const TruePath* found = nullptr;
    double least = kMaxMatchDistance;
    for (const auto& [id, path] : recording_.truth) {
      const std::optional<Vec3> centre = path.at(at);
      if (!centre || (*centre - p).norm() >= least) continue;
      least = (*centre - p).norm();
      found = &path;
    }
    return found;
  }

  void compare(const Track& track, const TrackedObject& object, const TruePath& truth) {
    std::array<bool, kLevels> covered;
    covered.fill(true);
    std::size_t h = 0;
    for (int k = 0; h < kCoverageHorizons.size(); ++k) {
      const UTime at = track.motion.start + Duration::from_seconds(k * kCheckPeriod);
      const std::optional<Vec3> centre = truth.at(at);
      if (!centre || at > track.motion.end()) return;  // the later truth is unknown
      const std::size_t piece = track.motion.locate(at).index;
      const Vec3 needed = (*centre - track.motion.sample(at).p).cwiseAbs() + truth.half_extents - track.half_extents;
      std::array<double, kLevels> half;
      for (int level = 0; level < kLevels; ++level) {
        const auto l = idx(level);
        const Vec3 alpha = track.alpha_at(piece, level);
        covered[l] = covered[l] && (needed - alpha).maxCoeff() <= kTolerance;
        half[l] = alpha.mean();
      }
      if ((k + 1) * kCheckPeriod <= kCoverageHorizons[h] + 1e-9) continue;
      count(track, object, kCoverageHorizons[h++], covered, half);
    }
  }

  void count(const Track& track, const TrackedObject& object, double ahead_s, const std::array<bool, kLevels>& covered,
             const std::array<double, kLevels>& half) {
    for (const std::string& what : cells_of(track, object)) {
      TrackIntervals& intervals = intervals_[{what, ahead_s, track.id}];
      ++intervals.intervals;
      for (std::size_t level = 0; level < covered.size(); ++level) {
        intervals.covered[level] += covered[level] ? 1 : 0;
        intervals.half_width_sum[level] += half[level];
      }
    }
  }

  [[nodiscard]] std::vector<std::string> cells_of(const Track& track, const TrackedObject& object) const {
    if (tracker_.is_stationary(object)) return {"class rest"};
    const auto until = [](const auto& table, double s) {
      return std::ranges::find_if(table, [&](const auto& a) { return s <= a.first; });
    };
    const auto age = until(kAges, (object.last_seen - object.born).seconds());
    const auto learning = until(kLearning, (track.motion.start - recording_.observations.front().set.at).seconds());
    return {"all moving", "class " + class_name(tracker_.assessment(object).of),
            age == kAges.end() ? "age above 2 s" : age->second, learning->second};
  }

  const Recording& recording_;
  Tracker tracker_;
  double confidence_;
  std::map<Key, TrackIntervals> intervals_;
};

}  // namespace

CellCoverage cell_coverage(const CoverageCell& cell, int level) {
  const auto l = idx(level);
  CellCoverage result;
  result.tracks = static_cast<int>(cell.tracks.size());
  double covered = 0.0, half = 0.0;
  for (const TrackIntervals& track : cell.tracks) {
    result.intervals += track.intervals;
    covered += track.covered[l];
    half += track.half_width_sum[l];
  }
  result.share = covered / result.intervals;
  result.mean_half_width = half / result.intervals;
  Rng rng(1);
  std::vector<double> shares;
  for (int draw = 0; draw < kDraws; ++draw) {
    double all = 0.0, of_them = 0.0;
    for (std::size_t i = 0; i < cell.tracks.size(); ++i) {
      const auto at = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(cell.tracks.size())));
      all += cell.tracks[at].intervals;
      of_them += cell.tracks[at].covered[l];
    }
    shares.push_back(of_them / all);
  }
  std::ranges::sort(shares);
  result.low = shares[kDraws / 40];
  result.high = shares[kDraws - 1 - kDraws / 40];
  return result;
}

Study study(const Recording& recording, const TrackerConfig& config) {
  return CoverageCounter(recording, config).run();
}

std::string coverage_table(const Study& study) {
  std::string text = "what,ahead_s,confidence,promises,tracks,kept,kept_low,kept_high,half_m\n";
  for (const CoverageCell& cell : study.cells) {
    for (int level = 0; level < kLevels; ++level) {
      const CellCoverage c = cell_coverage(cell, level);
      text += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.3f}\n", cell.what, cell.ahead_s,
                          confidence_at(study.confidence, level), c.intervals, c.tracks, c.share, c.low, c.high,
                          c.mean_half_width);
    }
  }
  return text;
}

void add(Study& sum, const Study& other) {
  sum.scored.insert(sum.scored.end(), other.scored.begin(), other.scored.end());
  sum.scored_slow.insert(sum.scored_slow.end(), other.scored_slow.begin(), other.scored_slow.end());
  for (const CoverageCell& cell : other.cells) {
    const auto same = std::ranges::find_if(
        sum.cells, [&](const CoverageCell& c) { return c.what == cell.what && c.ahead_s == cell.ahead_s; });
    if (same == sum.cells.end()) {
      sum.cells.push_back(cell);
    } else {
      same->tracks.insert(same->tracks.end(), cell.tracks.begin(), cell.tracks.end());
    }
  }
}

}  // namespace tern::calibrate
