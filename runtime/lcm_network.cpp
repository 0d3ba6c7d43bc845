#include "runtime/lcm_network.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <string_view>

#include "runtime/log.h"

namespace tern {
namespace {

constexpr std::string_view kBufferKey = "recv_buf_size=";

bool is_udpm(std::string_view url) { return url.starts_with("udpm://"); }

std::optional<int> requested_buffer(std::string_view url) {
  const std::size_t at = url.find(kBufferKey);
  if (!is_udpm(url) || at == std::string_view::npos) return std::nullopt;
  int bytes = 0;
  const auto [rest, error] = std::from_chars(url.data() + at + kBufferKey.size(), url.data() + url.size(), bytes);
  if (error != std::errc{}) return std::nullopt;
  return bytes;
}

/// The receive buffer that the kernel grants for a request, measured on a socket of ours because LCM's is not
/// accessible. The kernel reports twice the granted size; the other half is for its own bookkeeping.
std::optional<int> granted_buffer(int requested) {
  const int probe = socket(AF_INET, SOCK_DGRAM, 0);
  if (probe < 0) return std::nullopt;
  int granted = 0;
  socklen_t size = sizeof(granted);
  const bool ok = setsockopt(probe, SOL_SOCKET, SO_RCVBUF, &requested, sizeof(requested)) == 0 &&
                  getsockopt(probe, SOL_SOCKET, SO_RCVBUF, &granted, &size) == 0;
  close(probe);
  if (!ok) return std::nullopt;
  return granted / 2;
}

void report_buffer(const std::string& url) {
  const auto requested = requested_buffer(url);
  if (!requested) return;
  const auto granted = granted_buffer(*requested);
  if (!granted) {
    log::warn("LCM receive buffer: {} bytes requested, the granted size is unknown", *requested);
  } else if (*granted < *requested) {
    log::warn("LCM receive buffer: {} bytes requested, {} granted (more: sysctl -w net.core.rmem_max={})", *requested,
              *granted, *requested);
  } else {
    log::info("LCM receive buffer: {} bytes granted", *granted);
  }
}

}  // namespace

std::string choose_lcm_url(const std::string& option, const char* environment) {
  std::string url = option;
  if (url.empty() && environment != nullptr) url = environment;
  if (url.empty()) url = kDefaultLcmUrl;
  if (!is_udpm(url) || url.find(kBufferKey) != std::string::npos) return url;
  return fmt::format("{}{}{}{}", url, url.find('?') == std::string::npos ? '?' : '&', kBufferKey, kReceiveBufferBytes);
}

Result<std::shared_ptr<lcm::LCM>> open_lcm(const std::string& url) {
  auto lcm = std::make_shared<lcm::LCM>(url);
  // getFileno() sets up reception and tests it once, which finds hosts that can send but not receive.
  if (!lcm->good() || lcm->getFileno() < 0) {
    return fail(
        fmt::format("LCM cannot use {}. If this host has no multicast route, give it one: "
                    "`ip link set lo multicast on up; ip route add 224.0.0.0/4 dev lo` as root, or run inside "
                    "`unshare -Urn` with the same two commands (docs/howto/troubleshooting.md).",
                    url));
  }
  report_buffer(url);
  return lcm;
}

int drain(lcm::LCM& lcm, int limit, std::optional<Duration> at_most) {
  using Steady = std::chrono::steady_clock;
  const auto end = at_most ? Steady::now() + std::chrono::microseconds(at_most->us) : Steady::time_point::max();
  int handled = 0;
  while (handled < limit && lcm.handleTimeout(0) > 0) {
    ++handled;
    if (at_most && Steady::now() >= end) break;
  }
  return handled;
}

}  // namespace tern
