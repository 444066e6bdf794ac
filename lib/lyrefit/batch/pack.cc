#include "lyrefit/batch/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "lyrefit/base/new_file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/write_curve.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/stream/row_curve.h"

namespace lyrefit {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kBatch = 1024;  // number of curves read at once
constexpr std::size_t kBatchBytes = 32U << 20;

// Conditions and notes as keys of a row.
ordered_json StatedOf(const IvCurve& curve) {
  const ordered_json sidecar = ordered_json::parse(CurveSidecarJson(curve), nullptr, false);
  ordered_json stated = ordered_json::object();
  if (curve.irradiance_known) stated["irradiance_W_m2"] = sidecar["nominal_irradiance_Wm2"];
  if (curve.temperature_known) stated["cell_temperature_C"] = sidecar["nominal_temperature_C"];
  if (curve.cells_known) stated["cells_in_series"] = curve.conditions.cells_in_series;
  if (curve.strings_known) stated["strings_in_parallel"] = curve.conditions.strings_in_parallel;
  for (const auto& [key, value] : sidecar.items()) {
    const bool condition = key == "name" || key == "cells_in_series" ||
                           key == "strings_in_parallel" || key.rfind("nominal_", 0) == 0;
    if (condition) continue;
    if (key != "current_noise") {
      stated[key] = value;
      continue;
    }
    for (const auto& [part, number] : value.items()) stated["current_noise_" + part] = number;
  }
  return stated;
}

// True if `text` is a number in JSON notation, which is written unchanged.
bool IsJsonNumber(const std::string& text) {
  const bool digits = !text.empty() && (text[0] == '-' || (text[0] >= '0' && text[0] <= '9'));
  return digits && ordered_json::accept(text) &&
         std::isfinite(ParseNumber(text).value_or(kUnknown));
}

std::string TextOf(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// A sequence of JSON members, "key": value.
class Members {
 public:
  void Add(const std::string& key, std::string_view value) {
    text_ += text_.empty() ? "" : ", ";
    text_ += TextOf(key);
    text_ += ": ";
    text_ += value;
  }
  template <class T>
  void AddList(const std::string& key, const std::vector<T>& values) {
    std::string list = "[";
    // Without a precision, fmt writes the shortest text that restores the same bits.
    for (std::size_t i = 0; i < values.size(); ++i) {
      fmt::format_to(std::back_inserter(list), "{}{}", i == 0 ? "" : ",", values[i]);
    }
    Add(key, list + "]");
  }
  bool empty() const { return text_.empty(); }
  std::string Object() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

void AddBeside(const BatchCurve& curve, const ordered_json& stated, Members* members) {
  for (const auto& [name, text] : curve.beside) {
    const bool taken = stated.contains(name) || name == "id" || name == "error" ||
                       name == "assumptions" || name == "more";
    if (!taken) members->Add(name, IsJsonNumber(text) ? text : TextOf(text));
  }
}

// Adds the lists other than voltage and current, and the assumptions.
void AddFurther(const IvCurve& curve, Members* members) {
  const std::pair<const char*, const std::vector<double>*> lists[] = {
      {"sigma_A", &curve.sigma_A},
      {"time_s", &curve.time_s},
      {"irradiance_Wm2", &curve.irradiance_W_m2},
      {"temperature_C", &curve.temperature_C}};
  for (const auto& [name, values] : lists) {
    if (!values->empty()) members->AddList(name, *values);
  }
  if (!curve.sweep.empty()) members->AddList("sweep", curve.sweep);
  ordered_json assumptions = ordered_json::array();
  for (const Assumption& assumption : curve.assumptions) {
    if (assumption.about == About::kReading) assumptions.push_back(assumption.sentence);
  }
  if (!assumptions.empty()) members->Add("assumptions", TextOf(assumptions));
}

const char* VoltageName(const IvCurve& curve) {
  return curve.voltage_unit_known ? "voltage_V" : "voltage";
}
const char* CurrentName(const IvCurve& curve) {
  return curve.current_unit_known ? "current_A" : "current";
}

// The original reason, if the row was already broken when it was packed before.
std::string PackedReason(const Error& error) {
  if (error.message.rfind(kPackedAsBroken, 0) != 0) return error.ToString();
  return error.message.substr(kPackedAsBroken.size());
}

std::string JsonRow(const BatchCurve& curve) {
  Members members;
  members.Add("id", TextOf(curve.id));
  if (!curve.curve) {
    AddBeside(curve, {}, &members);
    members.Add("error", TextOf(PackedReason(curve.curve.error())));
    return members.Object() + "\n";
  }
  const ordered_json stated = StatedOf(*curve.curve);
  for (const auto& [key, value] : stated.items()) members.Add(key, TextOf(value));
  AddBeside(curve, stated, &members);
  members.AddList(VoltageName(*curve.curve), curve.curve->voltage_V);
  members.AddList(CurrentName(*curve.curve), curve.curve->current_A);
  AddFurther(*curve.curve, &members);
  return members.Object() + "\n";
}

std::string ListText(const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, " "));
}

constexpr const char* kCsvColumns[] = {"irradiance_W_m2", "cell_temperature_C", "cells_in_series"};

std::string CsvRow(const BatchCurve& curve) {
  std::vector<std::string> fields = {CsvField(curve.id)};
  Members more;
  ordered_json stated = ordered_json::object();
  if (curve.curve) stated = StatedOf(*curve.curve);
  for (const char* column : kCsvColumns) {
    fields.push_back(stated.contains(column) ? TextOf(stated[column]) : "");
  }
  for (const auto& [key, value] : stated.items()) {
    if (std::find(std::begin(kCsvColumns), std::end(kCsvColumns), key) == std::end(kCsvColumns)) {
      more.Add(key, TextOf(value));
    }
  }
  AddBeside(curve, stated, &more);
  fields.resize(fields.size() + 2);
  if (!curve.curve) {
    more.Add("error", TextOf(PackedReason(curve.curve.error())));
  } else {
    const IvCurve& one = *curve.curve;
    std::string* const lists = &fields[fields.size() - 2];
    // The header names units, so lists with unknown units go into the column `more`.
    if (one.voltage_unit_known && one.current_unit_known) {
      lists[0] = ListText(one.voltage_V);
      lists[1] = ListText(one.current_A);
    } else {
      more.AddList(VoltageName(one), one.voltage_V);
      more.AddList(CurrentName(one), one.current_A);
    }
    AddFurther(one, &more);
  }
  fields.push_back(more.empty() ? "" : CsvField(more.Object()));
  return CsvLine(fields);
}

// The next curves of the source, about a thousand of them or some megabytes.
Expected<std::vector<BatchItem>> NextBatch(BatchSource* source) {
  std::vector<BatchItem> items;
  std::size_t bytes = 0;
  while (items.size() < kBatch && bytes < kBatchBytes) {
    TRY(auto item, source->Next());
    if (!item) break;
    bytes += item->bytes.size();
    items.push_back(std::move(*item));
  }
  return items;
}

}  // namespace

