// Reports to the service manager that started the process.
#pragma once

#include <string>

#include "runtime/node.h"

namespace tern {

/// The other side of systemd's sd_notify(3): `Type=notify` and `WatchdogSec=` of a unit. Without NOTIFY_SOCKET in the
/// environment all calls do nothing.
///
/// A report that the manager does not take at once is lost: a flight does not wait for it.
class ServiceManager {
 public:
  /// @param socket  value of NOTIFY_SOCKET: a path, or @NAME for an abstract socket; null: there is no manager
  explicit ServiceManager(const char* socket);
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  [[nodiscard]] bool exists() const { return fd_ >= 0; }
  /// Says that the process has started and is alive, with the node's state as the status. Call it with each heartbeat:
  /// a node that is stuck sends none.
  void alive(const NodeHealth& health);
  /// Says that the process begins to end.
  void stopping();

 private:
  void send(const std::string& text) const;

  int fd_ = -1;  ///< a connected socket; −1: there is no manager
};

}  // namespace tern
