// The configuration is strict, and every refusal names file, line, key, value and limit.
#include "runtime/config.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

#include "runtime/yaml_tree.h"
#include "tests/messages/allocation_meter.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The error of reading, or "" if there is none.
std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

/// The error of reading the top section of a document called a.yaml.
std::string error_of(const std::string& yaml, const std::function<void(ConfigSection&)>& read,
                     const std::vector<std::string>& overrides = {}) {
  return error_of([&] {
    ConfigSection root = ConfigDocument::parse(yaml, "a.yaml", overrides).root();
    read(root);
    root.finish();
  });
}

ConfigSection root_of(const std::string& yaml) { return ConfigDocument::parse(yaml, "a.yaml").root(); }

TEST(Config, ReadsEveryType) {
  ConfigSection root = root_of(
      "n: -0.5e1\ni: 7\nf: true\nt: some words\nc: b\nv: [1, 2, 3]\nl: [4, 5]\none: 2\nr: [[1, 2], [3, 4]]\n"
      "s: {n: 3}\nitems:\n  - {n: 1}\n  - {n: 2}\n");
  EXPECT_EQ(root.number("n", 0.0), -5.0);
  EXPECT_EQ(root.integer("i", 0, 0, 10), 7);
  EXPECT_TRUE(root.flag("f", false));
  EXPECT_EQ(root.text("t", ""), "some words");
  EXPECT_EQ(root.choice("c", "a", {"a", "b"}), "b");
  EXPECT_EQ(root.vec3("v", Vec3::Zero()), Vec3(1, 2, 3));
  EXPECT_EQ(root.numbers("l", {}), (std::vector<double>{4, 5}));
  EXPECT_EQ(root.vec3_or_number("one", Vec3::Zero()), Vec3(2, 2, 2));
  EXPECT_EQ(root.rows("r", 2), (std::vector<std::vector<double>>{{1, 2}, {3, 4}}));
  EXPECT_EQ(root.section("s").number("n", 0.0), 3.0);
  ASSERT_EQ(root.list("items").size(), 2U);
  EXPECT_EQ(root.list("items")[1].number("n", 0.0), 2.0);
  EXPECT_NO_THROW(root.finish());
}

TEST(Config, GivesTheFallbackOfWhatIsAbsent) {
  ConfigSection root = root_of("");
  EXPECT_EQ(root.number("n", 1.5), 1.5);
  EXPECT_EQ(root.integer("i", 3, 0, 10), 3);
  EXPECT_TRUE(root.flag("f", true));
  EXPECT_EQ(root.text("t", "x"), "x");
  EXPECT_EQ(root.vec3("v", Vec3(1, 2, 3)), Vec3(1, 2, 3));
  EXPECT_FALSE(root.has("n"));
  EXPECT_TRUE(root.list("items").empty());
  EXPECT_EQ(root.section("s").section("t").number("n", 4.0), 4.0);
  EXPECT_NO_THROW(root.finish());
}

TEST(Config, RefusesWhatIsNotANumber) {
  const auto read = [](ConfigSection& s) { s.section("a").number("x", 0.0); };
  EXPECT_EQ(error_of("a:\n  x: fast\n", read), "a.yaml:2: a.x: fast is not a number");
  EXPECT_EQ(error_of("a:\n  x: \"3\"\n", read), "a.yaml:2: a.x: \"3\" is not a number");
  EXPECT_EQ(error_of("a:\n  x: [1]\n", read), "a.yaml:2: a.x: a list of 1 is not a number");
  EXPECT_EQ(error_of("a:\n  x: {}\n", read), "a.yaml:2: a.x: a mapping is not a number");
  EXPECT_EQ(error_of("a:\n  x:\n", read), "a.yaml:2: a.x: an empty value is not a number");
  for (const char* text : {"nan", ".nan", "1e999", "0x10", "1 2", "1,5", "--1", "+-1", "3m"}) {
    EXPECT_EQ(error_of(std::string("a:\n  x: ") + text, read),
              std::string("a.yaml:2: a.x: ") + text + " is not a number");
  }
}

