#include "lyrefit/law/law.h"

#include <glog/logging.h>

#include <cmath>
#include <limits>

#include "lyrefit/base/constants.h"
#include "lyrefit/law/cell_law.h"

namespace lyrefit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar_V = 50;
constexpr double kNear_V = 2;  // a former root farther from a plain guess is no start

struct Bound {
  double lower;
  double upper;
};
constexpr Bound kBaseBounds[] = {{0, 20}, {-60, 40}, {0.2, 8}, {0, 3}, {0, 50}, {0, 20}};
constexpr Bound kTempcoBound = {-0.01, 0.01}, kBandgapBound = {0.3, 2.5};

Bound BaseBound(const Law& law, int parameter) {
  if (law.free_bandgap && parameter == law.BandgapAt()) return kBandgapBound;
  if (law.free_tempco && parameter == law.TempcoAt()) return kTempcoBound;
  return kBaseBounds[parameter];
}

struct Root {
  double junction = 0;
  double current = 0;
  double slope = 0;  // dF/dVj
  // Of the shaded group: its junction voltage, and that voltage's slope by the current.
  double shaded_junction = 0;
  double shaded_slope = 0;
  double shaded_by_current = 0;
};

Root SolveUniform(const Bench<double>& bench, const Cell<double>& cell, double voltage,
                  double start) {
  Root root;
  const auto excess = [&](double vj) {
    const Slope1 x(vj, 0);
    const Slope1 current = CellCurrent(bench, cell, x);
    root.current = current.a;
    root.slope = current.v[0];
    return x - voltage - SeriesDrop(bench, cell, current);
  };
  root.junction = RisingRoot(excess, start);
  excess(root.junction);
  return root;
}

// The shaded group at a known current and series drop. Its cells and their bypass diode carry the
// current together: F(v) + B(D - v) = I.
void SolveShaded(const Bench<double>& bench, const Cell<double>& shaded, double current,
                 const Slope1& drop, Root* root) {
  double bypass_slope = 0;
  const auto excess = [&](double vj) {
    const Slope1 x(vj, 0);
    const Slope1 bypass = BypassCurrent(shaded, drop.a - x);
    bypass_slope = -bypass.v[0];
    const Slope1 cells = CellCurrent(bench, shaded, x);
    root->shaded_slope = cells.v[0] + bypass.v[0];
    return Slope1(current) - cells - bypass;
  };
  root->shaded_junction = RisingRoot(excess, root->shaded_junction);
  excess(root->shaded_junction);
  root->shaded_by_current = (1 - bypass_slope * drop.v[0]) / root->shaded_slope;
}

Root SolveGrouped(const Bench<double>& bench, const Cell<double>& cell, double voltage,
                  double start, double shaded_start) {
  Root root;
  root.shaded_junction = shaded_start;
  const double w = cell.share;
  const Cell<double> dim = UnderLight(cell, cell.light);
  const auto excess = [&](double vj) {
    const Slope1 x(vj, 0);
    const Slope1 current = CellCurrent(bench, cell, x);
    root.current = current.a;
    root.slope = current.v[0];
    const Slope1 by_current = SeriesDrop(bench, cell, Slope1(current.a, 0));
    SolveShaded(bench, dim, current.a, by_current, &root);
    Slope1 drop(by_current.a), shaded(root.shaded_junction - by_current.a);
    drop.v[0] = by_current.v[0] * current.v[0];
    shaded.v[0] = root.shaded_by_current * current.v[0] - drop.v[0];
    return (1 - w) * (x - drop) + w * shaded - voltage;
  };
  root.junction = RisingRoot(excess, start);
  excess(root.junction);
  return root;
}

