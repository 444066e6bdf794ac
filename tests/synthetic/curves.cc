#include "synthetic/curves.h"

#include <cmath>
#include <utility>

#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

// Where a function that rises with its argument passes 0, by halving.
template <class F>
double RisingRoot(double low, double high, const F& f) {
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (f(middle) >= 0 ? high : low) = middle;
  }
  return low;
}

}  // namespace

std::vector<double> EvenVoltages(double from_V, double to_V, int points) {
  std::vector<double> voltage_V;
  for (int k = 0; k < points; ++k) {
    voltage_V.push_back(from_V + (to_V - from_V) * k / (points - 1));
  }
  return voltage_V;
}

void AddNoise(double noise_A, RandomStream* random, IvCurve* curve) {
  for (double& current : curve->current_A) current += noise_A * random->Normal();
}

IvCurve UpTo(double last_V, const IvCurve& curve) {
  IvCurve part = curve;
  part.voltage_V.clear();
  part.current_A.clear();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.voltage_V[k] > last_V) continue;
    part.voltage_V.push_back(curve.voltage_V[k]);
    part.current_A.push_back(curve.current_A[k]);
  }
  return part;
}

std::vector<double> SyntheticParameters(const Recipe& recipe) {
  return {8 * recipe.irradiance_W_m2 / 1000, 1.2e-8, 1.2, 0.004 * recipe.cells, 20. * recipe.cells};
}

IvCurve SyntheticCurve(const Recipe& recipe) {
  IvCurve curve;
  curve.name = recipe.name;
  curve.conditions.cells_in_series = recipe.cells;
  curve.conditions.irradiance_W_m2 = recipe.irradiance_W_m2;
  const double step = (recipe.to_V - recipe.from_V) / (recipe.points - 1);
  for (int k = 0; k < recipe.points; ++k) {
    curve.voltage_V.push_back((recipe.from_V + step * k) * recipe.cells);
  }
  for (int k = recipe.and_back ? recipe.points - 1 : -1; k >= 0; --k) {
    curve.voltage_V.push_back(curve.voltage_V[k]);
  }
  const std::vector<double> p = SyntheticParameters(recipe);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  curve.current_A = SolveCurrents(device, p.data(), curve.voltage_V);
  RandomStream random(recipe.seed);
  for (double& i : curve.current_A) {
    i += recipe.noise_A * random.Normal() + recipe.noise_relative * i * random.Normal();
  }
  return curve;
}

IvCurve SyntheticDarkCurve(std::uint64_t seed) {
  Recipe recipe;
  recipe.name = "dark";
  recipe.irradiance_W_m2 = 0;
  recipe.from_V = -0.5;
  recipe.seed = seed;
  return SyntheticCurve(recipe);
}

CurveSet SetOf(std::vector<IvCurve> curves) {
  CurveSet set;
  set.name = "made set";
  set.curves = std::move(curves);
  return set;
}

IvCurve ModuleCurve(Model model, const std::vector<double>& p, double noise_A, std::uint64_t seed,
                    int points, double to_V) {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 36;
  curve.voltage_V = EvenVoltages(0, to_V, points);
  curve.current_A = SolveCurrents(MakeDevice(model, curve.conditions), p.data(), curve.voltage_V);
  RandomStream random(seed);
  AddNoise(noise_A, &random, &curve);
  return curve;
}

IvCurve WanderingCurve(int seed, int points) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 0, 1, points);
  RandomStream random(seed, 0);
  double light = random.Normal();
  const double kept = std::exp(-1.0 / points);
  for (int k = 0; k < points; ++k) {
    light = kept * light + std::sqrt(1 - kept * kept) * random.Normal();
    curve.current_A[k] *= 1 + 1e-3 * light;
    curve.voltage_V[k] *= 1 + 3e-4 * random.Normal();
  }
  return curve;
}

double SubstringVoltage(double current_A, double photocurrent_A, int cells) {
  const double thermal_V = 1.1 * 0.0257 * cells, saturation_A = 9 / std::exp(0.64 / (1.1 * 0.0257));
  const double shunt_ohm = 8.0 * cells;
  const double junction_V = RisingRoot(-0.5, 1.0 * cells, [&](double v) {
    return current_A - (photocurrent_A - saturation_A * std::expm1(v / thermal_V) - v / shunt_ohm);
  });
  return junction_V - current_A * 0.005 * cells;
}

IvCurve SyntheticModule(double first, double second, double third, int points) {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 60;
  curve.voltage_V = EvenVoltages(0, 39, points);
  RandomStream random(1);
  for (const double voltage_V : curve.voltage_V) {
    const double current_A = RisingRoot(-60, 9.5, [&](double current) {
      double reached_V = 0;
      for (const double light : {first, second, third}) {
        reached_V += SubstringVoltage(current, 9 * light, 20);
      }
      return voltage_V - reached_V;
    });
    curve.current_A.push_back(current_A + 0.002 * random.Normal());
  }
  return curve;
}

IvCurve SyntheticCell(double light) {
  IvCurve curve;
  curve.name = "cell";
  RandomStream random(1);
  for (int k = -10; k < 70; ++k) {
    const double voltage_V = 0.01 * k;
    const double current_A = RisingRoot(-2, 1, [&](double current) {
      const double junction_V = voltage_V + 0.15 * current;
      return current - (0.15 * light - 4e-10 * std::expm1(junction_V / 0.0308) - junction_V / 3000);
    });
    curve.voltage_V.push_back(voltage_V);
    curve.current_A.push_back(current_A + 3e-5 * random.Normal());
  }
  return curve;
}

IvCurve CellSweepOf(std::vector<double> p, double light, bool down, double noise_A) {
  IvCurve curve;
  curve.name = "made";
  curve.source = "made";
  curve.notes.area_cm2 = 0.25;
  curve.conditions.irradiance_W_m2 = light;
  p[0] *= light / 1000;
  for (int k = 0; k <= 106; ++k) curve.voltage_V.push_back(-0.1 + 0.01 * (down ? 106 - k : k));
  curve.current_A =
      SolveCurrents(MakeDevice(Model::kSingleDiode, curve.conditions), p.data(), curve.voltage_V);
  RandomStream random(down ? 2 : 1);
  AddNoise(noise_A, &random, &curve);
  return curve;
}

CurveSet CellOf(std::vector<IvCurve> curves) {
  CurveSet cell;
  cell.name = "made";
  for (std::size_t k = 0; k < curves.size(); ++k) {
    curves[k].source = "file " + std::to_string(k);
    cell.curves.push_back(curves[k]);
  }
  return cell;
}

}  // namespace lyrefit
