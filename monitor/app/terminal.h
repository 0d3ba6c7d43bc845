// Standard output as a place for one line that changes.
#pragma once

#include <string>

#include "core/base/time.h"

namespace tern {

/// On a terminal the line is rewritten in place, five times a second; elsewhere it is a line of its own every 5 s.
class LiveOutput {
 public:
  LiveOutput();
  /// When show() is due next, at least so long after the last time.
  [[nodiscard]] Duration period() const;
  /// How wide a line may be: the terminal's width, else without limit.
  [[nodiscard]] std::size_t columns() const;
  void show(const std::string& line);
  /// Ends the live line, if there is one, and prints text below it.
  void print(const std::string& text);

 private:
  bool terminal_;
  bool line_open_ = false;
};

}  // namespace tern
