#include "core/scenario/obstacle_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "core/scenario/blind_corner.h"

namespace tern {
namespace {

constexpr std::string_view kNote = "# obstacle ";

/// Returns the text of a YAML scalar: without its quotes, if it has any.
std::string plain(std::string_view value) {
  if (value.size() < 2 || value.front() != value.back() || (value.front() != '"' && value.front() != '\'')) {
    return std::string(value);
  }
  std::string text;
  const char quote = value.front();
  value = value.substr(1, value.size() - 2);
  for (std::size_t k = 0; k < value.size(); ++k) {
    const bool is_escape = k + 1 < value.size() && (quote == '"' ? value[k] == '\\' : value.substr(k, 2) == "''");
    text += value[is_escape ? ++k : k];
  }
  return text;
}

/// Returns the names that the scenario lists.
std::map<std::int64_t, std::string> listed_names(const std::string& yaml) {
  std::map<std::int64_t, std::string> names;
  std::int64_t first = 0, listed = 0;  // id of the first listed obstacle, number of them so far
  bool is_blind_corner = false;
  std::string section, key;  // of the first and the second level
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::string_view text(line);
    if (section == "world:" && !text.starts_with(' ')) break;
    if (!text.starts_with(' ')) section = line;
    if (section != "world:") continue;
    if (text.starts_with("  ") && text.substr(2, 1) != " ") key = line.substr(2, line.find(':') - 2);
    if (text == "  generator: step_aside") return {};
    if (text == "  generator: blind_corner") is_blind_corner = true;
    if (text.starts_with("  count: ")) {
      const int count = std::atoi(line.c_str() + 9);
      first = is_blind_corner ? blind_corner_obstacles(count) : count;
    }
    if (key != "obstacles") continue;
    if (text == "    -") ++listed;
    constexpr std::string_view kName = "      name: ";
    if (!text.starts_with(kName)) continue;
    if (std::string name = plain(text.substr(kName.size())); !name.empty()) names[first + listed - 1] = std::move(name);
  }
  return names;
}

}  // namespace

std::map<std::int64_t, std::string> obstacle_names(const std::string& yaml) {
  std::map<std::int64_t, std::string> names = listed_names(yaml);
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::string_view text(line);
    if (!text.starts_with(kNote)) continue;
    const std::size_t colon = text.find(": ", kNote.size());
    std::int64_t id = 0;
    const char* const end = text.data() + std::min(colon, text.size());
    const auto read = std::from_chars(text.data() + kNote.size(), end, id);
    if (read.ec != std::errc{} || read.ptr != end || colon == std::string_view::npos) continue;
    names[id] = text.substr(colon + 2);
  }
  return names;
}

std::string name_note(std::int64_t id, const std::string& name) { return fmt::format("obstacle {}: {}", id, name); }

std::string with_name(std::int64_t id, const std::map<std::int64_t, std::string>& names) {
  const auto found = names.find(id);
  return found == names.end() ? fmt::format("{}", id) : fmt::format("{} '{}'", id, found->second);
}

}  // namespace tern
