// Optimized fully: it runs once for each candidate.
#include "lyrefit/diagnose/noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/median.h"

namespace lyrefit {

// Ratios of constant to relative noise that are averaged over.
constexpr double kRatios[] = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5, 1, 2, 100};
constexpr int kRatioCount = static_cast<int>(std::size(kRatios));

// Second differences along the stretches of the lit or the dark curves: everything that does not
// depend on the residuals.
struct NoiseDifferences {
  struct Place {
    int at[3];       // consecutive readings of one stretch
    double part[2];  // weights of the outer two for a line through them at the middle one
  };
  std::vector<Place> places;
  Eigen::ArrayXd constant;        // factor of constant^2 in the variance of a difference
  Eigen::ArrayXd relative;        // factor of relative^2
  Eigen::ArrayXd steep;           // factor of voltage^2
  Eigen::ArrayXXd inverse;        // 1 / variance at unit noise, one column per ratio
  double logs[kRatioCount] = {};  // sums of ln variance at unit noise

  int size() const { return static_cast<int>(places.size()); }
};

namespace {

// Limit for squared differences, in variances. Steps and outliers, which are not noise, are cut to
// it.
constexpr double kLargestSquare = 6.63;
constexpr double kCutMean = 0.967;  // mean of a squared standard normal number cut at that limit
// Weight of a squared difference in the log-likelihood. It is below 1, since second differences
// overlap and are not independent.
constexpr double kEvidence = 0.5;

// Noise model up to its size: squares of its three terms.
struct Shape {
  double constant = 0;
  double relative = 1;
  double voltage = 0;

  Eigen::ArrayXd Variance(const NoiseDifferences& d) const {
    return constant * d.constant + relative * d.relative + voltage * d.steep;
  }
};

std::vector<NoiseDifferences::Place> FindPlaces(const Readings& readings, bool dark,
                                                const std::vector<char>& used) {
  std::vector<NoiseDifferences::Place> places;
  int segment = -1, length = 0, at[3] = {};
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    if (used[k] == 0 || r.dark != dark) continue;
    length = r.segment == segment ? length + 1 : 1;
    segment = r.segment;
    at[0] = at[1], at[1] = at[2], at[2] = static_cast<int>(k);
    if (length < 3) continue;
    const auto voltage = [&](int i) { return readings.points[at[i]].voltage; };
    // Weights of a line through the outer two, so that uneven voltage steps have no effect.
    const double span = voltage(2) - voltage(0);
    double part = span != 0 ? (voltage(1) - voltage(0)) / span : 0.5;
    if (!(part > 0.05 && part < 0.95)) part = 0.5;
    places.push_back({{at[0], at[1], at[2]}, {1 - part, part}});
  }
  return places;
}

NoiseDifferences FindDifferences(const Readings& readings, bool dark,
                                 const std::vector<char>& used) {
  NoiseDifferences d;
  d.places = FindPlaces(readings, dark, used);
  d.constant = d.relative = d.steep = Eigen::ArrayXd::Zero(d.size());
  for (int k = 0; k < d.size(); ++k) {
    const NoiseDifferences::Place& place = d.places[k];
    const Reading &a = readings.points[place.at[0]], &c = readings.points[place.at[2]];
    const double weight[] = {place.part[0], -1, place.part[1]};
    for (int i = 0; i < 3; ++i) {
      const Reading& r = readings.points[place.at[i]];
      const double part_of_noise = weight[i] * weight[i] / r.weight;
      d.constant[k] += part_of_noise;
      d.relative[k] += part_of_noise * r.current * r.current;
    }
    const double span = c.voltage - a.voltage;
    const double slope = span != 0 ? (c.current - a.current) / span : 0;
    d.steep[k] = d.constant[k] * slope * slope;
  }
  d.inverse.resize(d.size(), kRatioCount);
  for (int k = 0; k < kRatioCount; ++k) {
    const Eigen::ArrayXd variance = Shape{kRatios[k] * kRatios[k], 1, 0}.Variance(d);
    d.inverse.col(k) = variance.inverse();
    d.logs[k] = variance.log().sum();
  }
  return d;
}

Eigen::ArrayXd Squares(const NoiseDifferences& d, const std::vector<double>& residual) {
  Eigen::ArrayXd squares(d.size());
  for (int k = 0; k < d.size(); ++k) {
    const NoiseDifferences::Place& p = d.places[k];
    const double value =
        p.part[0] * residual[p.at[0]] - residual[p.at[1]] + p.part[1] * residual[p.at[2]];
    squares[k] = value * value;
  }
  return squares;
}

