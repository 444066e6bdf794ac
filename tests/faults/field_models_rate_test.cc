#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "diagnose/synthetic_data.h"
#include "faults/field_case.h"
#include "lyrefit/diagnose/fit_effect.h"

// Fits of one effect to exact curves from the simulator of modules, whose cells follow other laws
// than those of the effects and differ among each other. A figure is a misfit in % of Isc.
namespace faults::field {
namespace {

const Fault& FaultCalled(const std::string& kind) {
  for (const auto* faults : {&DeviceFaults(), &CellFaults(), &SweepFaults()}) {
    for (const Fault& fault : *faults) {
      if (kind == fault.name) return fault;
    }
  }
  ADD_FAILURE() << kind;
  return DeviceFaults().front();
}

// A curve without noise, departure or rounding.
struct ExactCurve {
  lyrefit::SyntheticData data;
  double isc = 1;
};

ExactCurve CurveWith(const std::string& kind, int seed) {
  Random random(seed);
  const Drawn drawn = DrawModule(Uniformity::kEveryCellItsOwn, &random);
  Rig rig;
  rig.module = drawn.module;
  Truth truth;
  FaultCalled(kind).apply(&random, &rig, &truth);
  const bool up_and_down = rig.tracer.up_and_down;
  rig.tracer = {};
  rig.tracer.up_and_down = up_and_down;
  Lit lit(rig.module);
  const Readings exact = Exact(rig, &lit);
  lyrefit::IvCurve curve;
  curve.name = kind;
  curve.as_is = true;
  curve.conditions.cells_in_series = rig.module.CellsInSeries();
  curve.conditions.cell_temperature_K = drawn.make.kelvin;
  curve.notes.bypass_diodes = static_cast<int>(rig.module.groups.size());
  curve.voltage_V = exact.voltage;
  curve.current_A = exact.current;
  if (up_and_down) {
    curve.sweep = exact.sweep;
    curve.time_s = exact.time;
  }
  ExactCurve made;
  made.isc = ShortCircuit(lit.Whole());
  made.data = lyrefit::OnTheData(lyrefit::SetOf({curve}), 1e-3 * made.isc);
  return made;
}

double Misfit(const ExactCurve& curve, const lyrefit::LawFit& fit) {
  const lyrefit::Readings& readings = curve.data.measurement.readings;
  double sum = 0;
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    sum += std::pow(fit.current[k] - readings.points[k].current, 2);
  }
  return 100 * std::sqrt(sum / static_cast<double>(fit.current.size())) * readings.scale.current_A /
         curve.isc;
}

// Misfits of one diode and of one more effect, over several modules.
struct Misfits {
  std::vector<double> before, after;
  double Middle() const { return after[after.size() / 2]; }
};

Misfits MisfitsOf(const std::string& kind, const char* effect, int modules) {
  Misfits misfits;
  for (int seed = 0; seed < modules; ++seed) {
    const ExactCurve curve = CurveWith(kind, seed);
    const lyrefit::LawFit base = lyrefit::FitBase(curve.data.weighted, lyrefit::Law());
    lyrefit::Score score;
    score.effect = lyrefit::FindEffect(effect);
    const auto& traits = curve.data.measurement.readings.traits;
    if (score.effect->WhyNot(traits)) continue;
    const lyrefit::LawFit fit = lyrefit::FitEffect(curve.data.weighted, base, score);
    misfits.before.push_back(Misfit(curve, base));
    misfits.after.push_back(fit.usable ? Misfit(curve, fit) : misfits.before.back());
  }
  std::sort(misfits.before.begin(), misfits.before.end());
  std::sort(misfits.after.begin(), misfits.after.end());
  return misfits;
}

struct FittedKind {
  const char *kind, *effect;
  int modules;
  int at_before;  // place of the misfit of one diode that is above
  double before;
  double middle;  // the middle misfit of the effect is below
  int at_after;   // -1: the largest
  double after;
};

void PrintTo(const FittedKind& one, std::ostream* out) { *out << one.kind << " " << one.effect; }

constexpr FittedKind kFittedKinds[] = {
    {"covered_edge", "covered_edge", 12, 6, 2, 0.25, 10, 0.6},
    {"open_group", "open_substring", 12, 0, 1, 0.05, -1, 0.1},
    {"dim_cells", "dim_cells", 16, 8, 4, 0.4, 13, 0.8},
    {"graded_shunt", "graded_shunt", 15, 7, 0.6, 0.15, -1, 0.4},
    // Of 24, 48 and 24 cells. Some have a single dim cell, for which a light of all cells is no model.
    {"unlike_groups", "substrings", 16, 8, 4, 1e9, 6, 0.1},
    {"unlike_groups", "covered_edge", 16, 8, 4, 0.1, 14, 0.7},
    // Two chains in parallel are at the same voltage: with a light each they have the curve of one
    // chain under the mean of both, as far as a curve shows.
    {"both_halves", "dim_cells", 16, 8, 4, 0.3, -1, 1e9},
    {"both_halves", "covered_edge", 16, 8, 4, 1e9, 14, 0.5},
    {"bypass_open", "bypass_open", 16, 8, 2, 0.1, 14, 0.5},
    {"falling_hysteresis", "capacitance", 12, 6, 0.5, 0.12, 11,
     0.25},  // 0.3 with times that do not fall
};

class FieldModels : public testing::TestWithParam<FittedKind> {};

TEST_P(FieldModels, FitTheKind) {
  const FittedKind& one = GetParam();
  const Misfits misfits = MisfitsOf(one.kind, one.effect, one.modules);
  const auto last = static_cast<int>(misfits.after.size()) - 1;
  ASSERT_GE(last, std::max(one.at_before, one.at_after));
  EXPECT_GT(misfits.before[one.at_before], one.before);
  EXPECT_LT(misfits.Middle(), one.middle);
  EXPECT_LT(misfits.after[one.at_after < 0 ? last : one.at_after], one.after);
}

INSTANTIATE_TEST_SUITE_P(Field, FieldModels, testing::ValuesIn(kFittedKinds), [](const auto& one) {
  return std::string(one.param.kind) + "_as_" + one.param.effect;
});

}  // namespace
}  // namespace faults::field
