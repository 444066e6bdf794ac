#include "lyrefit/diagnose/noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

// Ratios of constant and relative noise that are weighed against each other.
constexpr double kRatios[] = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5, 1, 2, 100};
constexpr int kRatioCount = static_cast<int>(std::size(kRatios));
// Squares beyond this many variances count as this many: steps and outliers are not noise.
constexpr double kLargestSquare = 6.63;
constexpr double kCutMean = 0.967;  // mean of a squared normal number cut there
// Second differences overlap: three of them say about as much as this many independent squares.
constexpr double kEvidence = 0.5;

struct Difference {
  double square;
  double constant;  // by how much constant noise enters
  double relative;  // by how much noise in proportion to the current does
  double steep;     // by how much noise of the voltage does
};

std::vector<Difference> Differences(const Readings& readings, const std::vector<char>& dark,
                                    bool want_dark, const std::vector<double>& residual,
                                    const std::vector<char>& used) {
  std::vector<int> chain;
  std::vector<Difference> differences;
  int segment = -1;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    if (used[k] == 0 || (dark[r.curve] != 0) != want_dark) continue;
    if (r.segment != segment) chain.clear();
    segment = r.segment;
    chain.push_back(static_cast<int>(k));
    if (chain.size() < 3) continue;
    const int a = chain[chain.size() - 3], b = chain[chain.size() - 2], c = chain.back();
    const double va = readings.points[a].voltage, vb = readings.points[b].voltage,
                 vc = readings.points[c].voltage;
    // A line through the outer two, so that uneven steps do not count.
    double part = vc != va ? (vb - va) / (vc - va) : 0.5;
    if (!(part > 0.05 && part < 0.95)) part = 0.5;
    const double weight[] = {1 - part, -1, part};
    const int at[] = {a, b, c};
    Difference difference{0, 0, 0, 0};
    const double slope =
        vc != va ? (readings.points[c].current - readings.points[a].current) / (vc - va) : 0;
    double value = 0;
    for (int i = 0; i < 3; ++i) {
      const double current = readings.points[at[i]].current;
      value += weight[i] * residual[at[i]];
      const double part_of_noise = weight[i] * weight[i] / readings.points[at[i]].weight;
      difference.constant += part_of_noise;
      difference.relative += part_of_noise * current * current;
    }
    difference.steep = difference.constant * slope * slope;
    difference.square = value * value;
    differences.push_back(difference);
  }
  return differences;
}

// Noise of unit size: its three parts, squared.
struct Shape {
  double constant = 0;
  double relative = 1;
  double voltage = 0;

  double Variance(const Difference& d) const {
    return constant * d.constant + relative * d.relative + voltage * d.steep;
  }
};

// Scale (squared) of noise with the given shape, large squares cut.
double CutScale(const std::vector<Difference>& differences, const Shape& shape) {
  std::vector<double> squares;
  squares.reserve(differences.size());
  for (const Difference& d : differences) squares.push_back(d.square / shape.Variance(d));
  std::vector<double> sorted = squares;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  double scale = sorted[sorted.size() / 2] / 0.455;
  double mean = 0;
  for (const double s : squares) mean += s / static_cast<double>(squares.size());
  if (!(scale > 0)) scale = mean;
  for (int round = 0; round < 6; ++round) {
    double sum = 0;
    for (const double s : squares) sum += std::min(s, kLargestSquare * scale);
    scale = sum / (kCutMean * static_cast<double>(squares.size()));
  }
  return scale;
}

double LogLikelihood(const std::vector<Difference>& differences, const Shape& shape, double scale) {
  double sum = 0;
  for (const Difference& d : differences) {
    const double variance = scale * shape.Variance(d);
    sum -= 0.5 * (std::log(variance) + std::min(d.square / variance, kLargestSquare));
  }
  return kEvidence * sum;
}

// Average over the shapes by their likelihood: with few readings nothing is decided.
NoiseLaw Weigh(const std::vector<Difference>& differences) {
  double scale[kRatioCount], likelihood[kRatioCount], best = -1e300;
  for (int k = 0; k < kRatioCount; ++k) {
    const Shape shape{kRatios[k] * kRatios[k], 1, 0};
    scale[k] = std::max(CutScale(differences, shape), 1e-30);
    likelihood[k] = LogLikelihood(differences, shape, scale[k]);
    best = std::max(best, likelihood[k]);
  }
  double constant2 = 0, relative2 = 0, sum = 0;
  for (int k = 0; k < kRatioCount; ++k) {
    const double weight = std::exp(likelihood[k] - best);
    sum += weight;
    constant2 += weight * scale[k] * kRatios[k] * kRatios[k];
    relative2 += weight * scale[k];
  }
  return {std::sqrt(constant2 / sum), std::sqrt(relative2 / sum), 0};
}

// Adds noise of the voltage where that explains the differences far better.
NoiseLaw AddVoltage(const std::vector<Difference>& differences, const NoiseLaw& law,
                    VoltageNoise voltage) {
  if (voltage == VoltageNoise::kNever) return law;
  // Gain in ln likelihood that is believed.
  const double insist = voltage == VoltageNoise::kAlways ? -1e300 : 5;
  double steepest = 0;
  for (const Difference& d : differences) {
    steepest = std::max(steepest, std::sqrt(d.steep / std::max(d.constant, 1e-12)));
  }
  const Shape plain{law.constant * law.constant, law.relative * law.relative, 0};
  if (!(steepest > 0) || !(plain.constant > 0)) return law;
  double best = LogLikelihood(differences, plain, CutScale(differences, plain)) + insist;
  NoiseLaw found = law;
  for (const double times : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
    Shape shape = plain;
    shape.voltage = std::pow(times / steepest, 2) * plain.constant;
    const double scale = std::max(CutScale(differences, shape), 1e-30);
    const double likelihood = LogLikelihood(differences, shape, scale);
    if (likelihood <= best) continue;
    best = likelihood;
    found = {law.constant * std::sqrt(scale), law.relative * std::sqrt(scale),
             std::sqrt(scale * shape.voltage)};
  }
  return found;
}

