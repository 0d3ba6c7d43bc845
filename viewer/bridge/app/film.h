// A flight as a film: an exported page, drawn picture by picture by a headless Chromium, written by ffmpeg.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "viewer/bridge/app/export_page.h"

namespace tern {

/// What a film is of, and how large it is.
struct FilmForm {
  std::vector<int> size{1280, 720};  ///< width and height, pixels, even
  int rate = 25;                     ///< pictures a second, 1 ... 60
  /// From, to: s since the vehicle first flies; what is outside the log is left out.
  std::vector<double> part{-0.5, std::numeric_limits<double>::infinity()};
};

struct Film {
  ExportedPage page;
  std::string file;  ///< to be written; its name's end says what: "flight.mp4", "flight.webp" (an animation)
  FilmForm form;
};

/// The vehicle is chased, and predicted hulls are drawn. The programs are `chromium` and `ffmpeg`, or what
/// TERN_CHROMIUM and TERN_FFMPEG name. Takes some 0.3 s a picture without a GPU.
/// @return an Error when one of them is not installed or fails, or no picture is in that part of the flight
Result<bool> make_film(const Film& film);

}  // namespace tern
