#include "plant/sample_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lyrefit {
namespace {

constexpr std::size_t kMostSamples = 40;  // in the text

std::string QuartileText(const Quartiles& found, double factor, int digits) {
  if (found.count == 0) return "";
  const auto text = [&](double value) { return fmt::format("{:.{}f}", factor * value, digits); };
  if (found.count == 1) return text(found.median);
  return fmt::format("{} [{}, {}]", text(found.median), text(found.low), text(found.high));
}

std::string ChampionText(const SampleDirection& one) {
  const std::string leaf = one.champion.substr(one.champion.rfind('/') + 1);
  if (std::isfinite(one.champion_efficiency)) {
    return fmt::format("{} {:.2f} %", leaf, 100 * one.champion_efficiency);
  }
  return fmt::format("{} {:.3g} mW", leaf, 1e3 * one.champion_pmp_W);
}

std::string CountsText(const std::map<std::string, std::int64_t>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

void AddSampleRows(const SampleSummary& sample, block::Table* table) {
  std::string title =
      fmt::format("{}: {} of {} work", sample.name, sample.working(), sample.pixels);
  if (std::isfinite(sample.yield())) {
    title += fmt::format(", yield {:.0f} %", 100 * sample.yield());
  }
  if (!sample.senses.empty()) title += "; hysteresis of pairs: " + CountsText(sample.senses);
  table->spans.push_back({table->rows.size(), title});
  for (const SampleDirection& one : sample.directions) {
    table->rows.push_back({one.direction, QuartileText(one.quantities[0], 100, 2),
                           QuartileText(one.quantities[1], 1, 2),
                           QuartileText(one.quantities[2], 1, 3),
                           QuartileText(one.quantities[3], 100, 1), ChampionText(one)});
  }
  if (sample.directions.empty()) table->rows.push_back({"-"});
}

Section NotWorkingSection(const std::vector<SampleSummary>& samples, std::size_t shown,
                          const std::string& criterion) {
  Section section = {"Pixels that do not work"};
  AddSentence(criterion, &section);
  block::Table table = {"lw", {{"sample", "pixels"}}};
  for (std::size_t i = 0; i < shown; ++i) {
    if (samples[i].not_working.empty()) continue;
    table.rows.push_back(
        {samples[i].name, fmt::format("{}", fmt::join(samples[i].not_working, "; "))});
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  return section;
}

}  // namespace

std::vector<Section> SampleSections(const std::vector<SampleSummary>& samples,
                                    const std::string& criterion) {
  if (samples.empty()) return {};
  const std::size_t shown = std::min(samples.size(), kMostSamples);
  Section statistics = {"Samples"};
  AddSentence("Median [quartiles] of the working pixels, and the best of them.", &statistics);
  block::Table table = {
      "lrrrrl", {{"direction", "efficiency, %", "Jsc, mA/cm2", "Voc, V", "FF, %", "champion"}}};
  for (std::size_t i = 0; i < shown; ++i) AddSampleRows(samples[i], &table);
  AddTable(std::move(table), &statistics);
  if (shown < samples.size()) {
    AddSentence(fmt::format("{} more samples are in samples.csv.", samples.size() - shown),
                &statistics);
  }
  return {std::move(statistics), NotWorkingSection(samples, shown, criterion)};
}

}  // namespace lyrefit
