// A headless browser that does what it is told (Chrome DevTools Protocol, over a pair of pipes).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace tern {

/// One page in a browser of its own, which ends with this.
class Devtools {
 public:
  /// @param program  Chromium, looked up in PATH  @param profile  an empty folder that it may write to
  /// @throws std::runtime_error when it cannot be started or does not answer
  Devtools(const std::string& program, const std::string& profile, int width, int height);
  ~Devtools();
  Devtools(const Devtools&) = delete;
  Devtools& operator=(const Devtools&) = delete;

  /// Opens a page and waits until `ready`, a JavaScript expression, is true. @throws std::runtime_error after 60 s
  void open(const std::string& url, const std::string& ready);
  /// @return what a JavaScript expression comes to. @throws std::runtime_error when it throws
  nlohmann::json evaluate(const std::string& expression);
  /// The page as it is drawn now: a JPEG file's bytes.
  std::string picture();

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
  std::string read_message();

  pid_t browser_ = 0;
  int to_ = -1, from_ = -1;
  std::string unread_, session_;
  std::int64_t calls_ = 0;
};

}  // namespace tern
