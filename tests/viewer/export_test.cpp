// A log as one page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.h"
#include "tests/viewer/known_log.h"
#include "viewer/bridge/app/export_page.h"

namespace tern {
namespace {

const PageFiles kPage = {
    {"/index.html",
     {"text/html",
      "<html><head><script type=\"module\" crossorigin src=\"./assets/a.js\"></script><link rel=\"stylesheet\" "
      "href=\"./assets/a.css\"></head><body>x</body></html>"}},
    {"/assets/a.js", {"text/javascript", "say('</script>')"}},
    {"/assets/a.css", {"text/css", "b{}"}},
    {"/licences.txt", {"text/plain", "BSD"}}};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(InlinePage, HoldsScriptStyleLicencesAndTape) {
  const auto html = inline_page(kPage, "QUJD");
  ASSERT_TRUE(html) << html.error().message;
  for (const char* part : {"<script type=\"module\">say('<\\/script>')</script>", "<style>b{}</style>",
                           "id=\"licences\">BSD<", "id=\"tape\">QUJD<", "default-src 'none'"}) {
    EXPECT_EQ(count(*html, part), 1U) << part << "\n" << *html;
  }
  EXPECT_EQ(count(*html, "./assets"), 0U);
  EXPECT_FALSE(inline_page({}, ""));
}

TEST(ExportPage, OfNoLogOrNoPageIsAnError) {
  const TempFolder folder;
  EXPECT_FALSE(export_page({folder.file("none.lcm"), "", "", ""}));
  support::write_known_log(folder.file("flight.lcm"));
  const auto exported = export_page({folder.file("flight.lcm"), "", "", folder.file("no page")});
  ASSERT_FALSE(exported);
  EXPECT_NE(exported.error().message.find("not built"), std::string::npos);
}

TEST(Deflated, IsSmallAndEndsWithAFinalBlock) {
  const std::string text(1'000'000, 'x');
  EXPECT_LT(deflated(text).size(), 3'000U);
  EXPECT_FALSE(deflated("").empty());
}

}  // namespace
}  // namespace tern
