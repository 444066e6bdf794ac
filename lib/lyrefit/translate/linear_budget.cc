#include "lyrefit/translate/linear_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace lyrefit
