#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "plant/campaign_results.h"
#include "plant/campaign_words.h"

namespace lyrefit {
namespace {

using CampaignRecord = nlohmann::ordered_json;

CampaignRecord Finite(double value) {
  return std::isfinite(value) ? CampaignRecord(value) : CampaignRecord();
}

double NumberAt(const CampaignRecord& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : kUnknown;
}

CampaignRecord CommonJson(const CommonChange& common) {
  CampaignRecord json = {{"name", common.name}, {"strings", common.strings}};
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    const PercentChange& change = common.percent[q];
    json[kCampaignFigures[q]] = {{"percent", Finite(change.value)},
                                 {"low_95", Finite(change.low)},
                                 {"high_95", Finite(change.high)}};
  }
  json["sentence"] = common.sentence;
  return json;
}

CommonChange CommonOf(const CampaignRecord& json) {
  CommonChange common;
  common.name = json.value("name", "");
  common.strings = json.value("strings", std::int64_t{0});
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    const CampaignRecord change = json.value(kCampaignFigures[q], CampaignRecord::object());
    common.percent[q] = {NumberAt(change, "percent"), NumberAt(change, "low_95"),
                         NumberAt(change, "high_95")};
  }
  common.sentence = json.value("sentence", "");
  return common;
}

CampaignRecord ChangeJson(const StringChange& change) {
  const Cause& cause = change.cause;
  const Sized& lost = cause.recoverable_power_W;
  return {{"rank", change.rank},
          {"id", change.id},
          {"kind", cause.id},
          {"candidates", fmt::format("{}", fmt::join(cause.equivalents, " "))},
          {"probability", Finite(cause.probability)},
          {"Isc_percent", Finite(change.isc_percent)},
          {"Voc_percent", Finite(change.voc_percent)},
          {"FF_percent", Finite(change.ff_percent)},
          {"lost_W", Finite(lost.value)},
          {"lost_W_low_95", Finite(lost.low_95)},
          {"lost_W_high_95", Finite(lost.high_95)},
          {"sentence", cause.sentence},
          {"action", cause.action}};
}

StringChange ChangeOf(const CampaignRecord& json) {
  StringChange change;
  change.rank = json.value("rank", std::int64_t{0});
  change.id = json.value("id", "");
  Cause& cause = change.cause;
  cause.id = json.value("kind", "");
  cause.equivalents = IdsIn(json.value("candidates", ""));
  cause.probability = NumberAt(json, "probability");
  cause.recoverable_power_W = {NumberAt(json, "lost_W"), NumberAt(json, "lost_W_low_95"),
                               NumberAt(json, "lost_W_high_95")};
  cause.sentence = json.value("sentence", "");
  cause.action = json.value("action", "");
  change.isc_percent = NumberAt(json, "Isc_percent");
  change.voc_percent = NumberAt(json, "Voc_percent");
  change.ff_percent = NumberAt(json, "FF_percent");
  return change;
}

}  // namespace

nlohmann::ordered_json CampaignJson(const CampaignSummary& summary) {
  CampaignRecord json = {{"before",
                          {{"version", summary.before_version},
                           {"rows", summary.before_rows},
                           {"first_date", summary.before_first_date},
                           {"last_date", summary.before_last_date}}},
                         {"level", summary.level},
                         {"compared", summary.compared},
                         {"changed", summary.changed},
                         {"lost_W", summary.lost_W},
                         {"gained_W", summary.gained_W},
                         {"plant", CommonJson(summary.plant)},
                         {"groups", CampaignRecord::array()},
                         {"changes", CampaignRecord::array()},
                         {"gone", summary.gone},
                         {"not_repeated", summary.not_repeated},
                         {"new", summary.fresh},
                         {"gone_ids", summary.gone_ids},
                         {"new_ids", summary.fresh_ids},
                         {"exchanged", CampaignRecord::array()},
                         {"remarks", summary.remarks}};
  for (const CommonChange& group : summary.groups) json["groups"].push_back(CommonJson(group));
  for (const StringChange& change : summary.changes) json["changes"].push_back(ChangeJson(change));
  for (const auto& [one, other] : summary.exchanged) {
    json["exchanged"].push_back(CampaignRecord::array({one, other}));
  }
  return json;
}

CampaignSummary CampaignOf(const nlohmann::ordered_json& json) {
  CampaignSummary summary;
  const CampaignRecord before = json.value("before", CampaignRecord::object());
  summary.before_version = before.value("version", "");
  summary.before_rows = before.value("rows", std::int64_t{0});
  summary.before_first_date = before.value("first_date", "");
  summary.before_last_date = before.value("last_date", "");
  summary.level = json.value("level", 0.0);
  summary.compared = json.value("compared", std::int64_t{0});
  summary.changed = json.value("changed", std::int64_t{0});
  summary.lost_W = json.value("lost_W", 0.0);
  summary.gained_W = json.value("gained_W", 0.0);
  summary.plant = CommonOf(json.value("plant", CampaignRecord::object()));
  for (const auto& group : json.value("groups", CampaignRecord::array())) {
    summary.groups.push_back(CommonOf(group));
  }
  for (const auto& change : json.value("changes", CampaignRecord::array())) {
    summary.changes.push_back(ChangeOf(change));
  }
  summary.gone = json.value("gone", std::int64_t{0});
  summary.not_repeated = json.value("not_repeated", std::int64_t{0});
  summary.fresh = json.value("new", std::int64_t{0});
  summary.gone_ids = json.value("gone_ids", std::vector<std::string>());
  summary.fresh_ids = json.value("new_ids", std::vector<std::string>());
  for (const auto& pair : json.value("exchanged", CampaignRecord::array())) {
    summary.exchanged.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<std::string>());
  }
  summary.remarks = json.value("remarks", std::vector<std::string>());
  return summary;
}

}  // namespace lyrefit
