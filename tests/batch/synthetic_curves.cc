#include "batch/synthetic_curves.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "faults/random.h"

namespace made {
namespace {

using faults::Random;

constexpr double kThermalVoltPerK = 8.617333262e-5;

// Single-diode model over the junction voltage, with the open-circuit voltage as a parameter.
struct Diode {
  double photocurrent_A;
  double open_circuit_V;
  double scale_V;  // cells times ideality times thermal voltage
  double series_ohm;
  double shunt_ohm;

  double Current(double junction_V) const {
    const double at_open_circuit = photocurrent_A - open_circuit_V / shunt_ohm;
    const double rise = std::expm1(junction_V / scale_V) / std::expm1(open_circuit_V / scale_V);
    return photocurrent_A - junction_V / shunt_ohm - at_open_circuit * rise;
  }
};

struct Row {
  std::string id;
  std::string date;
  double irradiance_Wm2 = 0;
  double temperature_C = 0;
  int cells = 60;
  double rated_power_W = 0;
  std::vector<double> voltage_V;
  std::vector<double> current_A;
};

// The row as text. A break changes either the row, before it becomes text, or this text.
struct RowText {
  std::string id, voltage, current;
  bool has_id = true, has_current = true, cut = false;
};

struct Break {
  const char* name;
  const char* fate;
  void (*row)(Random* random, const std::string& id_before, Row* row);
  void (*text)(Random* random, Shape shape, RowText* text);
};

void Append(std::string* text, double value, int digits) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits);
  text->append(buffer, end.ptr);
}

std::string Numbered(const char* word, std::int64_t number, int digits) {
  std::string text = std::to_string(number);
  if (static_cast<int>(text.size()) < digits) text.insert(0, digits - text.size(), '0');
  return word + text;
}

std::string IdOf(std::int64_t place) {
  const std::int64_t combiner = place / 24;
  const std::int64_t inverter = combiner / 20;
  return Numbered("site", inverter / 10 + 1, 3) + Numbered("/inv", inverter % 10 + 1, 2) +
         Numbered("/comb", combiner % 20 + 1, 2) + Numbered("/str", place % 24 + 1, 2);
}

double LargestPower(const Diode& diode) {
  double largest = 0;
  for (int i = 0; i <= 200; ++i) {
    const double junction_V = diode.open_circuit_V * (0.6 + 0.002 * i);
    const double current_A = diode.Current(junction_V);
    largest = std::max(largest, current_A * (junction_V - current_A * diode.series_ohm));
  }
  return largest;
}

Row DrawRow(std::int64_t place, const CurvesRequest& request, Random* random) {
  constexpr int kCells[] = {36, 60, 60, 72, 72, 96};
  Row row;
  row.id = IdOf(place);
  row.date = Numbered("2026-", random->Index(12) + 1, 2) + Numbered("-", random->Index(28) + 1, 2);
  row.cells = kCells[random->Index(6)];
  row.irradiance_Wm2 = std::round(random->Uniform(200, 1100));
  row.temperature_C = std::round(10 * random->Uniform(10, 70)) / 10;

  const double ideality = random->Uniform(1.0, 1.4);
  const double cell_V = random->Uniform(0.61, 0.72);
  const double suns = row.irradiance_Wm2 / 1000;
  Diode diode;
  diode.photocurrent_A = random->Uniform(5, 13);
  diode.open_circuit_V = row.cells * cell_V;
  diode.scale_V = row.cells * ideality * kThermalVoltPerK * 298.15;
  diode.series_ohm = row.cells * random->LogUniform(0.02, 0.06) / diode.photocurrent_A;
  diode.shunt_ohm = row.cells * random->LogUniform(10, 400) / diode.photocurrent_A;
  row.rated_power_W = 5 * std::floor(LargestPower(diode) / 5);

  const double warmer_K = row.temperature_C - 25;
  diode.photocurrent_A *= suns * (1 + 5e-4 * warmer_K);
  diode.scale_V *= (298.15 + warmer_K) / 298.15;
  diode.open_circuit_V +=
      diode.scale_V * std::log(suns) + row.cells * warmer_K * (cell_V - 1.25) / 298.15;
  diode.shunt_ohm /= suns;

  const double noise = random->LogUniform(2e-4, 2e-3);
  const double first_V = diode.photocurrent_A * diode.series_ohm;
  for (int i = 0; i < request.points; ++i) {
    const double part = request.points > 1 ? i / (request.points - 1.0) : 0;
    const double junction_V = first_V + (diode.open_circuit_V - first_V) * part;
    const double exact_A = diode.Current(junction_V);
    row.voltage_V.push_back(junction_V - exact_A * diode.series_ohm);
    row.current_A.push_back(exact_A + noise * diode.photocurrent_A * random->Normal());
  }
  return row;
}

std::string ListOf(const std::vector<double>& values, Shape shape) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += shape == Shape::kCsv ? " " : ", ";
    Append(&text, value, 4);
  }
  return text;
}

// Replaces one number of the list by a word.
void ReplaceSome(Random* random, const char* word, std::string* list) {
  const std::size_t begin =
      list->find(' ', static_cast<std::size_t>(random->Uniform(0, 0.9 * list->size())));
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(list->find_first_of(", ", begin + 1), list->size());
  list->replace(begin + 1, end - begin - 1, word);
}

void ReplaceAll(const char* word, Shape shape, std::string* list) {
  std::string words;
  for (std::size_t at = 0; at != std::string::npos; at = list->find(' ', at + 1)) {
    if (!words.empty()) words += shape == Shape::kCsv ? " " : ", ";
    words += word;
  }
  *list = words;
}

