#include <fmt/format.h>

#include <algorithm>

#include "family_flags.h"
#include "flags.h"
#include "lyrefit/curve/number_text.h"

namespace lyrefit {
namespace {

constexpr double kWorstAccuracy_percent = 50;

// Of a set, but not of what its curves share.
constexpr const char* kSetOnly[] = {"--leave-out", "--truth"};
// Flags that a joint fit does not have.
constexpr const char* kOneCurve[] = {
    "--floor", "--bounds", "--loss",      "--loss-scale",    "--kernel",
    "--curve", "--birds",  "--no-polish", "--temperature-C", "--irradiance-Wm2"};
// Flags about what the curves share.
constexpr const char* kShared[] = {"--shunt",
                                   "--recombination",
                                   "--weights",
                                   "--search-curves",
                                   "--fit-curves",
                                   "--irradiance-offset",
                                   "--folds",
                                   "--temperature-offset",
                                   "--irradiance-accuracy",
                                   "--free",
                                   "--temperature-accuracy",
                                   "--no-free-fits",
                                   "--against",
                                   "--pvlib"};
// Choices that auto makes.
constexpr const char* kChosenByAuto[] = {"--model", "--shunt", "--recombination"};

// Refuses the first of `names` that was given, in a sentence about it.
template <class Names>
Expected<void> RefuseGiven(const Verb& verb, const Names& names, const std::string& sentence) {
  for (const char* const name : names) {
    if (verb.Given(name)) return Fail(fmt::format("{} {}", name, sentence));
  }
  return {};
}

// "2" or "2%" as 0.02.
Expected<double> ParseAccuracy(const std::string& text) {
  const bool sign = !text.empty() && text.back() == '%';
  const std::optional<double> percent = ParseNumber(sign ? text.substr(0, text.size() - 1) : text);
  if (!percent || !(*percent >= 0 && *percent <= kWorstAccuracy_percent)) {
    return Fail(
        fmt::format("--irradiance-accuracy: expected percent from 0 to {}, such as 2 or "
                    "2%, found '{}'",
                    kWorstAccuracy_percent, text));
  }
  return *percent / 100;
}

void SplitAtCommas(const std::string& text, std::vector<std::string>* ids) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) ids->push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

// What no law knows is refused before anything is read.
Expected<void> CheckLaw(const FamilyFlags& flags, const FamilyOptions& options) {
  if (flags.family != Family::kDeSoto && flags.family != Family::kPvsyst) return {};
  TranslationSpec spec;
  spec.law = options.law;
  spec.model = options.model;
  spec.recombination = options.recombination;
  const bool pvsyst = spec.law == TranslationLaw::kPvsyst;
  const ShuntLaw own = pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse;
  spec.shunt = options.shunt.value_or(own);
  const Expected<Translation> known = MakeTranslation(spec);
  if (!known) return tl::unexpected(known.error());
  if (!flags.pvlib_file.empty() && spec.model != Model::kSingleDiode) {
    return Fail("--pvlib: pvlib knows one diode: expected --model sd");
  }
  if (!flags.pvlib_file.empty() && spec.shunt != own) {
    return Fail(fmt::format("--pvlib: pvlib's {} knows the shunt law {} only, not {}",
                            ToText(spec.law), ToText(own), ToText(spec.shunt)));
  }
  return {};
}

}  // namespace

Expected<void> CheckFamilyFlags(const Verb& verb, const FamilyFlags& flags) {
  if (!flags.family) {
    const std::string need =
        "is about a set of curves: it needs --family desoto, pvsyst, free or auto";
    if (auto checked = RefuseGiven(verb, kShared, need); !checked) return checked;
    return RefuseGiven(verb, kSetOnly, need);
  }
  if (auto checked = RefuseGiven(verb, kOneCurve, "is for one curve, not for --family"); !checked) {
    return checked;
  }
  if (flags.family == Family::kFree) {
    return RefuseGiven(verb, kShared,
                       "is about what curves share: --family free fits every curve on its own");
  }
  if (flags.family == Family::kAuto) {
    return RefuseGiven(verb, kChosenByAuto,
                       "is what --family auto chooses: it is for --family desoto and pvsyst");
  }
  return {};
}

Expected<FamilyOptions> FamilyOptionsFromFlags(const Verb& verb, const FamilyFlags& flags,
                                               const FitOptions& fit,
                                               const std::vector<std::string>& ranges) {
  FamilyOptions options = flags.options;
  const bool joint = flags.family != Family::kFree;
  if (joint && verb.Given("--intervals") && fit.intervals == Intervals::kProfile) {
    return Fail("--intervals: a joint fit has symmetric intervals or none, not profile");
  }
  if (joint && fit.errors.kind != ErrorKind::kWhite) {
    return Fail(
        "--noise: a joint fit weighs by --weights alone; its intervals take the errors of the "
        "readings and of whole curves into account by themselves");
  }
  options.law = flags.family == Family::kPvsyst ? TranslationLaw::kPvsyst : TranslationLaw::kDeSoto;
  options.model = fit.model;
  options.objective = fit.objective;
  options.constants = fit.constants;
  options.fixed = fit.fixed;
  options.intervals = fit.intervals != Intervals::kNone;
  options.threads = fit.threads;
  options.free_fits = !flags.no_free_fits;
  options.with = fit.with;
  options.force_effects = fit.force_effects;
  options.errors = fit.errors;
  options.search = fit.search;
  const SearchOptions usual = FamilyOptions::FamilySearch();
  if (joint && !verb.Given("--population")) options.search.population = usual.population;
  if (joint && !verb.Given("--iterations")) options.search.iterations = usual.iterations;
  for (const std::string& text : ranges) {
    const auto range = ParseRange("--bound", text);
    if (!range) return tl::unexpected(range.error());
    options.bounds[range->first] = range->second;
  }
  for (const std::string& text : flags.leave_out) SplitAtCommas(text, &options.leave_out);
  if (!flags.irradiance_accuracy.empty()) {
    const Expected<double> accuracy = ParseAccuracy(flags.irradiance_accuracy);
    if (!accuracy) return tl::unexpected(accuracy.error());
    options.irradiance_accuracy = *accuracy;
  }
  if (auto known = CheckLaw(flags, options); !known) return tl::unexpected(known.error());
  for (const std::string& file : flags.against_files) {
    Expected<NamedParameters> other = ReadPvlibParameters(file);
    if (!other) return tl::unexpected(other.error());
    options.against.push_back(std::move(*other));
  }
  return options;
}

}  // namespace lyrefit
