#include "lyrefit/devices/joint_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/cell_figures.h"
#include "lyrefit/estimate/fit/reading_errors.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {
namespace {

constexpr double kLeastCellSaturation = 1e-80;  // of the largest current
constexpr double kMostCellSaturation = 0.1;     // of the largest current
constexpr double kMostCellPhotocurrent = 3;     // of Isc
constexpr double kMostCellSeries = 0.5;         // of Voc / Isc
constexpr double kLeastCellShunt = 0.01;        // of Voc / Isc
constexpr double kMostContact = 5;              // of Voc / Isc
constexpr double kLeastContact = 0.01;          // of Voc / Isc, to start from
constexpr double kLeastAgedShare = 0.005;       // of the area
constexpr double kSecondIdeality = 2;           // recombination in the depletion region
constexpr double kLeastFactor = 0.2;            // of the lights of a Suns-Voc trace
constexpr double kMostFactor = 5;
// Of lit sweeps above the dark one. Voc of some devices moves half as much again in a kelvin as by the
// law here: this holds 5 K of each.
constexpr double kMostWarmer_K = 8;
constexpr double kExact = 1e-9;           // least error of a reading, of Isc or Voc
constexpr std::size_t kFewReadings = 12;  // that do not show their own errors
constexpr double kErrorOfFew = 1e-3;      // least error of one of them, of Isc or Voc

void Add(ParameterInfo info, double lower, double upper, CellProblem* problem) {
  problem->parameters.push_back(std::move(info));
  problem->lower.push_back(lower);
  problem->upper.push_back(upper);
}

// Parameters of the device without its photocurrent, and the collection.
void AddShared(const CellOptions& options, JointCell* cell) {
  CellProblem& problem = cell->problem;
  const double ohm = cell->voc_V / cell->isc_A;
  for (int i = 1; i < problem.device.size(); ++i) {
    ParameterInfo info = problem.device.parameters[i];
    for (int& other : info.with) other -= other > 0 ? 1 : 0;
    const bool second = i == IdealityIndex(1);
    switch (info.kind) {
      case ParameterKind::kSaturation:
        Add(info, kLeastCellSaturation * cell->isc_A, kMostCellSaturation * cell->isc_A, &problem);
        break;
      case ParameterKind::kIdeality:
        Add(info, second ? kSecondIdeality : 1, second ? kSecondIdeality : options.largest_n,
            &problem);
        break;
      case ParameterKind::kSeries:
        Add(info, 0, kMostCellSeries * ohm, &problem);
        break;
      default:
        Add(info, kLeastCellShunt * ohm, kInfinity, &problem);
    }
  }
  Add({"c", "collection_slope", "1/V", "part of the photocurrent lost per volt of the junction",
       ParameterKind::kPlain, 0.01},
      0, 1 / cell->voc_V, &problem);
  if (problem.contacts) {
    Add({"s", "contact_share", "", "part of the area behind a series resistance of its own",
         ParameterKind::kPlain, 0.1},
        kLeastAgedShare, 1 - kLeastAgedShare, &problem);
    Add({"Rc", "contact_resistance", "ohm",
         "series resistance of that part, as if the whole device were behind it",
         ParameterKind::kSeries},
        0, kMostContact * ohm, &problem);
  }
  if (!problem.warmer) return;
  Add({"dT", "temperature_difference", "K", "of the lit sweeps above the dark one",
       ParameterKind::kPlain, 1},
      -kMostWarmer_K, kMostWarmer_K, &problem);
}

// Band gap of a cell of this Voc: the stated one, else that of silicon or the half a volt above Voc
// that good cells lose.
double GapOf(const CellReport& report, double cell_voc_V) {
  constexpr double kSilicon_eV = 1.121, kLost_V = 0.5;
  return report.bandgap_eV > 0 ? report.bandgap_eV : std::max(kSilicon_eV, cell_voc_V + kLost_V);
}

// Least error of a reading. A few readings may be met exactly by parameters of their own.
double LeastError(std::size_t readings, double noise, double scale) {
  return readings < kFewReadings ? std::max(noise, kErrorOfFew * scale) : kExact * scale;
}

void AddCurve(const CellSweep& sweep, JointCell* cell) {
  CellProblem& problem = cell->problem;
  CellBlock block;
  block.voltage_V = sweep.voltage_V;
  block.current_A = sweep.current_A;
  block.pseudo = sweep.kind == SweepKind::kSunsVoc;
  block.heated = sweep.kind == SweepKind::kLit;
  if (sweep.kind != SweepKind::kDark) {
    block.light = static_cast<int>(problem.parameters.size());
    Add({"Iph[" + sweep.name + "]", "photocurrent[" + sweep.name + "]", "A",
         "photocurrent of this curve", ParameterKind::kPhotocurrent},
        0, kMostCellPhotocurrent * IscOfSweep(sweep), &problem);
  }
  cell->noise.push_back(sweep.noise_A);
  cell->least_error.push_back(LeastError(block.voltage_V.size(), sweep.noise_A, cell->isc_A));
  problem.blocks.push_back(std::move(block));
}

void AddTrace(const CellSweep& sweep, bool lit, JointCell* cell) {
  CellProblem& problem = cell->problem;
  CellBlock block;
  block.open_circuit = true;
  std::vector<double> logarithm;
  for (const VocPoint& point : PointsOfTrace(sweep)) {
    block.voltage_V.push_back(point.voc_V);
    block.current_A.push_back(point.light_A);
    logarithm.push_back(std::log(point.light_A));
  }
  block.light = static_cast<int>(problem.parameters.size());
  // Without a lit curve nothing else tells the light.
  Add({"s[" + sweep.name + "]", "light_factor[" + sweep.name + "]", "",
       "factor of the lights that the trace states", ParameterKind::kPlain, 0.1},
      lit ? kLeastFactor : 1, lit ? kMostFactor : 1, &problem);
  cell->noise.push_back(NoiseFromDifferences(logarithm, block.voltage_V));
  cell->least_error.push_back(LeastError(block.voltage_V.size(), cell->noise.back(), cell->voc_V));
  problem.blocks.push_back(std::move(block));
}

// Isc and Voc of the brightest curve; in their place what the curve reaches.
void FindScales(const CellReport& report, const std::vector<int>& lights, int dark,
                JointCell* cell) {
  const CellSweep& first = report.sweeps[lights.empty() ? dark : lights.front()];
  cell->isc_A = lights.empty() ? -first.current_A.back() : IscOfSweep(first);
  const double voc = first.key.open_circuit_voltage_V;  // NaN: not reached
  cell->voc_V = voc > 0 ? voc : first.voltage_V.back();
  cell->problem.current_scale_A = cell->isc_A;
  cell->problem.voltage_scale_V = cell->voc_V;
}

// What a relative departure of the model from the cell is a part of.
double DepartureScale(const CellBlock& block, std::size_t k, double photocurrent_A,
                      double thermal_V) {
  if (block.open_circuit) return thermal_V;
  return block.light >= 0 ? photocurrent_A : std::fabs(block.current_A[k]);
}

// Effect of the errors of a block's readings on its residuals. A departure of the model is relative
// to the photocurrent, to the dark current, or to the light of an open-circuit voltage.
ErrorShape ShapeOfBlock(const JointCell& cell, int b, const std::vector<double>& p) {
  const CellProblem& problem = cell.problem;
  const CellBlock& block = problem.blocks[b];
  const double scale = problem.error_A / block.error;
  const std::size_t count = block.voltage_V.size();
  ErrorShape shape;
  if (block.open_circuit) {
    shape.current.assign(count, scale);
    shape.voltage.assign(count, 0);
    shape.path.assign(count, 0);
    shape.chain.assign(count, 0);
    for (const double v : block.voltage_V) shape.position.push_back(v / cell.voc_V);
  } else {
    const std::vector<double> device =
        DeviceUnderLight(problem, p.data(), block.light < 0 ? 0 : p[block.light], block.heated);
    AppendErrorShape({problem.device, Objective::kSolvedCurrent, block.voltage_V, block.current_A,
                      std::vector<double>(count, scale * scale), cell.voc_V, device},
                     0, &shape);
  }
  const double thermal_V = problem.device.module_thermal_voltage_V * p[IdealityIndex(0) - 1];
  const double photocurrent = block.light < 0 ? 0 : p[block.light];
  for (std::size_t k = 0; k < count; ++k) {
    shape.path[k] = scale * DepartureScale(block, k, photocurrent, thermal_V);
  }
  return shape;
}

ErrorModel IndependentErrors(std::size_t count, double error_A) {
  ErrorModel errors;
  errors.white.assign(count, error_A);
  return errors;
}

}  // namespace

