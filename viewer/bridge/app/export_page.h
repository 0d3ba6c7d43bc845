// Exports a flight as one HTML page that plays itself, without server or network.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "viewer/bridge/app/page_files.h"

namespace tern {

/// The inputs of export_page().
struct PageExport {
  std::string log;     ///< see LogPlayer::open()
  std::string ghost;   ///< another log to draw over it; empty: none
  std::string suffix;  ///< only channels with this suffix are read
  std::string page;    ///< folder of the built page
};

/// An exported page.
struct ExportedPage {
  std::string html;
  double begin_s = 0.0, end_s = 0.0;  ///< the exported time, s since the flight's time 0
  double departure_s = 0.0;           ///< the vehicle's departure, on the same clock; begin_s if it never departs
  std::string left_out;               ///< in words, layers that did not fit; empty: everything fitted
};

/// Size limit of a page per minute of flight, bytes.
inline constexpr std::int64_t kMaxBytesPerMinute = 10'000'000;

/// Plays the log and packs the page's topics, 20 times a second, into the page as deflated JSON (web/src/tape.js). If
/// the page gets too large, hulls are left out first, then planes.
/// @return an Error if the page is still too large, or if the log or the built page cannot be read
Result<ExportedPage> export_page(const PageExport& wanted);

/// Builds a single-file page: index.html with the scripts and styles of `files`, the licences, and the tape.
/// @param packed  base64 of the deflated tape
/// @return an Error if the page is not built
Result<std::string> inline_page(const PageFiles& files, const std::string& packed);

/// Compresses by raw Deflate (RFC 1951), without a header.
std::string deflated(const std::string& bytes);

}  // namespace tern
