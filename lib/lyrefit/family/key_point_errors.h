#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/joint.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {

// Errors of measured key points. Beside an error of its own each key point has two that conditions
// share: a chamber misses a set temperature, a lamp a level of light,
//
//   C = sum over kinds k of s_k^2 D_k + s_T^2 Z_T Z_T' + s_G^2 Z_G Z_G'
//
// D_k marks the rows of one kind (Isc, Voc, Vmp, Pmp); those of Isc and Pmp may grow towards low light
// by another power than they are weighed with. Z has a column for each level: derivatives of
// its residuals by the temperature or by ln(light). The sizes s are found from the residuals by
// restricted likelihood (Patterson and Thompson 1971, doi:10.1093/biomet/58.3.545). A few levels
// hardly determine s_T and s_G, so intervals average over both, with half-Cauchy priors of 0.3 K and
// 0.2 % (Gelman 2006, doi:10.1214/06-BA117A).

// Positions of the errors of kinds (KeyPointRow), then of those that conditions share.
constexpr int kTemperatureError = kKeyPointRows, kLightError = kKeyPointRows + 1;
constexpr int kErrorParts = kKeyPointRows + 2;
// Residuals of key points of all curves of a problem at a point, without rows of priors.
struct KeyPointRowsOf {
  std::vector<int> first;  // first row of each curve, then the number of rows
  std::vector<int> kind;   // of each row, a KeyPointRow
  Eigen::VectorXd residual;
  Eigen::VectorXd log_light;          // of 1000 W/m2
  RowMatrix jacobian;                 // rows x free coordinates; 0 for curves that are not fitted
  RowMatrix influence;                // shared parameters x rows: their change by errors of rows
  std::array<RowMatrix, 2> by_level;  // rows x levels, of temperature (per K) and of ln(light)
};

// `fitted`: of each curve; empty: all. None: the curves have unknown conditions of their own.
std::optional<KeyPointRowsOf> RowsOfKeyPoints(const JointProblem& problem, const JointPoint& point,
                                              const std::vector<bool>& active,
                                              const std::vector<bool>& fitted = {});

class RestrictedLikelihood;  // key_point_errors.cc

// What the residuals of the fitted rows say of the sizes, in the unit of the residuals, K and parts.
class KeyPointErrorSizes {
 public:
  // `noise`: standard deviation of the residuals. `stated`: shared errors that are known.
  KeyPointErrorSizes(const KeyPointRowsOf& rows, double noise, const KeyPointErrors& stated);

  // Half of the 95 % interval of the sum of `weight` times error over rows, those that were found from
  // or further ones of the same problem.
  double HalfWidth95(const KeyPointRowsOf& rows, const Eigen::VectorXd& weight) const;
  // Posterior mean of an error's size. NaN: an error common to all rows, which shows in none.
  double Size(int part) const;

 private:
  // Sizes of the shared errors with their posterior. `known`: as stated; NaN: sought.
  void FillGrid(const RestrictedLikelihood& likelihood, const std::array<double, 2>& known);

  struct GridPoint {
    double weight;
    std::array<double, 2> size;  // of the shared errors
  };
  std::array<double, kKeyPointRows> kinds_ = {};
  std::array<double, kKeyPointRows> degrees_ = {};  // of freedom of `kinds_`
  std::array<bool, 2> seen_ = {};
  double power_ = 0;  // of light, by which the errors of Isc and Pmp depart from their weights
  std::vector<GridPoint> grid_;
};

// The estimated sizes as `errors` has them, in the units of the options.
KeyPointErrors FoundErrorsOf(const KeyPointErrorSizes& sizes, KeyPointErrors errors,
                             double key_point_scale_A);

// A value of key points that the others contradict.
struct WrongCell {
  int curve = 0;                      // position in the problem
  KeyPointRow point = kIscRow;        // kPmpRow: the current at maximum power
  double measured = 0, expected = 0;  // A or V; expected by a fit without it
};

// The fit without the wrong cells. A cell is wrong if a fit without it misses it by far more than
// its kind is missed elsewhere and by a visible part, and misses no other of its light alike. At most
// a tenth of the curves have one; none has where the law misses the others as well.
struct WithoutWrongCells {
  std::vector<WrongCell> cells;
  JointProblem rest;
  JointEnd end;
};
WithoutWrongCells FindWrongCells(const JointProblem& problem, const JointEnd& end,
                                 int free_parameters, const StopToken& stop = {});

}  // namespace lyrefit
