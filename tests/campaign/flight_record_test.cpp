#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "campaign/records/csv.h"
#include "tests/campaign/some_flights.h"

namespace tern {
namespace {

RC_GTEST_PROP(Csv, EveryTextReadsBackEqual, (const std::vector<std::vector<std::string>>& rows)) {
  std::string text;
  std::vector<CsvRecord> written;
  for (CsvRecord row : rows) {
    if (row.empty()) row.emplace_back();
    for (std::string& cell : row) {
      for (char& c : cell) c = "\",\r\n ab;"[static_cast<unsigned char>(c) % 8];
    }
    text += csv_line(row);
    written.push_back(row);
  }
  const CsvRecords read = parse_csv(text);
  RC_ASSERT(read.records == written);
  RC_ASSERT(read.whole_bytes == text.size());
}

RC_GTEST_PROP(Csv, ATornLastLineIsARestAndNothingElseIsLost, ()) {
  const std::string whole = csv_line({"a", "b,\nc"}) + csv_line({"d", "e"});
  const std::string torn = csv_line({"x\ny", "\"quoted\", too"});
  const auto kept = *rc::gen::inRange<std::size_t>(0, torn.size());
  const CsvRecords read = parse_csv(whole + torn.substr(0, kept));
  RC_ASSERT(read.records.size() == 2U);
  RC_ASSERT(read.whole_bytes == whole.size());
}

TEST(Csv, QuotesByTheBook) {
  EXPECT_EQ(csv_line({"plain", "a,b", "say \"hi\"", "", "two\nlines"}),
            "plain,\"a,b\",\"say \"\"hi\"\"\",,\"two\nlines\"\n");
  EXPECT_EQ(parse_csv("a,b\r\nc,\"d\"\r\n").records, (std::vector<CsvRecord>{{"a", "b"}, {"c", "d"}}));
}

TEST(FlightRecord, ReadsBackEqual) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FlightRecord flight = some_flight(seed);
    const auto read = read_flight(to_cells(flight));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_cells(*read), to_cells(flight));
    EXPECT_EQ(read->identity, flight.identity);
    EXPECT_EQ(read->result.flight_time_s, flight.result.flight_time_s);
    EXPECT_EQ(read->result.detail, flight.result.detail);
    EXPECT_EQ(read->tracking.margin_m, flight.tracking.margin_m);
    EXPECT_EQ(std::isnan(read->passively_safe_share), seed % 2 != 0);
    ASSERT_EQ(read->result.exposure.size(), 1U);
    EXPECT_EQ(read->result.exposure[0].region, flight.result.exposure[0].region);
    EXPECT_EQ(read->result.exposure[0].near_metres, flight.result.exposure[0].near_metres);
  }
}

TEST(FlightRecord, AFlightThatNobodyJudgedHasNoMeasures) {
  FlightRecord flight = some_flight(1);
  flight.result = unjudged(FlightOutcome::Failed, "died");
  const auto read = read_flight(to_cells(flight));
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->result.flight_time_s));
  EXPECT_FALSE(is_success(*read));
}

TEST(FlightRecord, SaysWhichCellCannotBeRead) {
  CsvRecord cells = to_cells(some_flight(1));
  cells[1] = "seven";
  EXPECT_EQ(read_flight(cells).error().message, "seed: \"seven\" cannot be read");
  cells.pop_back();
  EXPECT_FALSE(read_flight(cells));
}

TEST(FlightRecord, SuccessIsReachedWithinLimitsAndKeptByTheAudit) {
  FlightRecord flight = some_flight(2);
  flight.result.outcome = FlightOutcome::Reached;
  flight.result.limit_violations = 0;
  for (const char* audit : {"", "passed"}) {
    flight.audit = audit;
    EXPECT_TRUE(is_success(flight)) << audit;
  }
  flight.audit = "broken";
  EXPECT_FALSE(is_success(flight));
  flight.audit = "";
  flight.result.limit_violations = 1;
  EXPECT_FALSE(is_success(flight));
}

}  // namespace
}  // namespace tern
