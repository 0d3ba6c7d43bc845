#include "runtime/multicast_sockets.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <regex>
#include <set>
#include <utility>

#include "runtime/log.h"

namespace tern {
namespace {

constexpr int kNoInterface = 0;  // for the kernel: the one of the route

int option_of(int socket, int name) {
  int value = -1;
  socklen_t size = sizeof(value);
  return getsockopt(socket, SOL_SOCKET, name, &value, &size) == 0 ? value : -1;
}

bool is_udp(int descriptor) {
  return option_of(descriptor, SO_DOMAIN) == AF_INET && option_of(descriptor, SO_TYPE) == SOCK_DGRAM;
}

std::vector<int> open_descriptors() {
  std::vector<int> descriptors;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    descriptors.push_back(descriptor);
  }
  return descriptors;
}

/// The interfaces that are up and can carry multicast, loopback first: a socket may join only some 20.
std::vector<int> usable_interfaces() {
  std::set<std::pair<bool, int>> found;  // whether it is not loopback, and its index
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return {};
  for (const ifaddrs* of = all; of != nullptr; of = of->ifa_next) {
    const bool is_loopback = (of->ifa_flags & IFF_LOOPBACK) != 0;
    if ((of->ifa_flags & IFF_UP) == 0 || (!is_loopback && (of->ifa_flags & IFF_MULTICAST) == 0)) continue;
    found.emplace(!is_loopback, static_cast<int>(if_nametoindex(of->ifa_name)));
  }
  freeifaddrs(all);
  std::vector<int> indices;
  for (const auto& [is_not_loopback, index] : found) indices.push_back(index);
  return indices;
}

}  // namespace

MulticastSockets::MulticastSockets(const std::string& url) {
  std::smatch parts;
  if (!std::regex_match(url, parts, std::regex(R"(udpm://([0-9.]+):([0-9]+)(\?.*)?)"))) return;
  group_.sin_family = AF_INET;
  group_.sin_port = htons(static_cast<std::uint16_t>(std::stoi(parts[2])));
  if (inet_pton(AF_INET, parts[1].str().c_str(), &group_.sin_addr) != 1) return;
  const std::string options = parts[3];
  std::smatch ttl;
  this_host_only_ = !std::regex_search(options, ttl, std::regex(R"([?&]ttl=([0-9]+))")) || ttl[1] == "0";
  for (const int descriptor : open_descriptors()) {
    sockaddr_in bound{};
    socklen_t size = sizeof(bound);
    if (!is_udp(descriptor) || getsockname(descriptor, reinterpret_cast<sockaddr*>(&bound), &size) != 0) continue;
    (bound.sin_port == group_.sin_port ? receive_ : send_).push_back(descriptor);
  }
}

void MulticastSockets::join(int index) const {
  const ip_mreqn membership{group_.sin_addr, {}, index};
  // It fails if the socket is a member there already.
  for (const int s : receive_) setsockopt(s, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof(membership));
}

bool MulticastSockets::has_route() const {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return true;
  const bool has = connect(probe, reinterpret_cast<const sockaddr*>(&group_), sizeof(group_)) == 0;
  close(probe);
  return has;
}

void MulticastSockets::follow() {
  if (receive_.empty()) return;
  join(kNoInterface);
  if (!this_host_only_) return;
  for (const int index : usable_interfaces()) join(index);
  const bool by_loopback = !has_route();
  if (by_loopback == by_loopback_) return;
  by_loopback_ = by_loopback;
  in_addr from{};
  if (by_loopback) from.s_addr = htonl(INADDR_LOOPBACK);
  const ip_mreqn way{{}, from, by_loopback ? static_cast<int>(if_nametoindex("lo")) : kNoInterface};
  for (const int s : send_) setsockopt(s, IPPROTO_IP, IP_MULTICAST_IF, &way, sizeof(way));
  log::warn("network: {}", by_loopback ? "no multicast route is left, messages go by the loopback interface"
                                       : "there is a multicast route again, messages go by it");
}

void MulticastSockets::join_anew() {
  for (const int index : usable_interfaces()) {
    const ip_mreqn membership{group_.sin_addr, {}, index};
    for (const int s : receive_) setsockopt(s, IPPROTO_IP, IP_DROP_MEMBERSHIP, &membership, sizeof(membership));
  }
  follow();
}

}  // namespace tern
