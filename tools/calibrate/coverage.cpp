#include "tools/calibrate/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/base/random.h"

namespace tern::calibrate {
namespace {

constexpr double kStep = 0.02;       // s, between the times at which a promise is looked at
constexpr double kTolerance = 1e-6;  // m
constexpr int kDraws = 1000;
constexpr std::array<const char*, kTrackClasses> kClassNames{
    "new", "young", "steady-grown", "steady-old", "calm-grown", "calm-old", "lively-grown", "lively-old", "learnt"};
constexpr std::array<std::pair<double, const char*>, 5> kAges{std::pair{0.1, "age to 0.1 s"},
                                                              {0.3, "age to 0.3 s"},
                                                              {0.5, "age to 0.5 s"},
                                                              {1.0, "age to 1 s"},
                                                              {2.0, "age to 2 s"}};
constexpr std::array<std::pair<double, const char*>, 4> kLearning{
    std::pair{1.0, "flight to 1 s"}, {3.0, "flight to 3 s"}, {10.0, "flight to 10 s"}, {1e9, "flight above 10 s"}};

using Key = std::tuple<std::string, double, std::int64_t>;  // what, time ahead, track

class Watch {
 public:
  Watch(const Recording& recording, const TrackerConfig& config)
      : recording_(recording), tracker_(config), confidence_(config.prediction.confidence) {}

  Study run() {
    Study result;
    result.confidence = confidence_;
    int sets = 0;
    for (const Received& received : recording_.observations) {
      tracker_.update(received.set);
      result.judged.insert(result.judged.end(), tracker_.judge().judged().begin(), tracker_.judge().judged().end());
      if (++sets % kEvery == 0) look(received.at);
    }
    for (const auto& [key, promises] : promises_) {
      const auto& [what, ahead_s, id] = key;
      if (result.cells.empty() || result.cells.back().what != what || result.cells.back().ahead_s != ahead_s) {
        result.cells.push_back({what, ahead_s, {}});
      }
      result.cells.back().tracks.push_back(promises);
    }
    if (tracker_.judge().fastest() < kSlowSpeed) result.slow = result.judged;
    return result;
  }

 private:
  void look(UTime now) {
    const std::vector<Track> tracks = tracker_.predict(now);
    for (const Track& track : tracks) {
      const auto object =
          std::ranges::find_if(tracker_.objects(), [&](const TrackedObject& o) { return o.id == track.id; });
      const TruePath* truth = nearest(track.motion.sample(track.motion.start).p, track.motion.start);
      if (truth != nullptr) judge(track, *object, *truth);
    }
  }

  [[nodiscard]] const TruePath* nearest(const Vec3& p, UTime at) const {
    const TruePath* found = nullptr;
    double least = kSameThing;
    for (const auto& [id, path] : recording_.truth) {
      const std::optional<Vec3> centre = path.at(at);
      if (!centre || (*centre - p).norm() >= least) continue;
      least = (*centre - p).norm();
      found = &path;
    }
    return found;
  }

  void judge(const Track& track, const TrackedObject& object, const TruePath& truth) {
    std::array<bool, kLevels> kept;
    kept.fill(true);
    std::size_t h = 0;
    for (int k = 0; h < kCoveredAhead.size(); ++k) {
      const UTime at = track.motion.start + Duration::from_seconds(k * kStep);
      const std::optional<Vec3> centre = truth.at(at);
      if (!centre || at > track.motion.end()) return;  // what comes later nobody knows
      const std::size_t piece = track.motion.locate(at).index;
      const Vec3 needed = (*centre - track.motion.sample(at).p).cwiseAbs() + truth.half_extents - track.half_extents;
      std::array<double, kLevels> half;
      for (int level = 0; level < kLevels; ++level) {
        const auto l = idx(level);
        const Vec3 alpha = track.share_at(piece, level) * track.alpha[piece];
        kept[l] = kept[l] && (needed - alpha).maxCoeff() <= kTolerance;
        half[l] = alpha.mean();
      }
      if ((k + 1) * kStep <= kCoveredAhead[h] + 1e-9) continue;
      count(track, object, kCoveredAhead[h++], kept, half);
    }
  }

  void count(const Track& track, const TrackedObject& object, double ahead_s, const std::array<bool, kLevels>& kept,
             const std::array<double, kLevels>& half) {
    for (const std::string& what : cells_of(track, object)) {
      TrackPromises& promises = promises_[{what, ahead_s, track.id}];
      ++promises.promises;
      for (std::size_t level = 0; level < kept.size(); ++level) {
        promises.kept[level] += kept[level] ? 1 : 0;
        promises.half_sum[level] += half[level];
      }
    }
  }

  [[nodiscard]] std::vector<std::string> cells_of(const Track& track, const TrackedObject& object) const {
    if (tracker_.rests(object)) return {"class rest"};
    const auto until = [](const auto& table, double s) {
      return std::ranges::find_if(table, [&](const auto& a) { return s <= a.first; });
    };
    const auto age = until(kAges, (object.last_seen - object.born).seconds());
    const auto learning = until(kLearning, (track.motion.start - recording_.observations.front().set.at).seconds());
    const auto kind = idx(tracker_.verdict(object).kind);
    return {"all moving", std::string("class ") + kClassNames[kind], age == kAges.end() ? "age above 2 s" : age->second,
            learning->second};
  }

  const Recording& recording_;
  Tracker tracker_;
  double confidence_;
  std::map<Key, TrackPromises> promises_;
};

}  // namespace

Covered covered(const CoverageCell& cell, int level) {
  const auto l = idx(level);
  Covered result;
  result.tracks = static_cast<int>(cell.tracks.size());
  double kept = 0.0, half = 0.0;
  for (const TrackPromises& track : cell.tracks) {
    result.promises += track.promises;
    kept += track.kept[l];
    half += track.half_sum[l];
  }
  result.share = kept / result.promises;
  result.half_m = half / result.promises;
  Rng rng(1);
  std::vector<double> shares;
  for (int draw = 0; draw < kDraws; ++draw) {
    double all = 0.0, of_them = 0.0;
    for (std::size_t i = 0; i < cell.tracks.size(); ++i) {
      const auto at = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(cell.tracks.size())));
      all += cell.tracks[at].promises;
      of_them += cell.tracks[at].kept[l];
    }
    shares.push_back(of_them / all);
  }
  std::ranges::sort(shares);
  result.low = shares[kDraws / 40];
  result.high = shares[kDraws - 1 - kDraws / 40];
  return result;
}

Study study(const Recording& recording, const TrackerConfig& config) { return Watch(recording, config).run(); }

std::string coverage_table(const Study& study) {
  std::string text = "what,ahead_s,confidence,promises,tracks,kept,kept_low,kept_high,half_m\n";
  for (const CoverageCell& cell : study.cells) {
    for (int level = 0; level < kLevels; ++level) {
      const Covered c = covered(cell, level);
      text +=
          fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.3f}\n", cell.what, cell.ahead_s,
                      confidence_at(study.confidence, level), c.promises, c.tracks, c.share, c.low, c.high, c.half_m);
    }
  }
  return text;
}

void add(Study& sum, const Study& other) {
  sum.judged.insert(sum.judged.end(), other.judged.begin(), other.judged.end());
  sum.slow.insert(sum.slow.end(), other.slow.begin(), other.slow.end());
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
