#include "monitor/live_line.h"

#include <fmt/format.h>

#include <cmath>

#include "core/world/names.h"

namespace tern {
namespace {

std::string number(double x, int digits) { return std::isnan(x) ? "-" : fmt::format("{:.{}f}", x, digits); }

}  // namespace

std::string live_line(const LiveView& view, std::size_t columns) {
  const std::string concurrent = view.concurrent.empty() ? "" : "  at once: " + view.concurrent;
  if (!view.flying) {
    return "waiting for " + (view.waiting.empty() ? std::string("the simulator") : view.waiting) + concurrent;
  }
  std::string head = fmt::format("{:6.1f} s  {:3.0f} %  {:5.2f} m/s  nearest {} m", view.elapsed_s,
                                 view.progress * 100.0, view.speed_mps, number(view.nearest_m, 2));
  if (!std::isnan(view.nearest_wall_m)) head += fmt::format(", wall {} m", number(view.nearest_wall_m, 2));
  const std::string slowed = view.pace == 1.0 ? "" : fmt::format(" at pace {:g}", view.pace);
  const std::string replan =
      fmt::format("  replan {}/{} ms{}", number(view.replan_p50_ms, 1), number(view.replan_p99_ms, 1), slowed);
  const std::string in_time = fmt::format("  in time {}/{}", view.answered_in_time, view.requests);
  std::string trouble;
  if (view.reason != PlanReason::None) trouble += fmt::format("  ({})", to_string(view.reason));
  if (view.left_out > 0) trouble += fmt::format("  {} tracks left out", view.left_out);
  if (!view.waiting.empty()) trouble += "  waiting for " + view.waiting;
  trouble += concurrent;
  for (const std::string& middle : {fmt::format("{} (p50/p99){}", replan, in_time), replan + in_time, in_time}) {
    if (head.size() + middle.size() + trouble.size() <= columns) return fmt::format("{}{}{}", head, middle, trouble);
  }
  return head + trouble;
}

std::string fit(const std::string& text, std::size_t columns) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_character = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (begins_character && seen++ == columns) return text.substr(0, i);
  }
  return text;
}

}  // namespace tern
