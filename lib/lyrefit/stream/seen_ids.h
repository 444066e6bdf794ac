#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lyrefit {

// Location of an id: index of the input, from 0, and line in it; 0 for a file of its own.
struct IdPlace {
  int input = 0;
  std::int64_t line = 0;
};

// The set of used ids, as hashes of 64 bits. After the first few thousand ids the table takes 34
// MB, so that ten thousand curves need as much memory as a million. It doubles at 1.9 million ids.
class SeenIds {
 public:
  SeenIds() : slots_(kFirstSlots) {}

  // Inserts an id. Returns its earlier location if it is already in the set.
  std::optional<IdPlace> Insert(std::string_view id, IdPlace place);

 private:
  static constexpr std::size_t kFirstSlots = std::size_t{1} << 12;
  static constexpr std::size_t kSlots = std::size_t{1} << 21;

  struct Slot {
    std::uint64_t hash = 0;   // 0: free
    std::uint64_t place = 0;  // 20 bits of the input, 44 bits of the line
  };

  Slot* Find(std::uint64_t hash);
  void Grow();

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace lyrefit
