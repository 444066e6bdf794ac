#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/law/effect.h"
#include "lyrefit/law/reading.h"
#include "lyrefit/law/string_layout.h"
#include "lyrefit/law/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Base model and causes together: one parameter vector for a whole measurement. Base parameters
// first, then those of each effect in turn.
//
// Base: one diode (or a second with n = 2), five parameters for all readings, translated
// as law/translation.h does for De Soto, Klein and Beckman 2006
// (doi:10.1016/j.solener.2005.06.010):
//   Iph = g Iph_ref (1 + alpha (T - Tref)),   g = G / (1000 W/m2)
//   Is  = Is_ref (T / Tref)^3 exp(Eg / k Tref - Eg / k T),   Eg = EgRef (1 + dEgdT (T - 25 C))
//   n and Rs constant, Gsh = 1 / Rsh constant or in proportion to g
// What nobody stated of alpha and EgRef is a parameter as well. The recombination diode follows
// (T / Tref)^2.5 exp((Eg / k Tref - Eg / k T) / 2).
enum BaseParameter {
  kBasePhotocurrent = 0,  // at g = 1 and Tref
  kBasePivot = 1,  // ln of the first diode's current at the pivot voltage: unlike ln Is it is
                   // almost uncorrelated with n
  kBaseIdeality = 2,
  kBaseResistance = 3,
  kBaseConductance = 4,
  kBaseSecond = 5,  // dd: the second diode's current at the pivot voltage
  // Then those of alpha (1/K, relative) and EgRef (eV) that are free: see Law.
};

// What a law may have: derivatives are carried for so many.
constexpr int kMostParameters = 20;

// The terminal law of a measurement: a base of diodes and the effects beside them.
struct Law {
  Model model = Model::kSingleDiode;  // of the base: sd, or dd with n2 = 2
  // The base with its parameters as device.h orders them, in its units, at the reference and at
  // irradiance 1 instead; every model. A free alpha is in A/K.
  bool natural = false;
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<const Effect*> effects;          // in the order of their parameters
  std::shared_ptr<const StringLayout> layout;  // of cells that are not alike; none: all are
  double bandgap_slope_per_K = 0;              // dEgdT
  ShuntLaw shunt = ShuntLaw::kConstant;        // or kInverse
  bool free_tempco = false;                    // alpha is a parameter
  bool free_bandgap = false;                   // EgRef is a parameter
  // Parameters of effects that are descended in although fits keep them where they are.
  std::vector<std::pair<const Effect*, int>> freed;

  // Where alpha stands among the parameters, where it is free.
  int TempcoAt() const {
    const int diodes = static_cast<int>(model);
    return natural ? 3 + 2 * diodes : 4 + diodes;
  }
  int BandgapAt() const { return TempcoAt() + (free_tempco ? 1 : 0); }  // where free
  // Parameters of the base: those of the effects follow.
  int base_size() const { return BandgapAt() + (free_bandgap ? 1 : 0); }
  // All of them.
  int size() const;
  int Offset(int effect) const;  // of its first parameter
  // Bounds of all parameters.
  double Lower(int parameter) const;
  double Upper(int parameter) const;
  bool Searched(int parameter) const;  // not to be descended in, unless asked for
};

// Who would rather have no current than look for it in brackets, some ten thousand times as long.
enum class GiveUp {
  kNever,
  kAbsurd,  // where cells drive more than a million scales through their own bypass diode
  kSlow,    // wherever steps lead to no end
};

// The readings laid out for the law, and where the last evaluation of it ended: from there the next
// starts. For one law and one set of readings, which must not change in between.
class LawWorkspace {
 public:
  // Empty: the first evaluation fills it.
  explicit LawWorkspace(GiveUp give_up = GiveUp::kAbsurd);
  // On blocks that stand already (reading_blocks.h) and outlive this; every evaluation starts
  // afresh, and none is given up.
  explicit LawWorkspace(const std::vector<ReadingBlock>& blocks);
  ~LawWorkspace();

  struct State;
  // What evaluations keep for these readings; made at the first call.
  State* Of(const Readings& readings);

 private:
  std::unique_ptr<State> state_;
  GiveUp give_up_ = GiveUp::kNever;
};

// Recorded current of every reading. `jacobian`, where given, receives its derivatives by all
// parameters, row by row; those that are `held` (1) get 0 instead, which takes less time. False
// where it cannot be had (a step left the physical range).
bool EvaluateLaw(const Law& law, const Readings& readings, const double* p, LawWorkspace* workspace,
                 double* current, double* jacobian, const std::vector<char>* held = nullptr);

// Saturation current (in scales) and thermal voltage at the reference, as in the base law.
double SaturationCurrent(const Law& law, const Readings& readings, const double* p);

// exp(-pivot / 2 Vt): saturation current of a diode with n = 2 that carries 1 at the pivot.
double Saturation2Unit(const Readings& readings);

}  // namespace lyrefit
