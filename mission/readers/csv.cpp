#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "mission/readers/entry.h"
#include "mission/readers/mission_file.h"

namespace tern::mission {
namespace {

constexpr const char* kColumns[] = {"x",      "y",      "z",        "latitude", "longitude", "height",
                                    "action", "hold_s", "radius_m", "speed",    "track",     "name"};

std::string_view trimmed(std::string_view text) {
  constexpr const char* kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// The cells of a line, without the spaces around them.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A part of a hostile text, for a message.
std::string quoted(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 32)) out += c >= 0x20 && c < 0x7f ? c : '?';
  return '"' + out + '"';
}

/// The columns of a table, by name.
class Columns {
 public:
  static Result<Columns> of(std::string_view line) {
    Columns columns;
    for (const std::string_view name : cells_of(line)) {
      const bool is_known = std::find(std::begin(kColumns), std::end(kColumns), name) != std::end(kColumns);
      if (asks_for_other_speed(name)) return fail(fmt::format("column {} {}", quoted(name), kOtherSpeed));
      if (!is_known)
        return fail(fmt::format("column {} is unknown (known: {})", quoted(name), fmt::join(kColumns, ", ")));
      if (!columns.at_.emplace(name, columns.at_.size()).second)
        return fail(fmt::format("column {} is given twice", name));
    }
    columns.is_geodetic_ = columns.at_.contains("latitude");
    for (const char* needed : columns.is_geodetic_ ? kGeodetic : kLocal) {
      if (!columns.at_.contains(needed)) {
        return fail(fmt::format("column {} is missing: give x, y, z, or latitude, longitude, height", needed));
      }
    }
    for (const char* other : columns.is_geodetic_ ? kLocal : kGeodetic) {
      if (columns.at_.contains(other)) return fail("x, y, z and latitude, longitude, height exclude each other");
    }
    return columns;
  }

  Result<void> add(std::string_view line, int item, const Site& site, StepList& steps) const {
    const std::vector<std::string_view> cells = cells_of(line);
    if (cells.size() != at_.size()) return fail(fmt::format("has {} cells, not {}", cells.size(), at_.size()));
    Entry entry;
    entry.item = item;
    entry.name = text(cells, "name");
    entry.action = text(cells, "action");
    for (auto [name, value] :
         {std::pair{"hold_s", &entry.hold_s}, std::pair{"radius_m", &entry.radius}, std::pair{"speed", &entry.speed}}) {
      const auto read = number(cells, name);
      if (!read) return tl::unexpected(read.error());
      *value = *read;
    }
    const auto track = number(cells, "track");
    if (!track) return tl::unexpected(track.error());
    if (*track) {
      if (std::abs(**track) > kMaxTrack || **track != std::floor(**track)) return fail("track is not a whole number");
      entry.track = static_cast<std::int64_t>(**track);
    }
    const auto place = this->place(cells, entry.action == "follow", site);
    if (!place) return tl::unexpected(place.error());
    entry.place = *place;
    return add_entry(entry, steps);
  }

 private:
  static constexpr const char* kLocal[] = {"x", "y", "z"};
  static constexpr const char* kGeodetic[] = {"latitude", "longitude", "height"};
  static constexpr double kMaxTrack = 9e15;

  [[nodiscard]] std::string_view cell(const std::vector<std::string_view>& cells, const char* name) const {
    const auto column = at_.find(name);
    return column == at_.end() ? std::string_view() : cells[column->second];
  }
  [[nodiscard]] std::string text(const std::vector<std::string_view>& cells, const char* name) const {
    std::string text;
    for (const char c : cell(cells, name).substr(0, kMaxText)) text += c >= 0x20 || c < 0 ? c : '?';
    return text;
  }
  /// A number, or nullopt if the cell is empty or there is no such column.
  [[nodiscard]] Result<std::optional<double>> number(const std::vector<std::string_view>& cells,
                                                     const char* name) const {
    const std::string_view text = cell(cells, name);
    if (text.empty()) return std::optional<double>();
    const auto value = number_of(text);
    if (!value) return fail(fmt::format("{} {} is no finite number", name, quoted(text)));
    return value;
  }
  /// The place; nullopt if its cells are empty. An offset from a track is metres, in either kind of table.
  [[nodiscard]] Result<std::optional<Vec3>> place(const std::vector<std::string_view>& cells, bool is_offset,
                                                  const Site& site) const {
    double at[3];
    int empty = 0;
    for (int k = 0; k < 3; ++k) {
      const auto value = number(cells, is_geodetic_ ? kGeodetic[k] : kLocal[k]);
      if (!value) return tl::unexpected(value.error());
      if (!*value) ++empty;
      at[k] = value->value_or(0.0);
    }
    if (empty == 3) return std::optional<Vec3>();
    if (empty > 0) return fail("a position needs three numbers");
    if (is_offset && is_geodetic_) return fail("action follow needs an offset in x, y, z");
    const auto p = place_of(is_geodetic_, at[0], at[1], at[2], site);
    if (!p) return tl::unexpected(p.error());
    return std::optional<Vec3>(*p);
  }

  static constexpr std::size_t kMaxText = 64;

  std::map<std::string, std::size_t, std::less<>> at_;
  bool is_geodetic_ = false;
};

}  // namespace

Result<std::vector<Step>> parse_csv(std::string_view text, const Site& site) {
  std::optional<Columns> columns;
  StepList steps(site);
  int item = 0, number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (line.empty() || line.front() == '#') continue;
    if (!columns) {
      const auto read = Columns::of(line);
      if (!read) return fail(fmt::format("line {}: {}", number, read.error().message));
      columns = *read;
      continue;
    }
    if (const auto added = columns->add(line, ++item, site, steps); !added) {
      return fail(fmt::format("line {}: {}", number, added.error().message));
    }
  }
  if (!columns) return fail("has no line that names columns");
  return steps.take();
}

}  // namespace tern::mission
