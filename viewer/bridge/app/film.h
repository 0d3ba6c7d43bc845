// A flight as a film: an exported page, drawn picture by picture by a headless Chromium, written by ffmpeg.
#pragma once

#include <string>

#include "core/base/result.h"

namespace tern {

struct Film {
  std::string html;      ///< a page of export_page
  std::string file;      ///< to be written, "flight.mp4"
  double seconds = 0.0;  ///< of the flight
  std::string camera = "chase";
};

inline constexpr int kFilmWidth = 1280, kFilmHeight = 720, kFilmRate = 25;  ///< pixels; pictures a second

/// The programs are `chromium` and `ffmpeg`, or what TERN_CHROMIUM and TERN_FFMPEG name. Takes some 0.3 s a picture
/// without a GPU.
/// @return an Error when one of them is not installed or fails
Result<bool> make_film(const Film& film);

}  // namespace tern
