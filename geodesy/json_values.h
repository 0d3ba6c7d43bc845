// Reads values of JSON files that may be hostile: plans of QGroundControl and GeoJSON.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tern {

/// Deepest nesting of a file: it bounds the memory that a hostile file can take.
inline constexpr int kMaxJsonDepth = 32;

/// Parses a text. @return an Error if it is not JSON, or nested more deeply than kMaxJsonDepth
inline Result<nlohmann::json> parse_json(std::string_view text) {
  bool is_deep = false;
  const auto watch = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    is_deep = is_deep || depth > kMaxJsonDepth;
    return !is_deep;
  };
  nlohmann::json json = nlohmann::json::parse(text, watch, false);
  if (is_deep) return fail(fmt::format("is nested more deeply than {} levels", kMaxJsonDepth));
  if (json.is_discarded()) return fail("is no JSON, or ends too early");
  return json;
}

/// Returns the member of an object; null if it is missing, or if the value is not an object.
inline const nlohmann::json& member(const nlohmann::json& json, const char* name) {
  static const nlohmann::json null;
  if (!json.is_object()) return null;
  const auto found = json.find(name);
  return found == json.end() ? null : *found;
}

/// Returns a text without control characters, at most 64 bytes; "" if the value is not a text.
inline std::string short_text(const nlohmann::json& json) {
  if (!json.is_string()) return "";
  std::string text = json.get<std::string>().substr(0, 64);
  for (char& c : text) {
    if (c >= 0 && c < 0x20) c = '?';
  }
  return text;
}

}  // namespace tern
