#include "campaign/records/campaign_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "campaign/records/distinct_flights.h"

namespace tern {
namespace {

using Pair = std::pair<const FlightRecord*, const FlightRecord*>;
using Numbers = std::map<std::string, double>;

bool reached(const FlightRecord& r) { return r.result.outcome == FlightOutcome::Reached; }

/// Returns the metres inside and within 1 m of each region, by the name of the row.
Numbers exposure_of(const FlightRecord& r) {
  Numbers metres;
  for (const Exposure& e : r.result.exposure) {
    metres["inside " + e.region + ", m"] = e.metres;
    metres["within 1 m of " + e.region + ", m"] = e.near_metres;
  }
  return metres;
}

void add_columns(CampaignComparison& comparison, const std::vector<Pair>& pairs) {
  const std::vector<ColumnNote> notes = column_notes();
  std::vector<std::vector<std::pair<double, double>>> numbers(notes.size());
  for (const auto& [a, b] : pairs) {
    const CsvRecord cells_a = to_cells(*a);
    const CsvRecord cells_b = to_cells(*b);
    for (std::size_t k = 0; k < notes.size(); ++k) {
      if (notes[k].compared == Compared::No || cells_a[k].empty() || cells_b[k].empty()) continue;
      if (notes[k].compared == Compared::Reached && !(reached(*a) && reached(*b))) continue;
      numbers[k].emplace_back(std::stod(cells_a[k]), std::stod(cells_b[k]));
    }
  }
  for (std::size_t k = 0; k < notes.size(); ++k) {
    if (numbers[k].empty()) continue;
    comparison.measures.push_back({notes[k].name, notes[k].meaning, paired_difference(numbers[k])});
  }
}

void add_exposure(CampaignComparison& comparison, const std::vector<Pair>& pairs) {
  std::map<std::string, std::vector<std::pair<double, double>>> numbers;
  for (const auto& [a, b] : pairs) {
    const Numbers of_b = exposure_of(*b);
    for (const auto& [row, metres] : exposure_of(*a)) {
      if (const auto other = of_b.find(row); other != of_b.end()) numbers[row].emplace_back(metres, other->second);
    }
  }
  for (const auto& [row, both] : numbers) comparison.measures.push_back({row, "of the path", paired_difference(both)});
}

using Row = std::vector<std::string>;

std::string escaped(const std::string& text, TableForm form) {
  if (form != TableForm::Latex) return text;
  std::string out;
  for (const char c : text)
    out += (std::string_view("_%&#").find(c) != std::string_view::npos ? "\\" : "") + std::string(1, c);
  return out;
}

/// The first row is the header, and the first column is text.
std::string table(const std::vector<Row>& rows, TableForm form) {
  const std::size_t columns = rows.front().size();
  if (form == TableForm::Text) {
    std::string out;
    for (const Row& row : rows) {
      out += fmt::format("  {:<36}", row[0]);
      for (std::size_t k = 1; k < columns; ++k) out += fmt::format("{:>{}}", row[k], k + 1 == columns ? 26 : 12);
      out += "\n";
    }
    return out;
  }
  const bool latex = form == TableForm::Latex;
  std::string out = latex ? "\\begin{tabular}{l" + std::string(columns - 1, 'r') + "}\n\\hline\n" : "";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += latex ? "" : "| ";
    for (std::size_t k = 0; k < columns; ++k) {
      out += escaped(rows[i][k], form) + (k + 1 < columns ? (latex ? " & " : " | ") : (latex ? " \\\\\n" : " |\n"));
    }
    if (i > 0) continue;
    if (latex) {
      out += "\\hline\n";
    } else {
      out += "|---|";
      for (std::size_t k = 1; k < columns; ++k) out += "---:|";
      out += "\n";
    }
  }
  return latex ? out + "\\hline\n\\end{tabular}\n" : out;
}

std::string number(double x) { return fmt::format("{:.4g}", x); }

std::string heading(const CampaignComparison& c) {
  std::string text = fmt::format("{}\n{}\n{} seeds in both", in_words("A", c.a), in_words("B", c.b), c.pairs);
  if (c.only_in_a + c.only_in_b > 0) {
    text += fmt::format("; left out: {} in A alone, {} in B alone", c.only_in_a, c.only_in_b);
  }
  return text + "\n";
}

std::string success_lines(const CampaignComparison& c) {
  const auto percent = [&](std::int64_t n) { return 100.0 * static_cast<double>(n) / static_cast<double>(c.pairs); };
  std::string text = fmt::format("success: A {} ({:.1f} %), B {} ({:.1f} %)", c.successes_a, percent(c.successes_a),
                                 c.successes_b, percent(c.successes_b));
  text += c.may_infer() ? fmt::format("; McNemar p = {:.3g}\n", c.p_value) : "\n";
  if (!c.a_alone.empty()) text += fmt::format("A alone succeeds at seeds {}\n", fmt::join(c.a_alone, " "));
  if (!c.b_alone.empty()) text += fmt::format("B alone succeeds at seeds {}\n", fmt::join(c.b_alone, " "));
  if (c.same_flights) {
    text += "no intervals: A and B are the same flights, of one configuration and version\n";
  } else if (!c.may_infer()) {
    text += fmt::format(
        "no intervals: of {} flights, {} of A and {} of B differ from the others; equal flights add no information\n",
        c.pairs, c.different_a, c.different_b);
  }
  return text;
}

}  // namespace

