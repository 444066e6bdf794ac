#include "lyrefit/read/label.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace lyrefit {
namespace {

struct ForeignWord {
  std::string_view word;  // small letters without accents
  std::string_view english;
};

constexpr ForeignWord kTerms[] = {
    // German
    {"spannung", "voltage"},
    {"strom", "current"},
    {"stromstarke", "current"},
    {"stromstaerke", "current"},
    {"stromdichte", "current density"},
    {"leistung", "power"},
    {"temperatur", "temperature"},
    {"zelltemperatur", "cell temperature"},
    {"zellentemperatur", "cell temperature"},
    {"zelltemp", "cell temperature"},
    {"modultemperatur", "module temperature"},
    {"modultemp", "module temperature"},
    {"ruckseitentemperatur", "backside temperature"},
    {"rueckseitentemperatur", "backside temperature"},
    {"ruckseite", "backside"},
    {"rueckseite", "backside"},
    {"umgebungstemperatur", "ambient temperature"},
    {"umgebung", "ambient"},
    {"lufttemperatur", "air temperature"},
    {"luft", "air"},
    {"raumtemperatur", "room temperature"},
    {"temperaturkoeffizient", "temperature coefficient"},
    {"koeffizient", "coefficient"},
    {"zelle", "cell"},
    {"zellen", "cells"},
    {"solarzelle", "cell"},
    {"solarzellen", "cells"},
    {"modul", "module"},
    {"modulen", "modules"},
    {"dioden", "diodes"},
    {"bypassdioden", "bypass diodes"},
    {"bestrahlungsstarke", "irradiance"},
    {"bestrahlungsstaerke", "irradiance"},
    {"einstrahlung", "irradiance"},
    {"beleuchtungsstarke", "illuminance"},
    {"beleuchtungsstaerke", "illuminance"},
    {"flache", "area"},
    {"flaeche", "area"},
    {"zellflache", "cell area"},
    {"zellflaeche", "cell area"},
    {"kurzschlussstrom", "shortcircuit current"},
    {"kurzschlusstrom", "shortcircuit current"},
    {"leerlaufspannung", "opencircuit voltage"},
    {"leerlauf", "opencircuit"},
    {"kurzschluss", "shortcircuit"},
    {"maximalleistung", "maximum power"},
    {"anzahl", "number of"},
    {"modulanzahl", "number of modules"},
    {"modulzahl", "number of modules"},
    {"zellenanzahl", "number of cells"},
    {"zellenzahl", "number of cells"},
    {"zellanzahl", "number of cells"},
    {"zellzahl", "number of cells"},
    {"pro", "per"},
    {"je", "per"},
    {"strang", "string"},
    {"reihe", "series"},
    {"dunkel", "dark"},
    {"dunkelstrom", "dark current"},
    {"dunkelkennlinie", "dark"},
    {"hell", "lit"},
    {"hellkennlinie", "lit"},
    {"beleuchtet", "lit"},
    {"beleuchtung", "illumination"},
    {"licht", "light"},
    {"lichtquelle", "light source"},
    {"raumlicht", "room light"},
    {"zimmerlicht", "room light"},
    {"umgebungslicht", "ambient light"},
    {"zeit", "time"},
    {"datum", "date"},
    // French
    {"tension", "voltage"},
    {"courant", "current"},
    {"intensite", "amperage"},
    {"densite", "density"},
    {"puissance", "power"},
    {"cellule", "cell"},
    {"cellules", "cells"},
    {"par", "per"},
    {"chaine", "string"},
    {"ambiante", "ambient"},
    {"eclairement", "irradiance"},
    {"ensoleillement", "irradiance"},
    {"rayonnement", "irradiance"},
    {"maximale", "maximum"},
    {"courtcircuit", "shortcircuit"},
    {"court", "shortcircuit"},
    {"ouvert", "opencircuit"},
    {"vide", "opencircuit"},
    {"temps", "time"},
    {"obscurite", "dark"},
    {"noir", "dark"},
    {"eclairee", "lit"},
    {"eclaire", "lit"},
    // Spanish, Italian, Portuguese
    {"tensione", "voltage"},
    {"tensao", "voltage"},
    {"voltaje", "voltage"},
    {"voltagem", "voltage"},
    {"corriente", "current"},
    {"corrente", "current"},
    {"intensidad", "amperage"},
    {"intensita", "amperage"},
    {"intensidade", "amperage"},
    {"densidad", "density"},
    {"densita", "density"},
    {"densidade", "density"},
    {"potencia", "power"},
    {"potenza", "power"},
    {"temperatura", "temperature"},
    {"celda", "cell"},
    {"celdas", "cells"},
    {"celula", "cell"},
    {"celulas", "cells"},
    {"cella", "cell"},
    {"celle", "cells"},
    {"modulo", "module"},
    {"modulos", "modules"},
    {"moduli", "modules"},
    {"por", "per"},
    {"cadena", "string"},
    {"stringa", "string"},
    {"ambiente", "ambient"},
    {"irradiancia", "irradiance"},
    {"irradianza", "irradiance"},
    {"irraggiamento", "irradiance"},
    {"radiacion", "irradiance"},
    {"radiacao", "irradiance"},
    {"iluminancia", "illuminance"},
    {"illuminamento", "illuminance"},
    {"superficie", "area"},
    {"maxima", "maximum"},
    {"maximo", "maximum"},
    {"massima", "maximum"},
    {"massimo", "maximum"},
    {"cortocircuito", "shortcircuit"},
    {"curtocircuito", "shortcircuit"},
    {"corto", "shortcircuit"},
    {"circuito", "circuit"},
    {"punto", "point"},
    {"ponto", "point"},
    {"pico", "peak"},
    {"picco", "peak"},
    {"curto", "shortcircuit"},
    {"abierto", "opencircuit"},
    {"aperto", "opencircuit"},
    {"aberto", "opencircuit"},
    {"vuoto", "opencircuit"},
    {"vacio", "opencircuit"},
    {"vazio", "opencircuit"},
    {"numero", "number"},
    {"nombre", "number"},
    {"serie", "series"},
    {"oscuridad", "dark"},
    {"oscuro", "dark"},
    {"buio", "dark"},
    {"escuro", "dark"},
    {"iluminado", "lit"},
    {"iluminada", "lit"},
    {"illuminato", "lit"},
    {"illuminata", "lit"},
    {"tiempo", "time"},
    {"tempo", "time"},
    // Russian
    {"напряжение", "voltage"},
    {"напряжения", "voltage"},
    {"ток", "current"},
    {"тока", "current"},
    {"сила", ""},
    {"плотность", "density"},
    {"мощность", "power"},
    {"мощности", "power"},
    {"температура", "temperature"},
    {"ячейки", "cell"},
    {"элемента", "cell"},
    {"элементов", "cells"},
    {"модуля", "module"},
    {"панели", "panel"},
    {"ячеек", "cells"},
    {"число", "number"},
    {"количество", "number"},
    {"последовательно", "series"},
    {"воздуха", "air"},
    {"окружающей", "ambient"},
    {"облученность", "irradiance"},
    {"инсоляция", "irradiance"},
    {"энергетическая", ""},
    {"освещенность", "illuminance"},
    {"площадь", "area"},
    {"максимальная", "maximum"},
    {"максимальной", "maximum"},
    {"короткого", "shortcircuit"},
    {"замыкания", "circuit"},
    {"холостого", "opencircuit"},
    {"хода", "circuit"},
    {"кз", "shortcircuit"},
    {"хх", "opencircuit"},
    {"iкз", "isc"},
    {"uхх", "voc"},
    {"iмп", "imp"},
    {"iмпп", "imp"},
    {"iмм", "imp"},
    {"uмп", "vmp"},
    {"uмпп", "vmp"},
    {"uмм", "vmp"},
    {"pмп", "pmp"},
    {"pмпп", "pmp"},
    {"pмм", "pmp"},
    {"pмакс", "pmax"},
    {"макс", "maximum"},
    {"точке", "point"},
    {"тмм", "mpp"},
    {"тмпп", "mpp"},
    {"темновая", "dark"},
    {"темновой", "dark"},
    {"световая", "lit"},
    {"световой", "lit"},
    {"время", "time"},
    {"дата", "date"},
    {"в", "v"},
    {"мв", "mv"},
    {"кв", "kv"},
    {"а", "a"},
    {"ма", "ma"},
    {"мка", "ua"},
    {"вт", "w"},
    {"квт", "kw"},
    {"мвт", "mw"},
    {"м2", "m2"},
    {"см2", "cm2"},
    {"мм2", "mm2"},
    {"лк", "lux"},
    // Chinese, Japanese, Korean
    {"电压", "voltage"},
    {"電壓", "voltage"},
    {"電圧", "voltage"},
    {"전압", "voltage"},
    {"电流", "current"},
    {"電流", "current"},
    {"전류", "current"},
    {"密度", "density"},
    {"功率", "power"},
    {"出力", "power"},
    {"温度", "temperature"},
    {"溫度", "temperature"},
    {"온도", "temperature"},
    {"电池片", "cell"},
    {"电池", "cell"},
    {"電池", "cell"},
    {"セル", "cell"},
    {"セル数", "cells number"},
    {"セル枚数", "cells number"},
    {"电池片数", "cells number"},
    {"电池数", "cells number"},
    {"串联", "series"},
    {"直列", "series"},
    {"셀", "cell"},
    {"组件", "module"},
    {"組件", "module"},
    {"モジュール", "module"},
    {"모듈", "module"},
    {"背板", "backsheet"},
    {"环境", "ambient"},
    {"環境", "ambient"},
    {"周围", "ambient"},
    {"外気", "ambient"},
    {"辐照度", "irradiance"},
    {"輻照度", "irradiance"},
    {"辐照强度", "irradiance"},
    {"辐射强度", "irradiance"},
    {"辐射照度", "irradiance"},
    {"光强", "irradiance"},
    {"放射照度", "irradiance"},
    {"日射強度", "irradiance"},
    {"일사량", "irradiance"},
    {"照度", "illuminance"},
    {"面积", "area"},
    {"面積", "area"},
    {"면적", "area"},
    {"最大", "maximum"},
    {"点", "point"},
    {"點", "point"},
    {"短路", "shortcircuit"},
    {"短絡", "shortcircuit"},
    {"开路", "opencircuit"},
    {"峰值", "peak"},
    {"最佳", "maximum"},
    {"工作", ""},
    {"動作", ""},
    {"最大功率点", "mpp"},
    {"단락", "shortcircuit"},
    {"개방", "opencircuit"},
    {"최대", "maximum"},
    {"출력", "power"},
    {"開路", "opencircuit"},
    {"開放", "opencircuit"},
    {"暗", "dark"},
    {"暗态", "dark"},
    {"光照", "lit"},
    {"光态", "lit"},
    {"亮态", "lit"},
    {"光照度", "illuminance"},
    {"光照强度", "irradiance"},
    {"时间", "time"},
    {"時間", "time"},
    {"勒克斯", "lux"},
};

constexpr std::string_view kArticles[] = {
    "de",  "du", "des", "la",  "le", "l",  "d", "del", "della", "di", "da", "do", "dos",
    "das", "el", "der", "den", "im", "am", "a", "au",  "en",    "al", "в",  "при"};

// A character of a text and its code.
struct Letter {
  std::uint32_t code = 0;
  std::size_t length = 1;
};

Letter LetterAt(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (length == 1 || at + length > text.size()) return {lead, 1};
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    code = (code << 6U) | (static_cast<unsigned char>(text[at + i]) & 0x3FU);
  }
  return {code, length};
}

