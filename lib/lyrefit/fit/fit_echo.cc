#include "lyrefit/fit/fit_echo.h"

#include <fmt/format.h>

namespace lyrefit {

Expected<void> CheckErrorSpec(const FitOptions& options) {
  if (options.errors.kind == ErrorKind::kWhite) return {};
  if (options.objective == Objective::kMeasuredCurrent) {
    return Fail(
        "noise weighs the solved current alone: the errors of a reading stand on both sides of the "
        "measured-current equation");
  }
  if (options.loss != Loss::kSquared) return Fail("noise weighs squared residuals: leave out loss");
  if (!options.polish) return Fail("noise weighs the polish, which is switched off");
  return {};
}

void EchoOptions(const FitOptions& options, FitReport* report) {
  const FitOptions defaults;
  std::vector<OptionEcho>& echoes = report->non_default_options;
  const auto echo = [&](const char* name, const std::string& value, const std::string& usual) {
    if (value != usual) echoes.push_back({name, value, usual});
  };
  echo("objective", ToText(options.objective), ToText(defaults.objective));
  echo("constants", ToText(options.constants), ToText(defaults.constants));
  echo("bounds", options.bounds.name, defaults.bounds.name);
  for (const auto& [key, range] : options.bounds.overrides) {
    echo("bound", fmt::format("{}={:g}:{:g}", key, range.first, range.second), "");
  }
  for (const EffectUse& use : options.with) echo("with", DescribeUse(use), "");
  echo("force", options.force_effects ? "yes" : "no", "no");
  for (const auto& [key, value] : options.fixed)
    echo("fix", fmt::format("{}={:g}", key, value), "");
  echo("searcher", options.searcher ? "custom" : "", "");
  echo("plain-polish", options.plain_polish ? "yes" : "no", "no");
  echo("algorithm", ToText(options.search.algorithm), ToText(defaults.search.algorithm));
  echo("birds", ToText(options.birds), ToText(defaults.birds));
  AppendNonDefaults(options.search,
                    options.with.empty() ? defaults.search : FitOptions::SearchBesideShapes(),
                    kSearchOptionTable, &echoes);
  echo("random-baseline", options.random_baseline ? "yes" : "no", "yes");
  echo("polish", options.polish ? "yes" : "no", "yes");
  echo("floor", options.floor ? "yes" : "no", "no");
  echo("noise", options.errors.name, defaults.errors.name);
  echo("loss", ToText(options.loss), ToText(defaults.loss));
  echo("loss-scale", NumberText(options.loss_scale), NumberText(defaults.loss_scale));
  echo("intervals", ToText(options.intervals), ToText(defaults.intervals));
}

}  // namespace lyrefit