// Current and junction voltage as duals, given the root in plain numbers (implicit function
// theorem).
template <class S>
void Differentiate(const Bench<S>& bench, const Cell<S>& cell, const S& voltage,
                   const Bench<double>& plain, const Cell<double>& plain_cell, const Root& root,
                   S* current, S* junction) {
  const S drop = SeriesDrop(bench, cell, S(root.current));
  const double resistance = SeriesDrop(plain, plain_cell, Slope1(root.current, 0)).v[0];  // dD/dI
  const S missing = CellCurrent(bench, cell, plain, plain_cell, S(root.junction)) - root.current;
  if (!cell.grouped) {
    const S shift = voltage + drop - root.junction;
    *current = root.current + (missing + root.slope * shift) / (1 - root.slope * resistance);
    *junction = root.junction + shift + resistance * (*current - root.current);
    return;
  }
  const S lit = root.junction - missing / root.slope - drop;
  const Cell<S> dim = UnderLight(cell, cell.light);
  const Cell<double> plain_dim = UnderLight(plain_cell, plain_cell.light);
  const S carried = CellCurrent(bench, dim, plain, plain_dim, S(root.shaded_junction)) +
                    BypassCurrent(dim, S(drop - root.shaded_junction));
  const S shaded = root.shaded_junction - (carried - root.current) / root.shaded_slope - drop;
  const double w = plain_cell.share;
  const double slope =
      (1 - w) * (1 / root.slope - resistance) + w * (root.shaded_by_current - resistance);
  const S excess = (1.0 - cell.share) * lit + cell.share * shaded - voltage;
  *current = root.current - excess / slope;
  *junction = root.junction + (*current - root.current - missing) / root.slope;
}

template <class S>
S Recorded(const Bench<S>& bench, const Reading& reading, const Cell<S>& cell, const S& current,
           const S& junction) {
  Solved<S> solved;
  solved.current = current;
  solved.resistance = cell.resistance;
  solved.diode_conductance =
      cell.saturation * cell.inverse_n_vt * exp(Cut(S(junction * cell.inverse_n_vt)));
  if (cell.second) {
    solved.diode_conductance =
        solved.diode_conductance +
        cell.saturation_2 * cell.inverse_2_vt * exp(Cut(S(junction * cell.inverse_2_vt)));
  }
  solved.conductance = solved.diode_conductance + cell.conductance;
  for (std::size_t e = 0; e < bench.law.effects.size(); ++e) {
    const auto stage = bench.law.effects[e]->instrument.template For<S>();
    if (stage != nullptr) stage(bench.p + bench.offsets[e], reading, &solved);
  }
  return solved.current;
}

template <class S>
Bench<S> MakeBench(const Law& law, const Readings& readings, const S* p) {
  Bench<S> bench{law, readings, p, {}};
  int offset = law.base_size();
  for (const Effect* effect : law.effects) {
    bench.offsets.push_back(offset);
    offset += effect->size();
  }
  return bench;
}

// Value and all derivatives.
bool IsSame(double a, double b) { return a == b; }
template <int N>
bool IsSame(const Dual<N>& a, const Dual<N>& b) {
  if (a.a != b.a) return false;
  for (int k = 0; k < N; ++k) {
    if (a.v[k] != b.v[k]) return false;
  }
  return true;
}

// Cells are the same for readings under the same sky: the last one is kept, and what its
// temperature decided for readings under other light.
template <class S>
class CellKeeper {
 public:
  explicit CellKeeper(const Bench<S>& bench) : bench_(bench) {
    for (const Effect* effect : bench.law.effects) varies_ = varies_ || effect->sky;
  }
  const Cell<S>& At(const Reading& reading, Sky<S>* sky) {
    *sky = SkyAt(bench_, reading);
    const bool same = known_ && reading.temperature_K == temperature_;
    if (!varies_ && same && reading.irradiance == irradiance_) return cell_;
    if (!same || !IsSame(sky->temperature_K, last_.temperature_K) ||
        !IsSame(sky->bandgap_eV, last_.bandgap_eV)) {
      warm_ = CellUnder(bench_, *sky);
      last_ = *sky;
    }
    cell_ = CellAt(bench_, *sky, warm_);
    irradiance_ = reading.irradiance;
    temperature_ = reading.temperature_K;
    known_ = true;
    return cell_;
  }

 private:
  const Bench<S>& bench_;
  bool varies_ = false;
  bool known_ = false;
  double irradiance_ = 0;
  double temperature_ = 0;
  Sky<S> last_;
  Cell<S> warm_;  // at that sky's temperature
  Cell<S> cell_;
};

bool HasInstrument(const Law& law) {
  for (const Effect* effect : law.effects) {
    if (effect->instrument) return true;
  }
  return false;
}

