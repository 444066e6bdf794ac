#include "lyrefit/read/curve_set_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

Expected<void> CheckIrradiance(const std::vector<double>& column) {
  if (column.empty()) return {};
  const double mean =
      std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
  if (mean >= -kLargestDarkOffset_W_m2) return {};
  return Fail(
      fmt::format("expected an irradiance from 0 W/m2 up, found a mean of {:.6g} W/m2", mean));
}

void SayWhereTheyDiffer(About about, const char* unit, const std::optional<double>& own,
                        const std::optional<double>& index, double tolerance, IvCurve* curve) {
  if (!own || !index || std::abs(*own - *index) <= tolerance) return;
  curve->assumptions.emplace_back(
      fmt::format("the {} in the index ({:.6g} {}) differs from the one in the file beside the "
                  "curve ({:.6g} {}): the latter counts",
                  ToText(about), *index, unit, *own, unit),
      about);
}

// Moves the assumptions that all curves share to the set.
void GatherAssumptions(CurveSet* set) {
  std::map<std::string, std::size_t> curves_saying;
  for (const IvCurve& curve : set->curves) {
    std::set<std::string> sentences;
    for (const Assumption& one : curve.assumptions) sentences.insert(one.sentence);
    for (const std::string& sentence : sentences) ++curves_saying[sentence];
  }
  const auto common = [&](const Assumption& one) {
    return curves_saying[one.sentence] == set->curves.size();
  };
  const std::vector<Assumption> first = set->curves.front().assumptions;
  std::copy_if(first.begin(), first.end(), std::back_inserter(set->assumptions), common);
  for (IvCurve& curve : set->curves) {
    auto& own = curve.assumptions;
    own.erase(std::remove_if(own.begin(), own.end(), common), own.end());
  }
}

}  // namespace

CurveSetBuilder::CurveSetBuilder(std::string name, std::string source, const ReadOptions& options)
    : options_(options) {
  set_.name = std::move(name);
  set_.source = std::move(source);
}

Expected<void> CurveSetBuilder::ReadCommon(const std::string& path, SidecarOf of) {
  if (!IsFile(path)) return {};
  TRY(common_, ReadSidecar(path, options_.largest_file_bytes, of));
  return {};
}

Expected<void> CurveSetBuilder::ReadIndex(const std::string& path, IndexIds ids) {
  if (!IsFile(path)) return {};
  TRY(CurveIndex index, ReadCurveIndex(path, ids, options_));
  Assume(index.assumptions);
  index_ = std::move(index);
  return {};
}

Expected<void> CurveSetBuilder::CheckIndex(const std::set<std::string>& ids) const {
  if (!index_) return {};
  const Error* first = nullptr;
  for (const auto& [id, row] : index_->rows) {
    if (ids.count(id) != 0) continue;
    if (first == nullptr || row.missing.line < first->line) first = &row.missing;
  }
  if (first != nullptr) return tl::unexpected(*first);
  return {};
}

void CurveSetBuilder::ApplyIndex(const Sidecar& own, Sidecar* stated, IvCurve* curve) const {
  if (!index_) return;
  // An empty field of the index means that the value is unknown for this curve, despite common
  // values.
  if (index_->states_irradiance) stated->irradiance_W_m2.reset();
  if (index_->states_temperature) stated->temperature_C.reset();
  const auto found = index_->rows.find(curve->name);
  if (found == index_->rows.end()) {
    curve->assumptions.emplace_back("the index has no row for this curve");
    return;
  }
  const IndexRow& row = found->second;
  if (index_->states_irradiance) stated->irradiance_W_m2 = row.irradiance_W_m2;
  if (index_->states_temperature) stated->temperature_C = row.temperature_C;
  if (!row.date.empty()) stated->notes.date = row.date;
  SayWhereTheyDiffer(About::kIrradiance, "W/m2", own.irradiance_W_m2, row.irradiance_W_m2,
                     0.02 * own.irradiance_W_m2.value_or(0), curve);
  SayWhereTheyDiffer(About::kTemperature, "C", own.temperature_C, row.temperature_C, 1, curve);
}

void CurveSetBuilder::TakeHead(const Sidecar& head) {
  common_ = MergeHead(std::move(common_), head);
}

void CurveSetBuilder::Add(RawCurve raw, int line) {
  std::string id = raw.curve.name;
  Sidecar stated = common_;
  // A common nominal value is used only if the curve has no column.
  if (!raw.curve.irradiance_W_m2.empty()) stated.irradiance_W_m2.reset();
  if (!raw.curve.temperature_C.empty()) stated.temperature_C.reset();
  ApplyIndex(raw.stated, &stated, &raw.curve);
  raw.stated = Merge(std::move(raw.stated), stated);
  const std::string source = raw.curve.source;
  auto valid = CheckIrradiance(raw.curve.irradiance_W_m2);
  if (!valid) return Reject(std::move(id), {valid.error().message, source, line});
  Expected<IvCurve> curve = FinishCurve(std::move(raw), options_);
  if (!curve) return Reject(std::move(id), {curve.error().message, source, line});
  curve->name = id;
  set_.curves.push_back(std::move(*curve));
}

void CurveSetBuilder::AddSettled(IvCurve curve) { set_.curves.push_back(std::move(curve)); }

void CurveSetBuilder::Reject(std::string id, Error error) {
  set_.rejected.push_back({std::move(id), std::move(error)});
}

void CurveSetBuilder::Assume(const std::vector<Assumption>& assumptions) {
  set_.assumptions.insert(set_.assumptions.end(), assumptions.begin(), assumptions.end());
}

Expected<CurveSet> CurveSetBuilder::Finish() {
  if (set_.curves.empty()) {
    if (!set_.rejected.empty()) return tl::unexpected(set_.rejected.front().error);
    return Fail("expected curves, found none", set_.source);
  }
  GatherAssumptions(&set_);
  return std::move(set_);
}

}  // namespace lyrefit