std::string in_words(const char* which, const CampaignIdentity& id) {
  return fmt::format("{}: {}{}, charge {}, configuration {}, version {}", which, id.scenario,
                     id.count > 0 ? fmt::format(" {}", id.count) : "", id.charge, id.configuration, id.version);
}

std::int64_t different_flights(const std::map<std::uint64_t, FlightRecord>& records) {
  DistinctFlights different;
  for (const auto& [seed, record] : records) different.add(record);
  return different.count();
}

Result<CampaignComparison> compare(const Flights& a, const Flights& b) {
  CampaignComparison c;
  std::vector<Pair> pairs;
  std::map<std::uint64_t, FlightRecord> paired_a, paired_b;
  for (const auto& [seed, record] : a.records) {
    const auto other = b.records.find(seed);
    if (other == b.records.end()) {
      ++c.only_in_a;
      continue;
    }
    pairs.emplace_back(&record, &other->second);
    paired_a.emplace(seed, record);
    paired_b.emplace(seed, other->second);
    const bool success_a = is_success(record);
    const bool success_b = is_success(other->second);
    c.successes_a += success_a ? 1 : 0;
    c.successes_b += success_b ? 1 : 0;
    if (success_a && !success_b) c.a_alone.push_back(seed);
    if (success_b && !success_a) c.b_alone.push_back(seed);
  }
  if (pairs.empty()) return fail("no seed is in both files");
  c.pairs = static_cast<std::int64_t>(pairs.size());
  c.only_in_b = static_cast<std::int64_t>(b.records.size()) - c.pairs;
  c.a = pairs.front().first->identity;
  c.b = pairs.front().second->identity;
  if (c.a.scenario != c.b.scenario) {
    return fail(fmt::format("their scenarios differ, \"{}\" and \"{}\": their seeds cannot be compared", c.a.scenario,
                            c.b.scenario));
  }
  c.p_value = mcnemar(static_cast<std::int64_t>(c.a_alone.size()), static_cast<std::int64_t>(c.b_alone.size()));
  c.different_a = different_flights(paired_a);
  c.different_b = different_flights(paired_b);
  add_columns(c, pairs);
  add_exposure(c, pairs);
  c.same_flights = c.a == c.b && c.a_alone.empty() && c.b_alone.empty() &&
                   std::all_of(c.measures.begin(), c.measures.end(),
                               [](const ComparedMeasure& m) { return m.difference.different == 0; });
  return c;
}

std::string to_text(const CampaignComparison& c, TableForm form) {
  std::vector<Row> rows = {{"measure", "pairs", "A", "B", "B - A", "95 % interval"}};
  std::vector<std::string> equal;
  for (const ComparedMeasure& m : c.measures) {
    const PairedDifference& d = m.difference;
    if (d.different == 0) {
      equal.push_back(m.name);
      continue;
    }
    rows.push_back({m.name, fmt::format("{}", d.pairs), number(d.mean_a), number(d.mean_b), number(d.difference),
                    c.may_infer() && d.may_infer()
                        ? fmt::format("[{}, {}]", number(d.interval.low), number(d.interval.high))
                        : "-"});
  }
  const std::string gap = form == TableForm::Text ? "" : "\n";
  const std::string notes = heading(c) + gap + success_lines(c) + gap;
  if (rows.size() == 1) return notes + "all pairs are equal in every measure: A and B are the same flights\n";
  if (form == TableForm::Latex) return table(rows, form);
  const std::string others =
      equal.empty() ? "" : fmt::format("{}equal in all pairs: {}\n", gap, fmt::join(equal, ", "));
  return notes + table(rows, form) + others;
}

}  // namespace tern
