#include "viewer/bridge/flight_history.h"

#include <algorithm>
#include <limits>

namespace tern {
namespace {

constexpr Duration kEvery{50'000};
constexpr Duration kRowEvery{40'000};  ///< answers come about every 50 ms, so all are stored
constexpr std::size_t kMaxSamples = 432'000;
constexpr double kDepartureSpeed = 0.05;

template <class Sample>
void forget_half(std::vector<Sample>& row, std::size_t width = 1) {
  row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kMaxSamples / 2 * width));
}

template <class Sample>
auto first_after(const std::vector<Sample>& row, UTime t) {
  return std::upper_bound(row.begin(), row.end(), t, [](UTime at, const Sample& s) { return at < s.at; });
}

/// Returns the rows with the least and the greatest value of each stretch, in order of time.
std::vector<std::size_t> extremes(const std::vector<float>& values, std::size_t width, std::size_t column,
                                  std::size_t count, std::size_t most) {
  std::vector<std::size_t> kept;
  const std::size_t stretch = std::max<std::size_t>(1, (count + most - 1) / std::max<std::size_t>(most, 1));
  const auto value = [&](std::size_t row) { return values[row * width + column]; };
  for (std::size_t from = 0; from < count; from += stretch) {
    std::size_t least = from, greatest = from;
    for (std::size_t k = from; k < std::min(from + stretch, count); ++k) {
      if (value(k) < value(least)) least = k;
      if (value(k) > value(greatest)) greatest = k;
    }
    kept.push_back(std::min(least, greatest));
    if (least != greatest) kept.push_back(std::max(least, greatest));
  }
  return kept;
}

}  // namespace

void FlightHistory::add(const UavState& state) {
  if (!motion_.empty() && state.at - motion_.back().at < kEvery) return;
  if (motion_.size() >= kMaxSamples) forget_half(motion_);
  motion_.push_back({state.at, state.motion.p, state.motion.v.norm()});
}

bool FlightHistory::keeps_row(const std::string& table, UTime at) const {
  const auto found = tables_.find(table);
  return found == tables_.end() || found->second.at.empty() || at - found->second.at.back() >= kRowEvery;
}

bool FlightHistory::add_row(const std::string& name, UTime at, const NumberFields& fields) {
  if (fields.empty() || !keeps_row(name, at)) return false;
  Table& table = tables_[name];
  const bool is_first = table.names.empty();
  if (is_first) {
    for (const auto& [field, value] : fields) table.names.push_back(field);
  }
  if (table.at.size() >= kMaxSamples) {
    forget_half(table.at);
    forget_half(table.values, table.names.size());
  }
  table.at.push_back(at);
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    const bool in_place = k < fields.size() && fields[k].first == table.names[k];
    const auto found = in_place ? fields.begin() + static_cast<std::ptrdiff_t>(k)
                                : std::find_if(fields.begin(), fields.end(),
                                               [&](const auto& field) { return field.first == table.names[k]; });
    table.values.push_back(found == fields.end() ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(found->second));
  }
  return is_first;
}

void FlightHistory::add_answer(UTime at, PlanOutcome outcome) {
  if (!answers_.empty() && at < answers_.back().at) return;
  if (answers_.size() >= kMaxSamples) forget_half(answers_);
  answers_.push_back({at, static_cast<int>(outcome)});
}

std::vector<std::string> FlightHistory::fields() const {
  std::vector<std::string> all;
  for (const auto& [name, table] : tables_) all.insert(all.end(), table.names.begin(), table.names.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::optional<UTime> FlightHistory::departure() const {
  const auto flies = [](const Motion& m) { return m.speed > kDepartureSpeed; };
  const auto first = std::find_if(motion_.begin(), motion_.end(), flies);
  return first == motion_.end() ? std::nullopt : std::optional(first->at);
}

void FlightHistory::write_series(JsonWriter& json, UTime zero, UTime until, const std::string& name,
                                 std::size_t most) const {
  for (const auto& [key, table] : tables_) {
    const auto found = std::find(table.names.begin(), table.names.end(), name);
    if (found == table.names.end()) continue;
    const auto column = idx(found - table.names.begin());
    const auto count = idx(std::upper_bound(table.at.begin(), table.at.end(), until) - table.at.begin());
    const auto rows = extremes(table.values, table.names.size(), column, count, most);
    json.key(name).begin_list().begin_list();
    for (const std::size_t row : rows) json.number((table.at[row] - zero).seconds());
    json.end_list().begin_list();
    for (const std::size_t row : rows) json.number(table.values[row * table.names.size() + column]);
    json.end_list().end_list();
    return;
  }
}

std::string FlightHistory::chart_json(UTime zero, UTime until, const std::vector<std::string>& names,
                                      std::size_t most) const {
  JsonWriter json;
  json.begin_object().key("zero_us").integer(zero.us).key("begin_s").number((begin() - zero).seconds());
  json.key("end_s").number((until - zero).seconds());
  json.key("series").begin_object();
  for (const std::string& name : names) write_series(json, zero, until, name, most);
  json.end_object().key("outcomes").begin_list().begin_list();
  const auto end = first_after(answers_, until);
  for (auto it = answers_.begin(); it != end; ++it) json.number((it->at - zero).seconds());
  json.end_list().begin_list();
  for (auto it = answers_.begin(); it != end; ++it) json.integer(it->outcome);
  return json.end_list().end_list().end_object().take();
}

void FlightHistory::write_path(JsonWriter& json, UTime zero, UTime until, std::size_t most) const {
  const auto count = idx(first_after(motion_, until) - motion_.begin());
  const std::size_t stride = std::max<std::size_t>(1, (count + most - 1) / std::max<std::size_t>(most, 1));
  json.key("t").begin_list();
  for (std::size_t k = 0; k < count; k += stride) json.number((motion_[k].at - zero).seconds());
  json.end_list().key("curve").begin_list();
  for (std::size_t k = 0; k < count; k += stride) json.point(motion_[k].p).number(motion_[k].speed);
  json.end_list();
}

}  // namespace tern
