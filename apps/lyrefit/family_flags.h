#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
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
  std::vector<std::string> against_files;
  std::string pvlib_file;
  std::string truth_file;
};

// With --csv, which families have in common with curves fitted one by one.
void AddFamilyFlags(VerbLine* verb, FamilyFlags* flags, ReportFlags* output);

// Whether the flags given to the verb go together: those of one curve with those of a set.
Expected<void> CheckFamilyFlags(const VerbLine& verb, const FamilyFlags& flags);

// The options of the joint fit: family flags, and those that the verb has for one curve as well.
Expected<FamilyOptions> FamilyOptionsFromFlags(const VerbLine& verb, const FamilyFlags& flags,
                                               const FitOptions& fit);

}  // namespace lyrefit
