#pragma once

#include <iterator>
#include <vector>

namespace lyrefit {

// Puts `more` at the end of `list`.
template <class T>
void Append(std::vector<T> more, std::vector<T>* list) {
  list->insert(list->end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

}  // namespace lyrefit
