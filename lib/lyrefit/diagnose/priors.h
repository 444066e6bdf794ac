// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// What is known of a measurement beside its readings that makes causes more or less common.
struct Circumstances {
  Setup setup = Setup::kUnknown;
  bool module = false;                   // more than one cell in series
  bool slow = false;                     // its times show that a sweep took half a second or more
  std::string technology = {};           // as stated; empty: unknown
  std::optional<double> age_years = {};  // of the device in the field
};

// A change of an effect's prior (Effect::prior) where more is known than that a sweep was taken in the
// field.
struct PriorFactor {
  const char* id;                             // of the effect
  bool (*holds)(const Circumstances& where);  // where it counts
  double factor;                              // of its prior; 0: the cause cannot be there
  const char* source;                         // on what it rests; of 0 why not, said in reports
};

// The changes; those that hold at once multiply. As the priors they are orders of magnitude: their
// sources order causes, and do not count sweeps. The evidence of a fault above the floors is usually
// larger by far, so that a factor of three changes few verdicts.
const std::vector<PriorFactor>& PriorFactorTable();

// Why a cause cannot be there in these circumstances; null: it can.
const char* WhyNotThere(const std::string& id, const Circumstances& where);

// Prior probabilities of causes.
struct CausePriors {
  std::map<std::string, double> given;  // by id, replace those of the effects
  bool alike = false;                   // all other causes are equally probable
  std::string name = "table";           // "table", "alike" or the name of the file
  Circumstances where = {};             // of the measurement; Diagnose fills it

  // Of an effect in sweeps of modules or of cells. What cannot be there counts as elsewhere, for one
  // who asks for it by name.
  double Of(const Effect& effect, bool module) const;
};

// Of a cause without a prior, such as an effect of one's own, and of all with `alike`.
inline constexpr double kOtherPrior = 0.03;
// That something acts which no effect of the catalogue describes.
inline constexpr double kUnknownPrior = 0.003;
// That a sweep contains a wrong reading.
inline constexpr double kWrongReadingPrior = 0.05;

// Reads a file like {"shading": 0.1, "second_diode": 0.01}, whose values replace those of the
// effects. Errors, with file, line and column: an id that is no effect, a number outside (0, 1).
Expected<CausePriors> ReadPriors(const std::string& path);

// Priors by name ("table" or "alike"), or from a file of ReadPriors().
Expected<CausePriors> PriorsNamed(const std::string& name);

// Option for priors, by name or file: see base/option.h.
template <auto Member>
constexpr auto PriorsOption() {
  using Options = ClassOf<Member>;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders&) -> Expected<void> {
        Expected<CausePriors> priors = PriorsNamed(text);
        if (!priors) return tl::unexpected<Error>(priors.error());
        options->*Member = std::move(*priors);
        return {};
      },
      [](const Options& options) -> std::vector<std::string> { return {(options.*Member).name}; },
      nullptr, false};
}

}  // namespace lyrefit
