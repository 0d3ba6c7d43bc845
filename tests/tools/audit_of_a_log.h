// The audit of one flight's log, and of copies of it that lack something.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"
#include "tools/audit/audit.h"

namespace tern::audit {

/// A short flight among movers, past a region, recorded once, and its logs with something missing.
class AuditOfALog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    record_ = new FlightRecord(load_flight(good()).value());
  }
  static void TearDownTestSuite() {
    delete record_;
    delete folder_;
  }

  static std::string good() { return testing::recorded_log("demo"); }
  static std::string another_file() { return folder_->file("log" + std::to_string(++files_) + ".lcm"); }
  /// Seconds of the flight as a receive time of the log.
  static std::int64_t at_us(double seconds) { return (record_->zero() + Duration::from_seconds(seconds)).us; }

  Audit audit(const std::string& log) {
    read_ = load_flight(log).value();
    return audit_flight(read_);
  }
  [[nodiscard]] std::string text(const Audit& audit) const { return to_text(audit, read_); }

  template <class T>
  static std::string with(const std::string& log, const char* channel, const std::function<bool(T&)>& change) {
    const std::string file = another_file();
    testing::copy_log_with<T>(log, file, channel, change);
    return file;
  }
  template <class T>
  static std::string without(const char* channel) {
    return with<T>(good(), channel, [](T&) { return false; });
  }

  static std::vector<std::string> broken(const Audit& audit) {
    std::vector<std::string> names;
    for (const Check& c : audit.checks) {
      if (c.verdict() == Verdict::Broken) names.push_back(c.name);
    }
    return names;
  }
  static double measure_of(const Audit& audit, const std::string& check, const std::string& name) {
    for (const auto& [key, value] : audit.check(check).measures) {
      if (key == name) return value;
    }
    throw std::out_of_range(name);
  }

  static inline TempFolder* folder_ = nullptr;
  static inline FlightRecord* record_ = nullptr;
  static inline int files_ = 0;
  FlightRecord read_;
};

/// Runs tern-audit and returns its exit code.
inline int run_program(const std::string& arguments) {
  return WEXITSTATUS(std::system((std::string(TERN_AUDIT_PROGRAM) + " " + arguments + " >/dev/null 2>&1").c_str()));
}

}  // namespace tern::audit
