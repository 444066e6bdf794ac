#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/scale_evidence.h"

namespace lyrefit {
namespace {

// Priors of the causes of one string, in odds to each other; of a combiner whose strings are all
// alike, a sensor or the plan is more likely than the same fault in all strings.
struct CausePrior {
  ScaleCause cause;
  double string, combiner;
};
constexpr CausePrior kPriors[] = {
    {ScaleCause::kMissingModule, 1, 0.5},     {ScaleCause::kBypassedSubstring, 2, 0.05},
    {ScaleCause::kReversedModule, 0.5, 0.05}, {ScaleCause::kDisconnectedString, 1, 0.2},
    {ScaleCause::kWrongModuleType, 0.5, 0.5}, {ScaleCause::kExtraModule, 0.2, 0.3},
    {ScaleCause::kCableResistance, 1, 0.5},   {ScaleCause::kUniformSoiling, 2, 2},
    {ScaleCause::kLightSensor, 0.7, 6},       {ScaleCause::kTemperatureSensor, 1, 2},
    {ScaleCause::kSomethingElse, 1, 0.3},
};
constexpr double kHealthyPrior = 0.95;
constexpr int kSteps = 40;  // sizes of a cause
constexpr double kLeastLight = 0.35, kMostLight = 1.8;
constexpr double kLeastKelvin = 3, kMostKelvin = 45;
constexpr double kLeastSlopePart = 0.05, kMostSlopePart = 3;  // resistance, of the slope
constexpr int kMostModules = 4;

// Numbers of cells in series of modules and of their substrings, for strings without a plan.
constexpr int kModuleCells[] = {36, 48, 54, 60, 66, 72, 78, 96, 108, 120, 132, 144};
constexpr int kSubstringCells[] = {10, 11, 12, 13, 16, 18, 20, 22, 24, 26, 32};

double PriorOf(ScaleCause cause, bool shared) {
  for (const CausePrior& prior : kPriors) {
    if (prior.cause == cause) return shared ? prior.combiner : prior.string;
  }
  return 0;
}

class HypothesisList {
 public:
  explicit HypothesisList(const ScaleContext& context)
      : context_(context),
        device_(context.expected,
                std::isfinite(context.cells) ? static_cast<int>(context.cells) : 0,
                context.temperature_K) {}

  std::vector<ScaleHypothesis> Take() {
    AddLostVoltage();
    AddReversed();
    AddDisconnected();
    AddLight();
    AddWarmth();
    AddResistance();
    AddBroad(ScaleCause::kWrongModuleType, {{0.12, 0.12, 0.05, 0.03, 0.3}});
    AddBroad(ScaleCause::kSomethingElse, {{0.15, 0.10, 0.10, 0.10, 0.6}, {1, 1, 0.5, 0.5, 2}});
    double sum = 0;
    for (const ScaleHypothesis& one : all_) sum += one.prior;
    for (ScaleHypothesis& one : all_) one.prior *= (1 - kHealthyPrior) / sum;
    ScaleHypothesis healthy;
    healthy.prior = kHealthyPrior;
    all_.push_back(healthy);
    return std::move(all_);
  }

 private:
  // Adds sizes of one cause whose priors are relative to each other.
  void Add(std::vector<ScaleHypothesis> sizes) {
    double sum = 0;
    for (const ScaleHypothesis& one : sizes) sum += one.prior;
    for (ScaleHypothesis& one : sizes) {
      one.prior *= PriorOf(one.cause, context_.shared) / sum;
      all_.push_back(one);
    }
  }

  static ScaleHypothesis Voltage(ScaleCause cause, double part, double prior) {
    ScaleHypothesis one;
    one.cause = cause;
    one.shift[kScaleVoc] = std::log1p(-part);
    one.prior = prior;
    one.size = part;
    return one;
  }

  // Lost modules take Voc, Vmp and the slope alike, so that of the logarithms Voc alone changes.
  void AddLostVoltage() {
    if (context_.modules == 0) return AddLostCells();
    std::vector<ScaleHypothesis> modules, substrings, extra;
    const int m = context_.modules, k = context_.bypass_diodes;
    for (int count = 1; count <= std::min(kMostModules, m - 1); ++count) {
      modules.push_back(Voltage(ScaleCause::kMissingModule, double(count) / m, 1.0 / count));
      modules.back().count = count;
      modules.back().of = m;
    }
    for (int count = 1; count <= 2; ++count) {
      extra.push_back(Voltage(ScaleCause::kExtraModule, -double(count) / m, 1.0 / count));
      extra.back().count = count;
      extra.back().of = m;
    }
    for (int count = 1; count < 2 * k && k > 1 && count < m * k; ++count) {
      const double prior = count < k ? 1.0 / count : 0.1 / count;
      substrings.push_back(Voltage(ScaleCause::kBypassedSubstring, double(count) / (m * k), prior));
      substrings.back().count = count;
      substrings.back().of = m * k;
    }
    Add(std::move(modules));
    Add(std::move(substrings));
    Add(std::move(extra));
  }

