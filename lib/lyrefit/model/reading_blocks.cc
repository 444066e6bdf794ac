#include "lyrefit/model/make_readings.h"

#include <algorithm>

namespace lyrefit {
namespace {

bool SameConditions(const Reading& a, const Reading& b) {
  return a.irradiance == b.irradiance && a.temperature_K == b.temperature_K &&
         a.suns_voc == b.suns_voc;
}

template <class F>
Pack Gather(const Readings& readings, const ReadingBlock& block, F value) {
  Block lanes;
  for (int i = 0; i < Block::kLanes; ++i) {
    lanes.lane[i] = value(readings.points[block.first + std::min(i, block.count - 1)]);
  }
  return every_processor::Load(lanes);
}

// Number of readings from `first` on with the same irradiance and temperature, at most a full
// block.
int RunFrom(const Readings& readings, int first) {
  const std::vector<Reading>& points = readings.points;
  const int end = std::min(first + Block::kLanes, static_cast<int>(points.size()));
  int last = first + 1;
  while (last < end && SameConditions(points[first], points[last])) ++last;
  return last - first;
}

}  // namespace

std::vector<ReadingBlock> BlocksOf(const Readings& readings) {
  constexpr int kOwn = Block::kLanes / 2;
  const int count = static_cast<int>(readings.points.size());
  std::vector<ReadingBlock> blocks;
  for (int first = 0; first < count; first += blocks.back().count) {
    ReadingBlock block;
    block.first = first;
    block.count = RunFrom(readings, first);
    block.suns_voc = readings.points[first].suns_voc;
    block.same_conditions = block.count >= kOwn || block.suns_voc;
    while (!block.same_conditions && block.count < Block::kLanes && first + block.count < count) {
      const int next = RunFrom(readings, first + block.count);
      if (next >= kOwn || readings.points[first + block.count].suns_voc) break;
      block.count += next;
    }
    block.count = std::min(block.count, Block::kLanes);
    block.voltage = Gather(readings, block, [](const Reading& r) { return r.voltage; });
    block.current = Gather(readings, block, [](const Reading& r) { return r.current; });
    block.irradiance = Gather(readings, block, [](const Reading& r) { return r.irradiance; });
    block.temperature_K = Gather(readings, block, [](const Reading& r) { return r.temperature_K; });
    block.x = Gather(readings, block, [](const Reading& r) { return r.x; });
    block.rate = Gather(readings, block, [](const Reading& r) { return r.rate; });
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace lyrefit
