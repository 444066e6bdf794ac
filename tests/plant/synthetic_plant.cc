#include "plant/synthetic_plant.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "faults/for_each.h"
#include "faults/random.h"
#include "plant/synthetic_strings.h"

namespace made {
namespace {

using faults::Random;
using faults::SeedOf;

double RatedPower() { return 5 * std::floor(ModuleAt(1, 25).pmax() / 5); }

// Indices of the strings with a fault, in the order of PlantFaults.
std::vector<int> HiddenPlaces(const PlantRequest& request) {
  Random random(SeedOf(request.seed, 2'000'000));
  std::vector<int> places;
  const int faults = static_cast<int>(PlantFaults().size());
  while (static_cast<int>(places.size()) < std::min(faults, request.strings / 4)) {
    const int place = random.Index(request.strings);
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  return places;
}

// The strings of the first campaign in their order.
std::vector<Slot> FirstSlots(const PlantRequest& request) {
  std::vector<Slot> slots;
  for (int place = 0; place < request.strings; ++place)
    slots.push_back({place, place, IdOf(place)});
  const std::vector<int> hidden = HiddenPlaces(request);
  for (std::size_t k = 0; k < hidden.size(); ++k) slots[hidden[k]].fault = &PlantFaults()[k];
  return slots;
}

// The place of a string without fault and change.
int FreePlace(const std::vector<Slot>& slots, Random* random) {
  for (;;) {
    const int place = random->Index(static_cast<int>(slots.size()));
    if (slots[place].fault == nullptr && slots[place].change == nullptr) return place;
  }
}

int PlaceOfFault(const std::vector<Slot>& slots, const std::string& name) {
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (slots[k].fault != nullptr && slots[k].fault->name == name) return static_cast<int>(k);
  }
  return -1;
}

// The strings of a later campaign: those of the first with PlantChanges(). A plant of few strings
// has no string with some of the faults, and so not all changes.
std::vector<Slot> LaterSlots(const PlantRequest& request) {
  std::vector<Slot> slots = FirstSlots(request);
  Random random(SeedOf(request.seed, 5'000'000));
  for (const PlantChange& change : PlantChanges()) {
    const int ill = change.fault == nullptr ? -1 : PlaceOfFault(slots, change.fault);
    if (change.fault != nullptr && ill < 0) continue;
    int place = change.of == ChangeOf::kRepair ? ill : FreePlace(slots, &random);
    // Cables and labels are exchanged within a combiner.
    const auto combiner = [](int at) { return at / kStringsOfCombiner; };
    while (change.of == ChangeOf::kExchange && combiner(place) != combiner(ill)) {
      place = FreePlace(slots, &random);
    }
    Slot& slot = slots[place];
    slot.change = &change;
    if (change.of == ChangeOf::kName) slot.id += "b", slot.partner = IdOf(place);
    if (change.of != ChangeOf::kExchange) continue;
    Slot& other = slots[ill];
    other.change = &change;
    std::swap(slot.who, other.who);
    std::swap(slot.fault, other.fault);
    slot.partner = other.id;
    other.partner = slot.id;
  }
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (slots[k].change == nullptr || slots[k].change->of != ChangeOf::kNew) continue;
    // Modules of its own at the end of the combiner.
    const int last =
        static_cast<int>(k) / kStringsOfCombiner * kStringsOfCombiner + kStringsOfCombiner - 1;
    const int after = std::min(last, static_cast<int>(slots.size()) - 1);
    Slot added{request.strings + 1000, after, IdOf(after) + "-2"};
    added.change = slots[k].change;
    slots[k].change = nullptr;
    slots.insert(slots.begin() + after + 1, added);
    break;
  }
  return slots;
}

bool IsMeasured(const Slot& slot) {
  return slot.change == nullptr || slot.change->of != ChangeOf::kGone;
}

std::vector<Strung> MeasureAll(const PlantRequest& request, const std::vector<Slot>& slots) {
  std::vector<Strung> strings(slots.size());
  faults::ForEach(static_cast<int>(slots.size()), request.threads,
                  [&](int i) { strings[i] = Measure(slots[i], request); });
  return strings;
}

std::string ListOf(const std::vector<double>& values, const char* format) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, format, value);
    text += buffer;
  }
  return text;
}

constexpr int kCells = kModules * kCellsOfModule;
constexpr int kDiodes = kModules * kGroupsOfModule;

std::string Packed(const std::vector<Strung>& strings, double rated_W) {
  std::string text =
      "id,date,irradiance_Wm2,temperature_C,cells_in_series,bypass_diodes,rated_power_W,voltage_V,"
      "current_A\n";
  for (const Strung& one : strings) {
    text += Text("%s,%s,%.0f,%.1f,%d,%d,%.0f,", one.id.c_str(), one.date.c_str(),
                 one.irradiance_Wm2, one.temperature_C, kCells, kDiodes, kModules * rated_W);
    text +=
        ListOf(one.readings.voltage, "%.2f") + "," + ListOf(one.readings.current, "%.3f") + "\n";
  }
  return text;
}

