#include "mavlink/link/link.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <map>
#include <utility>

#include "core/base/files.h"
#include "mavlink/messages.h"

namespace tern::mavlink {
namespace {

constexpr std::size_t kMaxDatagram = 65'536;
constexpr Duration kPeerSilence{3'000'000};
constexpr std::uint8_t kAutopilotComponent = 1, kInvalidAutopilot = 8;

bool introduces(Peer peer, std::span<const std::uint8_t> bytes) {
  for (const Frame& frame : Parser().push(bytes)) {
    if (peer == Peer::Estimator && frame.id == Odometry::kId) return true;
    if (peer == Peer::Estimator) continue;
    const auto heartbeat = from_frame<Heartbeat>(frame);
    if (heartbeat && frame.from.component == kAutopilotComponent && heartbeat->autopilot != kInvalidAutopilot)
      return true;
  }
  return false;
}

class UdpLink final : public Link {
 public:
  /// @param peer  nullopt: the first of this kind that sends  @param accepts_all  accept datagrams of all senders
  UdpLink(Descriptor socket, std::optional<sockaddr_in> peer, Peer kind, bool accepts_all)
      : socket_(std::move(socket)), peer_(peer), kind_(kind), fixed_(peer.has_value()), accepts_all_(accepts_all) {}

  std::optional<Portion> receive(UTime now) override {
    Portion portion{Bytes(kMaxDatagram), {}};
    while (true) {
      sockaddr_in from{};
      const ssize_t n = receive_into(portion, from);
      if (n < 0) return std::nullopt;
      if (!is_peer(from, std::span(portion.bytes).first(static_cast<std::size_t>(n)), now)) {
        ++strangers_;
        continue;
      }
      last_ = now;
      portion.bytes.resize(static_cast<std::size_t>(n));
      return portion;
    }
  }

  void send(std::span<const std::uint8_t> bytes) override {
    if (!peer_) return;
    sendto(socket_.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&*peer_), sizeof(*peer_));
  }

  [[nodiscard]] bool datagrams() const override { return true; }
  [[nodiscard]] std::int64_t strangers() const override { return strangers_; }

 private:
  bool is_peer(const sockaddr_in& from, std::span<const std::uint8_t> bytes, UTime now) {
    if (accepts_all_) return true;
    const bool same = peer_ && from.sin_port == peer_->sin_port && from.sin_addr.s_addr == peer_->sin_addr.s_addr;
    if (same || fixed_) return same;
    if ((peer_ && now - last_ < kPeerSilence) || !introduces(kind_, bytes)) return false;
    peer_ = from;
    return true;
  }

  ssize_t receive_into(Portion& portion, sockaddr_in& from) const {
    iovec place{portion.bytes.data(), portion.bytes.size()};
    alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(timeval))> control{};
    msghdr message{};
    message.msg_name = &from;
    message.msg_namelen = sizeof(from);
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t n = recvmsg(socket_.get(), &message, 0);
    portion.unix_us.reset();
    const cmsghdr* const head = n < 0 ? nullptr : CMSG_FIRSTHDR(&message);
    if (head != nullptr && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SCM_TIMESTAMP) {
      timeval came{};
      std::memcpy(&came, CMSG_DATA(head), sizeof(came));
      portion.unix_us = std::int64_t{came.tv_sec} * 1'000'000 + came.tv_usec;
    }
    return n;
  }

  Descriptor socket_;
  std::optional<sockaddr_in> peer_;
  Peer kind_;
  bool fixed_, accepts_all_;
  UTime last_;
  std::int64_t strangers_ = 0;
};

