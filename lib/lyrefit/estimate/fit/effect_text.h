// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/text_readers.h"
#include "lyrefit/model/device_effects.h"

namespace LYREFIT_PUBLIC lyrefit {

// Option for a list of effects, one flag per effect: see base/option.h.
template <auto First, auto... Rest>
constexpr auto EffectsOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders& readers) -> Expected<void> {
        Expected<EffectUse> use = readers.effect(text);
        if (!use) return tl::unexpected<Error>(use.error());
        Along<First, Rest...>(*options).push_back(std::move(*use));
        return {};
      },
      [](const Options& options) {
        std::vector<std::string> texts;
        for (const EffectUse& use : Along<First, Rest...>(options)) {
          texts.push_back(DescribeUse(use));
        }
        return texts;
      },
      nullptr, true};
}

// Unit and help text of every option that takes effects.
inline constexpr char kEffectsUnit[] = "EFFECT[:P=VALUE|LOW:HIGH,...]";
inline constexpr char kEffectsDoc[] =
    "an effect beside the diodes, as diagnose --explain names it: alone, with what the shape of "
    "the curve suggests free; or with parameters fixed (d=0.3) or within a range (d=0:0.5); once "
    "for each";

}  // namespace lyrefit