double IscOfSweep(const CellSweep& sweep) {
  if (sweep.kind == SweepKind::kSunsVoc) return sweep.suns_voc_A;
  const double isc = sweep.key.short_circuit_current_A;
  if (!std::isnan(isc)) return isc;
  const auto [low, high] = std::minmax_element(sweep.voltage_V.begin(), sweep.voltage_V.end());
  if (!(*low < 0.5 * *high)) return isc;
  return *std::max_element(sweep.current_A.begin(), sweep.current_A.end());
}

JointCell MakeJointCell(const CellReport& report, const std::vector<int>& lights, int dark,
                        const CellOptions& options, const JointKind& kind) {
  JointCell cell;
  cell.problem.contacts = kind.contacts;
  cell.problem.warmer = kind.warmer;
  FindScales(report, lights, dark, &cell);
  Conditions conditions;
  conditions.cell_temperature_K = report.temperature_C + kZeroCelsius_K;
  conditions.cells_in_series = report.cells_in_series;
  cell.problem.device = MakeDevice(kind.second_diode ? Model::kDoubleDiode : Model::kSingleDiode,
                                   conditions, options.constants);
  cell.problem.temperature_K = conditions.cell_temperature_K;
  cell.problem.gap_over_thermal = GapOf(report, cell.voc_V / report.cells_in_series) *
                                  report.cells_in_series /
                                  cell.problem.device.module_thermal_voltage_V;
  AddShared(options, &cell);
  for (const int i : lights) {
    AddCurve(report.sweeps[i], &cell);
    cell.sweep.push_back(i);
  }
  if (dark >= 0) {
    AddCurve(report.sweeps[dark], &cell);
    cell.sweep.push_back(dark);
  }
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    if (report.sweeps[i].kind != SweepKind::kSunsVoc) continue;
    if (PointsOfTrace(report.sweeps[i]).size() < 2) continue;
    if (report.sweeps[i].pseudo_current) {
      AddCurve(report.sweeps[i], &cell);
    } else {
      AddTrace(report.sweeps[i], !lights.empty(), &cell);
    }
    cell.sweep.push_back(static_cast<int>(i));
  }
  for (std::size_t b = 0; b < cell.noise.size(); ++b) {
    cell.problem.blocks[b].error = std::max(cell.noise[b], cell.least_error[b]);
  }
  cell.problem.error_A = cell.problem.blocks.front().error;
  return cell;
}