  // Without a plan: as many cells as modules, or substrings of modules, have.
  void AddLostCells() {
    std::vector<ScaleHypothesis> modules, substrings;
    const double all = device_.cells();
    for (const int cells : kModuleCells) {
      for (int count = 1; count <= 3; ++count) {
        const double part = count * cells / all;
        if (part > 0.5) continue;
        modules.push_back(Voltage(ScaleCause::kMissingModule, part, 1.0 / count));
      }
    }
    for (const int cells : kSubstringCells) {
      for (int count = 1; count <= 2; ++count) {
        const double part = count * cells / all;
        if (part > 0.5) continue;
        substrings.push_back(Voltage(ScaleCause::kBypassedSubstring, part, count == 1 ? 1 : 0.2));
      }
    }
    Add(std::move(modules));
    Add(std::move(substrings));
  }

  void AddReversed() {
    std::vector<ScaleHypothesis> sizes;
    const auto add = [&](double part, double prior) {
      ScaleHypothesis one;
      one.cause = ScaleCause::kReversedModule;
      one.shift = device_.ByReversed(part);
      one.size = part;
      one.prior = prior;
      sizes.push_back(one);
    };
    if (context_.modules > 2) {
      for (int count = 1; count <= 2 && 2 * count < context_.modules; ++count) {
        add(double(count) / context_.modules, 1.0 / (count * count));
        sizes.back().count = count;
        sizes.back().of = context_.modules;
      }
    } else if (context_.modules == 0) {
      for (const int cells : kModuleCells) {
        if (cells < 0.25 * device_.cells()) add(double(cells) / device_.cells(), 1);
      }
    }
    Add(std::move(sizes));
  }

  // Strings in parallel change current and slope alike, so that of the logarithms Isc alone
  // changes. (Less light takes voltage too.)
  void AddDisconnected() {
    std::vector<ScaleHypothesis> sizes;
    const int least = context_.strings > 0 ? context_.strings : 2;
    const int most = context_.strings > 0 ? context_.strings : 8;
    for (int of = least; of <= most; ++of) {
      for (int count = 1; count < std::min(of, 4); ++count) {
        ScaleHypothesis one;
        one.cause = ScaleCause::kDisconnectedString;
        one.shift[kScaleIsc] = std::log1p(-double(count) / of);
        one.size = double(count) / of;
        if (context_.strings > 0) one.count = count, one.of = of;
        one.prior = 1.0 / (count * of);
        sizes.push_back(one);
      }
    }
    Add(std::move(sizes));
  }

  void AddLight() {
    std::vector<ScaleHypothesis> dirt, sensor;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) / kSteps;
      ScaleHypothesis one;
      const double factor = kLeastLight * std::pow(kMostLight / kLeastLight, t);
      one.shift = device_.ByLight(factor);
      one.size = factor - 1;
      // Half of the errors are below 10 %.
      one.prior = 1 / (1 + std::pow(std::log(factor) / 0.1, 2));
      one.width[kScaleIsc] = std::log(kMostLight / kLeastLight) / kSteps / 2;
      one.cause = ScaleCause::kLightSensor;
      sensor.push_back(one);
      one.cause = ScaleCause::kUniformSoiling;
      if (factor < 1) dirt.push_back(one);
    }
    Add(std::move(dirt));
    Add(std::move(sensor));
  }

  void AddWarmth() {
    std::vector<ScaleHypothesis> sizes;
    for (int k = 0; k < kSteps; ++k) {
      for (const int sign : {-1, 1}) {
        ScaleHypothesis one;
        one.cause = ScaleCause::kTemperatureSensor;
        one.size = sign * kLeastKelvin * std::pow(kMostKelvin / kLeastKelvin, (k + 0.5) / kSteps);
        one.shift = device_.ByWarmth(one.size);
        one.prior = 1;
        sizes.push_back(one);
      }
    }
    Add(std::move(sizes));
  }

  void AddResistance() {
    std::vector<ScaleHypothesis> sizes;
    const double slope = std::isfinite(context_.expected.slope_ohm)
                             ? context_.expected.slope_ohm
                             : 0.08 * context_.expected.voc_V / context_.expected.isc_A;
    for (int k = 0; k < kSteps; ++k) {
      ScaleHypothesis one;
      one.cause = ScaleCause::kCableResistance;
      one.size =
          slope * kLeastSlopePart * std::pow(kMostSlopePart / kLeastSlopePart, (k + 0.5) / kSteps);
      one.shift = device_.ByResistance(one.size);
      one.prior = 1;
      sizes.push_back(one);
    }
    Add(std::move(sizes));
  }

  // A cause that may change everything, by about these widths.
  void AddBroad(ScaleCause cause, const std::vector<ScaleVector>& widths) {
    std::vector<ScaleHypothesis> sizes;
    for (const ScaleVector& width : widths) {
      ScaleHypothesis one;
      one.cause = cause;
      one.width = width;
      one.prior = 1;
      sizes.push_back(one);
    }
    Add(std::move(sizes));
  }

  const ScaleContext context_;
  const ScaleDevice device_;
  std::vector<ScaleHypothesis> all_;
};

}  // namespace

std::vector<ScaleHypothesis> HypothesesFor(const ScaleContext& context) {
  return HypothesisList(context).Take();
}

}  // namespace lyrefit
