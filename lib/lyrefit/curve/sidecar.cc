#include "lyrefit/curve/sidecar.h"

#include "lyrefit/base/file.h"
#include "lyrefit/curve/json_text.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// The word that says an entry has no single value.
constexpr const char* kVaried = "varied";

class SidecarReader {
 public:
  SidecarReader(const json& object, const std::string& text, const std::string& path, SidecarOf of)
      : fields_(object, text, path), text_(text), path_(path), of_(of) {}

  Expected<Sidecar> Read() {
    ReadText("name", &sidecar_.name);
    ReadText("technology", &sidecar_.notes.technology);
    ReadConditions();
    DeviceNotes& notes = sidecar_.notes;
    ReadWhole({"bypass_diodes"}, 0, "a number from 0 up", &notes.bypass_diodes);
    ReadNumber({"bandgap_eV"}, Sign::kPositive, &notes.bandgap_eV);
    ReadNumber({"isc_tempco_per_K"}, Sign::kAny, &notes.isc_tempco_per_K);
    ReadNumber({"isc_tempco_A_per_K", "alpha_Isc_A_per_K"}, Sign::kAny, &notes.isc_tempco_A_per_K);
    ReadNumber({"current_resolution_A"}, Sign::kPositive, &notes.current_resolution_A);
    ReadNoise();
    if (failed_) return tl::unexpected(error_);
    return sidecar_;
  }

 private:
  enum class Sign { kAny, kNotNegative, kPositive };

  void Fail(const Error& error) {
    if (!failed_) error_ = error;
    failed_ = true;
  }

  void ReadText(const char* key, std::string* target) {
    const auto text = fields_.Text(key);
    if (!text) return Fail(text.error());
    if (*text) *target = **text;
  }

  // A text that begins like a number ("25 C") is rather a mistake.
  static bool IsRemark(const json& value) {
    if (!value.is_string()) return false;
    const auto& text = value.get_ref<const std::string&>();
    return !text.empty() && text.find_first_of("+-.0123456789 ") != 0;
  }

  // The first of `keys` that is given, in a set without those that are remarks.
  void ReadCondition(std::initializer_list<const char*> keys, Sign sign,
                     std::optional<double>* target) {
    for (const char* key : keys) {
      std::string name;
      const json* value = fields_.Find({key}, &name);
      if (value == nullptr || (of_ == SidecarOf::kSet && IsRemark(*value))) continue;
      return ReadNumber(fields_, {key}, sign, target);
    }
  }

  void ReadNumber(const JsonFields& fields, std::initializer_list<const char*> keys, Sign sign,
                  std::optional<double>* target) {
    std::string key;
    const json* value = fields.Find(keys, &key);
    if (value == nullptr) return;
    if (value->is_string() && value->get_ref<const std::string&>() == kVaried) return;
    const auto number = fields.Number(keys);
    if (!number) return Fail(number.error());
    if (sign == Sign::kPositive && !(**number > 0)) {
      return Fail(fields.Refuse(key, "a positive number").value());
    }
    if (sign == Sign::kNotNegative && !(**number >= 0)) {
      return Fail(fields.Refuse(key, "a number from 0 up").value());
    }
    *target = *number;
  }

  void ReadNumber(std::initializer_list<const char*> keys, Sign sign,
                  std::optional<double>* target) {
    ReadNumber(fields_, keys, sign, target);
  }

  void ReadWhole(std::initializer_list<const char*> keys, int smallest, const char* expected,
                 std::optional<int>* target) {
    const auto number = fields_.WholeNumber(keys);
    if (!number) return Fail(number.error());
    if (!*number) return;
    std::string key;
    fields_.Find(keys, &key);
    if (**number < smallest) return Fail(fields_.Refuse(key, expected).value());
    *target = *number;
  }

  void ReadConditions() {
    const auto temperature_keys = {"cell_temperature_C", "temperature_C", "nominal_temperature_C"};
    ReadCondition(temperature_keys, Sign::kAny, &sidecar_.temperature_C);
    const double temperature_C = sidecar_.temperature_C.value_or(25);
    if (temperature_C > 150 || temperature_C < -100) {
      std::string key;
      fields_.Find(temperature_keys, &key);
      Fail(fields_
               .Refuse(key, temperature_C > 150
                                ? "degrees Celsius from -100 to 150 (it looks like kelvin)"
                                : "degrees Celsius from -100 to 150")
               .value());
    }
    ReadCondition(
        {"irradiance_W_m2", "irradiance_Wm2", "nominal_irradiance_Wm2", "nominal_irradiance_W_m2"},
        Sign::kNotNegative, &sidecar_.irradiance_W_m2);
    ReadWhole({"cells_in_series"}, 1, "at least 1", &sidecar_.cells_in_series);
    ReadWhole({"strings_in_parallel"}, 1, "at least 1", &sidecar_.strings_in_parallel);
  }

  void ReadNoise() {
    std::string key;
    const json* noise = fields_.Find({"current_noise"}, &key);
    if (noise == nullptr) return;
    if (!noise->is_object()) {
      return Fail(fields_.Refuse(key, "an object of constant_A and relative").value());
    }
    const JsonFields fields(*noise, text_, path_);
    ReadNumber(fields, {"constant_A"}, Sign::kNotNegative,
               &sidecar_.notes.current_noise_constant_A);
    ReadNumber(fields, {"relative"}, Sign::kNotNegative, &sidecar_.notes.current_noise_relative);
  }

  JsonFields fields_;
  const std::string& text_;
  const std::string& path_;
  SidecarOf of_;
  Sidecar sidecar_;
  bool failed_ = false;
  Error error_;
};

}  // namespace

Expected<Sidecar> ReadSidecar(const std::string& path, std::uintmax_t largest_file_bytes,
                              SidecarOf of) {
  const Expected<std::string> text = ReadTextFile(path, largest_file_bytes);
  if (!text) return tl::unexpected(text.error());
  const Expected<json> object = ParseJson(*text, path);
  if (!object) return tl::unexpected(object.error());
  if (!object->is_object())
    return Fail("expected a JSON object with keys such as cells_in_series", path, 1, 1);
  return SidecarReader(*object, *text, path, of).Read();
}

Sidecar Merge(Sidecar own, const Sidecar& common) {
  const auto fill = [](auto* value, const auto& otherwise) {
    if (!*value) *value = otherwise;
  };
  if (own.name.empty()) own.name = common.name;
  fill(&own.temperature_C, common.temperature_C);
  fill(&own.irradiance_W_m2, common.irradiance_W_m2);
  fill(&own.cells_in_series, common.cells_in_series);
  fill(&own.strings_in_parallel, common.strings_in_parallel);
  DeviceNotes& notes = own.notes;
  if (notes.technology.empty()) notes.technology = common.notes.technology;
  fill(&notes.bypass_diodes, common.notes.bypass_diodes);
  fill(&notes.bandgap_eV, common.notes.bandgap_eV);
  fill(&notes.isc_tempco_per_K, common.notes.isc_tempco_per_K);
  fill(&notes.isc_tempco_A_per_K, common.notes.isc_tempco_A_per_K);
  fill(&notes.current_noise_constant_A, common.notes.current_noise_constant_A);
  fill(&notes.current_noise_relative, common.notes.current_noise_relative);
  fill(&notes.current_resolution_A, common.notes.current_resolution_A);
  return own;
}

}  // namespace lyrefit
