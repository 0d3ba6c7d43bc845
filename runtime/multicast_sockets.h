// Keeps LCM's multicast sockets hearing and sending while interfaces and routes change.
#pragma once

#include <netinet/in.h>

#include <string>
#include <vector>

namespace tern {

/// The UDP sockets of this process's LCM instance. LCM joins its group on one interface, the one that the route then
/// leads to, and sends wherever the route leads. If the route moves, as when Wi-Fi is lost, its processes send on an
/// interface where none of them listens.
///
/// | URL         | joined on                                | sends                              |
/// |-------------|------------------------------------------|------------------------------------|
/// | udpm, ttl=0 | loopback and all interfaces that are up  | by the route; without it, by lo    |
/// | udpm, ttl>0 | the interface of the route               | by the route                       |
/// | other       | nothing                                  | as LCM does                        |
///
/// With ttl=0 messages stay on this host on whatever interface they are sent. Needs no privileges. Other LCM programs
/// on this host hear these processes wherever the route leads.
class MulticastSockets {
 public:
  /// Finds LCM's sockets. @pre LCM was just opened with this URL, and the process has no other UDP sockets
  explicit MulticastSockets(const std::string& url);
  /// Adapts to the present interfaces and routes: some 50 µs. Logs when it changes the way of sending.
  void follow();
  /// Leaves the group and joins it again: for a process that no longer hears itself.
  void join_anew();

 private:
  void join(int index) const;
  [[nodiscard]] bool has_route() const;

  sockaddr_in group_{};
  bool this_host_only_ = false;
  bool by_loopback_ = false;
  std::vector<int> receive_, send_;  // descriptors, owned by LCM; empty: not udpm
};

}  // namespace tern
