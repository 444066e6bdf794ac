#include "paper/published.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/study/summary.h"
#include "studies/named_table.h"

namespace lyrefit {
namespace {

const std::vector<std::string> kPublishedColumns = {"table",    "curve", "model", "algorithm",
                                                    "quantity", "value", "note"};
enum PublishedColumn { kTable, kCurve, kModel, kAlgorithm, kQuantity, kValue, kNote };

// A statistic of the searched RMSE values of one batch; NaN for an unknown quantity.
double Statistic(const std::vector<double>& values, const std::string& quantity) {
  const RunSpread spread = SpreadOf(values, 1);
  if (quantity == "min") return spread.min;
  if (quantity == "mean") return spread.mean;
  if (quantity == "max") return spread.max;
  if (quantity == "std") return spread.std;
  return kUnknown;
}

// The statistic of every complete batch of runs.
std::vector<double> OverBatches(const AlgorithmResult& compared, const std::string& quantity,
                                int batch) {
  std::vector<double> statistics;
  for (std::size_t begin = 0; begin + batch <= compared.runs.size(); begin += batch) {
    std::vector<double> values(static_cast<std::size_t>(batch));
    for (std::size_t r = 0; r < values.size(); ++r) {
      values[r] = compared.runs[begin + r].searched_A;
    }
    statistics.push_back(Statistic(values, quantity));
  }
  return statistics;
}

void PredictBatch(const std::vector<double>& statistics, CheckedValue* checked) {
  const auto count = static_cast<double>(statistics.size());
  double mean = 0, square = 0;
  for (const double s : statistics) mean += std::log(std::max(s, 1e-300)) / count;
  for (const double s : statistics) square += std::pow(std::log(std::max(s, 1e-300)) - mean, 2);
  const double reach = StudentQuantile(0.995, count - 1) * std::sqrt(square / (count - 1)) *
                       std::sqrt(1 + 1 / count);
  const double half_unit = HalfUnit(checked->published.text);
  checked->ours = std::exp(mean);
  checked->low = std::exp(mean - reach) - half_unit;
  checked->high = std::exp(mean + reach) + half_unit;
  checked->batches = static_cast<int>(statistics.size());
  const double value = checked->published.value;
  if (value < checked->low || value > checked->high) {
    checked->check = Check::kNotReproduced;
  } else {
    checked->check = checked->high > 10 * checked->low ? Check::kCannotTell : Check::kReproduced;
  }
}

const AlgorithmResult* Find(const Comparison& comparison, const PublishedValue& published) {
  for (const ProblemResult& problem : comparison.problems) {
    if (problem.curve_name != published.curve || problem.model != published.model) continue;
    for (const AlgorithmResult& compared : problem.algorithms) {
      if (compared.name == published.algorithm) return &compared;
    }
  }
  return nullptr;
}

}  // namespace

Expected<std::vector<PublishedValue>> ReadPublished(const std::string& path) {
  NamedTable table;
  if (auto opened = table.Open(path, kPublishedColumns); !opened)
    return tl::unexpected(opened.error());
  std::vector<PublishedValue> values;
  while (true) {
    const auto more = table.Next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return values;
    const std::optional<Model> model = FromText<Model>(table[kModel]);
    const std::optional<double> number = ParseNumber(table[kValue]);
    if (!model) return table.Refuse(kModel, "a model (" + AllTexts<Model>() + ")");
    if (!number || !std::isfinite(*number)) return table.Refuse(kValue, "a number");
    values.push_back({table[kTable], table[kCurve], *model, table[kAlgorithm], table[kQuantity],
                      table[kValue], *number, table[kNote]});
  }
}

Expected<std::map<std::string, std::string>> ReadRemarks(const std::string& path) {
  NamedTable table;
  if (auto opened = table.Open(path, {"table", "remark"}); !opened) {
    return tl::unexpected(opened.error());
  }
  std::map<std::string, std::string> remarks;
  while (true) {
    const auto more = table.Next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return remarks;
    remarks[table[0]] = table[1];
  }
}

std::vector<CheckedValue> CheckPublished(const std::vector<PublishedValue>& published,
                                         const Comparison& comparison, int batch) {
  std::vector<CheckedValue> checked;
  for (const PublishedValue& value : published) {
    const AlgorithmResult* compared = Find(comparison, value);
    if (compared == nullptr) continue;
    const std::vector<double> statistics = OverBatches(*compared, value.quantity, batch);
    if (statistics.size() < 2 || std::isnan(statistics[0])) continue;
    CheckedValue one;
    one.published = value;
    PredictBatch(statistics, &one);
    checked.push_back(std::move(one));
  }
  return checked;
}

}  // namespace lyrefit
