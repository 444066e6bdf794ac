#include "lyrefit/read/column_names.h"

namespace lyrefit {
namespace {

constexpr ColumnName kNames[] = {
    {"v", ColumnKind::kVoltage},
    {"u", ColumnKind::kVoltage},
    {"voltage", ColumnKind::kVoltage},
    {"voltages", ColumnKind::kVoltage},
    {"potential", ColumnKind::kVoltage},
    {"ewe", ColumnKind::kVoltage},  // working electrode
    {"vf", ColumnKind::kVoltage},   // "full", the measured voltage of potentiostats
    {"vm", ColumnKind::kVoltage},
    {"i", ColumnKind::kCurrent},
    {"im", ColumnKind::kCurrent},
    {"current", ColumnKind::kCurrent},
    {"currents", ColumnKind::kCurrent},
    {"amperage", ColumnKind::kCurrent},  // "intensité", which may also be one of light
    {"sigma", ColumnKind::kSigma},
    {"sigmai", ColumnKind::kSigma},
    {"currentsigma", ColumnKind::kSigma},
    {"sigmacurrent", ColumnKind::kSigma},
    {"uncertainty", ColumnKind::kSigma},
    {"currentuncertainty", ColumnKind::kSigma},
    {"time", ColumnKind::kTime},
    {"elapsedtime", ColumnKind::kTime},
    {"t", ColumnKind::kTime},
    {"sweep", ColumnKind::kSweep},
    {"scan", ColumnKind::kSweep},
    {"direction", ColumnKind::kSweep},
    {"scandirection", ColumnKind::kSweep},
    {"sweepdirection", ColumnKind::kSweep},
    {"curve", ColumnKind::kCurve},
    {"irradiance", ColumnKind::kIrradiance},
    {"irr", ColumnKind::kIrradiance},
    {"irrad", ColumnKind::kIrradiance},
    {"effectiveirradiance", ColumnKind::kIrradiance},
    {"illuminance", ColumnKind::kIrradiance},
    {"intensity", ColumnKind::kIrradiance},
    {"g", ColumnKind::kIrradiance},
    {"poa", ColumnKind::kIrradiance},
    {"poairradiance", ColumnKind::kIrradiance},
    {"irradiancepoa", ColumnKind::kIrradiance},
    {"temperature", ColumnKind::kTemperature},
    {"temp", ColumnKind::kTemperature},
    {"tcell", ColumnKind::kTemperature},
    {"tc", ColumnKind::kTemperature},
    {"tmodule", ColumnKind::kTemperature},
    {"modt", ColumnKind::kTemperature},
    {"j", ColumnKind::kCurrentDensity},
    {"currentdensity", ColumnKind::kCurrentDensity},
};

// Words that say where a quantity was measured, not which one. A single letter may carry them:
// "Vmeas", "Idc".
constexpr std::string_view kQualifiers[] = {
    "pv",  "module",    "cell",  "panel",    "array", "string",   "load",   "bias",
    "dut", "device",    "anode", "measured", "meas",  "dc",       "output", "in",
    "opc", "electrode", "we",    "smu",      "corr",  "corrected"};

// Words that a number makes one of several: "Ch2 voltage", "PV1 current".
constexpr std::string_view kChannels[] = {"ch",     "channel", "px",   "pixel", "pv",
                                          "string", "str",     "mppt", "input"};

bool IsDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

const ColumnName* FindName(std::string_view text) {
  for (const ColumnName& name : kNames) {
    if (name.text == text) return &name;
  }
  return nullptr;
}

void DropQualifiers(std::vector<LabelWord>* words) {
  if (words->size() < 2) return;
  std::vector<LabelWord> kept;
  for (const LabelWord& word : *words) {
    if (!IsAmong(kQualifiers, word.text)) kept.push_back(word);
  }
  if (!kept.empty()) *words = kept;
}

void CutQualifierOffLetter(LabelWord* word) {
  if (word->text.size() < 3 || FindName(word->text) != nullptr) return;
  const ColumnName* letter = FindName(word->text.substr(0, 1));
  if (letter == nullptr || !IsElectrical(letter->kind)) return;
  if (IsAmong(kQualifiers, std::string_view(word->text).substr(1))) word->text.resize(1);
}

std::string TakeNumber(std::vector<LabelWord>* words) {
  std::string number;
  const auto add = [&number](std::string_view digits) {
    if (!number.empty()) number += '.';
    number += digits;
  };
  std::vector<LabelWord> kept;
  for (LabelWord word : *words) {
    const bool of_a_unit = !kept.empty() && (kept.back().text == "cm" || kept.back().text == "m" ||
                                             kept.back().text == "mm");
    if (IsDigits(word.text) && !of_a_unit) {
      add(word.text);
      continue;
    }
    const std::size_t letters = word.text.find_last_not_of("0123456789") + 1;
    LabelWord cut = {word.text.substr(0, letters), "", false};
    CutQualifierOffLetter(&cut);  // "vpv1" is a "v" with a number
    const std::string front = cut.text;
    const bool channel = IsAmong(kChannels, front);
    const ColumnName* name = FindName(front);
    const bool named = name != nullptr && IsElectrical(name->kind);
    if (letters < word.text.size() && (named || channel)) {
      add(std::string_view(word.text).substr(letters));
      word.text = front;
    }
    if (!channel) kept.push_back(word);
  }
  if (kept.empty()) return "";
  *words = kept;
  return number;
}

}  // namespace lyrefit
