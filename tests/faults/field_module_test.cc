#include "faults/field_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "faults/field_case.h"
#include "faults/field_misfit.h"
#include "faults/field_tracer.h"

namespace faults::field {
namespace {

constexpr double kThermal = 1.380649e-23 / 1.602176634e-19 * 298.15;

Cell Plain() {
  Cell cell;
  cell.photocurrent = 8;
  cell.diffusion_A = 2e-10;
  cell.series_ohm = 0.004;
  cell.shunt_S = 0.01;
  return cell;
}

Module Equal(const Cell& cell, int groups, int cells, int chains = 1) {
  Module module;
  module.groups.resize(groups);
  for (Group& group : module.groups) group.chains.assign(chains, std::vector<Cell>(cells, cell));
  return module;
}

void Dim(double light, std::vector<Cell>* chain) {
  for (Cell& cell : *chain) cell.photocurrent *= light;
}

double DropOf(const BypassDiode& diode, double current) {
  return diode.scale_V * std::log1p(current / diode.saturation_A) + diode.series_ohm * current;
}

// Root by bisection only, the reference for the interpolated curves.
template <class F>
double Halved(const F& falling, double low, double high) {
  for (int i = 0; i < 90; ++i) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double SlowChainCurrent(const std::vector<Cell>& chain, double voltage, double largest) {
  const auto beyond = [&](double current) {
    double sum = 0;
    for (const Cell& cell : chain) sum += AtCurrent(cell, current).voltage;
    return sum - voltage;
  };
  return Halved(beyond, -1.5 * largest, 1.1 * largest);
}

double SlowGroupVoltage(const Group& group, double current, double largest) {
  const auto beyond = [&](double voltage) {
    double sum = -current;
    for (const auto& chain : group.chains) sum += SlowChainCurrent(chain, voltage, largest);
    if (group.bypass == Bypass::kWorks) {
      const double blocked = -group.diode.saturation_A * (1 - 1e-9);
      sum += Halved([&](double i) { return -voltage - DropOf(group.diode, i); }, blocked, 100);
    }
    return sum;
  };
  return Halved(beyond, -40, 40);
}

TEST(FieldCell, GoesThereAndBackInEveryReverseLaw) {
  for (const Reverse law :
       {Reverse::kShuntBreakdown, Reverse::kSoftPower, Reverse::kMultiplication}) {
    Cell cell = Plain();
    cell.recombination_A = 1e-5;
    cell.reverse = law;
    for (const double current : {-9.0, 0.0, 5.0, 7.99, 8.0, 8.01, 9.0, 30.0}) {
      const Point at = AtCurrent(cell, current);
      const double junction = at.voltage + current * cell.series_ohm;
      EXPECT_NEAR(AtJunctionVoltage(cell, junction).current, current, 1e-9);
      const double up = AtCurrent(cell, current + 1e-6).voltage;
      const double down = AtCurrent(cell, current - 1e-6).voltage;
      if (current == 8) continue;  // the slope is discontinuous
      EXPECT_NEAR((up - down) / 2e-6 / at.slope, 1, 1e-4) << current;
    }
    EXPECT_LT(AtCurrent(cell, 8.5).voltage, -1);
  }
}

TEST(FieldModule, OfEqualCellsHasTheClosedForm) {
  Cell cell = Plain();
  cell.series_ohm = 0;
  cell.shunt_S = 1e-12;
  for (const int chains : {1, 2}) {
    const Sampled curve = CurveOf(Equal(cell, 3, 20, chains));
    const double leak = BypassDiode().saturation_A;
    for (double current = -1; current < 7.99; current += 0.37) {
      const double voltage =
          60 * kThermal * std::log1p((cell.photocurrent - current) / cell.diffusion_A);
      EXPECT_NEAR(curve.CurrentAt(voltage), chains * current - leak, 8e-6) << current;
    }
  }
}

TEST(FieldModule, ShadedGroupHasItsPlateauAndItsStepWhereItsDiodeTurns) {
  const Cell cell = Plain();
  Module module = Equal(cell, 3, 20);
  Dim(0.6, &module.groups[1].chains[0]);
  const Sampled curve = CurveOf(module);
  const double open = OpenCircuit(curve);
  EXPECT_NEAR(curve.CurrentAt(0.75 * open), 0.6 * 8, 0.02 * 8);
  // At 0.8 of the light the bypass diode carries the rest; the dim cells carry theirs at -drop / 20
  // V each.
  double carried = 0.2 * 8;
  double drop = DropOf(module.groups[1].diode, carried);
  carried -= cell.shunt_S * drop / 20;
  drop = DropOf(module.groups[1].diode, carried);
  const double step = 40 * AtCurrent(cell, 0.8 * 8).voltage - drop;
  EXPECT_NEAR(curve.VoltageAt(0.8 * 8), step, 1e-3);
  EXPECT_NEAR(step / open, 2.0 / 3, 0.08);
}

TEST(FieldModule, ShortedGroupTakesItsShareOfTheVoltage) {
  Module module = Equal(Plain(), 3, 20);
  const double whole = OpenCircuit(CurveOf(module));
  module.groups[0].bypass = Bypass::kShorted;
  EXPECT_NEAR(OpenCircuit(CurveOf(module)), whole * 2 / 3, 0.003 * 8.1);
}

TEST(FieldModule, OpenDiodeLeavesTheStringToItsWeakestCell) {
  Cell cell = Plain();
  cell.shunt_S = 1e-4;
  Module module = Equal(cell, 3, 20);
  Cell& weak = module.groups[0].chains[0][3];
  weak.photocurrent *= 0.5;
  weak.reverse_V = 60;  // far beyond the voltage that 59 cells can apply
  const double bypassed = ShortCircuit(CurveOf(module));
  module.groups[0].bypass = Bypass::kOpen;
  const double limited = ShortCircuit(CurveOf(module));
  EXPECT_NEAR(bypassed, 8, 0.01);
  EXPECT_NEAR(limited, 4, 0.05);
  EXPECT_GT(limited, 4);
}

TEST(FieldModule, IsWhatHalvingFinds) {
  for (int seed = 0; seed < 4; ++seed) {
    Random random(seed);
    Module module = DrawModule(Uniformity::kEveryCellItsOwn, &random).module;
    for (Group& group : module.groups) {
      for (auto& chain : group.chains) chain.resize(6);
    }
    module.groups[0].chains[0][2].photocurrent *= random.Uniform(0.2, 0.9);
    Dim(random.Uniform(0.2, 0.9), &module.groups[1].chains[0]);
    const double largest = module.LargestPhotocurrent();
    const Sampled curve = CurveOf(module);
    for (const double part : {-0.1, 0.3, 0.7, 0.97, 0.998}) {
      const double current = part * ShortCircuit(curve);
      double voltage = 0;
      for (const Group& group : module.groups) {
        voltage += SlowGroupVoltage(group, current, largest);
      }
      EXPECT_NEAR(curve.CurrentAt(voltage), current, 1e-6 * largest) << seed << " " << part;
    }
  }
}

TEST(FieldModule, CurrentFallsAndNoMoreComesOutThanItsCellsCanGive) {
  for (const Fault& fault : DeviceFaults()) {
    Random random(11);
    Rig rig;
    rig.module = DrawModule(Uniformity::kEveryCellItsOwn, &random).module;
    Truth truth;
    fault.apply(&random, &rig, &truth);
    double available = 0;
    for (const Group& group : rig.module.groups) {
      for (const auto& chain : group.chains) {
        for (const Cell& cell : chain) {
          double best = 0;
          for (double part = 0; part < 1; part += 0.002) {
            const Point at = AtCurrent(cell, part * cell.photocurrent);
            best = std::max(best, at.current * at.voltage);
          }
          available += best;
        }
      }
    }
    const Sampled curve = CurveOf(rig.module);
    const double open = OpenCircuit(curve);
    double before = curve.CurrentAt(-0.01 * open), most = 0;
    for (double u = -0.005; u < 1.03; u += 0.0025) {
      const double current = curve.CurrentAt(u * open);
      EXPECT_LT(current, before) << fault.name << " " << u;
      before = current;
      most = std::max(most, current * u * open);
    }
    EXPECT_LT(most, 1.0001 * available) << fault.name;
    EXPECT_GT(most, 0.1 * available) << fault.name;
  }
}

TEST(FieldLit, LadderOfLightsIsTheModuleUnderEach) {
  Random random(5);
  Module module = DrawModule(Uniformity::kEveryCellItsOwn, &random).module;
  Dim(0.7, &module.groups[0].chains[0]);
  Lit lit(module);
  for (const double light : {0.903, 0.998, 1.0037, 1.21}) {
    const Sampled curve = CurveOf(module, light);
    const double open = OpenCircuit(curve);
    for (double u = 0; u < 1.02; u += 0.02) {
      EXPECT_NEAR(lit.Current(u * open, light), curve.CurrentAt(u * open),
                  2e-5 * module.LargestPhotocurrent())
          << light << " " << u;
    }
  }
}

TEST(FieldMisfit, VanishesOnOneDiodeAndNotOnAShadedModule) {
  Module module = Equal(Plain(), 3, 20);
  const auto misfit = [&] {
    const Sampled curve = CurveOf(module);
    std::vector<double> voltage, current;
    for (int i = 0; i <= 100; ++i) {
      voltage.push_back(OpenCircuit(curve) * 1.01 * i / 100);
      current.push_back(curve.CurrentAt(voltage.back()));
    }
    return BestOneDiode(voltage, current);
  };
  const OneDiodeFit plain = misfit();
  EXPECT_LT(plain.rms, 1e-5 * 8);
  EXPECT_NEAR(plain.diode.scale_V, 60 * kThermal, 1e-3);
  EXPECT_NEAR(plain.diode.series_ohm, 60 * 0.004, 1e-3);
  Dim(0.8, &module.groups[0].chains[0]);
  EXPECT_GT(misfit().rms, 0.01 * 8);
}

}  // namespace
}  // namespace faults::field
