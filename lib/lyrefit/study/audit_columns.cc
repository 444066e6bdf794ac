#include "lyrefit/study/audit_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

struct Unit {
  const char* name;  // in lower case
  double factor;
};
constexpr Unit kAmpere[] = {{"a", 1},     {"ma", 1e-3},      {"ua", 1e-6},
                            {"na", 1e-9}, {"\u00b5a", 1e-6}, {"\u03bca", 1e-6}};
constexpr Unit kOhm[] = {{"ohm", 1}, {"mohm", 1e-3}, {"100ohm", 100}};
constexpr Unit kSquares[] = {{"a2", 1}};

constexpr const char* kWords[] = {"source", "device",    "model",  "algorithm", "temperature_c",
                                  "cells",  "constants", "bounds", "note",      "objective"};
constexpr const char* kNeededWords[] = {"source", "device", "model", "algorithm"};
constexpr const char* kNeededQuantities[] = {"iph", "rs", "rsh", "is1", "n1"};

// A column's name without its unit, and the unit in ampere or ohm.
struct Quantity {
  std::string name;
  double factor;
};

template <std::size_t kCount>
std::optional<Quantity> WithUnit(const std::string& name, const std::string& unit,
                                 const Unit (&units)[kCount]) {
  for (const Unit& known : units) {
    if (unit == known.name) return Quantity{name, known.factor};
  }
  return std::nullopt;
}

// "is1_ua" -> {"is1", 1e-6}; n has no unit and gets the factor 1.
std::optional<Quantity> AsQuantity(const std::string& name) {
  if (name == "n1" || name == "n2" || name == "n3") return Quantity{name, 1};
  const std::size_t at = name.find('_');
  if (at == std::string::npos) return std::nullopt;
  const std::string quantity = name.substr(0, at);
  const std::string unit = name.substr(at + 1);
  if (quantity == "rs" || quantity == "rsh") return WithUnit(quantity, unit, kOhm);
  if (quantity == "sse") return WithUnit(quantity, unit, kSquares);
  for (const char* current : {"rmse", "iph", "is1", "is2", "is3"}) {
    if (quantity == current) return WithUnit(quantity, unit, kAmpere);
  }
  return std::nullopt;
}

bool IsWord(const std::string& name) {
  return std::find(std::begin(kWords), std::end(kWords), name) != std::end(kWords);
}

char DelimiterOf(std::string_view header) {
  const auto count = [&](char c) { return std::count(header.begin(), header.end(), c); };
  char best = ',';
  for (const char c : {';', '\t'}) {
    if (count(c) > count(best)) best = c;
  }
  return best;
}

// Adds a column; false if the column exists already.
bool Enter(const Quantity& quantity, int field, AuditColumns* columns) {
  std::vector<QuantityColumn>& same = columns->quantities[quantity.name];
  const bool repeated = std::any_of(same.begin(), same.end(), [&](const QuantityColumn& column) {
    return column.factor == quantity.factor;
  });
  if (!repeated) same.push_back({field, quantity.factor});
  return !repeated;
}

std::string MissingColumns(const AuditColumns& columns) {
  std::string missing;
  const auto note = [&](const char* name, bool there) {
    if (!there) missing += std::string(missing.empty() ? "" : ", ") + name;
  };
  for (const char* name : kNeededWords) note(name, columns.words.count(name) > 0);
  note("rmse", columns.quantities.count("rmse") + columns.quantities.count("sse") > 0);
  for (const char* name : kNeededQuantities) note(name, columns.quantities.count(name) > 0);
  return missing;
}

}  // namespace

const char* const kAuditColumnNames =
    "source, device, model, algorithm, rmse_A (or sse_A2), Iph_A, Rs_ohm, Rsh_ohm, Is1_A (or "
    "Is1_uA), n1, Is2_A, n2, Is3_A, n3, objective, temperature_C, cells, constants, bounds, note";

Expected<AuditColumns> ReadAuditColumns(std::string_view line, const std::string& path,
                                        int number) {
  AuditColumns columns;
  columns.delimiter = DelimiterOf(line);
  LineSplitter fields(columns.delimiter);
  if (!fields.Split(line)) return Fail("the quotes do not close", path, number, 1);
  columns.fields = fields.size();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string name = LowerCase(fields[i]);
    const auto field = static_cast<int>(i);
    const std::optional<Quantity> quantity = AsQuantity(name);
    if (!quantity && !IsWord(name)) {
      return Fail(
          fmt::format("unknown column {}; known are {}", Quoted(fields[i]), kAuditColumnNames),
          path, number, FieldColumn(line, columns.delimiter, i));
    }
    const bool first =
        quantity ? Enter(*quantity, field, &columns) : columns.words.emplace(name, field).second;
    if (!first) {
      return Fail(fmt::format("the column {} stands twice", Quoted(fields[i])), path, number,
                  FieldColumn(line, columns.delimiter, i));
    }
  }
  const std::string missing = MissingColumns(columns);
  if (missing.empty()) return columns;
  return Fail(fmt::format("missing columns: {}; known are {}", missing, kAuditColumnNames), path,
              number, 1);
}

}  // namespace lyrefit
