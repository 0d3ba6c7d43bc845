// The built page, in memory: what is not in this table cannot be asked for.
#pragma once

#include <map>
#include <string>

#include "core/base/result.h"

namespace tern {

struct PageFile {
  std::string type;  ///< "text/html; charset=utf-8"
  std::string bytes;
};

/// By URL path, "/index.html"; "/" is the index.
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// Reads a folder that Vite built. Without an index.html there: one page that says how it is built. An Error when a
/// file cannot be read or all together are more than 50 MB.
Result<PageFiles> load_page(const std::string& folder);

/// Where the page lies when nobody says. Of an installed program, PREFIX/bin/tern-viewer:
/// PREFIX/share/tern/viewer-page; of one in a build tree, build/release/bin/tern-viewer: build/viewer-page, where
/// view_page.sh builds it.
std::string default_page_folder();

}  // namespace tern