std::vector<std::vector<double>> JointStarts(const JointCell& cell, const CellReport& report) {
  const CellProblem& problem = cell.problem;
  const double ohm = cell.voc_V / cell.isc_A;
  std::vector<std::vector<double>> starts;
  const auto add = [&](std::vector<double> p, double shunt_ohm, double collection) {
    p[kRsh - 1] = shunt_ohm;
    p[problem.collection()] = collection;
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const int light = problem.blocks[b].light;
      if (light < 0) continue;
      const CellSweep& sweep = report.sweeps[cell.sweep[b]];
      p[light] =
          problem.blocks[b].open_circuit ? 1 : IscOfSweep(sweep) * (1 + p[kRs - 1] / shunt_ohm);
    }
    starts.push_back(std::move(p));
  };
  constexpr double kNoShunt = 1e4;
  for (const int i : cell.sweep) {
    const CellSweep& sweep = report.sweeps[i];
    if (!sweep.fit) continue;
    std::vector<double> p(problem.parameters.size());
    p[SaturationCurrentIndex(0) - 1] = FittedValue(sweep, "Is1").value;
    p[IdealityIndex(0) - 1] = FittedValue(sweep, "n1").value;
    p[kRs - 1] = FittedValue(sweep, "Rs").value;
    const double shunt = std::min(FittedValue(sweep, "Rsh").value, kNoShunt * ohm);
    add(p, shunt, 0);
    if (sweep.kind == SweepKind::kLit) {
      add(p, kNoShunt * ohm, 1 / (shunt * IscOfSweep(sweep)));
    }
  }
  return starts;
}

