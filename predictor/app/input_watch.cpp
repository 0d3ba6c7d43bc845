#include "predictor/app/input_watch.h"

#include <fmt/format.h>

#include "runtime/log.h"

namespace tern {

void InputWatch::used(const std::string& input, UTime now) {
  std::erase_if(used_, [now](const auto& entry) {
    return entry.second.times < kExpectedAfter && now - entry.second.last > kTroubleReported;
  });
  if (used_.size() >= kMaxInputs && !used_.contains(input)) return;
  Use& use = used_[input];
  use.last = now;
  ++use.times;
}

void InputWatch::trouble(const std::string& kind, const std::string& text, UTime now) {
  const auto [found, is_new] = troubles_.try_emplace(kind);
  if (is_new || now - found->second.at > kTroubleReported) log::warn("{}", text);
  found->second = {text, now};
}

std::string InputWatch::silent(UTime now) const {
  std::string text;
  std::size_t silent = 0;
  for (const auto& [input, use] : used_) {
    if (use.times < kExpectedAfter || now - use.last <= kInputsStopped || ++silent > kMaxNamed) continue;
    text += fmt::format("{}{} (silent for {:.1f} s)", text.empty() ? "" : ", ", input, (now - use.last).seconds());
  }
  if (silent > kMaxNamed) text += fmt::format(" and {} more", silent - kMaxNamed);
  return text;
}

std::string InputWatch::troubles(UTime now) const {
  std::string text;
  for (const auto& [kind, trouble] : troubles_) {
    if (now - trouble.at <= kTroubleReported) text += (text.empty() ? "" : "; ") + trouble.text;
  }
  return text;
}

}  // namespace tern