std::string Trace(const Strung& one) {
  std::string text = Text(
      "String tracer,\nDate,%s\nMeasured Irradiance (W/m^2),%.0f\nMeasured Cell Temp (C),%.1f\n"
      "Number of cells,%d\n\nVoltage (V),Current (A)\n",
      one.date.c_str(), one.irradiance_Wm2, one.temperature_C, kCells);
  for (std::size_t k = 0; k < one.readings.voltage.size(); ++k) {
    text += Text("%.2f,%.3f\n", one.readings.voltage[k], one.readings.current[k]);
  }
  return text;
}

std::string FaultTruth(const std::vector<Strung>& strings, const std::vector<Slot>& slots) {
  std::string text = "id,fault,accepted,shows_in,loss_percent,words\n";
  for (const PlantFault& fault : PlantFaults()) {
    for (std::size_t k = 0; k < slots.size(); ++k) {
      if (slots[k].fault != &fault) continue;
      text += Text("%s,%s,%s,%s,%.2f,%s\n", slots[k].id.c_str(), fault.name, fault.accepted,
                   fault.shows_in, strings[k].loss_percent, fault.words);
    }
  }
  return text;
}

// Power in W at standard conditions that the string of this name lost by its change.
double LostPower(const Slot& slot, const std::vector<Slot>& first, const PlantRequest& request) {
  if (slot.change->of == ChangeOf::kGone || slot.change->of == ChangeOf::kNew) return 0;
  Slot before = first[slot.where];
  before.change = nullptr;
  return StandardPower(before, request) - StandardPower(slot, request);
}

std::string ChangeTruth(const std::vector<Slot>& slots, const PlantRequest& request) {
  const std::vector<Slot> first = FirstSlots(request);
  std::vector<std::string> lines(slots.size());
  faults::ForEach(static_cast<int>(slots.size()), request.threads, [&](int k) {
    const Slot& slot = slots[k];
    if (slot.change == nullptr) return;
    lines[k] =
        Text("%s,%s,%s,%s,%.1f,%s\n", slot.id.c_str(), slot.change->name, slot.change->accepted,
             slot.partner.c_str(), LostPower(slot, first, request), slot.change->words);
  });
  std::string text = "id,change,accepted,partner,lost_W,words\n";
  for (const std::string& line : lines) text += line;
  return text;
}

// Data sheet of one module as JSON, with temperature coefficients between 25 and 50 C.
std::string ModuleJson(double rated_W) {
  const KeyPoints cool = ModuleAt(1, 25), warm = ModuleAt(1, 50);
  const auto percent = [](double one, double other) { return 100 * (other / one - 1) / 25; };
  return Text(
             "{\n  \"name\": \"Elm 60\",\n  \"technology\": \"mono-Si\",\n"
             "  \"cells_in_series\": %d,\n  \"bypass_diodes\": %d,\n  \"modules_in_series\": %d,\n"
             "  \"rated_power_W\": %.0f,\n  \"short_circuit_current_A\": %.2f,\n"
             "  \"open_circuit_voltage_V\": %.1f,\n  \"max_power_current_A\": %.2f,\n"
             "  \"max_power_voltage_V\": %.1f,\n",
             kCellsOfModule, kGroupsOfModule, kModules, rated_W, cool.isc, cool.voc, cool.imp,
             cool.vmp) +
         Text(
             "  \"alpha_sc_percent_K\": %.3f,\n  \"beta_oc_percent_K\": %.3f,\n"
             "  \"gamma_pmp_percent_K\": %.3f\n}\n",
             percent(cool.isc, warm.isc), percent(cool.voc, warm.voc),
             percent(cool.pmax(), warm.pmax()));
}

std::string Write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  return file ? "" : "cannot write " + path;
}

std::string WriteTree(const PlantRequest& request, const std::vector<Strung>& strings) {
  for (const Strung& one : strings) {
    const std::filesystem::path path = std::filesystem::path(request.tree) / one.id;
    std::error_code failed;
    std::filesystem::create_directories(path.parent_path(), failed);
    std::string error = Write(path.string() + ".csv", Trace(one));
    if (error.empty() && request.sidecars) {
      error = Write(path.string() + ".json",
                    Text("{\"cells_in_series\": %d, \"bypass_diodes\": %d}\n", kCells, kDiodes));
    }
    if (!error.empty()) return error;
  }
  return "";
}

}  // namespace

std::string WritePlant(const PlantRequest& request) {
  constexpr int kLeastLater = 50;  // there is a place for every change
  if (request.years > 0 && request.strings < kLeastLater) return "--years needs 50 strings or more";
  const double rated_W = RatedPower();
  const std::vector<Slot> slots = request.years == 0 ? FirstSlots(request) : LaterSlots(request);
  std::vector<Slot> measured;
  std::copy_if(slots.begin(), slots.end(), std::back_inserter(measured), IsMeasured);
  const std::vector<Strung> strings = MeasureAll(request, measured);
  std::string error;
  const auto write = [&](const std::string& path, const auto& text) {
    if (error.empty() && !path.empty()) error = Write(path, text());
  };
  write(request.packed, [&] { return Packed(strings, rated_W); });
  write(request.truth, [&] {
    return request.years == 0 ? FaultTruth(strings, slots) : ChangeTruth(slots, request);
  });
  write(request.module, [&] { return ModuleJson(rated_W); });
  if (error.empty() && !request.tree.empty()) error = WriteTree(request, strings);
  return error;
}

}  // namespace made
