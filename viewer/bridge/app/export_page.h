// A flight as one page that plays itself: no server, no network, to mail to a colleague.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "viewer/bridge/app/page_files.h"

namespace tern {

struct PageExport {
  std::string log;     ///< what LogPlayer::open takes
  std::string ghost;   ///< another log, drawn over it; empty: none
  std::string suffix;  ///< only channels that end with it
  std::string page;    ///< folder of the built page
};

struct ExportedPage {
  std::string html;
  double begin_s = 0.0, end_s = 0.0;  ///< of what it shows, s since the flight's time 0
  double departure_s = 0.0;           ///< when the vehicle first flies, likewise; begin_s: never
  std::string left_out;               ///< what did not fit, in words; "" when everything did
};

/// A page is at most as large as this for each minute of flight that it shows, bytes, and never needs to be smaller.
inline constexpr std::int64_t kMaxBytesPerMinute = 10'000'000;

/// Plays the log and packs what the page would have been told, 20 times a second, into the page: deflated JSON
/// (web/src/tape.js). Where it becomes too large, hulls are left out first, then planes. An Error when that is not
/// enough, the log cannot be read or the page is not built.
Result<ExportedPage> export_page(const PageExport& wanted);

/// The page in one file: scripts and styles of `files` written into its index.html, its licences, and `tape`.
/// @param packed  base64 of a deflated tape
/// @return an Error when the page is not built
Result<std::string> inline_page(const PageFiles& files, const std::string& packed);

/// Deflate without a head (RFC 1951).
std::string deflated(const std::string& bytes);

}  // namespace tern
