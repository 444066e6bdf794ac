#include "progress_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lyrefit {
namespace {

constexpr double kSoonest_s = 1;  // shortest time of a stage before its end is estimated
constexpr double kLong_s = 60;

std::string Bar(double part) {
  constexpr std::size_t kWidth = 24;
  const auto filled = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * kWidth);
  return "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "]";
}

}  // namespace

std::string AboutText(double seconds) {
  if (seconds < 10) return fmt::format("about {:.0f} s", std::max(std::ceil(seconds), 1.0));
  if (seconds < 60) return fmt::format("about {:.0f} s", 5 * std::ceil(seconds / 5));
  const auto minutes = static_cast<std::int64_t>(std::ceil(std::min(seconds, 3e7) / 60 - 0.25));
  if (minutes < 2) return "about a minute";
  if (minutes < 60) return fmt::format("about {} minutes", minutes);
  return fmt::format("about {} h {} min", minutes / 60, minutes % 60 / 10 * 10);
}

void ProgressText::Hear(const Progress& progress, double seconds) {
  const bool fresh = stage_ != progress.stage || progress.iteration < last_.iteration;
  stage_ = progress.stage;
  last_ = progress;
  last_.stage = {};
  note_ = progress.note;
  last_.note = {};
  const double part = Part();
  if (fresh) {
    begin_s_ = seconds;
    begin_part_ = part;
  }
  if (fresh || part != heard_part_) {
    heard_s_ = seconds;
    heard_part_ = part;
  }
}

double ProgressText::Part() const {
  if (last_.part > 0) return last_.part;
  if (last_.iterations <= 0) return 0;
  return static_cast<double>(last_.iteration) / static_cast<double>(last_.iterations);
}

double ProgressText::SecondsLeft(double seconds) const {
  if (seconds - begin_s_ < kSoonest_s || heard_part_ <= begin_part_) return -1;
  const double all = (1 - begin_part_) / (heard_part_ - begin_part_) * (heard_s_ - begin_s_);
  return std::max(all - (seconds - begin_s_), 0.0);
}

std::string ProgressText::Line(double seconds) const {
  const std::string elapsed = fmt::format("{:.0f} s", std::floor(seconds));
  if (stage_.empty()) return seconds < kSoonest_s ? "" : "working, " + elapsed;
  const bool known = last_.best > 0 && std::isfinite(last_.best);
  const std::string best = known ? fmt::format(", best {:.4g}", last_.best) : "";
  const std::string note = best + (note_.empty() ? "" : ", " + note_);
  if (last_.iterations <= 0 && last_.part <= 0) {
    if (last_.iteration <= 0) return fmt::format("{}, {}", stage_, elapsed);
    return fmt::format("{}: {} done{}, {}", stage_, last_.iteration, note, elapsed);
  }
  // The number of iterations may be unknown although the finished part is known.
  const std::string of =
      last_.iterations > 0 ? fmt::format("of {}", last_.iterations) : std::string("done");
  const std::string line =
      fmt::format("{} {} {} {}{}", stage_, Bar(Part()), last_.iteration, of, note);
  const double left = SecondsLeft(seconds);
  if (left < 1) return line + ", " + elapsed;
  return line +
         fmt::format(", {} left{}", AboutText(left), stage_ == whole_ ? "" : " in this step");
}

std::string ProgressText::LongRun(double seconds) {
  if (said_) return "";
  const double left = SecondsLeft(seconds);
  const double all = seconds + left;
  if (left >= 0 && all > kLong_s) {
    said_ = true;
    return "this takes " + AboutText(all) + (stage_ == whole_ ? "" : " or more");
  }
  if (seconds <= kLong_s) return "";
  said_ = true;
  return "this has taken a minute so far";
}

}  // namespace lyrefit
