#include "ros2/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tern::ros2 {
namespace {

/// Topics that all vehicles share.
bool is_global(std::string_view topic) { return topic == "/tf" || topic == "/tf_static" || topic == "/clock"; }

/// Whether this is a full name: "/" and words of letters, digits and '_', none of which begins with a digit.
bool is_full_name(std::string_view name) {
  constexpr std::size_t kMost = 200;
  if (name.size() < 2 || name.size() > kMost || name.front() != '/' || name.back() == '/') return false;
  char before = ' ';
  for (const char c : name) {
    const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!is_letter && !is_digit && c != '/') return false;
    if (before == '/' && !is_letter) return false;
    before = c;
  }
  return true;
}

}  // namespace

std::string dds_topic_name(std::string_view topic) { return "rt" + std::string(topic); }

std::string dds_type_name(std::string_view type) {
  const std::size_t package = type.find('/'), name = type.rfind('/');
  return fmt::format("{}::msg::dds_::{}_", type.substr(0, package), type.substr(name + 1));
}

Result<TopicNames> TopicNames::parse(const std::string& name_space, const std::vector<std::string>& remaps,
                                     const std::vector<std::string>& known) {
  TopicNames names;
  if (!name_space.empty() && !is_full_name(name_space)) {
    return fail(fmt::format("--namespace {}: must be a name of ROS, as /drone1", name_space));
  }
  names.name_space_ = name_space;
  for (const std::string& remap : remaps) {
    const std::size_t sign = remap.find(":=");
    if (sign == std::string::npos) return fail(fmt::format("--remap {}: must be TOPIC:=/NAME", remap));
    std::string from = remap.substr(0, sign);
    if (!from.starts_with('/')) from.insert(0, "/");
    const std::string to = remap.substr(sign + 2);
    if (std::find(known.begin(), known.end(), from) == known.end()) {
      return fail(fmt::format("--remap {}: tern-ros2 has no topic {}; it has {}", remap, from, fmt::join(known, ", ")));
    }
    if (!is_full_name(to))
      return fail(fmt::format("--remap {}: {} is no full name of ROS, as /robot/odometry", remap, to));
    names.remaps_[from] = to;
  }
  return names;
}

std::string TopicNames::of(const std::string& topic) const {
  if (const auto found = remaps_.find(topic); found != remaps_.end()) return found->second;
  return is_global(topic) ? topic : name_space_ + topic;
}

}  // namespace tern::ros2
