// The connections of a listening socket, for both servers of the viewer.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace tern {

/// Accepts connections until its context stops.
///
/// While the process has no free descriptor, connections stay in the queue of the socket.
/// The loop then pauses before it tries again. It logs the first error in a row.
class AcceptLoop {
 public:
  static constexpr auto kPause = std::chrono::milliseconds(200);

  /// @param fd    a listening TCP socket; the loop closes it
  /// @param peer  for the log: "a browser"
  /// @param take  receives each connection
  AcceptLoop(boost::asio::io_context& context, int fd, std::string peer,
             std::function<void(boost::asio::ip::tcp::socket)> take);

  /// The number of attempts that failed.
  [[nodiscard]] std::int64_t failures() const { return failures_; }

 private:
  void accept();
  void pause();

  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer timer_;
  std::string peer_;
  std::function<void(boost::asio::ip::tcp::socket)> take_;
  std::int64_t failures_ = 0;
  bool failed_last_ = false;
};

}  // namespace tern
