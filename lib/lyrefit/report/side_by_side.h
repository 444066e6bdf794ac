#pragma once

namespace lyrefit {

// What to run instead where sweeps are too few to be judged together.
inline constexpr char kSideBySide[] =
    "to put Isc, Rs, Rsh and n of a few sweeps side by side, run lyrefit fit FILES --csv table.csv";

}  // namespace lyrefit
