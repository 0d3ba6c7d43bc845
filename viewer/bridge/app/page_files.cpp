#include "viewer/bridge/app/page_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace tern {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = 50'000'000;
constexpr char kNotBuilt[] =
    "<!doctype html><title>Tern</title><p>The page is not built. <code>launch_scripts/view_page.sh</code> builds it "
    "(Node 18 or newer); then start tern-viewer again.</p>";

std::string type_of(const fs::path& path) {
  const std::string extension = path.extension();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".js") return "text/javascript; charset=utf-8";
  if (extension == ".css") return "text/css; charset=utf-8";
  if (extension == ".txt") return "text/plain; charset=utf-8";
  if (extension == ".svg") return "image/svg+xml";
  if (extension == ".png") return "image/png";
  return "application/octet-stream";
}

}  // namespace

Result<PageFiles> load_page(const std::string& folder) {
  PageFiles files;
  std::size_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->is_regular_file()) continue;
    std::ifstream file(it->path(), std::ios::binary);
    PageFile page{type_of(it->path()), {std::istreambuf_iterator<char>(file), {}}};
    if (!file) return fail(it->path().string() + ": cannot be read");
    bytes += page.bytes.size();
    if (bytes > kMaxBytes) return fail(folder + ": holds more than 50 MB, so it is not a built page");
    files.emplace("/" + fs::relative(it->path(), folder).generic_string(), std::move(page));
  }
  if (!files.contains("/index.html")) files["/index.html"] = {"text/html; charset=utf-8", kNotBuilt};
  files["/"] = files["/index.html"];
  return files;
}

std::string default_page_folder() {
  std::error_code error;
  const fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  const fs::path installed = above / "share/tern/viewer-page";
  return (fs::is_directory(installed, error) ? installed : above.parent_path() / "viewer-page").string();
}

}  // namespace tern
