// Makes a video of a flight: headless Chromium draws an exported page frame by frame, ffmpeg encodes the frames.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "viewer/bridge/app/export_page.h"

namespace tern {

/// Format and time span of a film.
struct FilmForm {
  std::vector<int> size{1280, 720};  ///< width and height, pixels, even
  int rate = 25;                     ///< frames per second, 1 … 60
  /// From, to: s since the vehicle's departure; cut to the log's time.
  std::vector<double> part{-0.5, std::numeric_limits<double>::infinity()};
};

/// A film to make.
struct Film {
  ExportedPage page;
  std::string file;  ///< output file; its suffix selects the format: "flight.mp4", or "flight.webp" for an animation
  FilmForm form;
};

/// Makes a film with the chase camera and predicted hulls. It runs `chromium` and `ffmpeg`, or the programs that
/// TERN_CHROMIUM and TERN_FFMPEG name. Takes about 0.3 s per frame without a GPU.
/// @return an Error if a program is missing or fails, or if the time span has no frame
Result<bool> make_film(const Film& film);

}  // namespace tern
