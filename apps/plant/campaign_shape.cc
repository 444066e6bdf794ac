#include "plant/campaign_shape.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "plant/changed_sweep.h"

namespace lyrefit {
namespace {

// Errors of the mechanisms themselves, as part of the change that they make.
constexpr double kMechanismError = 0.06;
// Errors of neighbouring currents of a sweep are alike: as many count as one.
constexpr double kAlikeCurrents = 3;
// The shape of a sweep departs from every mechanism by more than noise: chi-squared over its mean.
constexpr double kOverdispersion = 2;
// -2 ln of the probability of a parameter, as of Schwarz's criterion for two dozen currents.
constexpr double kPerParameter = 3.2;
constexpr double kOtherModulesRare = 3;  // -2 ln of how much rarer than a fault
constexpr double kChangeRare = 10;       // -2 ln of how much rarer than no change
// The least part of the voltage that a substring gives, where their number is unknown.
constexpr double kLeastVoltage = 0.01;
// The least changes of Isc and Voc of other modules, in standard deviations, beyond what less light
// does to Voc.
constexpr double kOtherFigure = 2.5;
// Cells without light are a bypassed substring, and less light on more of them than this is less light.
constexpr double kDarkest = 0.9, kMostShaded = 0.7;
// Leaks at Voc in parts of Isc: median, and the standard deviation of the logarithm.
constexpr double kUsualLeak = 0.1, kLeakSpread = 1.2;
// -2 ln of how much rarer sizes are spread than alike.
constexpr double kSpreadRare = 1.4;

class MechanismSearch {
 public:
  MechanismSearch(const SweepFigures& sound, const SweepFigures& ill, const SweepScatter& scatter,
                  const StringFacts& facts)
      : points_(PointsOf(sound)), sound_(sound), ill_(ill), scatter_(scatter), facts_(facts) {
    power_ = points_.Power();
    isc_ = ill.log_isc - sound.log_isc;
    voc_ = ill.log_voc - sound.log_voc;
    fill_ = std::log(ill.imp_per_isc * ill.vmp_per_voc / (sound.imp_per_isc * sound.vmp_per_voc));
    largest_ = std::max({std::fabs(isc_), std::fabs(voc_), std::fabs(fill_)});
  }

  std::vector<MechanismFit> All() const {
    // Light is lost as evenly as dirt lies.
    std::vector<MechanismFit> fits = {OfOneSize(Mechanism::kLight, 0, 0.95, {0, 0.08, 0.15, 0.25}),
                                      OfOneSize(Mechanism::kSeriesResistance, 0, 0.7),
                                      OfOneSize(Mechanism::kTemperature, 0, kTemperatureMost),
                                      OfTwoSizes(Mechanism::kShunt, 1.5),
                                      OfTwoSizes(Mechanism::kMismatch, kDarkest)};
    // Modules of another type have another current and another voltage: else it is one fault, the
    // light or a temperature.
    if (std::fabs(isc_) > kOtherFigure * scatter_.log_isc &&
        std::fabs(voc_ - kVocPerLight * isc_) > kOtherFigure * scatter_.log_voc) {
      fits.push_back(OfOneSize(Mechanism::kOtherModules, -0.1, 0.1));
    }
    fits.push_back(facts_.substrings > 1 ? OfSubstrings()
                                         : OfOneSize(Mechanism::kSubstrings, kLeastVoltage, 0.5));
    fits.erase(std::remove_if(fits.begin(), fits.end(),
                              [](const MechanismFit& fit) { return !std::isfinite(fit.misfit); }),
               fits.end());
    if (fits.empty()) return {};
    std::sort(fits.begin(), fits.end(), [](const MechanismFit& one, const MechanismFit& other) {
      return one.misfit < other.misfit;
    });
    const MechanismFit none = Judge(Mechanism::kSeriesResistance, 0, 1, false);
    if (none.misfit - kPerParameter < fits.front().misfit + kChangeRare) return {};
    double sum = 0;
    for (MechanismFit& fit : fits) {
      fit.probability = std::exp(0.5 * (fits.front().misfit - fit.misfit));
      sum += fit.probability;
    }
    for (MechanismFit& fit : fits) fit.probability /= sum;
    return fits;
  }

