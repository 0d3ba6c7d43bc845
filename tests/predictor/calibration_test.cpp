// Margins and levels of the conformal calibration, against slow oracles, and its miss rate in the long run.
#include "predictor/tracking/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern {
namespace {

constexpr TrackClass kCalmOld{TrackAge::Old, MotionKind::Calm}, kLivelyOld{TrackAge::Old, MotionKind::Lively};

/// Oracle: the share of scores above q, counted over prior, pool and own scores.
double above(double q, std::size_t kind, std::size_t band, const std::vector<float>& own,
             const std::vector<float>& all) {
  const auto larger = [&](const std::vector<float>& scores) {
    return Calibration::score_weight(band) *
           static_cast<double>(
               std::count_if(scores.begin(), scores.end(), [&](float s) { return static_cast<double>(s) > q; }));
  };
  const auto count = [&](const std::vector<float>& scores) {
    return Calibration::score_weight(band) * static_cast<double>(scores.size());
  };
  const double prior = Calibration::kPriorWeight * prior_share_above(SceneSpeed::Any, kind, band, q);
  const double pool = (prior + larger(all)) / (Calibration::kPriorWeight + count(all));
  return (Calibration::kPoolWeight * pool + larger(own)) / (Calibration::kPoolWeight + count(own));
}

TEST(Calibration, TheMarginIsTheLeastThatPriorPoolAndOwnScoresAllow) {
  constexpr std::size_t kKind = class_index(kCalmOld);
  constexpr std::size_t kBand = 1;
  for (const int scores : {0, 3, 30, 300, 3000}) {
    Rng rng(1);
    Calibration calibration(0.99);
    std::vector<float> own, all;
    for (int k = 0; k < scores; ++k) {
      const bool is_own = k % 3 == 0;
      all.push_back(static_cast<float>(rng.uniform(-1.5, 0.5)));
      if (is_own) own.push_back(all.back());
      calibration.add(is_own ? kCalmOld : kLivelyOld, kBand, all.back(), {}, SceneSpeed::Any);
    }
    const auto newest = [](std::vector<float>& s, std::size_t most) {
      if (s.size() > most) s.erase(s.begin(), s.end() - static_cast<std::ptrdiff_t>(most));
    };
    newest(own, Calibration::kOwnScores);
    newest(all, Calibration::kPoolScores);
    calibration.refresh();
    const PerLevel margins = calibration.margins(kCalmOld);
    for (std::size_t level = 0; level < margins.size(); ++level) {
      // No interval missed: θ has risen with each.
      const double allowed = calibration.allowed(level, kBand);
      const double risen = (level == 0 ? 1.0 : Calibration::kInitialLevel) *
                           prior_level(SceneSpeed::Any, kKind, kBand, level) *
                           std::exp(Calibration::kAdaption * allowed * static_cast<double>((scores + 2) / 3));
      const double theta = std::min(Calibration::kMaxLevel * allowed, risen);
      const double q = margins[level][kBand];
      EXPECT_LE(above(q + 1e-6, kKind, kBand, own, all), theta * (1.0 + 1e-9)) << scores << ", " << level;
      if (q > -kModelSigmas + 1e-3) {
        EXPECT_GT(above(q - 1e-3, kKind, kBand, own, all), theta) << "less would do";
      }
    }
  }
}

TEST(Calibration, PredictionsMadeUnderAnotherPriorLeaveThetaAsItIs) {
  std::array<PerLevel, 2> margins;
  for (const SceneSpeed made_under : {SceneSpeed::Any, SceneSpeed::Slow}) {
    Rng rng(4);
    Calibration calibration(0.99);
    calibration.set_scene_speed(SceneSpeed::Slow);
    for (int k = 0; k < 1000; ++k) {
      calibration.add(kNewTrack, 1, static_cast<float>(rng.uniform()), {}, made_under);
    }
    calibration.refresh();
    margins[made_under == SceneSpeed::Slow ? 1 : 0] = calibration.margins(kNewTrack);
  }
  for (std::size_t level = 1; level < kConfidenceLevels.size(); ++level) {
    EXPECT_LT(margins[1][level][1], margins[0][level][1]) << "none missed, so a smaller margin will do";
  }
}

TEST(IntervalHalfWidth, CoversAnErrorWithItsMarginAndWithNoLess) {
  Rng rng(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const double ahead = rng.uniform(0.01, 4.5);
    const std::size_t band = band_of(ahead);
    Vec3 error, deviation;
    for (int axis = 0; axis < 3; ++axis) {
      error[axis] = rng.normal();
      deviation[axis] = std::exp(rng.uniform(-4.0, 1.0));
    }
    PerBand<double> margins{};
    margins[band] = covering_margin(error, deviation, band, ahead);
    EXPECT_LE((error.cwiseAbs() - interval_half_width(deviation, margins, ahead)).maxCoeff(), 1e-9);
    if (margins[band] < 1e-3 - kModelSigmas) continue;
    margins[band] -= 1e-3;
    EXPECT_GT((error.cwiseAbs() - interval_half_width(deviation, margins, ahead)).maxCoeff(), 0.0);
  }
}

TEST(Calibration, LeavingTheSlowPriorRestoresTheMarginsOfTheOther) {
  const Calibration fresh(0.99);
  Calibration calibration(0.99);
  calibration.set_scene_speed(SceneSpeed::Slow);
  calibration.refresh();
  for (const CalibratedClass& one : kCalibratedClasses) {
    const PerLevel &slow = calibration.margins(one.of), &any = fresh.margins(one.of);
    for (std::size_t band = 1; band < kBands; ++band)
      EXPECT_LT(slow[0][band], any[0][band] + 0.05) << class_index(one.of) << ", " << band;
  }
  EXPECT_LT(calibration.margins(kYoungTrack)[0][2], 0.5 * fresh.margins(kYoungTrack)[0][2]);
  calibration.set_scene_speed(SceneSpeed::Any);
  calibration.refresh();
  for (std::size_t level = 0; level < kConfidenceLevels.size(); ++level) {
    for (std::size_t band = 0; band < kBands; ++band) {
      EXPECT_NEAR(calibration.margins(kYoungTrack)[level][band], fresh.margins(kYoungTrack)[level][band], 1e-3);
    }
  }
}

/// Errors grow from band to band, and are `scale` times as large as those that the prior may know.
TEST(Calibration, MissesTheAllowedShareAtEachLevelForAnyDistribution) {
  for (const double scale : {0.1, 8.0}) {
    Rng rng(3);
    Calibration calibration(0.99);
    constexpr int kPredictions = 8'000, kLearning = 2'000;
    std::array<std::array<int, kBands>, kLevels> missed{};
    for (int prediction = 0; prediction < kPredictions; ++prediction) {
      const PerLevel margins = calibration.margins(kCalmOld);
      std::array<bool, kLevels> out{};
      double q = 0.0;
      for (std::size_t band = 0; band < kBands; ++band) {
        q = 0.5 * q + scale * kCoverageHorizons[band] * rng.normal();
        for (std::size_t level = 0; level < out.size(); ++level) {
          out[level] = out[level] || q > margins[level][band];
          missed[level][band] += prediction >= kLearning && out[level] ? 1 : 0;
        }
        calibration.add(kCalmOld, band, static_cast<float>(q), out, SceneSpeed::Any);
      }
      calibration.refresh();
    }
    for (std::size_t level = 0; level < kConfidenceLevels.size(); ++level) {
      EXPECT_LE(calibration.allowed(level, kBands - 1), 1.0 - kConfidenceLevels[level] + 1e-12);
      for (std::size_t band = 0; band < kBands; ++band) {
        const double share = static_cast<double>(missed[level][band]) / (kPredictions - kLearning);
        // Four standard deviations of that many independent misses.
        const double allowed = calibration.allowed(level, band);
        const double deviation = std::sqrt((1.0 - allowed) / (allowed * (kPredictions - kLearning)));
        EXPECT_NEAR(share / allowed, 1.0, 4.0 * deviation) << scale << ", " << level << ", " << band;
      }
    }
  }
}

}  // namespace
}  // namespace tern
