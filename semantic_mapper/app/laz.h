// Decompresses LAZ files (compressed LAS) by the program tern-unlaz, so that a damaged file can crash only that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tern {

/// Limits of tern-unlaz. It decompresses about a million points a second, and holds one chunk of the file at a time.
inline constexpr std::uint64_t kUnlazCpuLimitS = 600;
inline constexpr std::uint64_t kUnlazMemoryLimitBytes = 2'000'000'000;

/// Returns the path of tern-unlaz: beside the running program. The file exists if Tern was built with LASzip.
std::string unlaz_program();

/// Runs `program FILE` and returns its standard output: the points as an uncompressed LAS file. These bytes may be
/// hostile, as those of the file are.
///
/// An Error names the file. Errors are:
///
/// * there is no such program;
/// * it ended with an exit code other than 0: the error is the last line of its standard error;
/// * a signal ended it: it crashed, or needed more than kUnlazCpuLimitS;
/// * its output has more than `max_bytes`.
Result<std::vector<std::uint8_t>> decompress_laz(const std::string& file, const std::string& program,
                                                 std::size_t max_bytes);

}  // namespace tern
