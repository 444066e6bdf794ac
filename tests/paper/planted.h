#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Property of the optimum of a synthetic problem that is known without a search.
enum class Planted {
  kNothing,       // random errors on a random device: the RMSE of the device is an upper bound of
                  // the optimum
  kMeasuredAtRs,  // measured-current optimum over all mixtures at fixed Rs, a convex problem
  kMeasured,      // measured-current, optimal at fixed Rs and stationary in Rs, which is free
  kSolved,        // solved-current, stationary in all parameters; an additional diode of any n
                  // gives no descent
};

template <>
struct EnumTable<Planted> {
  static constexpr EnumText<Planted> kRows[] = {
      {Planted::kNothing, "random errors"},
      {Planted::kMeasuredAtRs, "measured-current, Rs fixed"},
      {Planted::kMeasured, "measured-current, Rs free"},
      {Planted::kSolved, "solved-current"}};
};

// A synthetic problem for the test of certificates.
struct SyntheticProblem {
  IvCurve curve;
  CertifyOptions ranges;  // of n; of Rs if fixed; of all other parameters in a third of the
                          // problems
  Planted planted = Planted::kNothing;
  Model model = Model::kSingleDiode;  // of the device
  std::vector<double> parameters;     // of the device, within `ranges`; the planted optimum if
                                      // there is one
  double noise = 0;                   // root mean square of the residuals at `parameters`, over Isc
};

// A random cell or module with one to three diodes and 8 to 60 points (100 to 300 in every tenth
// problem). Residuals are 1e-6 to 3e-2 of Isc; n is in [1, 2] or [0.5, 4].
// The residuals of a planted optimum are random except for the optimality conditions. They are
// orthogonal to the columns of photocurrent, shunt and diodes and to the derivatives by n and Rs.
// No column of a diode with n in the range has a positive product with them. The measured points
// follow from the residuals in closed form.
// Two fifths of the problems are planted for the solved current and a fifth for each other type. If
// no such residuals are found, which is rare, the errors are random. A third of the problems have
// ranges of Iph, Is and Rsh as well.
SyntheticProblem MakeProblem(std::uint64_t seed, int number);

// A problem of MakeProblem with a wide range of Rs. Its upper end is 0.9 to 1.7 times the largest
// voltage over the largest current; the lower end is 0. Every third curve is cut before open
// circuit, so that the order of its points gives little information on large Rs.
SyntheticProblem MakeWideProblem(std::uint64_t seed, int number);

}  // namespace lyrefit
