#include "viewer/bridge/app/accept_loop.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <vector>

#include "viewer/bridge/app/listening_socket.h"

namespace tern {
namespace {

using boost::asio::ip::tcp;

/// Takes all descriptors that the process may have, until it is destroyed.
class NoDescriptors {
 public:
  NoDescriptors() {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit few = before_;
    few.rlim_cur = 256;
    setrlimit(RLIMIT_NOFILE, &few);
    for (int fd = dup(STDERR_FILENO); fd >= 0; fd = dup(STDERR_FILENO)) taken_.push_back(fd);
  }
  ~NoDescriptors() {
    for (const int fd : taken_) close(fd);
    setrlimit(RLIMIT_NOFILE, &before_);
  }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit before_{};
  std::vector<int> taken_;
};

TEST(AcceptLoop, PausesWithoutDescriptorsAndAcceptsTheWaitingConnectionLater) {
  const auto fd = open_listening_socket("127.0.0.1:0", false);
  ASSERT_TRUE(fd);
  const std::string url = *listening_url(*fd);
  boost::asio::io_context context{1};
  int accepted = 0;
  const AcceptLoop loop(context, *fd, "a test", [&accepted](const tcp::socket&) { ++accepted; });

  tcp::socket client(context);
  client.open(tcp::v4());
  const auto port = static_cast<unsigned short>(std::stoi(url.substr(url.rfind(':') + 1)));
  {
    const NoDescriptors exhausted;
    client.connect({boost::asio::ip::address_v4::loopback(), port});
    // The first failure; then, however long the handlers run, nothing but the timer may be ready.
    while (loop.failures() == 0) context.run_one();
    EXPECT_EQ(context.poll(), 0U) << "the loop does not try again at once";
    EXPECT_EQ(accepted, 0);
  }
  while (accepted == 0) context.run_one();
  EXPECT_EQ(accepted, 1);
}

}  // namespace
}  // namespace tern
