#include "lyrefit/translate/translation_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace lyrefit {
namespace {

// The texts that every source has.
template <class Source>
BudgetLine LineOf(const Source& source) {
  BudgetLine line;
  line.name = source.name;
  line.title = source.title;
  line.group = source.group;
  line.source = source.source;
  return line;
}

// Half the difference of a result over one standard uncertainty either way. If the model has no
// value on one side, the difference to the other side.
double HalfDifference(double below, double at, double above) {
  if (std::isfinite(below) && std::isfinite(above)) return 0.5 * (above - below);
  return std::isfinite(above) ? above - at : at - below;
}

BudgetLine InputLine(const UncertainModel& model, const std::vector<UncertainInput>& inputs,
                     std::size_t which, const std::vector<double>& reported) {
  const UncertainInput& input = inputs[which];
  BudgetLine line = LineOf(input);
  line.unit = input.unit;
  line.value = input.value;
  line.standard_uncertainty = input.standard_uncertainty;
  line.distribution = input.distribution;
  line.entries.resize(reported.size());
  const double u = input.standard_uncertainty;
  if (u == 0) {
    for (BudgetEntry& entry : line.entries) entry.contribution = 0;
    return line;
  }
  std::vector<double> at = ValuesOf(inputs);
  const double value = at[which];
  at[which] = value + u;
  const std::vector<double> above = EvaluateAt(model, at);
  at[which] = value - u;
  const std::vector<double> below = EvaluateAt(model, at);
  for (std::size_t k = 0; k < reported.size(); ++k) {
    line.entries[k].contribution = HalfDifference(below[k], reported[k], above[k]);
    line.entries[k].sensitivity = line.entries[k].contribution / u;
  }
  return line;
}

BudgetLine TermLine(const OutputTerm& term, std::size_t outputs) {
  BudgetLine line = LineOf(term);
  line.entries.resize(outputs);
  for (std::size_t k = 0; k < outputs; ++k) {
    double variance = 0;
    for (const std::vector<double>& factor : term.factors) variance += factor[k] * factor[k];
    line.entries[k].contribution = std::sqrt(variance);
  }
  return line;
}

BudgetLine ChoiceLine(const OutputChoice& choice, const std::vector<double>& reported) {
  BudgetLine line = LineOf(choice);
  line.distribution = Distribution::kRectangular;
  line.entries.resize(reported.size());
  const ChoiceRange range = RangeOf(choice, reported);
  for (std::size_t k = 0; k < reported.size(); ++k) {
    const double width = range.high[k] - range.low[k];
    const double aside = 0.5 * (range.high[k] + range.low[k]) - reported[k];
    line.entries[k].contribution = std::sqrt(width * width / 12 + aside * aside);
  }
  return line;
}

// Sets each line's share of the variance and returns the variance.
double SharesOf(std::size_t output, std::vector<BudgetLine>* lines) {
  double variance = 0;
  for (const BudgetLine& line : *lines) {
    const double part = line.entries[output].contribution;
    variance += part * part;
  }
  for (BudgetLine& line : *lines) {
    BudgetEntry& entry = line.entries[output];
    entry.share = variance > 0 ? entry.contribution * entry.contribution / variance : kUnknown;
  }
  return std::sqrt(variance);
}

}  // namespace

std::vector<double> ValuesOf(const std::vector<UncertainInput>& inputs) {
  std::vector<double> values(inputs.size());
  std::transform(inputs.begin(), inputs.end(), values.begin(),
                 [](const UncertainInput& input) { return input.value; });
  return values;
}

std::vector<double> EvaluateAt(const UncertainModel& model, const std::vector<double>& inputs) {
  std::vector<double> outputs = model.evaluate(inputs);
  outputs.resize(model.outputs.size(), kUnknown);
  return outputs;
}

ChoiceRange RangeOf(const OutputChoice& choice, const std::vector<double>& reported) {
  const std::size_t outputs = reported.size();
  ChoiceRange range = {reported, reported, std::vector<char>(outputs, 0)};
  for (const std::vector<double>& answer : choice.answers) {
    for (std::size_t k = 0; k < outputs; ++k) {
      if (!std::isfinite(answer[k])) continue;
      range.low[k] = std::min(range.low[k], answer[k]);
      range.high[k] = std::max(range.high[k], answer[k]);
    }
  }
  std::size_t first = 0;
  while (first < outputs && !(range.high[first] > range.low[first])) ++first;
  for (std::size_t k = first; k < outputs; ++k) {
    double together = 0;
    for (const std::vector<double>& answer : choice.answers) {
      const double product = (answer[k] - reported[k]) * (answer[first] - reported[first]);
      if (std::isfinite(product)) together += product;
    }
    range.against[k] = together < 0 ? 1 : 0;
  }
  return range;
}

