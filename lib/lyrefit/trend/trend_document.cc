#include <fmt/format.h>

#include <cmath>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/trend/day_series.h"
#include "lyrefit/trend/trend_documents.h"
#include "lyrefit/trend/trend_parts.h"
#include "lyrefit/trend/trend_report.h"
#include "lyrefit/trend/trend_words.h"

namespace lyrefit {
namespace {

std::string TrendRange(const Ranged& one) {
  return std::isfinite(one.low_95) ? Range(one.low_95, one.high_95) : "";
}

std::string StatesText(const TrendReport& report) {
  std::string text = fmt::format("{} of {} on {}", report.states[0],
                                 Plural(report.rows, "measurement"), Plural(report.days, "day"));
  const char* before = "; left out: ";
  for (int s = 1; s < kTrendRowStates; ++s) {
    const auto count = report.states[static_cast<std::size_t>(s)];
    if (count == 0) continue;
    text += fmt::format("{}{} {}", before, count, ToText(static_cast<TrendRowState>(s)));
    before = ", ";
  }
  return text;
}

// "power" of "power, of what the reference lets expect".
std::string ShortTitle(const TrendQuantity& quantity) {
  return quantity.title.substr(0, quantity.title.find(','));
}

Section TrendHead(const TrendReport& report) {
  Section head = {fmt::format("lyrefit {}: trend of {}", report.version, report.name)};
  AddField("measured",
           fmt::format("{} to {}, {}", DateText(report.first_s), DateText(report.last_s),
                       StatesText(report)),
           &head);
  AddField("reference",
           fmt::format("the first clear days, up to {}{}: {} W at 1000 W/m2 and 25 C",
                       DateText(report.reference_end_s),
                       report.reference_capped ? " (no more than a third of the series)" : "",
                       Significant(report.reference_power_W, 4)),
           &head);
  AddField("law",
           fmt::format("{}, two diodes of n = {} and {}, De Soto, from {}",
                       Plural(report.cells_in_series, "cell"), Significant(report.ideality, 4),
                       Significant(2 * report.ideality, 4), report.law),
           &head);
  AddField("seed", fmt::format("{}", report.seed), &head);
  for (const TrendReason& reason : report.reasons) {
    AddField(reason.doubtful ? "DOUBTFUL" : "left out", ReasonText(reason), &head);
  }
  return head;
}

Section LossSection(const TrendReport& report) {
  Section section = {"Losses against the reference"};
  block::Table table = {
      "lrlrl",
      {{"", "energy", "95 % interval", "last 30 days", "95 % interval"}, {"", "%", "%", "%", "%"}}};
  for (const TrendLoss& loss : report.losses) {
    const std::string title = PartTitle(loss.name);
    table.rows.push_back({title.substr(0, title.find(" (")),
                          Significant(loss.energy_percent.value, 3),
                          TrendRange(loss.energy_percent), Significant(loss.now_percent.value, 3),
                          TrendRange(loss.now_percent)});
  }
  AddTable(std::move(table), &section);
  section.blocks.emplace_back(
      block::Legend{"Percent of the energy that the device of the reference would have given, over "
                    "all days and over the last 30 days. Parts are Shapley shares and add up to "
                    "the total."});
  section.blocks.emplace_back(
      block::Legend{"Light: dirt, shade on all cells, or the light sensor. Mismatch: shade on a "
                    "part, bypassed substrings."});
  return section;
}

Section QuantitySection(const TrendReport& report) {
  Section section = {"Parameters at standard conditions over time"};
  const bool short_series = IsBelowAYear(report);
  block::Table table = {"lrrlrl",
                        {{"", "reference", "a year", "95 % interval", "% a year", "seasonal"}}};
  if (short_series) table = {"lrrl", {{"", "reference", "change", "95 % interval"}}};
  for (const TrendQuantity& quantity : report.quantities) {
    const std::string name = quantity.unit.empty()
                                 ? ShortTitle(quantity)
                                 : fmt::format("{} ({})", ShortTitle(quantity), quantity.unit);
    if (!quantity.missing.empty()) {
      table.rows.push_back({name, "-"});
      continue;
    }
    const Ranged& shown = short_series ? quantity.change : quantity.rate_per_year;
    table.rows.push_back(
        {name, Significant(quantity.reference, 4), Significant(shown.value, 3), TrendRange(shown)});
    if (short_series) continue;
    table.rows.back().push_back(std::isfinite(quantity.rate_percent.value)
                                    ? fmt::format("{:+.2f}", quantity.rate_percent.value)
                                    : "");
    table.rows.back().push_back(std::isfinite(quantity.seasonal) ? Significant(quantity.seasonal, 2)
                                                                 : "");
  }
  AddTable(std::move(table), &section);
  section.blocks.emplace_back(block::Legend{
      std::string("Power is relative to what the reference lets expect, light to what "
                  "the sensor reads. Mismatch is that within substrings. ") +
      (short_series ? "Change: so far, without steps but for light. A series of less than 350 "
                      "days has no rates."
                    : "Rates are means without steps, but for light, which rain changes in "
                      "steps. Seasonal: the amplitude, from two years on.")});
  return section;
}

Section ChangeSection(const TrendReport& report) {
  Section section = {"Steps and onsets"};
  block::Table table = {"llllrl", {{"date", "between", "", "quantity", "size", "95 % interval"}}};
  const bool short_series = IsBelowAYear(report);
  for (const TrendQuantity& quantity : report.quantities) {
    for (const TrendChange& change : quantity.changes) {
      const bool by_day = change.onset && short_series;
      const Ranged shown = Scaled(change.size, by_day ? 1 / kYear_days : 1);
      const char* const per = !change.onset ? "" : by_day ? "/d" : "/a";
      table.rows.push_back(
          {DateText(change.time_s),
           fmt::format("{} .. {}", DateText(change.earliest_s), DateText(change.latest_s)),
           change.onset ? "onset" : "step", ShortTitle(quantity),
           fmt::format("{} {}{}", Significant(shown.value, 3), quantity.unit, per),
           TrendRange(shown)});
    }
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  for (const TrendOnset& onset : report.onsets) {
    section.blocks.emplace_back(block::Entry{
        fmt::format("{}, from {} ({} .. {})", onset.cause.title, DateText(onset.time_s),
                    DateText(onset.earliest_s), DateText(onset.latest_s)),
        {onset.sentence()}});
  }
  return section;
}

}  // namespace

Document TrendDocument(const TrendReport& report) {
  Document document;
  document.verdict = report.verdict;
  document.head = TrendHead(report);
  Section conclusion = {"Result"};
  conclusion.blocks.emplace_back(block::Conclusion{report.verdict});
  Section figures = {"Over time"};
  AddFigure(FigureBlock(report), &figures);
  AddSections({WarningSection(report.warnings), std::move(conclusion), LossSection(report),
               ChangeSection(report), QuantitySection(report), std::move(figures),
               ListSection("Not decided", report.not_decided)},
              &document);
  if (!report.options.empty()) {
    AddField("options", OptionsText(report.options), &document.head);
  }
  return document;
}

std::string TrendText(const TrendReport& report) { return DrawText(TrendDocument(report)); }

std::string BriefTrend(const TrendReport& report) {
  return fmt::format("{}: {}\n", report.name, report.verdict);
}

}  // namespace lyrefit
