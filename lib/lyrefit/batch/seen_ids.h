#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lyrefit {

// Where an id stood: the input, from 0, and the line in it, 0 where it is a file.
struct IdPlace {
  int input = 0;
  std::int64_t line = 0;
};

// The ids that were used. Holds hashes of 64 bits; behind the first few thousand in a table of 34 MB,
// so that a run over ten thousand curves needs as much as one over a million; it doubles when 1.9
// million are in it.
class SeenIds {
 public:
  SeenIds() : slots_(kFirstSlots) {}

  // Remembers it; where it stands already if it was there.
  std::optional<IdPlace> Insert(std::string_view id, IdPlace place);

 private:
  static constexpr std::size_t kFirstSlots = std::size_t{1} << 12;
  static constexpr std::size_t kSlots = std::size_t{1} << 21;

  struct Slot {
    std::uint64_t hash = 0;   // 0: free
    std::uint64_t place = 0;  // 20 bits of the input, 44 of the line
  };

  Slot* Find(std::uint64_t hash);
  void Grow();

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace lyrefit
