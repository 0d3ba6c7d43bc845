// The socket on which browsers are awaited: opened here, or inherited from who started this process.
#pragma once

#include <string>

#include "core/base/result.h"

namespace tern {

/// Where a bridge waits when it is not told a port: the first that is free of this many from the first.
inline constexpr int kFirstViewPort = 8765;
inline constexpr int kViewPorts = 100;
/// How an inherited socket is named in the environment (tern-listen sets both).
inline constexpr char kListenFdVariable[] = "TERN_LISTEN_FD";
inline constexpr char kListenUrlVariable[] = "TERN_LISTEN_URL";

/// Opens a listening TCP socket, which children inherit only if `inheritable`.
/// @param where  "127.0.0.1", "127.0.0.1:8765", "[::1]:8765"; port 0 is any free port, no port one of ours
Result<int> open_listening_socket(const std::string& where, bool inheritable);

/// "http://127.0.0.1:8765/". An Error when fd is not a listening TCP socket.
Result<std::string> listening_url(int fd);

/// The part of a URL between "http://" and the port: "127.0.0.1".
std::string host_of_url(const std::string& url);

}  // namespace tern
