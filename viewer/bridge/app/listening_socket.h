// The socket that browsers connect to: opened by this process, or inherited from its parent.
#pragma once

#include <string>

#include "core/base/result.h"

namespace tern {

/// Ports to try if none is given: the first free one of kViewPorts, beginning with kFirstViewPort.
inline constexpr int kFirstViewPort = 8765;
inline constexpr int kViewPorts = 100;
/// Environment variables that pass on an inherited socket and its URL; tern-listen sets both.
inline constexpr char kListenFdVariable[] = "TERN_LISTEN_FD";
inline constexpr char kListenUrlVariable[] = "TERN_LISTEN_URL";

/// Opens a listening TCP socket. Child processes inherit it only if `inheritable`.
/// @param where  "127.0.0.1", "127.0.0.1:8765", "[::1]:8765". Port 0 takes any free port; without a port, kViewPorts
/// are tried
Result<int> open_listening_socket(const std::string& where, bool inheritable);

/// Returns "http://127.0.0.1:8765/", or an Error if fd is not a listening TCP socket.
Result<std::string> listening_url(int fd);

/// Returns true if fd is bound to an IPv6 address. Boost.Asio asks when it takes over a socket.
bool is_ipv6_socket(int fd);

/// Returns the part of a URL between "http://" and the port: "127.0.0.1".
std::string host_of_url(const std::string& url);

}  // namespace tern