// Small Cyrillic letters, and Latin ones without their accents. Other text is kept.
std::string Fold(std::string_view word) {
  constexpr std::string_view kBase = "aaaaaaaceeeeiiiidnooooo*ouuuuyts";
  std::string folded;
  for (std::size_t at = 0; at < word.size();) {
    const Letter letter = LetterAt(word, at);
    std::uint32_t code = letter.code;
    if (letter.length == 2 && code >= 0xC0 && code <= 0xFF) {
      folded += kBase[(code - 0xC0) % kBase.size()];
    } else if (letter.length == 2 &&
               ((code >= 0x410 && code <= 0x42F) || code == 0x401 || code == 0x451)) {
      code = code < 0x410 || code > 0x42F ? 0x435 : code + 0x20;
      folded += static_cast<char>(0xC0U | (code >> 6U));
      folded += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
      folded.append(word, at, letter.length);
    }
    at += letter.length;
  }
  return folded;
}

// Whether words of the script of this character stand without blanks between them.
bool IsEastAsian(const Letter& letter) { return letter.length == 3 && letter.code >= 0x3040; }

const ForeignWord* FindForeignWord(std::string_view word) {
  static const auto* const kByWord = [] {
    auto* const terms = new std::unordered_map<std::string_view, const ForeignWord*>;
    for (const ForeignWord& term : kTerms) terms->emplace(term.word, &term);
    return terms;
  }();
  const auto found = kByWord->find(word);
  return found == kByWord->end() ? nullptr : found->second;
}

