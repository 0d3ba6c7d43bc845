// Decides which HTTP requests the bridge answers: a page of another site must not reach a vehicle through the user's
// browser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// Checks the headers Host and Origin, which a browser sets and a page cannot forge.
///
/// - Host must name this machine: a loopback name or address, the bound address, or a name that the user allowed. This
///   stops DNS rebinding, where a foreign name resolves to 127.0.0.1.
/// - Origin, if present, must be "http://" + Host: the page that this bridge served. This refuses pages of other sites
///   and of other servers on this machine. A request without Origin does not come from a page.
class Access {
 public:
  /// @param names  hosts allowed in addition to "localhost", "127.0.0.1" and "[::1]", without ports;
  ///   "" has no effect
  explicit Access(std::vector<std::string> names = {});
  [[nodiscard]] bool allows_host(std::string_view host) const;
  /// @param origin  empty: the request has none
  [[nodiscard]] bool allows_origin(std::string_view origin, std::string_view host) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace tern