TEST(Config, RefusesNumbersOutOfRange) {
  const auto read = [](Range range) { return [range](ConfigSection& s) { s.number("x", 1.0, range); }; };
  EXPECT_EQ(error_of("x: -3", read(Range::positive(1000))), "a.yaml:1: x: -3 is out of range (0, 1000]");
  EXPECT_EQ(error_of("x: 0", read(Range::positive(1000))), "a.yaml:1: x: 0 is out of range (0, 1000]");
  EXPECT_EQ(error_of("x: 1000", read(Range::positive(1000))), "");
  EXPECT_EQ(error_of("x: 0", read(Range::at_least(0, 5))), "");
  EXPECT_EQ(error_of("x: 5.5", read(Range::at_least(0, 5))), "a.yaml:1: x: 5.5 is out of range [0, 5]");
  EXPECT_EQ(error_of("x: -6", read(Range::within(5))), "a.yaml:1: x: -6 is out of range [-5, 5]");
}

TEST(Config, TakesInfinityOnlyWhereTheRangeAllowsIt) {
  for (const char* text : {"inf", ".inf", "+inf"}) {
    ConfigSection root = root_of(std::string("x: ") + text);
    EXPECT_EQ(root.number("x", 1.0, Range::positive(kInfinity)), kInfinity);
  }
  EXPECT_EQ(error_of("x: inf", [](ConfigSection& s) { s.number("x", 1.0); }),
            "a.yaml:1: x: inf is out of range (-inf, inf)");
  EXPECT_EQ(error_of("x: inf", [](ConfigSection& s) { s.number("x", 1.0, Range::positive()); }),
            "a.yaml:1: x: inf is out of range (0, 1000000000]");
  EXPECT_EQ(error_of("x: -inf", [](ConfigSection& s) { s.number("x", 1.0, Range::positive(kInfinity)); }),
            "a.yaml:1: x: -inf is out of range (0, inf]");
}

TEST(Config, RefusesWhatIsNotAnInteger) {
  const auto read = [](ConfigSection& s) { s.integer("n", 0, 0, 10); };
  EXPECT_EQ(error_of("n: 3.0", read), "a.yaml:1: n: 3.0 is not an integer");
  EXPECT_EQ(error_of("n: 1e1", read), "a.yaml:1: n: 1e1 is not an integer");
  EXPECT_EQ(error_of("n: \"3\"", read), "a.yaml:1: n: \"3\" is not an integer");
  EXPECT_EQ(error_of("n: []", read), "a.yaml:1: n: a list of 0 is not an integer");
  EXPECT_EQ(error_of("n: 11", read), "a.yaml:1: n: 11 is out of range [0, 10]");
  EXPECT_EQ(error_of("n: 99999999999999999999", read), "a.yaml:1: n: 99999999999999999999 is out of range [0, 10]");
}

TEST(Config, RefusesFlagsThatAreNotTrueOrFalse) {
  const auto read = [](ConfigSection& s) { s.flag("f", false); };
  for (const char* text : {"yes", "True", "1", "on"}) {
    EXPECT_EQ(error_of(std::string("f: ") + text, read), std::string("a.yaml:1: f: ") + text + " is not true or false");
  }
}

TEST(Config, RefusesWordsThatAreNoChoice) {
  EXPECT_EQ(error_of("c: d",
                     [](ConfigSection& s) {
                       s.choice("c", "a", {"a", "b"});
                     }),
            "a.yaml:1: c: d is not one of a, b");
}

