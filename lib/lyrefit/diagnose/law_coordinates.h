#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"
#include "lyrefit/estimate/refine/least_squares.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Whether fits keep a parameter fixed.
bool IsFixed(const Readings& readings, const Law& law, int parameter);

// Coordinates in which a law is fitted, one for each parameter and at its position. They are of
// order 1, and none depends strongly on another:
//   Iph      in current scales
//   Is1      ln of the first diode's current at the pivot voltage, in current scales; in contrast
//            to ln Is1, almost uncorrelated with n1
//   Rs, Rsh  resistance and conductance, in units of ReadingScale::resistance_ohm; 0: no shunt
//   Is2      the second diode's current at the pivot voltage, in current scales
//   alpha    relative to Iph, 1/K
// n1, n2, EgRef and the parameters of effects are their own coordinates.
class LawCoordinates {
 public:
  // References to `law` and `readings` are kept.
  LawCoordinates(const Law& law, const Readings& readings);

  // Of all parameters or of those of the base, and back.
  std::vector<double> Of(const std::vector<double>& p) const;
  std::vector<double> Parameters(const std::vector<double>& theta) const;

  // Bounds and fixed coordinates of a fit to the readings, without its evaluation.
  LeastSquaresProblem Problem() const;

  // EvaluateLaw with derivatives by the coordinates.
  bool Evaluate(const double* theta, LawWorkspace* workspace, double* current, double* jacobian,
                const std::vector<char>* fixed = nullptr) const;

  // Derivatives of the parameters by the coordinates. Infinite for Rsh without a shunt.
  Eigen::MatrixXd Slopes(const std::vector<double>& theta) const;

 private:
  // Sets the parameters of the base that are not their own coordinates.
  void SetParameters(const double* theta, double* p) const;
  template <class Add>
  void ForSlopes(const double* theta, const double* p, Add add) const;

  const Law& law_;
  const Readings& readings_;
  bool second_;
  double ampere_;
  double ohm_;
  double pivot_;     // pivot voltage in thermal voltages
  double second_A_;  // saturation current of a second diode that carries one scale there
};

// The law of model/translation.h that is fitted before any cause: De Soto's, as in `fit --family`.
// If the temperatures differ, alpha and EgRef are free parameters unless stated. A stated band gap
// slope is used unchanged: without it, errors of temperature and voltage would be harder to detect.
Law StartingLaw(const Readings& readings, Model model);

// Selects the variant of `law` that fits the readings better. Several irradiances select Rsh
// constant or in inverse proportion to light. Several temperatures, with a stated band gap and no
// stated slope, select De Soto's slope or none. Rsh in inverse proportion is selected only if a
// constant shunt beside it gains nothing. A shunt that merely grows with light is left to be found
// as a cause.
Law ChooseLaw(const WeightedData& weighted, const Law& law);

// Assumptions of a base law, as text.
std::string DescribeLaw(const Readings& readings, const Law& law);

}  // namespace lyrefit
