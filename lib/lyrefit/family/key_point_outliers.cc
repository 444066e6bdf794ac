#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/key_point_errors.h"

namespace lyrefit {
namespace {

constexpr double kFarOff = 6;          // of the usual miss of its kind
constexpr double kVisibleOff = 0.015;  // of the value
constexpr double kLawMissesBy = 3;     // of the errors that weigh
constexpr double kLeverage = 0.95;     // a cell of more decides its own fit
constexpr double kUsualMiss = 1.4826;  // median of a normal distribution to its standard deviation

// How far each row is from a fit without it.
struct Misses {
  KeyPointRowsOf rows;
  Eigen::VectorXd part;   // of the value
  Eigen::VectorXd times;  // of the usual one of its kind
};

// None: the errors of these curves are not those of key points alone.
std::optional<Misses> MissesOf(const JointProblem& problem, const JointEnd& end) {
  auto rows = RowsOfKeyPoints(problem, end.point, end.active);
  if (!rows) return std::nullopt;
  const Eigen::MatrixXd basis = RankedBasis(Eigen::MatrixXd(rows->jacobian));
  const auto count = rows->residual.size();
  Misses misses{std::move(*rows), Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  std::array<std::vector<double>, kKeyPointRows> sizes;
  Eigen::VectorXd scaled = Eigen::VectorXd::Zero(count);
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    for (int r = misses.rows.first[c]; r < misses.rows.first[c + 1]; ++r) {
      const int kind = misses.rows.kind[r];
      const double leverage = basis.row(r).squaredNorm();
      if (!(leverage < kLeverage)) continue;
      scaled[r] = misses.rows.residual[r] / std::sqrt(1 - leverage);
      misses.part[r] = misses.rows.residual[r] / (1 - leverage) / problem.key_point_scale_A *
                       problem.curves[c].key_points->error[kind];
      sizes[kind].push_back(std::fabs(scaled[r]));
    }
  }
  std::vector<double> all;
  for (const auto& kind : sizes) all.insert(all.end(), kind.begin(), kind.end());
  if (all.empty()) return std::nullopt;
  constexpr double kLeastOfAll = 0.5;  // a kind of few rows may be matched by chance
  const double least = kLeastOfAll * UpperMedian(all);
  for (Eigen::Index r = 0; r < count; ++r) {
    const auto& own = sizes[misses.rows.kind[r]];
    const double usual = kUsualMiss * std::max(own.empty() ? 0 : UpperMedian(own), least);
    if (usual > 0) misses.times[r] = std::fabs(scaled[r]) / usual;
  }
  return misses;
}

bool IsWrong(const Misses& misses, int r) {
  return misses.times[r] > kFarOff && std::fabs(misses.part[r]) > kVisibleOff;
}

// Whether another condition of the same light is missed to the same side: the law does so, not one
// value.
bool IsOfItsLight(const JointProblem& problem, const Misses& misses, int row) {
  constexpr double kAlike = 1.0 / 3, kSameLight = 0.04;
  const auto curve_of = [&](int r) {
    const auto& first = misses.rows.first;
    return std::upper_bound(first.begin(), first.end(), r) - first.begin() - 1;
  };
  const auto light_of = [&](int r) { return problem.curves[curve_of(r)].irradiance_W_m2; };
  for (int r = 0; r < static_cast<int>(misses.part.size()); ++r) {
    if (r == row || misses.rows.kind[r] != misses.rows.kind[row]) continue;
    if (std::fabs(light_of(r) / light_of(row) - 1) > kSameLight) continue;
    if (misses.part[r] / misses.part[row] > kAlike) return true;
  }
  return false;
}

// The row farthest off of those that look wrong; -1: none does.
int WorstOf(const JointProblem& problem, const Misses& misses) {
  int worst = -1;
  for (int r = 0; r < static_cast<int>(misses.times.size()); ++r) {
    if (!IsWrong(misses, r) || IsOfItsLight(problem, misses, r)) continue;
    if (worst < 0 || misses.times[r] > misses.times[worst]) worst = r;
  }
  return worst;
}

// The cell of a row. A wrong Vmp spoils Pmp = Imp Vmp, too; else Pmp is wrong by Imp.
WrongCell CellOf(const Misses& misses, int row) {
  const auto next = std::upper_bound(misses.rows.first.begin(), misses.rows.first.end(), row);
  WrongCell cell;
  cell.curve = static_cast<int>(next - misses.rows.first.begin()) - 1;
  cell.point = static_cast<KeyPointRow>(misses.rows.kind[row]);
  for (int r = *(next - 1); r < *next; ++r) {
    if (misses.rows.kind[r] != kVmpRow || cell.point != kPmpRow) continue;
    if (IsWrong(misses, r) && misses.part[r] * misses.part[row] > 0) cell.point = kVmpRow;
  }
  return cell;
}

// Takes the cell's residuals out of the problem.
void LeaveOutCell(const WrongCell& cell, JointProblem* problem) {
  KeyPointValues& value = problem->curves[cell.curve].key_points->value;
  value[cell.point] = kUnknown;
  if (cell.point == kVmpRow) value[kPmpRow] = kUnknown;
}

// The cell with its values, if the fit without it misses it visibly.
std::optional<WrongCell> Confirmed(WrongCell cell, const JointProblem& problem,
                                   const JointEnd& end) {
  const KeyPointValues& value = problem.curves[cell.curve].key_points->value;
  const std::vector<double> device = DeviceAt(problem, end.point, cell.curve);
  const KeyPointValues model =
      KeyPointsNear(DeviceOf(problem, cell.curve), device.data(), value, nullptr);
  const bool current = cell.point == kPmpRow && std::isfinite(value[kVmpRow]);
  cell.measured = current ? value[kPmpRow] / value[kVmpRow] : value[cell.point];
  cell.expected = current ? model[kPmpRow] / model[kVmpRow] : model[cell.point];
  if (!(std::fabs(cell.measured / cell.expected - 1) > kVisibleOff)) return std::nullopt;
  return cell;
}

}  // namespace

WithoutWrongCells FindWrongCells(const JointProblem& problem, const JointEnd& end,
                                 int free_parameters, const StopToken& stop) {
  constexpr std::size_t kFewest = 4, kCurvesOfOne = 10;
  const std::size_t most = (problem.curves.size() + kCurvesOfOne - 1) / kCurvesOfOne;
  WithoutWrongCells without{{}, problem, end};
  if (problem.curves.size() < kFewest) return without;
  while (without.cells.size() < most && !stop.Stopped()) {
    const std::optional<Misses> misses = MissesOf(without.rest, without.end);
    const int worst = misses ? WorstOf(without.rest, *misses) : -1;
    if (worst < 0) break;
    JointProblem rest = without.rest;
    const WrongCell cell = CellOf(*misses, worst);
    LeaveOutCell(cell, &rest);
    JointOptions how;
    how.stop = stop;
    const JointEnd refit = RefineJointly(rest, without.end.point, how);
    const auto confirmed = Confirmed(cell, without.rest, refit);
    if (!confirmed) break;
    without.cells.push_back(*confirmed);
    without.rest = std::move(rest);
    without.end = refit;
  }
  // A law that misses the others as well says nothing of one value.
  const double spare = JointDegrees(without.rest, free_parameters, 0);
  const double scale = std::sqrt(without.end.squares / spare) / problem.key_point_scale_A;
  if (scale > kLawMissesBy) without = {{}, problem, end};
  return without;
}

}  // namespace lyrefit
