#include "studies/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/number_text.h"
#include "studies/named_table.h"

namespace lyrefit {
namespace {

constexpr int kParameters = 5;
constexpr int kMostTrueCells = 10000;

// Columns in the order of a single-diode device, then the other columns.
const std::vector<std::string> kTruthColumns = {
    "photocurrent",     "saturation_current", "n",    "resistance_series",
    "resistance_shunt", "cells_in_series",    "Index"};
constexpr int kCells = kParameters;
constexpr int kIndex = kParameters + 1;

Expected<TruthRow> ReadRow(const NamedTable& table) {
  TruthRow row;
  row.index = table[kIndex];
  if (row.index.empty()) return table.Refuse(kIndex, "an index");
  for (int i = 0; i < kParameters; ++i) {
    const std::optional<double> value = ParseNumber(table[i]);
    const bool may_be_zero = i == kRs;
    if (!value || !std::isfinite(*value) || !(may_be_zero ? *value >= 0 : *value > 0)) {
      return table.Refuse(i, may_be_zero ? "a number from 0 up" : "a number above 0");
    }
    row.values.push_back(*value);
  }
  const std::optional<double> cells = ParseNumber(table[kCells]);
  if (!cells || !(*cells >= 1 && *cells <= kMostTrueCells) || *cells != std::floor(*cells)) {
    return table.Refuse(kCells, fmt::format("a whole number from 1 to {}", kMostTrueCells));
  }
  row.cells_in_series = static_cast<int>(*cells);
  return row;
}

const TruthRow* RowOf(const FamilyCurve& curve, const std::vector<TruthRow>& truth) {
  if (truth.size() == 1) return truth.data();
  for (const TruthRow& row : truth) {
    if (row.index == curve.id) return &row;
  }
  return nullptr;
}

// A fit and its true parameters.
struct Pair {
  const FamilyCurve* curve;
  const TruthRow* row;
};

void CountInterval(const Pair& pair, int index, TruthParameter* result) {
  const std::vector<Estimate>& plain = pair.curve->individual_estimates;
  if (static_cast<int>(plain.size()) <= index) return;
  const std::vector<Estimate>& under = pair.curve->individual_under_errors;
  const Estimate& e = plain[index];
  if (e.fixed || std::isnan(e.low_95) || std::isnan(e.high_95)) return;
  const double truth = pair.row->values[index];
  const auto holds = [&](const Estimate& one) {
    return one.low_95 <= truth && truth <= one.high_95 ? 1 : 0;
  };
  ++result->intervals;
  result->covered += holds(e);
  result->covered_believed += holds(under.empty() ? e : under[index]);
}

// Statistics of all fits of one device. Means are of the value, or of the inverse for the shunt.
void SumUpOneTruth(const std::vector<Pair>& pairs, int index, TruthParameter* result) {
  const bool inverse = IsConductance(result->info.kind);
  const auto averaged = [&](double value) { return inverse ? 1 / value : value; };
  const double truth = averaged(pairs[0].row->values[index]);
  double mean = 0, square = 0;
  for (const Pair& pair : pairs) {
    const double value = averaged(pair.curve->individual_parameters[index]);
    mean += value / static_cast<double>(pairs.size());
    square += std::pow(value - truth, 2) / static_cast<double>(pairs.size());
  }
  const double scale = truth == 0 ? 1 : truth;
  result->truth = averaged(truth);
  result->mean = averaged(mean);
  result->mean_error = (mean - truth) / scale;
  result->root_mean_square = std::sqrt(square) / scale;
}

TruthParameter CompareParameter(const ParameterInfo& info, const std::vector<Pair>& pairs,
                                int index, bool one_truth) {
  TruthParameter result;
  result.info = info;
  std::vector<double> errors;
  for (const Pair& pair : pairs) {
    const double truth = pair.row->values[index];
    // The error is absolute if the true value is 0.
    const double error =
        std::fabs(pair.curve->individual_parameters[index] - truth) / (truth == 0 ? 1 : truth);
    if (errors.empty() || error > result.worst) {
      result.worst = error;
      result.worst_id = pair.curve->id;
    }
    errors.push_back(error);
    CountInterval(pair, index, &result);
  }
  result.median = Median(std::move(errors));
  if (one_truth) SumUpOneTruth(pairs, index, &result);
  return result;
}

}  // namespace

Expected<std::vector<TruthRow>> ReadTruth(const std::string& path) {
  NamedTable table;
  if (auto opened = table.Open(path, kTruthColumns); !opened) return tl::unexpected(opened.error());
  std::vector<TruthRow> rows;
  while (true) {
    const auto more = table.Next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    auto row = ReadRow(table);
    if (!row) return tl::unexpected(row.error());
    const bool twice = std::any_of(
        rows.begin(), rows.end(), [&](const TruthRow& other) { return other.index == row->index; });
    if (twice) return table.Refuse(kIndex, "an index that did not occur yet");
    rows.push_back(std::move(*row));
  }
  if (rows.empty()) return Fail("expected at least one row of parameters", path);
  return rows;
}

namespace {

// True if all curves were taken at the reference conditions. Their parameters then equal the shared
// parameters.
bool AllAtReference(const FamilyReport& report) {
  return std::all_of(report.curves.begin(), report.curves.end(), [](const FamilyCurve& curve) {
    return curve.role == CurveRole::kLeftOut ||
           (std::fabs(curve.irradiance_W_m2 - kReferenceIrradiance_W_m2) < 1e-6 &&
            std::fabs(curve.temperature_C + kZeroCelsius_K - kReferenceTemperature_K) < 1e-6);
  });
}

// Compares the shared parameters with the only true row.
void CompareJoint(const FamilyReport& report, const TruthRow& truth, TruthComparison* result) {
  const bool one_diode = report.translation.spec.model == Model::kSingleDiode;
  if (report.free || report.estimates.empty() || !one_diode || !AllAtReference(report)) return;
  const Translation& at = report.translation;
  const int positions[] = {at.photocurrent, at.saturation_current, at.n, at.resistance_series,
                           at.resistance_shunt};
  for (int i = 0; i < kParameters; ++i) {
    const Estimate& e = report.estimates[positions[i]];
    TruthParameter& p = result->parameters[i];
    const double value = truth.values[i];
    p.joint = e.refined;
    const bool inverse = IsConductance(e.info.kind);
    p.joint_error = inverse ? value / e.refined - 1 : e.refined / value - 1;
    p.by_points = {e.refined, e.standard_error, e.low_95, e.high_95};
    if (!report.jackknife.empty()) p.by_curves = report.jackknife[positions[i]];
  }
}

}  // namespace

TruthComparison CompareWithTruth(const FamilyReport& report, const std::vector<TruthRow>& truth) {
  TruthComparison result;
  result.rows = static_cast<int>(truth.size());
  result.one_truth = truth.size() == 1;
  std::vector<Pair> pairs;
  bool other_model = false, other_cells = false;
  for (const FamilyCurve& curve : report.curves) {
    if (curve.individual_parameters.empty()) continue;
    const TruthRow* row = RowOf(curve, truth);
    if (row == nullptr) {
      ++result.unmatched;
    } else if (curve.individual_parameters.size() != kParameters) {
      other_model = true;
    } else {
      other_cells = other_cells || row->cells_in_series != report.cells_in_series;
      pairs.push_back({&curve, row});
    }
  }
  result.curves = static_cast<int>(pairs.size());
  if (other_model) {
    result.warnings.emplace_back("the truth is of one diode: fit with one to compare");
  } else if (pairs.empty()) {
    result.warnings.emplace_back("no curve that was fitted alone has a row of truth");
  }
  if (other_cells) {
    result.warnings.emplace_back(
        "the truth states another number of cells in series than the curves: n is per cell, so its "
        "errors mean nothing");
  }
  if (pairs.empty()) return result;
  const Device device = MakeDevice(Model::kSingleDiode, Conditions());
  for (int i = 0; i < kParameters; ++i) {
    result.parameters.push_back(CompareParameter(device.parameters[i], pairs, i, result.one_truth));
  }
  if (result.one_truth) CompareJoint(report, truth[0], &result);
  return result;
}

}  // namespace lyrefit
