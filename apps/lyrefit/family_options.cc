#include <fmt/format.h>

#include <optional>

#include "family_flags.h"
#include "flags.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/read_module.h"

namespace lyrefit {
namespace {

// Flags about a set of curves, but not about their common device.
constexpr const char* kSetOnly[] = {"--leave-out"};
// Flags of a fit of one curve that a joint fit does not have.
constexpr const char* kOneCurve[] = {"--floor",     "--bounds",        "--kernel",        "--curve",
                                     "--no-polish", "--temperature-C", "--irradiance-Wm2"};
constexpr const char* kRobust[] = {"--loss", "--loss-scale"};
// Flags about the parameters that the curves share.
constexpr const char* kShared[] = {"--shunt",
                                   "--recombination",
                                   "--residuals",
                                   "--key-point-errors",
                                   "--weights",
                                   "--search-curves",
                                   "--fit-curves",
                                   "--irradiance-offset",
                                   "--folds",
                                   "--temperature-offset",
                                   "--irradiance-accuracy",
                                   "--free",
                                   "--temperature-accuracy",
                                   "--no-individual-fits",
                                   "--against",
                                   "--pvlib",
                                   "--pan",
                                   "--sam"};
// Options that --family auto selects.
constexpr const char* kChosenByAuto[] = {"--model", "--shunt", "--recombination"};

// Rejects the first given flag of `names`, with a sentence about it.
template <class Names>
Expected<void> RefuseGiven(const VerbLine& verb, const Names& names, const std::string& sentence) {
  for (const char* const name : names) {
    if (verb.Given(name)) return Fail(fmt::format("{} {}", name, sentence));
  }
  return {};
}

// The law of a joint fit; none if it is free or chosen.
std::optional<TranslationLaw> LawOf(Family family) {
  switch (family) {
    case Family::kDeSoto:
      return TranslationLaw::kDeSoto;
    case Family::kPvsyst:
      return TranslationLaw::kPvsyst;
    case Family::kCec:
      return TranslationLaw::kCec;
    case Family::kFree:
    case Family::kAuto:
      break;
  }
  return std::nullopt;
}

// Rejects options that the law does not have, before any file is read.
Expected<void> CheckLaw(const FamilyFlags& flags, const FamilyOptions& options) {
  if (!LawOf(*flags.family)) return {};
  TranslationSpec spec;
  spec.law = options.law;
  spec.model = options.model;
  spec.recombination = options.recombination;
  const bool pvsyst = spec.law == TranslationLaw::kPvsyst;
  const ShuntLaw own = pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse;
  spec.shunt = options.shunt.value_or(own);
  TRY(MakeTranslation(spec));
  if (!flags.pvlib_file.empty() && spec.model != Model::kSingleDiode) {
    return Fail("--pvlib: pvlib knows one diode: expected --model sd");
  }
  if (!flags.pvlib_file.empty() && spec.shunt != own) {
    return Fail(fmt::format("--pvlib: pvlib's {} knows the shunt law {} only, not {}",
                            ToText(spec.law), ToText(own), ToText(spec.shunt)));
  }
  return {};
}

// Rejects, before any file is read, what a PAN file cannot state.
Expected<void> CheckPan(const FamilyFlags& flags, const FamilyOptions& options) {
  if (flags.pan_file.empty()) return {};
  const auto law = LawOf(*flags.family);
  if (law && law != TranslationLaw::kPvsyst) {
    return Fail("--pan: a PAN file takes the law pvsyst: expected --family pvsyst");
  }
  if (flags.family == Family::kPvsyst && options.model != Model::kSingleDiode) {
    return Fail("--pan: a PAN file has one diode: expected --model sd");
  }
  return {};
}

}  // namespace

Expected<void> CheckFamilyFlags(const VerbLine& verb, const FamilyFlags& flags) {
  if (!flags.family) {
    const std::string need =
        "is about a set of curves: it needs --family desoto, pvsyst, cec, free or auto";
    TRY(RefuseGiven(verb, kShared, need));
    return RefuseGiven(verb, kSetOnly, need);
  }
  TRY(RefuseGiven(verb, kOneCurve, "is for one curve, not for --family"));
  TRY(RefuseGiven(verb, kRobust,
                  "is for one curve. A joint fit names curves and key points that the others "
                  "contradict, with the parameters without them; --leave-out ID leaves one out"));
  if (flags.family == Family::kFree) {
    return RefuseGiven(verb, kShared,
                       "is about what curves share: --family free fits every curve on its own");
  }
  if (flags.family == Family::kAuto) {
    return RefuseGiven(verb, kChosenByAuto,
                       "is what --family auto chooses: it is for --family desoto, pvsyst and cec");
  }
  return {};
}

Expected<FamilyOptions> FamilyOptionsFromFlags(const VerbLine& verb, const FamilyFlags& flags,
                                               const FitOptions& fit) {
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
  options.law = LawOf(*flags.family).value_or(TranslationLaw::kDeSoto);
  options.model = fit.model;
  options.objective = fit.objective;
  options.constants = fit.constants;
  options.fixed = fit.fixed;
  options.intervals = fit.intervals != Intervals::kNone;
  options.threads = fit.threads;
  options.with = fit.with;
  options.force_effects = fit.force_effects;
  options.errors = fit.errors;
  options.search = fit.search;
  const SearchOptions usual = FamilyOptions::FamilySearch();
  if (joint && !verb.Given("--population")) options.search.population = usual.population;
  if (joint && !verb.Given("--iterations")) options.search.iterations = usual.iterations;
  options.bounds = fit.bounds.overrides;
  TRY(CheckLaw(flags, options));
  TRY(CheckPan(flags, options));
  if (!flags.sam_file.empty() && flags.family == Family::kPvsyst) {
    return Fail("--sam: SAM's modules follow the law cec or desoto: expected --family cec");
  }
  for (const std::string& file : flags.against_files) {
    TRY(NamedParameters other, ReadModuleParameters(file));
    options.against.push_back(std::move(other));
  }
  return options;
}

}  // namespace lyrefit
