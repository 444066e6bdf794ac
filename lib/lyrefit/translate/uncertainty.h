// Experimental: may change in a minor version (data/stable).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/translate/uncertainty_options.h"

// Uncertainty of a result by the law of propagation (GUM, JCGM 100:2008, clause 5) and by Monte
// Carlo propagation of distributions (Supplement 1, JCGM 101:2008, clause 7; for several results as
// in Supplement 2, JCGM 102:2011). Agreement of both is checked by JCGM 101, clause 8.
namespace LYREFIT_PUBLIC lyrefit {

enum class Distribution { kNormal, kRectangular };  // of an input about its value

template <>
struct EnumTable<Distribution> {
  static constexpr EnumText<Distribution> kRows[] = {{Distribution::kNormal, "normal"},
                                                     {Distribution::kRectangular, "rectangular"}};
};

// One input of a model. Inputs are independent; correlated ones are stated as one OutputTerm, or as
// functions of independent ones.
struct UncertainInput {
  std::string name;   // for programs: "irradiance"
  std::string title;  // for people: "irradiance, reference cell"
  std::string group;  // "light", "temperature", "electrical", "coefficients", ...
  std::string unit;
  std::string quantity;             // to which it adds; several inputs may share one
  double value = 0;                 // in `unit`
  double standard_uncertainty = 0;  // k = 1
  Distribution distribution = Distribution::kNormal;  // with that standard deviation
  std::string source;                                 // of the standard uncertainty: a sentence
};

// Uncertainty added to the results directly. Each factor holds the additions of one independent
// standard normal variable, so that the covariance of the term is the sum of factor factor^T. All
// factors make one line of the budget.
struct OutputTerm {
  std::string name;  // for programs
  std::string title;
  std::string group;                         // as that of an input
  std::string source;                        // of the factors: a sentence
  std::vector<std::vector<double>> factors;  // one number for each result, in its unit
};

// An undecidable choice among alternatives, such as equivalent causes or procedures. Each result is
// rectangular between its smallest and largest answer (GUM 4.3.7). The reported result counts as an
// answer and need not be the centre: the variance is the second moment about it, (b - a)^2 / 12 +
// (middle - result)^2, and draws cover the same range. One draw serves all results; a result that
// falls among the answers while the first one rises is drawn in the opposite direction.
struct OutputChoice {
  std::string name;  // for programs
  std::string title;
  std::string group;                         // as that of an input
  std::string source;                        // the alternatives: a sentence
  std::vector<std::vector<double>> answers;  // [alternative][result]
};

// Name of a result.
struct OutputQuantity {
  std::string name;   // "max_power"
  std::string title;  // "Pmax"
  std::string unit;
};

// Results as a function of the inputs, in the order of the inputs. `evaluate` must be pure: several
// threads call it. NaN marks a result that does not exist at these inputs.
struct UncertainModel {
  std::vector<OutputQuantity> outputs;  // as many as `evaluate` returns
  // One number for each output, in its unit.
  std::function<std::vector<double>(const std::vector<double>& inputs)> evaluate;
};

// All sources of uncertainty of a result.
struct UncertaintySources {
  std::vector<UncertainInput> inputs;
  std::vector<OutputTerm> terms = {};
  std::vector<OutputChoice> choices = {};
};

// Effect of one source on one result.
struct BudgetEntry {
  double sensitivity = kUnknown;   // per unit of the input; NaN of terms and choices
  double contribution = kUnknown;  // to the standard uncertainty, with the sign of the sensitivity
  double share = kUnknown;         // of the variance, 0 to 1
};

// One source of uncertainty: an input, a term or a choice.
struct BudgetLine {
  std::string name;  // for programs: "irradiance"
  std::string title;
  std::string group;  // "light", "temperature", "electrical", "coefficients", ...
  std::string unit;
  double value = kUnknown;  // of an input; NaN of terms and choices
  double standard_uncertainty = kUnknown;
  Distribution distribution = Distribution::kNormal;  // of the input
  std::string source;                                 // of the uncertainty: a sentence
  std::vector<BudgetEntry> entries;                   // one for each result
};

// Whether the interval of the linear propagation is validated by Monte Carlo.
enum class Agreement {
  kNotDone,
  kAgree,
  kDisagree,
  kUndecided,  // more draws are needed: the ends of the drawn interval are too uncertain
};

template <>
struct EnumTable<Agreement> {
  static constexpr EnumText<Agreement> kRows[] = {{Agreement::kNotDone, "not done"},
                                                  {Agreement::kAgree, "agree"},
                                                  {Agreement::kDisagree, "disagree"},
                                                  {Agreement::kUndecided, "undecided"}};
};

// Statistics of the draws of one result. The interval has equal tails.
struct DrawnInterval {
  double mean = kUnknown;                // of the finite draws
  double standard_deviation = kUnknown;  // of the finite draws
  double low = kUnknown;
  double high = kUnknown;
  double low_error = kUnknown;   // standard error of `low`, by order statistics
  double high_error = kUnknown;  // standard error of `high`
  double skewness = kUnknown;    // third moment in standard deviations; 0: symmetric
};

// A result with its uncertainty, by both propagations.
struct UncertainOutput {
  OutputQuantity quantity;
  double value = kUnknown;  // at the inputs' values
  double standard_uncertainty = kUnknown;
  double expanded_uncertainty = kUnknown;  // coverage factor times standard uncertainty
  DrawnInterval drawn;
  int failed_draws = 0;         // draws without this result
  double tolerance = kUnknown;  // delta of JCGM 101, clause 8: half a unit of the last digit
  Agreement agreement = Agreement::kNotDone;
  std::string sentence;         // if they disagree: by how much, and why
  std::vector<double> samples;  // finite draws, rising; not part of reports