constexpr Break kBreaks[] = {
    {"nan", "refused", nullptr,
     [](Random*, Shape shape, RowText* text) { ReplaceAll("NaN", shape, &text->current); }},
    {"empty", "refused",
     [](Random*, const std::string&, Row* row) {
       row->voltage_V.clear();
       row->current_A.clear();
     },
     nullptr},
    {"one_point", "refused",
     [](Random*, const std::string&, Row* row) {
       row->voltage_V.resize(1);
       row->current_A.resize(1);
     },
     nullptr},
    {"unequal_lengths", "refused",
     [](Random* random, const std::string&, Row* row) {
       row->current_A.resize(row->current_A.size() - 1 - random->Index(5));
     },
     nullptr},
    {"text", "refused", nullptr,
     [](Random* random, Shape shape, RowText* text) {
       ReplaceSome(random, shape == Shape::kCsv ? "OVERLOAD" : "\"OVERLOAD\"", &text->current);
     }},
    {"cut", "refused", nullptr, [](Random*, Shape, RowText* text) { text->cut = true; }},
    {"milliampere", "told",
     [](Random*, const std::string&, Row* row) {
       for (double& current : row->current_A) current *= 1000;
     },
     nullptr},
    {"zero_current", "refused",
     [](Random*, const std::string&, Row* row) {
       for (double& current : row->current_A) current = 0;
     },
     nullptr},
    {"duplicated_id", "told",
     [](Random*, const std::string& id_before, Row* row) { row->id = id_before; }, nullptr},
    {"no_id", "told", nullptr, [](Random*, Shape, RowText* text) { text->has_id = false; }},
    {"missing_current", "refused", nullptr,
     [](Random*, Shape, RowText* text) { text->has_current = false; }},
    {"kelvin", "refused",
     [](Random*, const std::string&, Row* row) { row->temperature_C += 273.15; }, nullptr},
};

std::string JsonRow(const Row& row, const RowText& text) {
  std::string line = "{";
  if (text.has_id) line += "\"id\": \"" + text.id + "\", ";
  line += "\"date\": \"" + row.date + "\", \"irradiance_Wm2\": ";
  Append(&line, row.irradiance_Wm2, 0);
  line += ", \"temperature_C\": ";
  Append(&line, row.temperature_C, 1);
  line += ", \"cells_in_series\": " + std::to_string(row.cells) + ", \"rated_power_W\": ";
  Append(&line, row.rated_power_W, 0);
  line += ", \"voltage_V\": [" + text.voltage + "]";
  if (text.has_current) line += ", \"current_A\": [" + text.current + "]";
  return line + "}";
}

constexpr const char* kHead =
    "id,date,irradiance_Wm2,temperature_C,cells_in_series,rated_power_W,voltage_V,current_A\n";

std::string CsvRow(const Row& row, const RowText& text) {
  std::string line = (text.has_id ? text.id : "") + "," + row.date + ",";
  Append(&line, row.irradiance_Wm2, 0);
  line += ",";
  Append(&line, row.temperature_C, 1);
  line += "," + std::to_string(row.cells) + ",";
  Append(&line, row.rated_power_W, 0);
  line += "," + text.voltage + ",";
  if (text.has_current) line += text.current;
  return line;
}

struct Line {
  std::string text, id;
  std::string how, fate;  // empty: an unchanged row
};

Line LineOf(std::int64_t place, const CurvesRequest& request) {
  Random random(faults::SeedOf(request.seed, place));
  const bool broken = place > 0 && random.Chance(request.broken);
  const bool reversed = !broken && random.Chance(request.reversed);
  const Break* how = broken ? &kBreaks[random.Index(std::size(kBreaks))] : nullptr;
  Row row = DrawRow(place, request, &random);
  if (reversed) {
    row.voltage_V = {row.voltage_V.rbegin(), row.voltage_V.rend()};
    row.current_A = {row.current_A.rbegin(), row.current_A.rend()};
  }
  if (how != nullptr && how->row != nullptr) how->row(&random, IdOf(place - 1), &row);
  RowText text;
  text.id = row.id;
  text.voltage = ListOf(row.voltage_V, request.shape);
  text.current = ListOf(row.current_A, request.shape);
  if (how != nullptr && how->text != nullptr) how->text(&random, request.shape, &text);
  Line line;
  line.text = request.shape == Shape::kCsv ? CsvRow(row, text) : JsonRow(row, text);
  if (text.cut)
    line.text.resize(static_cast<std::size_t>(line.text.size() * random.Uniform(.4, .9)));
  if (text.has_id) line.id = row.id;
  if (how != nullptr) line.how = how->name, line.fate = how->fate;
  if (reversed) line.how = "reversed", line.fate = "read";
  return line;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

bool Put(const std::string& text, std::FILE* file) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size();
}

}  // namespace

std::string WriteCurves(const CurvesRequest& request) {
  const File out(std::fopen(request.out.c_str(), "wb"));
  if (!out) return "cannot write " + request.out;
  const File truth(request.truth.empty() ? nullptr : std::fopen(request.truth.c_str(), "wb"));
  if (!truth && !request.truth.empty()) return "cannot write " + request.truth;
  const int head_lines = request.shape == Shape::kCsv ? 1 : 0;
  bool good = head_lines == 0 || Put(kHead, out.get());
  if (truth) good = Put("line,id,how,fate\n", truth.get()) && good;
  for (std::int64_t place = 0; place < request.count && good; ++place) {
    const Line line = LineOf(place, request);
    good = Put(line.text + "\n", out.get());
    if (!truth || line.how.empty()) continue;
    good = good && Put(std::to_string(place + 1 + head_lines) + "," + line.id + "," + line.how +
                           "," + line.fate + "\n",
                       truth.get());
  }
  good = std::fflush(out.get()) == 0 && good;
  return good ? "" : "cannot write all of " + request.out;
}

}  // namespace made
