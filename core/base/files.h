// File descriptors that close themselves, and functions that read or write a whole file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace tern {

/// Owns a file descriptor and closes it. −1 means that there is none.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

/// Writes all of `bytes` to `fd`; it goes on after short writes and interrupts.
/// @return the number of bytes written; if it is less than bytes.size(), errno holds the reason
std::size_t write_all(int fd, std::string_view bytes);

/// Returns the content of a file, or an empty text if it cannot be read.
std::string read_text(const std::string& path);

/// Replaces the content of a file. @return true if all of it was written
[[nodiscard]] bool write_text(const std::string& path, std::string_view text);

}  // namespace tern
