#include "tools/export/output_files.h"

#include <algorithm>
#include <system_error>

namespace tern::exporting {

namespace fs = std::filesystem;

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const auto& [output, part] : parts_) fs::remove(part, ignored);
}

bool OutputFiles::is_input(const fs::path& path) const {
  return std::ranges::any_of(inputs_, [&path](const std::string& input) {
    std::error_code error;  // one of them does not exist, so they are not the same
    return fs::equivalent(path, input, error) && !error;
  });
}

fs::path OutputFiles::part_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return path;
  fs::path output = fs::exists(status) ? fs::canonical(path, error) : path;
  if (output.empty()) output = path;
  fs::path part = output;
  part += ".part";
  if (is_input(output) || is_input(part)) {
    refusal_ = path.string() + ": the log itself would be overwritten; name another file";
    return {};
  }
  parts_[output] = part;
  return part;
}

Result<void> OutputFiles::put_in_place() {
  if (!refusal_.empty()) return fail(refusal_);
  for (; !parts_.empty(); parts_.erase(parts_.begin())) {
    const auto& [output, part] = *parts_.begin();
    std::error_code error;
    fs::rename(part, output, error);
    if (error) return fail(output.string() + ": cannot be replaced: " + error.message());
  }
  return {};
}

}  // namespace tern::exporting