NoiseLaw EstimateLaw(const std::vector<Difference>& differences, const NoiseLaw* stated,
                     VoltageNoise voltage) {
  if (differences.size() < 3) return {kSmallestNoise, 0, 0};
  if (stated != nullptr) {
    const double relative = std::max(stated->relative, 1e-12);
    const double ratio2 = std::pow(stated->constant / relative, 2);
    const double scale = CutScale(differences, {ratio2, 1, 0});
    return {std::sqrt(scale * ratio2), std::sqrt(scale), 0};
  }
  return AddVoltage(differences, Weigh(differences), voltage);
}

double Deviation(const NoiseLaw& law, double current, double slope) {
  return std::hypot(law.constant, law.relative * current, law.voltage * slope);
}

// dI/dV at a reading, from its neighbours of the same stretch.
double SlopeAt(const std::vector<Reading>& points, std::size_t k) {
  const std::size_t last = points.size() - 1;
  const std::size_t a = k > 0 && points[k - 1].segment == points[k].segment ? k - 1 : k;
  const std::size_t b = k < last && points[k + 1].segment == points[k].segment ? k + 1 : k;
  const double dv = points[b].voltage - points[a].voltage;
  return std::fabs(dv) > 1e-6 ? (points[b].current - points[a].current) / dv : 0;
}

}  // namespace

Noise EstimateNoise(const Readings& readings, const std::vector<char>& dark,
                    const std::vector<double>& residual, const std::vector<char>& used,
                    const DeviceNotes& notes, const Grids& grids, VoltageNoise voltage) {
  Noise noise;
  NoiseLaw stated;
  const bool is_stated = notes.current_noise_constant_A && notes.current_noise_relative;
  if (is_stated) {
    stated.constant = *notes.current_noise_constant_A / readings.scale.current_A;
    stated.relative = *notes.current_noise_relative;
  }
  const auto lit = Differences(readings, dark, false, residual, used);
  const auto unlit = Differences(readings, dark, true, residual, used);
  if (lit.size() >= 3) noise.lit = EstimateLaw(lit, is_stated ? &stated : nullptr, voltage);
  if (unlit.size() >= 3) noise.dark = EstimateLaw(unlit, nullptr, voltage);
  if (lit.size() < 3) noise.lit = noise.dark;
  if (unlit.size() < 3) noise.dark = noise.lit;
  // A grid leaves no two readings closer than its own rounding noise.
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    const NoiseLaw& law = dark[r.curve] != 0 ? noise.dark : noise.lit;
    const double rounding = 0.25 * (dark[r.curve] != 0 ? grids.dark : grids.lit);
    const double single =
        std::max(Deviation(law, r.current, SlopeAt(readings.points, k)), rounding);
    noise.sigma.push_back(std::max(single / std::sqrt(r.weight), kSmallestNoise));
  }
  return noise;
}

bool IsCoarse(const Readings& readings, const std::vector<char>& dark, const Noise& noise,
              const Grids& grids) {
  for (const char class_of : {0, 1}) {
    const double step = class_of != 0 ? grids.dark : grids.lit;
    std::vector<double> sigma;
    for (std::size_t k = 0; k < readings.points.size(); ++k) {
      if (dark[readings.points[k].curve] != class_of) continue;
      sigma.push_back(noise.sigma[k] * std::sqrt(readings.points[k].weight));
    }
    if (sigma.empty() || !(step > 0)) continue;
    std::nth_element(sigma.begin(), sigma.begin() + sigma.size() / 2, sigma.end());
    if (step > kCoarseGrid * sigma[sigma.size() / 2]) return true;
  }
  return false;
}

Autocorrelation EstimateAutocorrelation(const Readings& readings,
                                        const std::vector<double>& residual,
                                        const std::vector<char>& used, int parameters) {
  constexpr int kWaves = 6;
  double product = 0, square = 0, bias = 0;
  int count = 0;
  std::vector<double> chain;
  const auto close = [&] {
    const int n = static_cast<int>(chain.size());
    if (n >= 12) {
      const int waves = std::min(kWaves, n / 4);
      Eigen::MatrixXd smooth(n, waves);
      for (int i = 0; i < n; ++i) {
        for (int w = 0; w < waves; ++w) {
          smooth(i, w) = std::cos(M_PI * w * (i + 0.5) / n) * std::sqrt((w == 0 ? 1.0 : 2.0) / n);
        }
      }
      Eigen::VectorXd e = Eigen::Map<Eigen::VectorXd>(chain.data(), n);
      TakeOut(smooth, &e);
      for (int i = 0; i + 1 < n; ++i) product += e[i] * e[i + 1];
      square += e.squaredNorm();
      // What removing `waves` smooth shapes takes from the neighbours' product.
      bias -= smooth.topRows(n - 1).cwiseProduct(smooth.bottomRows(n - 1)).sum();
      count += n;
    }
    chain.clear();
  };
  int segment = -1;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    if (used[k] == 0) continue;
    if (readings.points[k].segment != segment) close();
    segment = readings.points[k].segment;
    chain.push_back(residual[k]);
  }
  close();
  Autocorrelation result;
  if (count < 20 || !(square > 0)) return result;
  const double free = count + bias - parameters;
  result.value = (product - bias * square / std::max(free, 1.0)) / square;
  result.standard_error = 1 / std::sqrt(static_cast<double>(count));
  return result;
}

}  // namespace lyrefit
