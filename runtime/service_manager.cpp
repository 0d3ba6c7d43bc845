#include "runtime/service_manager.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/log.h"

namespace tern {
namespace {

std::string words(const NodeHealth& health) {
  switch (health.state) {
    case ProcessState::Starting: return "starting";
    case ProcessState::Waiting: return "waits: " + health.waiting_for;
    case ProcessState::Ready: return "ready";
    case ProcessState::Finished: return "finished";
    case ProcessState::Failed: break;
  }
  return "failed: " + health.waiting_for;
}

/// Returns a socket that is connected to the manager's, or −1 with errno.
int connected(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() < 2 || (name[0] != '/' && name[0] != '@') || name.size() >= sizeof(address.sun_path)) {
    errno = EINVAL;
    return -1;
  }
  std::memcpy(address.sun_path, name.data(), name.size());
  if (name[0] == '@') address.sun_path[0] = '\0';
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (fd < 0 || connect(fd, reinterpret_cast<const sockaddr*>(&address), length) == 0) return fd;
  const int error = errno;
  close(fd);
  errno = error;
  return -1;
}

}  // namespace

ServiceManager::ServiceManager(const char* socket) {
  if (socket == nullptr || *socket == '\0') return;
  fd_ = connected(socket);
  if (fd_ < 0) log::warn("NOTIFY_SOCKET={}: {}; the service manager hears nothing", socket, std::strerror(errno));
}

ServiceManager::~ServiceManager() {
  if (fd_ >= 0) close(fd_);
}

void ServiceManager::alive(const NodeHealth& health) {
  if (fd_ >= 0) send(fmt::format("READY=1\nWATCHDOG=1\nSTATUS={}", words(health)));
}

void ServiceManager::stopping() {
  if (fd_ >= 0) send("STOPPING=1");
}

void ServiceManager::send(const std::string& text) const { (void)::send(fd_, text.data(), text.size(), MSG_NOSIGNAL); }

}  // namespace tern