template <class S>
bool Evaluate(const Law& law, const Readings& readings, const double* values,
              LawWorkspace* workspace, double* current, double* jacobian) {
  const int size = law.size();
  const Bench<double> plain = MakeBench(law, readings, values);
  std::vector<S> duals(size);
  if constexpr (!std::is_same_v<S, double>) {
    for (int k = 0; k < size; ++k) duals[k] = S(values[k], k);
  }
  const Bench<S> bench = MakeBench(law, readings, static_cast<const S*>(duals.data()));
  CellKeeper<double> plain_cells(plain);
  CellKeeper<S> cells(bench);
  const bool instrument = HasInstrument(law);
  const std::size_t count = readings.points.size();
  const bool fresh = workspace->junction.size() != count;
  if (fresh) workspace->junction.assign(count, 0.0);
  if (fresh) workspace->shaded.assign(count, kInfinity);
  for (std::size_t k = 0; k < count; ++k) {
    const Reading& reading = readings.points[k];
    Sky<double> sky;
    const Cell<double>& cell = plain_cells.At(reading, &sky);
    if (!(sky.temperature_K > 100 && sky.temperature_K < 700)) return false;
    double& start = workspace->junction[k];
    const double guess = sky.voltage + reading.current * cell.resistance;
    if (fresh || !(std::fabs(start - guess) < kNear_V)) start = guess;
    double& shaded_start = workspace->shaded[k];
    if (!(std::fabs(shaded_start) < kFar_V)) shaded_start = start;
    const Root root = cell.grouped ? SolveGrouped(plain, cell, sky.voltage, start, shaded_start)
                                   : SolveUniform(plain, cell, sky.voltage, start);
    start = root.junction;
    if (cell.grouped) shaded_start = root.shaded_junction;
    current[k] = root.current;
    if constexpr (std::is_same_v<S, double>) {
      if (instrument) {
        current[k] = Recorded(plain, reading, cell, root.current, root.junction);
      }
    } else {
      Sky<S> dual_sky;
      const Cell<S>& dual_cell = cells.At(reading, &dual_sky);
      S dual_current, dual_junction;
      Differentiate(bench, dual_cell, dual_sky.voltage, plain, cell, root, &dual_current,
                    &dual_junction);
      if (instrument) {
        dual_current = Recorded(bench, reading, dual_cell, dual_current, dual_junction);
      }
      current[k] = dual_current.a;
      for (int i = 0; i < size; ++i) {
        if (!std::isfinite(dual_current.v[i])) return false;
        jacobian[k * size + i] = dual_current.v[i];
      }
    }
    if (!std::isfinite(current[k])) return false;
  }
  return true;
}

}  // namespace

int Law::size() const {
  int size = base_size();
  for (const Effect* effect : effects) size += effect->size();
  return size;
}

int Law::Offset(int effect) const {
  int offset = base_size();
  for (int e = 0; e < effect; ++e) offset += effects[e]->size();
  return offset;
}

namespace {

const EffectParameter* ParameterAt(const Law& law, int parameter) {
  int at = parameter - law.base_size();
  for (const Effect* effect : law.effects) {
    if (at < effect->size()) return &effect->parameters[at];
    at -= effect->size();
  }
  return nullptr;
}

}  // namespace

double Law::Lower(int parameter) const {
  if (parameter < base_size()) return BaseBound(*this, parameter).lower;
  return ParameterAt(*this, parameter)->lower;
}

double Law::Upper(int parameter) const {
  if (parameter < base_size()) return BaseBound(*this, parameter).upper;
  return ParameterAt(*this, parameter)->upper;
}

bool Law::Searched(int parameter) const {
  return parameter >= base_size() && ParameterAt(*this, parameter)->searched;
}

bool EvaluateLaw(const Law& law, const Readings& readings, const double* p, LawWorkspace* workspace,
                 double* current, double* jacobian) {
  CHECK_LE(law.size(), 20);
  if (jacobian == nullptr) return Evaluate<double>(law, readings, p, workspace, current, nullptr);
  if (law.size() <= 8) return Evaluate<Narrow>(law, readings, p, workspace, current, jacobian);
  return Evaluate<Wide>(law, readings, p, workspace, current, jacobian);
}

double SaturationCurrent(const Law&, const Readings& readings, const double* p) {
  const double vt = ThermalVoltage(readings.reference_temperature_K);
  return std::exp(p[kBasePivot]) / std::expm1(readings.pivot_voltage / (p[kBaseIdeality] * vt));
}

double Saturation2Unit(const Readings& readings) {
  return std::exp(-readings.pivot_voltage / (2 * ThermalVoltage(readings.reference_temperature_K)));
}

}  // namespace lyrefit
