#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lyrefit {

// The lines of a module's .PAN file, to be changed one at a time.
class PanLines {
 public:
  explicit PanLines(std::vector<std::pair<std::string, std::string>> lines)
      : lines_(std::move(lines)) {}

  PanLines With(const std::string& key, const std::string& value) const {
    PanLines changed = *this;
    for (auto& line : changed.lines_) {
      if (line.first == key) line.second = value;
    }
    return changed;
  }

  PanLines Without(const std::string& key) const {
    PanLines changed({});
    for (const auto& line : lines_) {
      if (line.first != key) changed.lines_.push_back(line);
    }
    return changed;
  }

  std::string Text(const std::string& end = "\n") const {
    std::string text = "PVObject_=pvModule" + end;
    for (const auto& [key, value] : lines_) text += "  " + key + "=" + value + end;
    return text + "End of PVObject pvModule" + end;
  }

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

// An invented module of silicon; its first key stands in line 2, its values from column 3 on.
inline const PanLines kSiliconPan({{"Technol", "mtSiMono"},
                                   {"NCelS", "60"},
                                   {"GRef", "1000"},
                                   {"TRef", "25.0"},
                                   {"Isc", "9.740"},
                                   {"Voc", "39.90"},
                                   {"Imp", "9.192"},
                                   {"Vmp", "33.08"},
                                   {"muISC", "4.87"},
                                   {"muVocSpec", "-122.5"},
                                   {"muPmpReq", "-0.362"},
                                   {"RShunt", "400"},
                                   {"Rp_0", "2000"},
                                   {"Rp_Exp", "5.50"},
                                   {"RSerie", "0.218"},
                                   {"Gamma", "1.030"},
                                   {"muGamma", "-0.0004"}});

// An invented module of CdTe, with the recombination loss.
inline const PanLines kThinPan({{"Technol", "mtCdTe"},
                                {"NCelS", "108"},
                                {"GRef", "1000"},
                                {"TRef", "25.0"},
                                {"Isc", "1.800"},
                                {"Voc", "88.00"},
                                {"Imp", "1.640"},
                                {"Vmp", "70.40"},
                                {"muISC", "0.72"},
                                {"muVocSpec", "0.0"},
                                {"muPmpReq", "-0.341"},
                                {"RShunt", "7500"},
                                {"Rp_0", "15000"},
                                {"Rp_Exp", "4.00"},
                                {"RSerie", "4.000"},
                                {"Gamma", "1.500"},
                                {"muGamma", "0.0011"},
                                {"D2MuTau", "0.300"}});

}  // namespace lyrefit
