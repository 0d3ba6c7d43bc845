// Descriptors that close themselves, and files read and written whole.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace tern {

/// An open descriptor, which it closes; −1: none.
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

/// Writes all of it. @return the bytes written; fewer than asked for when errno says why.
std::size_t write_all(int fd, std::string_view bytes);

/// @return what the file holds; empty if it cannot be read.
std::string read_text(const std::string& path);

/// Writes a file anew. @return whether all of it could be written
[[nodiscard]] bool write_text(const std::string& path, std::string_view text);

}  // namespace tern
