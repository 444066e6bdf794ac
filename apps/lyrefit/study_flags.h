#pragma once

#include <string>
#include <vector>

#include "bounds_flag.h"
#include "command_line.h"
#include "flags.h"
#include "lyrefit/report/document.h"
#include "lyrefit/study/compare.h"
#include "lyrefit/study/algorithms.h"

namespace lyrefit {

// The flags of the verbs that run searches many times: compare, budget, sensitivity. Lists are one
// text with commas.
struct StudyFlags {
  std::vector<std::string> curve_files;  // curves, or sets of curves
  std::string at;                        // of sets: the curves nearest to these conditions
  std::string curve_ids;                 // of sets: the curves with these ids
  std::string algorithms = "lo,lo+mblss,lo+dmlss,mlo,de,random";
  std::string bounds = "physical";
  BoundsSpec::Table ranges;  // of single parameters
  ConditionOptions conditions;
  CompareOptions options;
  SearchOptions search;
  SearchVariables candidates = SearchVariables::kAll;  // of --algorithms that are searches
  std::string landscape;      // made problems instead of curves: "strings_2,strings_3", "all"
  int devices = 50;           // of each
  ReportFlags output;
};

inline constexpr OptionRow<StudyFlags> kStudyFlagTable[] = {
    OptionRow<StudyFlags>("Curves"),
    {"at", "LIST",
     "of a set of curves: those nearest to 1000x25,200x25 (W/m2 x C; 10 W/m2 are as far as 1 K)",
     &StudyFlags::at},
    {"curves", "LIST", "of a set of curves: those with these ids", &StudyFlags::curve_ids},
    {"devices", "N", "made devices of each problem", &StudyFlags::devices, 1, 10000,
     OptionTrait::kQuiet | OptionTrait::kNoFlag},
    OptionRow<StudyFlags>("Model"),
    {"bound", "P=LOWER:UPPER", "range of one parameter, Rs=0:0.5; once for each",
     RangesOption<&StudyFlags::ranges>(), OptionTrait::kNoFlag},
    OptionRow<StudyFlags>("Search"),
    {"candidates", "NAME", kSearchVariablesDoc, EnumOption<&StudyFlags::candidates>(), OptionTrait::kNoFlag},
};

// Curves, models, objective, bounds, runs, seed, threads, JSON and CSV. The flag of the curves
// comes back: whether it is required is the verb's to say.
Flag AddStudyFlags(VerbLine* verb, StudyFlags* flags);
// --landscape, --devices and --multistart. What goes without them is refused by CheckLandscape().
void AddLandscapeFlags(VerbLine* verb, StudyFlags* flags);
// Either curves or made problems, and nothing said of these that they say themselves. Of a study of
// problems with effects the defaults of runs and multistart.
Expected<void> CheckLandscape(const VerbLine& verb, StudyFlags* flags);
void AddAlgorithmsFlag(VerbLine* verb, StudyFlags* flags);
// The rows of the search's option table with these names; `flags->search` holds the defaults.
void AddSearchRows(VerbLine* verb, const std::vector<std::string>& names, StudyFlags* flags);

// "a,b" as its parts; empty parts are refused in the name of `flag`.
Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text);
Expected<std::vector<double>> ParseNumbers(const std::string& flag, const std::string& text);

// One point of irradiance and temperature.
struct StudyCondition {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
};
// "1000x25,200x25" given to --at.
Expected<std::vector<StudyCondition>> ParseStudyConditions(const std::string& text);

// The made problems of --landscape, or the curves of all files, with their bounds; of sets those
// that --curves and --at name.
Expected<std::vector<CompareCurve>> ReadStudyCurves(const StudyFlags& flags);

// The devices of --landscape.
Expected<std::vector<CompareCurve>> LandscapeSubjects(const StudyFlags& flags);

// One algorithm by its name, and those of --algorithms, with these settings.
Expected<ComparedAlgorithm> ParseAlgorithm(const std::string& name, const SearchOptions& search,
                                   SearchVariables candidates);
Expected<std::vector<ComparedAlgorithm>> ParseAlgorithms(const StudyFlags& flags);

// One file to write when all is done.
struct StudyPicture {
  std::string path;  // empty: not wanted
  Expected<void> (*draw)(const Comparison&, const std::string& path);
};

// Reads the curves, compares, writes what is wanted; returns the exit code.
Expected<int> RunStudy(const VerbLine& verb, const StudyFlags& flags,
                       const std::vector<ComparedAlgorithm>& algorithms,
                       Document (*document)(const Comparison&),
                       const std::vector<StudyPicture>& pictures);

}  // namespace lyrefit
