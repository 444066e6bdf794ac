#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/trend/trend_documents.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {
namespace {

Json DateJson(double seconds) { return std::isfinite(seconds) ? Json(DateText(seconds)) : Json(); }

Json ChangeJson(const TrendChange& change) {
  return {{"date", DateJson(change.time_s)},
          {"date_low", DateJson(change.earliest_s)},
          {"date_high", DateJson(change.latest_s)},
          {"size", change.size},
          {"p_value", change.p_value}};
}

Json QuantityJson(const TrendQuantity& quantity) {
  Json steps = Json::array(), onsets = Json::array(), days = Json::array();
  for (const TrendChange& change : quantity.changes) {
    (change.onset ? onsets : steps).push_back(ChangeJson(change));
  }
  for (const TrendDay& day : quantity.days) {
    days.push_back({DateTimeText(day.time_s), day.value, day.fitted, day.rows});
  }
  return {{"name", quantity.name},
          {"title", quantity.title},
          {"unit", quantity.unit},
          {"reference", quantity.reference},
          {"rate_per_year", quantity.rate_per_year},
          {"rate_percent", quantity.rate_percent},
          {"change", quantity.change},
          {"rate_until", DateJson(quantity.rate_until_s)},
          {"steps", steps},
          {"onsets", onsets},
          {"seasonal", quantity.seasonal},
          {"day_scatter", quantity.day_scatter},
          {"shared_scatter", quantity.shared_scatter},
          {"half_life_days", quantity.half_life_days},
          {"missing", quantity.missing},
          {"days", days}};
}

Json OnsetJson(const TrendOnset& onset) {
  return {{"date", DateJson(onset.time_s)},
          {"date_low", DateJson(onset.earliest_s)},
          {"date_high", DateJson(onset.latest_s)},
          {"quantity", onset.quantity},
          {"id", onset.cause.id},
          {"cause", onset.cause.title},
          {"lost_percent", onset.lost_percent},
          {"sentence", onset.sentence()}};
}

Json TrendLossJson(const TrendReport& report) {
  Json energy = Json::object(), now = Json::object(), days = Json::object();
  for (const TrendLoss& loss : report.losses) {
    energy[loss.name] = loss.energy_percent;
    now[loss.name] = loss.now_percent;
  }
  for (std::size_t p = 0; p < report.loss_days.size(); ++p) {
    Json list = Json::array();
    for (const TrendDay& day : report.loss_days[p]) {
      list.push_back({DateTimeText(day.time_s), day.value});
    }
    days[report.losses[p].name] = list;
  }
  return {{"energy_percent", energy}, {"now_percent", now}, {"days", days}};
}

}  // namespace

std::string TrendJson(const TrendReport& report) {
  Json states = Json::object(), reasons = Json::array(), quantities = Json::array(),
       onsets = Json::array(), covered = Json::array();
  for (int s = 0; s < kTrendRowStates; ++s) {
    states[ToText(static_cast<TrendRowState>(s))] = report.states[static_cast<std::size_t>(s)];
  }
  for (const TrendReason& reason : report.reasons) {
    reasons.push_back({{"reason", reason.reason},
                       {"measurements", reason.rows},
                       {"first", DateJson(reason.first_s)},
                       {"last", DateJson(reason.last_s)},
                       {"doubtful", reason.doubtful}});
  }
  for (const TrendQuantity& quantity : report.quantities) {
    quantities.push_back(QuantityJson(quantity));
  }
  for (const TrendOnset& onset : report.onsets) onsets.push_back(OnsetJson(onset));
  for (const CoveredDays& one : report.covered) {
    Json days = Json::array();
    for (const double day_s : one.days_s) days.push_back(DateJson(day_s));
    covered.push_back({{"frost", one.frost}, {"days", days}, {"lost_percent", one.lost_percent}});
  }
  const Json j = {{"lyrefit_version", report.version},
                  {"name", report.name},
                  {"verdict", report.verdict},
                  {"source", report.source},
                  {"cells_in_series", report.cells_in_series},
                  {"substrings", report.substrings},
                  {"n", report.ideality},
                  {"law", report.law},
                  {"first", DateTimeText(report.first_s)},
                  {"last", DateTimeText(report.last_s)},
                  {"reference_end", DateTimeText(report.reference_end_s)},
                  {"measurements", report.rows},
                  {"states", states},
                  {"reasons", reasons},
                  {"covered", covered},
                  {"dull_sky_percent", report.dull_sky_percent},
                  {"days", report.days},
                  {"reference_power_W", report.reference_power_W},
                  {"quantities", quantities},
                  {"loss", TrendLossJson(report)},
                  {"onsets", onsets},
                  {"not_decided", report.not_decided},
                  {"seed", report.seed},
                  {"options", report.options},
                  {"interrupted", report.interrupted},
                  {"warnings", report.warnings}};
  return Dump(j);
}

}  // namespace lyrefit
