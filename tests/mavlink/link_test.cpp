#include "mavlink/link/link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace tern::mavlink {
namespace {

/// A UDP socket of this host.
class Peer {
 public:
  Peer() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address_);
    if (bind(fd_, reinterpret_cast<sockaddr*>(&address_), length) != 0) throw std::runtime_error("bind");
    getsockname(fd_, reinterpret_cast<sockaddr*>(&address_), &length);
  }
  ~Peer() { close(fd_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  [[nodiscard]] std::string place() const { return "127.0.0.1:" + std::to_string(ntohs(address_.sin_port)); }
  /// Waits for a datagram. @return the place it came from
  std::string receive() {
    sockaddr_in from{};
    socklen_t length = sizeof(from);
    std::uint8_t byte = 0;
    recvfrom(fd_, &byte, 1, 0, reinterpret_cast<sockaddr*>(&from), &length);
    return "127.0.0.1:" + std::to_string(ntohs(from.sin_port));
  }
  void send(const Peer& to) const { send(to.address_); }
  void send(const std::string& place) const {
    sockaddr_in to = address_;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.find(':') + 1))));
    send(to);
  }

 private:
  void send(const sockaddr_in& to) const {
    const std::uint8_t byte = 1;
    sendto(fd_, &byte, 1, 0, reinterpret_cast<const sockaddr*>(&to), sizeof(to));
  }
  int fd_;
  sockaddr_in address_{};
};

/// A port that was free just now.
std::string free_place() { return Peer().place(); }

TEST(Link, SpeaksFirstFromAPortOfItsOwnAndHearsItsPeerAlone) {
  Peer autopilot;
  const std::string own = free_place(), url = "udp://" + own + "@" + autopilot.place();
  auto link = open_link(url);
  ASSERT_TRUE(link) << link.error().message;
  const Bytes hello{1};
  (*link)->send(hello);
  EXPECT_EQ(autopilot.receive(), own);
  const Peer stranger;
  stranger.send(own);
  autopilot.send(own);
  ASSERT_TRUE((*link)->receive(UTime{0}));
  EXPECT_FALSE((*link)->receive(UTime{0}));
  EXPECT_EQ((*link)->strangers(), 1);
}

TEST(Link, RefusesPlacesThatAreNone) {
  for (const char* url :
       {"udp://", "udp://127.0.0.1", "udp://@127.0.0.1:14580", "udp://127.0.0.1:14540@",
        "udp://0.0.0.0:14540@host:14580", "udpout://", "udpout://127.0.0.1:70000", "tcp://1.2.3.4:5"}) {
    EXPECT_FALSE(open_link(url)) << url;
  }
}

}  // namespace
}  // namespace tern::mavlink
