// A track as scores and weights need it.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// A track at the time of its last detection.
struct DetectedTrack {
  std::int64_t id = 0;
  UTime born;                    ///< start of its filters; the same id with another time is another motion
  int detections = 1;            ///< since then
  Vec3 position = Vec3::Zero();  ///< as detected, W, m
  Vec3 variance = Vec3::Zero();  ///< of the position, m²
  const BankFilter* bank = nullptr;
  bool is_stationary = false;  ///< true: no prediction of it is stored
  bool is_coarse = false;      ///< seen with few points (kCoarsePoints)
  bool is_sighted = false;     ///< a track by sightings

  [[nodiscard]] double age_s(UTime at) const { return (at - born).seconds(); }
};

}  // namespace tern