// The longest term that a word begins with; nullptr if there is none.
const ForeignWord* LongestForeignWord(std::string_view word) {
  const ForeignWord* longest = nullptr;
  for (const ForeignWord& term : kTerms) {
    const bool begins = word.substr(0, term.word.size()) == term.word;
    if (begins && (longest == nullptr || term.word.size() > longest->word.size())) longest = &term;
  }
  return longest;
}

// Appends the words of a term. The first has the original text.
void Append(const ForeignWord& term, std::string original, bool marked,
            std::vector<LabelWord>* words) {
  for (std::size_t at = 0; at < term.english.size();) {
    const std::size_t end = std::min(term.english.find(' ', at), term.english.size());
    words->push_back(
        {std::string(term.english.substr(at, end - at)), std::exchange(original, ""), marked});
    at = end + 1;
  }
}

// Appends a word of an East Asian script term by term. What is no term is a word of its own.
void AppendSplit(const LabelWord& word, std::vector<LabelWord>* words) {
  std::string unknown;
  const auto flush = [&] {
    if (!unknown.empty()) words->push_back({unknown, unknown, word.marked_as_unit});
    unknown.clear();
  };
  const std::string_view text = word.text;
  for (std::size_t at = 0; at < text.size();) {
    const Letter letter = LetterAt(text, at);
    const ForeignWord* term = IsEastAsian(letter) ? LongestForeignWord(text.substr(at)) : nullptr;
    if (term == nullptr) {
      unknown.append(text, at, letter.length);
      at += letter.length;
      continue;
    }
    flush();
    Append(*term, std::string(term->word), word.marked_as_unit, words);
    at += term->word.size();
  }
  flush();
}

}  // namespace