// Squared scale of noise, from squared differences divided by their variance at unit noise; large
// ones are cut. The iteration starts from `guess` (0: none). If it does not converge at once, as it
// does for pure noise, it starts from the median, which is robust against steps and outliers.
double CutScale(const Eigen::ArrayXd& squares, double guess) {
  constexpr int kRounds = 6;
  constexpr double kSettled = 1e-6;
  const double count = static_cast<double>(squares.size());
  double scale = guess;
  for (int round = 0; round < kRounds && scale > 0; ++round) {
    const double before = scale;
    scale = squares.min(kLargestSquare * scale).sum() / (kCutMean * count);
    if (std::fabs(scale - before) < kSettled * scale) return std::max(scale, 1e-30);
  }
  scale = UpperMedian({squares.data(), squares.data() + squares.size()}) / 0.455;
  if (!(scale > 0)) scale = squares.sum() / count;
  for (int round = 0; round < kRounds; ++round) {
    scale = squares.min(kLargestSquare * scale).sum() / (kCutMean * count);
  }
  return std::max(scale, 1e-30);
}

// `logs`: sum of ln variance at unit noise.
double LogLikelihood(const Eigen::ArrayXd& squares, double logs, double scale) {
  const double count = static_cast<double>(squares.size());
  const double cut = squares.min(kLargestSquare * scale).sum() / scale;
  return -0.5 * kEvidence * (logs + count * std::log(scale) + cut);
}

// Average over the ratios, weighted by their likelihood: few readings do not determine the ratio.
NoiseLaw Weigh(const NoiseDifferences& differences, const Eigen::ArrayXd& squares) {
  double scale[kRatioCount], likelihood[kRatioCount], best = -1e300;
  for (int k = 0; k < kRatioCount; ++k) {
    const Eigen::ArrayXd in_units = squares * differences.inverse.col(k);
    // The total noise is nearly the same for neighbouring ratios.
    const double count = static_cast<double>(squares.size());
    const double guess =
        k == 0 ? 0
               : scale[k - 1] * std::exp((differences.logs[k - 1] - differences.logs[k]) / count);
    scale[k] = CutScale(in_units, guess);
    likelihood[k] = LogLikelihood(in_units, differences.logs[k], scale[k]);
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

// Adds noise of the voltage if that raises the likelihood of the differences sufficiently.
NoiseLaw AddVoltage(const NoiseDifferences& differences, const Eigen::ArrayXd& squares,
                    const NoiseLaw& law, VoltageNoise voltage) {
  if (voltage == VoltageNoise::kNever) return law;
  // Required gain in log-likelihood.
  const double insist = voltage == VoltageNoise::kAlways ? -1e300 : 5;
  const double steepest =
      std::sqrt((differences.steep / differences.constant.max(1e-12)).maxCoeff());
  const Shape plain{law.constant * law.constant, law.relative * law.relative, 0};
  if (!(steepest > 0) || !(plain.constant > 0)) return law;
  double scale = 0;
  const auto try_shape = [&](const Shape& shape) {
    const Eigen::ArrayXd variance = shape.Variance(differences);
    const Eigen::ArrayXd in_units = squares / variance;
    scale = CutScale(in_units, 0);
    return LogLikelihood(in_units, variance.log().sum(), scale);
  };
  double best = try_shape(plain) + insist;
  NoiseLaw found = law;
  for (const double times : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
    Shape shape = plain;
    shape.voltage = std::pow(times / steepest, 2) * plain.constant;
    const double likelihood = try_shape(shape);
    if (likelihood <= best) continue;
    best = likelihood;
    found = {law.constant * std::sqrt(scale), law.relative * std::sqrt(scale),
             std::sqrt(scale * shape.voltage)};
  }
  return found;
}

// dI/dV at a reading, from its neighbours in the same stretch.
double SlopeAt(const std::vector<Reading>& points, std::size_t k) {
  const std::size_t last = points.size() - 1;
  const std::size_t a = k > 0 && points[k - 1].segment == points[k].segment ? k - 1 : k;
  const std::size_t b = k < last && points[k + 1].segment == points[k].segment ? k + 1 : k;
  const double dv = points[b].voltage - points[a].voltage;
  return std::fabs(dv) > 1e-6 ? (points[b].current - points[a].current) / dv : 0;
}

}  // namespace

struct NoiseEstimator::Parts {
  const Readings& readings;
  VoltageNoise voltage;
  std::optional<NoiseLaw> stated;
  NoiseDifferences lit, dark;
  std::vector<double> slope;       // dI/dV at each reading
  std::vector<double> grid_noise;  // lower limit from rounding to a grid

  NoiseLaw Estimate(const NoiseDifferences& differences,
                    const std::vector<double>& residual) const {
    const Eigen::ArrayXd squares = Squares(differences, residual);
    if (&differences == &lit && stated) {
      const double relative = std::max(stated->relative, 1e-12);
      const double ratio2 = std::pow(stated->constant / relative, 2);
      const double scale = CutScale(squares / Shape{ratio2, 1, 0}.Variance(differences), 0);
      return {std::sqrt(scale * ratio2), std::sqrt(scale), 0};
    }
    return AddVoltage(differences, squares, Weigh(differences, squares), voltage);
  }
};

NoiseEstimator::NoiseEstimator(const Measurement& measurement, const std::vector<char>& used,
                               VoltageNoise voltage)
    : parts_(new Parts{measurement.readings, voltage, {}, {}, {}, {}, {}}) {
  const Readings& readings = measurement.readings;
  const DeviceNotes& notes = measurement.notes;
  const Grids& grids = measurement.values.grids;
  if (notes.current_noise_constant_A && notes.current_noise_relative) {
    parts_->stated = NoiseLaw{*notes.current_noise_constant_A / readings.scale.current_A,
                              *notes.current_noise_relative, 0};
  }
  parts_->lit = FindDifferences(readings, false, used);
  parts_->dark = FindDifferences(readings, true, used);
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    parts_->slope.push_back(SlopeAt(readings.points, k));
    parts_->grid_noise.push_back(0.25 * (readings.points[k].dark ? grids.dark : grids.lit));
  }
}