std::string PackedRow(const BatchCurve& curve, PackFormat format) {
  return format == PackFormat::kCsv ? CsvRow(curve) : JsonRow(curve);
}

Expected<PackReport> PackBatch(BatchSource* source, PackFormat format, int threads,
                               const PackSink& sink, const Observer& observer) {
  PackReport report;
  if (format == PackFormat::kCsv) {
    std::string header = "id";
    for (const char* column : kCsvColumns) header += std::string(",") + column;
    TRY(sink(header + ",voltage_V,current_A,more\n"));
  }
  Progress progress;
  progress.stage = "pack";
  for (;;) {
    TRY(const std::vector<BatchItem> items, NextBatch(source));
    if (items.empty()) return report;
    std::vector<std::string> rows(items.size());
    std::vector<std::string> errors(items.size());
    ParallelFor(static_cast<int>(items.size()), threads, [&](int i) {
      const BatchCurve curve = source->Read(items[i]);
      rows[i] = PackedRow(curve, format);
      if (!curve.curve) errors[i] = curve.curve.error().ToString();
    });
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text += rows[i];
      ++report.curves;
      if (errors[i].empty()) continue;
      ++report.broken;
      if (report.first_error.empty()) report.first_error = errors[i];
    }
    TRY(sink(text));
    progress.iteration = report.curves;
    const std::int64_t size = source->size();
    if (size > 0) {
      progress.part = static_cast<double>(items.back().end) / static_cast<double>(size);
    }
    report.interrupted = StopRequested(observer, progress);
    if (report.interrupted) return report;
  }
}

Expected<PackReport> PackBatchInto(const std::string& file, BatchSource* source, PackFormat format,
                                   int threads, const Observer& observer) {
  NewFile packed(file);
  TRY(packed.Begin());
  TRY(const PackReport report,
      PackBatch(
          source, format, threads, [&packed](std::string_view text) { return packed.Write(text); },
          observer));
  if (report.interrupted) return report;
  TRY(packed.Commit());
  return report;
}

}  // namespace lyrefit
