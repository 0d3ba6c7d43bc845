// Shows a campaign's progress on stderr: a bar on a terminal, otherwise a line from time to time.
#pragma once

#include <chrono>
#include <string>

#include "campaign/campaign.h"

namespace tern {

/// Returns "[######..............]  37/1000  success 97.30 % [86.18, 99.52]  8.1 flights/min, 1 h 58 min left". If some
/// flights are equal, the number of different flights replaces the interval, since equal flights add no information.
/// @param elapsed_s  since the first flight of this call started
std::string progress_line(const CampaignProgress& progress, double elapsed_s);

/// Prints the progress.
class ProgressOutput {
 public:
  ProgressOutput();
  void show(const CampaignProgress& progress);
  /// Ends the bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::string last_;
  Clock::time_point begin_ = Clock::now(), shown_{};
};

}  // namespace tern
