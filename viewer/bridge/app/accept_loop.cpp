#include "viewer/bridge/app/accept_loop.h"

#include <utility>

#include "runtime/log.h"
#include "viewer/bridge/app/listening_socket.h"

namespace tern {

using boost::asio::ip::tcp;

AcceptLoop::AcceptLoop(boost::asio::io_context& context, int fd, std::string peer,
                       std::function<void(tcp::socket)> take)
    : acceptor_(context), timer_(context), peer_(std::move(peer)), take_(std::move(take)) {
  acceptor_.assign(is_ipv6_socket(fd) ? tcp::v6() : tcp::v4(), fd);
  accept();
}

void AcceptLoop::accept() {
  acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
    if (error == boost::asio::error::operation_aborted) return;
    if (error) {
      if (!failed_last_) log::warn("{} could not be accepted, which is tried again: {}", peer_, error.message());
      failed_last_ = true;
      ++failures_;
      pause();
      return;
    }
    failed_last_ = false;
    take_(std::move(socket));
    accept();
  });
}

void AcceptLoop::pause() {
  timer_.expires_after(kPause);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) accept();
  });
}

}  // namespace tern
