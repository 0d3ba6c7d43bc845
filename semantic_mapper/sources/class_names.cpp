#include "semantic_mapper/sources/class_names.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace tern {
namespace {

constexpr std::array<const char*, 23> kNames{"never_classified",
                                             "unclassified",
                                             "ground",
                                             "low_vegetation",
                                             "medium_vegetation",
                                             "high_vegetation",
                                             "building",
                                             "low_noise",
                                             "key_point",
                                             "water",
                                             "rail",
                                             "road_surface",
                                             "overlap",
                                             "wire_guard",
                                             "wire_conductor",
                                             "tower",
                                             "wire_connector",
                                             "bridge_deck",
                                             "high_noise",
                                             "overhead_structure",
                                             "ignored_ground",
                                             "snow",
                                             "temporal_exclusion"};

struct Group {
  const char* name;
  std::array<std::uint8_t, 3> members;
  std::size_t size;
};
constexpr std::array<Group, 4> kGroups{
    {{"vegetation", {3, 4, 5}, 3}, {"wire", {13, 14, 16}, 3}, {"noise", {7, 18, 0}, 2}, {"road", {11, 0, 0}, 1}}};

constexpr std::string_view kNumbered = "class_";

}  // namespace

std::string class_name(std::uint8_t number) {
  if (number < kNames.size()) return kNames[number];
  return fmt::format("{}{}", kNumbered, number);
}

std::vector<std::uint8_t> class_numbers(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return {static_cast<std::uint8_t>(i)};
  }
  for (const Group& group : kGroups) {
    if (name == group.name) return {group.members.begin(), group.members.begin() + group.size};
  }
  if (name.starts_with(kNumbered)) name.remove_prefix(kNumbered.size());
  const char* end = name.data() + name.size();
  int number = -1;
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc() || stop != end || number < 0 || number > 255) return {};
  return {static_cast<std::uint8_t>(number)};
}

bool is_class_group(std::string_view name) {
  for (const Group& group : kGroups) {
    if (name == group.name) return true;
  }
  return false;
}

}  // namespace tern
