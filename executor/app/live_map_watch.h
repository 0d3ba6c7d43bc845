// The age of a live map: without scans it shows the world as it was.
#pragma once

#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/wire/health.h"

namespace tern {

/// Watches the HEARTBEATs of a tern-mapper that makes its map of scans. A map of files has no age. Mappers of other
/// names are ignored.
///
/// | last HEARTBEAT of tern-mapper               | trouble() |
/// |---------------------------------------------|-----------|
/// | none, or of a mapper of files               | none      |
/// | receives scans, state Ready                 | none      |
/// | receives scans, another state               | its text  |
/// | receives scans, older than kMaxAge          | its age   |
class LiveMapWatch {
 public:
  /// HEARTBEAT comes at 2 Hz: five in a row may be lost, or late while a large map is updated.
  static constexpr Duration kMaxAge{3'000'000};

  void add(const Heartbeat& heartbeat, UTime received);
  /// Returns why the map is no longer kept up to date, in words; "" if it is.
  [[nodiscard]] std::string trouble(UTime now) const;
  /// Returns whether there is no trouble, and logs a change.
  bool judge(UTime now);

 private:
  std::optional<UTime> received_;  ///< of the newest HEARTBEAT of a live mapper
  std::string waiting_for_;        ///< "": it was ready
  bool was_kept_ = true;           ///< result of judge()
};

}  // namespace tern
