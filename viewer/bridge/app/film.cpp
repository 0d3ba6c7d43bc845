#include "viewer/bridge/app/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/base/files.h"
#include "runtime/child_process.h"
#include "viewer/bridge/app/devtools.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

/// Options of ffmpeg to read pictures at a rate, which follows.
const std::vector<const char*> kPictures = {"-loglevel", "error", "-y", "-f", "image2pipe", "-framerate"};
/// Options of ffmpeg to write the film. An animation repeats.
const std::vector<const char*> kFilm = {"-pix_fmt", "yuv420p", "-movflags", "+faststart"};
const std::vector<const char*> kAnimation = {"-c:v", "libwebp_anim",       "-loop", "0", "-quality",
                                             "55",   "-compression_level", "6"};

std::string program(const char* variable, const char* usual) {
  const char* named = std::getenv(variable);
  return named != nullptr && *named != '\0' ? named : usual;
}

bool is_installed(const std::string& name) {
  const pid_t asked = start_child({.command = {"sh", "-c", "command -v \"$0\" >/dev/null", name}});
  const ProcessEnd end = await_child(asked);
  return end.signal == 0 && end.exit_code == 0;
}

/// A temporary folder; the destructor deletes it.
struct Workplace {
  Workplace() {
    std::string name = (fs::temp_directory_path() / "tern-film-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + " cannot be made");
    folder = name;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  fs::path folder;
};

/// ffmpeg, reading pictures from a pipe.
class Encoder {
 public:
  Encoder(const std::string& file, int pictures_per_s) {
    int pictures[2];
    if (pipe2(pictures, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    to_ = pictures[1];
    std::vector<std::string> command = {program("TERN_FFMPEG", "ffmpeg")};
    const auto append = [&command](const auto& words) { command.insert(command.end(), words.begin(), words.end()); };
    const std::string rate = std::to_string(pictures_per_s), from = fmt::format("pipe:{}", pictures[0]);
    append(kPictures);
    append(std::vector<std::string>{rate, "-c:v", "mjpeg", "-i", from});
    append(fs::path(file).extension() == ".webp" ? kAnimation : kFilm);
    command.push_back(file);
    ffmpeg_ = start_child({.command = std::move(command), .inherited = {pictures[0]}});
    close(pictures[0]);
  }
  void add(const std::string& picture) {
    if (write_all(to_, picture) != picture.size()) throw std::runtime_error("ffmpeg stopped reading the frames");
  }
  void finish() {
    close(to_);
    const ProcessEnd end = await_child(ffmpeg_);
    if (end.signal != 0 || end.exit_code != 0) throw std::runtime_error("ffmpeg failed");
  }

 private:
  int to_ = -1;
  pid_t ffmpeg_ = 0;
};

}  // namespace

Result<bool> make_film(const Film& film) try {
  const std::string chromium = program("TERN_CHROMIUM", "chromium"), ffmpeg = program("TERN_FFMPEG", "ffmpeg");
  for (const std::string& name : {chromium, ffmpeg}) {
    if (!is_installed(name)) return fail(name + " is not installed: a film needs Chromium and ffmpeg");
  }
  const auto& [size, rate, part] = film.form;
  const ExportedPage& shown = film.page;
  const double departure = shown.departure_s;
  const double from = std::max(departure + part.at(0), shown.begin_s);
  const double to = std::min(departure + part.at(1), shown.end_s);
  const int pictures = static_cast<int>(std::ceil((to - from) * rate));
  if (pictures < 1) {
    return fail(
        fmt::format("--video-part {} {} is empty: the vehicle departs at {:.1f} s, the log has {:.1f} to {:.1f} s",
                    part.at(0), part.at(1), departure, shown.begin_s, shown.end_s));
  }
  std::signal(SIGPIPE, SIG_IGN);
  const Workplace workplace;
  const fs::path page = workplace.folder / "flight.html";
  std::ofstream(page, std::ios::binary) << film.page.html;
  Devtools browser(chromium, workplace.folder / "profile", size.at(0), size.at(1));
  browser.open("file://" + page.string() + "?quality=high&theme=dark#cam=chase", "window.tern?.counts.drawn > 1");
  browser.evaluate("tern.setLayer('hulls', true)");
  Encoder encoder(film.file, rate);
  for (int k = 0; k < pictures; ++k) {
    browser.evaluate(fmt::format("tern.film({:.4f}, {:.4f})", from + static_cast<double>(k) / rate, 1.0 / rate));
    encoder.add(browser.picture());
  }
  encoder.finish();
  return true;
} catch (const std::exception& e) {
  return fail(e.what());
}

}  // namespace tern