  // Interval to report: the drawn one where it disagrees with the linear one, else the linear one.
  double low() const;
  double high() const;
  // P(true value < x) by the draws, else by a normal distribution. Both assume a flat prior.
  double ProbabilityBelow(double x) const;
};

// Uncertainties of all results, and the contribution of each source.
struct UncertaintyBudget {
  std::vector<BudgetLine> lines;         // inputs in their order, then terms, then choices
  std::vector<UncertainOutput> outputs;  // in the order of the model's outputs
  double coverage_factor = 2;            // k of the linear propagation
  double coverage_probability = 0.9545;  // of the interval of the draws
  int draws = 0;                         // 0: no Monte Carlo
  std::uint64_t seed = 0;
  std::vector<std::string> warnings;
};

// Propagates by both methods. Sensitivities are central differences over one standard uncertainty
// either way (GUM 5.1.3, note 2), exact for linear and quadratic models. Each draw has its own
// random stream: draws do not depend on the number of threads or of draws. If `observer` stops the
// draws, the budget has none and `draws` is 0. Errors: options outside their ranges, sizes that are
// negative or do not match, no result at the inputs' values.
Expected<UncertaintyBudget> Propagate(const UncertainModel& model,
                                      const UncertaintySources& sources,
                                      const UncertaintyOptions& options,
                                      const Observer& observer = {});

// Factors of an OutputTerm with this covariance: its Cholesky factor. Variables with no more than
// rounding left of their variance are skipped, so a semidefinite matrix is accepted.
std::vector<std::vector<double>> FactorsOf(std::vector<std::vector<double>> covariance);

// JCGM 101, 7.9.2: half a unit in the last significant digit of u. 0.35, 2 digits: 0.005.
double NumericalTolerance(double standard_uncertainty, int significant_digits);

// The shortest interval with this part of the samples, which must be rising (JCGM 101, 5.3.4 and
// 7.7.4).
struct CoverageInterval {
  double low = kUnknown;
  double high = kUnknown;
};
CoverageInterval ShortestInterval(const std::vector<double>& rising, double probability);

}  // namespace lyrefit
