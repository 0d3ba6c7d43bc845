#include "campaign/app/progress_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "campaign/statistics/wilson.h"

namespace tern {
namespace {

constexpr int kBarWidth = 20;
constexpr std::chrono::seconds kLineEvery{30};

std::string time_left(double seconds) {
  const auto minutes = static_cast<std::int64_t>(seconds / 60.0);
  if (minutes >= 60) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  return minutes >= 1 ? fmt::format("{} min", minutes) : fmt::format("{:.0f} s", seconds);
}

}  // namespace

std::string progress_line(const CampaignProgress& p, double elapsed_s) {
  const auto filled = static_cast<std::size_t>(p.total > 0 ? kBarWidth * p.done / p.total : kBarWidth);
  std::string line =
      fmt::format("[{}{}] {:>5}/{}", std::string(filled, '#'), std::string(kBarWidth - filled, '.'), p.done, p.total);
  if (p.done > 0) {
    const Interval interval = wilson_interval(p.successes, p.done);
    line += fmt::format("  success {:.2f} %", 100.0 * static_cast<double>(p.successes) / static_cast<double>(p.done));
    line += p.different == p.done ? fmt::format(" [{:.2f}, {:.2f}]", 100.0 * interval.low, 100.0 * interval.high)
                                  : fmt::format(", {} different flights", p.different);
  }
  if (p.flown == 0 || elapsed_s <= 0.0) return line;
  const double rate = static_cast<double>(p.flown) / elapsed_s;
  line += fmt::format("  {:.1f} flights/min", 60.0 * rate);
  if (p.done < p.total) line += fmt::format(", {} left", time_left(static_cast<double>(p.total - p.done) / rate));
  return line;
}

ProgressOutput::ProgressOutput() : terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressOutput::show(const CampaignProgress& progress) {
  const Clock::time_point now = Clock::now();
  last_ = progress_line(progress, std::chrono::duration<double>(now - begin_).count());
  if (terminal_) {
    fmt::print(stderr, "\r\x1b[K{}", last_);
    std::fflush(stderr);
  } else if (now - shown_ >= kLineEvery) {
    fmt::print(stderr, "{}\n", last_);
    shown_ = now;
  }
}

void ProgressOutput::finish() {
  if (!last_.empty()) fmt::print(stderr, "{}\n", terminal_ ? "" : last_);
}

}  // namespace tern
