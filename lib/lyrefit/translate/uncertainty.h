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

// How sure a result is: the law of propagation of uncertainty (GUM, JCGM 100:2008, clause 5) and
// the propagation of distributions by Monte Carlo (its Supplement 1, JCGM 101:2008, clause 7; of
// several results at once as in Supplement 2, JCGM 102:2011), and whether both agree (JCGM 101,
// clause 8).
namespace LYREFIT_PUBLIC lyrefit {

enum class Distribution { kNormal, kRectangular };  // How an input scatters about its value.

template <>
struct EnumTable<Distribution> {
  static constexpr EnumText<Distribution> kRows[] = {{Distribution::kNormal, "normal"},
                                                     {Distribution::kRectangular, "rectangular"}};
};

// Something a result depends on. Inputs are independent; what is correlated is told as one
// OutputTerm, or as a function of independent ones.
struct UncertainInput {
  std::string name;   // for programs: "irradiance"
  std::string title;  // for people: "irradiance, reference cell"
  std::string group;  // "light", "temperature", "electrical", "coefficients", ...
  std::string unit;
  std::string quantity;             // whose value it adds to; several inputs may act on one
  double value = 0;                 // in `unit`
  double standard_uncertainty = 0;  // k = 1
  Distribution distribution = Distribution::kNormal;  // with that standard deviation
  std::string source;                                 // where the size is from: a sentence
};

// What acts on the results themselves: each factor is what one independent standard normal variable
// adds to every result, so that the covariance of the term is the sum of factor factor^T. The
// factors make one line of the budget.
struct OutputTerm {
  std::string name;  // for programs
  std::string title;
  std::string group;                         // as that of an input
  std::string source;                        // where the size is from: a sentence
  std::vector<std::vector<double>> factors;  // one number for each result, in its unit
};

// A choice that nobody can make for sure: equivalent causes, procedures. The result may lie
// anywhere between the smallest and the largest of the answers, rectangular (GUM 4.3.7). It is not
// centred there: the line's variance is the second moment about the result that is reported,
// (b - a)^2 / 12 + (middle - result)^2, and draws keep the side. The reported result is one of the
// answers, whether it is listed or not. One draw serves all results; where one falls while the
// first rises among the answers, it goes the other way.
struct OutputChoice {
  std::string name;  // for programs
  std::string title;
  std::string group;                         // as that of an input
  std::string source;                        // what the choice is between: a sentence
  std::vector<std::vector<double>> answers;  // one for each alternative, of all results
};

// What a result is called.
struct OutputQuantity {
  std::string name;   // "max_power"
  std::string title;  // "Pmax"
  std::string unit;
};

// Results as a function of the inputs, in their order. It must be pure: it is called from several
// threads. NaN: there is no such result there.
struct UncertainModel {
  std::vector<OutputQuantity> outputs;  // as many as `evaluate` returns
  // One number for each output, in its unit.
  std::function<std::vector<double>(const std::vector<double>& inputs)> evaluate;
};

// What a result depends on, all of it.
struct UncertaintySources {
  std::vector<UncertainInput> inputs;
  std::vector<OutputTerm> terms = {};
  std::vector<OutputChoice> choices = {};
};

// What one source does to one result.
struct BudgetEntry {
  double sensitivity = kUnknown;   // by the unit of the input; NaN of terms and choices
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
  std::string source;                                 // where the size is from: a sentence
  std::vector<BudgetEntry> entries;                   // one a result
};

// Whether the interval of the linear propagation is validated by Monte Carlo.
enum class Agreement {
  kNotDone,
  kAgree,
  kDisagree,
  kUndecided,  // the ends of the drawn interval are not sure enough: more draws
};

template <>
struct EnumTable<Agreement> {
  static constexpr EnumText<Agreement> kRows[] = {{Agreement::kNotDone, "not done"},
                                                  {Agreement::kAgree, "agree"},
                                                  {Agreement::kDisagree, "disagree"},
                                                  {Agreement::kUndecided, "undecided"}};
};

// What is drawn of one result. The interval has equal tails.
struct DrawnInterval {
  double mean = kUnknown;                // of the draws that have a result
  double standard_deviation = kUnknown;  // of the same
  double low = kUnknown;
  double high = kUnknown;
  double low_error = kUnknown;   // standard error of the ends, by order statistics
  double high_error = kUnknown;  // of the upper end
  double skewness = kUnknown;    // third moment in standard deviations; 0: symmetric
};

// A result with its uncertainty, by both propagations.
struct UncertainOutput {
  OutputQuantity quantity;  // what it is of
  double value = kUnknown;  // at the inputs' values
  double standard_uncertainty = kUnknown;
  double expanded_uncertainty = kUnknown;  // coverage factor times that
  DrawnInterval drawn;
  int failed_draws = 0;         // had no such result
  double tolerance = kUnknown;  // delta of JCGM 101, clause 8: half a unit of the last digit
  Agreement agreement = Agreement::kNotDone;
  std::string sentence;         // where they do not agree: by how much, and why
  std::vector<double> samples;  // finite draws, rising; not part of reports

  // The interval to quote: of the draws where they disagree with the linear one.
  double low() const;
  double high() const;
  // P(true value < x), by the draws where there are any, else normal. A flat prior is behind both.
  double ProbabilityBelow(double x) const;
};

// How sure the results are, and what makes them unsure.
struct UncertaintyBudget {
  std::vector<BudgetLine> lines;         // inputs in their order, then terms, then choices
  std::vector<UncertainOutput> outputs;  // in the order of the model's
  double coverage_factor = 2;            // k of the linear propagation
  double coverage_probability = 0.9545;  // of the interval of the draws
  int draws = 0;                         // 0: no Monte Carlo
  std::uint64_t seed = 0;
  std::vector<std::string> warnings;
};

// Both propagations. Sensitivities are central differences over one standard uncertainty either way
// (GUM 5.1.3, note 2), exact for linear models and for quadratic ones. Draws come from one stream
// each, so that they are the same on any number of threads and the first of many.
// Where `observer` stops the draws there are none in the budget: `draws` is 0.
// Errors: options outside their ranges, sizes that do not fit or are negative, no result at the
// inputs' values.
Expected<UncertaintyBudget> Propagate(const UncertainModel& model,
                                      const UncertaintySources& sources,
                                      const UncertaintyOptions& options,
                                      const Observer& observer = {});

// The factors of a term with this covariance (its Cholesky factor; a matrix that rounding has left
// a little indefinite is taken as the nearest one that is not).
std::vector<std::vector<double>> FactorsOf(std::vector<std::vector<double>> covariance);

// JCGM 101, 7.9.2: half a unit in the last of that many digits of u. 0.35, 2 digits: 0.005.
double NumericalTolerance(double standard_uncertainty, int significant_digits);

// The shortest interval that holds that part of the samples (JCGM 101, 5.3.4 and 7.7.4), which must
// be rising.
struct CoverageInterval {
  double low = kUnknown;
  double high = kUnknown;
};
CoverageInterval ShortestInterval(const std::vector<double>& rising, double probability);

}  // namespace lyrefit
