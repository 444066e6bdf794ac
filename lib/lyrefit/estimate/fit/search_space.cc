#include "lyrefit/estimate/fit/search_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lyrefit/base/portable_exp.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr double kMiddle = 0.5;  // of the interval of one value

int Stretch(double x, int count) { return std::clamp(static_cast<int>(x), 0, count - 1); }

}  // namespace

SearchSpace::SearchSpace(const std::vector<ParameterBounds>& bounds,
                         const std::vector<double>& fixed)
    : fixed_(fixed) {
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (std::isnan(fixed[i])) AddSide(static_cast<int>(i), bounds[i]);
  }
}

SearchSpace::SearchSpace(const std::vector<ParameterBounds>& bounds,
                         const std::vector<double>& fixed, const DeviceEffects& device_effects,
                         std::vector<Variant> variants)
    : SearchSpace(bounds, fixed) {
  effects_ = &device_effects;
  variants_ = std::move(variants);
  const std::size_t first = bounds.size();
  for (std::size_t k = 0; k < device_effects.bounds.size(); ++k) {
    const auto free = std::find_if(variants_.begin(), variants_.end(), [&](const Variant& variant) {
      return variant.bounds[k].lower < variant.bounds[k].upper;
    });
    if (free != variants_.end()) AddSide(static_cast<int>(first + k), free->bounds[k]);
  }
  if (variants_.size() < 2) return;
  box_.lower.push_back(0);
  box_.upper.push_back(static_cast<double>(variants_.size()));
}

void SearchSpace::AddSide(int parameter, const ParameterBounds& b) {
  Side side;
  side.parameter = parameter;
  double lower = b.search_lower, upper = b.search_upper;
  if (b.whole > 0) {
    side.first = b.search_lower;
    side.whole = b.whole;
    side.values = 1 + static_cast<int>(std::lround((b.search_upper - b.search_lower) / b.whole));
    lower = 0;
    upper = side.values;
  } else if (b.scale == SearchScale::kLog && b.search_lower > 0) {
    side.log_base = b.search_lower;
    lower = 0;
    upper = std::log(b.search_upper / b.search_lower);
  }
  sides_.push_back(side);
  box_.lower.push_back(lower);
  box_.upper.push_back(upper);
}

void SearchSpace::NameSides(const std::vector<ParameterInfo>& parameters) {
  for (const Side& side : sides_) {
    const ParameterInfo& info = parameters[side.parameter];
    box_.sides.push_back({ParameterKey(info), info.unit, side.log_base, side.whole, side.first});
  }
  if (variants_.size() > 1) box_.sides.push_back({"variant", "", 0, 1, 0});
}

void SearchSpace::ToParameters(const double* x, double* p) const {
  for (std::size_t i = 0; i < fixed_.size(); ++i) p[i] = fixed_[i];
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    const Side& side = sides_[k];
    double& value = p[side.parameter];
    value = side.log_base > 0 ? side.log_base * PortableExp(x[k]) : x[k];
    if (side.whole > 0) value = side.first + side.whole * Stretch(x[k], side.values);
  }
  if (effects_ == nullptr) return;
  double* const own = p + fixed_.size();
  const std::vector<ParameterBounds>& bounds = variants_[VariantAt(x)].bounds;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    own[k] = bounds[k].lower < bounds[k].upper ? WithinBounds(bounds[k], own[k]) : bounds[k].lower;
  }
  LeaveARest(*effects_, bounds, own);
}

std::vector<double> SearchSpace::FromParameters(const double* p, int variant) const {
  std::vector<double> x;
  for (const Side& side : sides_) {
    const double value = p[side.parameter];
    if (side.whole > 0) {
      x.push_back(std::round((value - side.first) / side.whole) + kMiddle);
    } else {
      x.push_back(side.log_base > 0 ? std::log(value / side.log_base) : value);
    }
  }
  if (variants_.size() > 1) x.push_back(variant + kMiddle);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::clamp(x[k], box_.lower[k], box_.upper[k]);
  return x;
}

int SearchSpace::VariantAt(const double* x) const {
  const int variants = static_cast<int>(variants_.size());
  return variants < 2 ? 0 : Stretch(x[sides_.size()], variants);
}

namespace {

constexpr double kRounding = 1e-9;  // of a side: candidates outside by less are clamped

Expected<void> CheckCandidate(const std::string& name, const Box& box, Candidate* candidate) {
  if (candidate->x.size() != box.lower.size()) {
    return Fail(
        fmt::format("the searcher's {} has {} coordinates, expected {}: one for each side "
                    "of the box",
                    name, candidate->x.size(), box.lower.size()));
  }
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    const double slack = kRounding * (box.upper[j] - box.lower[j]);
    double& x = candidate->x[j];
    if (!(x >= box.lower[j] - slack && x <= box.upper[j] + slack)) {
      return Fail(
          fmt::format("the searcher's {} is {:g} in coordinate {}, expected a number in "
                      "[{:g}, {:g}]",
                      name, x, j + 1, box.lower[j], box.upper[j]));
    }
    x = std::clamp(x, box.lower[j], box.upper[j]);
  }
  return {};
}

}  // namespace

Expected<void> CheckCandidates(const ObjectiveFunction& objective, const Box& box,
                               SearchSummary* summary) {
  if (summary->best.x.empty() && summary->elites.empty()) {
    return Fail(
        "the searcher came back without a best candidate: set `best` to the best point it met");
  }
  if (summary->best.x.empty()) summary->best = summary->elites.front();
  if (summary->elites.empty()) summary->elites = {summary->best};
  TRY(CheckCandidate("best candidate", box, &summary->best));
  for (std::size_t e = 0; e < summary->elites.size(); ++e) {
    const std::string name = fmt::format("elite {}", e + 1);
    TRY(CheckCandidate(name, box, &summary->elites[e]));
    summary->elites[e].objective = objective(summary->elites[e].x.data());
  }
  summary->best.objective = objective(summary->best.x.data());
  return {};
}

}  // namespace lyrefit
