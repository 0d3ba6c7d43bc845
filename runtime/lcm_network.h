// Opening LCM so that it either works or says what to do.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"

namespace lcm {
class LCM;
}

namespace tern {

/// This host only; two hosts need ttl=1 and a multicast route on both.
inline constexpr char kDefaultLcmUrl[] = "udpm://239.255.76.67:7667?ttl=0";
/// What a process asks for of the kernel's receive buffer, bytes: over a hundred of the longest messages.
inline constexpr std::int64_t kReceiveBufferBytes = 8'000'000;

/// The URL that a process uses: `option` if not empty, else LCM_DEFAULT_URL's value (`environment`, may be null), else
/// kDefaultLcmUrl; a udpm URL without recv_buf_size gets kReceiveBufferBytes.
std::string choose_lcm_url(const std::string& option, const char* environment);

/// Opens LCM. Logs the receive buffer that the kernel grants where the URL asks for one, as a warning when it is less.
/// (The kernel cuts it silently at net.core.rmem_max.)
/// @return an Error that says what to do when LCM cannot be used.
Result<std::shared_ptr<lcm::LCM>> open_lcm(const std::string& url);

/// Handles the messages that wait, at most `limit` of them, without blocking. @return how many were handled.
int drain(lcm::LCM& lcm, int limit);

}  // namespace tern
