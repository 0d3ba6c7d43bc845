#include "monitor/live_line.h"

#include <fmt/format.h>

#include <cmath>

#include "core/world/names.h"

namespace tern {
namespace {

std::string number(double x, int digits) { return std::isnan(x) ? "-" : fmt::format("{:.{}f}", x, digits); }

}  // namespace

std::string live_line(const LiveView& view) {
  const std::string beside = view.beside.empty() ? "" : "  at once: " + view.beside;
  if (!view.flying) {
    return "waiting for " + (view.waiting.empty() ? std::string("the simulator") : view.waiting) + beside;
  }
  std::string line =
      fmt::format("{:6.1f} s  {:3.0f} %  {:5.2f} m/s  nearest {} m  replan {}/{} ms (p50/p99)  in time {}/{}",
                  view.elapsed_s, view.progress * 100.0, view.speed_mps, number(view.nearest_m, 2),
                  number(view.replan_p50_ms, 1), number(view.replan_p99_ms, 1), view.answered_in_time, view.requests);
  if (view.reason != PlanReason::None) line += fmt::format("  ({})", to_string(view.reason));
  if (view.left_out > 0) line += fmt::format("  {} tracks left out", view.left_out);
  if (!view.waiting.empty()) line += "  waiting for " + view.waiting;
  return line + beside;
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
