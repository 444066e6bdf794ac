#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/effect.h"
#include "own_call.h"

namespace lyrefit::python {

// An effect with Python functions as stages, and its texts.
class OwnEffect {
 public:
  struct Texts {
    std::string id, title, equation, sentence, needs, acts, separate_by, reference, action;
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

// The effects of one call. Custom ones among them are kept in `own`, since they must outlive the
// result.
struct EffectsAsked {
  std::vector<EffectUse> uses;
  OwnEffects own;
};

// Converts the keyword with_. Effects of the catalogue: text in the command's notation
// ("shading:d=0.3") or a mapping {"shading": {"d": 0.3, "w": (0.1, 0.4)}}. Custom ones: an Effect,
// a pair of it and such a mapping of its parameters, or an Effect as a key. Or a list of all these.
EffectsAsked EffectsOf(pybind11::handle value);

// Custom effects: one, or a list of them.
OwnEffects OwnEffectsOf(const std::string& keyword, pybind11::handle value);

// Shares `record` and keeps the effects alive that it points to.
template <class T>
std::shared_ptr<const T> HoldWith(T record, OwnEffects own) {
  struct Held {
    OwnEffects own;  // destroyed last
    T record;
  };
  auto held = std::make_shared<Held>(Held{std::move(own), std::move(record)});
  return std::shared_ptr<const T>(held, &held->record);
}

}  // namespace lyrefit::python
