#include "campaign/records/flight_table.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace tern {
namespace {

tl::unexpected<Error> errno_error(const std::string& path, const char* what) {
  return fail(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

/// Calls `take` with every record after the header. @return the number of bytes of whole lines.
template <class Take>
Result<std::size_t> read_table(const std::string& path, const CsvRecord& columns, const Take& take) {
  const CsvRecords table = parse_csv(read_text(path));
  for (std::size_t k = 0; k < table.records.size(); ++k) {
    const std::string place = fmt::format("{}:{}", path, table.lines[k]);
    if (k == 0) {
      if (table.records[k] == columns) continue;
      return fail(place + ": has other columns than this version writes");
    }
    if (Result<void> taken = take(table.records[k]); !taken) {
      return fail(fmt::format("{}: {}", place, taken.error().message));
    }
  }
  return table.whole_bytes;
}

Result<void> take_flight(Flights& flights, const CsvRecord& cells) {
  auto record = read_flight(cells);
  if (!record) return tl::unexpected(record.error());
  if (!flights.records.empty()) {
    const std::string differs = difference(flights.records.begin()->second.identity, record->identity);
    if (!differs.empty()) return fail("flights of two campaigns in one file: " + differs);
  }
  const std::uint64_t seed = record->seed;
  if (!flights.records.emplace(seed, std::move(*record)).second) return fail(fmt::format("seed {} again", seed));
  return {};
}

struct WholeBytes {
  std::size_t flights = 0, times = 0;
};

Result<WholeBytes> read_both(const std::string& file, Flights& flights) {
  WholeBytes whole;
  const auto records =
      read_table(file, flight_columns(), [&](const CsvRecord& cells) { return take_flight(flights, cells); });
  if (!records) return tl::unexpected(records.error());
  const auto times = read_table(times_file(file), times_columns(), [&](const CsvRecord& cells) -> Result<void> {
    auto one = read_times(cells);
    if (!one) return tl::unexpected(one.error());
    if (flights.records.contains(one->seed)) flights.times[one->seed] = std::move(*one);
    return {};
  });
  if (!times) return tl::unexpected(times.error());
  return WholeBytes{*records, *times};
}

Result<void> replace_file(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  const Descriptor file(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (file.get() < 0 || write_all(file.get(), text) != text.size() || fsync(file.get()) != 0) {
    return errno_error(fresh, "cannot be written");
  }
  if (std::rename(fresh.c_str(), path.c_str()) != 0) return errno_error(path, "cannot be replaced");
  return {};
}

/// Locks `path`. The previous holder removes the file at its end, so the opened one may be gone when the lock is
/// acquired.
Result<Descriptor> lock(const std::string& path) {
  while (true) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (file.get() < 0) return errno_error(path, "cannot be made");
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) return fail(path + ": another campaign writes this file");
    struct stat held {};
    if (fstat(file.get(), &held) == 0 && held.st_nlink > 0) return file;
  }
}

}  // namespace

std::string times_file(const std::string& flights_file) { return flights_file + ".times"; }

Result<Flights> read_flights(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) return fail(file + ": no such file");
  Flights flights;
  if (auto read = read_both(file, flights); !read) return tl::unexpected(read.error());
  return flights;
}

Result<void> write_flights(const std::string& file, const Flights& flights) {
  std::string times = csv_line(times_columns()), records = csv_line(flight_columns());
  for (const auto& [seed, one] : flights.times) times += csv_line(to_cells(one));
  for (const auto& [seed, one] : flights.records) records += csv_line(to_cells(one));
  if (auto done = replace_file(times_file(file), times); !done) return done;
  return replace_file(file, records);
}

Result<void> join(Flights& all, Flights more) {
  if (!all.records.empty() && !more.records.empty()) {
    const std::string differs = difference(all.records.begin()->second.identity, more.records.begin()->second.identity);
    if (!differs.empty()) return fail("flights of another campaign: " + differs);
  }
  for (auto& [seed, record] : more.records) {
    const auto [known, is_new] = all.records.emplace(seed, record);
    if (!is_new && to_cells(known->second) != to_cells(record)) {
      return fail(fmt::format("seed {} is in both, with different results", seed));
    }
  }
  all.times.merge(more.times);
  return {};
}

Result<FlightTable> FlightTable::open(const std::string& file, const CampaignIdentity& identity) {
  FlightTable opened(file);
  auto held = lock(file + ".lock");
  if (!held) return tl::unexpected(held.error());
  opened.lock_ = std::move(*held);
  const auto whole = read_both(file, opened.flights_);
  if (!whole) return tl::unexpected(whole.error());
  if (!opened.flights_.records.empty()) {
    const std::string differs = difference(opened.flights_.records.begin()->second.identity, identity);
    if (!differs.empty()) {
      return fail(fmt::format("{}: holds flights of another campaign: {}; name another file", file, differs));
    }
  }
  if (auto begun = opened.begin(times_file(file), opened.times_file_, times_columns(), whole->times); !begun) {
    return tl::unexpected(begun.error());
  }
  if (auto begun = opened.begin(file, opened.flights_file_, flight_columns(), whole->flights); !begun) {
    return tl::unexpected(begun.error());
  }
  return opened;
}

Result<void> FlightTable::begin(const std::string& path, Descriptor& table, const CsvRecord& columns,
                                std::size_t whole_bytes) const {
  table = Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  const std::string head = whole_bytes == 0 ? csv_line(columns) : "";
  if (table.get() < 0 || ftruncate(table.get(), static_cast<off_t>(whole_bytes)) != 0 ||
      write_all(table.get(), head) != head.size()) {
    return errno_error(path, "cannot be written");
  }
  return {};
}

FlightTable::~FlightTable() {
  if (lock_.get() >= 0) unlink((file_ + ".lock").c_str());
}

Result<void> FlightTable::add(const FlightRecord& record, const FlightTimes& times) {
  // Times first: times without a flight are ignored.
  const auto append = [](const Descriptor& table, const CsvRecord& cells) {
    const std::string line = csv_line(cells);
    return write_all(table.get(), line) == line.size() && fdatasync(table.get()) == 0;
  };
  if (!append(times_file_, to_cells(times))) return errno_error(times_file(file_), "cannot be written");
  if (!append(flights_file_, to_cells(record))) return errno_error(file_, "cannot be written");
  flights_.records.emplace(record.seed, record);
  flights_.times[record.seed] = times;
  return {};
}

Result<void> FlightTable::close_sorted() { return write_flights(file_, flights_); }

}  // namespace tern
