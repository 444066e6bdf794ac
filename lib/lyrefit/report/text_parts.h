#pragma once
// Functions shared by the reports.

#include <string>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/report/document.h"

namespace lyrefit {

// Title of a model: "single-diode".
std::string ModelTitle(Model model);

// "non-ohmic shunt (nonohmic_shunt), partial shading (shading)"
std::string EffectTitles(const std::vector<EffectUse>& uses);
// " + nonohmic_shunt + shading"
std::string PlusEffects(const std::vector<EffectUse>& uses);

// The effects of a device besides its diodes.
std::vector<EffectUse> EffectsOf(const Device& device);

// The text with a full stop at its end.
std::string FullSentence(std::string text);

// The text of a proved lower bound, which is never rounded up.
std::string BoundText(double bound);

// Banners of a report that is interrupted or unusable; else none. `because` is the reason why it is
// unusable, `doubts` are problems of its readings.
std::vector<std::string> Banners(bool interrupted, bool usable, const std::string& because,
                                 const std::vector<std::string>& doubts);

// The marks of an interrupted or unusable report and the number of its warnings, for the end of a
// one-line report.
std::string BriefMarks(bool interrupted, bool usable, std::size_t warnings,
                       const std::string& because = {});

// Symbol and unit: "Rs (ohm)", "n1".
std::string LabelWithUnit(const ParameterInfo& info);

// Remarks on an estimate: "fixed", "lower bound, not identifiable"; may be empty.
std::string EstimateMarks(const Estimate& estimate);

// "Is1-n1 +0.9999, ..."
std::string CorrelationsText(const std::vector<Correlation>& correlations);

// "4.1 ms: mlo, seed 0, 20 candidates x 20 iterations, 420 evaluations; ended by: iterations"
std::string SearchText(const SearchOptions& options, const SearchSummary& search,
                       std::int64_t curve_evaluations);

// "seed = 1 (default 0), ..."
std::string OptionsText(const std::vector<OptionEcho>& options);

// Adds the fields "curve" and "conditions" to the head of a report.
void AddCurve(const IvCurve& curve, Section* section);

// Adds one field for each size of the errors of the readings, with its meaning.
void AddErrorSizes(const ErrorReport& errors, bool dark, Section* section);
// Which readings scatter more, by independent errors of several sizes.
std::string WhatScatters(const ErrorReport& errors, bool dark);
// The tests that chose the errors of the intervals.
std::string ErrorTests(const ErrorReport& errors, bool dark);

// Adds a sentence for each parameter that is not identifiable.
void AddUnidentifiable(const std::vector<Estimate>& estimates, Section* section);

// What to run instead where sweeps are too few to be judged together.
inline constexpr char kSideBySide[] =
    "to put Isc, Rs, Rsh and n of a few sweeps side by side, run lyrefit fit FILES --csv table.csv";

}  // namespace lyrefit
