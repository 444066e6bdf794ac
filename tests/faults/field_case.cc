#include "faults/field_case.h"

#include <cmath>

#include "faults/field_misfit.h"

namespace faults::field {
namespace {

constexpr int kDraws = 60;

const Fault* Called(const std::string& kind) {
  for (const auto* faults : {&DeviceFaults(), &CellFaults(), &SweepFaults()}) {
    for (const Fault& fault : *faults) {
      if (kind == fault.name) return &fault;
    }
  }
  return nullptr;
}

double MisfitPercent(const Rig& rig, Lit* lit) {
  const Readings exact = Exact(rig, lit);
  const double rms = BestOneDiode(exact.voltage, exact.current).rms;
  return 100 * rms / ShortCircuit(lit->Whole());
}

Measurement HandedOver(const Case& made, const Rig& rig, const Readings& readings, Random* random) {
  Measurement taken;
  const double suns = made.make.suns * (1 + 0.015 * random->Normal());
  const double celsius = made.make.kelvin - 273.15 + random->Normal();
  taken.voltage = readings.voltage;
  taken.current = readings.current;
  if (rig.tracer.writes_times) {
    for (const double time : readings.time) taken.time.push_back(time * rig.tracer.seconds);
  }
  if (rig.tracer.up_and_down) taken.sweep = readings.sweep;
  taken.curve.assign(readings.voltage.size(), 0);
  taken.irradiance.assign(readings.voltage.size(), std::round(1000 * suns));
  taken.temperature.assign(readings.voltage.size(), std::round(10 * celsius) / 10);
  taken.cells = rig.module.CellsInSeries();
  taken.bypass_diodes = static_cast<int>(rig.module.groups.size());
  taken.bandgap_eV = 0;
  return taken;
}

Uniformity UniformityOf(const std::string& kind) {
  if (kind == "clean_sd") return Uniformity::kSingleDiode;
  if (kind == "clean_dd") return Uniformity::kDoubleDiode;
  return Uniformity::kEveryCellItsOwn;
}

}  // namespace

std::vector<std::string> Kinds() {
  std::vector<std::string> kinds = {"clean_sd", "clean_dd", "clean_module"};
  for (const auto* faults : {&DeviceFaults(), &CellFaults(), &SweepFaults()}) {
    for (const Fault& fault : *faults) kinds.push_back(fault.name);
  }
  return kinds;
}

void SettleDeparture(const Sampled& curve, double wanted, Departure* departure) {
  const double isc = ShortCircuit(curve), voc = OpenCircuit(curve);
  departure->size = 1e-3;
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<double> voltage, current;
    for (int i = 0; i <= 120; ++i) {
      const double u = 1.005 * i / 120, plain = curve.CurrentAt(u * voc);
      voltage.push_back(u * voc);
      current.push_back(plain + isc * departure->At(u, 1 - plain / isc));
    }
    departure->size *= wanted * isc / BestOneDiode(voltage, current).rms;
  }
}

Case MakeCase(const std::string& kind, std::uint64_t seed) {
  Random random(seed);
  Case made;
  made.kind = kind;
  const Uniformity uniformity = UniformityOf(kind);
  const bool field = uniformity == Uniformity::kEveryCellItsOwn;
  const Drawn drawn = DrawModule(uniformity, &random);
  made.make = drawn.make;
  Rig rig;
  rig.module = drawn.module;
  rig.tracer = DrawTracer(field ? Bench::kField : Bench::kLaboratory, &random);
  Lit healthy(rig.module);
  made.misfit = made.healthy = MisfitPercent(rig, &healthy);
  if (field) {
    rig.departure = DrawDeparture(&random);
    SettleDeparture(healthy.Whole(), random.LogUniform(5e-4, 2e-3), &rig.departure);
    rig.sky.wander = DrawWander(random.LogUniform(2e-4, 2e-3), &random);
  }
  const Fault* fault = Called(kind);
  if (fault != nullptr) fault->apply(&random, &rig, &made.truth);
  Lit lit(rig.module);
  made.truth.power_W = MaximumPower(healthy.Whole());
  made.truth.lost_W = made.truth.power_W - MaximumPower(lit.Whole());
  if (fault != nullptr) made.misfit = MisfitPercent(rig, &lit);
  made.measurement = HandedOver(made, rig, Measured(rig, &lit, &random), &random);
  return made;
}

Case MakeCaseAbove(const std::string& kind, double misfit, std::uint64_t seed) {
  Case strongest;
  for (int draw = 0; draw < kDraws; ++draw) {
    Case made = MakeCase(kind, SeedOf(seed, draw));
    if (draw == 0 || made.misfit > strongest.misfit) strongest = std::move(made);
    if (strongest.misfit >= misfit) break;
  }
  return strongest;
}

}  // namespace faults::field
