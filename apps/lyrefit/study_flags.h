#pragma once

#include <string>
#include <vector>

#include "bounds_flag.h"
#include "command_line.h"
#include "flags.h"
#include "lyrefit/report/document.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"

namespace lyrefit {

// Flags of the verbs that run searches many times: compare, budget, sensitivity. Lists are texts
// separated by commas.
struct StudyFlags {
  std::vector<std::string> curve_files;  // curves, or sets of curves
  std::string at;                        // of sets: selects the curves nearest to these conditions
  std::string curve_ids;                 // of sets: selects the curves with these ids
  std::string algorithms = "lo,lo+mblss,lo+dmlss,mlo,de,random";
  std::string bounds = "physical";
  BoundsSpec::Table ranges;  // of single parameters
  ConditionOptions conditions;
  CompareOptions options;
  SearchOptions search;
  ReportFlags output;
};

inline constexpr OptionRow<StudyFlags> kStudyFlagTable[] = {
    OptionRow<StudyFlags>("Curves"),
    {"at", "LIST",
     "of a set of curves: those nearest to 1000x25,200x25 (W/m2 x C; 10 W/m2 are as far as 1 K)",
     &StudyFlags::at},
    {"curves", "LIST", "of a set of curves: those with these ids", &StudyFlags::curve_ids},
    OptionRow<StudyFlags>("Model"),
    {"bound", "P=LOWER:UPPER", "range of one parameter, Rs=0:0.5; once for each",
     RangesOption<&StudyFlags::ranges>(), OptionTrait::kNoFlag},
};

// Declares the flags of curves, models, objective, bounds, runs, seed, threads, JSON and CSV.
void AddStudyFlags(VerbLine* verb, StudyFlags* flags);
void AddAlgorithmsFlag(VerbLine* verb, StudyFlags* flags);
// Declares the rows of these names of the search's option table; `flags->search` holds the
// defaults.
void AddSearchRows(VerbLine* verb, const std::vector<std::string>& names, StudyFlags* flags);

// Splits "a,b" at commas; an empty part is an error that names `flag`.
Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text);
Expected<std::vector<double>> ParseNumbers(const std::string& flag, const std::string& text);

// One pair of irradiance and temperature.
struct StudyCondition {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
};
// Parses "1000x25,200x25", given to --at.
Expected<std::vector<StudyCondition>> ParseStudyConditions(const std::string& text);

// The curves of all files, with their bounds. --curves and --at select the curves of sets.
Expected<std::vector<CompareCurve>> ReadStudyCurves(const StudyFlags& flags);

// An algorithm by its name, and all those of --algorithms, with these settings.
Expected<ComparedAlgorithm> ParseAlgorithm(const std::string& name, const SearchOptions& search);
Expected<std::vector<ComparedAlgorithm>> ParseAlgorithms(const StudyFlags& flags);

// A picture that is written at the end.
struct StudyPicture {
  std::string path;  // empty: not wanted
  Expected<void> (*draw)(const Comparison&, const std::string& path);
};

// Reads the curves, compares the algorithms, writes the requested outputs; returns the exit code.
Expected<int> RunStudy(const VerbLine& verb, const StudyFlags& flags,
                       const std::vector<ComparedAlgorithm>& algorithms,
                       Document (*document)(const Comparison&),
                       const std::vector<StudyPicture>& pictures);

}  // namespace lyrefit