TEST(Config, RefusesListsOfAnotherLengthOrContent) {
  const auto read = [](ConfigSection& s) { s.vec3("v", Vec3::Zero(), Range::positive(10)); };
  EXPECT_EQ(error_of("v: [1, 2]", read), "a.yaml:1: v: a list of 2 is not a list of 3 numbers, [x, y, z]");
  EXPECT_EQ(error_of("v: 1", read), "a.yaml:1: v: 1 is not a list of 3 numbers, [x, y, z]");
  EXPECT_EQ(error_of("v:\n  - 1\n  - x\n  - 3", read), "a.yaml:3: v[1]: x is not a number");
  EXPECT_EQ(error_of("v:\n  - 1\n  - 2\n  - 11", read), "a.yaml:4: v[2]: 11 is out of range (0, 10]");
  const auto rows = [](ConfigSection& s) { s.rows("r", 2); };
  EXPECT_EQ(error_of("r:\n  - [1, 2]\n  - [1]\n", rows), "a.yaml:3: r[1]: a list of 1 is not a list of 2 numbers");
  EXPECT_EQ(error_of("r:\n  - [1, 2]\n  - [1, x]\n", rows), "a.yaml:3: r[1][1]: x is not a number");
  EXPECT_EQ(error_of("r: 3", rows), "a.yaml:1: r: 3 is not a list of lists of numbers");
}

TEST(Config, RefusesSectionsAndListsOfAnotherKind) {
  EXPECT_EQ(error_of("s: 3", [](ConfigSection& s) { s.section("s"); }), "a.yaml:1: s: 3 is not a mapping");
  EXPECT_EQ(error_of("l: {}", [](ConfigSection& s) { s.list("l"); }), "a.yaml:1: l: a mapping is not a list");
  EXPECT_EQ(error_of("l:\n  - {}\n  - 3", [](ConfigSection& s) { s.list("l"); }), "a.yaml:3: l[1]: 3 is not a mapping");
}

TEST(Config, RefusesUnknownKeysAndListsTheKnownOnes) {
  const auto read = [](ConfigSection& s) {
    ConfigSection inner = s.section("s");
    inner.number("speed", 0.0);
    inner.ignore("other");
    inner.finish();
  };
  EXPECT_EQ(error_of("s:\n  speed: 1\n  sped: 2\n", read), "a.yaml:3: s.sped: unknown key (known here: other, speed)");
  EXPECT_EQ(error_of("s:\n  other: {a: b}\n", read), "");
  EXPECT_EQ(error_of("t: 1\n", read), "a.yaml:1: t: unknown key (known here: s)");
}

TEST(Config, SaysWhereARequiredKeyIsMissing) {
  EXPECT_EQ(error_of("x: 1\ns:\n  a: 1\n", [](ConfigSection& s) { s.section("s").required_number("b"); }),
            "a.yaml:2: s.b: is missing");
  EXPECT_EQ(error_of("", [](ConfigSection& s) { s.required_text("t"); }), "a.yaml: t: is missing");
  EXPECT_EQ(error_of("", [](ConfigSection& s) { s.section("s").required_vec3("v"); }), "a.yaml: s.v: is missing");
}

TEST(Config, RefusesAKeyGivenTwice) {
  EXPECT_EQ(error_of("a: 1\nb: 2\na: 3\n", [](ConfigSection&) {}),
            "a.yaml:3: key a is given twice (first at a.yaml:1)");
}

TEST(Config, RefusesWhatIsNotOneMappingOfYaml) {
  const auto nothing = [](ConfigSection&) {};
  EXPECT_EQ(error_of("a: [1, 2\nb: 3\n", nothing).rfind("a.yaml:2: not YAML: ", 0), 0U);
  EXPECT_EQ(error_of("- 1\n", nothing), "a.yaml:1: a list of 1 where keys are expected");
  EXPECT_EQ(error_of("a: 1\n---\nb: 1\n", nothing), "a.yaml:3: a second YAML document begins here");
  EXPECT_EQ(error_of("[1, 2]: 3\n", nothing), "a.yaml:1: a key must be a word");
  EXPECT_EQ(error_of("a: " + std::string(100, '[') + std::string(100, ']'), nothing),
            "a.yaml:1: nested deeper than 32 levels");
}

