#include "viewer/bridge/app/export_page.h"

#include <fmt/format.h>

#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <boost/beast/zlib/deflate_stream.hpp>
#include <map>
#include <utility>
#include <vector>

#include "viewer/bridge/app/log_player.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/topics.h"

namespace tern {
namespace {

constexpr Duration kStep{50'000};
constexpr char kPolicy[] =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; img-src data:; connect-src data:\">";

std::string base64(const std::string& bytes) {
  using boost::archive::iterators::base64_from_binary, boost::archive::iterators::transform_width;
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  return std::string(Digits(bytes.begin()), Digits(bytes.end())) + std::string((3 - bytes.size() % 3) % 3, '=');
}

/// Replaces the element that refers to a file by `text`; without such an element, the text is unchanged.
void put_for(std::string& html, const std::string& file, const std::string& end, const std::string& text) {
  const std::size_t at = html.find("\"." + file + "\"");
  if (at == std::string::npos) return;
  const std::size_t begin = html.rfind('<', at), stop = html.find(end, at) + end.size();
  html.replace(begin, stop - begin, text);
}

/// Shortest interval between stored texts of a topic.
Duration spacing(Topic topic) {
  switch (topic) {
    case Topic::Truth: return Duration{100'000};
    case Topic::Tracks:
    case Topic::Tracked:
    case Topic::Sight:
    case Topic::Hulls: return Duration{200'000};
    case Topic::Health: return Duration{1'000'000};
    default: return kStep;
  }
}

/// One text of a topic, and its time.
struct Row {
  std::vector<UTime> at;
  std::vector<std::string> json;
};

using Rows = std::map<Topic, Row>;

Rows play(LogPlayer& player, const LayersCommand& layers) {
  Scene scene(nullptr, player.note().pace);
  SceneIntake intake(scene);
  Rows rows;
  player.seek(player.begin(), scene, intake);
  player.play(true, UTime{0});
  for (std::int64_t step = 0;; ++step) {
    const UTime now = player.position();
    for (int k = 0; k < kTopics; ++k) {
      const auto topic = static_cast<Topic>(k);
      Row& row = rows[topic];
      const bool is_due = row.at.empty() || now - row.at.back() >= spacing(topic) || now == player.end();
      const bool is_hidden = (topic == Topic::Hulls && !layers.hulls) || (topic == Topic::Tracked && !layers.tracks) ||
                             (topic == Topic::Tracks && scene.truth());
      if (is_hidden || is_of_the_past(topic) || !is_due || !scene.take_change(topic)) continue;
      std::string json = topic_json(topic, {scene, player.memory(), player.zero(), player.end(), now, layers, {}});
      if (row.json.empty() ? json == "null" : json == row.json.back()) continue;
      row.at.push_back(now);
      row.json.push_back(std::move(json));
    }
    if (now == player.end()) return rows;
    player.advance(UTime{(step + 1) * kStep.us}, intake);
  }
}

std::string session_json(const PageExport& wanted, const LogPlayer& player) {
  JsonWriter json;
  json.begin_object().key("mode").text("file").key("goals").flag(false).key("name").text(wanted.log);
  json.key("why").text(player.note().why);
  return json.key("epoch").integer(0).end_object().take();
}

Result<std::string> still_json(const PageExport& wanted, const LogPlayer& player) {
  const auto fields = player.memory().history.fields();
  const Scene nothing;
  const TopicSource source{nothing, player.memory(), player.zero(), player.end(), player.end(), {}, fields};
  JsonWriter json;
  json.begin_object().key("session").raw(session_json(wanted, player));
  for (const Topic topic : {Topic::Chart, Topic::Path, Topic::Fields, Topic::Events}) {
    json.key(to_string(topic)).raw(topic_json(topic, source));
  }
  if (!wanted.ghost.empty()) {
    const auto ghost = LogPlayer::open(wanted.ghost, wanted.suffix);
    if (!ghost) return fail(ghost.error().message);
    json.key("ghost").raw(ghost_json(wanted.ghost, ghost->body_radius(), ghost->memory().history,
                                     player.memory().history, player.zero()));
  }
  return json.end_object().take();
}

std::string tape_json(const LogPlayer& player, const std::string& still, const Rows& rows) {
  JsonWriter json;
  json.begin_object().key("begin_us").integer(player.begin().us).key("zero_us").integer(player.zero().us);
  json.key("end_us").integer(player.end().us);
  json.key("still").raw(still).key("rows").begin_object();
  for (const auto& [topic, row] : rows) {
    if (row.at.empty()) continue;
    json.key(to_string(topic)).begin_list().begin_list();
    for (const UTime at : row.at) json.integer(at.us);
    json.end_list().begin_list();
    for (const std::string& value : row.json) json.raw(value);
    json.end_list().end_list();
  }
  return json.end_object().end_object().take();
}

}  // namespace

std::string deflated(const std::string& bytes) {
  namespace zlib = boost::beast::zlib;
  zlib::deflate_stream stream;
  stream.reset(9, 15, 9, zlib::Strategy::normal);
  std::string out(stream.upper_bound(bytes.size()) + 64, '\0');
  zlib::z_params state;
  state.next_in = bytes.data();
  state.avail_in = bytes.size();
  state.next_out = out.data();
  state.avail_out = out.size();
  boost::beast::error_code error;
  while (!error) stream.write(state, zlib::Flush::finish, error);
  out.resize(state.total_out);
  return out;
}

Result<std::string> inline_page(const PageFiles& files, const std::string& packed) {
  const auto index = files.find("/index.html");
  const auto licences = files.find("/licences.txt");
  if (index == files.end() || licences == files.end())
    return fail("the page is not built: launch_scripts/view_page.sh builds it");
  std::string html = index->second.bytes;
  for (const auto& [path, file] : files) {
    std::string text = file.bytes;
    if (path.ends_with(".js")) {
      boost::replace_all(text, "</script", "<\\/script");
      put_for(html, path, "</script>", "<script type=\"module\">" + text + "</script>");
    } else if (path.ends_with(".css")) {
      put_for(html, path, ">", "<style>" + text + "</style>");
    }
  }
  std::string licence_text = licences->second.bytes;
  boost::replace_all(licence_text, "</script", "<\\/script");
  const std::size_t head = html.find("<head>") + 6;
  html.insert(head, kPolicy);
  const std::string elements = fmt::format("<script type=\"text/plain\" id=\"licences\">{}</script>", licence_text) +
                               fmt::format("<script type=\"text/plain\" id=\"tape\">{}</script>", packed);
  html.insert(html.rfind("</body>"), elements);
  return html;
}

Result<ExportedPage> export_page(const PageExport& wanted) {
  auto player = LogPlayer::open(wanted.log, wanted.suffix);
  if (!player) return fail(player.error().message);
  const auto files = load_page(wanted.page.empty() ? default_page_folder() : wanted.page);
  if (!files) return fail(files.error().message);
  const auto still = still_json(wanted, *player);
  if (!still) return fail(still.error().message);
  const auto seconds = [zero = player->zero()](UTime t) { return (t - zero).seconds(); };
  const double begin_s = seconds(player->begin()), end_s = seconds(player->end());
  const double departure_s = seconds(player->memory().history.departure().value_or(player->begin()));
  const double minutes = std::max((end_s - begin_s) / 60.0, 1.0);
  const auto most = static_cast<std::size_t>(minutes * static_cast<double>(kMaxBytesPerMinute));
  player->remember_tracks();
  constexpr std::array<std::pair<LayersCommand, const char*>, 4> kDetails = {
      {{{true, true, true, true}, ""},
       {{false, true, true, true}, "hulls"},
       {{false, true, true, false}, "hulls and tracks"},
       {{false, false, true, false}, "hulls, tracks and planes"}}};
  for (const auto& [layers, left_out] : kDetails) {
    auto html = inline_page(*files, base64(deflated(tape_json(*player, *still, play(*player, layers)))));
    if (!html) return fail(html.error().message);
    if (html->size() <= most) return ExportedPage{std::move(*html), begin_s, end_s, departure_s, left_out};
  }
  return fail(fmt::format("{}: its page would exceed {} MB per minute", wanted.log, kMaxBytesPerMinute / 1'000'000));
}

}  // namespace tern
