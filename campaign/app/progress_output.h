// How far a campaign is, on stderr: a bar that is written over on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <string>

#include "campaign/campaign.h"

namespace tern {

/// "[######..............]  37/1000  success 97.30 % [86.18, 99.52]  8.1 flights/min, 1 h 58 min left". Where flights
/// are equal, how many differ stands in the interval's place: they say no more than those.
/// @param elapsed_s  since this call's first flight began
std::string progress_line(const CampaignProgress& progress, double elapsed_s);

class ProgressOutput {
 public:
  ProgressOutput();
  void show(const CampaignProgress& progress);
  /// Leaves the last state standing.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::string last_;
  Clock::time_point begin_ = Clock::now(), shown_{};
};

}  // namespace tern
