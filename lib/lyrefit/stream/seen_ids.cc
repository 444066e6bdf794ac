#include "lyrefit/stream/seen_ids.h"

#include <algorithm>
#include <cstring>

namespace lyrefit {
namespace {

constexpr int kLineBits = 44;
constexpr std::uint64_t kLineMask = (std::uint64_t{1} << kLineBits) - 1;

// The finaliser of SplitMix64: every bit of the state affects every bit of the result.
std::uint64_t Mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t HashOf(std::string_view id) {
  std::uint64_t hash = Mix(id.size() + 0x9e3779b97f4a7c15ULL);
  while (!id.empty()) {
    std::uint64_t eight = 0;
    const std::size_t taken = id.size() < sizeof eight ? id.size() : sizeof eight;
    std::memcpy(&eight, id.data(), taken);
    hash = Mix(hash ^ eight) + 0x9e3779b97f4a7c15ULL;
    id.remove_prefix(taken);
  }
  hash = Mix(hash);
  return hash == 0 ? 1 : hash;
}

}  // namespace

SeenIds::Slot* SeenIds::Find(std::uint64_t hash) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].hash != 0 && slots_[at].hash != hash) at = (at + 1) & mask;
  return &slots_[at];
}

void SeenIds::Grow() {
  std::vector<Slot> old(std::max(kSlots, 2 * slots_.size()));
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.hash != 0) *Find(slot.hash) = slot;
  }
}

std::optional<IdPlace> SeenIds::Insert(std::string_view id, IdPlace place) {
  const std::uint64_t hash = HashOf(id);
  Slot* slot = Find(hash);
  if (slot->hash != 0) {
    return IdPlace{static_cast<int>(slot->place >> kLineBits),
                   static_cast<std::int64_t>(slot->place & kLineMask)};
  }
  if (10 * (used_ + 1) > 9 * slots_.size()) {
    Grow();
    slot = Find(hash);
  }
  ++used_;
  slot->hash = hash;
  slot->place = (static_cast<std::uint64_t>(place.input) << kLineBits) |
                (static_cast<std::uint64_t>(place.line) & kLineMask);
  return std::nullopt;
}

}  // namespace lyrefit