std::vector<std::vector<double>> SecondDiodeStarts(const JointCell& cell,
                                                   const std::vector<double>& single) {
  const CellProblem& problem = cell.problem;
  const double thermal_V = problem.device.module_thermal_voltage_V;
  std::vector<std::vector<double>> starts;
  const int first = SaturationCurrentIndex(0) - 1, second = SaturationCurrentIndex(1) - 1;
  const double n = single[IdealityIndex(0) - 1];
  const double lost = single[first] * std::exp(cell.voc_V / (n * thermal_V));
  for (const double ideality : {1.0, n}) {
    for (const double part : {0.03, 0.3}) {
      std::vector<double> p(problem.parameters.size());
      std::copy_n(single.begin(), kRsh, p.begin());
      p[IdealityIndex(0) - 1] = ideality;
      p[first] = (1 - part) * lost * std::exp(-cell.voc_V / (ideality * thermal_V));
      p[second] = part * lost * std::exp(-cell.voc_V / (kSecondIdeality * thermal_V));
      p[IdealityIndex(1) - 1] = kSecondIdeality;
      std::copy(single.begin() + kRsh, single.end(), p.begin() + problem.collection());
      starts.push_back(std::move(p));
    }
  }
  return starts;
}

std::vector<std::vector<double>> WarmerStarts(const JointCell& cell,
                                              const std::vector<double>& plain) {
  std::vector<std::vector<double>> starts;
  for (const double kelvin : {-1.5, 1.5}) {
    starts.push_back(plain);
    starts.back().insert(starts.back().begin() + cell.problem.warmth(), kelvin);
  }
  return starts;
}

std::vector<std::vector<double>> ContactStarts(const JointCell& cell,
                                               const std::vector<double>& plain) {
  std::vector<std::vector<double>> starts;
  const CellProblem& problem = cell.problem;
  for (const double share : {0.1, 0.25, 0.5}) {
    for (const double times : {4.0, 15.0}) {
      std::vector<double> p = plain;
      // Both parts together keep the resistance at large currents.
      const double whole = std::max(plain[kRs - 1], kLeastContact * cell.voc_V / cell.isc_A);
      const double rest = whole * (1 - share + share / times);
      p[kRs - 1] = rest;
      p.insert(p.begin() + problem.contact_share(), {share, times * rest});
      starts.push_back(std::move(p));
    }
  }
  return starts;
}

std::vector<double> RmsOfBlocks(const CellProblem& problem, const std::vector<double>& p) {
  const CellModel model(problem);
  std::vector<double> rms;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const CellBlock& block = problem.blocks[b];
    Eigen::VectorXd residual(static_cast<Eigen::Index>(block.voltage_V.size()));
    const bool evaluated =
        model.Evaluate(static_cast<int>(b), p.data(), nullptr, residual.data(), nullptr, nullptr);
    const double scale = block.error / problem.error_A;
    rms.push_back(evaluated ? scale * residual.norm() / std::sqrt(residual.size()) : kUnknown);
  }
  return rms;
}

std::vector<ErrorModel> FindBlockErrors(const JointCell& cell, const std::vector<double>& p) {
  constexpr std::size_t kFewest = 6;
  const CellProblem& problem = cell.problem;
  const CellModel model(problem);
  std::vector<ErrorModel> errors;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const CellBlock& block = problem.blocks[b];
    const std::size_t count = block.voltage_V.size();
    Eigen::VectorXd residual(static_cast<Eigen::Index>(count));
    const bool evaluated =
        model.Evaluate(static_cast<int>(b), p.data(), nullptr, residual.data(), nullptr, nullptr);
    errors.push_back(IndependentErrors(count, problem.error_A));
    if (!evaluated || count < kFewest) continue;
    const ErrorShape shape = ShapeOfBlock(cell, static_cast<int>(b), p);
    // A unit of the independent error is an ampere, or a volt of an open-circuit voltage.
    const double unit = block.open_circuit ? cell.voc_V : cell.isc_A;
    const FoundErrors found =
        FindErrorSizes(shape, UsualErrors(unit, cell.voc_V), residual, RowMatrix(count, 0));
    if (found.gain > kGainToBelieve) errors.back() = MakeErrorModel(shape, found.sizes);
  }
  return errors;
}

Spread SpreadUnderErrors(const CellProblem& problem, const FitPoint& end,
                         const std::vector<bool>& active, const std::vector<ErrorModel>& errors) {
  const CellModel model(problem);
  return FindSpread(model, end, active, [&](const RowMatrix& rows) {
    RowMatrix product(rows.rows(), rows.cols());
    Eigen::Index first = 0;
    for (const ErrorModel& block : errors) {
      product.middleRows(first, block.size()) =
          CovarianceTimes(block, RowMatrix(rows.middleRows(first, block.size())));
      first += block.size();
    }
    return product;
  });
}

CellProblem Without(CellProblem problem, int block) {
  problem.blocks.erase(problem.blocks.begin() + block);
  return problem;
}

}  // namespace lyrefit
