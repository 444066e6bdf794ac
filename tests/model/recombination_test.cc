#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/random.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "model/kernels_agree.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;
constexpr int kMostUnknowns = 9;
using Unknowns = Dual<kMostUnknowns>;

// A device with the recombination loss of PVsyst: d2mutau 0 to 2 V, NsVbi 0.9 V per cell.
struct LossyDraw {
  Device plain;
  Device device;
  std::vector<double> p;
  double pole_V = 0;
};

LossyDraw DrawLossyDevice(RandomStream* random) {
  LossyDraw draw;
  Conditions conditions;
  conditions.cells_in_series = 1 + static_cast<int>(random->Index(144));
  conditions.cell_temperature_K = 260 + 90 * random->Uniform();
  draw.plain = MakeDevice(static_cast<Model>(1 + random->Index(3)), conditions);
  draw.device = draw.plain;
  AddRecombination(&draw.device);
  draw.p.resize(draw.device.size());
  draw.p[kIph] = 10 * random->Uniform();
  draw.p[kRs] = random->Index(20) == 0 ? 0 : 2 * random->Uniform();
  draw.p[kRsh] = std::pow(10, 6 * random->Uniform());
  for (int d = 0; d < DiodeCount(draw.device); ++d) {
    draw.p[SaturationCurrentIndex(d)] = std::pow(10, -14 + 9 * random->Uniform());
    draw.p[IdealityIndex(d)] = 0.8 + 1.4 * random->Uniform();
  }
  draw.pole_V = 0.9 * conditions.cells_in_series;
  draw.p[draw.plain.size()] = random->Index(10) == 0 ? 0 : 2 * random->Uniform();
  draw.p[draw.plain.size() + 1] = draw.pole_V;
  return draw;
}

// F(Vd) in 113 bits, independently of the library, for vd below the pole.
Quad ExactRightHandSide(const LossyDraw& draw, const Quad& vd) {
  const auto p = [&](int i) { return Quad(draw.p[i]); };
  const int last = draw.device.size();
  Quad f = p(kIph) - vd / p(kRsh) - p(kIph) * p(last - 2) / (p(last - 1) - vd);
  for (int d = 0; d < DiodeCount(draw.device); ++d) {
    const Quad a = p(IdealityIndex(d)) * Quad(draw.device.module_thermal_voltage_V);
    f -= p(SaturationCurrentIndex(d)) * (exp(vd / a) - 1);
  }
  return f;
}

// The current by bisection on the junction voltage, which needs only a unique root. `start`: a
// guess of the junction voltage.
Quad ExactCurrent(const LossyDraw& draw, double voltage_V, double start) {
  const auto g = [&](const Quad& vd) {
    return vd - Quad(voltage_V) - Quad(draw.p[kRs]) * ExactRightHandSide(draw, vd);
  };
  const Quad pole = Quad(draw.pole_V) * Quad(1 - 1e-3);
  Quad width = Quad(1e-12) * (1 + std::fabs(start));
  Quad low = start - width, high = std::min(Quad(start + width), pole);
  while (g(low) > 0) low -= width *= 2;
  while (g(high) < 0 && high < pole) high = std::min(Quad(high + (width *= 2)), pole);
  for (int k = 0; k < 130 && high - low > Quad(1e-28) * (1 + abs(high)); ++k) {
    const Quad middle = (low + high) / 2;
    (g(middle) > 0 ? high : low) = middle;
  }
  return ExactRightHandSide(draw, (low + high) / 2);
}

TEST(Recombination, TheSolverAgreesWithBisectionIn113BitsOverRandomDevices) {
  RandomStream random(51);
  int compared = 0;
  for (int k = 0; k < Repeats(4000); ++k) {
    const LossyDraw draw = DrawLossyDevice(&random);
    const double v = draw.pole_V * (-1 + 1.9 * random.Uniform());
    const OperatingPoint point = SolveOperatingPoint(draw.device, draw.p.data(), v);
    ASSERT_TRUE(std::isfinite(point.current_A)) << "draw " << k;
    ASSERT_LE(point.conductance_S, 0) << "draw " << k;
    if (point.junction_voltage_V > (1 - 2e-3) * draw.pole_V) continue;
    const Quad exact = ExactCurrent(draw, v, point.junction_voltage_V);
    const Quad scale = abs(exact) + Quad(draw.p[kIph]);
    ASSERT_LE(static_cast<double>(abs(Quad(point.current_A) - exact) / scale), 1e-12)
        << "draw " << k << " V = " << v;
    ++compared;
  }
  EXPECT_GT(compared, Repeats(3500));
}