/// The aliases of a billion laughs: ten of each of ten, `levels` deep.
std::string alias_bomb(int levels) {
  std::string yaml = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int k = 1; k < levels; ++k) {
    const std::string alias = "*a" + std::to_string(k - 1);
    yaml += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [" + alias;
    for (int i = 1; i < 10; ++i) yaml += ", " + alias;
    yaml += "]\n";
  }
  return yaml;
}

TEST(Yaml, RepeatsWhatAnAliasNames) {
  ConfigSection root = root_of("a: &p [1, 2, 3]\nb: *p\nc: {d: *p}\ne: &t word\nf: *t\n");
  EXPECT_EQ(root.vec3("b", Vec3::Zero()), Vec3(1, 2, 3));
  EXPECT_EQ(root.section("c").vec3("d", Vec3::Zero()), Vec3(1, 2, 3));
  EXPECT_EQ(root.text("f", ""), "word");
  EXPECT_EQ(error_of("a: &p [1, 2]\nb: *p\n", [](ConfigSection& s) { s.vec3("b", Vec3::Zero()); }),
            "a.yaml:2: b: a list of 2 is not a list of 3 numbers, [x, y, z]");
}

TEST(Yaml, AnAliasBombIsRefusedBeforeItIsExpanded) {
  const auto nothing = [](ConfigSection&) {};
  const AllocationMeter meter;
  EXPECT_EQ(error_of(alias_bomb(9), nothing), "a.yaml:5: more than 200000 values, repetitions by aliases included");
  EXPECT_EQ(error_of("a: &a [*a]\n", nothing), "a.yaml:1: an alias inside the value that it repeats");
  std::string deep = "k0: &k0 [x]\n";
  for (int k = 1; k < 40; ++k) {
    deep += fmt::format("k{}: &k{} [*k{}]\n", k, k, k - 1);
  }
  EXPECT_EQ(error_of(deep, nothing), "a.yaml:32: nested deeper than 32 levels");
  EXPECT_LT(meter.peak(), std::size_t{100} << 20U);
}