void AddLinearBudget(const UncertainModel& model, const UncertaintySources& sources,
                     UncertaintyBudget* budget) {
  const std::vector<double> reported = EvaluateAt(model, ValuesOf(sources.inputs));
  for (std::size_t i = 0; i < sources.inputs.size(); ++i) {
    budget->lines.push_back(InputLine(model, sources.inputs, i, reported));
  }
  for (const OutputTerm& term : sources.terms) {
    budget->lines.push_back(TermLine(term, reported.size()));
  }
  for (const OutputChoice& choice : sources.choices) {
    budget->lines.push_back(ChoiceLine(choice, reported));
  }
  for (std::size_t k = 0; k < reported.size(); ++k) {
    UncertainOutput output;
    output.quantity = model.outputs[k];
    output.value = reported[k];
    output.standard_uncertainty = SharesOf(k, &budget->lines);
    output.expanded_uncertainty = budget->coverage_factor * output.standard_uncertainty;
    if (std::isfinite(output.value) && !std::isfinite(output.standard_uncertainty)) {
      budget->warnings.push_back(fmt::format(
          "{} has no value within one standard uncertainty of an input: its uncertainty is not "
          "known",
          output.quantity.title));
    }
    budget->outputs.push_back(std::move(output));
  }
}

namespace {

constexpr double kSureBy = 2;  // standard errors of the end of a drawn interval
// Largest standard error of a drawn end, in tolerances: 10,000 draws suffice for one digit of any
// u.
constexpr double kSharp = 0.6;
constexpr std::size_t kMostReasons = 2;

struct Reason {
  double size = 0;  // largest change of an end of the interval
  std::string sentence;
};

// Result with one or two inputs moved by their standard uncertainties, times the signs.
class Moved {
 public:
  Moved(const UncertainModel& model, const std::vector<UncertainInput>& inputs, std::size_t output)
      : model_(model), inputs_(inputs), output_(output), values_(ValuesOf(inputs)) {}

  double operator()(std::size_t i, double sign_i, std::size_t j, double sign_j) const {
    std::vector<double> at = values_;
    at[i] += sign_i * inputs_[i].standard_uncertainty;
    if (j != i) at[j] += sign_j * inputs_[j].standard_uncertainty;
    return EvaluateAt(model_, at)[output_];
  }

 private:
  const UncertainModel& model_;
  const std::vector<UncertainInput>& inputs_;
  std::size_t output_;
  std::vector<double> values_;
};

// Adds the deviation of the result from linearity at one standard uncertainty of each input, and
// the interaction of each pair of inputs.
void AddBends(const UncertainModel& model, const std::vector<UncertainInput>& inputs,
              std::size_t output, double reported, std::vector<Reason>* reasons) {
  const Moved moved(model, inputs, output);
  const std::string result = model.outputs[output].title;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].standard_uncertainty == 0) continue;
    const double bend = 0.5 * (moved(i, 1, i, 1) + moved(i, -1, i, -1)) - reported;
    if (std::isfinite(bend)) {
      reasons->push_back(
          {std::fabs(bend), fmt::format("{} is not linear in the {}", result, inputs[i].title)});
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (inputs[j].standard_uncertainty == 0) continue;
      const double both = 0.25 * (moved(i, 1, j, 1) + moved(i, -1, j, -1) - moved(i, 1, j, -1) -
                                  moved(i, -1, j, 1));
      if (!std::isfinite(both)) continue;
      reasons->push_back({std::fabs(both), fmt::format("in {} the {} and the {} act as a product",
                                                       result, inputs[j].title, inputs[i].title)});
    }
  }
}

// Adds reasons from the shape of the sources: a rectangular line ends sooner than a normal one of
// equal standard deviation, and the answers of a choice need not be centred on the result.
void AddShapes(const UncertaintySources& sources, const UncertaintyBudget& budget,
               std::size_t output, std::vector<Reason>* reasons) {
  const UncertainOutput& of = budget.outputs[output];
  const double sooner =
      std::fabs(budget.coverage_factor - std::sqrt(3.0) * budget.coverage_probability);
  for (const BudgetLine& line : budget.lines) {
    if (line.distribution != Distribution::kRectangular) continue;
    const double share = line.entries[output].share;
    if (!(share > 0)) continue;
    reasons->push_back({sooner * share * share * of.standard_uncertainty,
                        fmt::format("{:.0f} % of the variance has a rectangular distribution ({})",
                                    100 * share, line.title)});
  }
  std::vector<double> reported;
  for (const UncertainOutput& each : budget.outputs) reported.push_back(each.value);
  for (const OutputChoice& choice : sources.choices) {
    const ChoiceRange range = RangeOf(choice, reported);
    const double aside = 0.5 * (range.low[output] + range.high[output]) - of.value;
    reasons->push_back(
        {std::fabs(aside),
         fmt::format("the {} puts the result on one side of the others", choice.title)});
  }
}

