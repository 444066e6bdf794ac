#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/report/document.h"

// What the reports share.
namespace lyrefit {

// "single-diode"
std::string ModelTitle(Model model);

// "non-ohmic shunt (nonohmic_shunt), partial shading (shading)"
std::string EffectTitles(const std::vector<EffectUse>& uses);
// " + nonohmic_shunt + shading"
std::string PlusEffects(const std::vector<EffectUse>& uses);

// The effects that a device has beside its diodes.
std::vector<EffectUse> EffectsOf(const Device& device);

// "1 cell", "3 cells"
std::string Plural(std::size_t count, const std::string& noun);

// With a full stop.
std::string FullSentence(std::string text);

// A proved bound, which must not be rounded up.
std::string BoundText(double bound);

// What stands above everything else of a report that is unfinished or worthless; else nothing.
// `because` says why it is worthless, `doubts` what is doubtful about its readings.
std::vector<std::string> Banners(bool interrupted, bool usable, const std::string& because,
                                 const std::vector<std::string>& doubts);

// The same, and how many warnings there are, at the end of a report of one line.
std::string BriefMarks(bool interrupted, bool usable, std::size_t warnings,
                       const std::string& because = {});

// "Rs (ohm)", "n1".
std::string LabelWithUnit(const ParameterInfo& info);

// "fixed", "lower bound, not identifiable"; empty where there is nothing to say.
std::string EstimateMarks(const Estimate& estimate);

// "Is1-n1 +0.9999, ..."
std::string CorrelationsText(const std::vector<Correlation>& correlations);

// "4.1 ms: mlo, seed 0, 20 candidates x 20 iterations, 420 evaluations; ended by: iterations"
std::string SearchText(const SearchOptions& options, const SearchSummary& search,
                       std::int64_t curve_evaluations);

// "seed = 1 (default 0), ..."
std::string OptionsText(const std::vector<OptionEcho>& options);

// The fields "curve" and "conditions" of a report's head.
void AddCurve(const IvCurve& curve, Section* section);

// The sizes of the errors of the readings, a field each, with what they mean.
void AddErrorSizes(const ErrorReport& errors, Section* section);
// One sentence on which intervals to believe.
std::string WhichToBelieve(const ErrorReport& errors);

// A sentence for each parameter that cannot be told.
void AddUnidentifiable(const std::vector<Estimate>& estimates, Section* section);

}  // namespace lyrefit
