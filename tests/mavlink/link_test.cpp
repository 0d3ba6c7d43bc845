#include "mavlink/link/link.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/files.h"
#include "mavlink/messages.h"

namespace tern::mavlink {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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

/// A serial cable: the autopilot's end, and a name for the other end that stays when the plug is pulled.
class Cable {
 public:
  Cable() : folder_(std::filesystem::temp_directory_path() / ("tern_cable_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    plug_in();
  }
  ~Cable() { std::filesystem::remove_all(folder_); }
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;
  void plug_in() {
    end_ = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (grantpt(end_.get()) != 0 || unlockpt(end_.get()) != 0) throw std::runtime_error("posix_openpt");
    std::filesystem::create_symlink(ptsname(end_.get()), folder_ / "port");
  }
  void pull() {
    std::filesystem::remove(folder_ / "port");
    end_ = Descriptor();
  }
  [[nodiscard]] std::string url() const { return "serial://" + (folder_ / "port").string() + ":57600"; }
  void say(const Bytes& bytes) const { ASSERT_EQ(write(end_.get(), bytes.data(), bytes.size()), std::ssize(bytes)); }
  [[nodiscard]] Bytes heard() const {
    Bytes all, some(4096);
    for (ssize_t n = 0; (n = read(end_.get(), some.data(), some.size())) > 0;) {
      all.insert(all.end(), some.begin(), some.begin() + n);
    }
    return all;
  }

 private:
  std::filesystem::path folder_;
  Descriptor end_;
};

TEST(Link, ASerialPortThatIsPulledIsOpenedAgainWhenItIsBack) {
  Cable cable;
  auto link = open_link(cable.url());
  ASSERT_TRUE(link) << link.error().message;
  const Bytes hello{1, 2, 3};
  cable.say(hello);
  const auto heard = (*link)->receive(UTime{0});
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->bytes, hello);
  cable.pull();
  UTime now{0};
  const auto look = [&](int times) {
    std::optional<Portion> portion;
    for (int k = 0; k < times && !portion; ++k) {
      now = now + Duration{2'000};
      (*link)->send(hello);
      portion = (*link)->receive(now);
    }
    return portion;
  };
  EXPECT_FALSE(look(2'000));
  EXPECT_THAT((*link)->take_log_lines(), ElementsAre(HasSubstr("waiting for the port to come back")));
  cable.plug_in();
  EXPECT_FALSE(look(600)) << "nothing has come yet, but it looks at least once a second";
  EXPECT_THAT((*link)->take_log_lines(), ElementsAre(HasSubstr("opened again")));
  cable.say(hello);
  EXPECT_TRUE(look(1));
  EXPECT_FALSE(cable.heard().empty());
}

TEST(Link, ASerialPortThatIsFullLosesWholeFrames) {
  Cable cable;
  auto link = open_link(cable.url());
  ASSERT_TRUE(link) << link.error().message;
  const auto frame = [](std::uint8_t k) {
    return to_bytes(to_frame(StatusText{.text = text_of<50>(std::string(37, 'x'))}, {1, 1}, k));
  };
  const std::size_t length = frame(0).size();
  Bytes all;
  int sent = 0;
  for (int turn = 0; turn < 3; ++turn) {
    for (int k = 0; k < 3'000; ++k) (*link)->send(frame(static_cast<std::uint8_t>(sent++)));
    for (int k = 0; k < 20; ++k) {  // the buffer has room again
      const Bytes some = cable.heard();
      all.insert(all.end(), some.begin(), some.end());
      (*link)->send(frame(static_cast<std::uint8_t>(sent++)));
    }
  }
  const std::size_t heard = Parser().push(all).size();
  EXPECT_LT(heard, static_cast<std::size_t>(sent)) << "or else this shows nothing";
  EXPECT_EQ(heard, all.size() / length) << "every byte is of a whole frame";
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