Result<Descriptor> open_port(const std::string& path, speed_t speed) {
  Descriptor port(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (port.get() < 0) return fail(std::strerror(errno));
  termios settings{};
  if (tcgetattr(port.get(), &settings) != 0) return fail(std::string("no serial port: ") + std::strerror(errno));
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
  cfsetspeed(&settings, speed);
  if (tcsetattr(port.get(), TCSANOW, &settings) != 0) return fail(std::strerror(errno));
  return port;
}

class SerialLink final : public Link {
 public:
  SerialLink(std::string path, speed_t speed, Descriptor port)
      : path_(std::move(path)), speed_(speed), port_(std::move(port)) {}

  std::optional<Portion> receive(UTime now) override {
    if (port_.get() < 0) reopen(now);
    if (port_.get() < 0) return std::nullopt;
    Bytes bytes(4096);
    const ssize_t n = read(port_.get(), bytes.data(), bytes.size());
    // EAGAIN: no bytes at present. End of file or another error: the port is gone.
    if (n == 0 || (n < 0 && is_gone())) lose(n == 0 ? "end of file" : std::strerror(errno), now);
    if (n <= 0) return std::nullopt;
    bytes.resize(static_cast<std::size_t>(n));
    return Portion{std::move(bytes), {}};
  }

  /// Sends the rest of the last frame first. If the port does not take it whole, the new frame is lost.
  void send(std::span<const std::uint8_t> bytes) override {
    if (port_.get() < 0) return;
    rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(put(rest_)));
    if (!rest_.empty()) return;
    const std::size_t n = put(bytes);
    if (n > 0) rest_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(n), bytes.end());
  }

  [[nodiscard]] bool datagrams() const override { return false; }
  std::vector<std::string> take_log_lines() override { return std::exchange(log_lines_, {}); }

 private:
  static bool is_gone() { return errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR; }

  std::size_t put(std::span<const std::uint8_t> bytes) const {
    const ssize_t n = bytes.empty() ? 0 : write(port_.get(), bytes.data(), bytes.size());
    return n < 0 ? 0 : static_cast<std::size_t>(n);
  }

  void lose(const std::string& why, UTime now) {
    log_lines_.push_back(fmt::format("{}: {}: waiting for the port to come back", path_, why));
    port_ = Descriptor();
    rest_.clear();
    pause_ = kFirstPause;
    next_ = now + pause_;
  }

  void reopen(UTime now) {
    if (now < next_) return;
    auto port = open_port(path_, speed_);
    if (port) {
      port_ = std::move(*port);
      log_lines_.push_back(path_ + ": opened again");
      return;
    }
    pause_ = std::min(Duration{2 * pause_.us}, kLastPause);
    next_ = now + pause_;
  }

  static constexpr Duration kFirstPause{50'000}, kLastPause{1'000'000};
  std::string path_;
  speed_t speed_;
  Descriptor port_;
  Bytes rest_;  ///< of a frame that was sent in part
  UTime next_;  ///< time of the next attempt to open the port
  Duration pause_{};
  std::vector<std::string> log_lines_;
};

/// The last ":NUMBER" of a text, and what is before it.
std::optional<std::pair<std::string, int>> split(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  int number = -1;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data() + colon + 1, end, number);
  if (error != std::errc() || at != end || number <= 0) return std::nullopt;
  return std::pair(text.substr(0, colon), number);
}

std::optional<sockaddr_in> address_of(const std::string& place) {
  const auto parts = split(place);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (!parts || parts->second > 65535 || inet_pton(AF_INET, parts->first.c_str(), &address.sin_addr) != 1) return {};
  address.sin_port = htons(static_cast<std::uint16_t>(parts->second));
  return address;
}

/// @param here  own address; nullopt: any port  @param there  the peer; nullopt: the first of this kind that sends
Result<std::unique_ptr<Link>> open_udp(const std::string& url, const std::optional<std::string>& here,
                                       const std::optional<std::string>& there, Peer kind) {
  const auto own = here ? address_of(*here) : std::nullopt, peer = there ? address_of(*there) : std::nullopt;
  if ((here && !own) || (there && !peer)) return fail(url + ": not ADDRESS:PORT with a numeric IPv4 address");
  Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return fail(url + ": " + std::strerror(errno));
  const int stamped = 1;
  setsockopt(socket.get(), SOL_SOCKET, SO_TIMESTAMP, &stamped, sizeof(stamped));
  if (own && bind(socket.get(), reinterpret_cast<const sockaddr*>(&*own), sizeof(*own)) != 0) {
    return fail(fmt::format("{}: {}{}", url, std::strerror(errno),
                            errno == EADDRINUSE ? ": another bridge or ground station listens there" : ""));
  }
  return std::make_unique<UdpLink>(std::move(socket), peer, kind, !own);
}

Result<std::unique_ptr<Link>> open_serial(const std::string& url, const std::string& place) {
  static const std::map<int, speed_t> kSpeeds{{57600, B57600},     {115200, B115200},   {230400, B230400},
                                              {460800, B460800},   {500000, B500000},   {921600, B921600},
                                              {1000000, B1000000}, {1500000, B1500000}, {3000000, B3000000}};
  const auto parts = split(place);
  const auto speed = parts ? kSpeeds.find(parts->second) : kSpeeds.end();
  if (speed == kSpeeds.end()) return fail(url + ": not /dev/NAME:BAUD with a usual baud rate of 57600 or more");
  auto port = open_port(parts->first, speed->second);
  if (!port) return fail(url + ": " + port.error().message);
  return std::make_unique<SerialLink>(parts->first, speed->second, std::move(*port));
}

}  // namespace

Result<std::unique_ptr<Link>> open_link(const std::string& url, Peer peer) {
  const auto after = [&](const std::string& scheme) -> std::optional<std::string> {
    if (!url.starts_with(scheme)) return std::nullopt;
    return url.substr(scheme.size());
  };
  if (const auto place = after("udp://")) {
    const std::size_t at = place->find('@');
    if (at == std::string::npos) return open_udp(url, *place, {}, peer);
    return open_udp(url, place->substr(0, at), place->substr(at + 1), peer);
  }
  if (const auto place = after("udpout://")) return open_udp(url, {}, *place, peer);
  if (const auto place = after("serial://")) return open_serial(url, *place);
  return fail(url + ": neither udp://, udpout:// nor serial://");
}

}  // namespace tern::mavlink
