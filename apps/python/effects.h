#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/law/effect.h"
#include "lyrefit/law/extension.h"
#include "own_call.h"

namespace lyrefit::python {

// An effect whose stages are functions of Python's, and the texts that it points to.
class OwnEffect {
 public:
  struct Texts {
    std::string id, title, equation, sentence, needs, acts, separate_by, reference;
    struct OfParameter {
      std::string symbol, name, unit, doc;
    };
    std::vector<OfParameter> parameters;
  };
  OwnEffect(Texts texts, Effect effect, std::shared_ptr<Fault> fault);
  OwnEffect(const OwnEffect&) = delete;

  const Effect& effect() const { return effect_; }
  const std::shared_ptr<Fault>& fault() const { return fault_; }

 private:
  Texts texts_;
  Effect effect_;
  std::shared_ptr<Fault> fault_;
};
using OwnEffects = std::vector<std::shared_ptr<const OwnEffect>>;

Faults FaultsOf(const OwnEffects& own);

// The effects that one call names, and those of its own among them, which have to outlive what
// comes of it.
struct EffectsAsked {
  std::vector<EffectUse> uses;
  OwnEffects own;
};

// What the keyword with_ says: effects of the catalogue as the command names them
// ("shading:d=0.3"), or as a mapping {"shading": {"d": 0.3, "w": (0.1, 0.4)}}; an Effect of one's
// own, a pair of it and such a mapping of its parameters, or it as a key; or a list of all these.
EffectsAsked EffectsOf(pybind11::handle value);

// Effects of one's own: one, or a list of them.
OwnEffects OwnEffectsOf(const std::string& keyword, pybind11::handle value);

// `record` as it is, kept alive with effects that it points to.
template <class T>
std::shared_ptr<const T> HoldWith(T record, OwnEffects own) {
  struct Held {
    OwnEffects own;  // goes last
    T record;
  };
  auto held = std::make_shared<Held>(Held{std::move(own), std::move(record)});
  return std::shared_ptr<const T>(held, &held->record);
}

}  // namespace lyrefit::python
