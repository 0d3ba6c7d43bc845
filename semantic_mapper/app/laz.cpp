#include "semantic_mapper/app/laz.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>

#include "core/base/files.h"
#include "core/base/plain_text.h"
#include "runtime/child_process.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

/// Bytes of standard error that are kept: the last ones.
constexpr std::size_t kMaxSaid = 4096;
/// Longest reason of tern-unlaz in an error.
constexpr std::size_t kMaxReason = 200;

/// The output of a child process.
struct Output {
  std::vector<std::uint8_t> points;  ///< standard output
  std::string said;                  ///< the end of standard error
};

struct Pipe {
  Descriptor from, to;
};

Pipe make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// Appends what can be read. @return false at the end
template <class Bytes>
bool read_some(int fd, Bytes& bytes) {
  std::array<typename Bytes::value_type, 65536> buffer;
  const ssize_t n = read(fd, buffer.data(), buffer.size());
  if (n > 0) bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + n);
  return n > 0 || (n < 0 && errno == EINTR);
}

/// Reads both pipes to their ends, or until the output is longer than `max_bytes`.
Output read_output(int points, int said, std::size_t max_bytes) {
  Output output;
  std::array<pollfd, 2> ends{{{points, POLLIN, 0}, {said, POLLIN, 0}}};
  while ((ends[0].fd >= 0 || ends[1].fd >= 0) && output.points.size() <= max_bytes) {
    if (poll(ends.data(), ends.size(), -1) < 0) continue;  // a signal
    if (ends[0].revents != 0 && !read_some(points, output.points)) ends[0].fd = -1;
    if (ends[1].revents != 0 && !read_some(said, output.said)) ends[1].fd = -1;
    if (output.said.size() > kMaxSaid) output.said.erase(0, output.said.size() - kMaxSaid);
  }
  return output;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t before = text.find_last_of('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return plain_text(text.substr(begin, end + 1 - begin), kMaxReason);
}

/// Returns why the child gave no points; "" if it ended well.
std::string why_not(const ProcessEnd& end, const Output& output) {
  if (end.signal == SIGXCPU) return fmt::format("tern-unlaz needed more than {} s of CPU time", kUnlazCpuLimitS);
  if (end.signal != 0) {
    return fmt::format("tern-unlaz crashed (signal {}): the file is damaged, or LASzip has a defect", end.signal);
  }
  if (end.exit_code == 0) return "";
  const std::string reason = last_line(output.said);
  return reason.empty() ? fmt::format("tern-unlaz ended with exit code {}", end.exit_code) : reason;
}

}  // namespace

std::string unlaz_program() {
  std::error_code ignored;
  return (fs::read_symlink("/proc/self/exe", ignored).parent_path() / "tern-unlaz").string();
}

Result<std::vector<std::uint8_t>> decompress_laz(const std::string& file, const std::string& program,
                                                 std::size_t max_bytes) {
  std::error_code ignored;
  if (!fs::exists(program, ignored)) {
    return fail(
        fmt::format("{}: compressed (LAZ) points, and Tern was built without LASzip (there is no {}). On Debian 13 "
                    "install liblaszip-dev and build again; elsewhere decompress the file first, as by "
                    "`pdal translate FILE.laz FILE.las`",
                    file, program));
  }
  Pipe points = make_pipe(), said = make_pipe();
  const pid_t child = start_child({.command = {program, fs::absolute(file).string()},
                                   .out = points.to.get(),
                                   .error = said.to.get(),
                                   .cpu_limit_s = kUnlazCpuLimitS,
                                   .memory_limit_bytes = kUnlazMemoryLimitBytes});
  points.to = Descriptor();
  said.to = Descriptor();
  Output output = read_output(points.from.get(), said.from.get(), max_bytes);
  const bool is_too_long = output.points.size() > max_bytes;
  if (is_too_long) kill(child, SIGKILL);
  const std::string reason = why_not(await_child(child), output);
  if (is_too_long) return fail(fmt::format("{}: more than {} bytes when decompressed (limit)", file, max_bytes));
  if (!reason.empty()) return fail(fmt::format("{}: {}", file, reason));
  return std::move(output.points);
}

}  // namespace tern