NoiseEstimator::~NoiseEstimator() = default;

Noise NoiseEstimator::Estimate(const std::vector<double>& residual) const {
  constexpr int kFewest = 3;
  Noise noise;
  noise.lit = noise.dark = {0, 0, 0};
  const bool lit = parts_->lit.size() >= kFewest, dark = parts_->dark.size() >= kFewest;
  if (lit) noise.lit = parts_->Estimate(parts_->lit, residual);
  if (dark) noise.dark = parts_->Estimate(parts_->dark, residual);
  if (!lit) noise.lit = noise.dark;
  if (!dark) noise.dark = noise.lit;
  noise.sigma.reserve(parts_->slope.size());
  for (std::size_t k = 0; k < parts_->slope.size(); ++k) {
    const Reading& r = parts_->readings.points[k];
    const NoiseLaw& law = r.dark ? noise.dark : noise.lit;
    const double relative = law.relative * r.current, voltage = law.voltage * parts_->slope[k];
    const double deviation =
        std::sqrt(law.constant * law.constant + relative * relative + voltage * voltage);
    const double single = std::max(deviation, parts_->grid_noise[k]);
    noise.sigma.push_back(std::max(single / std::sqrt(r.weight), kSmallestNoise));
  }
  return noise;
}

Noise EstimateNoise(const Measurement& measurement, const std::vector<double>& residual,
                    const std::vector<char>& used, VoltageNoise voltage) {
  return NoiseEstimator(measurement, used, voltage).Estimate(residual);
}

bool IsCoarse(const Measurement& measurement, const Noise& noise) {
  const std::vector<Reading>& points = measurement.readings.points;
  const Grids& grids = measurement.values.grids;
  for (const bool dark : {false, true}) {
    const double step = dark ? grids.dark : grids.lit;
    std::vector<double> sigma;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].dark != dark) continue;
      sigma.push_back(noise.sigma[k] * std::sqrt(points[k].weight));
    }
    if (sigma.empty() || !(step > 0)) continue;
    if (step > kCoarseGrid * UpperMedian(std::move(sigma))) return true;
  }
  return false;
}

bool HasCoarseBins(const Measurement& measurement, const Noise& noise) {
  if (measurement.values.voltage_bin == 0) return false;
  const std::vector<double>& rounding = measurement.values.bin_rounding;
  std::vector<std::size_t> steepest(rounding.size());
  std::iota(steepest.begin(), steepest.end(), 0);
  const std::size_t steep = rounding.size() / 8;  // median of the steepest quarter
  std::nth_element(steepest.begin(), steepest.begin() + steep, steepest.end(),
                   [&](std::size_t a, std::size_t b) { return rounding[a] > rounding[b]; });
  const std::size_t k = steepest[steep];
  const double sigma = noise.sigma[k] * std::sqrt(measurement.readings.points[k].weight);
  return std::sqrt(12) * rounding[k] > kCoarseGrid * sigma;
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
      // Expected change of the lag-1 product by the removal of `waves` smooth functions.
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
