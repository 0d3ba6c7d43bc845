#include "core/scenario/setting.h"

#include <algorithm>
#include <sstream>

namespace tern {

std::string setting(const std::string& yaml, std::string_view path) {
  std::size_t depth = 0;  ///< of the key that is looked for
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || indent > depth) continue;
    if (indent < depth) return "";  ///< the section has ended
    const std::string_view wanted = path.substr(0, path.find('.'));
    const std::string_view text = std::string_view(line).substr(indent);
    if (!text.starts_with(wanted) || text.substr(wanted.size()).substr(0, 1) != ":") continue;
    if (wanted.size() == path.size()) return std::string(text.substr(std::min(wanted.size() + 2, text.size())));
    path.remove_prefix(wanted.size() + 1);
    depth += 2;
  }
  return "";
}

}  // namespace tern