std::string HalfWidth(std::string_view text) {
  constexpr std::uint32_t kFirst = 0xFF01;
  constexpr std::uint32_t kLast = 0xFF5E;
  std::string ascii;
  for (std::size_t at = 0; at < text.size();) {
    const Letter letter = LetterAt(text, at);
    if (letter.code >= kFirst && letter.code <= kLast) {
      ascii += static_cast<char>(letter.code - kFirst + '!');
    } else if (letter.code == 0x3000) {
      ascii += ' ';
    } else {
      ascii.append(text, at, letter.length);
    }
    at += letter.length;
  }
  return ascii;
}

void Translate(std::vector<LabelWord>* words) {
  std::vector<LabelWord> english;
  std::vector<bool> article;
  bool any = false;
  for (const LabelWord& word : *words) {
    const std::string folded = Fold(word.text);
    const ForeignWord* term = FindForeignWord(folded);
    any = any || term != nullptr;
    if (term != nullptr) {
      Append(*term, word.original, word.marked_as_unit, &english);
    } else if (!word.text.empty() && IsEastAsian(LetterAt(word.text, 0))) {
      AppendSplit(word, &english);
    } else {
      english.push_back(word);
      english.back().text = folded;
    }
    article.resize(english.size(), std::find(std::begin(kArticles), std::end(kArticles), folded) !=
                                       std::end(kArticles));
  }
  words->clear();
  for (std::size_t i = 0; i < english.size(); ++i) {
    const bool inside = i + 1 < english.size() && !english[i + 1].marked_as_unit;
    const bool dropped = any && article[i] && inside && !english[i].marked_as_unit;
    if (!dropped) words->push_back(std::move(english[i]));
  }
}

}  // namespace lyrefit
