#include "lyrefit/model/extended_set.h"

#include <memory>
#include <string>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/model/make_readings.h"

namespace lyrefit {
namespace {

// Applies the stated irradiances. A curve of irradiance 0 is dark, even if all other curves have
// very little light.
void TakeConditions(const CurveSet& set, Readings* readings) {
  constexpr double kOrdinary_suns = 0.02;  // below it MakeReadings decides by the readings
  for (Reading& r : readings->points) {
    const double stated = set.curves[r.curve].conditions.irradiance_W_m2 / 1000;
    r.dark = stated <= 0;
    if (stated <= kOrdinary_suns || r.irradiance == 0) r.irradiance = stated;
  }
}

// The device at other readings. It does not copy the readings of the whole set, which may be many.
Device At(const Device& device, std::vector<Reading> points) {
  const DeviceEffects& whole = *device.effects;
  DeviceEffects device_effects;
  device_effects.law = whole.law;
  device_effects.uses = whole.uses;
  device_effects.bounds = whole.bounds;
  device_effects.usual = whole.usual;
  device_effects.set = whole.set;
  Readings& readings = device_effects.readings;
  readings.scale = whole.readings.scale;
  readings.traits = whole.readings.traits;
  readings.reference_temperature_K = whole.readings.reference_temperature_K;
  readings.points = std::move(points);
  device_effects.blocks = BlocksOf(readings);
  Device one = device;
  one.effects = std::make_shared<const DeviceEffects>(std::move(device_effects));
  return one;
}

}  // namespace

Expected<Readings> SetReadings(const CurveSet& set, double reference_K) {
  std::vector<std::string> contradictions;  // discarded: the readers of the curves report them
  TRY(Readings readings, MakeReadings(set, &contradictions));
  const int cells = set.curves.front().conditions.cells_in_series;
  const double ratio = readings.scale.cells / static_cast<double>(cells);
  for (Reading& r : readings.points) r.voltage *= ratio;
  readings.scale.cells = readings.traits.cells = cells;
  readings.scale.rate_V_per_s *= ratio;
  readings.scale.reach_V *= ratio;
  readings.pivot_voltage *= ratio;
  readings.reference_temperature_K = reference_K;
  readings.traits.module = cells > 1;
  readings.scale.saturation_2_unit = Saturation2Unit(readings);
  return readings;
}

Expected<Device> ExtendSet(const Device& base, Law law, const CurveSet& set, double reference_K,
                           const std::vector<EffectUse>& uses, bool force) {
  TRY(auto readings, SetReadings(set, reference_K));
  TakeConditions(set, &readings);
  readings.isc_tempco_scales_per_K = 0;  // alpha is a parameter
  DeviceEffects device_effects;
  device_effects.readings = std::move(readings);
  device_effects.law = std::move(law);
  device_effects.law.free_tempco = device_effects.law.free_bandgap = true;
  device_effects.law.effects.clear();
  device_effects.set = std::make_shared<const CurveSet>(set);
  Device device = base;
  device.parameters = device_effects.law.BaseInfos();
  return AddEffects(device, std::move(device_effects), uses, force);
}

Device OfCurve(const Device& device, int curve) {
  std::vector<Reading> points;
  for (const Reading& r : device.effects->readings.points) {
    if (r.curve == curve) points.push_back(r);
  }
  return At(device, std::move(points));
}

Device UnderConditions(const Device& device, double irradiance, double temperature_K) {
  Reading reading;
  reading.irradiance = irradiance;
  reading.temperature_K = temperature_K;
  reading.dark = irradiance <= 0;
  return At(device, {reading});
}

Expected<void> ExtendTranslation(const CurveSet& set, double bandgap_slope,
                                 const std::vector<EffectUse>& uses, bool force,
                                 Translation* translation) {
  Translation& at = *translation;
  Law law;
  law.model = at.spec.model;
  law.constants = at.spec.constants;
  law.shunt = at.spec.shunt;
  law.bandgap_slope_per_K = bandgap_slope;
  TRY(auto device, ExtendSet(at.device, std::move(law), set, kReferenceTemperature_K, uses, force));
  at.shared_of = {at.photocurrent, at.saturation_current, at.n, at.resistance_series,
                  at.resistance_shunt};
  if (at.n_2 >= 0) at.shared_of.insert(at.shared_of.end(), {at.saturation_current_2, at.n_2});
  at.shared_of.insert(at.shared_of.end(), {at.alpha_sc, at.bandgap});
  at.first_effect = at.size();
  for (int i = at.size(); static_cast<int>(at.shared_of.size()) < device.size(); ++i) {
    at.shared_of.push_back(i);
  }
  AddInfos(uses, &at.parameters);
  at.extended = std::move(device);
  return {};
}

std::vector<double> ExtendedParameters(const Translation& translation, const double* shared) {
  std::vector<double> p;
  p.reserve(translation.shared_of.size());
  for (const int i : translation.shared_of) p.push_back(shared[i]);
  return p;
}

EffectSpan SpanOf(const Translation& translation) {
  if (!translation.extended) return {};
  return {translation.extended->effects.get(), translation.first_effect};
}

std::vector<double> ReportedShared(const Translation& translation, std::vector<double> shared) {
  return Reported(SpanOf(translation), std::move(shared));
}

std::vector<double> InternalShared(const Translation& translation, std::vector<double> shared) {
  return Internal(SpanOf(translation), std::move(shared));
}

}  // namespace lyrefit