TEST(Recombination, KernelsAgreeToTheBitAndWithTheScalarSolver) {
  RandomStream random(52);
  for (int k = 0; k < Repeats(1000); ++k) {
    const LossyDraw draw = DrawLossyDevice(&random);
    std::vector<double> v, i;
    for (int j = 0; j < 19; ++j) {
      v.push_back(draw.pole_V * (-0.2 + 0.06 * j));
      i.push_back(10 * random.Uniform());
    }
    SCOPED_TRACE(k);
    ASSERT_NO_FATAL_FAILURE(ExpectKernelsAgree(draw.device, draw.p, v));
    const PointSet points = MakePointSet(v, i);
    const Kernel& portable = AvailableKernels()[0];
    for (const Kernel& kernel : AvailableKernels()) {
      for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
        ASSERT_EQ(MeanSquare(draw.device, objective, draw.p.data(), points, kernel),
                  MeanSquare(draw.device, objective, draw.p.data(), points, portable))
            << kernel.name;
      }
    }
  }
}

TEST(Recombination, TheCurveFallsAndStaysFiniteFarBeyondThePole) {
  RandomStream random(53);
  for (int k = 0; k < 500; ++k) {
    const LossyDraw draw = DrawLossyDevice(&random);
    double before = std::numeric_limits<double>::infinity();
    for (double x = -2; x < 4; x += 0.05) {
      const double v = x * draw.pole_V;
      const double current = SolveOperatingPoint(draw.device, draw.p.data(), v).current_A;
      ASSERT_TRUE(std::isfinite(current)) << "draw " << k << " V = " << v;
      ASSERT_TRUE(std::isfinite(ExplicitCurrent(draw.device, draw.p.data(), v, 1.0)));
      ASSERT_LE(current, before + 1e-12 * (std::fabs(current) + draw.p[kIph])) << "draw " << k;
      before = current;
    }
  }
}

TEST(Recombination, WithoutAStrengthGivesTheOldDeviceToTheBit) {
  RandomStream random(54);
  for (int k = 0; k < 500; ++k) {
    LossyDraw draw = DrawLossyDevice(&random);
    draw.p[draw.plain.size()] = 0;
    const double v = 0.8 * draw.pole_V * random.Uniform();
    EXPECT_EQ(SolveOperatingPoint(draw.device, draw.p.data(), v).current_A,
              SolveOperatingPoint(draw.plain, draw.p.data(), v).current_A);
    EXPECT_EQ(ModelKeyPoints(draw.device, draw.p.data()).max_power_W,
              ModelKeyPoints(draw.plain, draw.p.data()).max_power_W);
  }
}

TEST(Recombination, DerivativesAgreeWithDifferences) {
  RandomStream random(55);
  Conditions conditions;
  conditions.cells_in_series = 38;
  Device device = MakeDevice(Model::kSingleDiode, conditions);
  AddRecombination(&device);
  const std::vector<double> p = {1.2, 2e-10, 1.4, 3.1, 900, 1.1, 34.2};
  for (const double vd : {-3.0, 0.0, 20.0, 33.0, 34.19, 40.0}) {
    Unknowns jets[kMostUnknowns];
    for (int i = 0; i < device.size(); ++i) jets[i] = Unknowns(p[i], i);
    const Unknowns current = JunctionCurrent(device, jets, Unknowns(vd));
    for (int i = 0; i < device.size(); ++i) {
      std::vector<double> up = p, down = p;
      const double h = 1e-6 * p[i];
      up[i] += h;
      down[i] -= h;
      const double slope =
          (JunctionCurrent(device, up.data(), vd) - JunctionCurrent(device, down.data(), vd)) /
          (up[i] - down[i]);
      EXPECT_NEAR(current.v[i], slope, 1e-4 * std::fabs(slope) + 1e-7 / p[i] + 1e-5)
          << device.parameters[i].symbol << " at " << vd;
    }
  }
}

TEST(AddRecombination, AppendsItsParametersAndLeavesTheDiodesCounted) {
  Device device = MakeDevice(Model::kDoubleDiode, {});
  AddRecombination(&device);
  EXPECT_EQ(device.Find("d2mutau"), 7);
  EXPECT_EQ(device.Find("NsVbi"), 8);
  EXPECT_EQ(DiodeCount(device), 2);
  const double p[] = {1, 1e-9, 1.2, 0, 1e12, 1e-9, 1.5, 0.1, 0.9};
  const double bare[] = {1, 1e-9, 1.2, 0, 1e12, 1e-9, 1.5, 0, 0.9};
  EXPECT_NEAR(JunctionCurrent(device, p, 0.4) - JunctionCurrent(device, bare, 0.4), -0.1 / 0.5,
              1e-14);
}

}  // namespace
}  // namespace lyrefit
