#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/label.h"

namespace lyrefit {

// `text` with full-width punctuation, letters and digits as their ASCII forms: "（mV）" is "(mV)".
std::string HalfWidth(std::string_view text);

// Replaces words of German, French, Spanish, Italian, Portuguese, Russian, Chinese, Japanese and
// Korean by their English ones, in small letters and whatever their accents: "Zelltemperatur" is
// "cell temperature", "电压" is "voltage". Chinese words need no blanks between them. Articles and
// prepositions before a further word of the name are dropped: "température de la cellule".
void Translate(std::vector<LabelWord>* words);

}  // namespace lyrefit
