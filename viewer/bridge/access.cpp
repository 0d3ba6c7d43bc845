#include "viewer/bridge/access.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace tern {
namespace {

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// Returns the name before ":port"; a bracketed IPv6 address contains colons of its own.
std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos || host.find(']', colon) != std::string_view::npos) return host;
  return host.substr(0, colon);
}

}  // namespace

Access::Access(std::vector<std::string> names) : names_(std::move(names)) {
  for (const char* name : {"localhost", "127.0.0.1", "[::1]"}) names_.emplace_back(name);
}

bool Access::allows_host(std::string_view host) const {
  const std::string_view name = without_port(host);
  if (name.empty()) return false;
  return std::any_of(names_.begin(), names_.end(), [&](const auto& n) { return equal_ignoring_case(n, name); });
}

bool Access::allows_origin(std::string_view origin, std::string_view host) const {
  constexpr std::string_view kScheme = "http://";
  if (origin.empty()) return true;
  return origin.starts_with(kScheme) && equal_ignoring_case(origin.substr(kScheme.size()), host);
}

}  // namespace tern
