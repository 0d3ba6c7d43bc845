// Whose requests the bridge answers: a page of another site must not reach a vehicle through the user's browser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// Decides by the headers Host and Origin, which a browser sets and a page cannot forge.
///
/// Host must name this machine: a loopback name or address, the address that was bound, or a name that the user
/// allowed. So a foreign name that resolves to 127.0.0.1 (DNS rebinding) is refused. Origin, when there is one, must be
/// the page that this host served, "http://" + Host. So another site's page, or another server's on this machine, is
/// refused. A request without Origin does not come from a page.
class Access {
 public:
  /// @param names  besides "localhost", "127.0.0.1" and "[::1]"; without ports; "" is ignored
  explicit Access(std::vector<std::string> names = {});
  [[nodiscard]] bool allows_host(std::string_view host) const;
  /// @param origin  empty: none was sent
  [[nodiscard]] bool allows_origin(std::string_view origin, std::string_view host) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace tern
