#include "viewer/bridge/flight_history.h"

#include <algorithm>
#include <cmath>

#include "viewer/bridge/json_writer.h"

namespace tern {
namespace {

constexpr Duration kMotionEvery{50'000};
constexpr Duration kClearanceEvery{100'000};
constexpr std::size_t kMostSamples = 432'000;

/// Appends in order of time, at least `every` after the last.
template <class Sample>
void append(std::vector<Sample>& row, const Sample& sample, Duration every) {
  if (!row.empty() && sample.at - row.back().at < every) return;
  if (row.size() >= kMostSamples) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kMostSamples / 2));
  row.push_back(sample);
}

template <class Sample>
auto first_after(const std::vector<Sample>& row, UTime t) {
  return std::upper_bound(row.begin(), row.end(), t, [](UTime at, const Sample& s) { return at < s.at; });
}

/// The samples in (until − span, until] as one list per column.
template <class Sample, class... Column>
void write_columns(JsonWriter& json, const std::vector<Sample>& row, UTime until, Column... columns) {
  const auto begin = first_after(row, until - kChartSpan);
  const auto end = first_after(row, until);
  const auto write = [&](auto column) {
    json.begin_list();
    for (auto it = begin; it != end; ++it) json.number(column(*it));
    json.end_list();
  };
  json.begin_list();
  write([until](const Sample& s) { return (s.at - until).seconds(); });
  (write(columns), ...);
  json.end_list();
}

}  // namespace

void FlightHistory::add(const UavState& state) {
  append(motion_, {state.at, state.motion.p, state.motion.v.norm(), state.motion.a.norm()}, kMotionEvery);
}

void FlightHistory::add_clearance(UTime at, double clearance_m) {
  append(clearance_, {at, clearance_m}, kClearanceEvery);
}

void FlightHistory::add_answer(UTime at, double total_ms, double allowed_ms, PlanOutcome outcome) {
  append(answers_, {at, total_ms, allowed_ms, static_cast<int>(outcome)}, Duration{0});
}

void FlightHistory::clear() {
  motion_.clear();
  clearance_.clear();
  answers_.clear();
}

std::string FlightHistory::chart_json(UTime until) const {
  JsonWriter json;
  json.begin_object().key("until_us").integer(until.us);
  json.key("elapsed_s").number(motion_.empty() ? 0.0 : (until - motion_.front().at).seconds()).key("motion");
  write_columns(
      json, motion_, until, [](const Motion& s) { return s.speed; }, [](const Motion& s) { return s.acceleration; });
  json.key("clearance");
  write_columns(json, clearance_, until, [](const Clearance& s) { return s.metres; });
  json.key("answers");
  write_columns(
      json, answers_, until, [](const Answer& s) { return s.total_ms; }, [](const Answer& s) { return s.allowed_ms; },
      [](const Answer& s) { return static_cast<double>(s.outcome); });
  json.end_object();
  return json.take();
}

std::string FlightHistory::path_json(UTime until, std::size_t most) const {
  const auto count = static_cast<std::size_t>(first_after(motion_, until) - motion_.begin());
  const std::size_t stride = std::max<std::size_t>(1, (count + most - 1) / std::max<std::size_t>(most, 1));
  JsonWriter json;
  json.begin_list();
  for (std::size_t k = 0; k < count; k += stride) {
    json.point(motion_[k].p);
    json.number(motion_[k].speed);
  }
  json.end_list();
  return json.take();
}

}  // namespace tern
