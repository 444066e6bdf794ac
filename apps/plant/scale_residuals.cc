#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "plant/neighbours.h"
#include "plant/scale_judge.h"

namespace lyrefit {
namespace {

// Errors of the deviation of a healthy string from its peers: light read for each string, dirt and
// current classes; temperature of a string within 1.5 K; spread of modules and of the key points
// that some 50 readings give; cables of unlike length. They count as kUsualDegrees strings.
constexpr ScaleVector kUsualErrors = {0.008, 0.004, 0.004, 0.005, 0.03};
constexpr double kUsualDegrees = 25;

double Kelvin(double celsius) { return celsius + kZeroCelsius_K; }

// Residuals are computed at the stated light of each string, so that light that is not alike, or
// stated wrongly, compares too.
constexpr double kMostUnlikeLight = 0.3;

bool AlikeLight(double a, double b) {
  return std::fabs(a - b) <= kMostUnlikeLight * std::max(a, b);
}

StringFigures Scaled(const StringFigures& f, double series, double parallel) {
  return {f.isc_A * parallel, f.voc_V * series, f.imp_A * parallel, f.vmp_V * series,
          f.slope_ohm * series / parallel};
}

// Units in series: modules, or cells where only these are known.
double SeriesOf(const ScaleMember& member) {
  if (member.modules > 0) return member.modules;
  return member.cells > 0 ? member.cells : 1;
}

StringFigures OfAll(const StringFigures& figures, const ScaleMember& member) {
  return Scaled(figures, SeriesOf(member), std::max(member.strings, 1));
}

// Figures of one unit and one string.
StringFigures OfOne(const ScaleMember& member) {
  return Scaled(member.measured, 1 / SeriesOf(member), 1.0 / std::max(member.strings, 1));
}

// A typical diode through the medians of strings without a plan.
class CommonString {
 public:
  explicit CommonString(const std::vector<const ScaleMember*>& members)
      : figures_(Medians(members, &light_, &temperature_C_, &cells_)),
        device_(figures_, cells_, Kelvin(temperature_C_)) {}

  const StringFigures& figures() const { return figures_; }

  ScaleVector LogsFor(const ScaleMember& member) const {
    ScaleVector logs = LogsOf(figures_);
    const ScaleVector by_light = device_.ByLight(member.irradiance_W_m2 / light_);
    const double kelvin = member.temperature_C - temperature_C_;
    const ScaleVector by_warmth = std::isfinite(kelvin) ? device_.ByWarmth(kelvin) : ScaleVector{};
    for (int q = 0; q < kScaleQuantities; ++q) logs[q] += by_light[q] + by_warmth[q];
    return logs;
  }

 private:
  static StringFigures Medians(const std::vector<const ScaleMember*>& members, double* light,
                               double* temperature_C, int* cells) {
    std::array<std::vector<double>, 8> values;
    for (const ScaleMember* const member : members) {
      const StringFigures f = OfOne(*member);
      const double per_light = 1 / member->irradiance_W_m2;
      const double one[] = {f.isc_A * per_light,   f.voc_V,
                            f.imp_A / f.isc_A,     f.vmp_V,
                            f.slope_ohm,           member->irradiance_W_m2,
                            member->temperature_C, member->cells / SeriesOf(*member)};
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isfinite(one[k])) values[k].push_back(one[k]);
      }
    }
    *light = Median(values[5]);
    *temperature_C = Median(values[6]);
    const double median_cells = Median(values[7]);
    *cells = std::isfinite(median_cells) ? static_cast<int>(std::lround(median_cells)) : 0;
    const double isc = Median(values[0]) * *light;
    return {isc, Median(values[1]), Median(values[2]) * isc, Median(values[3]), Median(values[4])};
  }

  double light_ = kUnknown, temperature_C_ = kUnknown;
  int cells_ = 0;
  StringFigures figures_;
  ScaleDevice device_;
};

ScaleVector UnknownVector() {
  ScaleVector vector;
  vector.fill(kUnknown);
  return vector;
}

