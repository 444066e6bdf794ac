#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/family/fit_family.h"

namespace lyrefit {

// Relation between the curves of a set.
enum class Family {
  kDeSoto,
  kPvsyst,
  kCec,
  kFree,  // none: every curve is fitted individually
  kAuto,  // the law with the least error on held-out curves
};

template <>
struct EnumTable<Family> {
  static constexpr EnumText<Family> kRows[] = {{Family::kDeSoto, "desoto"},
                                               {Family::kPvsyst, "pvsyst"},
                                               {Family::kCec, "cec"},
                                               {Family::kFree, "free"},
                                               {Family::kAuto, "auto"}};
};

// The flags of `lyrefit fit` for sets of curves.
struct FamilyFlags {
  std::optional<Family> family;
  FamilyOptions options;  // targets of the flags
  std::vector<std::string> against_files;
  std::string pvlib_file;
  std::string pan_file;
  std::string sam_file;
};

// Declares the flags of a set, and --csv, which curves fitted individually have too.
void AddFamilyFlags(VerbLine* verb, FamilyFlags* flags, ReportFlags* output);

// Whether the given flags are compatible: those of one curve with those of a set.
Expected<void> CheckFamilyFlags(const VerbLine& verb, const FamilyFlags& flags);

// Options of the joint fit: the flags of a set and the shared ones of a fit of one curve.
Expected<FamilyOptions> FamilyOptionsFromFlags(const VerbLine& verb, const FamilyFlags& flags,
                                               const FitOptions& fit);

}  // namespace lyrefit
