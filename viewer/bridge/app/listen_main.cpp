// tern-listen ADDRESS[:PORT] COMMAND [ARG...]: opens a listening socket and becomes COMMAND, which inherits it. The
// socket belongs to the namespace in which it was made. So a program in a network namespace can be reached from
// outside.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "viewer/bridge/app/listening_socket.h"

int main(int argc, char** argv) {
  const bool asks_for_help = argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h");
  if (argc < 3) {
    fmt::print(
        asks_for_help ? stdout : stderr,
        "tern-listen ADDRESS[:PORT] COMMAND [ARG...]: opens a listening socket and becomes COMMAND, which inherits "
        "it.\nSets {} and {} for COMMAND.\n",
        tern::kListenFdVariable, tern::kListenUrlVariable);
    return asks_for_help ? 0 : 3;
  }
  const auto fd = tern::open_listening_socket(argv[1], true);
  if (!fd) {
    fmt::print(stderr, "tern-listen: {}\n", fd.error().message);
    return 3;
  }
  setenv(tern::kListenFdVariable, std::to_string(*fd).c_str(), 1);
  setenv(tern::kListenUrlVariable, tern::listening_url(*fd)->c_str(), 1);
  execvp(argv[2], argv + 2);
  fmt::print(stderr, "tern-listen: {}: {}\n", argv[2], std::strerror(errno));
  return 127;
}
