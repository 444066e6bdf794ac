#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/document.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "studies/coverage.h"

namespace lyrefit {
namespace {

std::string PercentText(double share, int digits = 1) {
  return std::isnan(share) ? "-" : fmt::format("{:.{}f} %", 100 * share, digits);
}

std::string Promise(const ParameterCoverage& p, bool any_fit) {
  constexpr double kPromised = 0.95;
  if (p.counted == 0) return p.fitted == 0 && any_fit ? "fixed" : "-";
  if (p.high_95 < kPromised) return "too narrow";
  return p.low_95 > kPromised ? "too wide" : "as promised";
}

block::Table ParameterTable(const CoverageReport& report) {
  block::Table table = {
      "lrlrrrl",
      {{"parameter", "coverage", "95 % range", "sets", "half-width", "not identifiable", ""}}};
  const bool any_fit = report.failed < static_cast<int>(report.sets.size());
  for (const ParameterCoverage& p : report.parameters) {
    const bool any = p.counted > 0;
    const std::string width =
        p.offset ? Significant(p.median_half_width, 2) : PercentText(p.median_half_width, 2);
    const double lost = p.fitted > 0 ? static_cast<double>(p.not_identifiable) / p.fitted : NAN;
    table.rows.push_back({p.info.symbol, PercentText(p.coverage),
                          any ? PercentText(p.low_95) + " .. " + PercentText(p.high_95) : "-",
                          std::to_string(p.counted), any ? width : "-", PercentText(lost),
                          Promise(p, any_fit)});
  }
  return table;
}

std::string DeviceText(const CoverageOptions& options) {
  const std::string law =
      fmt::format("{} law, {} model", ToText(options.family.law), ModelTitle(options.family.model));
  if (options.module.empty()) return law + ", a module drawn for every set";
  return law + fmt::format(", one module of {}", Plural(options.cells_in_series, "cell"));
}

std::string SensorText(const CoverageOptions& options) {
  const auto one = [](double error, const char* unit, bool fitted) {
    return fmt::format("{:+g} {}, offset {}", error, unit, fitted ? "fitted" : "not fitted");
  };
  return "temperature reads " +
         one(options.temperature_error_K, "K", options.family.temperature_offset) +
         "; irradiance reads " +
         one(options.irradiance_error_W_m2, "W/m2", options.family.irradiance_offset);
}

const char* NoiseText(CoverageNoise noise) {
  switch (noise) {
    case CoverageNoise::kIsc:
      return "each curve's Isc";
    case CoverageNoise::kCorrelated:
      return "each curve's Isc, correlated over one Voc";
    case CoverageNoise::kEqual:
      break;
  }
  return "Isc at the reference";
}

// "12 of 400 sets (1.7 .. 5.2 %)"
std::string SharesText(int hits, int trials) {
  const Share share = WilsonInterval(hits, trials);
  return fmt::format("{} of {} ({} .. {})", hits, Plural(trials, "set"), PercentText(share.low_95),
                     PercentText(share.high_95));
}

// Explanation of the table. Half-widths of offsets are in their own unit.
std::string HowToRead(const CoverageReport& report) {
  std::string text =
      "Coverage: how often the 95 % interval holds the truth, over the sets where the parameter is "
      "fitted and identifiable, with Wilson's 95 % range of that share. Half-width: median, "
      "relative to the truth";
  const bool offsets =
      report.options.family.temperature_offset || report.options.family.irradiance_offset;
  return text + (offsets ? "; of offsets (dT in K, dG in W/m2) in their own unit." : ".");
}

}  // namespace

std::string CoverageText(const CoverageReport& report) {
  const CoverageOptions& o = report.options;
  Document document;
  if (report.interrupted) {
    document.banners = {"INTERRUPTED: only the sets that were done are counted."};
  }
  Section& head = document.head;
  head.heading = fmt::format("lyrefit {}: coverage of the 95 % intervals of joint fits, {}",
                             report.version, Plural(report.sets.size(), "simulated set"));
  AddField("device", DeviceText(o), &head);
  const std::string curves = o.curves > 0 ? Plural(o.curves, "curve") : "5 to 30 curves";
  AddField("sets",
           o.noise == CoverageNoise::kKeyPoints
               ? fmt::format("key points of {} each, errors {}, seed {}", curves,
                             KeyPointErrorsText({}), o.seed)
               : fmt::format("{} of {} points each, noise {:g} of {}, seed {}", curves, o.points,
                             o.noise_relative, NoiseText(o.noise), o.seed),
           &head);
  AddField("sensors", SensorText(o), &head);
  if (report.failed > 0) {
    AddField("failed", fmt::format("{} without a usable fit", Plural(report.failed, "set")), &head);
  }
  const int fits = static_cast<int>(report.sets.size()) - report.failed;
  AddField("weights",
           fmt::format("{}: relative to Isc in {}", ToText(o.family.weights),
                       SharesText(report.relative, fits)),
           &head);
  AddField("correlated errors", "found in " + SharesText(report.correlated, fits), &head);
  AddField("time", Duration(report.seconds), &head);
  AddSections({{"", {ParameterTable(report)}}, {"", {block::Sentence{HowToRead(report)}}}},
              &document);
  return DrawText(document);
}

}  // namespace lyrefit
