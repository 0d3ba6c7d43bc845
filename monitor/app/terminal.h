// Standard output with one line that changes.
#pragma once

#include <string>

#include "core/base/time.h"

namespace tern {

/// Prints a live line. On a terminal it is rewritten in place, five times a second; elsewhere a new line is printed
/// every 5 s.
class LiveOutput {
 public:
  LiveOutput();
  /// Least time between two calls of show().
  [[nodiscard]] Duration period() const;
  /// The terminal's width; without a terminal there is no limit.
  [[nodiscard]] std::size_t columns() const;
  void show(const std::string& line);
  /// Ends the live line, if there is one, and prints text below it.
  void print(const std::string& text);

 private:
  bool terminal_;
  bool line_open_ = false;
};

}  // namespace tern
