#include "lyrefit/model/model_points.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/random.h"
#include "lyrefit/model/kernel.h"
#include "model/kernels_agree.h"
#include "model/open_circuit.h"
#include "repeats.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

constexpr int kMost = 9;
using Unknowns = Dual<kMost>;

// A device, its parameters and a voltage, drawn from ranges far wider than physical ones.
struct Draw {
  Device device;
  std::vector<double> p;
  double voltage_V = 0;
};

Draw DrawDevice(RandomStream* random) {
  Draw draw;
  Conditions conditions;
  conditions.cells_in_series = 1 + static_cast<int>(random->Index(144));
  conditions.cell_temperature_K = 250 + 100 * random->Uniform();
  draw.device = MakeDevice(static_cast<Model>(1 + random->Index(3)), conditions);
  draw.p.resize(draw.device.size());
  draw.p[kIph] = 20 * random->Uniform();
  draw.p[kRs] = random->Index(20) == 0 ? 0 : 2 * random->Uniform();
  draw.p[kRsh] = LogUniform(random, 0.1, 1e6);
  for (int d = 0; d < DiodeCount(draw.device); ++d) {
    draw.p[SaturationCurrentIndex(d)] = LogUniform(random, 1e-15, 1e-4);
    draw.p[IdealityIndex(d)] = 0.5 + 3.5 * random->Uniform();
  }
  const double voc = OpenCircuit(draw.device, draw.p.data());
  draw.voltage_V = voc * (-2 + 3.2 * random->Uniform());
  return draw;
}

// The current in 113 bits, independently of the library: I - F(V + I Rs) = 0 solved for Vd by
// Newton's method. It always converges, since the function is convex and increasing.
Quad ExactCurrent(const Device& device, const std::vector<Quad>& p, double voltage_V,
                  double start) {
  Quad vd = start;
  Quad current = 0;
  for (int k = 0; k < 200; ++k) {
    Quad f = p[kIph] - vd / p[kRsh];
    Quad slope = -1 / p[kRsh];
    for (int d = 0; d < DiodeCount(device); ++d) {
      const Quad a = p[IdealityIndex(d)] * Quad(device.module_thermal_voltage_V);
      const Quad e = exp(vd / a);
      f -= p[SaturationCurrentIndex(d)] * (e - 1);
      slope -= p[SaturationCurrentIndex(d)] * e / a;
    }
    const Quad step = (vd - Quad(voltage_V) - p[kRs] * f) / (1 - p[kRs] * slope);
    vd -= step;
    current = f - slope * step;
    if (abs(step) < Quad(1e-25) * (abs(vd) + 1)) break;
  }
  return current;
}

std::vector<Quad> ToQuad(const std::vector<double>& p) { return {p.begin(), p.end()}; }

TEST(SolveOperatingPoint, AgreesWithMultiprecisionOverRandomDevices) {
  constexpr int kDraws = Repeats(100000);
  RandomStream random(20240607);
  double worst = 0;
  for (int k = 0; k < kDraws; ++k) {
    const Draw draw = DrawDevice(&random);
    const OperatingPoint point = SolveOperatingPoint(draw.device, draw.p.data(), draw.voltage_V);
    ASSERT_TRUE(std::isfinite(point.current_A)) << "draw " << k;
    const Quad exact =
        ExactCurrent(draw.device, ToQuad(draw.p), draw.voltage_V, point.junction_voltage_V);
    const Quad scale = abs(exact) + Quad(draw.p[kIph]);
    const double error = static_cast<double>(abs(Quad(point.current_A) - exact) / scale);
    ASSERT_LE(error, 1e-12) << "draw " << k << " V = " << draw.voltage_V;
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", std::to_string(worst * 1e15) + "e-15");
}

TEST(SolveCurrents, EveryKernelAgreesWithTheScalarSolverAndWithEachOtherToTheBit) {
  RandomStream random(7);
  for (int k = 0; k < 2000; ++k) {
    const Draw draw = DrawDevice(&random);
    std::vector<double> voltage;
    const int points = 1 + static_cast<int>(random.Index(20));
    for (int i = 0; i < points; ++i) {
      voltage.push_back(draw.voltage_V * (i + 1) / points);
    }
    SCOPED_TRACE(k);
    ASSERT_NO_FATAL_FAILURE(ExpectKernelsAgree(draw.device, draw.p, voltage));
  }
}

TEST(ImplicitFactor, GivesDerivativesThatAgreeWithMultiprecisionDifferences) {
  constexpr int kDraws = Repeats(3000);
  RandomStream random(99);
  for (int k = 0; k < kDraws; ++k) {
    const Draw draw = DrawDevice(&random);
    const OperatingPoint point = SolveOperatingPoint(draw.device, draw.p.data(), draw.voltage_V);
    Unknowns p[kMost];
    for (int i = 0; i < draw.device.size(); ++i) p[i] = Unknowns(draw.p[i], i);
    const Unknowns current = ExplicitCurrent(draw.device, p, draw.voltage_V, point.current_A);
    const double factor = ImplicitFactor(draw.device, draw.p.data(), point);
    for (int i = 0; i < draw.device.size(); ++i) {
      std::vector<Quad> up = ToQuad(draw.p), down = up;
      const Quad step = Quad(1e-11) * (abs(up[i]) + Quad(i == kRs ? 1e-3 : 0));
      if (step == 0) continue;
      up[i] += step;
      down[i] -= step;
      const Quad exact =
          (ExactCurrent(draw.device, up, draw.voltage_V, point.junction_voltage_V) -
           ExactCurrent(draw.device, down, draw.voltage_V, point.junction_voltage_V)) /
          (2 * step);
      // A derivative that changes the current by less than its rounding error is compared on the
      // scale of that error.
      const double floor =
          1e-5 * (std::fabs(point.current_A) + draw.p[kIph]) / (draw.p[i] + (i == kRs ? 1e-3 : 0));
      const double expected = static_cast<double>(exact);
      ASSERT_NEAR(current.v[i] * factor, expected, 1e-9 * (std::fabs(expected) + floor))
          << draw.device.parameters[i].symbol << ", draw " << k;
    }
  }
}

TEST(SolveOperatingPoint, StaysFiniteAtEveryCornerOfAWideBox) {
  Conditions conditions;
  const Device device = MakeDevice(Model::kDoubleDiode, conditions);
  for (const double iph : {0.0, 20.0}) {
    for (const double is : {0.0, 1e-15, 1e-2}) {
      for (const double n : {0.0, 0.5, 10.0}) {
        for (const double rs : {0.0, 1e-9, 100.0}) {
          for (const double rsh : {0.0, 1e-3, 1e15}) {
            for (const double v : {-1e3, -1.0, 0.0, 0.6, 50.0}) {
              const double p[] = {iph, is, n, rs, rsh, is, 2 * n};
              EXPECT_TRUE(std::isfinite(SolveOperatingPoint(device, p, v).current_A))
                  << iph << ' ' << is << ' ' << n << ' ' << rs << ' ' << rsh << ' ' << v;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace lyrefit