 private:
  // A mechanism of one size, with -2 ln of its likelihood and prior.
  MechanismFit Judge(Mechanism mechanism, double size, double part, bool spread) const {
    SweepPoints points = Changed(points_, mechanism, size, part, spread, facts_);
    MechanismFit fit = {mechanism, size, part, spread};
    const bool free = mechanism == Mechanism::kOtherModules;
    const double expected_voc = points.VoltageAt(0);
    // What is left of Voc is an error of temperature, which acts on the rest of the sweep too.
    if (!free && mechanism != Mechanism::kTemperature) {
      const double left = std::exp(voc_) - expected_voc;
      for (double& v : points.v) v += std::clamp(left, -kTemperatureMost, kTemperatureMost);
    }
    const double isc = points.CurrentAt(0), voc = points.VoltageAt(0), power = points.Power();
    if (!(isc > 0.01) || !(voc > 0.01) || !(power > 0)) return fit;
    const auto square = [&](double found, double expected, double sigma, double error) {
      return std::pow(found - expected, 2) / (sigma * sigma + error * error);
    };
    const double log_fill = std::log(power / (isc * voc) / power_);
    double sum = square(fill_, log_fill, scatter_.log_fill, kMechanismError * largest_);
    if (!free) {
      sum += square(isc_, std::log(isc), scatter_.log_isc, 0.5 * kMechanismError * largest_);
      sum +=
          square(voc_, std::log(expected_voc), scatter_.log_voc, 0.5 * kMechanismError * largest_);
    }
    if (ill_.currents.empty()) {
      const double vmp = std::log(points.v[points.AtMaximumPower()] / voc / sound_.vmp_per_voc);
      sum += square(std::log(ill_.vmp_per_voc / sound_.vmp_per_voc), vmp,
                    std::hypot(scatter_.log_vmp_per_voc, 0.007), kMechanismError * largest_);
    } else {
      for (int k = 1; k + 1 < kSparklinePoints; ++k) {
        const double v = static_cast<double>(k) / (kSparklinePoints - 1);
        const double expected = points.CurrentAt(v * voc) / isc;
        const double change = ill_.currents[k] - points_.CurrentAt(v);
        sum += square(ill_.currents[k], expected, scatter_.currents[k],
                      kMechanismError * std::fabs(change)) /
               kAlikeCurrents;
      }
    }
    fit.goodness =
        ill_.currents.empty()
            ? ChiSquaredTail(sum, 4)
            : ChiSquaredTail(sum / kOverdispersion, 3 + (kSparklinePoints - 2) / kAlikeCurrents);
    double prior = kPerParameter;
    if (mechanism == Mechanism::kTemperature) prior += std::pow(size / kTemperatureSigma, 2);
    if (mechanism == Mechanism::kShunt || mechanism == Mechanism::kMismatch) prior += kPerParameter;
    if (mechanism == Mechanism::kShunt) {
      prior += std::pow(std::log(size / kUsualLeak) / kLeakSpread, 2);
    }
    if (spread) prior += kSpreadRare;
    if (free) prior += 2 * kPerParameter + kOtherModulesRare;
    fit.misfit = sum + prior;
    return fit;
  }

  // A grid that is drawn together about the best point, for each of the parts.
  MechanismFit OfOneSize(Mechanism mechanism, double from, double to,
                         const std::vector<double>& parts = {1}) const {
    constexpr int kSteps = 12, kRounds = 5;
    MechanismFit best;
    for (const double part : parts) {
      double low = from, high = to;
      MechanismFit here;
      for (int round = 0; round < kRounds; ++round) {
        const double step = (high - low) / kSteps;
        for (int k = 0; k <= kSteps; ++k) {
          Take(Judge(mechanism, low + k * step, part, false), &here);
        }
        low = std::max(low, here.size - 1.5 * step);
        high = std::min(high, here.size + 1.5 * step);
      }
      Take(here, &best);
    }
    return best;
  }
  // Likewise in the logarithms of size and part.
  MechanismFit OfTwoSizes(Mechanism mechanism, double most) const {
    constexpr int kSteps = 9, kRounds = 4;
    double low[] = {std::log(0.003), std::log(0.01)};
    double high[] = {std::log(most), mechanism == Mechanism::kMismatch ? std::log(kMostShaded) : 0};
    MechanismFit best;
    for (int round = 0; round < kRounds; ++round) {
      const double size = (high[0] - low[0]) / kSteps, part = (high[1] - low[1]) / kSteps;
      for (int k = 0; k <= kSteps; ++k) {
        for (int l = 0; l <= kSteps; ++l) {
          for (const bool spread : {false, true}) {
            if (spread && 2 * std::exp(low[0] + k * size) > most) continue;
            Take(Judge(mechanism, std::exp(low[0] + k * size), std::exp(low[1] + l * part), spread),
                 &best);
          }
        }
      }
      const double middle[] = {std::log(best.size), std::log(best.part)};
      for (const int q : {0, 1}) {
        const double step = 1.5 * (q == 0 ? size : part);
        low[q] = std::max(low[q], middle[q] - step);
        high[q] = std::min(high[q], middle[q] + step);
      }
    }
    return best;
  }
  MechanismFit OfSubstrings() const {
    MechanismFit best;
    for (int k = 1; k <= std::max(facts_.substrings / 2, 1); ++k) {
      MechanismFit fit =
          Judge(Mechanism::kSubstrings, static_cast<double>(k) / facts_.substrings, 1, false);
      fit.count = k;
      Take(fit, &best);
    }
    return best;
  }
  static void Take(const MechanismFit& fit, MechanismFit* best) {
    if (std::isfinite(fit.misfit) && !(best->misfit <= fit.misfit)) *best = fit;
  }

  SweepPoints points_;
  const SweepFigures& sound_;
  const SweepFigures& ill_;
  const SweepScatter& scatter_;
  const StringFacts& facts_;
  double power_ = 0, isc_ = 0, voc_ = 0, fill_ = 0, largest_ = 0;
};

}  // namespace

std::vector<MechanismFit> FitMechanisms(const SweepFigures& sound, const SweepFigures& ill,
                                        const SweepScatter& scatter, const StringFacts& facts) {
  return MechanismSearch(sound, ill, scatter, facts).All();
}

}  // namespace lyrefit
