#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// What is known of the optimum of a made problem without any search.
enum class Planted {
  kNothing,       // random errors on a random device: only that the device's own RMSE is attained
  kMeasuredAtRs,  // the measured-current optimum over all mixtures, Rs being fixed: it is convex
  kMeasured,      // the same, and stationary in Rs, which is free
  kSolved,        // stationary in everything for the solved current, and no diode of any n helps
};

template <>
struct EnumTable<Planted> {
  static constexpr EnumText<Planted> kRows[] = {
      {Planted::kNothing, "random errors"},
      {Planted::kMeasuredAtRs, "measured-current, Rs fixed"},
      {Planted::kMeasured, "measured-current, Rs free"},
      {Planted::kSolved, "solved-current"}};
};

// A made problem for a proof.
struct MadeProblem {
  IvCurve curve;
  CertifyOptions ranges;  // of n, of Rs where that is fixed, of all else in a third of the problems
  Planted planted = Planted::kNothing;
  Model model = Model::kSingleDiode;  // of the device
  std::vector<double> parameters;     // of the device, within the ranges: the planted optimum
  double noise = 0;                   // root mean square of the residuals there, over Isc
};

// A random cell or module of one to three diodes with 8 to 60 points, in every tenth problem 100 to
// 300; residuals from 1e-6 to 3e-2 of Isc; n in [1, 2] or [0.5, 4]. The residuals of a planted optimum
// are random but for the conditions of an optimum: orthogonal to the columns of light, leak and the
// diodes and to what moves their n and Rs, and with no column of a diode of any n in the range along
// them. The measured points follow from them in closed form. Two fifths are planted for the solved
// current, a fifth each is of the other kinds; the rare draw to which no such residuals are found has
// random errors. A third of the problems have ranges of Iph, Is and Rsh too.
MadeProblem MakeProblem(std::uint64_t seed, int number);

// The same with Rs from 0 to 0.9 to 1.7 times the largest voltage over the largest current. Every third
// curve ends before its open circuit, so that the order of its points says little of large Rs.
MadeProblem MakeWideProblem(std::uint64_t seed, int number);

}  // namespace lyrefit