std::string Why(const UncertainModel& model, const UncertaintySources& sources,
                const UncertaintyBudget& budget, std::size_t output) {
  const UncertainOutput& of = budget.outputs[output];
  std::vector<Reason> reasons;
  AddBends(model, sources.inputs, output, of.value, &reasons);
  AddShapes(sources, budget, output, &reasons);
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const Reason& a, const Reason& b) { return a.size > b.size; });
  std::string text;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i) {
    // A second reason is added only if it is not small beside the first.
    if (i > 0 && reasons[i].size < 0.3 * reasons[0].size) break;
    text += (i > 0 ? "; " : "") + reasons[i].sentence;
  }
  if (of.failed_draws > 0) text += fmt::format("; {} draws have no value", of.failed_draws);
  return text;
}

Agreement Judge(const UncertainOutput& of) {
  const double low = std::fabs(of.value - of.expanded_uncertainty - of.drawn.low);
  const double high = std::fabs(of.value + of.expanded_uncertainty - of.drawn.high);
  if (low - of.tolerance > kSureBy * of.drawn.low_error ||
      high - of.tolerance > kSureBy * of.drawn.high_error) {
    return Agreement::kDisagree;
  }
  const bool sure = std::max(of.drawn.low_error, of.drawn.high_error) <= kSharp * of.tolerance &&
                    std::max(low, high) <= of.tolerance;
  return sure ? Agreement::kAgree : Agreement::kUndecided;
}

std::string Sentence(const UncertainModel& model, const UncertaintySources& sources,
                     const UncertaintyBudget& budget, std::size_t output) {
  const UncertainOutput& of = budget.outputs[output];
  const std::string unit = of.quantity.unit.empty() ? "" : " " + of.quantity.unit;
  const std::string intervals =
      fmt::format("{}: {:.5g} .. {:.5g}{} by linear propagation, {:.5g} .. {:.5g}{} by draws",
                  of.quantity.title, of.value - of.expanded_uncertainty,
                  of.value + of.expanded_uncertainty, unit, of.drawn.low, of.drawn.high, unit);
  if (of.agreement == Agreement::kUndecided) {
    return fmt::format(
        "{}; whether that is within {:.2g}{} takes more draws (the ends are sure to {:.2g}{})",
        intervals, of.tolerance, unit, std::max(of.drawn.low_error, of.drawn.high_error), unit);
  }
  return fmt::format("{}, further apart than {:.2g}{}: {}. The drawn interval is the one to quote",
                     intervals, of.tolerance, unit, Why(model, sources, budget, output));
}

}  // namespace

double NumericalTolerance(double standard_uncertainty, int significant_digits) {
  if (!std::isfinite(standard_uncertainty)) return kUnknown;
  if (standard_uncertainty <= 0) return 0;
  // u = c 10^l, where c has that many digits after rounding: 0.0996 to one digit is 0.1.
  const double scale = std::pow(10.0, significant_digits - 1);
  int exponent = static_cast<int>(std::floor(std::log10(standard_uncertainty)));
  const double digits = std::round(standard_uncertainty / std::pow(10.0, exponent) * scale);
  if (digits >= 10 * scale) ++exponent;
  return 0.5 * std::pow(10.0, exponent - significant_digits + 1);
}

void JudgeAgreement(const UncertainModel& model, const UncertaintySources& sources,
                    int significant_digits, UncertaintyBudget* budget) {
  for (std::size_t k = 0; k < budget->outputs.size(); ++k) {
    UncertainOutput& output = budget->outputs[k];
    output.tolerance = NumericalTolerance(output.standard_uncertainty, significant_digits);
    if (!std::isfinite(output.drawn.low) || !std::isfinite(output.tolerance)) continue;
    output.agreement = Judge(output);
    if (output.agreement != Agreement::kAgree) {
      output.sentence = Sentence(model, sources, *budget, k);
    }
  }
}

}  // namespace lyrefit
