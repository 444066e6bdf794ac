#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/fit/fit.h"

namespace lyrefit {

// How the curves of a set hang together.
enum class Family {
  kDeSoto,
  kPvsyst,
  kFree,  // not at all: every curve on its own
  kAuto,  // by the law that errs least on curves it did not see
};

template <>
struct EnumTable<Family> {
  static constexpr EnumText<Family> kRows[] = {{Family::kDeSoto, "desoto"},
                                               {Family::kPvsyst, "pvsyst"},
                                               {Family::kFree, "free"},
                                               {Family::kAuto, "auto"}};
};

// The flags of `lyrefit fit` that are about sets of curves.
struct FamilyFlags {
  std::optional<Family> family;
  FamilyOptions options;  // where the flags write
  std::string irradiance_accuracy;
  std::vector<std::string> leave_out;  // each one id or several with commas
  bool no_free_fits = false;
  std::vector<std::string> against_files;
  std::string csv_file;
  std::string pvlib_file;
  std::string truth_file;
};

void AddFamilyFlags(Verb* verb, FamilyFlags* flags);

// Whether the flags given to the verb go together: those of one curve with those of a set.
Expected<void> CheckFamilyFlags(const Verb& verb, const FamilyFlags& flags);

// The options of the joint fit: family flags, and those that the verb has for one curve as well.
// `ranges` are those of --bound.
Expected<FamilyOptions> FamilyOptionsFromFlags(const Verb& verb, const FamilyFlags& flags,
                                               const FitOptions& fit,
                                               const std::vector<std::string>& ranges);

}  // namespace lyrefit
