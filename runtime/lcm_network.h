// Opens LCM, or returns an error with a remedy.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/time.h"

namespace lcm {
class LCM;
}

namespace tern {

/// The default network: this host only. Two hosts need ttl=1 and a multicast route on both.
inline constexpr char kDefaultLcmUrl[] = "udpm://239.255.76.67:7667?ttl=0";
/// The kernel's receive buffer that a process requests, bytes: room for over a hundred of the longest messages.
inline constexpr std::int64_t kReceiveBufferBytes = 8'000'000;

/// The URL that a process uses: `option` if not empty, else `environment` (the value of LCM_DEFAULT_URL, may be null),
/// else kDefaultLcmUrl. A udpm URL without recv_buf_size gets kReceiveBufferBytes.
std::string choose_lcm_url(const std::string& option, const char* environment);

/// Opens LCM. If the URL requests a receive buffer, the granted size is logged, with a warning if it is smaller. The
/// kernel itself cuts it silently at net.core.rmem_max.
/// @return an Error with a remedy if LCM cannot be used.
Result<std::shared_ptr<lcm::LCM>> open_lcm(const std::string& url);

/// Handles up to `limit` waiting messages without blocking. @return the number handled.
/// @param at_most  no further message is begun after this time, by the system's clock
int drain(lcm::LCM& lcm, int limit, std::optional<Duration> at_most = {});

}  // namespace tern
