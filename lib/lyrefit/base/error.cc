#include "lyrefit/base/error.h"

namespace lyrefit {

std::string Error::ToString() const {
  std::string place = file;
  if (line > 0) place += (place.empty() ? "line " : ":") + std::to_string(line);
  if (line > 0 && column > 0) place += ":" + std::to_string(column);
  return place.empty() ? message : place + ": " + message;
}

}  // namespace lyrefit
