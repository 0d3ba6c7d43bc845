// The files of the built page, in memory. The server serves nothing else.
#pragma once

#include <map>
#include <string>

#include "core/base/result.h"

namespace tern {

/// One file of the page.
struct PageFile {
  std::string type;  ///< "text/html; charset=utf-8"
  std::string bytes;
};

/// Files by URL path, such as "/index.html"; "/" is the index.
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// Reads a folder that Vite built. If it has no index.html, the result is one page that explains how to build it.
/// @return an Error if a file cannot be read, or if all files together exceed 50 MB
Result<PageFiles> load_page(const std::string& folder);

/// Returns the default folder of the page:
/// - PREFIX/share/tern/viewer-page for an installed program PREFIX/bin/tern-viewer
/// - build/viewer-page, where view_page.sh builds it, for build/release/bin/tern-viewer
std::string default_page_folder();

}  // namespace tern
