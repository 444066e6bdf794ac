// Experimental: may change in a minor version (data/stable).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/parameter.h"
#include "lyrefit/model/reading.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// The wiring of a device's cells and the properties of each cell group. These are constants of the
// law, in contrast to the parameters of effects. The device's own parameters describe all cells as
// identical.
struct StringLayout {
  // A cell group: identical cells.
  struct Cells {
    double share = 1;   // fraction of all cells of the device
    double light = 1;   // factor of the photocurrent
    double leak_S = 0;  // additional shunt conductance of each cell
    int substring = 0;  // position of its substring in `substrings`
  };
  std::vector<Cells> groups;          // at most kMostGroups
  std::vector<Substring> substrings;  // at most kMostGroups
  int cells_in_series = 1;
  int strings = 1;                                // in parallel, of equal cell numbers
  double bypass_voltage_V = 0.5;                  // at the current scale, which is about Isc
  double bypass_ideality = kUsualBypassIdeality;  // towards 0: an ideal diode of constant voltage
  ReverseLaw reverse = ReverseLaw::kShunt;
  double reverse_strength = 0.1;  // Bishop's a
  double reverse_voltage_V = 15;
  double reverse_exponent = 3.4;  // m of either law
};

// Maximum number of parameters of a law: the derivative types hold as many.
constexpr int kMostParameters = 20;

// A law: base model and effects with one parameter vector for a whole measurement. The parameters
// of the base come first, in the order and units of device.h, at the reference temperature and
// irradiance 1. Those of each effect follow in turn.
//
// The parameters of the base serve all readings and are translated by De Soto, Klein and Beckman
// 2006 (model/translation.h, doi:10.1016/j.solener.2005.06.010):
//   Iph = g (Iph_ref + alpha (T - Tref)),   g = G / (1000 W/m2)
//   Is  = Is_ref (T / Tref)^3 exp(Eg / k Tref - Eg / k T),   Eg = EgRef (1 + dEgdT (T - 25 C))
//   n and Rs constant, Gsh = 1 / Rsh constant or proportional to g
// A free alpha (A/K) and a free EgRef (eV) follow the parameters of the device. Further diodes
// follow (T / Tref)^2.5 exp((Eg / k Tref - Eg / k T) / 2).
struct Law {
  Model model = Model::kSingleDiode;  // of the base
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<const Effect*> effects;          // in the order of their parameters
  std::shared_ptr<const StringLayout> layout;  // groups of unlike cells; null: all cells alike
  double bandgap_slope_per_K = 0;              // dEgdT
  ShuntLaw shunt = ShuntLaw::kConstant;        // or kInverse
  bool free_tempco = false;                    // alpha is a parameter
  bool free_bandgap = false;                   // EgRef is a parameter
  // Parameters of effects, by position, that are fitted although they are fixed by default.
  std::vector<std::pair<const Effect*, int>> freed;

  // Position of alpha among the parameters, if free.
  int TempcoAt() const { return 3 + 2 * static_cast<int>(model); }
  int BandgapAt() const { return TempcoAt() + (free_tempco ? 1 : 0); }  // EgRef, if free
  // Parameters of the base, and their number.
  std::vector<ParameterInfo> BaseInfos() const;
  int base_size() const { return BandgapAt() + (free_bandgap ? 1 : 0); }
  // Number of all parameters.
  int size() const;
  int Offset(int effect) const;                                   // position of its first parameter
  const EffectParameter* EffectParameterAt(int parameter) const;  // null: of the base
  bool Searched(int parameter) const;  // not fitted by descent by default
};

// Whether an evaluation may stop without a current, instead of the bracketed search (some ten
// thousand times as long).
enum class GiveUp {
  kNever,
  kAbsurd,  // if cells drive over a million scales through their own bypass diode
  kSlow,    // if Newton's steps do not converge
};

// Readings in blocks, and the solution of the last evaluation as the start of the next one. Serves
// one law and one set of readings, which must not change in between.
class LawWorkspace {
 public:
  // Empty: the first evaluation fills it.
  explicit LawWorkspace(GiveUp give_up = GiveUp::kAbsurd);
  // Uses existing blocks (make_readings.h) that must outlive this object. Every evaluation starts
  // from a guess, and none stops early.
  explicit LawWorkspace(const std::vector<ReadingBlock>& blocks);
  ~LawWorkspace();

  struct State;
  // The state for these readings, created at the first call.
  State* Of(const Readings& readings);

 private:
  std::unique_ptr<State> state_;
  GiveUp give_up_ = GiveUp::kNever;
};

// Recorded current of every reading, in current scales. `jacobian`, if not null, receives the
// derivatives by all parameters, row-major, readings x parameters. Columns of parameters with
// `fixed` 1 are 0, which saves time. Returns false if there is no result (a step left the physical
// range).
bool EvaluateLaw(const Law& law, const Readings& readings, const double* p, LawWorkspace* workspace,
                 double* current, double* jacobian, const std::vector<char>* fixed = nullptr);

// Saturation current exp(-pivot / 2 Vt) of a diode with n = 2 that carries 1 at the pivot voltage.
double Saturation2Unit(const Readings& readings);

}  // namespace lyrefit
