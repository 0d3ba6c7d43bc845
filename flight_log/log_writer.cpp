#include "flight_log/log_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "flight_log/log_format.h"

namespace tern {
namespace {

constexpr std::size_t kBufferBytes = 1'000'000;
constexpr int kMaxParts = 100'000;

template <class Integer>
void put(std::string& out, Integer value) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (int shift = static_cast<int>(sizeof(Integer) * 8) - 8; shift >= 0; shift -= 8) {
    out.push_back(static_cast<char>(bits >> static_cast<unsigned>(shift) & 0xFFU));
  }
}

}  // namespace

std::string log_part_path(const std::string& path, int part) {
  if (part == 0) return path;
  std::filesystem::path p(path);
  return p.replace_filename(fmt::format("{}.{:03}{}", p.stem().string(), part, p.extension().string())).string();
}

Result<LogWriter> LogWriter::open(const std::string& path, std::int64_t rotate_bytes) {
  LogWriter writer(path, rotate_bytes);
  if (auto opened = writer.open_next_part(); !opened) return tl::make_unexpected(opened.error());
  return writer;
}

LogWriter::~LogWriter() {
  if (fd_.get() >= 0) (void)flush();
}

Result<void> LogWriter::open_next_part() {
  for (int part = next_part_; part < kMaxParts; ++part) {
    const std::string file = log_part_path(path_, part);
    Descriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (fd.get() < 0 && errno == EEXIST) continue;
    if (fd.get() < 0) return fail(fmt::format("{}: cannot be written: {}", file, std::strerror(errno)));
    fd_ = std::move(fd);
    part_path_ = file;
    part_bytes_ = 0;
    next_part_ = part + 1;
    ++counters_.parts;
    return {};
  }
  return fail(fmt::format("{}: all {} parts exist already: move some of them away", path_, kMaxParts));
}

void LogWriter::append(std::string_view channel, std::int64_t received_us, std::span<const std::uint8_t> data) {
  put(buffer_, kLogSyncWord);
  put(buffer_, next_number_++);
  put(buffer_, received_us);
  put(buffer_, static_cast<std::int32_t>(channel.size()));
  put(buffer_, static_cast<std::int32_t>(data.size()));
  buffer_.append(channel);
  buffer_.append(reinterpret_cast<const char*>(data.data()), data.size());
  ++buffered_;
  if (buffer_.size() >= kBufferBytes) (void)flush();
}

Result<void> LogWriter::flush() {
  if (buffered_ == 0) return {};
  Result<void> result;
  // If the next part cannot be opened, writing continues in this one: a log that is too long is better than none.
  if (rotate_bytes_ > 0 && part_bytes_ >= rotate_bytes_) result = open_next_part();
  const std::size_t done = write_all(fd_.get(), buffer_);
  if (done == buffer_.size()) {
    part_bytes_ += static_cast<std::int64_t>(done);
    counters_.bytes += static_cast<std::int64_t>(done);
    counters_.written += buffered_;
  } else {
    trouble_ = fmt::format("{}: {}", part_path_, std::strerror(errno));
    counters_.unwritten += buffered_;
    result = fail(fmt::format("{} messages were not written: {}", buffered_, trouble_));
    if (ftruncate(fd_.get(), part_bytes_) == 0) lseek(fd_.get(), part_bytes_, SEEK_SET);
  }
  buffer_.clear();
  buffered_ = 0;
  return result;
}

}  // namespace tern
