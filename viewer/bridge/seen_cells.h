// Where sensors with a view have lately seen nothing, in the horizontal plane at each sensor's height.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/sighting.h"

namespace tern {

/// Square cells of W's x-y plane. Cell (x, y) has its lower corner at kCell · (x, y). The cells of a window of
/// kSide × kSide about each sensor are known; those of a window of kShown × kShown are told. So a vehicle with the
/// sensors may move by 4 m until their next frame.
///
/// A frame saw a cell if its centre, at the sensor's height, was looked through (perception/view.h). So a cell that an
/// obstacle fills, or that lies behind one, is unseen. A cell that has left the sensor's window may count as unseen. Of
/// frames of a sensor that are less than kPeriod apart, the first is used.
class SeenCells {
 public:
  static constexpr double kCell = 0.25;          ///< edge of a cell, m
  static constexpr int kSide = 96, kShown = 64;  ///< cells per edge of the windows
  static constexpr Duration kPeriod{200'000};

  /// O(kSide²). A frame that is older than the sensor's last one begins another flight: the sensor starts anew.
  void add(const SightingSet& frame);

  /// Cells (x, y), (x + 1, y) … (x + count − 1, y).
  struct Run {
    int x, y, count;
  };
  /// Returns the cells about `centre` (W) that no frame has seen since then, row by row.
  [[nodiscard]] std::vector<Run> unseen(const Vec3& centre, UTime since) const;

 private:
  struct Seen {
    int x = 0, y = 0;
    UTime at{INT64_MIN};
  };
  /// Cell (x, y) is stored at its coordinates modulo kSide, so the window moves without copies.
  struct Sensor {
    UTime used;
    std::vector<Seen> cells;
  };
  [[nodiscard]] bool is_seen(int x, int y, UTime since) const;

  std::map<std::int32_t, Sensor> sensors_;  ///< by id
};

}  // namespace tern
