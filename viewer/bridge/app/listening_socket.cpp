#include "viewer/bridge/app/listening_socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

namespace tern {
namespace {

struct Address {
  sockaddr_storage storage{};
  socklen_t length = 0;

  sockaddr* raw() { return reinterpret_cast<sockaddr*>(&storage); }
  [[nodiscard]] sockaddr_in& v4() { return reinterpret_cast<sockaddr_in&>(storage); }
  [[nodiscard]] sockaddr_in6& v6() { return reinterpret_cast<sockaddr_in6&>(storage); }
};

std::optional<Address> make_address(const std::string& host, int port) {
  Address a;
  const auto network_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, host.c_str(), &a.v4().sin_addr) == 1) {
    a.v4().sin_family = AF_INET;
    a.v4().sin_port = network_port;
    a.length = sizeof(sockaddr_in);
    return a;
  }
  if (host.size() > 2 && host.front() == '[' && host.back() == ']' &&
      inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), &a.v6().sin6_addr) == 1) {
    a.v6().sin6_family = AF_INET6;
    a.v6().sin6_port = network_port;
    a.length = sizeof(sockaddr_in6);
    return a;
  }
  return std::nullopt;
}

/// Opens a listening socket. @return the socket, or −1 with errno set.
int try_listen(Address address, bool inheritable) {
  const int fd = socket(address.storage.ss_family, SOCK_STREAM | (inheritable ? 0 : SOCK_CLOEXEC), 0);
  if (fd < 0) return -1;
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(fd, address.raw(), address.length) == 0 && listen(fd, SOMAXCONN) == 0) return fd;
  const int error = errno;
  close(fd);
  errno = error;
  return -1;
}

}  // namespace

Result<int> open_listening_socket(const std::string& where, bool inheritable) {
  std::string host = where;
  int first = kFirstViewPort, last = kFirstViewPort + kViewPorts - 1;
  const std::size_t colon = where.rfind(':');
  if (colon != std::string::npos && where.find(']', colon) == std::string::npos) {
    host = where.substr(0, colon);
    const std::string port = where.substr(colon + 1);
    if (port.empty() || port.size() > 5 || port.find_first_not_of("0123456789") != std::string::npos ||
        std::stoi(port) > 65535) {
      return fail(fmt::format("{}: the port is not 0 ... 65535", where));
    }
    first = last = std::stoi(port);
  }
  for (int port = first; port <= last; ++port) {
    const auto address = make_address(host, port);
    if (!address) return fail(fmt::format("{}: not an address (127.0.0.1, [::1], optionally with :PORT)", where));
    const int fd = try_listen(*address, inheritable);
    if (fd >= 0) return fd;
    if (errno != EADDRINUSE) break;
  }
  return fail(fmt::format("{}: cannot listen there: {}", where, std::strerror(errno)));
}

Result<std::string> listening_url(int fd) {
  int listens = 0;
  socklen_t length = sizeof listens;
  Address address;
  address.length = sizeof address.storage;
  if (getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) != 0 || listens == 0 ||
      getsockname(fd, address.raw(), &address.length) != 0) {
    return fail(fmt::format("descriptor {} is not a listening socket", fd));
  }
  char text[INET6_ADDRSTRLEN] = {};
  if (address.storage.ss_family == AF_INET) {
    inet_ntop(AF_INET, &address.v4().sin_addr, text, sizeof text);
    return fmt::format("http://{}:{}/", text, ntohs(address.v4().sin_port));
  }
  if (address.storage.ss_family == AF_INET6) {
    inet_ntop(AF_INET6, &address.v6().sin6_addr, text, sizeof text);
    return fmt::format("http://[{}]:{}/", text, ntohs(address.v6().sin6_port));
  }
  return fail(fmt::format("descriptor {} is not a TCP socket", fd));
}

bool is_ipv6_socket(int fd) {
  Address address;
  address.length = sizeof address.storage;
  return getsockname(fd, address.raw(), &address.length) == 0 && address.storage.ss_family == AF_INET6;
}

std::string host_of_url(const std::string& url) {
  const std::size_t begin = url.find("//") + 2;
  return url.substr(begin, url.rfind(':') - begin);
}

}  // namespace tern