TEST(Yaml, NestedAnchorsAreCountedAsOftenAsTheyAreHeld) {
  std::string yaml = "a: ";
  for (int k = 0; k < 30; ++k) yaml += fmt::format("&a{} [", k);
  for (int k = 0; k < 20'000; ++k) yaml += "1, ";
  yaml += std::string(30, ']');
  const AllocationMeter meter;
  EXPECT_EQ(error_of(yaml, [](ConfigSection&) {}),
            "a.yaml:1: more than 200000 values, repetitions by aliases included");
  EXPECT_LT(meter.peak(), std::size_t{100} << 20U);
}

TEST(Yaml, RefusesWhatIsTooLargeBeforeItIsHeld) {
  const auto nothing = [](ConfigSection&) {};
  const AllocationMeter meter;
  std::string yaml = "a: [0";
  for (std::size_t k = 0; k < kMaxYamlValues; ++k) yaml += k % 10 == 0 ? ",\n0" : ", 0";
  EXPECT_EQ(error_of(yaml + "]\n", nothing), "a.yaml:20001: more than 200000 values, repetitions by aliases included");
  EXPECT_EQ(error_of("a: " + std::string(kMaxYamlBytes, 'x'), nothing), "a.yaml:1: has more than 4194304 bytes");
  EXPECT_EQ(error_of("a: " + std::string(2'000'000, '['), nothing), "a.yaml:1: more than 1000 open brackets");
  EXPECT_EQ(error_of("a: 1\nb: " + std::string(2'000'000, '{'), nothing), "a.yaml:2: more than 1000 open brackets");
  EXPECT_LT(meter.peak(), std::size_t{100} << 20U);
}

TEST(Yaml, AFileWithoutEndIsRefusedByItsSize) {
  EXPECT_EQ(error_of([] { ConfigDocument::load("/dev/zero", {}); }), "/dev/zero:1: has more than 4194304 bytes");
}

/// Comparing every pair of keys would take 1.8e9 comparisons, and the test would exceed its time.
TEST(Yaml, SixtyThousandUnknownKeysAreReadOnce) {
  std::string yaml;
  for (int k = 0; k < 60'000; ++k) yaml += fmt::format("unknown_{}: 1\n", k);
  EXPECT_EQ(error_of(yaml, [](ConfigSection& s) { s.number("x", 0.0); }),
            "a.yaml:1: unknown_0: unknown key (known here: x)");
  EXPECT_EQ(error_of(yaml + "unknown_7: 2\n", [](ConfigSection&) {}),
            "a.yaml:60001: key unknown_7 is given twice (first at a.yaml:8)");
}

TEST(Config, KnowsTheKeysThatItWasAskedFor) {
  EXPECT_EQ(error_of("t: 1\n",
                     [](ConfigSection& s) {
                       if (s.has("time")) s.required_number("time");
                     }),
            "a.yaml:1: t: unknown key (known here: time)");
}

TEST(Config, RefusesAFileThatCannotBeRead) {
  EXPECT_EQ(error_of([] { ConfigDocument::load("/no/such/file.yaml", {}); }), "/no/such/file.yaml: cannot be read");
  EXPECT_EQ(error_of([] { ConfigDocument::load("/tmp", {}); }), "/tmp: cannot be read");
}

TEST(Config, LoadsAnEmptyFileAsNoKeys) {
  const TempFolder folder;
  const std::string file = folder.file("empty.yaml");
  std::ofstream(file) << "";
  EXPECT_TRUE(ConfigDocument::load(file, {}).root().keys().empty());
  EXPECT_TRUE(ConfigDocument::load("", {}).root().keys().empty());
}

TEST(Config, ErrorsOfRulesBetweenFieldsNameTheKeysLine) {
  ConfigSection root = root_of("a: 1\ns:\n  low: 3\n  high: 2\n");
  EXPECT_STREQ(root.section("s").error("high", "is below low").what(), "a.yaml:4: s.high: is below low");
  EXPECT_STREQ(root.section("s").error("absent", "is needed").what(), "a.yaml:2: s.absent: is needed");
}

TEST(Config, SectionsGotTwiceAreTheSame) {
  ConfigDocument document = ConfigDocument::parse("s: {a: 1, b: 2}", "a.yaml");
  document.root().section("s").number("a", 0.0);
  document.root().section("s").number("b", 0.0);
  EXPECT_NO_THROW(document.root().section("s").finish());
  EXPECT_EQ(document.effective(), "s:\n  a: 1\n  b: 2\n");
}

TEST(Override, ReplacesAddsAndReachesIntoLists) {
  ConfigDocument document = ConfigDocument::parse("s:\n  a: 1\nl:\n  - {x: 1}\n  - {x: 2}\n", "a.yaml",
                                                  {"s.a=2", "s.b.c=[1, 2, 3]", "l[1].x=7", "t={k: v}", "s.e=a=b"});
  ConfigSection root = document.root();
  EXPECT_EQ(root.section("s").number("a", 0.0), 2.0);
  EXPECT_EQ(root.section("s").section("b").vec3("c", Vec3::Zero()), Vec3(1, 2, 3));
  EXPECT_EQ(root.section("s").text("e", ""), "a=b");
  EXPECT_EQ(root.list("l")[0].number("x", 0.0), 1.0);
  EXPECT_EQ(root.list("l")[1].number("x", 0.0), 7.0);
  EXPECT_EQ(root.section("t").text("k", ""), "v");
}

TEST(Override, TheLastOneWins) {
  ConfigDocument document = ConfigDocument::parse("", "a.yaml", {"x=1", "x=2"});
  EXPECT_EQ(document.root().number("x", 0.0), 2.0);
}

TEST(Override, ErrorsNameTheOverride) {
  const auto read = [](ConfigSection& s) {
    ConfigSection inner = s.section("s");
    inner.number("a", 0.0, Range::positive(10));
    inner.finish();
  };
  EXPECT_EQ(error_of("", read, {"s.a=-1"}), "--set s.a=-1: s.a: -1 is out of range (0, 10]");
  EXPECT_EQ(error_of("", read, {"s.typo=1"}), "--set s.typo=1: s.typo: unknown key (known here: a)");
  EXPECT_EQ(error_of("", read, {"s.a"}), "--set s.a: must be KEY=VALUE, as in uav.limits.v_max=3");
  EXPECT_EQ(error_of("", read, {"=1"}), "--set =1: \"\" is not a path such as uav.limits.v_max");
  EXPECT_EQ(error_of("", read, {"s..a=1"}), "--set s..a=1: \"s..a\" is not a path such as uav.limits.v_max");
  EXPECT_EQ(error_of("", read, {"s[x]=1"}), "--set s[x]=1: \"s[x]\" is not a path such as uav.limits.v_max");
  std::string deep = "s";
  for (int k = 0; k < 40; ++k) deep += ".s";
  EXPECT_EQ(error_of("", read, {deep + "=1"}), "--set " + deep + "=1: more than 32 keys deep");
  EXPECT_EQ(error_of("s: 3", read, {"s.a=1"}), "--set s.a=1: a cannot be set: its parent is 3");
  EXPECT_EQ(error_of("", read, {"s[0]=1"}), "--set s[0]=1: s[0]: the list has 0 entries");
  EXPECT_EQ(error_of("", read, {"s.a="}), "--set s.a=: s.a: an empty value is not a number");
  EXPECT_EQ(error_of("", read, {"s.a=[1"}).rfind("--set s.a=[1: not YAML: ", 0), 0U);
}

/// Reads one of everything, from whatever document.
std::string effective_of(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse(yaml, "a.yaml");
  ConfigSection root = document.root();
  root.number("n", 0.1);
  root.number("limit", kInfinity, Range::positive(kInfinity));
  root.integer("i", -3, -10, 10);
  root.flag("f", true);
  root.text("t", "true");
  root.vec3("v", Vec3(1, 0.5, 1e-9));
  root.rows("r", 2);
  root.numbers("l", {1, 2});
  for (ConfigSection& item : root.list("items")) {
    item.text("name", "");
    item.section("inner").number("x", 1.0);
    item.finish();
  }
  root.section("s").flag("g", false);
  root.section("empty");
  root.finish();
  return document.effective();
}

TEST(Effective, HoldsEveryValueReadAndReadsBackAsItself) {
  const std::string whole = effective_of("items:\n  - {name: a b, inner: {x: 2}}\n  - {}\nr: [[1, 2], [3, 4]]\nn: 7\n");
  EXPECT_EQ(
      whole,
      "n: 7\nlimit: .inf\ni: -3\nf: true\nt: \"true\"\nv: [1, 0.5, 1e-09]\nr: [[1, 2], [3, 4]]\nl: [1, 2]\nitems:\n"
      "  -\n    name: \"a b\"\n    inner:\n      x: 2\n  -\n    name: \"\"\n    inner:\n      x: 1\n"
      "s:\n  g: false\nempty: {}\n");
  EXPECT_EQ(effective_of(whole), whole);
}

RC_GTEST_PROP(YamlText, ReadsBackAsTheSameText, (const std::vector<std::uint8_t>& bytes)) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += static_cast<char>(byte % 0x7f + 1);
  ConfigDocument document = ConfigDocument::parse("t: " + yaml_text(text), "a.yaml");
  RC_ASSERT(document.root().text("t", "?") == text);
}

RC_GTEST_PROP(YamlNumber, ReadsBackAsTheSameDouble, (std::uint64_t bits)) {
  double x = 0.0;
  static_assert(sizeof(x) == sizeof(bits));
  std::memcpy(&x, &bits, sizeof(x));
  RC_PRE(std::isfinite(x));
  ConfigDocument document = ConfigDocument::parse("x: " + yaml_number(x), "a.yaml");
  RC_ASSERT(document.root().number("x", 0.0) == x);
}

}  // namespace
}  // namespace tern