// Medians of the residuals of peers; unknown for too few of them.
ScaleVector MedianOf(const std::vector<ScaleResidual>& all, const std::vector<std::size_t>& peers) {
  ScaleVector medians;
  for (int q = 0; q < kScaleQuantities; ++q) {
    std::vector<double> values;
    for (const std::size_t j : peers) {
      if (std::isfinite(all[j].residual[q])) values.push_back(all[j].residual[q]);
    }
    medians[q] = static_cast<int>(values.size()) < kLeastPeers ? kUnknown : Median(values);
  }
  return medians;
}

void FindResiduals(const std::vector<ScaleMember>& group, std::vector<ScaleResidual>* all) {
  std::vector<const ScaleMember*> unplanned;
  for (const ScaleMember& member : group) {
    if (member.IsMeasured() && !member.IsPlanned()) unplanned.push_back(&member);
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    (*all)[i].residual = (*all)[i].deviation = (*all)[i].common = UnknownVector();
    if (!group[i].IsMeasured() || !group[i].IsPlanned()) continue;
    (*all)[i].residual = Difference(LogsOf(group[i].measured), LogsOf(group[i].planned));
    (*all)[i].expected = group[i].planned;
  }
  if (static_cast<int>(unplanned.size()) <= kLeastPeers) return;
  const CommonString common(unplanned);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (!group[i].IsMeasured() || group[i].IsPlanned()) continue;
    (*all)[i].residual = Difference(LogsOf(OfOne(group[i])), common.LogsFor(group[i]));
    (*all)[i].expected = OfAll(common.figures(), group[i]);
  }
}

}  // namespace

bool ScaleMember::IsMeasured() const {
  return irradiance_W_m2 > 0 && measured.isc_A > 0 && measured.voc_V > 0 && measured.imp_A > 0 &&
         measured.vmp_V > 0;
}

std::vector<ScaleResidual> ScaleResiduals(const std::vector<ScaleMember>& group) {
  std::vector<ScaleResidual> all(group.size());
  FindResiduals(group, &all);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (!std::isfinite(all[i].residual[kScaleVoc])) continue;
    std::vector<std::size_t> peers;
    for (std::size_t j = 0; j < group.size(); ++j) {
      const bool like = j != i && std::isfinite(all[j].residual[kScaleVoc]) &&
                        group[j].own_cause.empty() &&
                        group[j].IsPlanned() == group[i].IsPlanned() &&
                        AlikeLight(group[i].irradiance_W_m2, group[j].irradiance_W_m2);
      if (like) peers.push_back(j);
    }
    if (static_cast<int>(peers.size()) < kLeastPeers) continue;
    all[i].peers = static_cast<int>(peers.size());
    all[i].common = MedianOf(all, peers);
    all[i].deviation = Difference(all[i].residual, all[i].common);
  }
  return all;
}

void ScaleScatter::Add(const std::vector<ScaleResidual>& group) {
  bool any = false;
  for (const ScaleResidual& one : group) {
    for (int q = 0; q < kScaleQuantities; ++q) {
      if (std::isfinite(one.deviation[q])) bins_[q].Add(one.deviation[q]), any = true;
    }
  }
  groups_ += any ? 1 : 0;
}

ScaleErrors ScaleScatter::ErrorsOf(const std::vector<ScaleResidual>& group) const {
  ScaleErrors errors;
  const auto mixed = [](double usual, double found, double degrees) {
    if (!(degrees > 0)) return usual;
    const double sum = kUsualDegrees * usual * usual + degrees * found * found;
    return std::sqrt(sum / (kUsualDegrees + degrees));
  };
  const auto counted = static_cast<double>(bins_[kScaleVoc].count() - groups_);
  const double degrees = kMadEfficiency * std::max(counted, 0.0);
  for (int q = 0; q < kScaleQuantities; ++q) {
    std::vector<double> own;
    for (const ScaleResidual& one : group) {
      if (std::isfinite(one.deviation[q])) own.push_back(one.deviation[q]);
    }
    const double plant = mixed(kUsualErrors[q], kMedianToSigma * bins_[q].Median(), degrees);
    const double own_degrees = kMadEfficiency * (static_cast<double>(own.size()) - 1);
    errors.sizes[q] =
        std::max(plant, mixed(kUsualErrors[q], RobustScale(std::move(own)), own_degrees));
  }
  errors.degrees = kUsualDegrees + degrees;
  return errors;
}

}  // namespace lyrefit
